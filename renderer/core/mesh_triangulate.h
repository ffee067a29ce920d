// Cuts a polygon in space into triangles. Knows no mesh.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace patina {

/// Appends triangles of corner numbers 0 … n − 1 that cover the polygon, same winding: convex or not, planar
/// or nearly. A quad is cut along the diagonal that folds neither half over, the shorter one if both serve. A
/// polygon that crosses itself still gets n − 2 triangles. Appends nothing where n < 3 or the polygon has no
/// area.
void triangulate(std::span<const glm::dvec3> corners, std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace patina
