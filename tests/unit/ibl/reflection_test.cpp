#include "renderer/ibl/reflection.h"

#include "renderer/ibl/bake.h"
#include "renderer/ibl/light_sampler.h"
#include "renderer/ibl/low_discrepancy.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <set>

namespace patina {
namespace {

Environment panorama(int width, const std::function<glm::vec3(glm::vec3)>& radiance) {
    Environment environment;
    environment.width = width;
    environment.height = width / 2;
    for (int y = 0; y < environment.height; ++y)
        for (int x = 0; x < width; ++x)
            environment.radiance.push_back(radiance(equirect_to_direction(
                {(float(x) + 0.5f) / float(width), (float(y) + 0.5f) / float(environment.height)})));
    return environment;
}

TEST(ReflectionReference, knows_the_closed_form_at_normal_incidence) {
    const glm::dvec2 ab = reference_split_sum(1.0, 1.0);
    EXPECT_NEAR(ab.x + ab.y, 1.0 - std::log(2.0), 1e-5);
}

TEST(ReflectionReference, agrees_with_the_table) {
    const BrdfTable table = bake_brdf_table(64);
    for (const int y : {6, 18, 40, 63})
        for (const int x : {10, 22, 41, 63}) {
            const double NoV = std::pow((x + 0.5) / 64, 2);
            const glm::dvec2 ab = reference_split_sum(NoV, (y + 0.5) / 64);
            EXPECT_NEAR(ab.x, double(table.ab[y * 64 + x].x), 1e-3) << x << " " << y;
            EXPECT_NEAR(ab.y, double(table.ab[y * 64 + x].y), 1e-3) << x << " " << y;
        }
}

TEST(ReflectionReference, reflects_all_light_of_a_white_room) {
    const Environment white = panorama(16, [](glm::vec3) { return glm::vec3(1.0f); });
    const ReflectionReference reference(white);
    for (const double metallic : {0.0, 1.0})
        for (const double roughness : {0.1, 0.4, 1.0})
            for (const double NoV : {0.1, 0.6, 1.0}) {
                const glm::dvec3 V(std::sqrt(1.0 - NoV * NoV), NoV, 0.0);
                const glm::dvec3 Lo =
                    reference.radiance({0.0, 1.0, 0.0}, V, {glm::dvec3(1.0), metallic, roughness});
                EXPECT_NEAR(Lo.x, 1.0, 2e-4) << metallic << " " << roughness << " " << NoV;
            }
}

TEST(ReflectionReference, knows_the_irradiance_of_a_linear_sky) {
    // L = 1 + d·a gives E/π = 1 + ⅔ N·a.
    const glm::vec3 a(0.3f, 0.5f, -0.2f);
    const Environment sky = panorama(256, [&](glm::vec3 d) { return glm::vec3(1.0f + glm::dot(d, a)); });
    const glm::dvec3 N = glm::normalize(glm::dvec3(1.0, 2.0, 0.5));
    const auto parts = ReflectionReference(sky).parts(N, N, 0.7);
    EXPECT_NEAR(parts.irradiance.x, 1.0 + 2.0 / 3.0 * glm::dot(N, glm::dvec3(a)), 2e-4);
}

TEST(ReflectionReference, does_not_depend_on_how_the_sky_is_cut_into_texels) {
    // The same quarters of the sphere as 4 × 2 and as 128 × 64 texels.
    const auto quarters = [](glm::vec3 d) {
        return glm::vec3(d.x > 0.0f ? 3.0f : 0.2f, d.y > 0.0f ? 1.0f : 0.1f, d.z > 0.0f ? 0.5f : 2.0f);
    };
    const Environment coarse = panorama(4, quarters), fine = panorama(128, quarters);
    for (const double roughness : {0.08, 0.3, 0.8}) {
        const ReflectingSurface surface{{0.9, 0.5, 0.2}, 0.6, roughness};
        const glm::dvec3 N = glm::normalize(glm::dvec3(0.3, 0.4, 0.8)),
                         V = glm::normalize(glm::dvec3(0.9, 0.2, 0.3));
        const glm::dvec3 one = ReflectionReference(coarse).radiance(N, V, surface);
        const glm::dvec3 two = ReflectionReference(fine).radiance(N, V, surface);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(one[c] / two[c], 1.0, 5e-5) << roughness;
    }
}

TEST(LowDiscrepancy, points_fill_every_elementary_interval_once) {
    for (const std::uint64_t seed : {1ull, 99ull}) {
        for (int first = 0; first < 128; first += 64)
            for (int k = 0; k <= 6; ++k) {  // 2^k columns, 2^(6−k) rows
                std::set<std::pair<int, int>> cells;
                for (int i = first; i < first + 64; ++i) {
                    const glm::dvec3 u = scrambled_sobol(std::uint32_t(i), seed);
                    cells.insert({int(u.x * (1 << k)), int(u.y * (1 << (6 - k)))});
                }
                EXPECT_EQ(cells.size(), 64u) << seed << " " << k;
            }
        std::set<int> third;
        for (int i = 0; i < 64; ++i) third.insert(int(scrambled_sobol(std::uint32_t(i), seed).z * 64));
        EXPECT_EQ(third.size(), 64u);
    }
}

glm::dvec3 shuffled_sobol(std::uint32_t index, std::uint64_t seed) {
    return scrambled_sobol(shuffled_index(index, seed), seed);
}

TEST(LowDiscrepancy, shuffled_points_are_as_even_and_meet_all_others) {
    for (int first = 0; first < 128; first += 64) {
        std::set<std::pair<int, int>> cells;
        for (int i = first; i < first + 64; ++i) {
            const glm::dvec3 u = shuffled_sobol(std::uint32_t(i), 5);
            cells.insert({int(u.x * 8), int(u.y * 8)});
        }
        EXPECT_EQ(cells.size(), 64u);
    }
    // Halves of two dimensions of two sequences side by side, in order and with one of them shuffled.
    const auto together = [](auto other) {
        double sum = 0.0;
        for (std::uint32_t i = 0; i < 1024; ++i)
            sum += (scrambled_sobol(i, 1).x < 0.5 ? 1.0 : -1.0) * (other(i, 2ull).x < 0.5 ? 1.0 : -1.0);
        return std::abs(sum) / 1024;
    };
    EXPECT_GT(together(scrambled_sobol), 0.99) << "no need to shuffle";
    EXPECT_LT(together(shuffled_sobol), 0.2);
}

TEST(LowDiscrepancy, eight_hands_hold_the_whole_sequence_and_each_is_even) {
    constexpr int points = 64;
    std::set<std::uint32_t> all;
    for (int hand = 0; hand < 8; ++hand) {
        std::array<std::array<int, 16>, 3> filled{};
        std::array<std::array<int, 4>, 4> squares{};
        for (int i = 0; i < points; ++i) {
            const std::uint32_t index = index_in_hand(std::uint32_t(i), hand);
            EXPECT_EQ(index / 8, std::uint32_t(i));
            all.insert(index);
            const glm::dvec3 u = scrambled_sobol(index, 7);
            for (int d = 0; d < 3; ++d) ++filled[d][std::size_t(u[d] * 16)];
            ++squares[std::size_t(u.x * 4)][std::size_t(u.y * 4)];
        }
        for (const auto& row : filled)
            for (const int count : row) EXPECT_EQ(count, points / 16) << hand;
        for (const auto& row : squares)
            for (const int count : row) EXPECT_NEAR(count, points / 16, 2) << hand;
    }
    EXPECT_EQ(all.size(), 8u * points);
}

TEST(LowDiscrepancy, eight_hands_err_less_together_than_their_scatter_says) {
    // Half of a cube, cut slantwise, as a lamp's border cuts what is reflected.
    const auto cut = [](glm::dvec3 u) { return u.x + 0.7 * u.y + 0.4 * u.z < 1.05 ? 1.0 : 0.0; };
    for (const int points : {24, 64, 200}) {
        double error2 = 0.0, told2 = 0.0;
        constexpr int seeds = 200;
        for (int seed = 0; seed < seeds; ++seed) {
            double mean = 0.0, squares = 0.0;
            for (int hand = 0; hand < 8; ++hand) {
                double sum = 0.0;
                for (int i = 0; i < points; ++i)
                    sum += cut(scrambled_sobol(index_in_hand(std::uint32_t(i), hand), std::uint64_t(seed)));
                mean += sum / points / 8;
                squares += sum / points * sum / points / 8;
            }
            error2 += (mean - 0.5) * (mean - 0.5);
            told2 += (squares - mean * mean) / 7;
        }
        EXPECT_LT(std::sqrt(error2 / told2), 0.8) << points;
    }
}

}  // namespace
}  // namespace patina
