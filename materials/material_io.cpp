#include "materials/material_io.h"

#include "materials/json_text.h"
#include "materials/params.h"
#include "materials/text_io.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>

namespace patina {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Pointer = nlohmann::json_pointer<std::string>;

namespace {

constexpr std::size_t kMaxNotes = 50;

/// Where a key's object or value stands: "uv.scale" is /uv/scale.
std::string json_place(std::string_view key) {
    std::string place = "/" + std::string(key);
    std::replace(place.begin(), place.end(), '.', '/');
    return place;
}
std::string json_place(const MaterialParam& param) {
    return json_place(param.key) + (param.slot ? "/value" : "");
}

/// Calls act(choices, value, JSON key) for each way of reading the map that the slot has.
template <class Ref, class Act>
void for_each_choice(const Ref& ref, Act&& act) {
    if (ref.color_space) act(kColorSpaces, *ref.color_space, "color_space");
    if (ref.channel) act(kChannels, *ref.channel, "channel");
    if (ref.convention) act(kNormalConventions, *ref.convention, "convention");
}

std::string lower(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

/// The double with the digits of the shortest text that reads back the same float.
Json shortest(float value) {
    std::array<char, 32> text{};
    *std::to_chars(text.data(), text.data() + text.size() - 1, value).ptr = '\0';
    return Json::parse(text.data());
}

class Reader {
public:
    Reader(std::string_view text, const std::string& name) : text_(text), name_(name) {
        std::vector<std::string> repeated;
        root_ = parse_json(text, name, repeated);
        if (!root_.is_object()) fail("", "is " + type_of(root_) + "; a material preset is a JSON object");
        for (const std::string& key : repeated)
            if (noted_.insert(key).second) note(key, "is there more than once; the last one counts");
    }

    LoadedMaterial read() {
        read_head();
        for (const MaterialParam& param : kMaterialParams) read_numbers(param);
        for (const MaterialSlot& slot : material_slots()) read_slot(slot);
        keep_unknown();
        if (dropped_notes_ > 0)
            result_.notes.push_back(name_ + ": " + std::to_string(dropped_notes_) +
                                    " more notes of this kind.");
        return std::move(result_);
    }

private:
    std::string sentence(const std::string& pointer, const std::string& what) const {
        const TextPosition at = position_of(text_, Pointer(pointer));
        return name_ + ":" + std::to_string(at.line) + ":" + std::to_string(at.column) + ": " +
               (pointer.empty() ? "the document" : printable(pointer)) + " " + what + ".";
    }
    [[noreturn]] void fail(const std::string& pointer, const std::string& what) const {
        throw std::runtime_error(sentence(pointer, what));
    }
    void note(const std::string& pointer, const std::string& what) {
        if (result_.notes.size() < kMaxNotes)
            result_.notes.push_back(sentence(pointer, what));
        else
            ++dropped_notes_;
    }

    /// The value there, and from now on a known one; null if there is none.
    const Json* find(const std::string& place) {
        known_.insert(place);
        const Json* here = &root_;
        std::size_t start = 1;
        while (true) {
            const std::size_t end = place.find('/', start);
            const auto member = here->find(place.substr(start, end - start));
            if (member == here->end()) return nullptr;
            here = &*member;
            if (end == std::string::npos) return here;
            if (!here->is_object())
                fail(place.substr(0, end), "is " + type_of(*here) + "; it must be an object");
            start = end + 1;
        }
    }
    const std::string* find_text(const std::string& place) {
        const Json* json = find(place);
        if (!json) return nullptr;
        if (!json->is_string()) fail(place, "is " + type_of(*json) + "; it must be text");
        return &json->get_ref<const std::string&>();
    }

    void read_head() {
        if (const std::string* name = find_text("/name")) result_.material.name = *name;
        if (const std::string* source = find_text("/source")) result_.material.source = *source;
        static constexpr std::string_view before = "patina-material-";
        const std::string* schema = find_text("/$schema");
        if (!schema || *schema == kPresetSchema) return;
        known_.erase("/$schema");
        const std::size_t at = schema->find(before);
        const long version =
            at == std::string::npos ? 0 : std::strtol(schema->c_str() + at + before.size(), nullptr, 10);
        is_patina_ = version >= 1;
        if (version > kPresetVersion)
            note("/$schema", "says version " + std::to_string(version) + ", this program knows version " +
                                 std::to_string(kPresetVersion) +
                                 "; what it does not know is kept but not shown");
        else if (!is_patina_)
            note("/$schema", "is '" + printable(*schema) + "', not that of a Patina material");
    }

    void read_numbers(const MaterialParam& param) {
        const std::string place = json_place(param);
        const Json* json = find(place);
        if (!json) return;
        const std::span<float> values = values_of(param, result_.material);
        if (param.kind == ParamKind::Scalar) {
            values[0] = number(param, *json, place);
            return;
        }
        if (!json->is_array() || json->size() != values.size())
            fail(place, "is " + type_of(*json) + "; it must be an array of " + std::to_string(values.size()) +
                            " numbers");
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = number(param, (*json)[i], place + "/" + std::to_string(i));
    }
    float number(const MaterialParam& param, const Json& json, const std::string& place) {
        const std::string range =
            "from " + number_text(param.range.min) + " to " + number_text(param.range.max);
        if (!json.is_number()) fail(place, "is " + type_of(json) + "; it must be a number " + range);
        const double value = json.get<double>();
        if (std::abs(value) > static_cast<double>(std::numeric_limits<float>::max()))
            fail(place, "is " + json.dump() + ", too large a number; it must be one " + range);
        const float clamped = std::clamp(static_cast<float>(value), param.range.min, param.range.max);
        if (clamped != static_cast<float>(value))
            note(place, "is " + json.dump() + ", outside " + range + "; taken as " + number_text(clamped));
        return clamped;
    }

    void read_slot(const MaterialSlot& slot) {
        const std::string place = json_place(slot.key);
        const MapRef ref = slot.edit(result_.material);
        if (const std::string* map = find_text(place + "/map")) {
            *ref.map = *map;
            note_odd_map(place + "/map", *map);
        }
        for_each_choice(ref, [&](const auto& choices, auto& value, const char* key) {
            if (const std::string* id = find_text(place + "/" + key)) {
                const auto found = choice_of(choices, lower(*id));
                if (!found)
                    fail(place + "/" + key, "is '" + printable(*id) + "'; it must be " + ids_of(choices));
                value = *found;
            }
        });
        if (!ref.invert) return;
        if (const Json* invert = find(place + "/invert")) {
            if (!invert->is_boolean())
                fail(place + "/invert", "is " + type_of(*invert) + "; it must be true or false");
            *ref.invert = invert->get<bool>();
        }
    }
    template <class Choices>
    static std::string ids_of(const Choices& choices) {
        std::string ids;
        for (const auto& row : choices)
            ids += (ids.empty() ? "" : " or ") + ("'" + std::string(row.id) + "'");
        return ids;
    }
    void note_odd_map(const std::string& place, const std::string& map) {
        if (map.find('\0') != std::string::npos)
            fail(place, "holds a zero, which no file's name does; name a picture");
        if (is_web_address(map))
            note(place, "is the address '" + printable(map) +
                            "', which is never fetched; save the picture beside the preset");
        else if (map.find('\\') != std::string::npos)
            note(place, "is '" + printable(map) + "' with backslashes; they are taken as '/'");
    }

    void keep_unknown() {
        const Json unknown = unknown_part(root_, "");
        if (unknown.empty()) return;
        if (unknown.size() == root_.size() && unknown == root_ && !is_patina_)
            fail("", "has none of the keys of a material preset; it seems to be something else");
        result_.material.unknown_json = in_writing_order(unknown).dump();
    }
    /// As they stand in a saved preset, so that a material read back from one compares equal.
    static Json in_writing_order(const Json& unknown) {
        Json ordered = Json::object();
        const auto take = [&](const std::string& key) {
            if (unknown.contains(key)) ordered[key] = unknown[key];
        };
        take("$schema");
        for (const MaterialParam& param : kMaterialParams)
            take(std::string(param.key.substr(0, param.key.find('.'))));
        for (const auto& item : unknown.items()) take(item.key());
        return ordered;
    }
    /// The members of an object that nobody asked for, at any depth.
    Json unknown_part(const Json& object, const std::string& pointer) {
        Json unknown = Json::object();
        for (const auto& [key, value] : object.items()) {
            const std::string place = pointer_to(pointer, key);
            if (known_.count(place)) continue;
            const auto below = known_.lower_bound(place + "/");
            const bool leads_on = below != known_.end() && below->starts_with(place + "/");
            if (leads_on && value.is_object()) {
                Json rest = unknown_part(value, place);
                if (!rest.empty()) unknown[key] = std::move(rest);
            } else {
                unknown[key] = value;
                if (place != "/$schema")
                    note(place, "is not known to this version; it is kept when the preset is saved");
            }
        }
        return unknown;
    }

    std::string_view text_;
    const std::string& name_;
    Json root_;
    LoadedMaterial result_;
    bool is_patina_ = false;       ///< by its $schema
    std::set<std::string> known_;  ///< pointers that were asked for
    std::set<std::string> noted_;  ///< repeated keys already spoken of
    std::size_t dropped_notes_ = 0;
};

Json numbers_json(const MaterialParam& param, const Material& material) {
    static const Material defaults;
    const auto values = values_of(param, material);
    Json numbers = Json::array();
    for (std::size_t i = 0; i < values.size(); ++i) {
        const float value = std::isfinite(values[i]) ? values[i] : values_of(param, defaults)[i];
        numbers.push_back(shortest(std::clamp(value, param.range.min, param.range.max)));
    }
    return param.kind == ParamKind::Scalar ? numbers[0] : numbers;
}

/// How the map is read is written where there is a map, or where it is not the default.
void write_slot(Json& json, const Material& material, MapSlot slot) {
    static const Material defaults;
    const ConstMapRef ref = map_of(material, slot);
    const ConstMapRef standard = map_of(defaults, slot);
    const bool mapped = !ref.map->empty();
    if (mapped) json["map"] = *ref.map;
    const auto write = [&](const auto& choices, const auto* value, const auto* usual, const char* key) {
        if (value && (mapped || *value != *usual)) json[key] = choice(choices, *value).id;
    };
    write(kColorSpaces, ref.color_space, standard.color_space, "color_space");
    write(kChannels, ref.channel, standard.channel, "channel");
    write(kNormalConventions, ref.convention, standard.convention, "convention");
    if (ref.invert && *ref.invert) json["invert"] = true;
}

/// Adds what is not there yet, at any depth.
void merge(Json& into, const Json& unknown) {
    for (const auto& [key, value] : unknown.items()) {
        if (!into.contains(key))
            into[key] = value;
        else if (into[key].is_object() && value.is_object())
            merge(into[key], value);
    }
}

fs::path folder_of(const fs::path& preset_file) {
    return preset_file.has_parent_path() ? preset_file.parent_path() : fs::path(".");
}

/// Absolute, with the links of its folders followed but not one at its end: a link beside the preset stays a
/// neighbour.
fs::path settled(const fs::path& file) {
    std::error_code failure;
    const fs::path absolute = fs::absolute(file, failure);
    if (failure) return file.lexically_normal();
    const fs::path folder = fs::weakly_canonical(absolute.parent_path(), failure);
    return failure ? absolute.lexically_normal() : folder / absolute.filename();
}

}  // namespace

LoadedMaterial parse_material(std::string_view text, const std::string& name) {
    if (text.size() > kMaxPresetBytes)
        throw std::runtime_error(name + ": the preset is larger than the limit of " +
                                 std::to_string(kMaxPresetBytes >> 20) + " MiB.");
    return Reader(text, name).read();
}

std::string to_json(const Material& material) {
    Json unknown =
        material.unknown_json.empty() ? Json::object() : Json::parse(material.unknown_json, nullptr, false);
    if (!unknown.is_object()) unknown = Json::object();
    Json json;
    json["$schema"] = unknown.contains("$schema") ? unknown["$schema"] : Json(std::string(kPresetSchema));
    json["name"] = material.name;
    if (!material.source.empty()) json["source"] = material.source;
    for (const MaterialParam& param : kMaterialParams) {
        json[Pointer(json_place(param))] = numbers_json(param, material);
        if (param.slot) write_slot(json[Pointer(json_place(param.key))], material, *param.slot);
    }
    merge(json, unknown);
    return to_text(json);
}

LoadedMaterial load_material(const fs::path& file) {
    return parse_material(load_text(file, kMaxPresetBytes), path_to_utf8(file));
}

void save_material(const fs::path& file, const Material& material) { save_text(file, to_json(material)); }

bool is_web_address(std::string_view map) {
    const std::size_t colon = map.find(':');
    if (colon == std::string_view::npos || colon < 2) return false;
    const bool scheme =
        std::all_of(map.begin(), map.begin() + static_cast<std::ptrdiff_t>(colon),
                    [](unsigned char c) { return std::isalnum(c) || c == '+' || c == '-' || c == '.'; });
    const std::string_view rest = map.substr(colon + 1);
    return scheme && (rest.starts_with("//") || lower(map.substr(0, colon)) == "file" ||
                      lower(map.substr(0, colon)) == "data");
}

fs::path resolve_map(const fs::path& preset_file, std::string_view map) {
    if (map.empty() || is_web_address(map)) return {};
    const fs::path folder = folder_of(preset_file);
    fs::path literal = (folder / utf8_to_path(map)).lexically_normal();
    std::error_code failure;
    if (map.find('\\') == std::string_view::npos || fs::exists(literal, failure)) return literal;
    std::string slashes(map);
    std::replace(slashes.begin(), slashes.end(), '\\', '/');
    return (folder / utf8_to_path(slashes)).lexically_normal();
}

std::string relative_map(const fs::path& preset_file, const fs::path& map_file) {
    const fs::path map = settled(map_file);
    if (preset_file.empty()) return path_to_utf8(map);
    const fs::path relative = map.lexically_relative(settled(preset_file).parent_path());
    return path_to_utf8(relative.empty() ? map : relative);
}

Material rebase_maps(Material material, const fs::path& from, const fs::path& to) {
    for (const MaterialSlot& slot : material_slots()) {
        std::string& map = *slot.edit(material).map;
        const fs::path file = resolve_map(from, map);
        if (!file.empty() && utf8_to_path(map).is_relative()) map = relative_map(to, file);
    }
    return material;
}

}  // namespace patina
