#include "renderer/ibl/cube.h"

#include "renderer/ibl/bake.h"

#include <glm/geometric.hpp>

#include <cassert>
#include <cmath>

namespace patina {
namespace {

/// Solid angle of the rectangle from the face's centre to (s, t) on the plane at distance 1 (signed): the
/// antiderivative of (1 + s² + t²)^(−3/2) in both variables.
double corner_area(double s, double t) { return std::atan2(s * t, std::sqrt(s * s + t * t + 1.0)); }

}  // namespace

glm::vec3 cube_texel_direction(int size, int face, int x, int y) {
    assert(size > 0 && face >= 0 && face < 6 && x >= 0 && x < size && y >= 0 && y < size);
    const double s = (2.0 * x + 1.0) / size - 1.0;
    const double t = (2.0 * y + 1.0) / size - 1.0;
    const double inverse_length = 1.0 / std::sqrt(1.0 + s * s + t * t);
    return face_direction(face, s, t) * inverse_length;
}

double cube_texel_solid_angle(int size, int x, int y) {
    assert(size > 0 && x >= 0 && x < size && y >= 0 && y < size);
    const double s0 = 2.0 * x / size - 1.0;
    const double t0 = 2.0 * y / size - 1.0;
    const double s1 = 2.0 * (x + 1) / size - 1.0;
    const double t1 = 2.0 * (y + 1) / size - 1.0;
    return corner_area(s1, t1) - corner_area(s0, t1) - corner_area(s1, t0) + corner_area(s0, t0);
}

}  // namespace patina
