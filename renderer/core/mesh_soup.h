// Polygons as a file lists them, nothing assumed about how they hang together, and the way from there to a
// Mesh.
#pragma once

#include "renderer/core/mesh.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace patina {

/// Face f has the corners face_begin[f] … face_begin[f + 1] − 1. Indices may be out of range, numbers may be
/// NaN.
struct PolygonSoup {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> corner_position;
    std::vector<glm::vec3> corner_normal;  ///< per corner, or empty; the zero vector where a corner has none
    std::vector<glm::vec2> corner_uv;      ///< per corner, or empty; kNoUv where a corner has none
    std::vector<std::uint32_t> face_begin{0};
    std::size_t faces_without_area = 0;  ///< that a reader has left out already
};

/// Stands for "this corner has no texture coordinate" (no file can say −∞).
inline constexpr glm::vec2 kNoUv{-std::numeric_limits<float>::infinity()};

/// The angle between two faces from which on their common edge is a crease.
inline constexpr double kCreaseDegrees = 60.0;

/// Triangulates, drops what has no area, cannot be located or is there twice, fills in missing normals and
/// texture coordinates (all counted in notes), makes vertices out of equal corners, and normalizes to the
/// unit sphere. Takes near-linear time for any input. Throws std::runtime_error when no triangle is left.
Mesh make_mesh(const PolygonSoup& soup);

}  // namespace patina
