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
