#include "app/autosave.h"

#include "app/comparison_file.h"
#include "materials/json_text.h"
#include "materials/material_io.h"
#include "materials/text_io.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <exception>

namespace patina {

using Json = nlohmann::ordered_json;

namespace {

constexpr int kRecoveryVersion = 1;

Json view_to_json(const View& view) {
    return {{"env_rotation_deg", view.env_rotation_deg},
            {"exposure_ev", view.exposure_ev},
            {"tonemap", named(kTonemaps, view.tonemap).id},
            {"background", named(kBackgrounds, view.background).id},
            {"plain_color", {view.plain_color.x, view.plain_color.y, view.plain_color.z}},
            {"shading", named(kShadings, view.shading).id},
            {"quality", named(kQualities, view.quality).id},
            {"debug", named(kDebugViews, view.debug).id}};
}

View view_from_json(const Json& json) {
    View view;
    view.env_rotation_deg = json.value("env_rotation_deg", view.env_rotation_deg);
    view.exposure_ev = json.value("exposure_ev", view.exposure_ev);
    view.tonemap = value_of(kTonemaps, json.value("tonemap", std::string{})).value_or(view.tonemap);
    view.background =
        value_of(kBackgrounds, json.value("background", std::string{})).value_or(view.background);
    view.shading = value_of(kShadings, json.value("shading", std::string{})).value_or(view.shading);
    view.quality = value_of(kQualities, json.value("quality", std::string{})).value_or(view.quality);
    view.debug = value_of(kDebugViews, json.value("debug", std::string{})).value_or(view.debug);
    const auto color = json.find("plain_color");
    if (color != json.end() && color->is_array() && color->size() == 3)
        for (int i = 0; i < 3; ++i) view.plain_color[i] = color->at(i).get<float>();
    return view;
}

}  // namespace

std::string to_json(const Recovery& recovery) {
    const Document& document = recovery.document;
    Json json{{"patina_recovery", kRecoveryVersion},
              {"file", path_to_utf8(recovery.file)},
              {"unix_time_s", recovery.unix_time_s},
              {"mesh", document.mesh},
              {"environment", document.environment},
              {"view", view_to_json(document.view)},
              {"material", Json::parse(to_json(document.material))}};
    if (document.sheet) {
        json["sheet_file"] = path_to_utf8(recovery.sheet_file);
        json["sheet"] = Json::parse(to_json(*document.sheet));
    }
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::optional<Recovery> parse_recovery(std::string_view text) {
    try {
        std::vector<std::string> repeated_keys;
        const Json json = parse_json(text, "recovery file", repeated_keys);  // of bounded depth
        if (json.value("patina_recovery", 0) != kRecoveryVersion) return std::nullopt;
        Recovery recovery;
        recovery.file = utf8_to_path(json.value("file", std::string{}));
        recovery.unix_time_s = json.value("unix_time_s", std::int64_t{0});
        recovery.document.mesh = json.value("mesh", recovery.document.mesh);
        recovery.document.environment = json.value("environment", recovery.document.environment);
        recovery.document.view = view_from_json(json.value("view", Json::object()));
        recovery.document.material = parse_material(json.at("material").dump(), "recovery file").material;
        recovery.sheet_file = utf8_to_path(json.value("sheet_file", std::string{}));
        if (json.contains("sheet"))
            recovery.document.sheet = parse_comparison(json.at("sheet").dump(), "recovery file").comparison;
        return recovery;
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

void AutosaveClock::changed(double now_s) {
    if (!first_change_s_) first_change_s_ = now_s;
    last_change_s_ = now_s;
}

void AutosaveClock::written() { first_change_s_.reset(); }

std::optional<double> AutosaveClock::due_in_s(double now_s) const {
    if (!first_change_s_) return std::nullopt;
    const double when = std::min(last_change_s_ + kQuietSeconds, *first_change_s_ + kAtLeastEverySeconds);
    return std::max(0.0, when - now_s);
}

bool AutosaveClock::due(double now_s) const {
    const std::optional<double> wait = due_in_s(now_s);
    return wait && *wait <= 0.0;
}

}  // namespace patina
