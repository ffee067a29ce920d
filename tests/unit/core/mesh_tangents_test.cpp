#include "mesh_tools.h"
#include "renderer/core/mesh.h"

#include <glm/mat3x3.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace patina {
namespace {

using namespace test;

Mesh with_tangents(Mesh mesh) {
    make_tangents(mesh);
    return mesh;
}
Mesh builtin(std::string_view id) {
    for (const BuiltinMesh& mesh : builtin_meshes())
        if (mesh.id == id) return mesh.make();
    throw std::runtime_error("no such mesh");
}
glm::vec3 bitangent(const Vertex& v) { return v.tangent.w * glm::cross(v.normal, glm::vec3(v.tangent)); }
void expect_near(const glm::vec3& a, const glm::vec3& b, float tolerance) {
    EXPECT_LT(glm::distance(a, b), tolerance) << a.x << " " << a.y << " " << a.z;
}
void expect_orthonormal(const Mesh& mesh) {
    for (const Vertex& v : mesh.vertices) {
        const glm::mat3 frame(glm::vec3(v.tangent), bitangent(v), v.normal);
        ASSERT_NEAR(std::abs(glm::determinant(frame)), 1.0f, 1e-4f);
        ASSERT_NEAR(glm::dot(glm::vec3(v.tangent), v.normal), 0.0f, 1e-5f);
        ASSERT_EQ(std::abs(v.tangent.w), 1.0f);
    }
}

/// Two unit squares side by side in x, sharing the edge x = 0; u runs away from it on both sides if mirrored.
Mesh two_squares(bool mirrored) {
    Mesh mesh;
    for (int j = 0; j < 2; ++j)
        for (int i = -1; i <= 1; ++i) {
            const float u = mirrored ? std::abs(float(i)) : 0.5f + 0.5f * float(i);
            mesh.vertices.push_back({.position = {i, j, 0}, .uv = {u, j}});
        }
    mesh.indices = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4};
    return mesh;
}

TEST(Tangents, follow_u_on_the_quad) {
    for (const Vertex& v : with_tangents(builtin("quad")).vertices)
        EXPECT_EQ(v.tangent, glm::vec4(1, 0, 0, 1));
}

TEST(Tangents, turn_around_where_the_picture_is_mirrored) {
    Mesh quad = builtin("quad");
    for (Vertex& v : quad.vertices) v.uv.x = 1.0f - v.uv.x;
    for (const Vertex& v : with_tangents(quad).vertices) {
        EXPECT_EQ(v.tangent, glm::vec4(-1, 0, 0, -1));
        expect_near(bitangent(v), {0, 1, 0}, 1e-6f);
    }
    Mesh upside_down = builtin("quad");
    for (Vertex& v : upside_down.vertices) v.uv.y = 1.0f - v.uv.y;
    for (const Vertex& v : with_tangents(upside_down).vertices) EXPECT_EQ(v.tangent, glm::vec4(1, 0, 0, -1));
}

TEST(Tangents, split_vertices_only_along_the_mirror_seam) {
    EXPECT_EQ(with_tangents(two_squares(false)).vertices.size(), 6u);
    const Mesh mesh = with_tangents(two_squares(true));
    EXPECT_EQ(mesh.vertices.size(), 8u);
    for (const Corners& t : triangles(mesh)) {
        const bool left = t.a.position.x + t.b.position.x + t.c.position.x < 0.0f;
        for (const Vertex& v : {t.a, t.b, t.c})
            EXPECT_EQ(v.tangent, left ? glm::vec4(-1, 0, 0, -1) : glm::vec4(1, 0, 0, 1));
    }
    for (std::size_t i = 0; i < 6; ++i)
        EXPECT_EQ(mesh.vertices[i].position, two_squares(true).vertices[i].position);
}

TEST(Tangents, are_averaged_by_angle_and_not_by_area) {
    // Two triangles at the origin with corners of 90° and 45° there, whose uvs grow along different
    // directions.
    Mesh mesh;
    mesh.vertices = {{.position = {0, 0, 0}, .uv = {0, 0}},
                     {.position = {5, 0, 0}, .uv = {5, 0}},
                     {.position = {0, 1, 0}, .uv = {0, 1}},
                     {.position = {-3, 3, 0}, .uv = {-1, 1}}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    const auto direction = [&](int b, int c) {
        const glm::vec3 p1 = mesh.vertices[std::size_t(b)].position,
                        p2 = mesh.vertices[std::size_t(c)].position;
        const glm::vec2 t1 = mesh.vertices[std::size_t(b)].uv, t2 = mesh.vertices[std::size_t(c)].uv;
        return glm::normalize((t2.y * p1 - t1.y * p2) / (t1.x * t2.y - t1.y * t2.x));
    };
    const float right_angle = std::numbers::pi_v<float> / 2;
    const glm::vec3 expected =
        glm::normalize(direction(1, 2) * right_angle + direction(2, 3) * (right_angle / 2));
    ASSERT_GT(glm::distance(direction(1, 2), direction(2, 3)), 0.5f);
    const Mesh result = with_tangents(mesh);
    ASSERT_EQ(result.vertices.size(), 4u);
    expect_near(glm::vec3(result.vertices[0].tangent), expected, 1e-6f);
}

TEST(Tangents, follow_the_parallels_of_the_sphere) {
    for (const Vertex& v : with_tangents(builtin("sphere")).vertices) {
        const float angle = (v.uv.x - 0.5f) * std::numbers::pi_v<float>;
        expect_near(glm::vec3(v.tangent), {std::cos(angle), 0, -std::sin(angle)}, 0.02f);
        EXPECT_EQ(v.tangent.w, 1.0f);
    }
}

TEST(Tangents, follow_each_face_of_a_cube_and_add_no_vertex) {
    const Mesh before = builtin("cube");
    const Mesh cube = with_tangents(before);
    EXPECT_EQ(cube.vertices.size(), before.vertices.size());
    for (const Vertex& v : cube.vertices) {
        // At a flat face's own corners the rounded corner beside it has a small say.
        if (v.normal == glm::vec3(0, 0, 1)) expect_near(glm::vec3(v.tangent), {1, 0, 0}, 1e-3f);
        if (v.normal == glm::vec3(1, 0, 0)) expect_near(glm::vec3(v.tangent), {0, 0, -1}, 1e-3f);
        if (v.normal == glm::vec3(0, 1, 0)) expect_near(bitangent(v), {0, 0, -1}, 1e-3f);
    }
    expect_orthonormal(cube);
}

TEST(Tangents, find_a_frame_where_uvs_say_nothing) {
    Mesh flat = builtin("sphere");
    for (Vertex& v : flat.vertices) v.uv = {0.25f, 0.75f};
    expect_orthonormal(with_tangents(flat));
    Mesh line = builtin("torus");
    for (Vertex& v : line.vertices) v.uv.y = 0.0f;
    expect_orthonormal(with_tangents(line));
}

TEST(Tangents, of_triangles_without_uv_area_come_from_their_neighbours) {
    Mesh mesh = two_squares(false);
    mesh.vertices[2].uv =
        mesh.vertices[5].uv = {0.5f, 0.0f};  // the right square loses its uv area in one triangle
    mesh.vertices[5].uv = {0.5f, 1.0f};
    const Mesh result = with_tangents(mesh);
    EXPECT_EQ(result.vertices.size(), 6u);
    expect_orthonormal(result);
    EXPECT_EQ(result.vertices[1].tangent, glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(result.vertices[4].tangent, glm::vec4(1, 0, 0, 1));
}

TEST(Tangents, ignore_triangles_without_area) {
    Mesh mesh = two_squares(false);
    mesh.indices.insert(mesh.indices.end(), {1, 1, 4, 3, 3, 3});
    const Mesh result = with_tangents(mesh);
    EXPECT_EQ(result.vertices.size(), 6u);
    for (const Vertex& v : result.vertices) EXPECT_EQ(v.tangent, glm::vec4(1, 0, 0, 1));
}

TEST(Tangents, are_shared_by_copies_of_one_vertex_as_if_it_were_indexed) {
    const Mesh indexed = with_tangents(builtin("torus"));
    Mesh soup = builtin("torus");
    const Mesh source = soup;
    soup.vertices.clear();
    for (std::uint32_t& index : soup.indices) {
        soup.vertices.push_back(source.vertices[index]);
        index = std::uint32_t(soup.vertices.size()) - 1;
    }
    make_tangents(soup);
    ASSERT_EQ(soup.indices.size(), indexed.indices.size());
    for (std::size_t i = 0; i < soup.indices.size(); ++i)
        EXPECT_EQ(soup.vertices[soup.indices[i]].tangent, indexed.vertices[indexed.indices[i]].tangent);
}

/// Triangles in another order, each begun at another corner, vertices renumbered.
Mesh shuffled(const Mesh& mesh, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<std::uint32_t> new_index(mesh.vertices.size());
    for (std::uint32_t i = 0; i < new_index.size(); ++i) new_index[i] = i;
    std::shuffle(new_index.begin(), new_index.end(), random);
    Mesh result = mesh;
    for (std::size_t i = 0; i < new_index.size(); ++i) result.vertices[new_index[i]] = mesh.vertices[i];
    std::vector<std::uint32_t> order(mesh.indices.size() / 3);
    for (std::uint32_t t = 0; t < order.size(); ++t) order[t] = t;
    std::shuffle(order.begin(), order.end(), random);
    for (std::size_t t = 0; t < order.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            result.indices[3 * t + k] = new_index[mesh.indices[3 * order[t] + (k + t) % 3]];
    return result;
}

TEST(Tangents, do_not_depend_on_the_order_of_triangles_corners_or_vertices) {
    const auto sorted = [](const Mesh& mesh) {
        std::vector<std::array<float, 12>> rows;
        for (const Vertex& v : mesh.vertices)
            rows.push_back({v.position.x, v.position.y, v.position.z, v.normal.x, v.normal.y, v.normal.z,
                            v.uv.x, v.uv.y, std::round(v.tangent.w), v.tangent.x, v.tangent.y, v.tangent.z});
        std::sort(rows.begin(), rows.end());
        return rows;
    };
    for (const Mesh& mesh : {builtin("cube"), two_squares(true)}) {
        const auto expected = sorted(with_tangents(mesh));
        const auto found = sorted(with_tangents(shuffled(mesh, 7)));
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < found.size(); ++i)
            for (std::size_t k = 0; k < 12; ++k) ASSERT_NEAR(found[i][k], expected[i][k], 2e-6f);
    }
}

TEST(Tangents, take_their_sign_from_the_uv_winding_alone_as_bakers_do) {
    Mesh mesh = two_squares(true);
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    for (const Corners& t : triangles(with_tangents(mesh))) {
        const bool left = t.a.position.x + t.b.position.x + t.c.position.x < 0.0f;
        expect_near(glm::vec3(t.a.tangent), {left ? -1 : 1, 0, 0}, 1e-6f);
        EXPECT_EQ(t.a.tangent.w, left ? 1.0f : -1.0f);
    }
}

TEST(Tangents, of_a_vast_fan_take_no_more_than_linear_time) {
    constexpr std::uint32_t kSpokes = 100000;
    Mesh mesh;
    mesh.vertices.push_back({.uv = {0.5f, 0.5f}});
    for (std::uint32_t i = 0; i < kSpokes; ++i) {
        const float a = 6.2831853f * float(i) / kSpokes;
        const glm::vec2 p(std::cos(a), std::sin(a));
        mesh.vertices.push_back({.position = {p, 0}, .uv = 0.5f + 0.5f * p});
        mesh.indices.insert(mesh.indices.end(), {0, i + 1, (i + 1) % kSpokes + 1});
    }
    make_tangents(mesh);
    expect_near(glm::vec3(mesh.vertices[0].tangent), {1, 0, 0}, 1e-3f);
}

}  // namespace
}  // namespace patina
