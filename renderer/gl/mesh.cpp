#include "renderer/gl/mesh.h"

#include "renderer/gl/texture.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace patina::gl {

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

void attribute(GLuint index, GLint components, std::size_t offset) {
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, components, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                          reinterpret_cast<const void*>(offset));
}

}  // namespace

GpuMesh make_mesh_buffers(const Mesh& mesh) {
    GLint array = 0;
    GLint buffer = 0;
    glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &array);
    glGetIntegerv(GL_ARRAY_BUFFER_BINDING, &buffer);
    const std::vector<Vertex> vertices = clean_vertices(mesh);
    GpuMesh result{VertexArray::make(), Buffer::make(), Buffer::make(), GLsizei(mesh.indices.size())};
    glBindVertexArray(result.layout.name());
    glBindBuffer(GL_ARRAY_BUFFER, result.vertices.name());
    glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(vertices.size() * sizeof(Vertex)), vertices.data(),
                 GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, result.indices.name());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(mesh.indices.size() * sizeof(mesh.indices[0])),
                 mesh.indices.data(), GL_STATIC_DRAW);
    attribute(kPosition, 3, offsetof(Vertex, position));
    attribute(kNormal, 3, offsetof(Vertex, normal));
    attribute(kUv, 2, offsetof(Vertex, uv));
    attribute(kTangent, 4, offsetof(Vertex, tangent));
    glBindVertexArray(GLuint(array));
    glBindBuffer(GL_ARRAY_BUFFER, GLuint(buffer));
    check_memory("the mesh");
    return result;
}

void draw_mesh(const GpuMesh& mesh) {
    if (mesh.index_count == 0) return;
    glBindVertexArray(mesh.layout.name());
    glDrawElements(GL_TRIANGLES, mesh.index_count, GL_UNSIGNED_INT, nullptr);
}

}  // namespace patina::gl
