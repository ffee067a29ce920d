// The smallest sphere around points, exact up to rounding. Knows no mesh.
#pragma once

#include <glm/vec3.hpp>

#include <span>

namespace patina {

struct BoundingSphere {
    glm::dvec3 center{0.0};
    double radius = 0.0;
};

/// Precondition: at least one point, all finite with |coordinate| ≤ 1e100.
BoundingSphere smallest_enclosing_sphere(std::span<const glm::dvec3> points);

}  // namespace patina
