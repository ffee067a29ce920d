#include "app/ktx.h"

#include "tests/unit/app/ktx_reader.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>
#include <sstream>

namespace patina {
namespace {

using test::KtxFile;
using test::read_ktx1;
using test::read_ktx2;

Environment environment_of(int width, const std::function<glm::vec3(glm::vec3)>& radiance) {
    Environment environment;
    environment.id = "made";
    environment.width = width;
    environment.height = width / 2;
    for (int y = 0; y < environment.height; ++y)
        for (int x = 0; x < width; ++x)
            environment.radiance.push_back(radiance(equirect_to_direction(
                {(float(x) + 0.5f) / float(width), (float(y) + 0.5f) / float(environment.height)})));
    environment.content_hash = environment_hash(environment);
    return environment;
}

/// Tells every direction from every other.
glm::vec3 direction_as_color(glm::vec3 d) { return 1.5f + d; }

BakedEnvironment baked_of(const Environment& environment, int base) {
    return *bake_for_ktx(environment, base, {});
}

/// The texture direction of a texel, from the face tables of the OpenGL and Vulkan specifications.
glm::vec3 texture_direction(int size, int face, int x, int y) {
    const float s = (2.0f * float(x) + 1.0f) / float(size) - 1.0f;
    const float t = (2.0f * float(y) + 1.0f) / float(size) - 1.0f;
    const std::array<glm::vec3, 6> directions{glm::vec3(1, -t, -s), glm::vec3(-1, -t, s),
                                              glm::vec3(s, 1, t),   glm::vec3(s, -1, -t),
                                              glm::vec3(s, -t, 1),  glm::vec3(-s, -t, -1)};
    return glm::normalize(directions[std::size_t(face)]);
}

glm::vec3 color(const KtxFile& file, int mip, int face, int x, int y) {
    const float* texel = file.texel(mip, face, x, y);
    return {texel[0], texel[1], texel[2]};
}

TEST(Ktx, mips_follow_filaments_mapping_from_lod_to_roughness) {
    EXPECT_EQ(ktx_mip_count(256), 5);
    EXPECT_EQ(ktx_mip_count(512), 6);
    EXPECT_EQ(ktx_mip_count(16), 5);
    EXPECT_EQ(ktx_mip_count(4), 3);
    for (const int count : {3, 5, 9})
        for (int mip = 0; mip < count; ++mip) {
            const double r = ktx_roughness(mip, count);
            EXPECT_NEAR((count - 1) * r * (2.0 - r), mip, 1e-6);  // perceptualRoughnessToLod of its shaders
        }
    EXPECT_NEAR(ktx_roughness(1, 5), 0.1339746f, 1e-7f);
    EXPECT_EQ(ktx_roughness(0, 5), 0.0f);
    EXPECT_EQ(ktx_roughness(4, 5), 1.0f);
}

TEST(Ktx, every_mip_is_baked_at_its_size_and_roughness) {
    for (const int base : {4, 32}) {
        const BakedEnvironment baked = baked_of(environment_of(64, direction_as_color), base);
        ASSERT_EQ(int(baked.levels.size()), ktx_mip_count(base));
        for (int k = 0; k < int(baked.levels.size()); ++k) {
            EXPECT_EQ(baked.levels[std::size_t(k)].cube.size, base >> k);
            EXPECT_EQ(baked.levels[std::size_t(k)].roughness, ktx_roughness(k, ktx_mip_count(base)));
        }
        EXPECT_TRUE(baked.lights.empty());
    }
}

TEST(Ktx, a_strict_reader_accepts_both_files_and_finds_the_baked_values) {
    const BakedEnvironment baked = baked_of(environment_of(64, direction_as_color), 32);
    const KtxFile one = read_ktx1(to_ktx1(baked, 0));
    const KtxFile two = read_ktx2(to_ktx2(baked, 0));
    ASSERT_EQ(one.mips.size(), baked.levels.size());
    ASSERT_EQ(two.mips.size(), baked.levels.size());
    EXPECT_EQ(one.base, 32);
    EXPECT_EQ(two.base, 32);
    for (int mip = 0; mip < int(baked.levels.size()); ++mip) {
        const CubeMap& cube = baked.levels[std::size_t(mip)].cube;
        for (int face = 0; face < 6; ++face)
            for (int y = 0; y < cube.size; ++y)
                for (int x = 0; x < cube.size; ++x) {
                    const glm::vec3 expected =
                        cube.texels[(std::size_t(face) * cube.size + y) * cube.size + x];
                    const int mirrored = face < 2 ? 1 - face : face;
                    EXPECT_LE(glm::distance(color(one, mip, face, x, y), expected),
                              1e-3f * glm::length(expected));
                    EXPECT_EQ(color(two, mip, mirrored, cube.size - 1 - x, y), color(one, mip, face, x, y));
                }
    }
}

TEST(Ktx, light_lies_where_filament_and_three_js_look_for_it) {
    const BakedEnvironment baked = baked_of(environment_of(256, direction_as_color), 32);
    const KtxFile one = read_ktx1(to_ktx1(baked, 0));
    const KtxFile two = read_ktx2(to_ktx2(baked, 0));
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x) {
                const glm::vec3 d = texture_direction(32, face, x, y);
                EXPECT_LE(glm::distance(color(one, 0, face, x, y), direction_as_color(d)), 0.02f);
                EXPECT_LE(glm::distance(color(two, 0, face, x, y), direction_as_color({-d.x, d.y, d.z})),
                          0.02f);
            }
}

TEST(Ktx, the_sharpest_mip_keeps_the_energy_of_a_single_bright_texel) {
    for (const int width : {64, 250, 1024, 1501}) {
        Environment environment = environment_of(width, [](glm::vec3) { return glm::vec3(0.0f); });
        environment.radiance[std::size_t(width / 3) * std::size_t(width) + 7] = glm::vec3(1000.0f);
        const double v0 = std::numbers::pi * (width / 3) / environment.height;
        const double v1 = std::numbers::pi * (width / 3 + 1) / environment.height;
        const double expected = 1000.0 * 2.0 * std::numbers::pi / width * (std::cos(v0) - std::cos(v1));
        const CubeMap cube = baked_of(environment, 32).levels.front().cube;
        double energy = 0.0;
        for (int row = 0; row < 6 * cube.size; ++row)
            for (int x = 0; x < cube.size; ++x)
                energy += cube_texel_solid_angle(cube.size, x, row % cube.size) *
                          double(cube.texels[std::size_t(row) * cube.size + x].g);
        EXPECT_NEAR(energy / expected, 1.0, 0.01);
    }
}

TEST(Ktx, key_values_name_orientation_roughness_and_scale) {
    const BakedEnvironment baked = baked_of(environment_of(32, direction_as_color), 16);
    const auto one = read_ktx1(to_ktx1(baked, 0)).values;
    const auto two = read_ktx2(to_ktx2(baked, 0)).values;
    EXPECT_STREQ(one.at("KTXorientation").c_str(), "S=r,T=d");
    EXPECT_STREQ(two.at("KTXorientation").c_str(), "rd");
    EXPECT_STREQ(one.at("PatinaScale").c_str(), "1");
    EXPECT_EQ(two.count("KTXmapRange"), 0u);
    EXPECT_EQ(two.at("KTXwriter").rfind("Patina ", 0), 0u);
    for (const auto& values : {one, two}) {
        std::istringstream list(values.at("PatinaRoughness"));
        for (const PrefilteredLevel& level : baked.levels) {
            float roughness = -1.0f;
            list >> roughness;
            EXPECT_EQ(roughness, level.roughness);
        }
    }
}

/// Filament's definition: each coefficient is a constant times ∫ L p dω.
std::array<glm::dvec3, 9> filament_coefficients(const Environment& environment) {
    const double pi = std::numbers::pi;
    const std::array<double, 9> constants{1 / (4 * pi),  1 / (2 * pi),   1 / (2 * pi),
                                          1 / (2 * pi),  15 / (16 * pi), 15 / (16 * pi),
                                          5 / (64 * pi), 15 / (16 * pi), 15 / (64 * pi)};
    std::array<glm::dvec3, 9> sums{};
    for (int y = 0; y < environment.height; ++y)
        for (int x = 0; x < environment.width; ++x) {
            const glm::dvec3 d(equirect_to_direction({(float(x) + 0.5f) / float(environment.width),
                                                      (float(y) + 0.5f) / float(environment.height)}));
            const double area =
                2 * pi / environment.width *
                (std::cos(pi * y / environment.height) - std::cos(pi * (y + 1) / environment.height));
            const std::array<double, 9> basis{
                1, d.y, d.z, d.x, d.x * d.y, d.y * d.z, 3 * d.z * d.z - 1, d.z * d.x, d.x * d.x - d.y * d.y};
            for (std::size_t i = 0; i < 9; ++i)
                sums[i] += constants[i] * area * basis[i] *
                           glm::dvec3(environment.radiance[std::size_t(y) * environment.width + x]);
        }
    return sums;
}

TEST(Ktx, irradiance_coefficients_are_what_filaments_cmgen_computes) {
    const Environment environment = environment_of(128, [](glm::vec3 d) {
        return glm::vec3(1.0f + d.x + d.x * d.y, std::exp(2.0f * d.y),
                         d.z > 0.3f && d.x < 0.5f ? 4.0f : 0.2f);
    });
    const std::array<glm::dvec3, 9> expected = filament_coefficients(environment);
    const KtxFile file = read_ktx1(to_ktx1(baked_of(environment, 64), 0));
    std::istringstream lines(file.values.at("sh"));
    for (const glm::dvec3& each : expected)
        for (int c = 0; c < 3; ++c) {
            double value = 0.0;
            ASSERT_TRUE(lines >> value);
            EXPECT_NEAR(value, each[c], 4e-3);
        }
}

TEST(Ktx, light_beyond_half_floats_is_scaled_by_a_power_of_two_and_says_so) {
    Environment environment = environment_of(64, direction_as_color);
    environment.radiance[64 * 10 + 20] = glm::vec3(1e6f);
    environment.content_hash = environment_hash(environment);
    const BakedEnvironment baked = baked_of(environment, 64);
    const int exponent = ktx_exponent(baked, "sun");
    EXPECT_EQ(exponent, 4);
    const KtxFile one = read_ktx1(to_ktx1(baked, exponent));
    const KtxFile two = read_ktx2(to_ktx2(baked, exponent));
    EXPECT_STREQ(one.values.at("PatinaScale").c_str(), "16");
    const std::string range = two.values.at("KTXmapRange");
    ASSERT_EQ(range.size(), 8u);
    std::array<float, 2> scale_and_offset{};
    std::memcpy(scale_and_offset.data(), range.data(), 8);
    EXPECT_EQ(scale_and_offset[0], 16.0f);
    EXPECT_EQ(scale_and_offset[1], 0.0f);
    const CubeMap& cube = baked.levels.front().cube;
    for (int i = 0; i < 6 * 64 * 64; ++i) {
        const glm::vec3 restored = 16.0f * color(one, 0, i / 4096, i % 64, i / 64 % 64);
        EXPECT_LE(glm::distance(restored, cube.texels[std::size_t(i)]),
                  1e-3f * glm::length(cube.texels[std::size_t(i)]));
    }
    std::istringstream sh(one.values.at("sh"));
    float first = 0.0f;
    sh >> first;
    EXPECT_NEAR(16.0f * first, irradiance_coefficients(baked.irradiance)[0].r, 1e-4f * first * 16.0f);
}

TEST(Ktx, light_that_half_floats_cannot_span_is_refused_in_one_sentence) {
    Environment environment = environment_of(32, [](glm::vec3) { return glm::vec3(1e-3f); });
    const BakedEnvironment dim = baked_of(environment, 16);
    EXPECT_EQ(ktx_exponent(dim, "dim"), 0);
    BakedEnvironment wide = dim;
    wide.levels[2].cube.texels[3] = glm::vec3(1e20f);
    try {
        ktx_exponent(wide, "sky.hdr");
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(std::string(error.what()).rfind("sky.hdr: ", 0), 0u);
        EXPECT_NE(std::string(error.what()).find("--format exr"), std::string::npos);
    }
}

TEST(Ktx, the_reader_refuses_every_truncation_and_every_changed_header_byte) {
    const BakedEnvironment baked = baked_of(environment_of(16, direction_as_color), 4);
    for (const bool second : {false, true}) {
        const std::vector<std::byte> bytes = second ? to_ktx2(baked, 0) : to_ktx1(baked, 0);
        const auto read = [&](std::span<const std::byte> part) {
            return second ? read_ktx2(part) : read_ktx1(part);
        };
        for (std::size_t length = 0; length < bytes.size(); length += 7)
            EXPECT_THROW(read(std::span(bytes).first(length)), std::runtime_error);
        for (std::size_t at = 0; at < (second ? 80u + 72u + 92u : 64u); ++at) {
            std::vector<std::byte> changed = bytes;
            changed[at] ^= std::byte{0x11};
            EXPECT_THROW(read(changed), std::runtime_error) << at;
        }
    }
}

TEST(Ktx, a_stopped_bake_gives_nothing) {
    std::stop_source stop;
    stop.request_stop();
    BakeControl control;
    control.stop = stop.get_token();
    EXPECT_FALSE(bake_for_ktx(environment_of(32, direction_as_color), 16, control).has_value());
}

}  // namespace
}  // namespace patina
