// From plain values to the uniform rows the shaders read. Pure; no GL.
#pragma once

#include "materials/material.h"
#include "renderer/core/camera.h"
#include "renderer/core/crop.h"
#include "renderer/core/view.h"
#include "renderer/features.h"
#include "renderer/ibl/bake.h"
#include "renderer/shaders/blocks.h"

#include <glm/vec2.hpp>

#include <vector>

namespace patina {

/// Roughness at which the environment is shown out of focus.
inline constexpr float kBackdropRoughness = 0.35f;

/// What the frame's rows need to know of the light's textures; scales undo how they are stored.
struct LightLayout {
    float panorama_scale = 1.0f;
    float levels_scale = 1.0f;
    float irradiance_scale = 1.0f;
    float texels_per_radian = 1.0f;
    int layers = 1;
    std::vector<float> roughness{1.0f};  ///< of the levels, ascending, 1 … blocks::kMaxLevels of them
    float sharpest = 1.0f;               ///< lobes sharper than this are made up from the panorama
    std::vector<ExtractedLight> lights;  ///< shaded as lights
    std::vector<ExtractedLight> panorama_lights;  ///< kept apart by the panorama
};

blocks::FrameBlock make_frame_block(const Camera& camera, const View& view, glm::ivec2 size_px,
                                    const LightLayout& light, float largest_radiance);

/// In a picture of size_px everything is seen so many pixels further to the right and up.
void move_picture(blocks::FrameBlock& block, glm::vec2 offset_px, glm::ivec2 size_px);

/// Of the picture only that part is seen, in a picture of size_px.
void crop_picture(blocks::FrameBlock& block, const Crop& crop, glm::ivec2 size_px);

/// features: which maps are read. exposure: factor on what the surface emits.
blocks::MaterialBlock make_material_block(const Material& material, Features features, float exposure);

}  // namespace patina
