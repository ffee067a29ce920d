#include "renderer/map_detail.h"

#include "renderer/map_levels.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <cstdint>
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
    const MapLevels map = make_map_levels(make_image(width, height, 1, PixelType::U8), MapKind::Data,
                                          ColorSpace::Linear, finest_side);
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

/// Values that every filter tells apart.
Image noisy(int channels, PixelType type) {
    Image image = make_image(41, 30, channels, type);
    std::uint32_t state = 7;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < channels; ++c) {
                state = state * 1664525u + 1013904223u;
                set_texel(image, x, y, c, float(state >> 8) / float(1 << 24));
            }
    return image;
}

TEST(MapDetail, levels_that_stay_are_the_same_whether_finer_ones_are_made_or_not) {
    for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32})
        for (int channels = 1; channels <= 4; ++channels)
            for (const MapKind kind : {MapKind::Color, MapKind::Data, MapKind::Normal})
                for (const int finest_side : {15, 7, 64}) {
                    const Image image = noisy(channels, type);
                    const MapLevels all = make_map_levels(image, kind, ColorSpace::Srgb);
                    const MapLevels some = make_map_levels(image, kind, ColorSpace::Srgb, finest_side);
                    ASSERT_LE(some.levels.size(), all.levels.size());
                    EXPECT_EQ(some.levels.size(), finest_side == 64 ? 6u : finest_side == 15 ? 5u : 4u);
                    EXPECT_EQ(some.srgb, all.srgb);
                    const std::size_t left_out = all.levels.size() - some.levels.size();
                    for (std::size_t i = 0; i < some.levels.size(); ++i) {
                        EXPECT_EQ(some.levels[i].width, all.levels[i + left_out].width);
                        EXPECT_EQ(some.levels[i].bytes, all.levels[i + left_out].bytes);
                    }
                }
}

/// Of n = 2k maps: what is kept, and a few rows for each of the 11 levels; 12 MiB are the picture.
TEST(MapDetail, a_map_is_made_from_rows_in_little_more_memory_than_what_is_kept_of_it) {
    constexpr int side = 2048, seen = 256;
    for (const MapKind kind : {MapKind::Color, MapKind::Data, MapKind::Normal}) {
        MapMaker maker(kind, ColorSpace::Srgb, seen);
        maker.begin({.width = side, .height = side, .channels = 3, .type = PixelType::U8, .bytes = {}});
        std::vector<std::byte> row(3 * side);
        std::size_t most = 0;
        for (int y = 0; y < side; ++y) {
            for (std::size_t i = 0; i < row.size(); ++i) row[i] = std::byte((i * 31 + y * 17) % 251);
            maker.row(row.data());
            most = std::max(most, maker.bytes());
        }
        const MapLevels map = maker.take();
        ASSERT_EQ(map.levels[0].width, seen);
        std::size_t kept = 0;
        for (const Image& level : map.levels) kept += level.bytes.size();
        // Floats of three channels: the finest row, and four rows of each level below, together as wide; of
        // four channels a row of what is kept, as it is coded; and the picture's own.
        const std::size_t rows =
            3 * sizeof(float) * (side + 4 * side) + 4 * sizeof(float) * seen + row.size();
        EXPECT_LE(most, kept + rows);
        EXPECT_GE(most, kept);
    }
}

TEST(MapDetail, grey_is_grey_until_a_colour_comes) {
    Image late = make_image(32, 32, 3, PixelType::U8);
    for (int i = 0; i < 32 * 32; ++i)
        for (int c = 0; c < 3; ++c) late.bytes[std::size_t(3 * i + c)] = std::byte(i * 37 % 256);
    for (const int coloured : {0, 5, 31}) {
        Image image = late;
        image.bytes[std::size_t(3 * (32 * coloured + 7))] ^= std::byte(0x81);
        const MapLevels all = make_map_levels(image, MapKind::Data, ColorSpace::Linear);
        for (const int finest_side : {4, 8, 32}) {
            const MapLevels some = make_map_levels(image, MapKind::Data, ColorSpace::Linear, finest_side);
            ASSERT_EQ(some.levels[0].channels, 4);
            for (std::size_t i = 0; i < some.levels.size(); ++i)
                EXPECT_EQ(some.levels[i].bytes, all.levels[i + all.levels.size() - some.levels.size()].bytes);
        }
    }
}

TEST(MapDetail, grey_numbers_have_one_channel_where_detail_is_left_out) {
    Image grey = make_image(8, 8, 3, PixelType::U8);
    for (int i = 0; i < 64; ++i)
        for (int c = 0; c < 3; ++c) grey.bytes[std::size_t(3 * i + c)] = std::byte(i);
    const auto channels = [&](MapKind kind, int finest_side) {
        return make_map_levels(grey, kind, ColorSpace::Linear, finest_side).levels[0].channels;
    };
    EXPECT_EQ(channels(MapKind::Data, 4), 1);
    EXPECT_EQ(channels(MapKind::Data, 0), 4);
    EXPECT_EQ(channels(MapKind::Color, 4), 4);
    grey.bytes[1] = std::byte(9);
    EXPECT_EQ(channels(MapKind::Data, 4), 4);
}

}  // namespace
}  // namespace patina
