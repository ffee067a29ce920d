// A square at night: a dark blue sky, lamps of many colours, the pools of light below them, a town on the
// horizon.
#include "renderer/core/builtin_env.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace patina {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kGround = -1.3f;  // metres below the object
constexpr float kGroundAlbedo = 0.14f;

/// A glowing ball.
struct Bulb {
    glm::vec3 position;  ///< metres
    float radius;
    glm::vec3 radiance;
};
constexpr std::array kBulbs{
    Bulb{{-2.6f, 3.4f, 2.7f}, 0.090f, {1700.0f, 1200.0f, 720.0f}},  // street lamp, warm
    Bulb{{3.3f, 2.6f, 1.9f}, 0.065f, {900.0f, 1080.0f, 1300.0f}},   // street lamp, cool
    Bulb{{-4.2f, 3.0f, -4.4f}, 0.100f, {1100.0f, 560.0f, 130.0f}},  // sodium
    Bulb{{0.6f, 4.6f, -2.2f}, 0.055f, {620.0f, 520.0f, 380.0f}},    // window
    Bulb{{3.6f, 1.2f, -3.4f}, 0.075f, {60.0f, 520.0f, 700.0f}},     // cyan sign
    Bulb{{-3.4f, 0.5f, -0.9f}, 0.065f, {620.0f, 50.0f, 330.0f}},    // magenta sign
    Bulb{{1.1f, 0.5f, -5.0f}, 0.070f, {110.0f, 480.0f, 130.0f}},    // traffic light, green
    Bulb{{5.0f, 0.3f, -1.3f}, 0.055f, {640.0f, 40.0f, 26.0f}},      // rear light, red
};

glm::vec3 night_sky(float sine_of_elevation) {
    constexpr glm::vec3 zenith{0.006f, 0.011f, 0.030f};
    constexpr glm::vec3 low_sky{0.020f, 0.028f, 0.060f};
    constexpr glm::vec3 town_glow{0.110f, 0.062f, 0.030f};
    const float low = 1.0f - sine_of_elevation;
    return zenith + low_sky * (low * low * low) + town_glow * std::exp(-sine_of_elevation / 0.07f);
}

std::vector<Disc> bulb_discs() {
    std::vector<Disc> discs;
    for (const Bulb& bulb : kBulbs) {
        const float distance = glm::length(bulb.position);
        discs.push_back({.direction = bulb.position / distance,
                         .angular_radius = std::asin(bulb.radius / distance),
                         .radiance = bulb.radiance,
                         .limb_darkening = 0.25f});
    }
    return discs;
}

/// What the damp air around the bulbs scatters to the eye: halos that fall off with the angle and end at 14°.
glm::vec3 halos(const std::vector<Disc>& bulbs, const glm::vec3& direction) {
    constexpr float core = 0.02f * 0.02f;  // squared distance (2 − 2 cos) of half brightness
    constexpr float end = 0.06f;
    constexpr float share = 0.0012f;
    glm::vec3 sum(0.0f);
    for (const Disc& bulb : bulbs) {
        const float square = 2.0f - 2.0f * glm::dot(direction, bulb.direction);
        const float fade = 1.0f - square / end;
        if (fade > 0.0f)
            sum += bulb.radiance * (share * fade * fade * core / (core + std::max(square, 0.0f)));
    }
    return sum;
}

/// A ball of radius r at distance d gives π L (r/d)² cos θ.
glm::vec3 lit_ground(const glm::vec3& point) {
    glm::vec3 irradiance = glm::vec3(0.020f, 0.026f, 0.048f) * kPi;
    for (const Bulb& bulb : kBulbs) {
        const glm::vec3 to_bulb = bulb.position - point;
        const float square = glm::dot(to_bulb, to_bulb);
        irradiance +=
            bulb.radiance * (kPi * bulb.radius * bulb.radius * to_bulb.y / (square * std::sqrt(square)));
    }
    return kGroundAlbedo / kPi * irradiance;
}

/// Far windows and lanterns along the horizon, spread by the golden ratio.
void add_town(Environment& environment) {
    constexpr int windows = 72;
    constexpr std::array colors{glm::vec3(1.0f, 0.72f, 0.40f), glm::vec3(1.0f, 0.86f, 0.66f),
                                glm::vec3(1.0f, 0.52f, 0.16f), glm::vec3(0.70f, 0.85f, 1.0f),
                                glm::vec3(1.0f, 0.80f, 0.52f)};
    constexpr float golden = 0.61803399f;
    for (int i = 0; i < windows; ++i) {
        const float turn = static_cast<float>(i) * golden;
        const float spread = static_cast<float>(i) * 0.75487767f;
        const float height = 0.055f * (spread - std::floor(spread)) - 0.004f;
        const float azimuth = 2.0f * kPi * (turn - std::floor(turn));
        const float brightness = 18.0f + 30.0f * static_cast<float>((i * 7) % 11) / 10.0f;
        add_disc(environment,
                 {.direction = glm::normalize(glm::vec3(std::sin(azimuth), height, -std::cos(azimuth))),
                  .angular_radius = 0.0026f,
                  .radiance = brightness * colors[i % colors.size()]});
    }
}

}  // namespace

Environment make_night(int width) {
    const std::vector<Disc> bulbs = bulb_discs();
    Environment environment = paint_environment(width, [&](const glm::vec3& direction) -> PaintedPoint {
        const glm::vec3 glow = halos(bulbs, direction);
        if (direction.y >= 0.0f) return {night_sky(direction.y) + glow, 0};
        const float reach = kGround / direction.y;
        const float clarity = std::exp(-reach / 60.0f);
        return {glm::mix(night_sky(0.0f), lit_ground(direction * reach), clarity) + glow, 1};
    });
    for (const Disc& bulb : bulbs) add_disc(environment, bulb);
    add_town(environment);
    return environment;
}

}  // namespace patina
