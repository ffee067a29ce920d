// A mesh on the GPU.
#pragma once

#include "renderer/core/mesh.h"
#include "renderer/gl/handles.h"

namespace patina {

struct GpuMesh {
    gl::VertexArray layout;
    gl::Buffer vertices;
    gl::Buffer indices;
    GLsizei index_count = 0;
    bool is_closed = false;  ///< its back faces cannot be seen from outside the bounding sphere
    float radius = 0.0f;     ///< of the bounding sphere around the origin
};

namespace gl {

/// Vertex attributes, by name in the shaders.
enum Attribute : GLuint { Position, Normal, Uv, Tangent };

/// Numbers that are not finite become 0; tangents that were not computed become 0, which the shader
/// recognises. Triangles are wound to agree with their normals: the front is the side the normals are on.
GpuMesh make_mesh_buffers(const Mesh& mesh);
/// Both sides; of a closed mesh seen from outside only the front.
void draw_mesh(const GpuMesh& mesh, const glm::vec3& eye);

/// True if the surface encloses volume: each connected part (by position) has no boundary and is wound
/// outwards. Meshes too large to be looked through in a few milliseconds count as open.
bool is_closed(const std::vector<Vertex>& vertices, const std::vector<std::uint32_t>& indices);

}  // namespace gl
}  // namespace patina
