#include "renderer/ibl/brdf_table.h"

#include "renderer/ibl/legendre.h"

#include <glm/common.hpp>
#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_double3.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

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

/// A and B by an independent rule: all visible normals, Gauss in height and equal steps in azimuth.
glm::dvec2 exact_albedo(double NoV, double alpha) {
    constexpr int kHeights = 400, kAzimuths = 200;
    const double sin_v = std::sqrt(1.0 - NoV * NoV), a2 = alpha * alpha;
    const double length = std::sqrt(a2 * sin_v * sin_v + NoV * NoV);
    const double vx = alpha * sin_v / length, vz = NoV / length;
    const auto lambda = [&](double c) { return 0.5 * (std::sqrt(1.0 + a2 * (1.0 - c * c) / (c * c)) - 1.0); };
    const GaussNodes gauss(kHeights);
    glm::dvec2 sum(0.0);
    for (int i = 0; i < kHeights; ++i)
        for (int j = 0; j < kAzimuths; ++j) {
            const double z = 1.0 - (1.0 + vz) * gauss.x[i] * gauss.x[i];
            const double phi = std::numbers::pi * (j + 0.5) / kAzimuths,
                         ring = std::sqrt(std::max(0.0, 1.0 - z * z));
            glm::dvec3 H(alpha * (ring * std::cos(phi) + vx), alpha * ring * std::sin(phi), z + vz);
            H = glm::normalize(H);
            const double VoH = H.x * sin_v + H.z * NoV, NoL = 2.0 * VoH * H.z - NoV;
            if (NoL <= 0.0) continue;
            const double weight = 2.0 * gauss.x[i] * gauss.weight[i] / kAzimuths;
            const double g = weight * (1.0 + lambda(NoV)) / (1.0 + lambda(NoV) + lambda(NoL));
            const double fresnel = std::pow(1.0 - VoH, 5.0);
            sum += g * glm::dvec2(1.0 - fresnel, fresnel);
        }
    return sum;
}

/// As a texture unit fetches it, 16 bits, bilinear: x and y in texels.
glm::dvec2 fetch(const BrdfTable& table, double x, double y) {
    x = std::clamp(x, 0.0, table.size - 1.0);
    y = std::clamp(y, 0.0, table.size - 1.0);
    const int x0 = std::min(int(x), table.size - 2), y0 = std::min(int(y), table.size - 2);
    const auto at = [&](int dx, int dy) {
        const glm::dvec2 ab = table.ab[std::size_t(y0 + dy) * table.size + x0 + dx];
        return glm::round(ab * 65535.0) / 65535.0;
    };
    return glm::mix(glm::mix(at(0, 0), at(1, 0), x - x0), glm::mix(at(0, 1), at(1, 1), x - x0), y - y0);
}

struct FetchErrors {
    double square = 0.0, largest = 0.0;
    int count = 0;
    void add(glm::dvec2 error) {
        largest = std::max({largest, std::abs(error.x), std::abs(error.y)});
        square += error.x * error.x + error.y * error.y;
        count += 2;
    }
    double rms() const { return std::sqrt(square / count); }
};
/// Two numbers in [0, 1), well spread over the square.
glm::dvec2 spread(int i) {
    return {std::fmod((i + 0.5) * 0.7548776662466927, 1.0), std::fmod((i + 0.5) * 0.5698402909980532, 1.0)};
}

TEST(BrdfTable, is_accurate_as_fetched) {
    const BrdfTable table = bake_brdf_table();
    const double last = 1.0 - 0.5 / table.size;  // beyond the outermost texels' centres a fetch is constant
    FetchErrors errors;
    for (int i = 0; i < 150; ++i) {
        const double root = std::lerp(0.1, last, spread(i).x), roughness = std::lerp(0.03, last, spread(i).y);
        errors.add(fetch(table, root * table.size - 0.5, roughness * table.size - 0.5) -
                   exact_albedo(root * root, roughness * roughness));
    }
    EXPECT_LE(errors.rms(), 1e-4);
    EXPECT_LE(errors.largest, 5e-4);
}

TEST(BrdfTable, from_end_to_end_is_accurate_everywhere) {
    const BrdfTable table = bake_end_to_end_brdf_table(256);
    FetchErrors errors;
    for (int i = 0; i < 160; ++i) {
        const bool at_end = i % 4 == 0;  // head on, or entirely rough
        const double root = at_end && i % 8 == 0 ? 1.0 : std::lerp(0.06, 1.0, spread(i).x);
        const double roughness = at_end && i % 8 != 0 ? 1.0 : std::lerp(0.02, 1.0, spread(i).y);
        errors.add(fetch(table, root * (table.size - 1), roughness * (table.size - 1)) -
                   exact_albedo(root * root, roughness * roughness));
    }
    EXPECT_LE(errors.rms(), 1e-4);
    EXPECT_LE(errors.largest, 5e-4);
    EXPECT_NEAR(double(table.ab.back().x + table.ab.back().y), 1.0 - std::log(2.0), 1e-4);
    const glm::vec2 mirror = table.ab[std::size_t(table.size) - 1];
    EXPECT_NEAR(double(mirror.x + mirror.y), 1.0, 1e-4);
}

}  // namespace
}  // namespace patina
