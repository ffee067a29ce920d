#include "renderer/core/environment.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace patina {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

void expect_near(glm::vec3 a, glm::vec3 b, float tolerance = 1e-6f) {
    EXPECT_NEAR(glm::length(a - b), 0.0f, tolerance) << a.x << " " << a.y << " " << a.z;
}

TEST(Equirect, centre_is_minus_z_right_half_is_plus_x_top_is_plus_y) {
    expect_near(equirect_to_direction({0.5f, 0.5f}), {0, 0, -1});
    expect_near(equirect_to_direction({0.75f, 0.5f}), {1, 0, 0});
    expect_near(equirect_to_direction({0.25f, 0.5f}), {-1, 0, 0});
    expect_near(equirect_to_direction({0.0f, 0.5f}), {0, 0, 1});
    expect_near(equirect_to_direction({0.3f, 0.0f}), {0, 1, 0});
    expect_near(equirect_to_direction({0.3f, 1.0f}), {0, -1, 0});
    EXPECT_NEAR(direction_to_equirect({0, 0, -1}).x, 0.5f, 1e-6f);
    EXPECT_NEAR(direction_to_equirect({1, 0, 0}).x, 0.75f, 1e-6f);
    EXPECT_NEAR(direction_to_equirect({-1, 0, 0}).x, 0.25f, 1e-6f);
    EXPECT_NEAR(direction_to_equirect({0, 1, 0}).y, 0.0f, 1e-6f);
    EXPECT_NEAR(direction_to_equirect({0, -1, 0}).y, 1.0f, 1e-6f);
}

TEST(Equirect, there_and_back_is_the_same_place) {
    for (float u = 0.01f; u < 1.0f; u += 0.07f)
        for (float v = 0.001f; v < 1.0f; v += 0.037f) {
            const glm::vec2 back = direction_to_equirect(equirect_to_direction({u, v}));
            EXPECT_NEAR(back.x, u, 2e-5f);
            EXPECT_NEAR(back.y, v, 1e-6f);
        }
}

TEST(Equirect, seam_and_poles_stay_inside_the_picture) {
    for (const glm::vec3 d :
         {glm::vec3(0.0f, 0.0f, 1.0f), glm::vec3(-0.0f, 0.0f, 1.0f), glm::vec3(-1e-9f, 0.0f, 1.0f),
          glm::vec3(0, 1, 0), glm::vec3(-0.0f, -1, -0.0f), glm::vec3(-0.0f, 1, 0.0f)}) {
        const glm::vec2 uv = direction_to_equirect(d);
        EXPECT_GE(uv.x, 0.0f);
        EXPECT_LT(uv.x, 1.0f);
        EXPECT_GE(uv.y, 0.0f);
        EXPECT_LE(uv.y, 1.0f);
    }
}

TEST(MakeEnvironment, repairs_and_counts_nan_negative_and_infinite_values) {
    Image image = make_image(4, 2, 3, PixelType::F32);
    set_texel(image, 0, 0, 0, kNan);
    set_texel(image, 0, 0, 1, kNan);
    set_texel(image, 1, 0, 1, -2.0f);
    set_texel(image, 2, 1, 2, kInf);
    set_texel(image, 3, 1, 2, -kInf);
    set_texel(image, 3, 1, 0, 7.0f);
    const Environment environment = make_environment(image, "id", "title");
    EXPECT_EQ(environment.radiance[0], glm::vec3(0.0f));
    EXPECT_EQ(environment.radiance[1], glm::vec3(0.0f));
    EXPECT_EQ(environment.radiance[6].z, 7.0f) << "infinite becomes the largest finite value";
    EXPECT_EQ(environment.radiance[7], glm::vec3(7.0f, 0.0f, 0.0f));
    ASSERT_EQ(environment.notes.size(), 3u);
    EXPECT_NE(environment.notes[0].find("2 NaN"), std::string::npos);
    EXPECT_NE(environment.notes[1].find("2 negative"), std::string::npos);
    EXPECT_NE(environment.notes[2].find("1 infinite"), std::string::npos);
}

TEST(MakeEnvironment, leaves_no_value_that_overflows_when_squared) {
    Image image = make_image(2, 1, 1, PixelType::F32);
    set_texel(image, 0, 0, 0, 3e38f);
    set_texel(image, 1, 0, 0, kInf);
    const Environment environment = make_environment(image, "", "");
    for (const glm::vec3& texel : environment.radiance) EXPECT_TRUE(std::isfinite(texel.x * texel.x));
    EXPECT_EQ(environment.notes.size(), 2u);
}

TEST(MakeEnvironment, picture_of_nothing_but_infinity_becomes_black) {
    Image image = make_image(2, 1, 1, PixelType::F32);
    set_texel(image, 0, 0, 0, kInf);
    set_texel(image, 1, 0, 0, kInf);
    for (const glm::vec3& texel : make_environment(image, "", "").radiance) EXPECT_EQ(texel, glm::vec3(0.0f));
}

TEST(MakeEnvironment, spreads_grey_and_drops_alpha) {
    for (const int channels : {1, 2, 3, 4}) {
        Image image = make_image(2, 1, channels, PixelType::F32);
        for (int c = 0; c < channels; ++c) set_texel(image, 1, 0, c, static_cast<float>(c + 1));
        const glm::vec3 expected = channels < 3 ? glm::vec3(1.0f) : glm::vec3(1.0f, 2.0f, 3.0f);
        EXPECT_EQ(make_environment(image, "", "").radiance[1], expected) << channels;
    }
}

TEST(MakeEnvironment, decodes_8_and_16_bit_as_srgb_and_says_so) {
    for (const PixelType type : {PixelType::U8, PixelType::U16}) {
        Image image = make_image(2, 1, 3, type);
        set_texel(image, 0, 0, 1, 0.5f);
        const Environment environment = make_environment(image, "", "");
        EXPECT_NEAR(environment.radiance[0].y, srgb_to_linear(0.5f), 0.004f);
        ASSERT_EQ(environment.notes.size(), 1u);
        EXPECT_NE(environment.notes[0].find("sRGB"), std::string::npos);
    }
}

TEST(MakeEnvironment, takes_any_size_and_notes_what_is_not_two_to_one) {
    for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(7, 1), glm::ivec2(1, 9), glm::ivec2(13, 5)}) {
        const Environment environment =
            make_environment(make_image(size.x, size.y, 3, PixelType::F32), "", "");
        EXPECT_EQ(environment.radiance.size(), static_cast<std::size_t>(size.x) * size.y);
        ASSERT_EQ(environment.notes.size(), 1u);
        EXPECT_NE(environment.notes[0].find("2:1"), std::string::npos);
    }
    EXPECT_TRUE(make_environment(make_image(6, 3, 3, PixelType::F32), "", "").notes.empty());
}

TEST(MakeEnvironment, refuses_an_empty_picture) {
    EXPECT_THROW(make_environment(Image{}, "", "nothing"), std::runtime_error);
}

TEST(MakeEnvironment, hash_tells_sizes_and_pixels_apart_and_nothing_else) {
    Image image = make_image(4, 2, 3, PixelType::F32);
    const std::uint64_t black = make_environment(image, "a", "b").content_hash;
    EXPECT_EQ(make_environment(image, "c", "d").content_hash, black);
    EXPECT_NE(make_environment(make_image(2, 4, 3, PixelType::F32), "", "").content_hash, black);
    set_texel(image, 3, 1, 2, 1e-30f);
    EXPECT_NE(make_environment(image, "a", "b").content_hash, black);
}

}  // namespace
}  // namespace patina
