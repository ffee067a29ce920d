// A mesh on the GPU.
#pragma once

#include "renderer/gl/handles.h"
#include "renderer/gl/mesh_prepare.h"

#include <cstddef>
#include <utility>

namespace patina {

struct GpuMesh {
    gl::VertexArray layout;
    gl::Buffer vertices;
    gl::Buffer indices;
    GLsizei index_count = 0;
    bool is_closed = false;  ///< as PreparedMesh has them
    float radius = 0.0f;
};

namespace gl {

/// Vertex attributes, by name in the shaders.
enum Attribute : GLuint { Position, Normal, Uv, Tangent };

/// A mesh on its way to the GPU, a portion at a time.
class MeshWriter {
public:
    explicit MeshWriter(const PreparedMesh& mesh);
    /// Copies up to byte_budget bytes of the same mesh; true when all is there.
    bool step(const PreparedMesh& mesh, std::size_t byte_budget);
    GpuMesh take() { return std::move(mesh_); }

private:
    GpuMesh mesh_;
    std::size_t vertex_bytes_ = 0, index_bytes_ = 0;  ///< copied so far
};
/// Both sides; of a closed mesh seen from outside only the front. Gives the number of draw calls.
int draw_mesh(const GpuMesh& mesh, const glm::vec3& eye);

}  // namespace gl
}  // namespace patina
