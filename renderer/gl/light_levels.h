// Baked light as the GPU samples it: half floats, laid out in the mips and layers of one cube-map array.
// Pure; no GL is called, so it can be made on a worker.
#pragma once

#include "renderer/core/unset_vector.h"
#include "renderer/gl/panorama.h"
#include "renderer/ibl/bake.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace patina {

struct GpuEnvironment;

struct LightLevels {
    struct Cube {
        int size = 0;
        UnsetVector<std::uint16_t> rgba;  ///< six faces of half floats, radiance · 2^−exponent
    };
    std::vector<Cube>
        levels;  ///< level k goes to layer k mod layers of mip k div layers, and has that mip's size
    int layers = 1;
    int levels_exponent = 0, irradiance_exponent = 0;
    Cube irradiance;
    std::vector<float> roughness;  ///< of each level, ascending
    float sharpest = 1.0f;  ///< lobes sharper than this are made up from the panorama; of the first level,
                            ///< if not set otherwise
    std::vector<ExtractedLight> lights;
};

/// All of an environment that goes to the GPU.
struct PreparedLight {
    PanoramaLevels panorama;
    LightLevels levels;
    std::shared_ptr<const GpuEnvironment> panorama_of = {};  ///< whose panorama it is, instead of panorama
};

/// Baked light by reference.
struct LightView {
    std::vector<const PrefilteredLevel*> levels;  ///< ascending roughness
    const CubeMap* irradiance = nullptr;
    std::span<const ExtractedLight> lights;
};
LightView view_of(const BakedEnvironment& baked);

/// Throws std::runtime_error where there is no light to draw with.
LightLevels make_light_levels(const LightView& baked, const ParallelFor& parallel_for = serial_for);
LightLevels make_light_levels(const BakedEnvironment& baked);

/// How levels are laid out in mips of a cube-map array so that each gets at least its own size: the fewest
/// layers with (first size >> k / layers) ≥ sizes[k] for all k.
int layers_for(const std::vector<int>& sizes);

/// Ascending levels with others between wherever two lie further apart than standard ones, mixed from both by
/// the logarithm of roughness: lobes are fitted to that spacing (brdf.glsl, equation 3). No more than the
/// shaders hold (blocks::kMaxLevels), sharp ones first.
std::vector<PrefilteredLevel> close_gaps(std::vector<PrefilteredLevel> levels);

/// The same light on faces of another size, bilinear across edges. Precondition: size ≥ cube.size.
CubeMap enlarged(const CubeMap& cube, int size);

}  // namespace patina
