// The camera as four numbers and a target. Knows no input device and no GPU.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace patina {

/// Looks at target from target + distance·(sin yaw·cos pitch, sin pitch, cos yaw·cos pitch); +Y up;
/// right-handed.
struct Camera {
    float yaw_deg = 0.0f;
    float pitch_deg = 0.0f;  ///< −89.9…89.9
    float distance = 4.5f;   ///< > 0, in mesh radii
    float fov_deg = 30.0f;   ///< vertical field of view
    glm::vec3 target{0.0f};
    bool operator==(const Camera&) const = default;
};

/// The camera for a picture of that aspect (width / height) such that an object that fits into a square
/// picture fits into this one: in a narrow picture the field of view is the horizontal one.
Camera fitted_to(const Camera& camera, float aspect);

glm::vec3 camera_position(const Camera& camera);
glm::mat4 view_matrix(const Camera& camera);
/// OpenGL clip space (z −1…1). aspect = width / height.
glm::mat4 projection_matrix(const Camera& camera, float aspect);

}  // namespace patina
