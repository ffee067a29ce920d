// A photographer's studio: a dark round room with softboxes, and the constant furnace.
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

/// The room's shape, in metres around the object: |x, z| / radius and y / height, each to the sixth power,
/// sum to 1: walls, floor and ceiling that run into each other in coves, as in a photographer's cyclorama.
constexpr float kRoomRadius = 6.5f;
constexpr float kFloorDepth = 1.4f;
constexpr float kCeilingHeight = 5.2f;
constexpr float kWallAlbedo = 0.20f;
constexpr float kFloorAlbedo = 0.11f;
constexpr float kBounce = 0.15f;  // light that has met more than one wall, as irradiance

/// A spot on the wall behind the object.
constexpr glm::vec3 kBackdropSpot{0.0f, 0.2f, -6.5f};
constexpr float kBackdropSize = 3.2f;
constexpr glm::vec3 kBackdropRadiance{0.30f, 0.31f, 0.33f};

/// A rectangular lamp behind cloth that faces the object.
struct Softbox {
    glm::vec3 centre;
    glm::vec2 half_size;  ///< metres: across, up
    glm::vec3 radiance;   ///< in the middle
    float rim = 0.5f;     ///< brightness at the border over that of the middle
};
constexpr std::array kSoftboxes{
    Softbox{{-3.1f, 2.3f, 2.6f}, {1.25f, 1.25f}, {22.0f, 21.2f, 20.0f}, 0.35f},  // key, front left
    Softbox{{4.2f, 0.9f, 1.7f}, {0.45f, 1.7f}, {5.6f, 5.9f, 6.4f}, 0.6f},        // fill, right
    Softbox{{2.9f, 1.4f, -3.9f}, {0.09f, 1.5f}, {92.0f, 95.0f, 100.0f}, 0.8f},   // rim, behind right
    Softbox{{-4.0f, 1.1f, -3.0f}, {0.07f, 1.4f}, {62.0f, 60.0f, 57.0f}, 0.8f},   // rim, behind left
    Softbox{{0.3f, 4.4f, -0.6f}, {1.7f, 0.8f}, {5.0f, 5.0f, 5.0f}, 0.4f},        // overhead
};

/// The lamp with its frame of axes worked out.
struct Lamp {
    explicit Lamp(const Softbox& softbox)
        : box(softbox), distance(glm::length(softbox.centre)), normal(-softbox.centre / distance) {
        const glm::vec3 pole = std::abs(normal.y) > 0.9f ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0);
        right = glm::normalize(glm::cross(pole, normal));
        up = glm::cross(normal, right);
        area = 4.0f * softbox.half_size.x * softbox.half_size.y;
    }
    Softbox box;
    float distance;
    glm::vec3 normal;
    glm::vec3 right{};
    glm::vec3 up{};
    float area = 0.0f;
};

/// Signed distance to a rectangle with rounded corners, negative inside.
float rounded_distance(glm::vec2 point, glm::vec2 half_size, float corner) {
    const glm::vec2 q = glm::abs(point) - half_size + corner;
    return glm::length(glm::max(q, 0.0f)) + std::min(std::max(q.x, q.y), 0.0f) - corner;
}

/// Brightness of the cloth where the direction meets it, 0…1, 0 beside it.
float cloth(const Lamp& lamp, const glm::vec3& direction) {
    const float towards = -glm::dot(direction, lamp.normal);
    if (towards <= 0.0f) return 0.0f;
    const glm::vec3 point = direction * (lamp.distance / towards);
    const glm::vec2 at{glm::dot(point, lamp.right), glm::dot(point, lamp.up)};
    const glm::vec2 size = lamp.box.half_size;
    if (std::abs(at.x) > size.x || std::abs(at.y) > size.y) return 0.0f;
    const float corner = 0.3f * std::min(size.x, size.y);
    const float edge = std::min(0.06f, corner);
    const float inside = glm::smoothstep(0.0f, edge, -rounded_distance(at, size, corner));
    const glm::vec2 relative = at / size;
    const float middle = std::exp(-2.2f * glm::dot(relative, relative));
    return inside * glm::mix(lamp.box.rim, 1.0f, middle);
}

/// Irradiance on a wall: each lamp as one point, kept finite close to it. A softbox's grid narrows its light:
/// cos² of the angle from its axis, with the same flux as a bare one.
glm::vec3 wall_irradiance(const std::vector<Lamp>& lamps, const glm::vec3& point, const glm::vec3& normal) {
    glm::vec3 sum(kBounce);
    for (const Lamp& lamp : lamps) {
        const glm::vec3 to_lamp = lamp.box.centre - point;
        const float square = glm::dot(to_lamp, to_lamp);
        const float at_wall = std::max(0.0f, glm::dot(normal, to_lamp));
        const float at_lamp = std::max(0.0f, -glm::dot(lamp.normal, to_lamp));
        const float mean_times_area = 0.6f * lamp.area;
        sum += lamp.box.radiance * (1.5f * mean_times_area * at_wall * at_lamp * at_lamp /
                                    (square * std::sqrt(square) * (square + lamp.area / kPi)));
    }
    return sum;
}

glm::vec3 room(const std::vector<Lamp>& lamps, const glm::vec3& direction) {
    const auto fifth_power = [](float x) { return x * x * x * x * x; };
    const float height = direction.y < 0.0f ? kFloorDepth : kCeilingHeight;
    const float across = std::sqrt(direction.x * direction.x + direction.z * direction.z);
    const float flat = across / kRoomRadius;
    const float steep = std::abs(direction.y) / height;
    const float flat_slope = fifth_power(flat);
    const float steep_slope = fifth_power(steep);
    const glm::vec3 point = direction / std::cbrt(std::sqrt(flat_slope * flat + steep_slope * steep));
    const float outward = across > 0.0f ? flat_slope / kRoomRadius / across : 0.0f;
    const glm::vec3 normal = -glm::normalize(glm::vec3(
        outward * direction.x, std::copysign(steep_slope / height, direction.y), outward * direction.z));
    const glm::vec3 from_spot = point - kBackdropSpot;
    const float spot = std::exp(-glm::dot(from_spot, from_spot) / (kBackdropSize * kBackdropSize));
    const float albedo = glm::mix(kWallAlbedo, kFloorAlbedo, std::max(normal.y, 0.0f));
    return albedo / kPi * wall_irradiance(lamps, point, normal) + spot * kBackdropRadiance;
}

}  // namespace

Environment make_studio(int width) {
    const std::vector<Lamp> lamps(kSoftboxes.begin(), kSoftboxes.end());
    return paint_environment(width, [&](const glm::vec3& direction) -> PaintedPoint {
        for (std::size_t i = 0; i < lamps.size(); ++i) {
            const float brightness = cloth(lamps[i], direction);
            if (brightness <= 0.0f) continue;
            return {brightness * lamps[i].box.radiance, static_cast<int>(i) + 1};
        }
        return {room(lamps, direction), 0};
    });
}

Environment make_furnace(int width) {
    return paint_environment(width, [](const glm::vec3&) -> PaintedPoint { return {glm::vec3(1.0f), 0}; });
}

}  // namespace patina
