// Building blocks of the built-in meshes: patches and surfaces of revolution with exact normals.
#pragma once

#include "renderer/core/mesh.h"

#include <glm/vec2.hpp>

#include <span>

namespace patina {

/// One ring of a surface of revolution about +Y. Points go from bottom to top where the outside lies to the
/// right of the path (x: radius ≥ 0, y: height); a radius of exactly 0 is a pole.
struct ProfilePoint {
    glm::dvec2 position{0.0};
    glm::dvec2 normal{1.0, 0.0};  ///< unit, (radial, up)
    double v = 0.0;
};

/// Part of the way around: u_begin…u_end of the whole turn (u = ½ faces +Z, and grows to the right seen from
/// outside).
struct LatheRange {
    double u_begin = 0.0;
    double u_end = 1.0;
    int segments = 192;
    /// How often a picture goes once around, its middle staying at u = ½: about the way around divided by the
    /// way from v = 0 to 1, so that pictures keep their proportions.
    int repeats = 2;
};

/// Appends the surface. Two following points at one position make a crease and no triangles; at a pole every
/// triangle has a vertex of its own, whose u is the middle of its sector, so that the texture does not twist.
void append_lathe(Mesh& mesh, std::span<const ProfilePoint> profile, const LatheRange& range = {});

/// Two triangles over a lower left, b lower right, c upper right, d upper left (indices), seen from outside.
void append_quad(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);

/// The direction at u: (−sin 2πu, −cos 2πu) in (x, z), exact at the quarters.
glm::dvec2 lathe_direction(double u);

}  // namespace patina
