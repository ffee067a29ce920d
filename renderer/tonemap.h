// The tone mappers of the shaders, compiled as C++: the same text, so the two cannot drift apart.
#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <cmath>

namespace patina::tone {

using glm::clamp;
using glm::max;
using glm::min;
using glm::mix;
using glm::vec3;
using std::pow;

#define PATINA_FN inline
#include "renderer/shaders/tonemap.glsl"
#undef PATINA_FN

}  // namespace patina::tone
