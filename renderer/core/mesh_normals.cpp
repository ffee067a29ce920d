#include "renderer/core/mesh_normals.h"

#include "renderer/core/mesh_adjacency.h"
#include "renderer/core/mesh_box.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace patina {
namespace {

glm::dvec3 place_of(const TriangleView& t, std::uint32_t corner) {
    return glm::dvec3(t.places[t.corner_place[corner]]);
}

/// Disjoint sets of corners, halving paths on the way up.
class CornerSets {
public:
    explicit CornerSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
    std::uint32_t root(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = root(a);
        b = root(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::uint32_t> parent_;
};

/// acos loses half its digits near 0 and π; atan2 of sine and cosine does not.
double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace

std::vector<glm::vec3> triangle_normals(const TriangleView& triangles) {
    std::vector<glm::vec3> normals(triangles.corner_place.size() / 3);
    for (std::uint32_t t = 0; t < normals.size(); ++t) {
        const glm::dvec3 a = place_of(triangles, 3 * t);
        const glm::dvec3 n =
            glm::cross(place_of(triangles, 3 * t + 1) - a, place_of(triangles, 3 * t + 2) - a);
        const double length = glm::length(n);
        if (length > 0.0) normals[t] = glm::vec3(n / length);
    }
    return normals;
}

std::vector<glm::vec3> smooth_normals(const TriangleView& triangles, double crease_degrees) {
    const auto corners = std::uint32_t(triangles.corner_place.size());
    const std::vector<glm::vec3> face_normal = triangle_normals(triangles);
    const auto least_cosine = float(std::cos((crease_degrees + 0.01) * std::numbers::pi / 180.0));
    const std::vector<std::uint32_t> opposite = opposite_half_edges(triangles.corner_place);
    CornerSets sets(corners);
    for (std::uint32_t h = 0; h < corners; ++h) {
        const std::uint32_t other = opposite[h];
        if (other == kNoCorner || other < h) continue;
        if (glm::dot(face_normal[h / 3], face_normal[other / 3]) < least_cosine) continue;
        sets.join(h, next_corner(other));
        sets.join(next_corner(h), other);
    }
    std::vector<glm::vec3> sum(corners, glm::vec3(0.0f));
    for (std::uint32_t c = 0; c < corners; ++c) {
        const glm::dvec3 here = place_of(triangles, c);
        const double angle = angle_between(place_of(triangles, next_corner(c)) - here,
                                           place_of(triangles, previous_corner(c)) - here);
        sum[sets.root(c)] += face_normal[c / 3] * float(angle);
    }
    std::vector<glm::vec3> normals(corners);
    for (std::uint32_t c = 0; c < corners; ++c) {
        const glm::vec3 n = sum[sets.root(c)];
        const float length = glm::length(n);
        normals[c] = length > 1e-6f ? n / length : face_normal[c / 3];
    }
    return normals;
}

std::vector<glm::vec2> box_uvs(const TriangleView& triangles) {
    glm::dvec3 low(std::numeric_limits<double>::max());
    glm::dvec3 high(-low);
    for (const std::uint32_t place : triangles.corner_place) {
        low = glm::min(low, glm::dvec3(triangles.places[place]));
        high = glm::max(high, glm::dvec3(triangles.places[place]));
    }
    const glm::dvec3 center = 0.5 * (low + high);
    const glm::dvec3 extent = high - low;
    const double side = std::max({extent.x, extent.y, extent.z});
    const std::vector<glm::vec3> face_normal = triangle_normals(triangles);
    std::vector<glm::vec2> uvs(triangles.corner_place.size());
    for (std::uint32_t c = 0; c < uvs.size(); ++c) {
        const glm::dvec3 n(face_normal[c / 3]);
        const BoxSide* best = &kBoxSides[4];  // a tie goes to the front
        for (const BoxSide& candidate : kBoxSides)
            if (glm::dot(n, candidate.out) > glm::dot(n, best->out) + 1e-6) best = &candidate;
        const glm::dvec3 p = (place_of(triangles, c) - center) / side;
        uvs[c] =
            glm::clamp(glm::vec2(glm::dvec2(0.5 + glm::dot(p, best->right), 0.5 + glm::dot(p, best->up))),
                       glm::vec2(0.0f), glm::vec2(1.0f));
    }
    return uvs;
}

}  // namespace patina
