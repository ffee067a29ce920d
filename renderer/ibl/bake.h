// Image-based light, baked: from an environment to prefiltered GGX levels, irradiance and the BRDF table.
// Pure functions; know no GL, no file, no thread.
//
// A level of roughness r holds, for each direction N, ∫ L(l) K(N·l) dl with the kernel D(h)·(N·l) at N = V =
// R, normalised to 1 (Karis 2013), alpha = r². Irradiance holds E(N)/π. Cube faces follow OpenGL's order and
// orientation.
#pragma once

#include "renderer/core/environment.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace patina {

/// Runs body(0) … body(count − 1) in any order, perhaps at once, and returns when all are done.
using ParallelFor = std::function<void(int count, const std::function<void(int)>& body)>;
/// One after the other on the calling thread.
void serial_for(int count, const std::function<void(int)>& body);

/// Six faces of size × size texels: +X −X +Y −Y +Z −Z, each row 0 first as glTexImage2D takes it.
struct CubeMap {
    int size = 0;
    std::vector<glm::vec3> texels;  ///< 6 · size · size
};
/// Unit direction through the centre of a texel, and the exact solid angle of a texel (sums to 4π over the
/// cube).
glm::vec3 cube_texel_direction(int size, int face, int x, int y);
double cube_texel_solid_angle(int size, int x, int y);

struct PrefilteredLevel {
    float roughness = 0.0f;
    CubeMap cube;
};

/// A compact bright source taken out of the map, shaded analytically instead.
struct ExtractedLight {
    glm::vec3 direction{0.0f, 1.0f, 0.0f};  ///< unit, towards the light, in the environment's frame
    glm::vec3 irradiance{0.0f};             ///< on a surface that faces it
    float angular_radius_rad = 0.0f;  ///< R of the uniform disc with the same mean-square radius ½R²; shade
                                      ///< it with the lobe widened to alpha'² = alpha² + R²/8
};

/// Wall-clock milliseconds of a bake's stages; 0 for what was not needed. Not part of the result's identity.
struct BakeTimings {
    double transform_ms = 0.0;  ///< what all levels share
    double levels_ms = 0.0;
    double irradiance_ms = 0.0;
    double lights_ms = 0.0;
};

struct BakedEnvironment {
    std::vector<PrefilteredLevel> levels;  ///< ascending roughness, in the source's radiance units
    CubeMap irradiance;                    ///< E/π; empty where it was not asked for
    std::vector<ExtractedLight> lights;    ///< empty where none was taken out
    std::vector<std::string> notes;
    BakeTimings timings;  ///< not stored by the cache
};

/// The roughness values the renderer interpolates between: geometric from 0.1 to 1.
std::vector<float> standard_roughness_levels();

/// Part of the cache key: raised whenever bake_environment's output changes.
inline constexpr int kBakerVersion = 7;

struct BakeSettings {
    std::vector<float> roughness =
        standard_roughness_levels();  ///< ascending, each in 0…1; exactly these are baked
    int max_face_size = 256;          ///< no level is larger; smooth levels are smaller
    std::vector<int> face_sizes;      ///< of each level, instead; empty: chosen by roughness
    bool extract_lights = false;      ///< compact bright sources leave the map for BakedEnvironment::lights,
                                      ///< which the renderer must then shade; otherwise levels hold all light
    bool irradiance = true;
    bool operator==(const BakeSettings&) const = default;
};

/// How a long computation runs: threads, progress 0…1 (called from any thread, monotone), cancellation.
struct BakeControl {
    ParallelFor parallel_for = serial_for;
    std::function<void(float)> progress = [](float) {};
    std::stop_token stop;
};

/// nullopt only when stopped. Precondition: environment not empty. Same input, same bits, whatever
/// parallel_for does. Roughness 0 is the environment itself on cube faces.
std::optional<BakedEnvironment> bake_environment(const Environment& environment, const BakeSettings& settings,
                                                 const BakeControl& control);

/// The same levels and irradiance in a few hundredths of the time, for a first picture: the environment
/// reduced to 128 × 64 texels (of a large picture only some rows are read), degrees to 32, faces of 32². Good
/// where the roughness is above ½, blurred where it is below. Lights are taken out where the settings say so,
/// each as large as a texel of that.
std::optional<BakedEnvironment> bake_first_light(const Environment& environment, const BakeSettings& settings,
                                                 const BakeControl& control);

/// Split-sum scale A and bias B of F0·A + B with GGX and height-correlated Smith: ab[y · size + x] at
/// NoV = ((x + ½)/size)², roughness = (y + ½)/size. A + B ≤ 1.
struct BrdfTable {
    int size = 0;
    std::vector<glm::vec2> ab;
};
inline constexpr int kBrdfTableSize = 128;
BrdfTable bake_brdf_table(int size = kBrdfTableSize, const ParallelFor& parallel_for = serial_for);

}  // namespace patina
