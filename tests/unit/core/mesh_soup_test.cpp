#include "renderer/core/mesh_soup.h"

#include "mesh_tools.h"
#include "renderer/core/mesh_adjacency.h"
#include "renderer/core/mesh_bounds.h"
#include "renderer/core/mesh_normals.h"
#include "renderer/core/mesh_triangulate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>

namespace patina {
namespace {

using namespace test;

constexpr double kPi = std::numbers::pi;

// ---- Triangulation

using Cut = std::vector<std::array<std::uint32_t, 3>>;
Cut cut(const std::vector<glm::dvec3>& polygon) {
    Cut triangles;
    triangulate(polygon, triangles);
    return triangles;
}
std::vector<glm::dvec3> in_plane(const std::vector<glm::dvec2>& points) {
    // A plane that is aligned with nothing.
    const glm::dvec3 right = glm::normalize(glm::dvec3(2, -1, 0.5));
    const glm::dvec3 up = glm::normalize(glm::cross(glm::dvec3(0.3, 0.5, 0.9), right));
    std::vector<glm::dvec3> polygon;
    for (const glm::dvec2& p : points) polygon.push_back(glm::dvec3(3, 1, 2) + p.x * right + p.y * up);
    return polygon;
}
double polygon_area(const std::vector<glm::dvec2>& p) {
    double sum = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const glm::dvec2& a = p[i];
        const glm::dvec2& b = p[(i + 1) % p.size()];
        sum += a.x * b.y - a.y * b.x;
    }
    return 0.5 * sum;
}
/// The triangles turn as the polygon does and add up to its area: they cover it once.
void expect_cover(const std::vector<glm::dvec2>& points) {
    const Cut triangles = cut(in_plane(points));
    EXPECT_EQ(triangles.size(), points.size() - 2);
    double sum = 0.0;
    for (const auto& t : triangles) {
        const double a = polygon_area({points[t[0]], points[t[1]], points[t[2]]});
        EXPECT_GT(a, -1e-12);
        sum += a;
    }
    EXPECT_NEAR(sum, polygon_area(points), 1e-9);
}

TEST(MeshTriangulate, covers_convex_and_concave_polygons_once) {
    expect_cover({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    expect_cover({{0, 0}, {4, 0}, {1, 1}, {0, 4}});
    expect_cover({{1, 1}, {0, 4}, {0, 0}, {4, 0}});
    expect_cover({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {3, 2}, {3, 3}, {0, 3}});
    expect_cover({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 3}, {2, 1}, {1, 3}, {0, 3}});
    std::vector<glm::dvec2> spiral;
    for (int i = 0; i <= 60; ++i)
        spiral.push_back((1.0 + i * 0.1) * glm::dvec2(std::cos(i * 0.2), std::sin(i * 0.2)));
    for (int i = 60; i >= 0; --i)
        spiral.push_back((0.6 + i * 0.1) * glm::dvec2(std::cos(i * 0.2), std::sin(i * 0.2)));
    expect_cover(polygon_area(spiral) > 0 ? spiral : std::vector(spiral.rbegin(), spiral.rend()));
}

TEST(MeshTriangulate, covers_a_polygon_with_a_hole_joined_by_a_bridge) {
    expect_cover({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}});
}

TEST(MeshTriangulate, cuts_quads_inside_and_along_the_shorter_diagonal) {
    EXPECT_EQ(cut(in_plane({{0, 0}, {2, 0}, {3, 1}, {0, 1}}))[0], (std::array<std::uint32_t, 3>{1, 2, 3}));
    EXPECT_EQ(cut(in_plane({{0, 0}, {4, 0}, {1, 1}, {0, 4}}))[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
    EXPECT_EQ(cut(in_plane({{4, 0}, {1, 1}, {0, 4}, {0, 0}}))[0], (std::array<std::uint32_t, 3>{1, 2, 3}));
}

TEST(MeshTriangulate, covers_random_stars_with_many_corners) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> radius(0.2, 1.0);
    for (const int n : {5, 6, 7, 17, 100, 1001}) {
        std::vector<glm::dvec2> star;
        for (int i = 0; i < n; ++i)
            star.push_back(radius(random) * glm::dvec2(std::cos(2 * kPi * i / n), std::sin(2 * kPi * i / n)));
        expect_cover(star);
    }
}

TEST(MeshTriangulate, ends_on_polygons_that_cross_themselves_and_skips_those_without_area) {
    EXPECT_EQ(cut(in_plane({{0, 0}, {3, 3}, {3, 0}, {0, 2}, {1, 5}})).size(), 3u);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    std::vector<glm::dvec2> scribble;
    for (int i = 0; i < 500; ++i) scribble.emplace_back(any(random), any(random));
    EXPECT_EQ(cut(in_plane(scribble)).size(), 498u);
    EXPECT_TRUE(cut({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}).empty());
    EXPECT_TRUE(cut({{0, 0, 0}, {1, 0, 0}}).empty());
}

TEST(MeshTriangulate, cuts_a_hundred_thousand_corners_in_no_time) {
    constexpr std::size_t kCorners = 100000;
    std::vector<glm::dvec3> star;
    for (std::size_t i = 0; i < kCorners; ++i) {
        const double a = 2 * kPi * double(i) / kCorners;
        star.push_back((i % 2 == 0 ? 1.0 : 0.9) * glm::dvec3(std::cos(a), std::sin(a), 0));
    }
    EXPECT_EQ(cut(star).size(), kCorners - 2);
}

// ---- Adjacency

TEST(MeshAdjacency, pairs_half_edges_that_run_opposite_ways) {
    const std::vector<std::uint32_t> corners{0, 1, 2, 2, 1, 3};
    const auto opposite = opposite_half_edges(corners);
    EXPECT_EQ(opposite, (std::vector<std::uint32_t>{kNoCorner, 3, kNoCorner, 1, kNoCorner, kNoCorner}));
}

TEST(MeshAdjacency, leaves_alone_what_has_no_partner) {
    const auto same_way = opposite_half_edges(std::vector<std::uint32_t>{0, 1, 2, 0, 1, 3});
    EXPECT_EQ(std::set(same_way.begin(), same_way.end()), std::set{kNoCorner});
    const auto fin = opposite_half_edges(std::vector<std::uint32_t>{0, 1, 2, 1, 0, 3, 1, 0, 4});
    EXPECT_EQ(fin[0], 3u);
    EXPECT_EQ(fin[3], 0u);
    EXPECT_EQ(fin[6], kNoCorner);
    const auto degenerate = opposite_half_edges(std::vector<std::uint32_t>{0, 0, 1, 5, 5, 5});
    EXPECT_EQ(std::set(degenerate.begin(), degenerate.end()), std::set{kNoCorner});
}

// ---- Normals

/// A roof of two triangles that folds by so many degrees along the x axis.
std::vector<glm::vec3> roof_normals(double fold_degrees) {
    const double a = fold_degrees / 180.0 * kPi;
    const std::vector<glm::vec3> places{
        {0, 0, 0}, {1, 0, 0}, {0.5f, 1, 0}, {0.5f, -std::cos(a), -std::sin(a)}};
    const std::vector<std::uint32_t> corners{0, 1, 2, 1, 0, 3};
    return smooth_normals({corners, places}, 60.0);
}

TEST(MeshNormals, are_smooth_up_to_sixty_degrees_and_creased_above) {
    for (const double fold : {0.0, 20.0, 59.9, 60.0}) {
        const auto n = roof_normals(fold);
        EXPECT_EQ(n[0], n[4]);
        EXPECT_EQ(n[1], n[3]);
        EXPECT_NEAR(glm::dot(n[0], glm::vec3(0, 0, 1)), std::cos(fold / 2 / 180 * kPi), 1e-5);
    }
    for (const double fold : {60.1, 90.0, 170.0})
        EXPECT_LT(glm::distance(roof_normals(fold)[0], glm::vec3(0, 0, 1)), 1e-6f);
}

TEST(MeshNormals, weigh_triangles_by_their_angle_however_they_are_cut) {
    // The corner of a cube of smooth faces (crease 180°): however many triangles each face brings, (1, 1,
    // 1)/√3.
    const std::vector<glm::vec3> places{{0, 0, 0},  {-1, 0, 0},  {0, -1, 0},
                                        {0, 0, -1}, {-1, -1, 0}, {-9, -1, 0}};
    const std::vector<std::uint32_t> corners{0, 1, 4, 0, 4, 2, 0, 2, 3, 0, 3, 1};
    const auto n = smooth_normals({corners, places}, 180.0);
    EXPECT_LT(glm::distance(n[0], glm::vec3(0.57735f)), 1e-5f);
}

TEST(MeshNormals, on_a_cone_differ_around_the_tip_only_across_creases) {
    // A pyramid of four sides is creased, one of 64 is smooth.
    const auto tip_normals = [](std::uint32_t sides) {
        std::vector<glm::vec3> places{{0, 0, 1}};
        std::vector<std::uint32_t> corners;
        for (std::uint32_t i = 0; i < sides; ++i) {
            const double a = 2 * kPi * i / sides;
            places.emplace_back(std::cos(a), std::sin(a), 0);
            corners.insert(corners.end(), {0, i + 1, (i + 1) % sides + 1});
        }
        const auto n = smooth_normals({corners, places}, 60.0);
        std::set<std::tuple<float, float, float>> distinct;
        for (std::size_t c = 0; c < corners.size(); c += 3) distinct.insert({n[c].x, n[c].y, n[c].z});
        return distinct.size();
    };
    EXPECT_EQ(tip_normals(4), 4u);
    EXPECT_EQ(tip_normals(64), 1u);
}

// ---- The whole way

TEST(MeshSoup, makes_one_vertex_of_equal_corners_and_forgets_unused_points) {
    PolygonSoup soup;
    soup.positions = {{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}, {-0.0f, 0, 0}};
    soup.corner_position = {1, 2, 3, 5, 3, 4, 6, 4, 2};
    soup.face_begin = {0, 3, 6, 9};
    const Mesh mesh = make_mesh(soup);
    EXPECT_EQ(mesh.vertices.size(), 7u);  // the last triangle faces the other way
    for (const Vertex& v : mesh.vertices) EXPECT_NEAR(glm::length(v.position), 1.0f, 1e-6f);
}

TEST(MeshSoup, cuts_one_polygon_alike_wherever_it_begins) {
    for (std::uint32_t n = 4; n < 9; ++n) {
        PolygonSoup soup;
        for (std::uint32_t i = 0; i < n; ++i)
            soup.positions.emplace_back(std::cos(2 * kPi * i / n), std::sin(2 * kPi * i / n), 0);
        for (std::uint32_t begin = 0; begin < n; ++begin) {
            for (std::uint32_t i = 0; i < n; ++i) soup.corner_position.push_back((begin + i) % n);
            soup.face_begin.push_back(std::uint32_t(soup.corner_position.size()));
        }
        const Mesh mesh = make_mesh(soup);
        EXPECT_EQ(mesh.indices.size(), 3 * (n - 2));
        EXPECT_TRUE(says(mesh.notes, "duplicate triangles were dropped"));
    }
}

TEST(MeshSoup, copes_with_a_hundred_thousand_faces_around_one_vertex_or_edge) {
    constexpr std::uint32_t kFaces = 100000;
    for (const bool around_an_edge : {false, true}) {
        PolygonSoup soup;
        soup.positions = {{0, 0, 1}, {0, 0, -1}};
        for (std::uint32_t i = 0; i < kFaces; ++i) {
            const double a = 2 * kPi * i / kFaces;
            soup.positions.emplace_back(std::cos(a), std::sin(a), 0);
            const std::uint32_t other = around_an_edge ? 1 : 2 + (i + 1) % kFaces;
            soup.corner_position.insert(soup.corner_position.end(), {0, 2 + i, other});
            soup.face_begin.push_back(3 * i + 3);
        }
        Mesh mesh = make_mesh(soup);
        make_tangents(mesh);
        EXPECT_EQ(mesh.indices.size(), 3 * kFaces);
    }
}

TEST(MeshSoup, projects_texture_coordinates_upright_from_six_sides) {
    PolygonSoup soup;
    std::mt19937 random(1);
    std::normal_distribution<float> any(0.0f, 1.0f);
    for (std::uint32_t t = 0; t < 200; ++t) {
        for (int k = 0; k < 3; ++k) soup.positions.emplace_back(any(random), any(random), any(random));
        soup.corner_position.insert(soup.corner_position.end(), {3 * t, 3 * t + 1, 3 * t + 2});
        soup.face_begin.push_back(3 * t + 3);
    }
    const Mesh mesh = make_mesh(soup);
    EXPECT_FALSE(mesh.has_uvs);
    for (const Corners& t : triangles(mesh)) {
        EXPECT_GT(uv_area(t), 0.0);
        for (const Vertex& v : {t.a, t.b, t.c})
            EXPECT_TRUE(v.uv.x >= 0 && v.uv.x <= 1 && v.uv.y >= 0 && v.uv.y <= 1);
    }
}

TEST(MeshSoup, takes_equal_texture_coordinates_everywhere_for_none) {
    PolygonSoup soup;
    soup.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    soup.corner_position = {0, 1, 2};
    soup.face_begin = {0, 3};
    soup.corner_uv.assign(3, {0.5f, 0.5f});
    const Mesh mesh = make_mesh(soup);
    EXPECT_FALSE(mesh.has_uvs);
    EXPECT_TRUE(says(mesh.notes, "are the same"));
}

TEST(MeshNormalize, reaches_the_unit_sphere_from_anywhere) {
    std::mt19937 random(2);
    std::normal_distribution<float> any(0.0f, 1.0f);
    for (const float scale : {1e-18f, 1e-3f, 1.0f, 1e18f}) {
        Mesh mesh;
        for (std::uint32_t i = 0; i < 30; ++i) {
            const glm::vec3 p(any(random), 3.0f * any(random), any(random) + 5.0f);
            mesh.vertices.push_back({.position = scale * p});
            mesh.indices.push_back(i);
        }
        normalize_to_unit_sphere(mesh);
        float reach = 0.0f;
        for (const Vertex& v : mesh.vertices) reach = std::max(reach, glm::length(v.position));
        EXPECT_NEAR(reach, 1.0f, 1e-6f) << scale;
    }
}

TEST(MeshNormalize, refuses_meshes_without_a_size) {
    Mesh nothing;
    EXPECT_THROW(normalize_to_unit_sphere(nothing), std::runtime_error);
    Mesh point;
    point.vertices.resize(3);
    point.indices = {0, 1, 2};
    EXPECT_THROW(normalize_to_unit_sphere(point), std::runtime_error);
    Mesh line = point;
    line.vertices[1].position.x = 1.0f;
    line.vertices[2].position.x = 2.0f;
    EXPECT_THROW(normalize_to_unit_sphere(line), std::runtime_error);
    Mesh lost = point;
    lost.vertices[1].position.x = std::numeric_limits<float>::infinity();
    EXPECT_THROW(normalize_to_unit_sphere(lost), std::runtime_error);
}

TEST(BoundingSphere, is_the_smallest) {
    const auto of = [](std::vector<glm::dvec3> points) { return smallest_enclosing_sphere(points); };
    EXPECT_EQ(of({{1, 2, 3}}).radius, 0.0);
    EXPECT_NEAR(of({{1, 0, 0}, {-1, 0, 0}, {0, 0.5, 0}}).radius, 1.0, 1e-9);
    EXPECT_NEAR(of({{1, 0, 0}, {-0.5, 0.75, 0}, {-0.5, -0.75, 0}, {0, 0, 0.1}}).radius, 0.9375, 1e-9);
    EXPECT_NEAR(of({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}, {0, 0, 0}}).radius, std::sqrt(3.0),
                1e-9);
    std::vector<glm::dvec3> cube;
    for (int i = 0; i < 8; ++i) cube.emplace_back(i & 1, i >> 1 & 1, i >> 2);
    EXPECT_NEAR(of(cube).radius, std::sqrt(3.0) / 2, 1e-9);
    std::mt19937 random(4);
    std::normal_distribution<double> any(0.0, 1.0);
    std::vector<glm::dvec3> shell;
    for (int i = 0; i < 5000; ++i)
        shell.push_back(glm::dvec3(7, 8, 9) +
                        2.0 * glm::normalize(glm::dvec3(any(random), any(random), any(random))));
    const BoundingSphere sphere = of(shell);
    EXPECT_NEAR(sphere.radius, 2.0, 1e-3);
    EXPECT_LE(sphere.radius, 2.0 + 1e-9);
    EXPECT_NEAR(glm::distance(sphere.center, glm::dvec3(7, 8, 9)), 0.0, 1e-2);
    for (const glm::dvec3& p : shell) EXPECT_LE(glm::distance(p, sphere.center), sphere.radius * (1 + 1e-8));
}

}  // namespace
}  // namespace patina
