// The fitted lobes of renderer/shaders/brdf.glsl, equation (3), as plain numbers. Knows no GL and no
// environment.
//
// A table of nodes over (√NoV, roughness), end-inclusive, as patina_fit_lobes wrote it (fitted_lobes.inc;
// lobes.glsl reads it bilinearly): node (i, j) lies at NoV = (i/15)², roughness = 0.1 + 0.9 j/15.
#pragma once

#include <array>
#include <span>

namespace patina {

/// A look into the prefiltered light.
struct LobeTap {
    float kappa = 0.0f;       ///< direction R + kappa · alpha · (N − R)
    float log2_ratio = 0.0f;  ///< log₂ of the level's roughness over the surface's
};

/// For one F0; weights are fractions, the first tap takes what the others leave.
struct LobeNode {
    LobeTap one;
    float one_irradiance = 0.0f;
    std::array<LobeTap, 3> three;
    float second_weight = 0.0f;
    float third_weight = 0.0f;
    float three_irradiance = 0.0f;
};

struct LobePair {
    std::array<LobeNode, 2> by_reflectance;  ///< F0 = 1, F0 = 0.04
};

inline constexpr int kLobeTableSize = 16;

/// kLobeTableSize² nodes, √NoV fastest.
std::span<const LobePair> lobe_nodes();

/// Bilinear in the table, linear in φ (brdf.glsl, equation 4), as the shader reads it. NoV and roughness in
/// 0…1.
LobeNode lobe_at(std::span<const LobePair> nodes, float NoV, float roughness, float phi);

/// Bounds of the levels' roughness over the surface's, for surfaces between two roughnesses.
struct LobeReach {
    float sharpest = 1.0f;
    float widest = 1.0f;
};
LobeReach lobe_reach(float lowest_roughness, float highest_roughness, bool three_taps);

}  // namespace patina
