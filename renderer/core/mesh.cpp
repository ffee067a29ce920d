#include "renderer/core/mesh.h"

#include "renderer/core/mesh_bounds.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <stdexcept>

namespace patina {
namespace {

bool has_area(const std::vector<glm::dvec3>& positions, const std::vector<std::uint32_t>& indices,
              double radius) {
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::dvec3 a = positions[indices[i]];
        const glm::dvec3 b = (positions[indices[i + 1]] - a) / radius;
        const glm::dvec3 c = (positions[indices[i + 2]] - a) / radius;
        if (glm::length(glm::cross(b, c)) > 1e-14) return true;
    }
    return false;
}

}  // namespace

void normalize_to_unit_sphere(Mesh& mesh) {
    std::vector<glm::dvec3> positions;
    positions.reserve(mesh.vertices.size());
    for (const Vertex& vertex : mesh.vertices) {
        const glm::dvec3 p(vertex.position);
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            throw std::runtime_error("the mesh has a vertex that is not a finite point.");
        positions.push_back(p);
    }
    if (positions.empty() || mesh.indices.empty()) throw std::runtime_error("the mesh has no triangle.");
    const BoundingSphere sphere = smallest_enclosing_sphere(positions);
    if (!(sphere.radius > 0.0) || !has_area(positions, mesh.indices, sphere.radius))
        throw std::runtime_error("the mesh has no triangle with an area.");
    for (std::size_t i = 0; i < positions.size(); ++i)
        mesh.vertices[i].position = glm::vec3((positions[i] - sphere.center) / sphere.radius);
}

}  // namespace patina
