#include "tests/unit/ibl/oracle.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

namespace patina::test {
namespace {

constexpr double kPi = std::numbers::pi;

glm::dvec3 direction(double theta, double phi) {
    return {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
}

void set_hash(Environment& environment) {
    std::uint64_t hash = 1469598103934665603u;
    for (const glm::vec3& value : environment.radiance)
        for (int c = 0; c < 3; ++c) {
            std::uint32_t bits;
            std::memcpy(&bits, &value[c], 4);
            hash = (hash ^ bits) * 1099511628211u;
        }
    environment.content_hash = hash + std::uint64_t(environment.width);
}

/// Part of the sphere between colatitudes t0, t1 and azimuths p0, p1.
struct Cell {
    double t0, t1, p0, p1;
};

double kernel_at(glm::dvec3 N, glm::dvec3 L, double alpha2) {
    const double NoL = glm::dot(N, L);
    if (NoL <= 0.0) return 0.0;
    const glm::dvec3 apart = N - L;
    const double sin2 = glm::dot(apart, apart) / 4.0;  // of the half angle, without cancellation
    const double d = sin2 + alpha2 * (1.0 - sin2);
    return NoL * alpha2 / (d * d);
}

/// ∫ K over a cell: split until it is small against the lobe, which widens as the power law does with the
/// distance; then Gauss's rule of 3 × 3 points.
double cell_kernel(const Cell& cell, glm::dvec3 N, double alpha) {
    const double t = (cell.t0 + cell.t1) / 2, p = (cell.p0 + cell.p1) / 2;
    const double height = cell.t1 - cell.t0;
    const double sine =
        cell.t0 < kPi / 2 && cell.t1 > kPi / 2 ? 1.0 : std::max(std::sin(cell.t0), std::sin(cell.t1));
    const double width = (cell.p1 - cell.p0) * sine;
    const double angle = std::acos(std::clamp(glm::dot(direction(t, p), N), -1.0, 1.0));
    const double nearest = std::max(0.0, angle - 0.5 * std::hypot(height, width));
    if (std::max(height, width) > 0.5 * std::max(alpha, 0.5 * nearest)) {
        const bool by_height = height > width;
        const Cell one = by_height ? Cell{cell.t0, t, cell.p0, cell.p1} : Cell{cell.t0, cell.t1, cell.p0, p};
        const Cell two = by_height ? Cell{t, cell.t1, cell.p0, cell.p1} : Cell{cell.t0, cell.t1, p, cell.p1};
        return cell_kernel(one, N, alpha) + cell_kernel(two, N, alpha);
    }
    constexpr double kNode[3] = {-0.774596669241483377, 0.0, 0.774596669241483377};
    constexpr double kWeight[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    double total = 0.0;
    for (int i = 0; i < 9; ++i) {
        const double theta = t + 0.5 * height * kNode[i / 3];
        const double phi = p + 0.5 * (cell.p1 - cell.p0) * kNode[i % 3];
        total += kWeight[i / 3] * kWeight[i % 3] * std::sin(theta) *
                 kernel_at(N, direction(theta, phi), alpha * alpha);
    }
    return total * height * (cell.p1 - cell.p0);
}

}  // namespace

Environment make_panorama(int width, int height, const std::function<glm::dvec3(glm::dvec3)>& radiance) {
    Environment e;
    e.id = "made";
    e.width = width;
    e.height = height;
    constexpr int kSub = 3;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            glm::dvec3 sum(0.0);
            for (int k = 0; k < kSub * kSub; ++k)
                sum += radiance(direction((y + (k / kSub + 0.5) / kSub) * kPi / height,
                                          (x + (k % kSub + 0.5) / kSub) * 2.0 * kPi / width - kPi));
            e.radiance.push_back(glm::vec3(sum / double(kSub * kSub)));
        }
    set_hash(e);
    return e;
}

Environment constant_panorama(int width, int height, glm::vec3 value) {
    return make_panorama(width, height, [&](glm::dvec3) { return glm::dvec3(value); });
}

Environment sunny_panorama(int width, int height, double sun_radiance, double sun_radius_rad) {
    const glm::dvec3 sun = glm::normalize(glm::dvec3(0.4, 0.6, -0.7));
    return make_panorama(width, height, [&](glm::dvec3 d) {
        const double up = 0.5 + 0.5 * d.y;
        glm::dvec3 c =
            d.y > 0 ? glm::dvec3(0.6 - 0.3 * up, 0.75 - 0.3 * up, 0.9) : glm::dvec3(0.25, 0.2, 0.15);
        c *= 1.0 + 0.5 * std::sin(9 * d.x + 3 * d.y) * std::sin(7 * d.z - 2 * d.x) +
             0.3 * std::sin(41 * d.x) * std::sin(37 * d.z) * std::sin(31 * d.y);
        if (glm::dot(d, sun) > std::cos(sun_radius_rad)) c += glm::dvec3(1.0, 0.95, 0.85) * sun_radiance;
        return c;
    });
}

Environment studio_panorama(int width, int height) {
    return make_panorama(width, height, [](glm::dvec3 d) {
        glm::dvec3 c(0.02, 0.02, 0.025);
        if (d.y > 0.7 && std::abs(d.x) < 0.4) c = glm::dvec3(30.0, 28.0, 25.0);
        if (d.x > 0.8 && std::abs(d.y) < 0.3 && std::abs(d.z) < 0.5) c = glm::dvec3(8.0, 9.0, 12.0);
        if (d.z > 0.9 && d.y > 0.1 && d.y < 0.3) c = glm::dvec3(60.0);
        return c;
    });
}

Environment noise_panorama(int width, int height, unsigned seed) {
    Environment e = constant_panorama(width, height, glm::vec3(0.0f));
    std::mt19937 random(seed);
    for (glm::vec3& value : e.radiance)
        for (int c = 0; c < 3; ++c) value[c] = float(random() >> 8) * 0x1p-24f;
    set_hash(e);
    return e;
}

glm::dvec3 mean_radiance(const Environment& e) {
    glm::dvec3 sum(0.0);
    for (int y = 0; y < e.height; ++y) {
        const double area =
            (std::cos(y * kPi / e.height) - std::cos((y + 1) * kPi / e.height)) * 2.0 * kPi / e.width;
        for (int x = 0; x < e.width; ++x) sum += area * glm::dvec3(e.radiance[std::size_t(y) * e.width + x]);
    }
    return sum / (4.0 * kPi);
}

double kernel_integral(double alpha) {
    const double a = alpha * alpha, q = (1.0 - a) / 2.0;
    if (q < 1e-6) return kPi;
    return 2.0 * kPi * a / q * ((1.0 + a / q) * (1.0 / a - 1.0 / (q + a)) - std::log((q + a) / a) / q);
}

glm::dvec3 prefiltered_radiance(const Environment& e, glm::dvec3 N, double roughness) {
    const double alpha = roughness * roughness;
    glm::dvec3 sum(0.0);
    for (int y = 0; y < e.height; ++y)
        for (int x = 0; x < e.width; ++x) {
            const glm::dvec3 L = e.radiance[std::size_t(y) * e.width + x];
            if (L == glm::dvec3(0.0)) continue;
            const Cell texel = {y * kPi / e.height, (y + 1) * kPi / e.height, x * 2.0 * kPi / e.width - kPi,
                                (x + 1) * 2.0 * kPi / e.width - kPi};
            sum += cell_kernel(texel, N, alpha) * L;
        }
    return sum / kernel_integral(alpha);
}

ScratchFolder::ScratchFolder() {
    std::random_device random;
    path_ = std::filesystem::temp_directory_path() /
            ("patina-ibl-" + std::to_string(random()) + std::to_string(random()));
    std::filesystem::create_directories(path_);
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace patina::test
