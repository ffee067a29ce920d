// Baked light on the GPU: the panorama, the prefiltered levels in one cube-map array and the irradiance.
#pragma once

#include "renderer/gl/handles.h"
#include "renderer/gl/panorama.h"
#include "renderer/ibl/bake.h"

#include <glm/vec4.hpp>

#include <array>
#include <vector>

namespace patina {

struct GpuEnvironment {
    gl::Texture panorama;
    gl::Texture levels;  ///< level k in layer k mod layers, mip k div layers
    gl::Texture irradiance;
    float panorama_scale = 1.0f;  ///< powers of two that undo how the half floats are stored
    float levels_scale = 1.0f;
    float irradiance_scale = 1.0f;
    float texels_per_radian = 1.0f;  ///< of the panorama
    int layers = 1;
    std::vector<float> roughness;  ///< of each level, ascending
    std::vector<ExtractedLight> lights;
};

namespace gl {

GpuEnvironment make_environment_textures(const PanoramaLevels& panorama, const BakedEnvironment& baked);

/// How levels are laid out in mips of a cube-map array so that each gets at least its own size: the fewest
/// layers with (first size >> k / layers) ≥ sizes[k] for all k.
int layers_for(const std::vector<int>& sizes);

/// The same light on faces of another size, bilinear across edges. Precondition: size ≥ cube.size.
CubeMap enlarged(const CubeMap& cube, int size);

}  // namespace gl
}  // namespace patina
