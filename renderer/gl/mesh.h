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
};

namespace gl {

/// Vertex attributes, by name in the shaders.
enum Attribute : GLuint { kPosition, kNormal, kUv, kTangent };

/// Numbers that are not finite become 0; tangents that were not computed become 0, which the shader
/// recognises.
GpuMesh make_mesh_buffers(const Mesh& mesh);
void draw_mesh(const GpuMesh& mesh);

}  // namespace gl
}  // namespace patina
