#include "renderer/gl/mesh_prepare.h"

#include "renderer/core/hash.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <unordered_map>
#include <utility>

namespace patina {

namespace {

template <class V>
void make_finite(V& v) {
    for (int i = 0; i < V::length(); ++i)
        if (!std::isfinite(v[i])) v[i] = 0.0f;
}

std::vector<Vertex> clean_vertices(const Mesh& mesh) {
    std::vector<Vertex> vertices = mesh.vertices;
    for (Vertex& vertex : vertices) {
        make_finite(vertex.position);
        make_finite(vertex.normal);
        make_finite(vertex.uv);
        if (mesh.has_tangents)
            make_finite(vertex.tangent);
        else
            vertex.tangent = glm::vec4(0.0f);
    }
    return vertices;
}

/// Index order such that each triangle's own normal is on the side of its vertices' normals.
std::vector<std::uint32_t> oriented_indices(const std::vector<Vertex>& vertices,
                                            std::vector<std::uint32_t> indices) {
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const Vertex& a = vertices[indices[i]];
        const Vertex& b = vertices[indices[i + 1]];
        const Vertex& c = vertices[indices[i + 2]];
        const glm::vec3 face = glm::cross(b.position - a.position, c.position - a.position);
        if (glm::dot(face, a.normal + b.normal + c.normal) < 0.0f) std::swap(indices[i + 1], indices[i + 2]);
    }
    return indices;
}

struct PositionHash {
    std::size_t operator()(const glm::vec3& p) const {
        return std::size_t(hash_bytes(std::as_bytes(std::span(&p.x, 3))));
    }
};

/// A number per position, the same for equal ones.
std::vector<std::uint32_t> position_ids(const std::vector<Vertex>& vertices) {
    std::unordered_map<glm::vec3, std::uint32_t, PositionHash> known;
    std::vector<std::uint32_t> ids;
    ids.reserve(vertices.size());
    for (const Vertex& vertex : vertices) {
        const glm::vec3 position = vertex.position + 0.0f;  // −0 becomes 0
        ids.push_back(known.try_emplace(position, std::uint32_t(known.size())).first->second);
    }
    return ids;
}

std::uint32_t root_of(std::vector<std::uint32_t>& parent, std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
}

/// What a connected part adds up to. An edge counts + in one direction and − in the other, under a hash of
/// its ends: the sum is 0 where each is walked as often either way, that is, where the part has no boundary.
struct Part {
    std::uint64_t boundary = 0;
    double volume = 0.0;
};
std::uint64_t edge_term(std::uint32_t from, std::uint32_t to) {
    if (from == to) return 0;
    const std::uint32_t ends[] = {std::min(from, to), std::max(from, to)};
    const std::uint64_t hash = hash_bytes(std::as_bytes(std::span(ends)));
    return from < to ? hash : ~hash + 1;
}

}  // namespace

bool is_closed(const std::vector<Vertex>& vertices, const std::vector<std::uint32_t>& indices) {
    constexpr std::size_t most_indices = 4'000'000;
    if (indices.size() > most_indices) return false;
    const auto ids = position_ids(vertices);
    std::vector<std::uint32_t> parent(vertices.size());
    std::iota(parent.begin(), parent.end(), 0u);
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
        for (int k = 1; k < 3; ++k)
            parent[root_of(parent, ids[indices[i + k]])] = root_of(parent, ids[indices[i]]);
    std::unordered_map<std::uint32_t, Part> parts;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        Part& part = parts[root_of(parent, ids[indices[i]])];
        glm::dvec3 p[3];
        for (int k = 0; k < 3; ++k) {
            p[k] = glm::dvec3(vertices[indices[i + k]].position);
            part.boundary += edge_term(ids[indices[i + k]], ids[indices[i + (k + 1) % 3]]);
        }
        part.volume += glm::dot(p[0], glm::cross(p[1], p[2]));
    }
    return std::all_of(parts.begin(), parts.end(), [](const auto& entry) {
        return entry.second.boundary == 0 && entry.second.volume > 0.0;
    });
}

PreparedMesh prepare_mesh(const Mesh& mesh) {
    PreparedMesh ready;
    ready.vertices = clean_vertices(mesh);
    ready.indices = oriented_indices(ready.vertices, mesh.indices);
    ready.is_closed = is_closed(ready.vertices, ready.indices);
    for (const Vertex& vertex : ready.vertices)
        ready.radius = std::max(ready.radius, glm::length(vertex.position));
    return ready;
}

}  // namespace patina
