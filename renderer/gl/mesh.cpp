#include "renderer/gl/mesh.h"

#include "renderer/gl/texture.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>

namespace patina::gl {

namespace {

void attribute(GLuint index, GLint components, std::size_t offset) {
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, components, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                          reinterpret_cast<const void*>(offset));  // NOLINT(performance-no-int-to-ptr)
}

/// The one array and its two buffers, put back at the end.
class KeepMeshBindings {
public:
    KeepMeshBindings() {
        glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &array_);
        glGetIntegerv(GL_ARRAY_BUFFER_BINDING, &buffer_);
    }
    ~KeepMeshBindings() {
        glBindVertexArray(GLuint(array_));
        glBindBuffer(GL_ARRAY_BUFFER, GLuint(buffer_));
    }
    KeepMeshBindings(const KeepMeshBindings&) = delete;
    KeepMeshBindings& operator=(const KeepMeshBindings&) = delete;

private:
    GLint array_ = 0, buffer_ = 0;
};

GLsizeiptr bytes_of(const auto& values) { return GLsizeiptr(values.size() * sizeof(values[0])); }

}  // namespace

MeshWriter::MeshWriter(const PreparedMesh& mesh)
    : mesh_{VertexArray::make(),          Buffer::make(), Buffer::make(),
            GLsizei(mesh.indices.size()), mesh.is_closed, mesh.radius} {
    const KeepMeshBindings keep;
    glBindVertexArray(mesh_.layout.name());
    glBindBuffer(GL_ARRAY_BUFFER, mesh_.vertices.name());
    glBufferData(GL_ARRAY_BUFFER, bytes_of(mesh.vertices), nullptr, GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, mesh_.indices.name());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, bytes_of(mesh.indices), nullptr, GL_STATIC_DRAW);
    attribute(Position, 3, offsetof(Vertex, position));
    attribute(Normal, 3, offsetof(Vertex, normal));
    attribute(Uv, 2, offsetof(Vertex, uv));
    attribute(Tangent, 4, offsetof(Vertex, tangent));
    check_memory("the mesh");
}

bool MeshWriter::step(const PreparedMesh& mesh, std::size_t byte_budget) {
    const KeepMeshBindings keep;
    glBindVertexArray(0);  // the index buffer's binding belongs to an array: none is to be changed
    glBindBuffer(GL_ARRAY_BUFFER, mesh_.vertices.name());
    const auto copy = [&](const auto& values, std::size_t& written) {
        const std::size_t bytes = std::min(byte_budget, std::size_t(bytes_of(values)) - written);
        if (bytes == 0) return;
        const auto* from = reinterpret_cast<const std::byte*>(values.data()) + written;
        glBufferSubData(GL_ARRAY_BUFFER, GLintptr(written), GLsizeiptr(bytes), from);
        written += bytes;
        byte_budget -= bytes;
    };
    copy(mesh.vertices, vertex_bytes_);
    glBindBuffer(GL_ARRAY_BUFFER, mesh_.indices.name());
    copy(mesh.indices, index_bytes_);
    if (GLsizeiptr(vertex_bytes_) < bytes_of(mesh.vertices) ||
        GLsizeiptr(index_bytes_) < bytes_of(mesh.indices))
        return false;
    check_memory("the mesh");  // a driver may find a place only for what is written
    return true;
}

int draw_mesh(const GpuMesh& mesh, const glm::vec3& eye) {
    if (mesh.index_count == 0) return 0;
    glBindVertexArray(mesh.layout.name());
    glEnable(GL_CULL_FACE);
    glFrontFace(GL_CCW);
    // What faces the viewer mostly hides what does not: drawn first, it leaves the rest to the depth test.
    glCullFace(GL_BACK);
    glDrawElements(GL_TRIANGLES, mesh.index_count, GL_UNSIGNED_INT, nullptr);
    const bool back_seen = !mesh.is_closed || glm::length(eye) < 1.01f * mesh.radius;
    if (back_seen) {
        glCullFace(GL_FRONT);
        glDrawElements(GL_TRIANGLES, mesh.index_count, GL_UNSIGNED_INT, nullptr);
    }
    glDisable(GL_CULL_FACE);
    return back_seen ? 2 : 1;
}

}  // namespace patina::gl
