#include "app/editor_state.h"
#include "app/reconcile_load.h"
#include "materials/material_io.h"
#include "materials/params.h"
#include "materials/text_io.h"

#include <algorithm>
#include <exception>

namespace patina {

namespace fs = std::filesystem;

namespace {

constexpr float kMetal = 0.5f;

std::string group_of(const Material& material) {
    for (const MaterialSlot& row : material_slots())
        if (!map_of(material, row.slot).map->empty()) return "With maps";
    return material.metallic.value > kMetal ? "Metals" : "Non-metals";
}

std::vector<PresetEntry> list_presets() {
    std::vector<PresetEntry> entries;
    for (const fs::path& file : shipped_presets()) {
        PresetEntry entry{.file = file, .title = path_to_utf8(file.stem())};
        try {
            const Material material = load_material(file).material;
            entry.title = material.name;
            entry.description = material.source;
            entry.group = group_of(material);
        } catch (const std::exception& error) {
            entry.description = error.what();
        }
        entries.push_back(std::move(entry));
    }
    const auto rank = [](const PresetEntry& entry) {
        return entry.group == "With maps" ? 0 : entry.group == "Metals" ? 1 : 2;
    };
    std::stable_sort(entries.begin(), entries.end(), [&](const PresetEntry& a, const PresetEntry& b) {
        return std::pair(rank(a), a.title) < std::pair(rank(b), b.title);
    });
    return entries;
}

void add_opened(std::vector<ui::CatalogItem>& items, const std::vector<std::string>& opened,
                const std::string& current) {
    std::vector<std::string> files = opened;
    const auto known = [&](const std::string& id) {
        return std::any_of(items.begin(), items.end(),
                           [&](const ui::CatalogItem& item) { return item.id == id; });
    };
    if (!current.empty() && std::find(files.begin(), files.end(), current) == files.end())
        files.insert(files.begin(), current);
    for (const std::string& file : files)
        if (!known(file))
            items.push_back({.id = file,
                             .title = path_to_utf8(utf8_to_path(file).stem()),
                             .description = file,
                             .group = "Opened"});
}

}  // namespace

void read_presets(Editor& editor) {
    editor.jobs.start("", [&editor](JobContext&) -> Jobs::Done {
        return [&editor, presets = list_presets()] {
            editor.presets = presets;
            fill_catalog(editor);
        };
    });
}

void fill_catalog(Editor& editor) {
    ui::Catalog& catalog = editor.catalog;
    catalog = {.presets_are_read = editor.presets.has_value(), .recent = editor.settings.recent};
    for (const PresetEntry& preset : editor.presets.value_or(std::vector<PresetEntry>{}))
        catalog.presets.push_back({.id = path_to_utf8(preset.file),
                                   .title = preset.title,
                                   .description = preset.description,
                                   .group = preset.group});
    add_opened(catalog.presets, editor.settings.recent, path_to_utf8(editor.file.path));
    for (const EnvironmentSource& source : editor.registry.environments)
        for (const EnvironmentItem& item : source.list())
            catalog.environments.push_back({.id = item.id,
                                            .title = item.title,
                                            .description = item.description,
                                            .group = source.name == "built-in" ? "Built-in" : source.name});
    add_opened(catalog.environments, editor.settings.opened_environments, editor.document.environment);
    for (const MeshPart& part : editor.registry.meshes)
        catalog.meshes.push_back(
            {.id = part.id, .title = part.title, .description = part.description, .group = "Built-in"});
    add_opened(catalog.meshes, editor.settings.opened_meshes, editor.document.mesh);
    ++editor.changes;
}

}  // namespace patina
