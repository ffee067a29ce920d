// The fitted lobes of renderer/shaders/brdf.glsl, equation (3), as plain numbers. Knows no GL and no
// environment.
//
// A table of nodes over (√NoV, log roughness), end-inclusive, as patina_fit_lobes wrote it (fitted_lobes.inc;
// lobes.glsl reads it bilinearly): node (i, j) lies at NoV = (i/15)², roughness = 0.1 · 10^(j/15).
#pragma once

#include <glm/vec2.hpp>

#include <array>
#include <span>

namespace patina {

/// How the prefiltered levels are swept.
struct LobeSweep {
    float log2_ratio = 0.0f;  ///< log₂(ρ/r): the middle's roughness over the surface's
    float kappa = 0.0f;       ///< κ: in the middle, direction R + κ · alpha · (N − R)
    float slope = 0.0f;       ///< λ: what a level adds to κ
    float irradiance = 0.0f;  ///< w_E, 0…1
    glm::vec2 lean{0.0f};     ///< a₁, a₂; of four levels
};

/// For one F0.
struct LobeNode {
    LobeSweep two;   ///< over two levels
    LobeSweep four;  ///< over four
};

struct LobePair {
    std::array<LobeNode, 2> by_reflectance;  ///< F0 = 1, F0 = 0.04
};

inline constexpr int kLobeTableSize = 16;

/// kLobeTableSize² nodes, √NoV fastest.
std::span<const LobePair> lobe_nodes();

/// Bilinear in the table, linear in φ (brdf.glsl, equation 4), as the shader reads it. NoV in 0…1, roughness
/// in 0…1 and taken for kSharpestFitted where it is less.
LobeNode lobe_at(std::span<const LobePair> nodes, float NoV, float roughness, float phi);

/// What one of the swept levels adds.
struct SweptLevel {
    int level = 0;        ///< index; of levels beyond the ends too
    float weight = 0.0f;  ///< of the sweep's, which sum to 1 − irradiance
    float kappa = 0.0f;
};
/// Equation (3) around a continuous index of levels; of two levels, the first and the last have no weight.
std::array<SweptLevel, 4> swept_levels(const LobeSweep& sweep, float level, bool four);

/// Bounds of the swept levels' roughness over the surface's, for surfaces between two roughnesses, where
/// levels are no further apart than standard ones.
struct LobeReach {
    float sharpest = 1.0f;
    float widest = 1.0f;
};
LobeReach lobe_reach(float lowest_roughness, float highest_roughness, bool four_levels);

}  // namespace patina
