#include "renderer/core/camera.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace patina {
namespace {

glm::vec3 project(const Camera& camera, glm::vec3 point, float aspect = 1.0f) {
    const glm::vec4 clip = projection_matrix(camera, aspect) * view_matrix(camera) * glm::vec4(point, 1.0f);
    return glm::vec3(clip) / clip.w;
}

constexpr std::array kYaws{-170.0f, -90.0f, 0.0f, 33.0f, 90.0f, 180.0f};
constexpr std::array kPitches{-89.9f, -30.0f, 0.0f, 45.0f, 89.9f};

TEST(Camera, default_stands_on_the_positive_z_axis) {
    EXPECT_EQ(camera_position({}), glm::vec3(0.0f, 0.0f, 4.5f));
}

TEST(Camera, default_shows_x_to_the_right_and_y_up_with_z_towards_the_eye) {
    EXPECT_GT(project({}, {0.5f, 0.0f, 0.0f}).x, 0.1f);
    EXPECT_GT(project({}, {0.0f, 0.5f, 0.0f}).y, 0.1f);
    EXPECT_LT(project({}, {0.0f, 0.0f, 0.9f}).z, project({}, {0.0f, 0.0f, -0.9f}).z);
}

TEST(Camera, position_follows_the_formula_of_yaw_and_pitch) {
    const glm::vec3 side = camera_position({.yaw_deg = 90.0f});
    EXPECT_NEAR(side.x, 4.5f, 1e-5f);
    EXPECT_NEAR(side.z, 0.0f, 1e-5f);
    const glm::vec3 above =
        camera_position({.pitch_deg = 30.0f, .distance = 2.0f, .target = {1.0f, 2.0f, 3.0f}});
    EXPECT_NEAR(above.x, 1.0f, 1e-5f);
    EXPECT_NEAR(above.y, 3.0f, 1e-5f);
    EXPECT_NEAR(above.z, 3.0f + 2.0f * std::sqrt(0.75f), 1e-5f);
}

TEST(Camera, target_is_in_the_middle_and_the_view_is_a_rigid_motion) {
    for (const float yaw : kYaws)
        for (const float pitch : kPitches) {
            const Camera camera{.yaw_deg = yaw, .pitch_deg = pitch, .target = {0.3f, -0.2f, 0.1f}};
            const glm::mat4 view = view_matrix(camera);
            const glm::vec3 seen = view * glm::vec4(camera.target, 1.0f);
            EXPECT_NEAR(glm::length(seen - glm::vec3(0.0f, 0.0f, -4.5f)), 0.0f, 1e-5f);
            EXPECT_NEAR(glm::determinant(glm::mat3(view)), 1.0f, 1e-5f);
            const glm::vec3 eye = view * glm::vec4(camera_position(camera), 1.0f);
            EXPECT_NEAR(glm::length(eye), 0.0f, 1e-5f);
            EXPECT_GT(view[1][1], 0.0f) << "+Y points up";
        }
}

TEST(Camera, vertical_field_of_view_is_what_it_says_for_every_aspect) {
    const Camera camera{.distance = 2.0f, .fov_deg = 90.0f};
    for (const float aspect : {0.5f, 1.0f, 3.0f}) {
        EXPECT_NEAR(project(camera, {0.0f, 2.0f, 0.0f}, aspect).y, 1.0f, 1e-5f);
        EXPECT_NEAR(project(camera, {2.0f * aspect, 0.0f, 0.0f}, aspect).x, 1.0f, 1e-5f);
    }
}

TEST(Camera, clip_planes_hold_the_unit_sphere_and_the_quads_corners_at_every_distance) {
    for (const float distance : {0.01f, 1.2f, 2.0f, 4.5f, 50.0f, 1e4f}) {
        const Camera camera{.yaw_deg = 20.0f, .pitch_deg = 40.0f, .distance = distance};
        const glm::vec3 eye = camera_position(camera);
        for (const glm::vec3 point : {glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(1, 1, 0),
                                      glm::vec3(-1, -1, 0), glm::vec3(0, 0, 1), glm::vec3(0, 0, -1)}) {
            const glm::vec3 seen = view_matrix(camera) * glm::vec4(point, 1.0f);
            if (seen.z > -0.02f * glm::length(eye)) continue;  // behind the eye or at it
            const float depth = project(camera, point).z;
            EXPECT_GT(depth, -1.0f) << distance;
            EXPECT_LT(depth, 1.0f) << distance;
        }
    }
}

TEST(Camera, matrices_stay_finite_for_senseless_distances) {
    for (const float distance : {0.0f, -1.0f, 1e-20f, 1e20f}) {
        const Camera camera{.distance = distance};
        const glm::mat4 all = projection_matrix(camera, 1.5f) * view_matrix(camera);
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r) EXPECT_TRUE(std::isfinite(all[c][r])) << distance;
    }
}

TEST(Camera, fitted_to_a_narrow_picture_shows_as_much_across_as_a_square_one) {
    const Camera camera{.fov_deg = 40.0f};
    EXPECT_EQ(fitted_to(camera, 1.5f), camera);
    const glm::vec4 edge{0.9f, 0.0f, 0.0f, 1.0f};
    const auto across = [&](const Camera& seen, float aspect) {
        const glm::vec4 clip = projection_matrix(seen, aspect) * view_matrix(seen) * edge;
        return clip.x / clip.w;
    };
    EXPECT_NEAR(across(fitted_to(camera, 0.5f), 0.5f), across(camera, 1.0f), 1e-5f);
}

}  // namespace
}  // namespace patina
