// The reflection model of the shaders, compiled as C++: the same text, so the two cannot drift apart.
#pragma once

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace patina::brdf {

using glm::clamp;
using glm::dot;
using glm::exp;
using glm::exp2;
using glm::log2;
using glm::max;
using glm::min;
using glm::mix;
using glm::pow;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using std::sqrt;

#define PATINA_FN inline
#include "renderer/shaders/brdf.glsl"
#undef PATINA_FN

}  // namespace patina::brdf
