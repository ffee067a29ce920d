// Light on demand: which prefiltered levels a picture can look up, and whether it looks up the irradiance.
// Pure; bakes nothing and knows no environment.
//
// Rotation, exposure, tone mapping and the sharp background look up nothing that is baked. The irradiance is
// looked up by what is diffuse, by what bounces more than once between microfacets, and by fitted lobes.
#pragma once

#include "materials/material.h"
#include "renderer/core/view.h"
#include "renderer/map_range.h"

#include <vector>

namespace patina {

struct NeededLight {
    std::vector<ValueRange> roughness;  ///< of the levels looked up, each within kSharpestLevel…1
    bool irradiance = false;
    bool operator==(const NeededLight&) const = default;
};

/// Sharper lobes are made of this level's tails and samples of the panorama.
inline constexpr float kSharpestLevel = 0.1f;
/// At or below it a lobe is a mirror's: the share of that level is (r/kSharpestLevel)⁴ ≤ 10⁻⁴.
inline constexpr float kMirrorRoughness = 0.01f;
/// Weights of the irradiance below it are left out: a picture then errs by less than this share of E/π.
inline constexpr float kIgnoredWeight = 1e-3f;

/// maps: of what is bound; slots without are shaded by their value alone.
NeededLight needed_light(const Material& material, const MapRanges& maps, const View& view);
/// All that any material and view can ask for.
NeededLight all_light();
/// What both ask for.
NeededLight combined(const NeededLight& a, const NeededLight& b);

/// The roughness of the levels to bake so that everything needed lies on a level or between two that are as
/// close as the standard ones; none if it does already. held: ascending. Where nothing is held yet, one
/// roughness is baked as it is; otherwise standard levels are added, so that a slider that moves on finds
/// them.
std::vector<float> missing_levels(const NeededLight& needed, const std::vector<float>& held);

}  // namespace patina
