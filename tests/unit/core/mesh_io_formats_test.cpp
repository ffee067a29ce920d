#include "mesh_tools.h"
#include "renderer/core/mesh_io.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace patina {
namespace {

using namespace test;

Mesh loaded(const std::string& name, std::string_view bytes) {
    const MeshFolder folder;
    return load_mesh(folder.write(name, bytes));
}
std::string refusal_of(const std::string& name, std::string_view bytes) {
    const MeshFolder folder;
    try {
        load_mesh(folder.write(name, bytes));
    } catch (const std::runtime_error& error) {
        const std::string said = error.what();
        EXPECT_NE(said.find(name), std::string::npos) << said;
        EXPECT_EQ(said.find('\n'), std::string::npos) << said;
        return said;
    }
    return "";
}
bool has(const std::string& text, std::string_view what) { return text.find(what) != std::string::npos; }

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// ---- PLY

constexpr std::string_view kTextPly =
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty uchar red\n"
    "property float s\nproperty float t\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0 0 0 1 255 0 0\n2 0 0 0 0 1 255 1 0\n2 2 0 0 3 4 255 1 1\n0 2 0 0 0 1 255 0 1\n3 0 1 2\n3 0 2 3\n";

TEST(MeshPly, reads_text_with_normals_and_texture_coordinates) {
    const Mesh mesh = loaded("quad.ply", kTextPly);
    ASSERT_EQ(mesh.vertices.size(), 4u);
    EXPECT_EQ(mesh.indices.size(), 6u);
    EXPECT_EQ(mesh.vertices[2].uv, glm::vec2(1, 1));
    EXPECT_LT(glm::distance(mesh.vertices[2].normal, glm::vec3(0, 0.6f, 0.8f)), 1e-6f);
    EXPECT_EQ(mesh.vertices[0].normal, glm::vec3(0, 0, 1));
    EXPECT_TRUE(mesh.notes.empty()) << mesh.notes.front();
    std::string windows;
    for (const char c : kTextPly) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
    EXPECT_EQ(loaded("windows.ply", windows).vertices, mesh.vertices);
}

/// A square of two triangles and a pentagon's worth of odd properties around it.
std::string binary_ply(bool big, const std::string& count_type, const std::string& index_type,
                       bool real_is_double) {
    const std::string real = real_is_double ? "double" : "float32";
    std::string ply = std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\n" +
                      "element camera 2\nproperty list uchar short view\nproperty double gain\n" +
                      "element vertex 4\nproperty " + real + " x\nproperty " + real + " y\nproperty " + real +
                      " z\nproperty uchar red\nproperty double confidence\nproperty " + real +
                      " texture_u\nproperty " + real +
                      " texture_v\nelement face 2\nproperty uchar intensity\nproperty list " + count_type +
                      " " + index_type + " vertex_index\nproperty list uchar double weights\nend_header\n";
    const auto put_real = [&](double v) {
        real_is_double ? append(ply, v, big) : append(ply, float(v), big);
    };
    const auto put_int = [&](const std::string& type, int v) {
        if (type == "char" || type == "uchar") append(ply, std::uint8_t(v), big);
        if (type == "short" || type == "ushort") append(ply, std::uint16_t(v), big);
        if (type == "int" || type == "uint") append(ply, std::uint32_t(v), big);
    };
    for (int i = 0; i < 2; ++i) {
        append(ply, std::uint8_t(3), big);
        for (int k = 0; k < 3; ++k) append(ply, std::int16_t(-k), big);
        append(ply, 1.5, big);
    }
    for (const glm::dvec2 p : {glm::dvec2(0, 0), glm::dvec2(2, 0), glm::dvec2(2, 2), glm::dvec2(0, 2)}) {
        for (const double v : {p.x, p.y, 0.0}) put_real(v);
        append(ply, std::uint8_t(200), big);
        append(ply, 0.25, big);
        for (const double v : {p.x / 2, p.y / 2}) put_real(v);
    }
    for (int f = 0; f < 2; ++f) {
        append(ply, std::uint8_t(9), big);
        put_int(count_type, 3);
        for (const int i : {0, 1 + f, 2 + f}) put_int(index_type, i);
        append(ply, std::uint8_t(2), big);
        for (int k = 0; k < 2; ++k) append(ply, 0.5, big);
    }
    return ply + "trailing bytes";
}

TEST(MeshPly, reads_binary_of_both_endians_all_list_types_and_foreign_properties) {
    for (const bool big : {false, true})
        for (const char* count : {"char", "uchar", "short", "ushort", "int", "uint"})
            for (const char* index : {"uchar", "short", "ushort", "int", "uint"}) {
                const Mesh mesh = loaded("b.ply", binary_ply(big, count, index, big));
                ASSERT_EQ(mesh.vertices.size(), 4u) << count << " " << index;
                ASSERT_EQ(mesh.indices.size(), 6u);
                EXPECT_EQ(mesh.vertices[2].uv, glm::vec2(1, 1));
                EXPECT_NEAR(area(mesh), 2.0, 1e-6);
            }
}

TEST(MeshPly, keeps_texture_coordinates_that_are_listed_by_face) {
    const std::string header =
        "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty float quality\n"
        "element face 2\nproperty list uchar int vertex_indices\nproperty list uchar float "
        "texcoord\nproperty int texnumber\n"
        "end_header\n";
    const std::string text =
        "ply\nformat ascii 1.0\n" + header +
        "0 0 0 1\n2 0 0 1\n2 2 0 1\n0 2 0 1\n3 0 1 2 6 0 0 0.5 0 0.5 0.5 0\n3 0 2 3 6 0.5 0.5 1 1 0.5 1 0\n";
    std::string binary = "ply\nformat binary_little_endian 1.0\n" + header;
    for (const glm::vec2 p : {glm::vec2(0, 0), glm::vec2(2, 0), glm::vec2(2, 2), glm::vec2(0, 2)})
        for (const float v : {p.x, p.y, 0.0f, 1.0f}) append(binary, v);
    const std::vector<float> uvs[2] = {{0, 0, 0.5f, 0, 0.5f, 0.5f}, {0.5f, 0.5f, 1, 1, 0.5f, 1}};
    for (int f = 0; f < 2; ++f) {
        append(binary, std::uint8_t(3));
        for (const int i : {0, 1 + f, 2 + f}) append(binary, i);
        append(binary, std::uint8_t(6));
        for (const float v : uvs[f]) append(binary, v);
        append(binary, 0);
    }
    for (const std::string& ply : {text, binary}) {
        const Mesh mesh = loaded("wedge.ply", ply);
        ASSERT_EQ(mesh.indices.size(), 6u);
        EXPECT_EQ(mesh.vertices.size(), 6u);
        EXPECT_EQ(mesh.vertices[mesh.indices[1]].uv, glm::vec2(0.5f, 0));
        EXPECT_EQ(mesh.vertices[mesh.indices[3]].uv, glm::vec2(0.5f, 0.5f));
        EXPECT_EQ(mesh.vertices[mesh.indices[4]].uv, glm::vec2(1, 1));
    }
}

TEST(MeshPly, drops_what_is_not_finite_or_points_nowhere) {
    std::string text(kTextPly);
    text.replace(text.find("0 2 0 0 0 1"), 1, "nan");
    const Mesh mesh = loaded("nan.ply", text);
    EXPECT_EQ(mesh.indices.size(), 3u);
    EXPECT_TRUE(says(mesh.notes, "1 face was dropped: a corner points nowhere or is not finite"));
    text = kTextPly;
    text.replace(text.find("3 0 2 3"), 7, "3 0 2 -1");
    EXPECT_EQ(loaded("negative.ply", text).indices.size(), 3u);

    std::string binary = binary_ply(false, "uchar", "int", false);
    const std::size_t last_z = binary.find("end_header\n") + 11 + 2 * 15 + 3 * 29 + 8;
    const float nan = kNan;
    std::copy_n(reinterpret_cast<const char*>(&nan), 4, binary.begin() + std::ptrdiff_t(last_z));
    EXPECT_EQ(loaded("nan.ply", binary).indices.size(), 3u);
}

TEST(MeshPly, refuses_bombs_and_cut_off_files_before_it_allocates) {
    const std::string head = "ply\nformat binary_little_endian 1.0\nelement vertex ";
    const std::string xyz = "\nproperty float x\nproperty float y\nproperty float z\nelement face ";
    const std::string list = "\nproperty list uchar int vertex_indices\nend_header\n";
    EXPECT_TRUE(has(refusal_of("bomb.ply", head + "1000000000000" + xyz + "1" + list), "100 million"));
    EXPECT_TRUE(
        has(refusal_of("bomb.ply", head + "99999999999999999999999" + xyz + "1" + list), "100 million"));
    EXPECT_TRUE(has(refusal_of("bomb.ply", head + "-5" + xyz + "1" + list), "100 million"));
    EXPECT_TRUE(has(refusal_of("cut.ply", head + "90000000" + xyz + "1" + list), "cut off"));
    EXPECT_TRUE(
        has(refusal_of("cut.ply", head + "1" + xyz + "90000000" + list + std::string(12, '\0')), "cut off"));
    const std::string whole = binary_ply(false, "int", "int", false);
    for (const std::size_t left : {30u, 60u, 200u}) {
        const std::string cut = whole.substr(0, whole.size() - left);
        EXPECT_TRUE(has(refusal_of("cut.ply", cut), "cut off")) << left;
    }
    EXPECT_TRUE(has(refusal_of("head.ply", kTextPly.substr(0, 80)), "no end_header"));
    EXPECT_TRUE(has(refusal_of("body.ply", kTextPly.substr(0, kTextPly.size() - 6)), "cut off"));
    EXPECT_TRUE(
        has(refusal_of("points.ply",
                       head + "1\nproperty float x\nproperty float y\nproperty float z\nend_header\n"),
            "no faces"));
}

TEST(MeshPly, says_what_it_does_not_understand) {
    const auto with = [](std::string_view old_text, std::string_view new_text) {
        std::string text(kTextPly);
        return text.replace(text.find(old_text), old_text.size(), new_text);
    };
    EXPECT_TRUE(has(refusal_of("a.ply", with("ascii", "morse")), "unknown format 'morse'"));
    EXPECT_TRUE(has(refusal_of("a.ply", with("uchar red", "half red")), "unknown type 'half'"));
    EXPECT_TRUE(has(refusal_of("a.ply", with("3 0 1 2", "3 0 x 2")), "unreadable value 'x'"));
    EXPECT_TRUE(has(refusal_of("a.ply", with("2 0 0 0 0 1", "2 o 0 0 0 1")), "unreadable value 'o'"));
    EXPECT_TRUE(has(refusal_of("a.ply", with("float z", "float w")), "x, y, z"));
    EXPECT_TRUE(has(refusal_of("a.ply", "plyer"), "does not begin with 'ply'"));
}

// ---- STL

void append_triangle(std::string& stl, const std::vector<float>& nine) {
    for (int k = 0; k < 3; ++k) append(stl, 0.0f);
    for (const float v : nine) append(stl, v);
    append(stl, std::uint16_t(0));
}
/// A tetrahedron; the header may start like text.
std::string binary_stl(const std::string& title = "binary") {
    std::string stl = title + std::string(80 - title.size(), '\0');
    append(stl, std::uint32_t(4));
    append_triangle(stl, {0, 0, 0, 0, 1, 0, 1, 0, 0});
    append_triangle(stl, {0, 0, 0, 1, 0, 0, 0, 0, 1});
    append_triangle(stl, {0, 0, 0, 0, 0, 1, 0, 1, 0});
    append_triangle(stl, {1, 0, 0, 0, 1, 0, 0, 0, 1});
    return stl;
}
std::string facet(const std::string& a, const std::string& b, const std::string& c) {
    return "  facet normal 0 0 0\n    outer loop\n      vertex " + a + "\n      vertex " + b +
           "\n      vertex " + c + "\n    endloop\n  endfacet\n";
}
std::string text_stl() {
    return "solid outer vertex\n" + facet("0 0 0", "0 1 0", "1 0 0") + facet("0 0 0", "1 0 0", "0 0 1") +
           facet("0 0 0", "0 0 1", "0 1 0") + facet("1 0 0", "0 1 0", "0 0 1") + "endsolid outer vertex\n";
}

TEST(MeshStl, reads_binary_and_text_alike) {
    const Mesh binary = loaded("t.stl", binary_stl());
    EXPECT_EQ(binary.indices.size(), 12u);
    EXPECT_EQ(loaded("t.stl", binary_stl("solid as a rock")).vertices, binary.vertices);
    const Mesh text = loaded("t.stl", text_stl());
    EXPECT_EQ(text.vertices, binary.vertices);
    EXPECT_EQ(text.indices, binary.indices);
    EXPECT_GT(volume(binary), 0.0);
    EXPECT_TRUE(says(binary.notes, "Normals were computed"));
    EXPECT_EQ(loaded("padded.stl", binary_stl() + "xx").vertices, binary.vertices);
}

TEST(MeshStl, welds_corners_so_that_curved_surfaces_are_smooth) {
    std::string stl(80, ' ');
    constexpr std::uint32_t kSides = 32;
    append(stl, kSides * 2);
    for (std::uint32_t i = 0; i < kSides; ++i) {
        const auto at = [](std::uint32_t k, float z) {
            const float a = 6.2831853f * float(k % kSides) / kSides;
            return std::vector<float>{std::cos(a), std::sin(a), z};
        };
        const auto triangle = [&](const std::vector<float>& a, const std::vector<float>& b,
                                  const std::vector<float>& c) {
            std::vector<float> nine = a;
            nine.insert(nine.end(), b.begin(), b.end());
            nine.insert(nine.end(), c.begin(), c.end());
            append_triangle(stl, nine);
        };
        triangle(at(i, -1), at(i + 1, -1), at(i + 1, 1));
        triangle(at(i, -1), at(i + 1, 1), at(i, 1));
    }
    for (const Vertex& v : loaded("tube.stl", stl).vertices) {
        const glm::vec3 radial(v.position.x, v.position.y, 0.0f);
        EXPECT_GT(glm::dot(v.normal, glm::normalize(radial)), 0.998f);
    }
}

TEST(MeshStl, drops_and_counts_what_shows_nothing) {
    std::string stl(80, ' ');
    append(stl, std::uint32_t(4));
    append_triangle(stl, {0, 0, 0, 1, 0, 0, 0, 1, 0});
    append_triangle(stl, {0, 0, 0, 1, 0, 0, 1, 0, 0});
    append_triangle(stl, {0, 0, 0, 1, 0, 0, kNan, 1, 0});
    append_triangle(stl, {1, 0, 0, 0, 1, 0, 0, 0, 0});
    const Mesh mesh = loaded("dirt.stl", stl);
    EXPECT_EQ(mesh.indices.size(), 3u);
    EXPECT_TRUE(says(mesh.notes, "1 face without an area"));
    EXPECT_TRUE(says(mesh.notes, "1 triangle(s) dropped: a corner is not a finite point"));
    EXPECT_TRUE(says(mesh.notes, "1 duplicate triangle"));
    const Mesh text = loaded("dirt.stl", "solid\n" + facet("0 0 0", "1 0 0", "0 1 0") +
                                             facet("0 0 0", "inf 0 0", "1e40 1 0") + "endsolid\n");
    EXPECT_EQ(text.indices.size(), 3u);
    EXPECT_TRUE(says(text.notes, "1 triangle(s) dropped"));
}

TEST(MeshStl, refuses_bombs_and_cut_off_files) {
    const std::string whole = binary_stl();
    EXPECT_TRUE(
        has(refusal_of("cut.stl", whole.substr(0, whole.size() - 20)), "promises 4 triangles but holds 3"));
    EXPECT_TRUE(has(refusal_of("short.stl", whole.substr(0, 50)), "too short"));
    std::string bomb(80, ' ');
    append(bomb, 4'000'000'000u);
    EXPECT_TRUE(has(refusal_of("bomb.stl", bomb), "promises 4000000000 triangles but holds 0"));
    std::string none(80, ' ');
    append(none, 0u);
    EXPECT_TRUE(has(refusal_of("none.stl", none), "no faces"));
    const std::string text = text_stl();
    EXPECT_TRUE(has(refusal_of("cut.stl", text.substr(0, text.rfind("vertex 0 0 1"))), "cut off"));
    EXPECT_TRUE(has(refusal_of("cut.stl", text.substr(0, text.rfind("0 1\n    endloop"))), "cut off"));
    EXPECT_TRUE(has(refusal_of("cut.stl", text.substr(0, text.rfind("endfacet"))), "cut off"));
    EXPECT_TRUE(has(refusal_of("bad.stl", "solid\n" + facet("0 0 0", "1 o 0", "0 1 0")), "line 5"));
}

// ---- OFF

TEST(MeshOff, reads_counts_comments_colours_and_polygons) {
    const std::string body = "\n0 0 0 255 0 0\n2 0 0 255 0 0\n2 2 0 255 0 0 # corner\n\n0 2 0 255 0 0\n";
    for (const std::string& text :
         {"OFF\n# a square\n4 1 0" + body + "4 0 1 2 3 0.5 0.5 0.5\n", "OFF 4 1 0" + body + "4 0 1 2 3\n",
          "COFF\r\n4 1 4" + body + "4 0 1 2 3 255 0 0\n", "OFF\n4 1 0 9 8 7 6" + body + "4 0 1 2 3\n",
          "OFF\n4 2 0" + body + "3 0 1 2 128 0 0\n3 0 2 3 128 0 0\n"}) {
        const Mesh mesh = loaded("square.off", text);
        EXPECT_EQ(mesh.indices.size(), 6u) << text;
        EXPECT_NEAR(area(mesh), 2.0, 1e-6) << text;
    }
}

TEST(MeshOff, keeps_normals_and_texture_coordinates) {
    const Mesh mesh = loaded("full.off",
                             "STCNOFF\n3 1 0\n0 0 0  0 0 2  1 0 0 1  0.5  0.25\n1 0 0  0 3 4  1 0 0 1  1 0\n"
                             "0 1 0  0 nan 0  1 0 0 1  inf 1\n3 0 1 2\n");
    ASSERT_EQ(mesh.vertices.size(), 3u);
    EXPECT_EQ(mesh.vertices[0].uv, glm::vec2(0.5f, 0.25f));
    EXPECT_EQ(mesh.vertices[2].uv, glm::vec2(0, 1));
    EXPECT_EQ(mesh.vertices[0].normal, glm::vec3(0, 0, 1));
    EXPECT_LT(glm::distance(mesh.vertices[1].normal, glm::vec3(0, 0.6f, 0.8f)), 1e-6f);
    EXPECT_LT(glm::distance(mesh.vertices[2].normal, glm::vec3(0, 0, 1)), 1e-6f);
}

TEST(MeshOff, refuses_what_it_cannot_read) {
    EXPECT_TRUE(has(refusal_of("a.off", "4OFF\n1 1 0\n"), "three dimensions"));
    EXPECT_TRUE(has(refusal_of("a.off", "OFF BINARY\n"), "binary OFF"));
    EXPECT_TRUE(has(refusal_of("a.off", "OFF\n4000000000 1 0\n"), "100 million"));
    EXPECT_TRUE(has(refusal_of("a.off", "OFF\n90000000 1 0\n0 0 0\n"), "cut off"));
    EXPECT_TRUE(has(refusal_of("a.off", "OFF\n3 1\n0 0 0\n"), "edges is missing"));
    EXPECT_TRUE(has(refusal_of("a.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), "cut off"));
    EXPECT_TRUE(
        has(refusal_of("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n"), "fewer than its 3 corners"));
    EXPECT_TRUE(has(refusal_of("a.off", "OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n"), "too few numbers"));
    const Mesh mesh = loaded("b.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 7\n");
    EXPECT_TRUE(says(mesh.notes, "1 face was dropped: a corner points nowhere"));
}

TEST(LoadMesh, believes_contents_more_than_names) {
    const Mesh mesh = loaded("really.obj", kTextPly);
    EXPECT_EQ(mesh.indices.size(), 6u);
    EXPECT_TRUE(says(mesh.notes, "read as .ply"));
}

/// One byte changed, some lost, some doubled, or the rest cut off.
std::string damaged(std::string bytes, std::mt19937& random) {
    constexpr std::string_view kLikely = "0123456789-./ \n\rnaife#\\";
    for (auto blows = 1 + random() % 3; blows > 0 && !bytes.empty(); --blows) {
        const std::size_t at = random() % bytes.size();
        switch (random() % 6) {
            case 0:
                bytes[at] = char(random());
                break;
            case 1:
                bytes[at] = kLikely[random() % kLikely.size()];
                break;
            case 2:
                bytes.erase(at, 1 + random() % 8);
                break;
            case 3:
                bytes.insert(at, bytes.substr(random() % bytes.size(), random() % 40));
                break;
            case 4:
                bytes.insert(at, 1, kLikely[random() % kLikely.size()]);
                break;
            default:
                bytes.resize(at);
                break;
        }
    }
    return bytes;
}
void expect_sound(const Mesh& mesh) {
    ASSERT_FALSE(mesh.indices.empty());
    for (const std::uint32_t index : mesh.indices) ASSERT_LT(index, mesh.vertices.size());
    for (const Vertex& v : mesh.vertices) {
        ASSERT_LE(glm::length(v.position), 1.0f + 1e-5f);
        ASSERT_NEAR(glm::length(v.normal), 1.0f, 1e-4f);
        ASSERT_TRUE(std::isfinite(v.uv.x) && std::isfinite(v.uv.y));
        ASSERT_NEAR(glm::length(glm::vec3(v.tangent)), 1.0f, 1e-4f);
    }
}

TEST(LoadMesh, either_reads_or_refuses_any_damaged_file) {
    const std::vector<std::pair<std::string, std::string>> whole{
        {"a.ply", std::string(kTextPly)},
        {"b.ply", binary_ply(true, "uchar", "int", false)},
        {"c.ply", binary_ply(false, "int", "uint", true)},
        {"d.stl", binary_stl()},
        {"e.stl", text_stl()},
        {"f.off",
         "STNOFF\n# x\n4 2 0\n0 0 0 0 0 1 0 0\n1 0 0 0 0 1 1 0\n1 1 0 0 0 1 1 1\n0 1 0 0 0 1 0 1\n3 0 1 2 "
         "9\n3 0 2 3\n"},
        {"g.obj",
         "mtllib a\nv 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 1 0\nv 1 3 0\nv 3 3 1\nv 3 1 0\nvt 0 0\nvt 1 "
         "1\nvn 0 0 1\n"
         "f 1/1/1 2/2 3//1 4 1 5 6 7 8 5\nf -1/-1 \\\n-2/-2 -3/-1\n"}};
    const MeshFolder folder;
    std::mt19937 random(11);
    int read = 0;
    int refused = 0;
    for (int i = 0; i < 700; ++i) {
        const auto& [name, bytes] = whole[std::size_t(i) % whole.size()];
        const auto file = folder.write(name, damaged(bytes, random));
        try {
            Mesh mesh = load_mesh(file);
            make_tangents(mesh);
            expect_sound(mesh);
            ++read;
        } catch (const std::runtime_error& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
            ++refused;
        }
    }
    EXPECT_GT(read, 70);
    EXPECT_GT(refused, 70);
}

}  // namespace
}  // namespace patina
