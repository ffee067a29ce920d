// Baked light on the GPU: the panorama, the prefiltered levels in one cube-map array and the irradiance.
#pragma once

#include "renderer/gl/handles.h"
#include "renderer/gl/light_levels.h"

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace patina {

struct GpuEnvironment {
    std::shared_ptr<gl::Texture> panorama;  ///< shared by all light made from it
    gl::Texture levels;                     ///< laid out as LightLevels says
    gl::Texture irradiance;
    float panorama_scale = 1.0f;  ///< powers of two that undo how the half floats are stored
    float levels_scale = 1.0f;
    float irradiance_scale = 1.0f;
    float texels_per_radian = 1.0f;  ///< of the panorama
    int layers = 1;
    std::vector<float> roughness;                 ///< of each level, ascending
    float sharpest = 1.0f;                        ///< lobes sharper than this are made up from the panorama
    std::vector<ExtractedLight> lights;           ///< to be shaded: the levels are without them
    std::vector<ExtractedLight> panorama_lights;  ///< those the panorama's alpha holds
};

namespace gl {

/// Light on its way to the GPU, a portion at a time. Always the same light.
class EnvironmentWriter {
public:
    explicit EnvironmentWriter(const PreparedLight& light);
    /// Copies about byte_budget bytes; true when all is there.
    bool step(const PreparedLight& light, std::size_t byte_budget);
    GpuEnvironment take() { return std::move(environment_); }

private:
    std::size_t write_cube(const LightLevels& light);
    std::size_t write_rows(const PanoramaLevels& panorama, std::size_t byte_budget);

    GpuEnvironment environment_;
    std::size_t next_cube_ = 0;  ///< what comes next
    std::size_t level_ = 0;
    int row_ = 0;
};

}  // namespace gl
}  // namespace patina
