#include "renderer/needed_light.h"

#include "renderer/brdf.h"
#include "renderer/features.h"
#include "renderer/gl/brdf_table.h"
#include "renderer/ibl/bake.h"
#include "renderer/lobes/lobe_table.h"
#include "renderer/uniforms.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

constexpr float kSame = 1e-5f;          ///< relative: roughness that is taken for equal
constexpr float kWidestPitch = 1.168f;  ///< ratio of neighbouring standard levels, 10^(1/15), and rounding

/// 1 − Ess at one roughness, averaged over the sphere as it is seen (cosine-weighted): what bounces more than
/// once. Table texels lie at NoV = s², so 2 NoV dNoV = 4 s³ ds, by trapezia.
double mean_multiple(int row) {
    constexpr int last = kShadingTableSize - 1;
    const std::uint16_t* ab = embedded::brdf_table().data() + std::size_t(row) * kShadingTableSize * 2;
    double sum = 0.0;
    for (int x = 1; x <= last; ++x) {
        const double s = double(x) / last, width = (x < last ? 1.0 : 0.5) / last;
        const double Ess = (double(ab[std::size_t(2) * x]) + double(ab[std::size_t(2) * x + 1])) / 65535.0;
        sum += 4.0 * s * s * s * std::max(1.0 - Ess, 0.0) * width;
    }
    return sum;
}

/// The largest roughness whose multiple scattering may be left out.
float single_scattering_limit() {
    static const float limit = [] {
        int row = 0;
        while (row < kShadingTableSize && mean_multiple(row) < double(kIgnoredWeight)) ++row;
        return (float(row) - 1.0f) / (kShadingTableSize - 1);
    }();
    return limit;
}

/// The reference is drawn as fitted until it is there.
bool is_fitted(const View& view) {
    return view.shading == Shading::Fitted || view.shading == Shading::Reference;
}

/// Levels that lobes of these roughnesses look up, before clamping to those there are.
ValueRange looked_up(const View& view, ValueRange roughness) {
    if (!is_fitted(view))
        return {std::max(roughness.low, kSharpestLevel), std::max(roughness.high, kSharpestLevel)};
    // Falls to kCoreReach · kSharpestLevel and rises again.
    const float from = brdf::tail_roughness(roughness.low, kSharpestLevel);
    const float to = brdf::tail_roughness(roughness.high, kSharpestLevel);
    const float turn = brdf::kCoreReach * kSharpestLevel;
    const float low = roughness.low < turn && roughness.high > turn ? turn : std::min(from, to);
    const float high = std::max(from, to);
    const LobeReach reach = lobe_reach(low, high, view.quality == Quality::High);
    return {low * reach.sharpest, high * reach.widest};
}

/// What the surface's roughness becomes: normals that a pixel averages widen it. Their spread is 1 − alpha of
/// the normal map, squared, and adds to roughness⁴.
ValueRange widened(ValueRange roughness, const Material& material, const MapRanges& maps) {
    const auto& normals = maps[std::size_t(MapSlot::Normal)];
    if (!normals || material.normal.value == 0.0f) return roughness;
    const float deviation = std::max(1.0f - (*normals)[3].low, 0.0f) * std::abs(material.normal.value);
    const float spread = std::min(deviation * deviation, 1.0f);
    if (spread > 0.0f)
        roughness.high = std::min(std::pow(std::pow(roughness.high, 4.0f) + spread, 0.25f), 1.0f);
    return roughness;
}

bool is_black(const ColorSlot& albedo) { return albedo.value == glm::vec3(0.0f); }

bool needs_irradiance(const Material& material, ValueRange metallic, ValueRange roughness, const View& view) {
    const bool diffuse = metallic.low < 1.0f && !is_black(material.albedo);
    const bool fitted = is_fitted(view) && roughness.high > kMirrorRoughness;
    if (fitted && view.debug != DebugView::Diffuse) return true;
    const bool multiple = view.shading != Shading::Course && roughness.high > single_scattering_limit();
    return (diffuse && view.debug != DebugView::Specular) || (multiple && view.debug != DebugView::Diffuse);
}

/// Of held levels, ascending: true if neighbours no further apart than standard ones reach over the range.
bool is_covered(ValueRange range, const std::vector<float>& held) {
    const float low = range.low * (1.0f + kSame), high = range.high * (1.0f - kSame);
    auto next = std::upper_bound(held.begin(), held.end(), low);
    if (next == held.begin()) return false;
    float reached = *std::prev(next);
    for (; reached < high; ++next) {
        if (next == held.end() || *next > reached * kWidestPitch) return false;
        reached = *next;
    }
    return true;
}

bool holds(const std::vector<float>& levels, float roughness) {
    return std::any_of(levels.begin(), levels.end(),
                       [&](float each) { return std::abs(each - roughness) <= kSame * roughness; });
}

/// The standard levels that enclose a range.
std::vector<float> enclosing_levels(ValueRange range) {
    const std::vector<float> standard = standard_roughness_levels();
    auto first = std::upper_bound(standard.begin(), standard.end(), range.low * (1.0f + kSame));
    if (first != standard.begin()) --first;
    auto last = std::lower_bound(first, standard.end(), range.high * (1.0f - kSame));
    if (last != standard.end()) ++last;
    return {first, last};
}

}  // namespace

NeededLight needed_light(const Material& material, const MapRanges& maps, const View& view) {
    NeededLight needed;
    if (view.background == Background::Blurred)
        needed.roughness.push_back({kBackdropRoughness, kBackdropRoughness});
    if (is_data_view(view.debug) || view.debug == DebugView::Emission) return needed;
    const ValueRange metallic = scalar_range(material.metallic, maps[std::size_t(MapSlot::Metallic)]);
    const ValueRange roughness =
        widened(scalar_range(material.roughness, maps[std::size_t(MapSlot::Roughness)]), material, maps);
    needed.irradiance = needs_irradiance(material, metallic, roughness, view);
    if (roughness.high <= kMirrorRoughness || view.debug == DebugView::Diffuse) return needed;
    const ValueRange levels = looked_up(view, roughness);
    needed.roughness.push_back(
        {std::clamp(levels.low, kSharpestLevel, 1.0f), std::clamp(levels.high, kSharpestLevel, 1.0f)});
    return needed;
}

NeededLight all_light() { return {{{kSharpestLevel, 1.0f}}, true}; }

NeededLight combined(const NeededLight& a, const NeededLight& b) {
    NeededLight both = a;
    for (const ValueRange& range : b.roughness)
        if (std::find(both.roughness.begin(), both.roughness.end(), range) == both.roughness.end())
            both.roughness.push_back(range);
    both.irradiance = a.irradiance || b.irradiance;
    return both;
}

std::vector<float> missing_levels(const NeededLight& needed, const std::vector<float>& held) {
    std::vector<float> missing;
    for (const ValueRange& range : needed.roughness) {
        if (is_covered(range, held)) continue;
        const std::vector<float> added =
            range.is_single() && held.empty() ? std::vector<float>{range.low} : enclosing_levels(range);
        for (const float roughness : added)
            if (!holds(held, roughness) && !holds(missing, roughness)) missing.push_back(roughness);
    }
    std::sort(missing.begin(), missing.end());
    return missing;
}

}  // namespace patina
