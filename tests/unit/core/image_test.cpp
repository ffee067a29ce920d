#include "renderer/core/image.h"

#include "renderer/core/hash.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string_view>

namespace patina {
namespace {

TEST(Image, new_one_is_black_and_tightly_packed) {
    const Image image = make_image(3, 2, 4, PixelType::U16);
    EXPECT_EQ(image.bytes.size(), 3u * 2u * 4u * 2u);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x)
            for (int c = 0; c < 4; ++c) EXPECT_EQ(texel(image, x, y, c), 0.0f);
}

TEST(Image, every_stored_level_survives_texel_and_set_texel) {
    Image image8 = make_image(1, 1, 1, PixelType::U8);
    for (int i = 0; i < 256; ++i) {
        image8.bytes[0] = static_cast<std::byte>(i);
        set_texel(image8, 0, 0, 0, texel(image8, 0, 0, 0));
        ASSERT_EQ(std::to_integer<int>(image8.bytes[0]), i);
    }
    Image image16 = make_image(1, 1, 1, PixelType::U16);
    for (int i = 0; i < 65536; ++i) {
        set_texel(image16, 0, 0, 0, static_cast<float>(i) / 65535.0f);
        ASSERT_EQ(std::lround(texel(image16, 0, 0, 0) * 65535.0f), i);
    }
}

TEST(Image, unsigned_texels_clamp_and_turn_nan_into_black) {
    for (const PixelType type : {PixelType::U8, PixelType::U16}) {
        Image image = make_image(1, 1, 1, type);
        set_texel(image, 0, 0, 0, 7.0f);
        EXPECT_EQ(texel(image, 0, 0, 0), 1.0f);
        set_texel(image, 0, 0, 0, -7.0f);
        EXPECT_EQ(texel(image, 0, 0, 0), 0.0f);
        set_texel(image, 0, 0, 0, std::numeric_limits<float>::infinity());
        EXPECT_EQ(texel(image, 0, 0, 0), 1.0f);
        set_texel(image, 0, 0, 0, std::numeric_limits<float>::quiet_NaN());
        EXPECT_EQ(texel(image, 0, 0, 0), 0.0f);
    }
}

TEST(Image, float_texels_are_kept_as_they_are_and_where_they_belong) {
    Image image = make_image(2, 2, 3, PixelType::F32);
    set_texel(image, 1, 0, 2, -3.5f);
    EXPECT_EQ(texel(image, 1, 0, 2), -3.5f);
    EXPECT_EQ(texel(image, 1, 0, 1), 0.0f);
    EXPECT_EQ(texel(image, 0, 1, 2), 0.0f);
}

TEST(Srgb, matches_the_standards_known_values) {
    EXPECT_EQ(srgb_to_linear(0.0f), 0.0f);
    EXPECT_NEAR(srgb_to_linear(1.0f), 1.0f, 1e-6f);
    EXPECT_NEAR(srgb_to_linear(0.5f), 0.21404114f, 1e-6f);
    EXPECT_NEAR(srgb_to_linear(0.04045f), 0.0031308f, 1e-7f);
    EXPECT_NEAR(linear_to_srgb(0.18f), 0.46135613f, 1e-6f);
    EXPECT_EQ(linear_to_srgb(-1.0f), 0.0f);
    EXPECT_EQ(linear_to_srgb(std::numeric_limits<float>::quiet_NaN()), 0.0f);
}

TEST(Srgb, all_8_bit_levels_survive_a_round_trip) {
    for (int i = 0; i < 256; ++i)
        ASSERT_EQ(std::lround(255.0f * linear_to_srgb(srgb_to_linear(static_cast<float>(i) / 255.0f))), i);
}

std::uint64_t hash_text(std::string_view text) { return hash_bytes(std::as_bytes(std::span(text))); }

TEST(Hash, matches_the_published_test_values_of_xxh64) {
    EXPECT_EQ(hash_text(""), 0xEF46DB3751D8E999ull);
    EXPECT_EQ(hash_text("a"), 0xD24EC4F1A98C6E5Bull);
    EXPECT_EQ(hash_text("abc"), 0x44BC2CF5AD770999ull);
    EXPECT_EQ(hash_text("Nobody inspects the spammish repetition"), 0xFBCEA83C8A378BF1ull);
}

}  // namespace
}  // namespace patina
