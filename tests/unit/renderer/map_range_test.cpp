#include "renderer/map_range.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patina {
namespace {

MapLevels picture(PixelType type, int channels) {
    MapLevels map;
    map.levels = {make_image(4, 2, channels, type)};
    return map;
}

TEST(MapRange, spans_the_numbers_that_are_sampled) {
    MapLevels map = picture(PixelType::U8, 4);
    Image& image = map.levels[0];
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 4; ++x)
            for (int c = 0; c < 4; ++c) set_texel(image, x, y, c, 0.2f * float(c + 1));
    set_texel(image, 3, 1, 1, 1.0f);
    const ChannelRanges ranges = channel_ranges(map);
    EXPECT_TRUE(ranges[0].is_single());
    EXPECT_NEAR(ranges[0].low, 0.2f, 1e-6f);
    EXPECT_NEAR(ranges[1].low, 0.4f, 1e-6f);
    EXPECT_EQ(ranges[1].high, 1.0f);
    map.levels.push_back(make_image(2, 1, 4, PixelType::U8));  // black: what smaller levels hold counts too
    EXPECT_EQ(channel_ranges(map)[0].low, 0.0f);
}

TEST(MapRange, finds_what_is_smallest_and_largest_wherever_it_lies) {
    for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32})
        for (const int channels : {1, 2, 3, 4})
            for (const int at : {0, 15, 16, 50, 110}) {  // of 37 × 3 pixels
                MapLevels map;
                map.levels = {make_image(37, 3, channels, type)};
                Image& image = map.levels[0];
                for (int i = 0; i < 37 * 3; ++i)
                    for (int c = 0; c < channels; ++c) set_texel(image, i % 37, i / 37, c, 0.4f);
                const int channel = channels - 1;
                set_texel(image, at % 37, at / 37, channel, 0.8f);
                set_texel(image, (at + 30) % 37, at / 37, channel, 0.2f);
                if (type == PixelType::F32) set_texel(image, (at + 3) % 37, at / 37, channel, std::nanf(""));
                const ChannelRanges ranges = channel_ranges(map);
                const int row = channels == 2 ? 3 : channel;  // grey and alpha
                EXPECT_NEAR(ranges[row].low, 0.2f, 2e-3f) << channels << ' ' << at;
                EXPECT_NEAR(ranges[row].high, 0.8f, 2e-3f) << channels << ' ' << at;
                if (channels > 1) EXPECT_TRUE(ranges[0].is_single()) << channels << ' ' << at;
            }
}

TEST(MapRange, of_grey_is_the_same_in_every_colour) {
    MapLevels map = picture(PixelType::U16, 1);
    set_texel(map.levels[0], 2, 1, 0, 0.5f);
    const ChannelRanges ranges = channel_ranges(map);
    for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(ranges[c].low, 0.0f);
        EXPECT_NEAR(ranges[c].high, 0.5f, 1e-4f);
    }
    EXPECT_EQ(ranges[3], (ValueRange{1.0f, 1.0f}));
}

TEST(MapRange, of_floating_point_numbers_is_clamped_where_the_shader_does) {
    MapLevels map = picture(PixelType::F32, 1);
    set_texel(map.levels[0], 0, 0, 0, -2.0f);
    set_texel(map.levels[0], 1, 0, 0, 3.0f);
    EXPECT_EQ(channel_ranges(map)[0], (ValueRange{-2.0f, 3.0f}));
    EXPECT_EQ(scalar_range({.value = 0.5f, .map = "m"}, channel_ranges(map)), (ValueRange{0.0f, 1.0f}));
    EXPECT_EQ(scalar_range({.value = 0.5f, .map = "m"}, std::nullopt), (ValueRange{0.5f, 0.5f}));
    EXPECT_EQ(scalar_range({.value = 0.0f, .map = "m"}, channel_ranges(map)), (ValueRange{0.0f, 0.0f}));
}

TEST(MapRange, of_srgb_colours_is_their_light) {
    MapLevels map = picture(PixelType::U8, 4);
    map.srgb = true;
    for (int c = 0; c < 4; ++c) set_texel(map.levels[0], 1, 1, c, 0.5f);
    EXPECT_NEAR(channel_ranges(map)[0].high, srgb_to_linear(128.0f / 255.0f), 1e-6f);
    EXPECT_NEAR(channel_ranges(map)[3].high, 128.0f / 255.0f, 1e-6f);
}

ChannelRanges single(float r, float g, float b, float a = 1.0f) {
    return {ValueRange{r, r}, ValueRange{g, g}, ValueRange{b, b}, ValueRange{a, a}};
}

TEST(Collapsed, maps_of_one_colour_are_values) {
    Material material;
    material.albedo.value = {0.5f, 1.0f, 1.0f};
    material.roughness.value = 0.5f;
    material.roughness.channel = Channel::G;
    material.metallic.invert = true;
    material.metallic.value = 1.0f;
    MapRanges maps;
    maps[std::size_t(MapSlot::Albedo)] = single(0.5f, 0.25f, 1.0f);
    maps[std::size_t(MapSlot::Roughness)] = single(0.0f, 0.8f, 0.0f);
    maps[std::size_t(MapSlot::Metallic)] = single(0.0f, 0.0f, 0.25f);
    maps[std::size_t(MapSlot::Normal)] = single(128.0f / 255.0f, 127.0f / 255.0f, 1.0f);
    const auto [result, slots] = collapsed(material, maps);
    EXPECT_EQ(result.albedo.value, glm::vec3(0.25f, 0.25f, 1.0f));
    EXPECT_FLOAT_EQ(result.roughness.value, 0.4f);
    EXPECT_FLOAT_EQ(result.metallic.value, 0.75f);
    EXPECT_TRUE(slots[std::size_t(MapSlot::Normal)]);
    EXPECT_EQ(slots.count(), 4u);
    EXPECT_FALSE(slots[std::size_t(MapSlot::Ao)]);
}

TEST(Collapsed, maps_that_vary_where_they_are_read_stay) {
    Material material;
    material.roughness.channel = Channel::G;
    MapRanges maps;
    ChannelRanges varying = single(0.5f, 0.5f, 1.0f);
    varying[1].high = 0.6f;
    maps[std::size_t(MapSlot::Roughness)] = varying;
    maps[std::size_t(MapSlot::Albedo)] = varying;
    maps[std::size_t(MapSlot::Normal)] = varying;
    EXPECT_EQ(collapsed(material, maps).slots.count(), 0u);
    EXPECT_EQ(collapsed(material, maps).material, material);
    material.roughness.channel = Channel::R;
    EXPECT_TRUE(collapsed(material, maps).slots[std::size_t(MapSlot::Roughness)]);
    maps[std::size_t(MapSlot::Normal)] = single(0.6f, 0.5f, 0.9f);  // one normal, but it leans
    EXPECT_FALSE(collapsed(material, maps).slots[std::size_t(MapSlot::Normal)]);
}

}  // namespace
}  // namespace patina
