#include "renderer/map_levels.h"

#include "tests/gl/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace patina {
namespace {

using test::make_picture;

int byte_at(const Image& image, int x, int y, int c) { return int(std::lround(255 * texel(image, x, y, c))); }

TEST(MapLevels, end_in_one_pixel_and_halve_each_time) {
    const MapLevels map = make_map_levels(make_picture(37, 10, [](int, int) { return glm::ivec3(9); }),
                                          MapKind::Data, ColorSpace::Linear);
    const glm::ivec2 sizes[] = {{37, 10}, {18, 5}, {9, 2}, {4, 1}, {2, 1}, {1, 1}};
    ASSERT_EQ(map.levels.size(), std::size(sizes));
    for (std::size_t i = 0; i < map.levels.size(); ++i) {
        EXPECT_EQ(map.levels[i].width, sizes[i].x);
        EXPECT_EQ(map.levels[i].height, sizes[i].y);
        EXPECT_EQ(map.levels[i].channels, 4);
        EXPECT_EQ(byte_at(map.levels[i], 0, 0, 1), 9);
        EXPECT_EQ(byte_at(map.levels[i], 0, 0, 3), 255);
    }
}

TEST(MapLevels, black_and_white_average_to_half_the_light_which_is_code_188) {
    const Image checker =
        make_picture(64, 64, [](int x, int y) { return (x + y) % 2 == 0 ? glm::ivec3(255) : glm::ivec3(0); });
    const MapLevels color = make_map_levels(checker, MapKind::Color, ColorSpace::Srgb);
    EXPECT_TRUE(color.srgb);
    for (std::size_t i = 1; i < color.levels.size(); ++i) EXPECT_EQ(byte_at(color.levels[i], 0, 0, 0), 188);
    const MapLevels data = make_map_levels(checker, MapKind::Data, ColorSpace::Srgb);
    EXPECT_FALSE(data.srgb);
    for (std::size_t i = 1; i < data.levels.size(); ++i) EXPECT_EQ(byte_at(data.levels[i], 0, 0, 0), 128);
}

TEST(MapLevels, every_srgb_byte_survives_averaging_with_itself) {
    const Image picture = make_picture(512, 2, [](int x, int) { return glm::ivec3(x / 2); });
    const MapLevels map = make_map_levels(picture, MapKind::Color, ColorSpace::Srgb);
    for (int x = 0; x < 256; ++x) EXPECT_EQ(byte_at(map.levels[1], x, 0, 0), x);
}

TEST(MapLevels, odd_sizes_give_every_pixel_its_share) {
    // One bright pixel, wherever it is: the mean of the last level is the mean of the picture.
    for (int bright = 0; bright < 7; ++bright) {
        Image picture = make_image(7, 5, 1, PixelType::F32);
        set_texel(picture, bright, bright % 5, 0, 35.0f);
        const MapLevels map = make_map_levels(picture, MapKind::Data, ColorSpace::Linear);
        EXPECT_NEAR(texel(map.levels.back(), 0, 0, 0), 1.0f, 1e-5f) << bright;
    }
}

TEST(MapLevels, normals_stay_unit_vectors) {
    const Image slopes = make_picture(
        32, 32, [](int x, int) { return x % 2 == 0 ? glm::ivec3(218, 128, 218) : glm::ivec3(38, 128, 218); });
    const MapLevels map = make_map_levels(slopes, MapKind::Normal, ColorSpace::Srgb);
    EXPECT_FALSE(map.srgb);
    for (std::size_t i = 1; i < map.levels.size(); ++i) {
        EXPECT_NEAR(byte_at(map.levels[i], 0, 0, 0), 128, 1);
        EXPECT_EQ(byte_at(map.levels[i], 0, 0, 2), 255);
    }
    const Image opposite = make_picture(
        2, 1, [](int x, int) { return x == 0 ? glm::ivec3(255, 128, 128) : glm::ivec3(0, 127, 127); });
    const MapLevels cancelled = make_map_levels(opposite, MapKind::Normal, ColorSpace::Linear);
    EXPECT_EQ(byte_at(cancelled.levels.back(), 0, 0, 2), 255);
}

TEST(MapLevels, smaller_levels_of_a_normal_map_keep_how_far_its_normals_spread) {
    // Tilted by ±45° in turn: the mean has length R = cos 45°, and the spread is (1 − R²)/(2R(3 − R²)).
    const Image slopes = make_picture(
        32, 32, [](int x, int) { return x % 2 == 0 ? glm::ivec3(218, 128, 218) : glm::ivec3(38, 128, 218); });
    const MapLevels map = make_map_levels(slopes, MapKind::Normal, ColorSpace::Linear);
    const float spread = 0.5f / (2.0f * std::sqrt(0.5f) * 2.5f);
    EXPECT_EQ(byte_at(map.levels[0], 5, 5, 3), 255);
    for (std::size_t i = 1; i < map.levels.size(); ++i)
        EXPECT_NEAR(texel(map.levels[i], 0, 0, 3), 1.0f - std::sqrt(spread), 0.006f) << i;
    const Image flat = make_picture(8, 8, [](int, int) { return glm::ivec3(128, 128, 255); });
    EXPECT_EQ(byte_at(make_map_levels(flat, MapKind::Normal, ColorSpace::Linear).levels.back(), 0, 0, 3),
              255);
    Image own_alpha = make_image(2, 2, 4, PixelType::U8);  // means nothing in a normal map
    EXPECT_EQ(byte_at(make_map_levels(own_alpha, MapKind::Normal, ColorSpace::Linear).levels[0], 0, 0, 3),
              255);
}

TEST(MapLevels, a_normal_map_of_two_channels_gets_its_third) {
    Image picture = make_image(1, 1, 2, PixelType::U8);
    set_texel(picture, 0, 0, 0, 0.8f);
    set_texel(picture, 0, 0, 1, 0.5f);
    const MapLevels map = make_map_levels(picture, MapKind::Normal, ColorSpace::Linear);
    ASSERT_EQ(map.levels[0].channels, 4);
    EXPECT_NEAR(texel(map.levels[0], 0, 0, 2), 0.9f, 0.005f);
}

TEST(MapLevels, sixteen_bits_of_srgb_become_linear_light) {
    Image picture = make_image(1, 1, 3, PixelType::U16);
    for (int c = 0; c < 3; ++c) set_texel(picture, 0, 0, c, 0.5f);
    const MapLevels map = make_map_levels(picture, MapKind::Color, ColorSpace::Srgb);
    EXPECT_FALSE(map.srgb);
    EXPECT_NEAR(texel(map.levels[0], 0, 0, 0), srgb_to_linear(0.5f), 1e-4f);
    EXPECT_FLOAT_EQ(texel(map.levels[0], 0, 0, 3), 1.0f);
    EXPECT_NEAR(texel(make_map_levels(picture, MapKind::Data, ColorSpace::Srgb).levels[0], 0, 0, 0), 0.5f,
                1e-4f);
}

TEST(MapLevels, numbers_that_are_none_become_none_harmful) {
    Image picture = make_image(2, 2, 1, PixelType::F32);
    set_texel(picture, 0, 0, 0, std::numeric_limits<float>::quiet_NaN());
    set_texel(picture, 1, 0, 0, std::numeric_limits<float>::infinity());
    set_texel(picture, 0, 1, 0, 1e30f);
    set_texel(picture, 1, 1, 0, 4.0f);
    const MapLevels map = make_map_levels(picture, MapKind::Data, ColorSpace::Linear);
    EXPECT_FLOAT_EQ(texel(map.levels[0], 0, 0, 0), 0.0f);
    EXPECT_FLOAT_EQ(texel(map.levels[0], 1, 0, 0), 0.0f);
    EXPECT_FLOAT_EQ(texel(map.levels[0], 0, 1, 0), 65504.0f);
    EXPECT_TRUE(std::isfinite(texel(map.levels[1], 0, 0, 0)));
}

TEST(MapLevels, grey_stays_one_channel_unless_it_is_srgb) {
    const Image grey = make_image(4, 4, 1, PixelType::U8);
    EXPECT_EQ(make_map_levels(grey, MapKind::Data, ColorSpace::Linear).levels[0].channels, 1);
    EXPECT_EQ(make_map_levels(grey, MapKind::Color, ColorSpace::Srgb).levels[0].channels, 4);
}

}  // namespace
}  // namespace patina
