// Normals and texture coordinates for meshes that bring none. Knows no file.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace patina {

/// Three corners a triangle, each the number of a place; places[number] is where it is, equal places have
/// equal numbers.
struct TriangleView {
    std::span<const std::uint32_t> corner_place;
    std::span<const glm::vec3> places;
};

/// Unit normal of every triangle; zero where it has no area.
std::vector<glm::vec3> triangle_normals(const TriangleView& triangles);

/// One unit normal a corner: the mean of the triangles around it, weighed by their angles there, that can be
/// reached over edges where the surface folds by no more than crease_degrees. Linear in the triangles,
/// whatever meets at a place.
std::vector<glm::vec3> smooth_normals(const TriangleView& triangles, double crease_degrees);

/// One texture coordinate a corner, in 0…1: each triangle is projected straight onto the side of the bounding
/// cube it faces most, upright and unmirrored.
std::vector<glm::vec2> box_uvs(const TriangleView& triangles);

}  // namespace patina
