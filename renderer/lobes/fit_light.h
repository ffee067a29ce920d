// Environments as the fit and its judge see them: many at once, one luminance each in a lane, so that one
// look serves all. Holds what the renderer would read (levels, irradiance) and what the truth is summed from.
// Knows no file.
#pragma once

#include "renderer/ibl/bake.h"

#include <array>
#include <vector>

namespace patina::lobes {

inline constexpr int kLanes = 16;
using Lanes = std::array<float, kLanes>;

inline void add_scaled(Lanes& sum, const Lanes& x, float weight) {
    for (int i = 0; i < kLanes; ++i) sum[i] += weight * x[i];
}

/// Faces with a border of one texel of their neighbours: bilinear without seams.
struct LaneCube {
    int size = 0;
    std::vector<Lanes> texels;  ///< six faces of (size + 2)²

    explicit LaneCube(int face_size);
    std::size_t at(int face, int x, int y) const {
        return (std::size_t(face) * (size + 2) + (y + 1)) * (size + 2) + (x + 1);
    }
    void fill_border();
    /// sum += weight · bilinear; direction of any length.
    void add_to(Lanes& sum, glm::vec3 direction, float weight) const;
};

/// A light's texel, split: where it lies and how much it sends.
struct LightSample {
    glm::vec3 direction{0.0f};
    float irradiance = 0.0f;  ///< luminance
};

/// One environment's lights.
struct FitLights {
    std::vector<ExtractedLight> lights;
    std::vector<LightSample> samples;  ///< all that was taken out, for the truth
};

struct FitLight {
    int count = 0;                     ///< environments; further lanes hold zeros
    std::vector<LaneCube> levels;      ///< the standard ones, without lights
    std::vector<LaneCube> irradiance;  ///< one: E/π, likewise
    std::vector<LaneCube> pyramid;     ///< the environments without lights, each level half the last
    std::vector<FitLights> lights;     ///< count of them

    /// sum += weight · the light of one level; of the first or the last where there is none of that index.
    void add_level(Lanes& sum, glm::vec3 direction, int level, float weight) const;
    /// sum += weight · the levels' light, mixed linearly in log roughness as light.glsl does.
    void add_prefiltered(Lanes& sum, glm::vec3 direction, float log2_roughness, float weight) const;
    /// Where a roughness lies among the levels, as level_index in light.glsl has it: 0 at 0.1, 15 at 1.
    static float level_index(float log2_roughness);
    /// sum += weight · the environment averaged over about a solid angle.
    void add_filtered(Lanes& sum, glm::vec3 direction, double solid_angle, float weight) const;
};

/// At most kLanes environments, each scaled to a mean luminance of 1. source_size: faces of the pyramid's
/// first level.
FitLight make_fit_light(const std::vector<Environment>& environments, int source_size);

}  // namespace patina::lobes
