// What a mesh needs before it goes to the GPU: sane numbers, consistent winding, and whether it encloses
// volume. Pure; no GL is called, so it can be made on a worker.
#pragma once

#include "renderer/core/mesh.h"

#include <cstdint>
#include <vector>

namespace patina {

struct PreparedMesh {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
    bool is_closed = false;  ///< its back faces cannot be seen from outside the bounding sphere
    float radius = 0.0f;     ///< of the bounding sphere around the origin
};

/// Numbers that are not finite become 0; tangents that were not computed become 0, which the shader
/// recognises. Triangles are wound to agree with their normals: the front is the side the normals are on.
PreparedMesh prepare_mesh(const Mesh& mesh);

/// True if the surface encloses volume: each connected part (by position) has no boundary and is wound
/// outwards. Meshes that would take longer than a second to look through count as open.
bool is_closed(const std::vector<Vertex>& vertices, const std::vector<std::uint32_t>& indices);

}  // namespace patina
