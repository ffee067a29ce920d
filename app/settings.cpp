#include "app/settings.h"

#include "materials/json_text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <stdexcept>

namespace patina {

using Json = nlohmann::ordered_json;

namespace {

/// Takes over values of the right type and inside their range; everything else is noted and left alone.
struct Reader {
    const Json& json;
    std::vector<std::string>& notes;

    void complain(const char* key) const {
        notes.push_back(std::string("settings: '") + key + "' is ignored.");
    }

    void read(const char* key, int& value, int low, int high) const {
        const auto found = json.find(key);
        if (found == json.end()) return;
        if (!found->is_number_integer() || found->get<std::int64_t>() < low ||
            found->get<std::int64_t>() > high)
            return complain(key);
        value = found->get<int>();
    }
    void read(const char* key, float& value, float low, float high) const {
        const auto found = json.find(key);
        if (found == json.end()) return;
        if (!found->is_number() || !(found->get<double>() >= low && found->get<double>() <= high))
            return complain(key);
        value = found->get<float>();
    }
    void read(const char* key, bool& value) const {
        const auto found = json.find(key);
        if (found == json.end()) return;
        if (!found->is_boolean()) return complain(key);
        value = found->get<bool>();
    }
    void read(const char* key, std::string& value) const {
        const auto found = json.find(key);
        if (found == json.end()) return;
        if (!found->is_string()) return complain(key);
        value = found->get<std::string>();
    }
    void read(const char* key, std::vector<std::string>& value) const {
        const auto found = json.find(key);
        if (found == json.end()) return;
        if (!found->is_array()) return complain(key);
        value.clear();
        for (const Json& item : *found)
            if (item.is_string() && value.size() < kRecentFiles) value.push_back(item.get<std::string>());
    }
};

}  // namespace

namespace {

/// Of bounded depth; null where it is no JSON.
Json parsed_or_null(std::string_view text) {
    try {
        std::vector<std::string> repeated_keys;
        return parse_json(text, "settings", repeated_keys);
    } catch (const std::runtime_error&) {
        return nullptr;
    }
}

}  // namespace

ParsedSettings parse_settings(std::string_view text) {
    ParsedSettings parsed;
    const Json json = parsed_or_null(text);
    if (!json.is_object()) {
        parsed.notes.emplace_back("The settings could not be read and start afresh.");
        return parsed;
    }
    Settings& s = parsed.settings;
    const Reader reader{json, parsed.notes};
    reader.read("window_width", s.window_width, 320, 32768);
    reader.read("window_height", s.window_height, 240, 32768);
    reader.read("maximized", s.maximized);
    reader.read("mesh", s.mesh);
    reader.read("environment", s.environment);
    reader.read("recent", s.recent);
    reader.read("opened_environments", s.opened_environments);
    reader.read("opened_meshes", s.opened_meshes);
    reader.read("last_folder", s.last_folder);
    reader.read("library_width", s.library_width, 50.0f, 2000.0f);
    reader.read("inspector_width", s.inspector_width, 50.0f, 2000.0f);
    reader.read("drawer_height", s.drawer_height, 50.0f, 2000.0f);
    reader.read("show_library", s.show_library);
    reader.read("show_inspector", s.show_inspector);
    return parsed;
}

std::string to_json(const Settings& s) {
    const Json json{{"window_width", s.window_width},
                    {"window_height", s.window_height},
                    {"maximized", s.maximized},
                    {"mesh", s.mesh},
                    {"environment", s.environment},
                    {"recent", s.recent},
                    {"opened_environments", s.opened_environments},
                    {"opened_meshes", s.opened_meshes},
                    {"last_folder", s.last_folder},
                    {"library_width", s.library_width},
                    {"inspector_width", s.inspector_width},
                    {"drawer_height", s.drawer_height},
                    {"show_library", s.show_library},
                    {"show_inspector", s.show_inspector}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void remember(std::vector<std::string>& list, const std::string& path, std::size_t limit) {
    std::erase(list, path);
    list.insert(list.begin(), path);
    if (list.size() > limit) list.resize(limit);
}

}  // namespace patina
