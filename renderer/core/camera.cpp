#include "renderer/core/camera.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace patina {
namespace {

/// Everything that is drawn lies within this distance of the origin (the corners of the quad are at √2).
constexpr float kSceneRadius = 2.0f;
constexpr float kMinDistance = 1e-4f;
constexpr float kMaxDistance = 1e6f;

float safe_distance(const Camera& camera) { return std::clamp(camera.distance, kMinDistance, kMaxDistance); }

/// Unit vector from the target to the eye.
glm::vec3 backward(const Camera& camera) {
    const float yaw = glm::radians(camera.yaw_deg);
    const float pitch = glm::radians(camera.pitch_deg);
    return {std::sin(yaw) * std::cos(pitch), std::sin(pitch), std::cos(yaw) * std::cos(pitch)};
}

}  // namespace

Camera fitted_to(const Camera& camera, float aspect) {
    Camera fitted = camera;
    if (aspect >= 1.0f) return fitted;
    const float half = std::tan(glm::radians(camera.fov_deg) / 2.0f) / aspect;
    fitted.fov_deg = std::min(2.0f * glm::degrees(std::atan(half)), 170.0f);
    return fitted;
}

glm::vec3 camera_position(const Camera& camera) {
    return camera.target + safe_distance(camera) * backward(camera);
}

glm::mat4 view_matrix(const Camera& camera) {
    // The right vector comes from the yaw alone, so that the frame is defined straight up and down, too.
    const float yaw = glm::radians(camera.yaw_deg);
    const glm::vec3 back = backward(camera);
    const glm::vec3 right{std::cos(yaw), 0.0f, -std::sin(yaw)};
    const glm::vec3 up = glm::cross(back, right);
    const glm::vec3 eye = camera_position(camera);
    return {glm::vec4(right.x, up.x, back.x, 0.0f), glm::vec4(right.y, up.y, back.y, 0.0f),
            glm::vec4(right.z, up.z, back.z, 0.0f),
            glm::vec4(-glm::dot(right, eye), -glm::dot(up, eye), -glm::dot(back, eye), 1.0f)};
}

glm::mat4 projection_matrix(const Camera& camera, float aspect) {
    // The near plane keeps in front of the scene where the eye is outside it, else close to the eye; never
    // further than half way, which keeps the depth buffer's resolution from far away.
    const float eye = glm::length(camera_position(camera));
    const float closest = 0.01f * safe_distance(camera);
    const float near = std::max(closest, std::min(eye - kSceneRadius, 0.5f * eye));
    const float far = std::max(eye + kSceneRadius, 2.0f * near);
    const float scale = 1.0f / std::tan(0.5f * glm::radians(camera.fov_deg));
    return {glm::vec4(scale / aspect, 0.0f, 0.0f, 0.0f), glm::vec4(0.0f, scale, 0.0f, 0.0f),
            glm::vec4(0.0f, 0.0f, -(far + near) / (far - near), -1.0f),
            glm::vec4(0.0f, 0.0f, -2.0f * far * near / (far - near), 0.0f)};
}

}  // namespace patina
