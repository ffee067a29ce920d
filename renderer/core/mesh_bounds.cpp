#include "renderer/core/mesh_bounds.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <cassert>
#include <cmath>
#include <optional>
#include <vector>

namespace patina {
namespace {

/// The sphere through all given points (1…4) whose centre lies in their affine hull; none if they are
/// dependent. With q_i = p_i − p_0 and centre p_0 + Σ λ_j q_j, equal distances mean 2 Σ_j (q_i·q_j) λ_j =
/// q_i·q_i.
std::optional<BoundingSphere> sphere_through(const std::vector<glm::dvec3>& points) {
    const int n = int(points.size()) - 1;
    glm::dvec3 q[3] = {};
    for (int i = 0; i < n; ++i) q[i] = points[std::size_t(i) + 1] - points[0];
    glm::dmat3 gram(1.0);
    glm::dvec3 right_side(0.0);
    double scale = 1.0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) gram[j][i] = 2.0 * glm::dot(q[i], q[j]);
        right_side[i] = glm::dot(q[i], q[i]);
        scale *= gram[i][i];
    }
    const double det = glm::determinant(gram);
    if (!(std::abs(det) > 1e-14 * scale)) return std::nullopt;
    const glm::dvec3 lambda = glm::inverse(gram) * right_side;
    glm::dvec3 offset(0.0);
    for (int i = 0; i < n; ++i) offset += lambda[i] * q[i];
    return BoundingSphere{points[0] + offset, glm::length(offset)};
}

bool encloses(const BoundingSphere& sphere, const std::vector<glm::dvec3>& points) {
    for (const glm::dvec3& p : points)
        if (glm::distance(p, sphere.center) > sphere.radius * (1.0 + 1e-10)) return false;
    return true;
}

/// The smallest sphere around at most five points, by trying every subset of up to four; support becomes that
/// subset.
BoundingSphere smallest_of_few(std::vector<glm::dvec3>& support) {
    const std::vector<glm::dvec3> points = support;
    BoundingSphere best{points[0], -1.0};
    for (unsigned mask = 1; mask < 1u << points.size(); ++mask) {
        std::vector<glm::dvec3> subset;
        for (std::size_t i = 0; i < points.size(); ++i)
            if (mask >> i & 1u) subset.push_back(points[i]);
        if (subset.size() > 4) continue;
        const auto sphere = sphere_through(subset);
        if (!sphere || !encloses(*sphere, points)) continue;
        if (best.radius < 0.0 || sphere->radius < best.radius) {
            best = *sphere;
            support = subset;
        }
    }
    return best;
}

}  // namespace

/// Basis exchange: the farthest point outside joins the support set, whose exact sphere can only grow, until
/// none is out.
BoundingSphere smallest_enclosing_sphere(std::span<const glm::dvec3> points) {
    assert(!points.empty());
    std::vector<glm::dvec3> support{points[0]};
    BoundingSphere sphere{points[0], 0.0};
    for (int round = 0; round < 100; ++round) {
        double farthest2 = -1.0;
        glm::dvec3 farthest = points[0];
        for (const glm::dvec3& p : points) {
            const glm::dvec3 d = p - sphere.center;
            const double d2 = glm::dot(d, d);
            if (d2 > farthest2) {
                farthest2 = d2;
                farthest = p;
            }
        }
        const double reach = std::sqrt(farthest2);
        if (reach <= sphere.radius * (1.0 + 1e-9)) break;
        support.push_back(farthest);
        const BoundingSphere grown = smallest_of_few(support);
        if (!(grown.radius >
              sphere.radius)) {  // rounding has the last word: keep the centre, reach everything
            sphere.radius = reach;
            break;
        }
        sphere = grown;
    }
    return sphere;
}

}  // namespace patina
