#include "app/editor_sheet.h"

#include "app/comparison_file.h"
#include "app/editor_state.h"
#include "app/paths.h"
#include "materials/material_io.h"
#include "materials/text_io.h"

#include <algorithm>
#include <exception>

namespace patina {

namespace fs = std::filesystem;

namespace {

/// The selected view's place; nullopt without a sheet.
std::optional<ViewPlace> selected_place(const Editor& editor) {
    if (!editor.document.sheet) return std::nullopt;
    const std::vector<ViewPlace> places = places_of(*editor.document.sheet);
    if (places.empty()) return std::nullopt;
    return places[std::min(std::size_t(std::max(editor.ui.sheet_selected, 0)), places.size() - 1)];
}

const SheetPreset& sheet_preset(Editor& editor, const std::string& name) {
    const auto found = editor.sheet.presets.find(name);
    if (found != editor.sheet.presets.end()) return found->second;
    SheetPreset preset;
    try {
        if (name != "-") {
            const fs::path file = find_preset(name);
            preset.material = with_full_map_paths(load_material(file).material, file);
        }
    } catch (const std::exception& error) {
        preset.error = error.what();
        log_line(editor, ui::Severity::Error, error.what());
    }
    return editor.sheet.presets.emplace(name, std::move(preset)).first->second;
}

void start_sheet(Editor& editor, Comparison comparison, const fs::path& file) {
    SheetFile& opened = editor.sheet.files[int(editor.sheet.files.size()) + 1];
    editor.document.sheet_opened = int(editor.sheet.files.size());
    opened = {file, comparison};
    editor.camera = comparison.camera;
    editor.ui.sheet_selected = 0;
    editor.ui.sheet_enlarged = -1;
    editor.document.sheet = std::move(comparison);
    ++editor.changes;
}

}  // namespace

ViewBinding bind_view(const Editor& editor) {
    const Document& document = editor.document;
    const std::optional<ViewPlace> place = selected_place(editor);
    if (!place) return {-1, document.view, editor.camera, document.environment, document.mesh};
    const Lighting& light = lighting_at(*document.sheet, *place);
    View view = view_of(*document.sheet, light);
    view.debug = document.view.debug;
    return {editor.ui.sheet_selected, view, light.camera.value_or(editor.camera), light.environment,
            document.sheet->mesh};
}

void take_binding(Editor& editor, const ViewBinding& before, const ViewBinding& after, bool all_lights) {
    Document& document = editor.document;
    if (before.selected < 0 || !document.sheet) {
        document.view = after.view;
        editor.camera = after.camera;
        document.environment = after.environment;
        document.mesh = after.mesh;
        return;
    }
    Comparison& sheet = *document.sheet;
    const std::vector<ViewPlace> places = places_of(sheet);
    if (std::size_t(before.selected) >= places.size()) return;
    const ViewPlace place = places[std::size_t(before.selected)];
    const float turned = after.view.env_rotation_deg - before.view.env_rotation_deg;
    if (turned != 0.0f)
        sheet = with_turned_light(std::move(sheet), all_lights ? std::nullopt : std::optional(place), turned);
    Lighting& light = lighting_at(sheet, place);
    if (after.camera != before.camera) (light.camera ? *light.camera : editor.camera) = after.camera;
    light.environment = after.environment;
    light.exposure_ev = after.view.exposure_ev;
    light.tonemap = after.view.tonemap;
    light.background = after.view.background;
    light.plain_color = after.view.plain_color;
    if (after.environment != before.environment) light.title.clear();
    if (is_reference(after.view) && !is_reference(before.view))
        say_status(editor, "The reference gathers one view at a time; go back to the one view for it.");
    else if (after.view.shading != before.view.shading)
        (light.shading ? *light.shading : sheet.shading) = after.view.shading;
    sheet.quality = after.view.quality;
    sheet.mesh = after.mesh;
    document.view.debug = after.view.debug;
}

std::vector<WantedPicture> wanted_pictures(Editor& editor) {
    std::vector<WantedPicture> pictures;
    if (!editor.document.sheet) return pictures;
    const Comparison& sheet = *editor.document.sheet;
    for (const ViewPlace place : places_of(sheet)) {
        if (pictures.size() == kMaxFurtherPictures) break;
        const std::string& preset = preset_at(sheet, place).preset;
        const Material& material =
            preset == kEditedPreset ? editor.document.material : sheet_preset(editor, preset).material;
        View view = view_of(sheet, lighting_at(sheet, place));
        view.debug = editor.document.view.debug;
        pictures.push_back({material, sheet.mesh, lighting_at(sheet, place).environment, view});
    }
    const auto selected = std::size_t(std::max(editor.ui.sheet_selected, 0));
    if (selected < pictures.size() && hints_wanted(editor))
        pictures[selected].roughness_trials = kRoughnessTrials;
    return pictures;
}

const Camera& camera_of_sheet(const Editor& editor, std::size_t view) {
    const Lighting& light = lighting_at(*editor.document.sheet, places_of(*editor.document.sheet)[view]);
    return light.camera ? *light.camera : editor.camera;
}

View view_of_sheet(const Editor& editor, std::size_t view) {
    const Comparison& sheet = *editor.document.sheet;
    View result = view_of(sheet, lighting_at(sheet, places_of(sheet)[view]));
    result.debug = editor.document.view.debug;
    return result;
}

const SheetFile& sheet_file(const Editor& editor) {
    static const SheetFile none;
    const auto found = editor.sheet.files.find(editor.document.sheet_opened);
    return found != editor.sheet.files.end() ? found->second : none;
}

void show_sheet(Editor& editor, bool shown) {
    ++editor.changes;
    if (!shown) {
        editor.sheet.put_away = std::exchange(editor.document.sheet, std::nullopt);
        return;
    }
    if (editor.document.sheet) return;
    editor.ui.right_tab = "sheet";
    if (editor.sheet.put_away) {
        editor.document.sheet = std::exchange(editor.sheet.put_away, std::nullopt);
        return;
    }
    const Document& document = editor.document;
    start_sheet(
        editor,
        first_comparison(lighting_of(document.view, document.environment), document.mesh, editor.camera), {});
    say_status(editor, "The edited material under two lights; choose others in the library.");
}

void open_sheet(Editor& editor, const std::string& file) {
    try {
        std::error_code ignored;
        const fs::path path = fs::absolute(utf8_to_path(file), ignored).lexically_normal();
        LoadedComparison loaded = load_comparison(path);
        for (const std::string& note : loaded.notes) log_line(editor, ui::Severity::Warning, note);
        const std::size_t views = places_of(loaded.comparison).size();
        editor.sheet.presets.clear();
        if (sheet_unsaved(editor))
            log_line(editor, ui::Severity::Warning,
                     "The comparison before it was not saved; Undo brings it back.");
        start_sheet(editor, std::move(loaded.comparison), path);
        editor.ui.right_tab = "sheet";
        log_line(editor, ui::Severity::Info, "Opened " + path_to_utf8(path.filename()) + ".");
        if (views > kMaxFurtherPictures)
            log_line(editor, ui::Severity::Warning,
                     "The first " + std::to_string(kMaxFurtherPictures) + " of " + std::to_string(views) +
                         " views are shown; patina compare draws them all.");
    } catch (const std::exception& error) {
        log_line(editor, ui::Severity::Error, error.what());
    }
}

bool save_sheet_as(Editor& editor, const std::string& chosen) {
    if (!editor.document.sheet) return false;
    try {
        fs::path file = utf8_to_path(chosen);
        if (file.extension() != ".json") file += ".json";
        std::error_code ignored;
        file = fs::absolute(file, ignored).lexically_normal();
        Comparison comparison = *editor.document.sheet;
        comparison.camera = editor.camera;
        save_comparison(file, comparison);
        editor.document.sheet->camera = editor.camera;
        editor.sheet.files[editor.document.sheet_opened] = {file, editor.document.sheet};
        log_line(editor, ui::Severity::Info, "Saved " + path_to_utf8(file.filename()) + ".");
    } catch (const std::exception& error) {
        log_line(editor, ui::Severity::Error, error.what());
        editor.waiting.reset();
        return false;
    }
    if (editor.waiting) carry_on(editor);
    return true;
}

void save_sheet(Editor& editor) {
    if (!editor.document.sheet && editor.sheet.put_away) show_sheet(editor, true);
    if (!editor.document.sheet) return;
    if (sheet_file(editor).path.empty()) return open_browser(editor, ui::BrowserPurpose::SaveComparison);
    save_sheet_as(editor, path_to_utf8(sheet_file(editor).path));
}

bool set_sheet_preset(Editor& editor, const std::string& file) {
    const std::optional<ViewPlace> place = selected_place(editor);
    if (!place) return false;
    ComparedPreset& preset = preset_at(*editor.document.sheet, *place);
    if (preset.preset == kEditedPreset) return false;
    preset.preset = file;
    preset.title.clear();
    editor.sheet.presets.erase(file);  // read it anew: it may have changed
    return true;
}

void set_light(Editor& editor, const std::string& environment) {
    const std::optional<ViewPlace> place = selected_place(editor);
    (place ? lighting_at(*editor.document.sheet, *place).environment : editor.document.environment) =
        environment;
}

void set_mesh(Editor& editor, const std::string& mesh) {
    (editor.document.sheet ? editor.document.sheet->mesh : editor.document.mesh) = mesh;
}

const std::optional<Comparison>& current_sheet(const Editor& editor) {
    return editor.document.sheet ? editor.document.sheet : editor.sheet.put_away;
}

bool sheet_unsaved(const Editor& editor) {
    const std::optional<Comparison>& sheet = current_sheet(editor);
    return sheet && sheet != sheet_file(editor).saved;
}

std::string sheet_name(const Editor& editor) {
    const std::optional<Comparison>& sheet = current_sheet(editor);
    if (sheet && !sheet->title.empty()) return sheet->title;
    const fs::path& file = sheet_file(editor).path;
    return file.empty() ? "Comparison" : path_to_utf8(file.stem());
}

void restore_sheet(Editor& editor, Comparison comparison, const fs::path& file) {
    start_sheet(editor, std::move(comparison), file);
    std::optional<Comparison>& saved = editor.sheet.files[editor.document.sheet_opened].saved;
    saved.reset();
    std::error_code ignored;
    if (file.empty() || !fs::exists(file, ignored)) return;
    try {
        saved = load_comparison(file).comparison;
    } catch (const std::exception& error) {
        log_line(editor, ui::Severity::Warning, error.what());
    }
}

}  // namespace patina
