// Whether vectors hold numbers.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cmath>

namespace patina {

inline bool is_finite(glm::vec2 v) { return std::isfinite(v.x) && std::isfinite(v.y); }
inline bool is_finite(glm::vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace patina
