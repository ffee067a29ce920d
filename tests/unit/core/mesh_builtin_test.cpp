#include "mesh_tools.h"
#include "renderer/core/mesh.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

namespace patina {
namespace {

using namespace test;

using Key = std::tuple<float, float, float>;
Key key_of(const glm::vec3& p) { return {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}; }

Mesh builtin(std::string_view id) {
    for (const BuiltinMesh& mesh : builtin_meshes())
        if (mesh.id == id) return mesh.make();
    throw std::runtime_error("no such mesh");
}

/// ∂position/∂v, unnormalised.
glm::dvec3 along_v(const Corners& t) {
    const glm::dvec3 a(t.a.position);
    const glm::dvec2 p(glm::dvec2(t.b.uv) - glm::dvec2(t.a.uv));
    const glm::dvec2 q(glm::dvec2(t.c.uv) - glm::dvec2(t.a.uv));
    return (p.x * (glm::dvec3(t.c.position) - a) - q.x * (glm::dvec3(t.b.position) - a)) /
           (p.x * q.y - p.y * q.x);
}
/// Likewise for u.
glm::dvec3 along_u(const Corners& t) {
    const glm::dvec3 a(t.a.position);
    const glm::dvec2 p(glm::dvec2(t.b.uv) - glm::dvec2(t.a.uv));
    const glm::dvec2 q(glm::dvec2(t.c.uv) - glm::dvec2(t.a.uv));
    return (q.y * (glm::dvec3(t.b.position) - a) - p.y * (glm::dvec3(t.c.position) - a)) /
           (p.x * q.y - p.y * q.x);
}
/// Edges that are not run exactly once each way.
std::size_t open_edges(const Mesh& mesh) {
    std::map<std::pair<Key, Key>, int> runs;
    for (const Corners& t : triangles(mesh)) {
        const Key k[3] = {key_of(t.a.position), key_of(t.b.position), key_of(t.c.position)};
        for (int i = 0; i < 3; ++i) ++runs[{k[i], k[(i + 1) % 3]}];
    }
    std::size_t open = 0;
    for (const auto& [edge, count] : runs) {
        const auto back = runs.find({edge.second, edge.first});
        if (count != 1 || back == runs.end()) ++open;
    }
    return open;
}

class EveryBuiltin : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Meshes, EveryBuiltin,
                         testing::Values("sphere", "quad", "cube", "torus", "shaderball"),
                         [](const auto& mesh) { return mesh.param; });

TEST_P(EveryBuiltin, is_well_formed_and_inside_the_unit_sphere) {
    const Mesh mesh = builtin(GetParam());
    EXPECT_EQ(mesh.name, GetParam());
    EXPECT_TRUE(mesh.has_uvs);
    ASSERT_FALSE(mesh.indices.empty());
    ASSERT_EQ(mesh.indices.size() % 3, 0u);
    EXPECT_LT(mesh.indices.size() / 3, 250000u);
    for (const std::uint32_t index : mesh.indices) ASSERT_LT(index, mesh.vertices.size());
    for (const Vertex& vertex : mesh.vertices) {
        EXPECT_LE(glm::length(vertex.position), (GetParam() == "quad" ? std::sqrt(2.0f) : 1.0f) + 1e-6f);
        EXPECT_NEAR(glm::length(vertex.normal), 1.0f, 1e-6f);
        // Round shapes carry the picture twice around, its middle in front.
        EXPECT_TRUE(vertex.uv.x >= -0.5f && vertex.uv.x <= 1.5f && vertex.uv.y >= 0.0f &&
                    vertex.uv.y <= 1.0f);
    }
}

TEST_P(EveryBuiltin, has_no_degenerate_triangle_and_uses_every_vertex) {
    const Mesh mesh = builtin(GetParam());
    std::vector<bool> used(mesh.vertices.size(), false);
    for (const std::uint32_t index : mesh.indices) used[index] = true;
    EXPECT_TRUE(std::all_of(used.begin(), used.end(), [](bool u) { return u; }));
    for (const Corners& t : triangles(mesh)) {
        EXPECT_GT(glm::length(area_vector(t)), 1e-9);
        EXPECT_GT(std::abs(uv_area(t)), 1e-9);
    }
}

TEST_P(EveryBuiltin, is_counter_clockwise_seen_from_where_its_normals_point) {
    for (const Corners& t : triangles(builtin(GetParam()))) {
        const glm::dvec3 n = glm::normalize(area_vector(t));
        for (const Vertex& v : {t.a, t.b, t.c}) ASSERT_GT(glm::dot(n, glm::dvec3(v.normal)), 0.9);
    }
}

TEST_P(EveryBuiltin, is_closed_but_for_the_quad) {
    const Mesh mesh = builtin(GetParam());
    EXPECT_EQ(open_edges(mesh), GetParam() == "quad" ? 4u : 0u);
    if (GetParam() != "quad") {
        EXPECT_GT(volume(mesh), 0.5);
    }
}

TEST_P(EveryBuiltin, shows_text_unmirrored) {
    for (const Corners& t : triangles(builtin(GetParam()))) ASSERT_GT(uv_area(t), 0.0);
}

TEST_P(EveryBuiltin, gets_an_orthonormal_frame_everywhere) {
    Mesh mesh = builtin(GetParam());
    make_tangents(mesh);
    EXPECT_TRUE(mesh.has_tangents);
    for (const Vertex& v : mesh.vertices) {
        const glm::vec3 tangent(v.tangent);
        EXPECT_NEAR(glm::length(tangent), 1.0f, 1e-5f);
        EXPECT_NEAR(glm::dot(tangent, v.normal), 0.0f, 1e-5f);
        EXPECT_EQ(v.tangent.w, 1.0f);
    }
}

TEST(BuiltinMeshes, are_listed_in_the_order_shown) {
    std::string order;
    for (const BuiltinMesh& mesh : builtin_meshes()) {
        order += std::string(mesh.id) + " ";
        EXPECT_FALSE(mesh.title.empty());
        EXPECT_TRUE(mesh.description.ends_with('.'));
    }
    EXPECT_EQ(order, "sphere quad cube torus shaderball ");
}

TEST(BuiltinMeshes, have_the_areas_and_volumes_of_their_ideals) {
    const double pi = std::numbers::pi;
    const Mesh sphere = builtin("sphere");
    EXPECT_NEAR(area(sphere), 4 * pi, 4 * pi * 1e-3);
    EXPECT_NEAR(volume(sphere), 4 * pi / 3, 4 * pi / 3 * 1e-3);
    EXPECT_NEAR(area(builtin("quad")), 4.0, 1e-6);

    const double h = 1.0 / (std::sqrt(3.0) * 0.84 + 0.16);
    const double r = 0.16 * h;
    const double s = 2 * (h - r);  // Steiner's formula for a cube grown by r
    EXPECT_NEAR(volume(builtin("cube")),
                s * s * s + 6 * s * s * r + 3 * pi * s * r * r + 4 * pi / 3 * r * r * r, 2e-3);
    EXPECT_NEAR(area(builtin("cube")), 6 * s * s + 6 * pi * s * r + 4 * pi * r * r, 5e-3);

    const Mesh torus = builtin("torus");
    EXPECT_NEAR(volume(torus), 2 * pi * pi * 0.7 * 0.3 * 0.3, 2e-3);
    EXPECT_NEAR(area(torus), 4 * pi * pi * 0.7 * 0.3, 5e-3);
}

TEST(BuiltinMeshes, the_sphere_shows_the_middle_of_the_picture_to_the_viewer) {
    for (const Vertex& v : builtin("sphere").vertices) {
        EXPECT_EQ(v.position, v.normal);
        if (glm::distance(v.uv, glm::vec2(0.5f, 0.5f)) < 1e-6f) {
            EXPECT_LT(glm::distance(v.position, glm::vec3(0, 0, 1)), 1e-6f);
        }
        if (glm::distance(v.uv, glm::vec2(1.0f, 0.5f)) < 1e-6f) {
            EXPECT_LT(glm::distance(v.position, glm::vec3(1, 0, 0)), 1e-6f);
        }
        if (v.uv.y == 1.0f) {
            EXPECT_EQ(v.position, glm::vec3(0, 1, 0));
        }
    }
}

TEST(BuiltinMeshes, pictures_keep_their_proportions_around_the_spheres_equator) {
    for (const Corners& t : triangles(builtin("sphere"))) {
        const glm::dvec3 middle =
            (glm::dvec3(t.a.position) + glm::dvec3(t.b.position) + glm::dvec3(t.c.position)) / 3.0;
        if (std::abs(middle.y) > 0.05) continue;
        EXPECT_NEAR(glm::length(along_u(t)) / glm::length(along_v(t)), 1.0, 0.01);
    }
}

TEST(BuiltinMeshes, textures_stand_upright_where_there_is_an_up) {
    for (const char* id : {"sphere", "quad", "cube"})
        for (const Corners& t : triangles(builtin(id))) {
            const glm::dvec3 up = glm::normalize(along_v(t));
            const glm::dvec3 n = glm::normalize(area_vector(t));
            if (std::abs(n.y) < 0.5) {
                ASSERT_GT(up.y, 0.6) << id;
            }
        }
}

TEST(BuiltinMeshes, the_quad_is_the_picture) {
    const Mesh quad = builtin("quad");
    ASSERT_EQ(quad.vertices.size(), 4u);
    for (const Vertex& v : quad.vertices) {
        EXPECT_EQ(v.position, glm::vec3(v.uv * 2.0f - 1.0f, 0.0f));
        EXPECT_EQ(v.normal, glm::vec3(0, 0, 1));
    }
}

TEST(BuiltinMeshes, each_cube_face_shows_the_whole_picture) {
    std::map<int, std::pair<glm::vec2, glm::vec2>> range;
    for (const Vertex& v : builtin("cube").vertices) {
        const glm::vec3 a = glm::abs(v.normal);
        const float largest = std::max({a.x, a.y, a.z});
        if (largest < 0.9f) continue;
        const int axis = a.x == largest ? 0 : a.y == largest ? 1 : 2;
        auto& [low, high] =
            range.try_emplace(axis * 2 + (v.normal[axis] < 0), glm::vec2(1), glm::vec2(0)).first->second;
        low = glm::min(low, v.uv);
        high = glm::max(high, v.uv);
    }
    EXPECT_EQ(range.size(), 6u);
    for (const auto& [face, r] : range) {
        EXPECT_LT(std::max(r.first.x, r.first.y), 0.1f);
        EXPECT_GT(std::min(r.second.x, r.second.y), 0.9f);
    }
}

TEST(BuiltinMeshes, are_the_same_every_time) {
    for (const BuiltinMesh& mesh : builtin_meshes()) {
        const Mesh first = mesh.make();
        const Mesh second = mesh.make();
        EXPECT_EQ(first.vertices, second.vertices);
        EXPECT_EQ(first.indices, second.indices);
    }
}

}  // namespace
}  // namespace patina
