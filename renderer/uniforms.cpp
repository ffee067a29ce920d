#include "renderer/uniforms.h"

#include "renderer/ibl/kernel.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace patina {

namespace {

using glm::vec3;
using glm::vec4;

/// ∫ D·NoL of the backdrop's roughness: what a level's kernel is divided by.
float backdrop_integral() {
    static const double without_pi = ggx_kernel_integral(kBackdropRoughness * kBackdropRoughness);
    return float(without_pi / std::numbers::pi);
}

float exposure_factor(const View& view) { return std::exp2(std::clamp(view.exposure_ev, -64.0f, 64.0f)); }

void set_camera(blocks::FrameBlock& block, const Camera& camera, glm::ivec2 size) {
    const glm::mat4 view = view_matrix(camera);
    const glm::mat4 projection = projection_matrix(camera, float(size.x) / float(size.y));
    const glm::mat4 both = projection * view;
    for (int i = 0; i < 4; ++i) block.view_projection[i] = both[i];
    block.camera_position = vec4(camera_position(camera), 1.0f);
    const glm::mat4 rows = glm::transpose(view);
    const glm::vec2 half_size(1.0f / projection[0][0], 1.0f / projection[1][1]);
    const glm::vec2 pixel = 2.0f * half_size / glm::vec2(size);
    const vec3 right(rows[0]), up(rows[1]), back(rows[2]);
    block.ray_corner = vec4(-back - half_size.x * right - half_size.y * up, pixel.y * pixel.y);
    block.ray_right = vec4(right * pixel.x, 0.0f);
    block.ray_up = vec4(up * pixel.y, kBackdropRoughness);
}

/// The picture's corner is then that place of it.
void move_rays(blocks::FrameBlock& block, glm::vec2 by_px) {
    block.ray_corner += vec4(by_px.x * vec3(block.ray_right) + by_px.y * vec3(block.ray_up), 0.0f);
}

/// Turning the environment by ψ about +Y is looking it up along directions turned back by ψ.
glm::mat3 environment_from_world(float rotation_deg) {
    const float angle = glm::radians(std::fmod(rotation_deg, 360.0f));
    const float c = std::cos(angle);
    const float s = std::sin(angle);
    return {vec3(c, 0.0f, -s), vec3(0.0f, 1.0f, 0.0f), vec3(s, 0.0f, c)};  // rows
}

void set_levels(blocks::FrameBlock& block, const LightLayout& light) {
    const int segments = int(light.roughness.size()) - 1;
    assert(segments >= 0 && segments < blocks::kMaxLevels);
    const auto position = [&](int i) { return std::log2(std::max(light.roughness[i], 1e-4f)); };
    for (int i = 0; i < segments; ++i) {
        const float length = std::max(position(i + 1) - position(i), 1e-6f);
        block.level_slope[i / 4][i % 4] = 1.0f / length;
        block.level_offset[i / 4][i % 4] = -position(i) / length;
    }
    const float sharpest = std::max(light.sharpest, 1e-6f);  // the shader divides by its square
    block.level_ends = vec4(position(0), position(segments), 0.0f, 0.0f);
    block.level_layout = vec4(float(segments), float(light.layers), sharpest, sharpest * sharpest);
}

/// Per slot: the row that picks ±value from the map, and the bias.
void set_scalar(const ScalarSlot& slot, bool mapped, vec4& row, float& bias) {
    row = vec4(0.0f);
    bias = slot.value;
    if (!mapped) return;
    row[int(slot.channel)] = slot.invert ? -slot.value : slot.value;
    bias = slot.invert ? slot.value : 0.0f;
}

}  // namespace

blocks::FrameBlock make_frame_block(const Camera& camera, const View& view, glm::ivec2 size_px,
                                    const LightLayout& light, float largest_radiance) {
    blocks::FrameBlock block{};
    const float exposure = exposure_factor(view);
    set_camera(block, camera, size_px);
    block.camera_position.w = exposure;
    block.ray_right.w = largest_radiance;
    const glm::mat3 rows = environment_from_world(view.env_rotation_deg);
    for (int i = 0; i < 3; ++i) block.env_from_world[i] = vec4(rows[i], 0.0f);
    block.env_scale = vec4(light.panorama_scale * exposure, light.levels_scale * exposure,
                           light.irradiance_scale * exposure, light.texels_per_radian);
    set_levels(block, light);
    const auto& sources = light.lights.empty() ? light.panorama_lights : light.lights;
    const int count = std::min(int(sources.size()), blocks::kMaxLights);
    for (int i = 0; i < count; ++i) {
        const ExtractedLight& source = sources[i];
        const float widening = 0.125f * source.angular_radius_rad * source.angular_radius_rad;
        // glm's columns are these rows, so its product is the transposed one: from environment to world.
        block.light_direction[i] = vec4(rows * source.direction, widening);
        block.light_irradiance[i] = vec4(source.irradiance * exposure, 0.0f);
    }
    block.counts = vec4(light.lights.empty() ? 0.0f : float(count), float(int(view.debug)), float(count),
                        1.0f / backdrop_integral());
    return block;
}

void move_picture(blocks::FrameBlock& block, glm::vec2 offset_px, glm::ivec2 size_px) {
    const glm::vec2 offset = 2.0f * offset_px / glm::vec2(size_px);
    for (vec4& column : block.view_projection) {
        column.x += offset.x * column.w;
        column.y += offset.y * column.w;
    }
    move_rays(block, -offset_px);
}

/// With x the place in the whole picture and y in the part, both −1…1: y = scale x + shift.
void crop_picture(blocks::FrameBlock& block, const Crop& crop, glm::ivec2 size_px) {
    if (crop == Crop{}) return;
    const glm::vec2 scale = glm::vec2(crop.whole_px) / glm::vec2(size_px);
    const glm::vec2 shift = glm::vec2(crop.whole_px - 2 * crop.at_px - size_px) / glm::vec2(size_px);
    for (vec4& column : block.view_projection) {
        column.x = scale.x * column.x + shift.x * column.w;
        column.y = scale.y * column.y + shift.y * column.w;
    }
    move_rays(block, crop.at_px);
}

blocks::MaterialBlock make_material_block(const Material& material, Features features, float exposure) {
    blocks::MaterialBlock block{};
    block.albedo = vec4(material.albedo.value, 1.0f);
    block.emission = vec4(material.emission.value * exposure, 1.0f);
    set_scalar(material.roughness, has(features, Feature::RoughnessMap), block.roughness,
               block.scalar_bias.x);
    set_scalar(material.metallic, has(features, Feature::MetallicMap), block.metallic, block.scalar_bias.y);
    set_scalar(material.ao, has(features, Feature::AoMap), block.ao, block.scalar_bias.z);

    // The picture turns counter-clockwise by θ when it is looked up at coordinates turned back by θ. A normal
    // read from it turns along with it; where an axis is mirrored its slope changes sign.
    const float angle = glm::radians(std::fmod(material.uv.rotation_deg, 360.0f));
    const float c = std::cos(angle);
    const float s = std::sin(angle);
    const glm::vec2 scale = material.uv.scale;
    block.uv_matrix = vec4(c * scale.x, -s * scale.x, s * scale.y, c * scale.y);
    block.uv_offset = vec4(material.uv.offset, 0.0f, 0.0f);
    const glm::vec2 mirror{scale.x < 0.0f ? -1.0f : 1.0f, scale.y < 0.0f ? -1.0f : 1.0f};
    const float strength = material.normal.value;
    const float green = material.normal.convention == NormalConvention::DirectX ? -strength : strength;
    block.normal_x = vec4(mirror.x * c * strength, -mirror.x * s * green, 0.0f, std::abs(strength));
    block.normal_y = vec4(mirror.y * s * strength, mirror.y * c * green, 0.0f, 0.0f);
    return block;
}

}  // namespace patina
