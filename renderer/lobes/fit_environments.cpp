#include "renderer/lobes/fit_environments.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace patina::lobes {

namespace {

using glm::vec3;

/// Knuth's 64-bit congruential generator: the same numbers everywhere.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {
        for (int i = 0; i < 5; ++i) (*this)();
    }
    float operator()() {
        state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
        return float(double(state_ >> 33) / 2147483648.0);
    }
    vec3 direction(float lowest, float highest) {
        const float y = lowest + (highest - lowest) * (*this)(), azimuth = 6.2831853f * (*this)();
        const float s = std::sqrt(1.0f - y * y);
        return {s * std::cos(azimuth), y, s * std::sin(azimuth)};
    }

private:
    std::uint64_t state_;
};

/// A rectangle at distance 1, soft at its rim.
struct Box {
    vec3 normal, right, up;
    float half_width, half_height, softness, radiance;

    float light(vec3 d) const {
        const float z = glm::dot(d, normal);
        if (z <= 0.0f) return 0.0f;
        const auto inside = [this](float at, float half) {
            return glm::smoothstep(0.0f, 1.0f, (half + softness - std::abs(at)) / (2.0f * softness));
        };
        return radiance * inside(glm::dot(d, right) / z, half_width) *
               inside(glm::dot(d, up) / z, half_height);
    }
};

Box make_box(vec3 normal, glm::vec2 half, float radiance, float softness) {
    const vec3 axis = std::abs(normal.y) > 0.95f ? vec3(1, 0, 0) : vec3(0, 1, 0);
    const vec3 right = glm::normalize(glm::cross(axis, normal));
    return {normal, right, glm::cross(normal, right), half.x, half.y, softness, radiance};
}

std::vector<Box> make_boxes(int kind, Random& random) {
    std::vector<Box> boxes;
    const auto add = [&](vec3 n, float w, float h, float L, float soft) {
        boxes.push_back(make_box(n, {w, h}, L, soft));
    };
    if (kind == 0)  // a studio's softboxes
        for (int i = 0; i < 3; ++i) {
            const vec3 n = random.direction(-0.1f, 0.8f);
            const float w = 0.15f + 0.35f * random(), h = 0.2f + 0.5f * random();
            add(n, w, h, 20.0f + 60.0f * random(), 0.02f);
        }
    if (kind == 1)  // windows of a room
        for (int i = 0; i < 4; ++i) {
            const vec3 n = random.direction(0.0f, 0.35f);
            const float w = 0.2f + 0.2f * random(), h = 0.3f + 0.2f * random();
            add(n, w, h, 8.0f + 12.0f * random(), 0.005f);
        }
    if (kind == 3)  // many lamps of all sizes
        for (int i = 0; i < 14; ++i) {
            const float size = 0.03f * std::exp(2.8f * random());
            const vec3 n = random.direction(-1.0f, 1.0f);
            const float h = size * (0.5f + random());
            add(n, size, h, 2.0f * std::exp(3.5f * random()), 0.3f * size);
        }
    if (kind == 4)  // a bright floor and one large window
        add(random.direction(0.1f, 0.3f), 0.5f, 0.7f, 15.0f, 0.01f);
    if (kind == 5)  // strip lights
        for (int i = 0; i < 6; ++i) {
            const vec3 n = random.direction(0.2f, 0.95f);
            const float w = 0.02f + 0.03f * random(), h = 0.4f + 0.6f * random();
            add(n, w, h, 25.0f + 30.0f * random(), 0.008f);
        }
    return boxes;
}

/// Seven octaves of waves, about −1…1.
float texture(vec3 d, const float* phase) {
    float sum = 0.0f, amplitude = 0.5f, frequency = 2.0f;
    for (int o = 0; o < 7; ++o, amplitude *= 0.62f, frequency *= 2.1f)
        sum += amplitude * std::sin(frequency * (1.3f * d.x + 0.7f * d.y) + phase[std::ptrdiff_t(3) * o]) *
               std::sin(frequency * (1.1f * d.y - 0.6f * d.z) + phase[3 * o + 1]) *
               std::sin(frequency * (1.2f * d.z + 0.5f * d.x) + phase[3 * o + 2]);
    return sum;
}

float background(int kind, vec3 d, float detail) {
    if (kind == 0) return 0.03f * detail * (d.y < -0.2f ? 2.0f : 0.7f);
    if (kind == 1) return 0.25f * detail;
    if (kind == 2) {
        const float up = std::max(0.0f, d.y),
                    towards_sun = glm::dot(d, glm::normalize(vec3(-0.6f, 0.25f, 0.5f)));
        const float sky =
            d.y > 0.0f ? (0.55f + 0.8f * std::exp(-8.0f * up)) * (0.5f + 0.7f * detail) : 0.1f * detail;
        return sky + 2.5f * std::exp(-20.0f * (1.0f - towards_sun)) +
               50.0f * std::exp(-900.0f * (1.0f - towards_sun));
    }
    if (kind == 4) return (d.y < -0.3f ? 0.9f : 0.2f) * detail;
    return 0.05f * detail;
}

}  // namespace

Environment make_fit_environment(int number, int width) {
    Random random(1000 + 77 * std::uint64_t(number));
    const int kind = number % 6;
    const float ambient = number < 6 ? 1.0f : 2.5f;  // the later ones are brighter between their lamps
    const std::vector<Box> boxes = make_boxes(kind, random);
    float phase[21];
    for (float& p : phase) p = 6.28f * random();
    Environment environment;
    environment.width = width;
    environment.height = width / 2;
    environment.id = environment.title = "fit-" + std::to_string(number);
    for (int y = 0; y < environment.height; ++y) {
        for (int x = 0; x < width; ++x) {
            const vec3 d = equirect_to_direction(
                {(float(x) + 0.5f) / float(width), (float(y) + 0.5f) / float(environment.height)});
            float radiance = ambient * background(kind, d, std::exp(2.0f * texture(d, phase)));
            for (const Box& box : boxes) radiance += box.light(d);
            environment.radiance.emplace_back(radiance);
        }
    }
    environment.content_hash = environment_hash(environment);
    return environment;
}

}  // namespace patina::lobes
