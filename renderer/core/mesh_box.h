// The six sides of a box with their own right and up, such that pictures on them are upright and unmirrored
// from outside.
#pragma once

#include <glm/vec3.hpp>

#include <array>

namespace patina {

/// Seen from outside: right × up = out.
struct BoxSide {
    glm::dvec3 right, up, out;
};

/// +X −X +Y −Y +Z −Z.
inline constexpr std::array kBoxSides{
    BoxSide{{0, 0, -1}, {0, 1, 0}, {1, 0, 0}}, BoxSide{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}},
    BoxSide{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, BoxSide{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
    BoxSide{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},  BoxSide{{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}}};

}  // namespace patina
