// Properties of meshes: from disordered triangles to frames and a unit sphere.
#include "app/stability.h"
#include "renderer/core/mesh.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

using glm::vec3;

/// Triangles that share vertices at random: slivers, points, opposite windings, edges of many faces, uvs that
/// collapse to a line or a point.
Mesh any_mesh(Random& random) {
    Mesh mesh;
    const double uv_kind = random.uniform();
    const int count = 3 + random.below(12);
    for (int i = 0; i < count; ++i) {
        Vertex vertex;
        vertex.position = vec3(random.direction() * random.log_between(1e-3, 1.0));
        if (i > 0 && random.chance(0.2)) vertex.position = mesh.vertices.back().position;
        vertex.normal = vec3(random.direction());
        const auto u = float(random.uniform());
        vertex.uv = uv_kind < 0.3   ? glm::vec2(0.5f)
                    : uv_kind < 0.5 ? glm::vec2(u, u)
                    : uv_kind < 0.6 ? glm::vec2(1e-20f * u, 0.0f)
                                    : glm::vec2(u, float(random.uniform()));
        mesh.vertices.push_back(vertex);
    }
    for (int i = 3 * (1 + random.below(20)); i > 0; --i)
        mesh.indices.push_back(std::uint32_t(random.below(count)));
    return mesh;
}

/// |det| of (tangent, w · normal × tangent, normal).
Trial tangent_frames(Random& random, Stage&) {
    Mesh mesh = any_mesh(random);
    make_tangents(mesh);
    Trial trial;
    trial.require(mesh.has_tangents);
    for (const Vertex& vertex : mesh.vertices) {
        const vec3 T(vertex.tangent);
        const vec3 B = vertex.tangent.w * glm::cross(vertex.normal, T);
        const glm::mat3 frame(T, B, vertex.normal);
        trial.add(std::abs(std::abs(double(glm::determinant(frame))) - 1.0));
    }
    return trial;
}

/// Any scale, any place (as far as single precision tells its vertices apart): on the unit sphere afterwards.
Trial unit_sphere(Random& random, Stage&) {
    Mesh mesh = any_mesh(random);
    mesh.indices = {0, 1, 2};
    mesh.vertices[0].position = {1.0f, 0.0f, 0.0f};
    mesh.vertices[1].position = {0.0f, 1.0f, 0.0f};
    mesh.vertices[2].position = {0.0f, 0.0f, 1.0f};
    const double scale = std::pow(10.0, random.between(-20.0, 20.0));
    const glm::dvec3 offset = random.direction() * random.log_between(1e-3, 10.0) * scale;
    for (Vertex& vertex : mesh.vertices) vertex.position = vec3(glm::dvec3(vertex.position) * scale + offset);
    normalize_to_unit_sphere(mesh);
    double farthest = 0.0;
    for (const std::uint32_t i : mesh.indices)
        farthest = std::max(farthest, double(glm::length(mesh.vertices[i].position)));
    Trial trial;
    trial.add(std::abs(farthest - 1.0));
    for (const Vertex& vertex : mesh.vertices)
        trial.require(std::isfinite(vertex.position.x + vertex.position.y + vertex.position.z));
    return trial;
}

}  // namespace

std::vector<Property> mesh_properties() {
    return {
        {"tangent-frames", "tangents of any mesh, degenerate too: |det − 1|", 1e-4, 50000, tangent_frames},
        {"unit-sphere", "meshes of 1e±20 fill the unit sphere", 1e-5, 20000, unit_sphere},
    };
}

}  // namespace patina
