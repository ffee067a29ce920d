#include "app/editor_state.h"
#include "app/reconcile_load.h"
#include "materials/map_naming.h"
#include "materials/params.h"
#include "materials/text_io.h"
#include "renderer/core/image_io.h"

#include <algorithm>
#include <exception>

namespace patina {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kFilesInFolder = 500;  ///< a dropped home folder is a slip of the hand

std::string extension_of(const fs::path& file) {
    std::string extension = path_to_utf8(file.extension());
    if (!extension.empty()) extension.erase(0, 1);
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    return extension;
}

template <class Part>
bool reads(const std::vector<Part>& parts, const fs::path& file) {
    const std::string extension = extension_of(file);
    return std::any_of(parts.begin(), parts.end(), [&](const Part& part) {
        return std::find(part.extensions.begin(), part.extensions.end(), extension) != part.extensions.end();
    });
}

/// Radiance files are light. An OpenEXR file is light where it is twice as wide as high and not named like a
/// map.
bool is_environment(const fs::path& file) {
    const std::string extension = extension_of(file);
    if (extension == "hdr" || extension == "pic") return true;
    if (extension != "exr") return false;
    const std::vector<std::string> names{path_to_utf8(file)};
    const ImportProposal proposal = propose_import(names);
    if (!proposal.rows.empty() && proposal.rows[0].confidence >= Confidence::Likely) return false;
    try {
        const ImageInfo info = load_image_info(file);
        return info.width == 2 * info.height;
    } catch (const std::exception&) {
        return false;  // whoever loads it says what is wrong
    }
}

/// What lies in a folder and one level below it, as scans are packed.
std::vector<std::string> files_in(const fs::path& folder) {
    std::vector<std::string> files;
    std::error_code failure;
    fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, failure);
    for (const fs::recursive_directory_iterator end; !failure && entry != end; entry.increment(failure)) {
        std::error_code ignored;
        if (entry->is_directory(ignored) && entry.depth() >= 1) entry.disable_recursion_pending();
        if (entry->is_regular_file(ignored)) files.push_back(path_to_utf8(entry->path()));
        if (files.size() >= kFilesInFolder) break;
    }
    std::sort(files.begin(), files.end());
    return files;
}

struct Sorted {
    std::vector<std::string> presets, meshes, environments, maps, other;
};

void sort_file(const Registry& registry, const std::string& name, Sorted& sorted) {
    const fs::path file = utf8_to_path(name);
    if (extension_of(file) == "json")
        sorted.presets.push_back(name);
    else if (reads(registry.mesh_importers, file))
        sorted.meshes.push_back(name);
    else if (is_environment(file))
        sorted.environments.push_back(name);
    else if (reads(registry.image_importers, file))
        sorted.maps.push_back(name);
    else
        sorted.other.push_back(name);
}

ui::ImportRow to_ui(const patina::ImportRow& row) {
    return {.file = row.file,
            .name = short_name(row.file),
            .slot = row.slot,
            .channel = row.channel,
            .invert = row.invert,
            .color_space = row.color_space,
            .convention = row.convention,
            .reason = row.reason};
}

void offer_sheet(Editor& editor, const Sorted& sorted) {
    const ImportProposal proposal = propose_import(sorted.maps);
    ui::ImportSheet sheet{.title = proposal.name};
    for (const patina::ImportRow& row : proposal.rows) sheet.rows.push_back(to_ui(row));
    const auto offer = [&](const std::vector<std::string>& files, std::string& only, const char* note) {
        if (files.size() == 1) only = files[0];
        for (std::size_t i = 0; files.size() > 1 && i < files.size(); ++i)
            sheet.notes.push_back(short_name(files[i]) + note);
    };
    offer(sorted.meshes, sheet.mesh, " is a mesh; drop it by itself to put the material on it.");
    offer(sorted.environments, sheet.environment, " is an environment; drop it by itself to light by it.");
    for (const std::string& preset : sorted.presets)
        sheet.notes.push_back(short_name(preset) + " is not a picture; drop it by itself to open it.");
    if (!sorted.other.empty())
        sheet.notes.push_back(std::to_string(sorted.other.size()) +
                              (sorted.other.size() == 1 ? " other file is" : " other files are") +
                              " left out.");
    editor.import_sheet = std::move(sheet);
    ++editor.changes;
}

}  // namespace

void propose_maps(Editor& editor, const std::vector<std::string>& files) {
    Sorted sorted;
    for (const std::string& name : files) {
        std::error_code ignored;
        const bool folder = fs::is_directory(utf8_to_path(name), ignored);
        const std::vector<std::string> inside = folder ? files_in(utf8_to_path(name)) : std::vector{name};
        for (const std::string& file : inside) sort_file(editor.registry, file, sorted);
    }
    if (!sorted.maps.empty()) return offer_sheet(editor, sorted);
    const std::size_t meshes = sorted.meshes.size(), lights = sorted.environments.size();
    if (meshes == 1 && lights == 0) return use_mesh(editor, sorted.meshes[0]);
    if (meshes == 0 && lights == 1) return use_environment(editor, sorted.environments[0]);
    log_line(editor, ui::Severity::Warning,
             (files.size() == 1 ? short_name(files[0]) : std::string("What was dropped")) +
                 " holds no pictures that could be maps.");
}

void take_dropped(Editor& editor, const ui::request::Dropped& dropped) {
    Sorted sorted;
    bool folders = false;
    for (const std::string& name : dropped.files) {
        std::error_code ignored;
        if (fs::is_directory(utf8_to_path(name), ignored)) {
            folders = true;
            continue;
        }
        sort_file(editor.registry, name, sorted);
    }
    if (dropped.slot && dropped.files.size() == 1 && sorted.maps.size() + sorted.environments.size() == 1)
        return assign_map(editor, *dropped.slot, dropped.files[0]);
    if (dropped.view && editor.document.sheet && sorted.maps.size() == 1 && dropped.files.size() == 1) {
        editor.ui.sheet_selected = *dropped.view;
        editor.ui.right_tab = "sheet";
        set_photo(editor, *dropped.view, sorted.maps[0]);
        return say_status(editor, short_name(sorted.maps[0]) + " is held against this view now.");
    }
    if (folders || !sorted.maps.empty()) return propose_maps(editor, dropped.files);
    if (!sorted.meshes.empty()) use_mesh(editor, sorted.meshes.back());
    if (!sorted.environments.empty()) use_environment(editor, sorted.environments.back());
    if (!sorted.presets.empty()) ask_open(editor, sorted.presets.back());
    for (const std::string& name : sorted.other)
        log_line(editor, ui::Severity::Warning,
                 short_name(name) + " is neither a preset, a picture, a mesh nor an environment.");
}

void apply_import_sheet(Editor& editor) {
    if (!editor.import_sheet) return;
    const ui::ImportSheet sheet = *std::exchange(editor.import_sheet, std::nullopt);
    ImportProposal proposal{.name = sheet.title};
    int used = 0;
    for (const ui::ImportRow& row : sheet.rows) {
        proposal.rows.push_back({.file = row.file,
                                 .slot = row.slot,
                                 .fits = row.slot,
                                 .channel = row.channel,
                                 .invert = row.invert,
                                 .color_space = row.color_space,
                                 .convention = row.convention,
                                 .confidence = Confidence::Sure,
                                 .reason = row.reason});
        used += row.slot.has_value();
    }
    proposal.clear_other_maps = used > 1;
    editor.document.material = apply_import(editor.document.material, proposal);
    if (sheet.rename_material && !sheet.title.empty()) {
        editor.document.material.name = sheet.title;
        editor.document.material.source.clear();  // it spoke of the values that were here before
    }
    if (sheet.use_mesh && !sheet.mesh.empty()) use_mesh(editor, sheet.mesh);
    if (sheet.use_environment && !sheet.environment.empty()) use_environment(editor, sheet.environment);
    log_line(editor, ui::Severity::Info,
             "Imported " + std::to_string(used) + (used == 1 ? " map." : " maps."));
}

void assign_map(Editor& editor, MapSlot slot, const std::string& file) {
    const std::vector<std::string> files{file};
    const ImportProposal proposal = propose_import(files);
    Material& material = editor.document.material;
    // The artist has chosen the slot; the name may still say how the file is to be read there.
    patina::ImportRow row{.file = file, .slot = slot};
    for (const patina::ImportRow& named : proposal.rows)
        if (named.fits == slot) row = named;
    row.slot = slot;
    if (row.fits != slot && slot == MapSlot::Emission && material.emission.value == glm::vec3(0.0f))
        material.emission.value = glm::vec3(1.0f);
    const std::string name = material.name;
    material = apply_import(material, {.rows = {row}});
    material.name = name;
    log_line(editor, ui::Severity::Info,
             short_name(file) + " is the " + std::string(slot_row(slot).label) + " map now.");
}

void locate_map(Editor& editor, MapSlot slot, const std::string& file) {
    const std::string old = *map_of(editor.document.material, slot).map;
    const fs::path old_folder = utf8_to_path(old).parent_path(),
                   new_folder = utf8_to_path(file).parent_path();
    int found = 0;
    for (const MaterialSlot& row : material_slots()) {
        std::string& map = *row.edit(editor.document.material).map;
        std::error_code ignored;
        if (row.slot == slot || (!old.empty() && map == old)) {
            map = file;
            ++found;
        } else if (const fs::path path = utf8_to_path(map);
                   !map.empty() && path.parent_path() == old_folder && !fs::exists(path, ignored) &&
                   fs::exists(new_folder / path.filename(), ignored)) {
            map = path_to_utf8(new_folder / path.filename());
            ++found;
        }
    }
    log_line(editor, ui::Severity::Info,
             "Located " + short_name(file) +
                 (found > 1 ? " and " + std::to_string(found - 1) + " more beside it." : "."));
}

void use_environment(Editor& editor, const std::string& file) {
    set_light(editor, file);
    remember(editor.settings.opened_environments, file);
    fill_catalog(editor);
}

void use_mesh(Editor& editor, const std::string& file) {
    set_mesh(editor, file);
    remember(editor.settings.opened_meshes, file);
    fill_catalog(editor);
}

}  // namespace patina
