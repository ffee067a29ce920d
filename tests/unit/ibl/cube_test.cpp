#include "tests/unit/ibl/oracle.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace patina {
namespace {

TEST(Cube, solid_angles_sum_to_the_sphere) {
    for (const int size : {1, 2, 7, 64}) {
        double total = 0.0;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) total += 6.0 * cube_texel_solid_angle(size, x, y);
        EXPECT_NEAR(total, 4.0 * std::numbers::pi, 1e-11) << size;
    }
}

TEST(Cube, faces_point_where_opengl_says) {
    const glm::vec3 centres[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (int face = 0; face < 6; ++face)
        EXPECT_NEAR(glm::dot(cube_texel_direction(1, face, 0, 0), centres[face]), 1.0f, 1e-6f);
    // First texel of +X: s = −1, t = −1 means towards +Z and +Y.
    const glm::vec3 corner = cube_texel_direction(64, 0, 0, 0);
    EXPECT_GT(corner.x, 0.5f);
    EXPECT_GT(corner.y, 0.5f);
    EXPECT_GT(corner.z, 0.5f);
    // First texel of +Y: towards −X and −Z.
    const glm::vec3 top = cube_texel_direction(64, 2, 0, 0);
    EXPECT_LT(top.x, -0.5f);
    EXPECT_LT(top.z, -0.5f);
}

TEST(Cube, directions_are_unit) {
    for (int face = 0; face < 6; ++face)
        for (int k = 0; k < 25; ++k)
            EXPECT_NEAR(glm::length(cube_texel_direction(5, face, k % 5, k / 5)), 1.0f, 1e-6f);
}

TEST(RoughnessLevels, are_sixteen_and_close_enough_to_interpolate) {
    const std::vector<float> levels = standard_roughness_levels();
    ASSERT_EQ(levels.size(), 16u);
    EXPECT_FLOAT_EQ(levels.front(), 0.1f);
    EXPECT_EQ(levels.back(), 1.0f);
    for (std::size_t i = 1; i < levels.size(); ++i) {
        EXPECT_GT(levels[i], levels[i - 1]);
        EXPECT_LE(levels[i] / levels[i - 1], 1.17f);
    }
}

}  // namespace
}  // namespace patina
