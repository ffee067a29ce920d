// Daylight: clear sky, sunset, overcast.
#include "renderer/core/builtin_env.h"
#include "renderer/core/sky_model.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patina {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

struct Daylight {
    glm::vec3 sun_direction{0.0f, 1.0f, 0.0f};
    float turbidity = 3.0f;
    glm::vec3 ground_albedo{0.2f};
    float units_per_kcd = 1.0f;  ///< radiance stored for 1 kcd/m²
};

/// Light on the ground: ∫ L cos θ dω over the upper half, and the sun.
glm::vec3 ground_irradiance(const PreethamSky& sky) {
    constexpr int rings = 64;
    constexpr int sectors = 128;
    glm::vec3 sum(0.0f);
    for (int i = 0; i < rings; ++i) {
        // Equal steps of sin² θ make every sample weigh the same: cos θ dω = ½ d(sin² θ) dφ.
        const float sine_squared = (static_cast<float>(i) + 0.5f) / rings;
        const float sine = std::sqrt(sine_squared);
        for (int j = 0; j < sectors; ++j) {
            const float azimuth = 2.0f * kPi * (static_cast<float>(j) + 0.5f) / sectors;
            sum += sky.radiance(
                {sine * std::sin(azimuth), std::sqrt(1.0f - sine_squared), sine * std::cos(azimuth)});
        }
    }
    const float sun_solid_angle = 2.0f * kPi * (1.0f - std::cos(kSunAngularRadius));
    return sum * (kPi / (rings * sectors)) + sky.sun_radiance() * (sun_solid_angle * sky.sun_direction().y);
}

/// Far ground is seen through air as bright as the horizon: how much of it is ground.
float ground_clarity(float sine_below) {
    constexpr float haze = 0.04f;
    return 1.0f - 0.75f * std::exp(-sine_below / haze);
}

Environment make_daylight(int width, const Daylight& daylight) {
    const PreethamSky sky(daylight.sun_direction, daylight.turbidity);
    const glm::vec3 ground = daylight.ground_albedo / kPi * ground_irradiance(sky);
    const float scale = daylight.units_per_kcd;
    Environment environment = paint_environment(width, [&](const glm::vec3& direction) -> PaintedPoint {
        if (direction.y >= 0.0f) return {scale * sky.radiance(direction), 0};
        const float clarity = ground_clarity(-direction.y);
        if (clarity > 0.999f) return {scale * ground, 1};
        const glm::vec3 horizon = sky.radiance(glm::normalize(glm::vec3(direction.x, 0.0f, direction.z)));
        return {scale * glm::mix(horizon, ground, clarity), 1};
    });
    add_disc(environment, {.direction = sky.sun_direction(),
                           .angular_radius = kSunAngularRadius,
                           .radiance = scale * sky.sun_radiance(),
                           .limb_darkening = 0.6f});
    return environment;
}

}  // namespace

Environment make_sky(int width) {
    return make_daylight(width, {.sun_direction = {-0.55f, 0.7f, 0.45f},
                                 .turbidity = 2.8f,
                                 .ground_albedo = {0.21f, 0.21f, 0.17f},
                                 .units_per_kcd = 1.0f / 20.0f});
}

Environment make_sunset(int width) {
    return make_daylight(width, {.sun_direction = {0.76f, 0.085f, -0.64f},
                                 .turbidity = 3.6f,
                                 .ground_albedo = {0.21f, 0.18f, 0.15f},
                                 .units_per_kcd = 1.0f / 5.5f});
}

Environment make_overcast(int width) {
    constexpr glm::vec3 zenith{1.36f, 1.40f, 1.48f};
    constexpr glm::vec3 ground_albedo{0.25f, 0.24f, 0.22f};
    // Under the overcast sky of unit zenith the ground receives 7π/9.
    const glm::vec3 ground = ground_albedo * zenith * (7.0f / 9.0f);
    return paint_environment(width, [=](const glm::vec3& direction) -> PaintedPoint {
        const glm::vec3 sky = zenith * overcast_luminance(std::max(direction.y, 0.0f));
        if (direction.y >= 0.0f) return {sky, 0};
        return {glm::mix(sky, ground, ground_clarity(-direction.y)), 1};
    });
}

}  // namespace patina
