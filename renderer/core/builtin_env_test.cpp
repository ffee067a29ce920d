// Labelled directions: a cube of six colours with the axis names written on its faces, and a grid of angles.
#include "renderer/core/builtin_env.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

namespace patina {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// A face as one sees it from the origin: right = forward × up, so that its letters are not mirrored. Looking
/// up or down keeps +X on the right, as when tilting the head while facing −Z.
struct Face {
    glm::vec3 forward, up, color;
    bool positive;
    char axis;
};
constexpr std::array kFaces{
    Face{{1, 0, 0}, {0, 1, 0}, {0.80f, 0.10f, 0.08f}, true, 'X'},
    Face{{-1, 0, 0}, {0, 1, 0}, {0.08f, 0.50f, 0.55f}, false, 'X'},
    Face{{0, 1, 0}, {0, 0, 1}, {0.14f, 0.62f, 0.12f}, true, 'Y'},
    Face{{0, -1, 0}, {0, 0, -1}, {0.50f, 0.12f, 0.50f}, false, 'Y'},
    Face{{0, 0, 1}, {0, 1, 0}, {0.10f, 0.20f, 0.85f}, true, 'Z'},
    Face{{0, 0, -1}, {0, 1, 0}, {0.70f, 0.55f, 0.06f}, false, 'Z'},
};

/// A letter is a few straight strokes in a box of ±1 across and up.
struct Stroke {
    glm::vec2 from, to;
};
constexpr std::array kLetterX{Stroke{{-0.7f, -1}, {0.7f, 1}}, Stroke{{-0.7f, 1}, {0.7f, -1}}};
constexpr std::array kLetterY{Stroke{{-0.7f, 1}, {0, 0}}, Stroke{{0.7f, 1}, {0, 0}}, Stroke{{0, 0}, {0, -1}}};
constexpr std::array kLetterZ{Stroke{{-0.7f, 1}, {0.7f, 1}}, Stroke{{0.7f, 1}, {-0.7f, -1}},
                              Stroke{{-0.7f, -1}, {0.7f, -1}}};
constexpr std::array kPlus{Stroke{{-0.6f, 0}, {0.6f, 0}}, Stroke{{0, -0.6f}, {0, 0.6f}}};
constexpr std::array kMinus{Stroke{{-0.6f, 0}, {0.6f, 0}}};

float stroke_distance(glm::vec2 point, const Stroke& stroke) {
    const glm::vec2 along = stroke.to - stroke.from;
    const float t = std::clamp(glm::dot(point - stroke.from, along) / glm::dot(along, along), 0.0f, 1.0f);
    return glm::length(point - stroke.from - t * along);
}

bool on_strokes(glm::vec2 point, std::span<const Stroke> strokes) {
    constexpr float half_width = 0.2f;
    return std::any_of(strokes.begin(), strokes.end(),
                       [&](const Stroke& stroke) { return stroke_distance(point, stroke) < half_width; });
}

std::span<const Stroke> letter(char axis) {
    if (axis == 'X') return kLetterX;
    if (axis == 'Y') return kLetterY;
    return kLetterZ;
}

/// Sign to the left, letter to the right of the face's centre; `at` spans ±1 over the face.
bool on_label(const Face& face, glm::vec2 at) {
    constexpr float size = 0.2f;
    const glm::vec2 scaled = at / size;
    if (std::abs(scaled.x) > 2.4f || std::abs(scaled.y) > 1.3f) return false;
    const auto sign = face.positive ? std::span<const Stroke>(kPlus) : std::span<const Stroke>(kMinus);
    return on_strokes(scaled + glm::vec2(1.1f, 0.0f), sign) ||
           on_strokes(scaled - glm::vec2(1.0f, 0.0f), letter(face.axis));
}

/// Lines of latitude and longitude every 15°, 0.7° wide everywhere; towards the poles only every third
/// meridian.
class Graticule {
public:
    Graticule() {
        for (int i = 0; i < kLines; ++i) {
            const float angle = static_cast<float>(i) * kPi / kLines;
            across_[i] = {std::cos(angle), std::sin(angle)};
        }
    }
    bool covers(const glm::vec3& direction) const {
        for (int i = 1; i < kLines; ++i)
            if (std::abs(direction.y - across_[i].x) < kHalfWidth * across_[i].y) return true;
        // The distance from a meridian's plane is the sine of the angle to it.
        const int step = std::abs(direction.y) > kPolarSine ? 3 : 1;
        for (int i = 0; i < kLines; i += step)
            if (std::abs(direction.x * across_[i].x + direction.z * across_[i].y) < kHalfWidth) return true;
        return false;
    }

private:
    static constexpr int kLines = 12;
    static constexpr float kHalfWidth = 0.35f * kPi / 180.0f;
    static constexpr float kPolarSine = 0.9659258f;  // of 75°
    std::array<glm::vec2, kLines> across_{};         // cosine and sine of 0°, 15° … 165°
};

int face_of(const glm::vec3& direction) {
    const glm::vec3 size = glm::abs(direction);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return 2 * axis + (direction[axis] < 0.0f ? 1 : 0);
}

PaintedPoint look(const Graticule& graticule, const glm::vec3& direction) {
    const int index = face_of(direction);
    const Face& face = kFaces[index];
    const glm::vec3 right = glm::cross(face.forward, face.up);
    const float depth = glm::dot(direction, face.forward);
    const glm::vec2 at = glm::vec2(glm::dot(direction, right), glm::dot(direction, face.up)) / depth;
    if (std::abs(at.x) < 0.56f && std::abs(at.y) < 0.33f) {
        if (on_label(face, at)) return {glm::vec3(2.0f), 6};
        return {0.12f * face.color, 7 + index};
    }
    if (graticule.covers(direction)) return {glm::vec3(0.85f), 13};
    return {face.color, index};
}

}  // namespace

Environment make_test(int width) {
    const Graticule graticule;
    return paint_environment(width, [&](const glm::vec3& direction) { return look(graticule, direction); });
}

}  // namespace patina
