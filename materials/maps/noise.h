// Noise that repeats across the unit square and gives the same bits everywhere: integer hashes, polynomials
// and square roots, no library random numbers and no sines.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace patina::maps {

inline std::uint32_t hash(std::uint32_t x, std::uint32_t y, std::uint32_t seed) {
    std::uint32_t h = x * 0x8da6b343u ^ y * 0xd8163841u ^ seed * 0xcb1ab31fu;
    h = (h ^ (h >> 16)) * 0x85ebca6bu;  // MurmurHash3's finaliser
    h = (h ^ (h >> 13)) * 0xc2b2ae35u;
    return h ^ (h >> 16);
}
/// 0…1, uniform.
inline float random01(int x, int y, std::uint32_t seed) {
    return static_cast<float>(hash(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), seed) >> 8) *
           0x1p-24f;
}
inline float random_signed(int x, int y, std::uint32_t seed) { return 2.0f * random01(x, y, seed) - 1.0f; }

inline float saturate(float x) { return std::clamp(x, 0.0f, 1.0f); }
inline float smoothstep(float low, float high, float x) {
    const float t = saturate((x - low) / (high - low));
    return t * t * (3.0f - 2.0f * t);
}
inline float mix(float a, float b, float t) { return a + (b - a) * t; }
inline glm::vec3 mix(glm::vec3 a, glm::vec3 b, float t) { return a + (b - a) * t; }
inline int wrap(int i, int period) { return ((i % period) + period) % period; }
/// 0 at whole numbers, 1 half way between.
inline float triangle(float x) { return 1.0f - std::abs(2.0f * (x - std::floor(x)) - 1.0f); }

/// Perlin's gradient noise, about −1…1, with `period` cells across the unit square in each direction.
inline float gradient_noise(glm::vec2 uv, glm::ivec2 period, std::uint32_t seed) {
    const glm::vec2 p{uv.x * static_cast<float>(period.x), uv.y * static_cast<float>(period.y)};
    const glm::ivec2 cell{static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y))};
    const glm::vec2 f{p.x - static_cast<float>(cell.x), p.y - static_cast<float>(cell.y)};
    const auto corner = [&](int dx, int dy) {
        const int x = wrap(cell.x + dx, period.x);
        const int y = wrap(cell.y + dy, period.y);
        const float gx = random_signed(x, y, seed);
        const float gy = random_signed(x, y, seed + 0x9e3779b9u);
        return gx * (f.x - static_cast<float>(dx)) + gy * (f.y - static_cast<float>(dy));
    };
    const auto fade = [](float t) { return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f); };
    const float low = mix(corner(0, 0), corner(1, 0), fade(f.x));
    const float high = mix(corner(0, 1), corner(1, 1), fade(f.x));
    return 1.6f * mix(low, high, fade(f.y));
}

/// Octaves of it, each twice as fine and half as strong; about −1…1.
inline float fractal_noise(glm::vec2 uv, glm::ivec2 period, int octaves, std::uint32_t seed) {
    float sum = 0.0f;
    float amplitude = 0.5f;
    for (int i = 0; i < octaves; ++i) {
        sum += amplitude * gradient_noise(uv, period, seed + static_cast<std::uint32_t>(i) * 101u);
        amplitude *= 0.5f;
        period *= 2;
    }
    return 1.4f * sum;
}
inline float fractal_noise(glm::vec2 uv, int period, int octaves, std::uint32_t seed) {
    return fractal_noise(uv, glm::ivec2(period), octaves, seed);
}
/// The same place, pushed about by noise of that strength.
inline glm::vec2 warped(glm::vec2 uv, int period, float strength, std::uint32_t seed) {
    return {uv.x + strength * fractal_noise(uv, period, 3, seed),
            uv.y + strength * fractal_noise(uv, period, 3, seed + 7u)};
}

/// The nearest of `cells`² jittered points and the border to its neighbours; lengths in cells.
struct Cell {
    glm::ivec2 id{0};  ///< the same for all of a cell, also across the edge of the square
    glm::vec2 to_point{0.0f};
    float distance = 0.0f;
    float to_border = 0.0f;
};
inline Cell cell_noise(glm::vec2 uv, int cells, float jitter, std::uint32_t seed) {
    const glm::vec2 p{uv.x * static_cast<float>(cells), uv.y * static_cast<float>(cells)};
    const glm::ivec2 home{static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y))};
    const auto point = [&](glm::ivec2 cell) {
        const int x = wrap(cell.x, cells);
        const int y = wrap(cell.y, cells);
        return glm::vec2{static_cast<float>(cell.x) + 0.5f + 0.5f * jitter * random_signed(x, y, seed),
                         static_cast<float>(cell.y) + 0.5f + 0.5f * jitter * random_signed(x, y, seed + 1u)};
    };
    Cell nearest;
    glm::ivec2 nearest_cell{0};
    nearest.distance = std::numeric_limits<float>::max();
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
            const glm::ivec2 cell = home + glm::ivec2(dx, dy);
            const glm::vec2 d = point(cell) - p;
            const float squared = d.x * d.x + d.y * d.y;
            if (squared >= nearest.distance) continue;
            nearest.distance = squared;
            nearest.to_point = d;
            nearest_cell = cell;
        }
    nearest.to_border = std::numeric_limits<float>::max();
    for (int dy = -2; dy <= 2; ++dy)
        for (int dx = -2; dx <= 2; ++dx) {
            const glm::vec2 d = point(nearest_cell + glm::ivec2(dx, dy)) - p;
            const glm::vec2 across = d - nearest.to_point;
            const float length = std::sqrt(across.x * across.x + across.y * across.y);
            if (length < 1e-5f) continue;
            const glm::vec2 middle = 0.5f * (d + nearest.to_point);
            nearest.to_border =
                std::min(nearest.to_border, (middle.x * across.x + middle.y * across.y) / length);
        }
    nearest.distance = std::sqrt(nearest.distance);
    nearest.id = {wrap(nearest_cell.x, cells), wrap(nearest_cell.y, cells)};
    return nearest;
}

}  // namespace patina::maps
