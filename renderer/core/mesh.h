// A triangle mesh as the GPU wants it, plain data, and what can be computed on it. Knows no file and no GPU.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace patina {

struct Vertex {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f, 0.0f, 1.0f};         ///< unit
    glm::vec2 uv{0.0f};                         ///< (0,0) is the picture's lower-left corner
    glm::vec4 tangent{1.0f, 0.0f, 0.0f, 1.0f};  ///< xyz unit; bitangent = w · cross(normal, tangent)
    bool operator==(const Vertex&) const = default;
};

/// Indexed triangles, counter-clockwise seen from outside. Index < vertices.size(); indices.size() % 3 == 0.
struct Mesh {
    std::string name;
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
    bool has_uvs = true;             ///< false: the file had none and they were projected (see notes)
    bool has_tangents = false;       ///< tangents are only computed when a normal map needs them
    std::vector<std::string> notes;  ///< what was repaired or assumed, one sentence each
};

/// Centres the mesh on its smallest enclosing sphere and scales it to radius 1 (built-ins are already so);
/// computed in double, so extents from 1e-20 to 1e20 are safe. Throws std::runtime_error if a position is not
/// finite or no triangle has an area.
void normalize_to_unit_sphere(Mesh& mesh);

/// Tangents as normal maps are baked against them (MikkTSpace, Mikkelsen 2008): per corner, averaged over the
/// corners of one vertex whose triangles hang together and are mirrored alike in uv; vertices are split where
/// these groups differ. Where uvs say nothing, any frame around the normal. Sets has_tangents.
void make_tangents(Mesh& mesh);

struct BuiltinMesh {
    std::string_view id;
    std::string_view title;
    std::string_view description;  ///< one sentence for a student
    Mesh (*make)();
};

/// sphere (radius 1), quad (±1 in x and y, facing +Z), cube (bevelled), torus, shaderball — in the order
/// shown. Textures are upright and not mirrored seen from outside; all but the quad are closed surfaces
/// inside the unit sphere.
std::span<const BuiltinMesh> builtin_meshes();

}  // namespace patina
