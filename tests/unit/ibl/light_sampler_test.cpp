// A panorama's cells and the directions that are drawn from them.
#include "renderer/ibl/light_sampler.h"

#include "renderer/core/environment.h"
#include "renderer/ibl/low_discrepancy.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace patina {
namespace {

constexpr double kPi = std::numbers::pi;

PanoramaTexels painted(int width, glm::vec3 (*radiance)(glm::dvec3)) {
    PanoramaTexels texels{width, std::max(width / 2, 1), {}};
    for (int y = 0; y < texels.height; ++y)
        for (int x = 0; x < texels.width; ++x)
            texels.radiance.push_back(radiance(texel_direction(texels, x + 0.5, y + 0.5)));
    return texels;
}

/// A dark room, bluish above, with a large and a thin bright lamp.
glm::vec3 room(glm::dvec3 d) {
    if (glm::dot(d, glm::normalize(glm::dvec3(1.0, 1.0, 0.5))) > 0.95) return glm::vec3(20.0f);
    if (std::abs(d.z + 0.9) < 0.06 && std::abs(d.y) < 0.3) return {90.0f, 80.0f, 70.0f};
    return d.y > 0.0 ? glm::vec3(0.1f, 0.2f, 0.4f) : glm::vec3(0.05f);
}

TEST(LightCells, cover_every_texel_once_and_hold_all_light) {
    for (const auto& [width, height] :
         {std::pair{64, 32}, {1024, 512}, {1, 1}, {1, 9}, {700, 2}, {1030, 300}}) {
        PanoramaTexels texels{width, height, {}};
        for (int i = 0; i < width * height; ++i)
            texels.radiance.emplace_back(float(i % 7), 1.0f, float(i % 91));
        std::vector<int> times(texels.radiance.size(), 0);
        double light = 0.0, all = 0.0;
        const std::vector<LightCell> cells = divide_light(texels, 32);
        ASSERT_LE(cells.size(), 32u);
        EXPECT_EQ(cells.size(), std::size_t(std::min(32, width * height)));
        for (const LightCell& cell : cells) {
            light += cell.light;
            EXPECT_NEAR(glm::length(cell.direction), 1.0, 1e-9);
            EXPECT_GT(cell.spread, 0.0);
            for (int y = cell.top; y < cell.bottom; ++y)
                for (int x = cell.left; x < cell.right; ++x) ++times[std::size_t(y) * width + x];
        }
        for (int i = 0; i < width * height; ++i)
            all += mean_channel(texels.radiance[i]) * texel_solid_angle(texels, i / width);
        EXPECT_NEAR(light, all, 1e-9 * all);
        EXPECT_TRUE(std::all_of(times.begin(), times.end(), [](int each) { return each == 1; }))
            << width << "×" << height;
    }
}

TEST(LightCells, are_small_where_the_light_is) {
    const PanoramaTexels texels = painted(512, room);
    double spread = 0.0, light = 0.0;
    for (const LightCell& cell : divide_light(texels, 32)) {
        spread += cell.light * cell.spread;
        light += cell.light;
    }
    EXPECT_LT(std::sqrt(spread / light), 0.2);
    const std::vector<LightCell> one = divide_light(texels, 1);
    ASSERT_EQ(one.size(), 1u);
    EXPECT_GT(std::sqrt(one[0].spread), 0.7);
}

TEST(LightSampler, draws_texels_by_their_light) {
    PanoramaTexels texels{8, 4, std::vector<glm::vec3>(32, glm::vec3(0.0f))};
    texels.radiance[8 + 3] = glm::vec3(6.0f, 0.0f, 0.0f);
    texels.radiance[16 + 6] = glm::vec3(0.0f, 2.0f, 0.0f);
    const LightSampler sampler(texels);
    double red = 0.0, area = 0.0;
    constexpr int count = 256;
    for (int k = 0; k < int(sampler.cells().size()); ++k)
        for (int i = 0; i < count; ++i) {
            const glm::dvec3 u = scrambled_sobol(std::uint32_t(i), 7);
            const LightSample sample = sampler.sample(k, {u.x, u.y});
            ASSERT_GT(sample.density, 0.0);
            ASSERT_NEAR(glm::length(sample.direction), 1.0, 1e-12);
            const glm::vec2 uv = direction_to_equirect(glm::vec3(sample.direction));
            const int x = int(uv.x * 8), y = int(uv.y * 4);
            EXPECT_EQ(sample.radiance, texels.radiance[std::size_t(y) * 8 + x]);
            EXPECT_EQ(sampler.radiance_and_cell()[std::size_t(y) * 8 + x],
                      glm::vec4(sample.radiance, float(k)));
            if (!(sampler.cells()[k].light > 0.0)) continue;
            red += sampler.cells()[k].light / sampler.total() * (sample.radiance.x > 0.0f) / count;
            area += 1.0 / sample.density / count;
        }
    EXPECT_NEAR(red, 0.75, 2e-3);  // both rows are as high
    EXPECT_NEAR(area, 2.0 * 2.0 * kPi / 8.0 * std::sqrt(0.5), 1e-3);
}

TEST(LightSampler, integrates_to_the_sum_over_texels) {
    const PanoramaTexels texels = painted(256, room);
    const LightSampler sampler(texels);
    const auto weight = [](glm::dvec3 d) { return std::exp(2.0 * d.x - d.y + 0.5 * d.z); };
    double exact = 0.0, sampled = 0.0;
    for (int y = 0; y < texels.height; ++y)
        for (int x = 0; x < texels.width; ++x)
            exact += weight(texel_direction(texels, x + 0.5, y + 0.5)) * texel_solid_angle(texels, y) *
                     mean_channel(texels.radiance[std::size_t(y) * texels.width + x]);
    constexpr int count = 1024;
    for (int k = 0; k < int(sampler.cells().size()); ++k)
        for (int i = 0; i < count; ++i) {
            const glm::dvec3 u = scrambled_sobol(std::uint32_t(i), 3);
            const LightSample sample = sampler.sample(k, {u.x, u.y});
            sampled += weight(sample.direction) * mean_channel(sample.radiance) / sample.density / count;
        }
    EXPECT_NEAR(sampled / exact, 1.0, 5e-4);
}

TEST(LightSampler, without_light_looks_everywhere) {
    const LightSampler sampler({4, 2, std::vector<glm::vec3>(8, glm::vec3(0.0f))});
    EXPECT_EQ(sampler.total(), 0.0);
    ASSERT_EQ(sampler.cells().size(), 1u);
    EXPECT_NEAR(sampler.sample(0, {0.3, 0.6}).density, 0.25 / kPi, 1e-12);
    EXPECT_EQ(sampler.sample(0, {0.3, 0.6}).radiance, glm::vec3(0.0f));
}

}  // namespace
}  // namespace patina
