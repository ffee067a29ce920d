#include "renderer/uniforms.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace patina {
namespace {

using glm::vec2;
using glm::vec3;
using glm::vec4;

/// Where a picture of that size shows the point, in pixels from its lower left corner.
vec2 pixel_of(const blocks::FrameBlock& block, vec3 point, vec2 size) {
    const auto& m = block.view_projection;
    const vec4 clip = m[0] * point.x + m[1] * point.y + m[2] * point.z + m[3];
    return (vec2(clip) / clip.w * 0.5f + 0.5f) * size;
}

/// Radians between the ray through the pixel that shows a point and the way from the eye to the point: the
/// largest of several points.
float largest_angle(const blocks::FrameBlock& block, vec2 size) {
    float largest = 0.0f;
    for (const vec3 point : {vec3(0.0f), vec3(0.9f, 0.2f, -0.3f), vec3(-0.5f, -0.8f, 0.4f)}) {
        const vec2 pixel = pixel_of(block, point, size);
        const vec3 ray =
            vec3(block.ray_corner) + pixel.x * vec3(block.ray_right) + pixel.y * vec3(block.ray_up);
        const vec3 way = point - vec3(block.camera_position);
        EXPECT_GT(glm::dot(ray, way), 0.0f);
        largest = std::max(largest, glm::length(glm::cross(glm::normalize(ray), glm::normalize(way))));
    }
    return largest;
}

constexpr glm::ivec2 kSize{320, 200};
constexpr float kRounding = 32.0f * std::numeric_limits<float>::epsilon();

blocks::FrameBlock block_of(glm::ivec2 whole) {
    const Camera camera{.yaw_deg = 33.0f,
                        .pitch_deg = -21.0f,
                        .distance = 5.0f,
                        .fov_deg = 40.0f,
                        .target = {0.1f, -0.2f, 0.3f}};
    return make_frame_block(camera, View{}, whole, LightLayout{}, 1e4f);
}

TEST(Uniforms, rays_go_where_the_mesh_is_drawn) {
    EXPECT_LT(largest_angle(block_of(kSize), kSize), kRounding);
}

TEST(Uniforms, rays_of_a_moved_picture_do_too) {
    blocks::FrameBlock block = block_of(kSize);
    const vec2 before = pixel_of(block, vec3(0.2f), kSize);
    move_picture(block, {0.4f, -0.3f}, kSize);
    EXPECT_LT(glm::distance(pixel_of(block, vec3(0.2f), kSize), before + vec2(0.4f, -0.3f)), 1e-3f);
    EXPECT_LT(largest_angle(block, kSize), kRounding);
}

TEST(Uniforms, rays_of_a_part_of_a_picture_do_too) {
    const Crop crop{.whole_px = {900, 700}, .at_px = {250, 300}};
    blocks::FrameBlock block = block_of(crop.whole_px);
    const vec2 before = pixel_of(block, vec3(0.2f), crop.whole_px);
    crop_picture(block, crop, kSize);
    EXPECT_LT(glm::distance(pixel_of(block, vec3(0.2f), kSize), before - vec2(crop.at_px)), 1e-3f);
    EXPECT_LT(largest_angle(block, kSize), kRounding);
}

}  // namespace
}  // namespace patina
