#include "app/drive.h"
#include "materials/params.h"
#include "materials/text_io.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace patina {

namespace {

constexpr double kTolerance = 1e-3;

std::string text_of(double value) {
    std::ostringstream text;
    text.precision(9);
    text << value;
    return text.str();
}

const char* text_of(ui::MapState state) {
    switch (state) {
        case ui::MapState::None:
            return "none";
        case ui::MapState::Loading:
            return "loading";
        case ui::MapState::Ok:
            return "ok";
        case ui::MapState::Missing:
            return "missing";
        case ui::MapState::Broken:
            return "broken";
    }
    return "";
}

std::optional<std::string> material_value(const Editor& editor, const std::string& key) {
    const Material& material = editor.document.material;
    if (const MaterialParam* param = find_param(key)) {
        std::string text;
        for (const float value : values_of(*param, material))
            text += (text.empty() ? "" : ",") + text_of(value);
        return text;
    }
    for (const MaterialSlot& row : material_slots()) {
        const std::string slot(row.key);
        const ConstMapRef map = map_of(material, row.slot);
        if (key == slot + ".map") return *map.map;
        if (key == slot + ".state") return text_of(editor.reconciler.maps()[int(row.slot)].state);
        if (key == slot + ".channel" && map.channel) return std::string(choice(kChannels, *map.channel).id);
        if (key == slot + ".invert" && map.invert) return *map.invert ? "true" : "false";
        if (key == slot + ".convention" && map.convention)
            return std::string(choice(kNormalConventions, *map.convention).id);
    }
    return std::nullopt;
}

std::string log_text(const ui::Status& status) {
    std::string text;
    for (const ui::LogLine& line : status.log) text += line.text + "\n";
    return text;
}

/// Of the photo in the sheet's selected view.
std::string photo_value(const DriveView& view, float Photo::*member) {
    const auto& sheet = view.editor.document.sheet;
    if (!sheet) return "none";
    const std::vector<ViewPlace> places = places_of(*sheet);
    const auto selected = std::size_t(view.editor.ui.sheet_selected);
    if (selected >= places.size() || !lighting_at(*sheet, places[selected]).photo) return "none";
    const Photo& photo = *lighting_at(*sheet, places[selected]).photo;
    return text_of(photo.*member);
}

/// Of the camera that looks into each view.
std::string sheet_yaws(const DriveView& view) {
    std::string text;
    if (!view.editor.document.sheet) return text;
    for (std::size_t i = 0; i < places_of(*view.editor.document.sheet).size(); ++i)
        text += (i > 0 ? "," : "") + text_of(double(camera_of_sheet(view.editor, i).yaw_deg));
    return text;
}

/// As each view is shaded.
std::string sheet_shadings(const DriveView& view) {
    std::string text;
    if (!view.editor.document.sheet) return text;
    for (std::size_t i = 0; i < places_of(*view.editor.document.sheet).size(); ++i)
        text += (i > 0 ? "," : "") + std::string(named(kShadings, view_of_sheet(view.editor, i).shading).id);
    return text;
}

/// The first hint of the selected view; empty: none, or not known yet.
std::string photo_hint(const DriveView& view) {
    const auto& hints = view.editor.photos.views[std::size_t(view.editor.ui.sheet_selected)].hints;
    return hints && !hints->empty() ? hints->front() : "";
}

/// Linear radiance, then display values; "none".
std::string probe_text(const std::optional<ui::PixelValue>& value) {
    if (!value) return "none";
    std::string text;
    for (int c = 0; c < 3; ++c) text += text_of(value->radiance[c]) + ",";
    for (int c = 0; c < 3; ++c) text += std::to_string(value->display[c]) + (c < 2 ? "," : "");
    return text;
}

using Value = std::string (*)(const DriveView&);
struct NamedValue {
    const char* key;
    Value value;
};
constexpr std::array kValues{
    NamedValue{"title", [](const DriveView& v) { return v.editor.status.title; }},
    NamedValue{"file", [](const DriveView& v) { return path_to_utf8(v.editor.file.path); }},
    NamedValue{"name", [](const DriveView& v) { return v.editor.document.material.name; }},
    NamedValue{"status", [](const DriveView& v) { return v.editor.status.text; }},
    NamedValue{"log", [](const DriveView& v) { return log_text(v.editor.status); }},
    NamedValue{"environment", [](const DriveView& v) { return v.editor.document.environment; }},
    NamedValue{"mesh", [](const DriveView& v) { return v.editor.document.mesh; }},
    NamedValue{"exposure", [](const DriveView& v) { return text_of(v.editor.document.view.exposure_ev); }},
    NamedValue{"rotation",
               [](const DriveView& v) { return text_of(v.editor.document.view.env_rotation_deg); }},
    NamedValue{
        "shading",
        [](const DriveView& v) { return std::string(named(kShadings, v.editor.document.view.shading).id); }},
    NamedValue{
        "quality",
        [](const DriveView& v) { return std::string(named(kQualities, v.editor.document.view.quality).id); }},
    NamedValue{
        "tonemap",
        [](const DriveView& v) { return std::string(named(kTonemaps, v.editor.document.view.tonemap).id); }},
    NamedValue{
        "debug",
        [](const DriveView& v) { return std::string(named(kDebugViews, v.editor.document.view.debug).id); }},
    NamedValue{"yaw", [](const DriveView& v) { return text_of(v.editor.camera.yaw_deg); }},
    NamedValue{"pitch", [](const DriveView& v) { return text_of(v.editor.camera.pitch_deg); }},
    NamedValue{"distance", [](const DriveView& v) { return text_of(v.editor.camera.distance); }},
    NamedValue{"triangles",
               [](const DriveView& v) { return std::to_string(v.editor.reconciler.mesh_info().triangles); }},
    NamedValue{"import",
               [](const DriveView& v) {
                   return std::to_string(v.editor.import_sheet ? v.editor.import_sheet->rows.size() : 0);
               }},
    NamedValue{"unsaved", [](const DriveView& v) { return std::string(v.editor.unsaved ? "asked" : "no"); }},
    NamedValue{"recovery",
               [](const DriveView& v) { return std::string(v.editor.recovery_question ? "asked" : "no"); }},
    NamedValue{"undo", [](const DriveView& v) { return v.editor.status.undo_what; }},
    NamedValue{"redo", [](const DriveView& v) { return v.editor.status.redo_what; }},
    NamedValue{"sheet_views",
               [](const DriveView& v) {
                   const auto& sheet = v.editor.document.sheet;
                   return std::to_string(sheet ? places_of(*sheet).size() : 0);
               }},
    NamedValue{"sheet_selected",
               [](const DriveView& v) { return std::to_string(v.editor.ui.sheet_selected + 1); }},
    NamedValue{"photo_exposure", [](const DriveView& v) { return photo_value(v, &Photo::exposure_ev); }},
    NamedValue{"photo_opacity", [](const DriveView& v) { return photo_value(v, &Photo::opacity); }},
    NamedValue{"photo_delta_e",
               [](const DriveView& v) {
                   return text_of(
                       v.editor.photos.views[std::size_t(v.editor.ui.sheet_selected)].residual.delta_e);
               }},
    NamedValue{"probe_first", [](const DriveView& v) { return probe_text(v.editor.probe.first); }},
    NamedValue{"probe_second", [](const DriveView& v) { return probe_text(v.editor.probe.second); }},
    NamedValue{"sheet_file", [](const DriveView& v) { return path_to_utf8(sheet_file(v.editor).path); }},
    NamedValue{"sheet_unsaved",
               [](const DriveView& v) { return std::string(sheet_unsaved(v.editor) ? "yes" : "no"); }},
    NamedValue{"sheet_yaws", sheet_yaws},
    NamedValue{"photo_hint", photo_hint},
    NamedValue{"sheet_shadings", sheet_shadings},
    NamedValue{"sheet_rotations",
               [](const DriveView& v) {
                   std::string text;
                   if (v.editor.document.sheet)
                       for (const Lighting& light : v.editor.document.sheet->columns)
                           text += (text.empty() ? "" : ",") + text_of(light.rotation_deg);
                   return text;
               }},
    NamedValue{"frames", [](const DriveView& v) { return std::to_string(v.frames); }},
    NamedValue{"views", [](const DriveView& v) { return std::to_string(v.views); }},
    NamedValue{"turns", [](const DriveView& v) { return std::to_string(v.turns); }},
    NamedValue{"cpu_ms", [](const DriveView& v) { return text_of(v.cpu_ms); }},
    NamedValue{"longest_turn_ms", [](const DriveView& v) { return text_of(v.turn_ms); }},
    NamedValue{
        "lights_baked",
        [](const DriveView& v) { return std::to_string(v.editor.reconciler.counts().environments_baked); }},
    NamedValue{"pending",
               [](const DriveView& v) { return std::string(v.editor.reconciler.pending() ? "yes" : "no"); }},
    NamedValue{"lights_from_disk",
               [](const DriveView& v) {
                   return std::to_string(v.editor.reconciler.counts().environments_from_disk);
               }},
    NamedValue{"lights_from_memory",
               [](const DriveView& v) {
                   return std::to_string(v.editor.reconciler.counts().environments_from_memory);
               }},
    NamedValue{"maps_loaded",
               [](const DriveView& v) { return std::to_string(v.editor.reconciler.counts().maps_loaded); }},
    NamedValue{
        "maps_from_memory",
        [](const DriveView& v) { return std::to_string(v.editor.reconciler.counts().maps_from_memory); }},
    NamedValue{"meshes_loaded",
               [](const DriveView& v) { return std::to_string(v.editor.reconciler.counts().meshes_loaded); }},
};

std::optional<double> number(const std::string& text) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    return !text.empty() && *end == '\0' ? std::optional(value) : std::nullopt;
}

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
    return parts;
}

/// Lists of numbers within the tolerance, everything else to the letter.
bool equal(const std::string& a, const std::string& b) {
    if (a == b) return true;
    const auto left = split(a), right = split(b);
    if (left.size() != right.size()) return false;
    for (std::size_t i = 0; i < left.size(); ++i) {
        const auto x = number(left[i]), y = number(right[i]);
        if (!x || !y || std::abs(*x - *y) > kTolerance) return false;
    }
    return !left.empty();
}

bool holds(const std::string& value, const std::string& operation, const std::string& wanted) {
    if (operation == "~") return value.find(wanted) != std::string::npos;
    if (operation == "!~") return value.find(wanted) == std::string::npos;
    if (operation == "=") return equal(value, wanted);
    if (operation == "!=") return !equal(value, wanted);
    const auto x = number(value), y = number(wanted);
    if (!x || !y) return false;
    if (operation == "<") return *x < *y;
    if (operation == "<=") return *x <= *y;
    if (operation == ">") return *x > *y;
    return *x >= *y;
}

}  // namespace

std::optional<std::string> drive_value(const DriveView& view, const std::string& key) {
    for (const NamedValue& row : kValues)
        if (key == row.key) return row.value(view);
    return material_value(view.editor, key);
}

std::string drive_mismatch(const DriveView& view, const std::vector<std::string>& words) {
    if (words.empty()) return "an expectation is missing";
    const std::string& first = words[0];
    if (first == "dirty" || first == "clean") {
        const bool dirty = is_dirty(view.editor.document, view.editor.file);
        return dirty == (first == "dirty") ? ""
               : dirty                     ? "the document has unsaved changes"
                                           : "nothing is unsaved";
    }
    if (first == "item" && words.size() == 2)
        return view.items.find(words[1]) ? "" : "there is no item '" + words[1] + "'";
    if (first == "no" && words.size() == 3 && words[1] == "item")
        return view.items.find(words[2]) ? "there is an item '" + words[2] + "'" : "";
    const std::size_t at = first.find_first_of("=<>~!");
    if (words.size() != 1 || at == std::string::npos) return "'" + first + "' is no expectation";
    const std::size_t after = first.find_first_not_of("=<>~!", at);
    const std::string key = first.substr(0, at);
    const std::string operation = first.substr(at, after == std::string::npos ? after : after - at);
    const std::string wanted = after == std::string::npos ? "" : first.substr(after);
    const std::optional<std::string> value = drive_value(view, key);
    if (!value) return "there is no value '" + key + "'";
    return holds(*value, operation, wanted)
               ? ""
               : key + " is '" + *value + "', not " + operation + " '" + wanted + "'";
}

}  // namespace patina
