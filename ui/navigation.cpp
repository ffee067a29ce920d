#include "ui/navigation.h"

#include <glm/mat4x4.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace patina::ui {
namespace {

constexpr float kOrbitDegrees = 0.4f;  // a unit of mouse movement
constexpr float kLightDegrees = 0.5f;
constexpr float kZoomPerNotch = 0.11f;  // of the distance's logarithm
constexpr float kMostPitch = 89.9f;
constexpr float kNearest = 0.1f, kFarthest = 100.0f;

}  // namespace

void orbit(Camera& camera, glm::vec2 moved) {
    camera.yaw_deg = wrap_degrees(camera.yaw_deg - kOrbitDegrees * moved.x);
    camera.pitch_deg = std::clamp(camera.pitch_deg + kOrbitDegrees * moved.y, -kMostPitch, kMostPitch);
}

void turn_light(View& view, glm::vec2 moved) {
    view.env_rotation_deg = wrap_degrees(view.env_rotation_deg + kLightDegrees * moved.x);
}

void pan(Camera& camera, glm::vec2 moved) {
    const float height = 2.0f * camera.distance * std::tan(glm::radians(camera.fov_deg) / 2.0f);
    const glm::mat4 to_view = view_matrix(camera);
    const glm::vec3 right{to_view[0][0], to_view[1][0], to_view[2][0]};
    const glm::vec3 up{to_view[0][1], to_view[1][1], to_view[2][1]};
    camera.target += height * (moved.y * up - moved.x * right);
}

void zoom(Camera& camera, float notches) {
    camera.distance = std::clamp(camera.distance * std::exp(-kZoomPerNotch * notches), kNearest, kFarthest);
}

}  // namespace patina::ui
