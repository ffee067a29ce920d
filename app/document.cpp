#include "app/document.h"

#include "materials/material_io.h"
#include "materials/params.h"
#include "materials/text_io.h"

#include <algorithm>
#include <vector>

namespace patina {

namespace fs = std::filesystem;

namespace {

/// Text that names no file (none, a web address) stays as it is.
std::string full_path(const std::string& map, const fs::path& preset) {
    const fs::path path = resolve_map(preset, map);
    if (path.empty()) return map;
    std::error_code ignored;
    const fs::path absolute = fs::absolute(path, ignored);
    return path_to_utf8((absolute.empty() ? path : absolute).lexically_normal());
}

std::string preset_path(const std::string& map, const fs::path& preset, const std::string& before) {
    if (map.empty() || is_web_address(map)) return map;
    if (!before.empty() && full_path(before, preset) == map) return before;
    return relative_map(preset, utf8_to_path(map));
}

bool same_slot(const Material& a, const Material& b, MapSlot slot) {
    const ConstMapRef before = map_of(a, slot), after = map_of(b, slot);
    const auto same = [](const auto* x, const auto* y) { return !x || !y || *x == *y; };
    return same(before.map, after.map) && same(before.color_space, after.color_space) &&
           same(before.channel, after.channel) && same(before.invert, after.invert) &&
           same(before.convention, after.convention);
}

void describe_material(const Material& before, const Material& after, std::vector<std::string>& changes) {
    if (before.name != after.name) changes.emplace_back("Name");
    for (const MaterialParam& param : kMaterialParams) {
        const auto a = values_of(param, before), b = values_of(param, after);
        if (!std::equal(a.begin(), a.end(), b.begin(), b.end())) changes.emplace_back(param.label);
    }
    for (const MaterialSlot& row : material_slots())
        if (!same_slot(before, after, row.slot)) changes.push_back(std::string(row.label) + " map");
    if (changes.empty() && before != after) changes.emplace_back("Material");
}

}  // namespace

bool is_dirty(const Document& document, const DocumentFile& file) { return document.material != file.saved; }

std::string document_title(const Document& document, const DocumentFile& file) {
    const std::string& name = document.material.name;
    if (!name.empty() && name != Material{}.name) return name;
    return file.path.empty() ? Material{}.name : path_to_utf8(file.path.stem());
}

Material with_full_map_paths(const Material& as_written, const fs::path& preset) {
    Material material = as_written;
    for (const MaterialSlot& row : material_slots()) {
        std::string& map = *row.edit(material).map;
        map = full_path(map, preset);
    }
    return material;
}

Material with_preset_map_paths(const Material& material, const fs::path& preset, const Material& before) {
    Material written = material;
    for (const MaterialSlot& row : material_slots()) {
        std::string& map = *row.edit(written).map;
        map = preset_path(map, preset, *map_of(before, row.slot).map);
    }
    return written;
}

std::string describe_change(const Document& before, const Document& after) {
    std::vector<std::string> changes;
    describe_material(before.material, after.material, changes);
    if (before.mesh != after.mesh) changes.emplace_back("Mesh");
    if (before.environment != after.environment) changes.emplace_back("Environment");
    const View &a = before.view, &b = after.view;
    if (a.env_rotation_deg != b.env_rotation_deg) changes.emplace_back("Light rotation");
    if (a.exposure_ev != b.exposure_ev) changes.emplace_back("Exposure");
    if (a.tonemap != b.tonemap) changes.emplace_back("Tone mapping");
    if (a.background != b.background || a.plain_color != b.plain_color) changes.emplace_back("Background");
    if (a.quality != b.quality) changes.emplace_back("Quality");
    if (a.shading != b.shading) changes.emplace_back("Shading");
    if (a.debug != b.debug) changes.emplace_back("View mode");
    if (before.sheet.has_value() != after.sheet.has_value()) changes.emplace_back("Comparison");
    if (before.sheet && after.sheet && before.sheet != after.sheet)
        changes.push_back(describe_comparison_change(*before.sheet, *after.sheet));
    if (changes.empty()) return before == after ? std::string{} : "View";
    if (changes.size() <= 2) return changes.size() == 1 ? changes[0] : changes[0] + ", " + changes[1];
    return std::to_string(changes.size()) + " values";
}

}  // namespace patina
