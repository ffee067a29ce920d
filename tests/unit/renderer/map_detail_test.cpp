#include "renderer/map_detail.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <numbers>
#include <vector>

namespace patina {
namespace {

/// Covers x in ±1 and y in ±height with uv 0…1.
Mesh board(float height) {
    Mesh mesh;
    for (const glm::vec2 uv : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)})
        mesh.vertices.push_back(
            {.position = {2.0f * uv.x - 1.0f, height * (2.0f * uv.y - 1.0f), 0.0f}, .uv = uv});
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

TEST(UvStretch, is_the_length_of_a_unit_of_uv_where_that_is_longest) {
    EXPECT_NEAR(uv_stretch(board(1.0f)), 2.0f, 1e-5f);
    EXPECT_NEAR(uv_stretch(board(3.0f)), 6.0f, 1e-5f);
    EXPECT_NEAR(uv_stretch(board(0.1f)), 2.0f, 1e-5f);
    for (const BuiltinMesh& mesh : builtin_meshes()) {
        EXPECT_GT(uv_stretch(mesh.make()), 0.5f) << mesh.id;
        EXPECT_LT(uv_stretch(mesh.make()), 8.0f) << mesh.id;
        if (mesh.id == "sphere") {
            EXPECT_NEAR(uv_stretch(mesh.make()), std::numbers::pi, 0.1);
        }
    }
}

TEST(UvStretch, leaves_out_what_is_painted_with_one_colour) {
    Mesh mesh = board(1.0f);
    for (const Vertex& corner : board(5.0f).vertices) {
        mesh.vertices.push_back(corner);
        mesh.vertices.back().uv *= 1e-3f;
    }
    for (const std::uint32_t i : {0, 1, 2, 0, 2, 3}) mesh.indices.push_back(4 + i);
    EXPECT_NEAR(uv_stretch(mesh), 2.0f, 1e-5f);
    for (Vertex& vertex : mesh.vertices) vertex.uv = {};
    EXPECT_EQ(uv_stretch(mesh), 0.0f);
    mesh.has_uvs = false;
    EXPECT_EQ(uv_stretch(mesh), 0.0f);
}

TEST(VisibleMapSide, is_the_power_of_two_above_what_the_pixels_show) {
    const Sight sight{.camera = {.distance = 4.5f}, .height_px = 512};
    // A pixel at distance 3.5 covers 2 tan 15° · 3.5 / 512 = 0.00366.
    EXPECT_EQ(visible_map_side(2.0f, glm::vec2(1.0f), sight), 1024);
    EXPECT_EQ(visible_map_side(1.8f, glm::vec2(1.0f), sight), 512);
    EXPECT_EQ(visible_map_side(1.8f, glm::vec2(4.0f), sight), 128);
    EXPECT_EQ(visible_map_side(1.8f, glm::vec2(-4.0f, 2.0f), sight), 256);
    Sight larger = sight;
    larger.height_px = 1024;
    EXPECT_EQ(visible_map_side(1.8f, glm::vec2(1.0f), larger), 1024);
    Sight nearer = sight;
    nearer.camera.distance = 1.5f;
    EXPECT_EQ(visible_map_side(1.8f, glm::vec2(1.0f), nearer), 4096);
    nearer.camera.distance = 0.2f;
    EXPECT_EQ(visible_map_side(2.0f, glm::vec2(0.1f), nearer), 0);
    EXPECT_EQ(visible_map_side(2.0f, glm::vec2(1.0f), {}), 0);
}

std::vector<int> widths_left(int width, int height, int finest_side) {
    MapLevels map;
    for (glm::ivec2 size(width, height);; size = glm::max(size / 2, 1)) {
        map.levels.push_back(make_image(size.x, size.y, 1, PixelType::U8));
        if (size == glm::ivec2(1)) break;
    }
    leave_out_finer(map, finest_side);
    std::vector<int> widths;
    for (const Image& level : map.levels) widths.push_back(level.width);
    return widths;
}

TEST(MapDetail, leaves_out_levels_that_are_finer_than_what_is_seen) {
    EXPECT_EQ(widths_left(64, 64, 16), (std::vector<int>{16, 8, 4, 2, 1}));
    EXPECT_EQ(widths_left(70, 70, 16), (std::vector<int>{17, 8, 4, 2, 1}));
    EXPECT_EQ(widths_left(64, 16, 16), (std::vector<int>{64, 32, 16, 8, 4, 2, 1}));
    EXPECT_EQ(widths_left(16, 16, 32), (std::vector<int>{16, 8, 4, 2, 1}));
    EXPECT_EQ(widths_left(8, 8, 0), (std::vector<int>{8, 4, 2, 1}));
}

}  // namespace
}  // namespace patina
