// Moving the camera and the light: mouse movements and steps to new values. Pure.
#pragma once

#include "renderer/core/angles.h"
#include "renderer/core/camera.h"
#include "renderer/core/view.h"

#include <glm/vec2.hpp>

namespace patina::ui {

/// moved: in display units at scale 1, x to the right, y down, as the mouse went.
void orbit(Camera& camera, glm::vec2 moved);
void turn_light(View& view, glm::vec2 moved);
/// moved: in heights of the picture; the point under the mouse (in the target's plane) stays under it.
void pan(Camera& camera, glm::vec2 moved);
/// notches of the wheel, > 0 moves closer.
void zoom(Camera& camera, float notches);

using patina::wrap_degrees;

}  // namespace patina::ui
