#include "renderer/core/mesh_io.h"

#include "mesh_tools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <locale>
#include <thread>

namespace patina {
namespace {

using namespace test;

/// What load_mesh says about a file that it refuses.
std::string refusal(const std::filesystem::path& file) {
    try {
        load_mesh(file);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}
std::string refusal_of(const std::string& name, std::string_view bytes) {
    const MeshFolder folder;
    const std::string said = refusal(folder.write(name, bytes));
    EXPECT_NE(said.find(name), std::string::npos) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    return said;
}
Mesh loaded(const std::string& name, std::string_view bytes) {
    const MeshFolder folder;
    return load_mesh(folder.write(name, bytes));
}

constexpr std::string_view kCube =
    "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
constexpr std::string_view kTriangle = "v 0 0 0\nv 2 0 0\nv 0 2 0\n";

TEST(MeshObj, reads_a_cube_centred_and_scaled_with_hard_edges) {
    const Mesh mesh = loaded("my cube.obj", kCube);
    EXPECT_EQ(mesh.name, "my cube");
    EXPECT_EQ(mesh.indices.size(), 36u);
    EXPECT_EQ(mesh.vertices.size(), 24u);
    EXPECT_FALSE(mesh.has_uvs);
    EXPECT_FALSE(mesh.has_tangents);
    EXPECT_TRUE(says(mesh.notes, "no texture coordinates"));
    EXPECT_TRUE(says(mesh.notes, "Normals were computed"));
    EXPECT_NEAR(volume(mesh), 8.0 / std::pow(3.0, 1.5), 1e-6);
    for (const Corners& t : triangles(mesh)) {
        EXPECT_NEAR(glm::dot(glm::normalize(area_vector(t)), glm::dvec3(t.b.normal)), 1.0, 1e-6);
        EXPECT_GT(uv_area(t), 0.0);
    }
}

TEST(MeshObj, keeps_normals_and_texture_coordinates_of_each_corner) {
    const Mesh mesh = loaded("corners.obj",
                             "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 2 2 0\n"
                             "vt 0.1 0.2\nvt 0.3 0.4\nvt 0.5 0.6\nvt 0.7 0.8\nvt 0.9 1\n"
                             "vn 0 0 1\nvn 0 3 4\nvn 1 0 0\n"
                             "f 1/1/1 2/2/2 3/3/3\nf 2/5/1 4/4/1 3/3/2\n");
    ASSERT_EQ(mesh.indices.size(), 6u);
    EXPECT_EQ(mesh.vertices.size(), 6u);
    const auto corner = [&](int i) { return mesh.vertices[mesh.indices[std::size_t(i)]]; };
    EXPECT_EQ(corner(0).uv, glm::vec2(0.1f, 0.2f));
    EXPECT_EQ(corner(1).uv, glm::vec2(0.3f, 0.4f));
    EXPECT_EQ(corner(3).uv, glm::vec2(0.9f, 1.0f));
    EXPECT_EQ(corner(1).position, corner(3).position);
    EXPECT_LT(glm::distance(corner(1).normal, glm::vec3(0, 0.6f, 0.8f)), 1e-6f);
    EXPECT_EQ(corner(2).normal, glm::vec3(1, 0, 0));
    EXPECT_EQ(corner(3).normal, glm::vec3(0, 0, 1));
    EXPECT_TRUE(mesh.has_uvs);
    EXPECT_TRUE(mesh.notes.empty()) << mesh.notes.front();
}

TEST(MeshObj, reads_every_form_of_corner_and_fills_in_what_a_face_leaves_out) {
    const Mesh mesh = loaded("mixed.obj",
                             "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nvt 0.5 0.25\nvt 1 0\nvn 1 0 0\n"
                             "f 1 2 3\nf 1//1 3//1 4//1\nf 1/1 4/2 2/2\n");
    ASSERT_EQ(mesh.indices.size(), 9u);
    const auto corner = [&](int i) { return mesh.vertices[mesh.indices[std::size_t(i)]]; };
    EXPECT_LT(glm::distance(corner(0).normal, glm::vec3(0, 0, 1)), 1e-6f);
    EXPECT_EQ(corner(3).normal, glm::vec3(1, 0, 0));
    EXPECT_EQ(corner(6).uv, glm::vec2(0.5f, 0.25f));
    EXPECT_EQ(corner(0).uv, glm::vec2(0.0f));
    EXPECT_TRUE(says(mesh.notes, "6 missing texture coordinates"));
    EXPECT_TRUE(says(mesh.notes, "6 missing or zero normals"));
}

TEST(MeshObj, counts_negative_indices_back_from_the_line_they_stand_on) {
    const Mesh mesh = loaded("back.obj",
                             "v 9 9 9\nv 0 0 0\nv 2 0 0\nv 0 2 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                             "f -3/-3 -2/-2 -1/-1\nv 7 7 7\nvt 5 5\n");
    ASSERT_EQ(mesh.vertices.size(), 3u);
    EXPECT_EQ(mesh.vertices[0].uv, glm::vec2(0, 0));
    EXPECT_EQ(mesh.vertices[1].uv, glm::vec2(1, 0));
    EXPECT_GT(mesh.vertices[1].position.x, mesh.vertices[0].position.x);
}

TEST(MeshObj, understands_windows_and_old_mac_line_ends_continued_lines_and_comments) {
    const std::string text =
        "# a comment\r\nmtllib ../../etc/passwd\r\no thing\r\nv 0 0 0 # first\r\nv 2 0 0\r\nv +0.0 2e0 0\r\n"
        "usemtl none\r\ns 1\r\nf 1 2 \\\r\n 3 # 4\r\n";
    EXPECT_EQ(loaded("windows.obj", text).indices.size(), 3u);
    std::string mac = "v 0 0 0\nv 2 0 0\nv 0 2 0\nf 1 2 3\n";
    std::replace(mac.begin(), mac.end(), '\n', '\r');
    EXPECT_EQ(loaded("mac.obj", mac).indices.size(), 3u);
    EXPECT_EQ(loaded("mark.obj", "\xef\xbb\xbf" + std::string(kCube)).indices.size(), 36u);
}

TEST(MeshObj, keeps_faces_around_an_edge_or_vertex_that_a_half_edge_mesh_cannot_hold) {
    const Mesh fin =
        loaded("fin.obj", "v 0 0 0\nv 0 0 2\nv 1 0 0\nv -1 1 0\nv -1 -1 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\n");
    EXPECT_EQ(fin.indices.size(), 9u);
    const Mesh hourglass =
        loaded("hourglass.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv -1 0 0\nv 0 -1 0\nf 1 2 3\nf 1 4 5\n");
    EXPECT_EQ(hourglass.indices.size(), 6u);
    EXPECT_TRUE(says(hourglass.notes, "Normals"));
    const Mesh moebius = loaded("turned.obj", std::string(kTriangle) + "v 2 2 0\nf 1 2 3\nf 2 3 4\n");
    EXPECT_EQ(moebius.indices.size(), 6u);
}

TEST(MeshObj, keeps_the_hole_of_a_polygon_that_visits_vertices_twice) {
    const std::string points =
        "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 1 0\nv 1 3 0\nv 3 3 0\nv 3 1 0\nvt 0 0\nvt 1 1\nvn 0 0 1\n";
    const double scale = 1.0 / 8.0;  // the enclosing circle has the radius √8
    for (const char* face :
         {"f 1 2 3 4 1 5 6 7 8 5", "f -8//-1 2//1 3//1 4//1 1//1 5//1 6//1 7//1 8//1 -4//-1\n",
          "f 1/1/1 2/2/1 3/1/1 4/1/1 1/1/1 5/2/1 6/1/1 7/1/1 8/1/1 5/-1/1\nv 9 9 9\nvt 7 7\n"}) {
        const Mesh mesh = loaded("hole.obj", points + face);
        EXPECT_EQ(mesh.indices.size(), 24u) << face;
        EXPECT_NEAR(area(mesh), 12.0 * scale, 1e-6) << face;
        for (const Vertex& v : mesh.vertices) {
            EXPECT_EQ(v.normal, glm::vec3(0, 0, 1));
            EXPECT_LE(v.uv.x, 1.0f);
        }
    }
}

TEST(MeshObj, drops_and_counts_faces_that_show_nothing) {
    const Mesh mesh =
        loaded("dirt.obj", std::string(kCube) + "f 1 1 2\nf 1 2\nf 1 2 1\nf 5 6 7 8\nf 6 7 8 5\n");
    EXPECT_EQ(mesh.indices.size(), 36u);
    EXPECT_TRUE(says(mesh.notes, "3 faces without an area")) << mesh.notes.front();
    EXPECT_TRUE(says(mesh.notes, "4 duplicate triangles"));
    const Mesh line = loaded("line.obj", std::string(kTriangle) + "v 1 0 0\nf 1 2 3\nf 1 4 2\n");
    EXPECT_EQ(line.indices.size(), 3u);
    EXPECT_TRUE(says(line.notes, "1 face without an area"));
}

TEST(MeshObj, keeps_both_sides_of_a_sheet) {
    EXPECT_EQ(loaded("sheet.obj", std::string(kTriangle) + "f 1 2 3\nf 1 3 2\n").indices.size(), 6u);
}

TEST(MeshObj, drops_faces_that_point_nowhere_and_says_how_many) {
    const Mesh mesh = loaded("far.obj", std::string(kTriangle) + "f 1 2 3\nf 1 2 4\nf 0 1 2\nf -9 1 2\n");
    EXPECT_EQ(mesh.indices.size(), 3u);
    EXPECT_TRUE(says(mesh.notes, "3 face(s) dropped"));
    const Mesh bare = loaded("bare.obj", std::string(kTriangle) + "vt 0 0\nvt 1 0\nf 1/1/7 2/2 3/9\n");
    EXPECT_EQ(bare.vertices[1].uv, glm::vec2(1, 0));
    EXPECT_TRUE(says(bare.notes, "2 corner(s) point at no normal or texture coordinate"));
}

TEST(MeshObj, survives_numbers_that_are_none) {
    const Mesh mesh =
        loaded("nan.obj", std::string(kTriangle) +
                              "v nan 0 0\nv 1e50 0 -inf\nv 0 0 1e-60\nvt nan 0.5\n"
                              "vt 1 0.5\nvn nan 0 0\nf 1/1/1 2/2 3/1\nf 1 2 4\nf 1 2 5\nf 1 6 3\n");
    EXPECT_EQ(mesh.indices.size(), 3u);
    EXPECT_TRUE(says(mesh.notes, "2 faces were dropped: a corner points nowhere or is not finite"));
    EXPECT_TRUE(says(mesh.notes, "1 texture coordinate(s) that are not finite"));
    EXPECT_TRUE(says(mesh.notes, "1 face without an area"));
    EXPECT_EQ(mesh.vertices[0].uv, glm::vec2(0.0f, 0.5f));
    EXPECT_LT(glm::distance(mesh.vertices[0].normal, glm::vec3(0, 0, 1)), 1e-6f);
    for (const Vertex& v : mesh.vertices) EXPECT_LE(glm::length(v.position), 1.0f + 1e-6f);
}

TEST(MeshObj, recomputes_normals_of_length_zero_and_drops_single_texture_coordinates) {
    const Mesh mesh =
        loaded("zero.obj", std::string(kTriangle) + "vn 0 0 0\nvt 0.5\nvt 1\nf 1/1/1 2/2/1 3/1/1\n");
    for (const Vertex& v : mesh.vertices) EXPECT_LT(glm::distance(v.normal, glm::vec3(0, 0, 1)), 1e-6f);
    EXPECT_TRUE(says(mesh.notes, "single number"));
    EXPECT_FALSE(mesh.has_uvs);
}

TEST(MeshObj, says_which_line_it_cannot_read) {
    EXPECT_NE(refusal_of("word.obj", "v 0 0 0\nv 1 zero 0\n").find("line 2: a vertex needs 3 numbers"),
              std::string::npos);
    EXPECT_NE(refusal_of("short.obj", "v 0 0 0\nv 1 0\nv 1 1 1\n").find("line 2"), std::string::npos);
    EXPECT_NE(refusal_of("face.obj", std::string(kTriangle) + "f 1 2 x\n").find("line 4"), std::string::npos);
    EXPECT_NE(refusal_of("slash.obj", std::string(kTriangle) + "vt 0 0\nf /1 /1 /1\n").find("line 5"),
              std::string::npos);
    EXPECT_NE(refusal_of("many.obj", std::string(kTriangle) + "f 1/1/1/1 2 3\n").find("line 4"),
              std::string::npos);
}

TEST(MeshObj, notices_that_it_is_cut_off) {
    const std::string_view cube = kCube;
    EXPECT_NE(refusal_of("cut.obj", cube.substr(0, cube.size() - 6)).find("cut off"), std::string::npos);
    EXPECT_NE(refusal_of("cut.obj", cube.substr(0, 15)).find("cut off"), std::string::npos);
    EXPECT_TRUE(
        says(loaded("cut.obj", cube.substr(0, cube.size() - 1)).notes, "perhaps the file was cut off"));
    EXPECT_NE(refusal_of("points.obj", cube.substr(0, cube.find('f'))).find("no faces"), std::string::npos);
}

TEST(MeshObj, is_read_with_a_decimal_point_in_any_locale) {
    struct Comma : std::numpunct<char> {
        char do_decimal_point() const override { return ','; }
        char do_thousands_sep() const override { return '.'; }
        std::string do_grouping() const override { return "\3"; }
    };
    const MeshFolder folder;
    const auto obj =
        folder.write("point.obj", "v 0.25 0 0\nv 1000.5 0 0\nv 0.25 2.125 0\nvt 0.5 0.25\nf 1/1 2/1 3/1\n");
    const Mesh plain = load_mesh(obj);
    const std::locale with_comma(std::locale::classic(), new Comma);
    const std::locale before = std::locale::global(with_comma);
    const Mesh comma = load_mesh(obj);
    EXPECT_TRUE(std::locale() == with_comma);
    std::locale::global(before);
    EXPECT_EQ(plain.vertices, comma.vertices);
}

TEST(LoadMesh, refuses_what_is_no_mesh_with_one_sentence) {
    const MeshFolder folder;
    EXPECT_NE(refusal(folder.path() / "none.obj").find("none.obj"), std::string::npos);
    EXPECT_NE(refusal(folder.path()).find("folder"), std::string::npos);
    EXPECT_NE(refusal_of("a.obj", "").find("empty"), std::string::npos);
    EXPECT_NE(refusal_of("a.fbx", "x").find("use OBJ, PLY, OFF or STL"), std::string::npos);
    EXPECT_NE(refusal_of("a", "x").find("use OBJ, PLY, OFF or STL"), std::string::npos);
    EXPECT_NE(refusal_of("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n").find("no face with an area"),
              std::string::npos);
    EXPECT_NE(refusal_of("point.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n").find("no face with an area"),
              std::string::npos);
    for (const char* name : {"noise.obj", "noise.ply", "noise.off", "noise.stl"})
        EXPECT_FALSE(refusal_of(name, std::string("\x01\xff\x00\x7fv\n\x80 f\n", 10)).empty()) << name;
}

TEST(LoadMesh, reads_files_with_names_in_any_script) {
    const MeshFolder folder;
    const Mesh mesh = load_mesh(folder.write("茶碗 Größe.obj", kCube));
    EXPECT_EQ(mesh.name, "茶碗 Größe");
    EXPECT_EQ(load_mesh(folder.write("LOUD.OBJ", kCube)).indices.size(), 36u);
    EXPECT_EQ(
        load_mesh(folder.write("größe.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")).indices.size(),
        3u);
}

TEST(LoadMesh, scales_extents_of_any_magnitude) {
    for (const char* e : {"e20", "e-20", "e0"}) {
        std::string text;
        for (const char* p : {"3 1 1", "5 1 1", "3 3 1", "3 1 3"}) {
            text += "v ";
            for (const char* c = p; *c; ++c) text += *c == ' ' ? " " : std::string(1, *c) + e;
            text += "\n";
        }
        const Mesh mesh = loaded("far.obj", text + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
        double reach = 0.0;
        for (const Vertex& v : mesh.vertices) {
            reach = std::max(reach, double(glm::length(v.position)));
            EXPECT_NEAR(glm::length(v.normal), 1.0f, 1e-5f);
        }
        EXPECT_NEAR(reach, 1.0, 1e-6) << e;
        EXPECT_NEAR(volume(mesh), 8.0 / 6.0 / std::pow(std::sqrt(8.0 / 3.0), 3.0), 1e-5) << e;
    }
}

TEST(LoadMesh, stops_when_asked) {
    const MeshFolder folder;
    const auto file = folder.write("cube.obj", kCube);
    std::stop_source source;
    source.request_stop();
    EXPECT_THROW(load_mesh(file, source.get_token()), std::runtime_error);
    EXPECT_NO_THROW(load_mesh(file));
}

TEST(SlowLoadMesh, takes_near_linear_time_up_to_a_million_triangles) {
    const MeshFolder folder;
    const auto seconds_for = [&](std::uint32_t side) {
        std::string obj;
        obj.reserve(std::size_t(side) * side * 80);
        char line[96];
        for (std::uint32_t j = 0; j <= side; ++j)
            for (std::uint32_t i = 0; i <= side; ++i) {
                const double x = double(i) / side;
                const double y = double(j) / side;
                const int length = std::snprintf(line, sizeof line, "v %.6f %.6f %.6f\nvt %.6f %.6f\n", x, y,
                                                 0.05 * std::sin(40 * x) * std::sin(30 * y), x, y);
                obj.append(line, std::size_t(length));
            }
        for (std::uint32_t j = 0; j < side; ++j)
            for (std::uint32_t i = 0; i < side; ++i) {
                const std::uint32_t a = j * (side + 1) + i + 1;
                const std::uint32_t d = a + side + 1;
                const int length = std::snprintf(line, sizeof line, "f %u/%u %u/%u %u/%u %u/%u\n", a, a,
                                                 a + 1, a + 1, d + 1, d + 1, d, d);
                obj.append(line, std::size_t(length));
            }
        const auto file = folder.write("grid.obj", obj);
        const auto begin = std::chrono::steady_clock::now();
        Mesh mesh = load_mesh(file);
        make_tangents(mesh);
        EXPECT_EQ(mesh.indices.size(), std::size_t(side) * side * 6);
        EXPECT_EQ(mesh.vertices.size(), std::size_t(side + 1) * (side + 1));
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    const double quarter = seconds_for(354);
    const double whole = seconds_for(708);
    EXPECT_LT(whole, 10.0 * quarter) << quarter << " s and " << whole << " s";  // quadratic time would be 16
}

TEST(LoadMesh, may_be_called_from_several_threads) {
    const MeshFolder folder;
    const auto obj = folder.write("cube.obj", kCube);
    const auto off = folder.write("t.off", "STOFF\n3 1 0\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n");
    std::atomic<int> right{0};
    {
        std::vector<std::jthread> threads;
        for (int t = 0; t < 4; ++t)
            threads.emplace_back([&, t] {
                for (int i = 0; i < 10; ++i)
                    right += t % 2 == 0 ? load_mesh(obj).indices.size() == 36
                                        : load_mesh(off).vertices[1].uv.x == 1.0f;
            });
    }
    EXPECT_EQ(right, 40);
}

}  // namespace
}  // namespace patina
