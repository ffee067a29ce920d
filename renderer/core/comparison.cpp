#include "renderer/core/comparison.h"

#include "renderer/core/angles.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace patina {

std::vector<ViewPlace> places_of(const Comparison& comparison) {
    std::vector<ViewPlace> places;
    for (int row = 0; row < int(comparison.rows.size()); ++row)
        for (int column = 0; column < int(comparison.columns.size()); ++column)
            places.push_back({.row = row, .column = column});
    for (int free = 0; free < int(comparison.views.size()); ++free) places.push_back({.free = free});
    return places;
}

const ComparedPreset& preset_at(const Comparison& comparison, ViewPlace place) {
    return place.free >= 0 ? comparison.views[std::size_t(place.free)].preset
                           : comparison.rows[std::size_t(place.row)];
}
const Lighting& lighting_at(const Comparison& comparison, ViewPlace place) {
    return place.free >= 0 ? comparison.views[std::size_t(place.free)].lighting
                           : comparison.columns[std::size_t(place.column)];
}
ComparedPreset& preset_at(Comparison& comparison, ViewPlace place) {
    return const_cast<ComparedPreset&>(preset_at(std::as_const(comparison), place));
}
Lighting& lighting_at(Comparison& comparison, ViewPlace place) {
    return const_cast<Lighting&>(lighting_at(std::as_const(comparison), place));
}

View view_of(const Comparison& comparison, const Lighting& lighting) {
    return {.env_rotation_deg = lighting.rotation_deg,
            .exposure_ev = lighting.exposure_ev,
            .tonemap = lighting.tonemap,
            .background = lighting.background,
            .plain_color = lighting.plain_color,
            .shading = lighting.shading.value_or(comparison.shading),
            .quality = comparison.quality};
}

const Camera& camera_of(const Comparison& comparison, const Lighting& lighting) {
    return lighting.camera ? *lighting.camera : comparison.camera;
}

Lighting lighting_of(const View& view, const std::string& environment) {
    return {.environment = environment,
            .rotation_deg = view.env_rotation_deg,
            .exposure_ev = view.exposure_ev,
            .tonemap = view.tonemap,
            .background = view.background,
            .plain_color = view.plain_color};
}

Comparison first_comparison(const Lighting& light, const std::string& mesh, const Camera& camera) {
    Comparison comparison{.mesh = mesh, .camera = camera};
    comparison.rows = {ComparedPreset{}};
    Lighting other = light;
    other.environment = light.environment == "sunset" ? "studio" : "sunset";
    other.title.clear();
    other.photo.reset();
    comparison.columns = {light, other};
    return comparison;
}

Comparison with_column_after(Comparison comparison, int column, Lighting light) {
    const auto at = std::clamp<std::ptrdiff_t>(column + 1, 0, std::ptrdiff_t(comparison.columns.size()));
    comparison.columns.insert(comparison.columns.begin() + at, std::move(light));
    if (comparison.rows.empty()) comparison.rows.emplace_back();
    return comparison;
}

Comparison with_row_after(Comparison comparison, int row, ComparedPreset preset) {
    const auto at = std::clamp<std::ptrdiff_t>(row + 1, 0, std::ptrdiff_t(comparison.rows.size()));
    comparison.rows.insert(comparison.rows.begin() + at, std::move(preset));
    if (comparison.columns.empty()) comparison.columns.emplace_back();
    return comparison;
}

Comparison with_duplicate(Comparison comparison, ViewPlace place) {
    const FreeView copy{preset_at(comparison, place), lighting_at(comparison, place)};
    const auto at = place.free >= 0 ? place.free + 1 : int(comparison.views.size());
    comparison.views.insert(comparison.views.begin() + at, copy);
    return comparison;
}

Comparison without(Comparison comparison, ViewPlace place) {
    if (places_of(comparison).size() <= 1) return comparison;
    if (place.free >= 0) {
        comparison.views.erase(comparison.views.begin() + place.free);
    } else if (comparison.columns.size() > 1) {
        comparison.columns.erase(comparison.columns.begin() + place.column);
    } else {
        comparison.rows.erase(comparison.rows.begin() + place.row);
        if (comparison.rows.empty()) comparison.columns.clear();
    }
    return comparison;
}

Comparison with_turned_light(Comparison comparison, std::optional<ViewPlace> place, float degrees) {
    const auto turn = [&](Lighting& light) {
        light.rotation_deg = wrap_degrees(light.rotation_deg + degrees);
    };
    if (place) {
        turn(lighting_at(comparison, *place));
        return comparison;
    }
    for (Lighting& light : comparison.columns) turn(light);
    for (FreeView& view : comparison.views) turn(view.lighting);
    return comparison;
}

int grid_columns(std::size_t cells, float region_aspect, float cell_aspect) {
    const auto count = int(std::max<std::size_t>(cells, 1));
    int best = 1;
    float best_size = 0.0f;
    for (int columns = 1; columns <= count; ++columns) {
        const int rows = (count + columns - 1) / columns;
        // A cell's width where the region is 1 high: bound by the region's width, or by its height.
        const float size = std::min(region_aspect / float(columns), cell_aspect / float(rows));
        if (size <= best_size * 1.0001f) continue;
        best_size = size;
        best = columns;
    }
    return best;
}

namespace {
const char* describe_photo(const Photo& before, const Photo& after) {
    if (before.fit != after.fit) return "Photo fit";
    if (before.exposure_ev != after.exposure_ev || before.white_balance != after.white_balance)
        return "Photo balance";
    if (before.region != after.region) return "Region";
    return "Photo";
}

const char* describe_lighting(const Lighting& before, const Lighting& after) {
    if (before.environment != after.environment) return "Environment";
    if (before.rotation_deg != after.rotation_deg) return "Light rotation";
    if (before.exposure_ev != after.exposure_ev) return "Exposure";
    if (before.tonemap != after.tonemap) return "Tone mapping";
    if (before.photo != after.photo)
        return before.photo && after.photo ? describe_photo(*before.photo, *after.photo) : "Photo";
    if (before.title != after.title) return "Title";
    if (before.camera != after.camera) return "Camera";
    if (before.shading != after.shading) return "Shading";
    return "Background";
}
}  // namespace

std::string describe_comparison_change(const Comparison& before, const Comparison& after) {
    if (before == after) return {};
    if (before.columns.size() != after.columns.size()) return "Lightings";
    if (before.rows.size() != after.rows.size()) return "Presets";
    if (before.views.size() != after.views.size()) return "Views";
    for (std::size_t i = 0; i < after.columns.size(); ++i)
        if (before.columns[i] != after.columns[i])
            return describe_lighting(before.columns[i], after.columns[i]);
    for (std::size_t i = 0; i < after.views.size(); ++i) {
        if (before.views[i].lighting != after.views[i].lighting)
            return describe_lighting(before.views[i].lighting, after.views[i].lighting);
        if (before.views[i] != after.views[i]) return "Preset of a view";
    }
    if (before.rows != after.rows) return "Preset of a row";
    return "Comparison";
}

}  // namespace patina
