#include "renderer/ibl/bake.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patina {
namespace {

/// Albedo near the corner NoV = 1, roughness = 1, extrapolated linearly from the outermost texels.
double corner(const BrdfTable& t) {
    const auto e = [&](int x, int y) {
        const glm::vec2 ab = t.ab[std::size_t(y) * t.size + x];
        return double(ab.x) + ab.y;
    };
    const int n = t.size - 1;
    return e(n, n) + (e(n, n) - e(n - 1, n)) / 2 + (e(n, n) - e(n, n - 1)) / 2;
}

TEST(BrdfTable, gives_one_minus_ln_two_head_on_at_full_roughness) {
    EXPECT_NEAR(corner(bake_brdf_table()), 1.0 - std::log(2.0), 1e-4);
}

TEST(BrdfTable, never_reflects_more_than_it_receives) {
    const BrdfTable table = bake_brdf_table(64);
    for (const glm::vec2& ab : table.ab) {
        EXPECT_GE(ab.x, 0.0f);
        EXPECT_GE(ab.y, 0.0f);
        EXPECT_LE(ab.x + ab.y, 1.0f);
    }
}

TEST(BrdfTable, is_nearly_white_where_it_is_smooth) {
    const BrdfTable table = bake_brdf_table();
    for (int x = 16; x < table.size; ++x) EXPECT_NEAR(table.ab[x].x + table.ab[x].y, 1.0f, 1e-3f);
}

/// Average albedo 2∫E(μ)μ dμ of the row of a roughness.
double average_albedo(const BrdfTable& t, double roughness) {
    const double row = roughness * t.size - 0.5;
    const int y = std::min(int(row), t.size - 2);
    double sum = 0.0, weight = 0.0;
    for (int x = 0; x < t.size; ++x) {
        const double root = (x + 0.5) / t.size;
        const double w = root * root * root;  // μ dμ with μ = root²
        const glm::vec2 a = t.ab[std::size_t(y) * t.size + x], b = t.ab[std::size_t(y + 1) * t.size + x];
        sum += w * ((1.0 - (row - y)) * (a.x + a.y) + (row - y) * (b.x + b.y));
        weight += w;
    }
    return sum / weight;
}

TEST(BrdfTable, has_the_known_average_albedos) {
    const BrdfTable table = bake_brdf_table();
    EXPECT_NEAR(average_albedo(table, 0.5), 0.8823, 3e-4);
    EXPECT_NEAR(average_albedo(table, 0.75), 0.6562, 3e-4);
    EXPECT_NEAR(average_albedo(table, 1.0), 0.4091, 3e-4);
}

}  // namespace
}  // namespace patina
