// Inputs at the ends of what there is: radiance, exposure, sizes, meshes, headers that promise too much. Each
// is drawn cleanly or refused in one sentence.
#include "app/stability.h"
#include "app/stability_scene.h"
#include "renderer/core/image_io.h"
#include "renderer/core/mesh_guard.h"
#include "renderer/core/mesh_io.h"
#include "tests/stability/process.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <sys/resource.h>

namespace patina {
namespace {

using namespace test;

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Stage& stage() {
    static auto* one = new Stage;  // lives until the process ends: the driver outlives static destructors
    return *one;
}

/// Every channel finite and ≥ 0; gives the brightest.
float expect_clean(const Image& image, const std::string& what) {
    float brightest = 0.0f;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const float value = texel(image, x, y, c);
                if (!std::isfinite(value) || value < 0.0f) {
                    ADD_FAILURE() << what << ": " << value << " at " << x << ", " << y;
                    return value;
                }
                brightest = std::max(brightest, value);
            }
    return brightest;
}

Image constant_picture(float value) {
    Image image = make_image(8, 4, 3, PixelType::F32);
    for (int i = 0; i < 96; ++i) set_texel(image, i / 3 % 8, i / 24, i % 3, value);
    return image;
}

Mesh builtin(std::string_view id) {
    for (const BuiltinMesh& mesh : builtin_meshes())
        if (mesh.id == id) return mesh.make();
    throw std::runtime_error("no such mesh");
}

Scene ball(const Environment& environment) {
    static const MeshHandle sphere = stage().renderer().upload_mesh(builtin("sphere"));
    Scene scene;
    scene.environment = upload_light(stage(), environment);
    scene.mesh = sphere;
    return scene;
}

TEST(Extremes, every_radiance_and_exposure_is_drawn_cleanly_and_brighter_is_never_darker) {
    for (const auto& mode : kShadings) {
        float before = -1.0f;
        for (const float radiance : {0.0f, 1e-30f, 1e-6f, 1.0f, 65504.0f, 1e6f, 1e18f, 3e38f}) {
            Scene scene = ball(make_environment(constant_picture(radiance), "x", "x"));
            scene.view.shading = mode.value;
            float darker = -1.0f;
            for (const float stops : {-30.0f, 0.0f, 30.0f}) {
                scene.view.exposure_ev = stops;
                const Image image = drawn_radiance(stage(), scene, glm::ivec2(24));
                expect_clean(image, std::to_string(radiance) + " at " + std::to_string(stops) + " EV");
                const float middle = texel(image, 12, 12, 1);
                EXPECT_GE(middle, darker) << radiance << " at " << stops << " EV, " << mode.id;
                darker = middle;
                if (stops != 0.0f) continue;
                EXPECT_GE(middle, before) << radiance << ", " << mode.id;
                before = middle;
                const TargetHandle half = stage().renderer().make_target(glm::ivec2(24), 4);
                stage().renderer().draw(scene, *half);
                EXPECT_LE(expect_clean(stage().renderer().read_radiance(*half), "half"), 65504.0f);
            }
        }
        for (const float broken : {kNan, kInf, -kInf, -1.0f}) {
            Scene scene = ball(make_environment(constant_picture(broken), "x", "x"));
            scene.view.shading = mode.value;
            expect_clean(drawn_radiance(stage(), scene, glm::ivec2(24)), "broken radiance");
        }
    }
}

TEST(Extremes, panoramas_of_every_shape_are_drawn_cleanly) {
    for (const glm::ivec2 size : {glm::ivec2(1, 1), {1, 64}, {64, 1}, {2, 1}, {7, 5}, {3, 17}, {16384, 2}}) {
        Random random(1);
        Environment environment = panorama_of(SoftLight(random), size.x, size.y);
        for (const bool has_sun : {false, true}) {
            if (has_sun) environment.radiance[environment.radiance.size() / 2] = glm::vec3(1e6f);
            Scene scene = ball(environment);
            for (const float roughness : {0.0f, 1e-38f, 0.05f, 1.0f}) {
                scene.material.roughness.value = roughness;
                scene.material.metallic.value = 1.0f;
                expect_clean(drawn_radiance(stage(), scene, glm::ivec2(24)),
                             std::to_string(size.x) + "×" + std::to_string(size.y));
            }
        }
    }
}

TEST(Extremes, a_black_environment_gives_black) {
    const Scene scene = ball(make_environment(constant_picture(0.0f), "x", "x"));
    EXPECT_EQ(expect_clean(drawn_radiance(stage(), scene, glm::ivec2(32)), "black"), 0.0f);
}

TEST(Extremes, normal_maps_of_one_value_and_flipped_ones_are_drawn_cleanly) {
    Random random(2);
    Scene scene = ball(panorama_of(SoftLight(random), 64, 32));
    for (const glm::ivec3 color :
         {glm::ivec3(0), {255, 255, 255}, {128, 128, 255}, {128, 128, 0}, {127, 127, 127}}) {
        Image image = make_image(2, 2, 3, PixelType::U8);
        for (int i = 0; i < 12; ++i) set_texel(image, i / 3 % 2, i / 6, i % 3, float(color[i % 3]) / 255.0f);
        scene.maps[std::size_t(MapSlot::Normal)] =
            stage().renderer().upload_map(make_map_levels(image, MapKind::Normal, ColorSpace::Linear));
        for (const NormalConvention convention : {NormalConvention::OpenGl, NormalConvention::DirectX}) {
            scene.material.normal.convention = convention;
            expect_clean(drawn_radiance(stage(), scene, glm::ivec2(48)), "normal map");
        }
    }
}

TEST(Extremes, views_from_one_pixel_to_eight_thousand_wide) {
    Random random(3);
    const Scene scene = ball(panorama_of(SoftLight(random), 64, 32));
    for (const glm::ivec2 size : {glm::ivec2(1, 1), {1, 8192}, {8192, 1}, {8192, 16}, {3, 700}}) {
        const Image image = drawn_radiance(stage(), scene, size);
        EXPECT_EQ(glm::ivec2(image.width, image.height), size);
        expect_clean(image, "view");
    }
}

TEST(SlowExtremes, a_view_of_8k) {
    Random random(3);
    const Scene scene = ball(panorama_of(SoftLight(random), 64, 32));
    const TargetHandle target = stage().renderer().make_target({7680, 4320}, 1);
    stage().renderer().draw(scene, *target);
    const Image image = stage().renderer().read_display(*target);
    ASSERT_EQ(image.width, 7680);
    ASSERT_EQ(image.height, 4320);
    EXPECT_NE(texel(image, 3840, 2160, 1), texel(image, 3840, 2600, 1));
}

// Meshes.

/// Loads and draws it, or gives the one sentence that refused it.
std::string drawn_or_refused(const std::filesystem::path& file) {
    try {
        Mesh mesh = load_mesh(file);
        for (const Vertex& v : mesh.vertices) EXPECT_LE(glm::length(v.position), 1.0f + 1e-5f) << file;
        make_tangents(mesh);
        Random random(4);
        Scene scene = ball(panorama_of(SoftLight(random), 32, 16));
        scene.mesh = stage().renderer().upload_mesh(mesh);
        EXPECT_GT(expect_clean(drawn_radiance(stage(), scene, glm::ivec2(32)), file.string()), 0.0f);
        return "";
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.what();
    }
}

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(Extremes, broken_meshes_are_drawn_or_refused_in_one_sentence) {
    const Folder folder;
    const std::filesystem::path file = folder.path / "x.obj";
    const auto outcome = [&](const std::string& text) {
        write_text(file, text);
        return drawn_or_refused(file);
    };
    const std::string triangle = kTriangle;
    EXPECT_EQ(outcome(triangle + "f 1 2 3\n"), "");
    EXPECT_NE(outcome(""), "");
    EXPECT_NE(outcome(triangle), "");                                      // no face
    EXPECT_NE(outcome("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), "");        // no area
    EXPECT_EQ(outcome(triangle + "v nan inf 0\nf 1 2 3\nf 1 2 4\n"), "");  // one face is lost
    EXPECT_NE(outcome("v nan 0 0\nv nan 0 0\nv nan 1 0\nf 1 2 3\n"), "");
    EXPECT_EQ(outcome(triangle + "v 1e9 1e9 1e9\nf 1 2 3\n"), "");  // unreferenced
    EXPECT_EQ(outcome(triangle + "v 0 0 1\nv 0 0 -1\nf 1 2 3\nf 1 2 4\nf 1 2 5\nf 2 1 3\n"),
              "");                                                 // three at an edge
    EXPECT_EQ(outcome(triangle + "vt 0 0\nf 1/1 2/1 3/1\n"), "");  // collapsed uv
    EXPECT_EQ(outcome(triangle + "vt nan 0\nf 1/1 2/1 3/1\n"), "");
    EXPECT_EQ(outcome(triangle + "vn 0 0 0\nf 1//1 2//1 3//1\n"), "");
    for (const char* scale : {"1e-20", "1e20", "1e-38", "1e38"}) {
        const std::string s = scale;
        EXPECT_EQ(outcome("v 0 0 0\nv " + s + " 0 0\nv 0 " + s + " 0\nf 1 2 3\n"), "") << scale;
    }
}

TEST(SlowExtremes, ten_million_faces_are_drawn) {
    constexpr int side = 2237;  // 2 · 2236² ≈ 10 M
    Mesh mesh;
    mesh.vertices.resize(std::size_t(side) * side);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            mesh.vertices[std::size_t(y) * side + x].position = {float(x) / side - 0.5f,
                                                                 float(y) / side - 0.5f, 0.0f};
    mesh.indices.reserve(std::size_t(6) * side * side);
    for (int y = 0; y + 1 < side; ++y)
        for (int x = 0; x + 1 < side; ++x) {
            const auto i = std::uint32_t(y * side + x);
            for (const std::uint32_t k : {i, i + 1, i + side, i + side, i + 1, i + side + 1})
                mesh.indices.push_back(k);
        }
    EXPECT_GT(mesh.indices.size() / 3, 9'990'000u);
    Random random(5);
    Scene scene = ball(panorama_of(SoftLight(random), 32, 16));
    scene.mesh = stage().renderer().upload_mesh(mesh);
    EXPECT_GT(expect_clean(drawn_radiance(stage(), scene, glm::ivec2(32)), "10 M faces"), 0.0f);
}

// Headers that promise what no file holds.

long peak_memory_kib() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

std::string big_endian(std::uint32_t n) { return {char(n >> 24), char(n >> 16), char(n >> 8), char(n)}; }
std::string little_endian(std::uint32_t n, int bytes = 4) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += char(n >> (8 * i));
    return text;
}

/// A width and a height of a thousand million each.
std::vector<std::pair<std::string, std::string>> lying_pictures() {
    constexpr std::uint32_t huge = 1000000000;
    const std::string png = "\x89PNG\r\n\x1a\n" + big_endian(13) + "IHDR" + big_endian(huge) +
                            big_endian(huge) + std::string("\x08\x02\x00\x00\x00", 5) +
                            big_endian(0xebfe91b3u) + big_endian(0) + "IDAT" + big_endian(0x35af061eu) +
                            big_endian(0) + "IEND" + big_endian(0xae426082u);
    std::string tiff = "II*" + std::string(1, '\0') + little_endian(8) + little_endian(5, 2);
    const auto entry = [&](std::uint32_t tag, std::uint32_t value) {
        tiff += little_endian(tag, 2) + little_endian(4, 2) + little_endian(1) + little_endian(value);
    };
    entry(256, huge);
    entry(257, huge);
    entry(258, 8);
    entry(262, 1);
    entry(273, 8);
    tiff += little_endian(0) + std::string(64, 'x');
    const std::string bmp = "BM" + little_endian(1000) + little_endian(0) + little_endian(54) +
                            little_endian(40) + little_endian(huge) + little_endian(huge) +
                            little_endian(1, 2) + little_endian(24, 2) + std::string(64, '\0');
    return {{"a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1000000000 +X 1000000000\nxxxx"},
            {"a.png", png},
            {"a.tif", tiff},
            {"a.bmp", bmp}};
}

TEST(Extremes, a_header_that_promises_a_billion_pixels_a_side_is_refused_before_allocation) {
    const Folder folder;
    for (const auto& [name, bytes] : lying_pictures()) {
        write_text(folder.path / name, bytes);
        const long before = peak_memory_kib();
        std::string refusal;
        try {
            load_image(folder.path / name);
        } catch (const std::runtime_error& error) {
            refusal = error.what();
        }
        EXPECT_NE(refusal.find("1000000000"), std::string::npos) << name << ": " << refusal;
        EXPECT_NE(refusal.find("more than 16384×16384"), std::string::npos) << name << ": " << refusal;
        EXPECT_LT(peak_memory_kib() - before, 200 * 1024) << name;
    }
    const std::pair<const char*, const char*> meshes[] = {
        {"a.ply",
         "ply\nformat ascii 1.0\nelement vertex 1000000000\nproperty float x\nproperty float y\nproperty "
         "float z\nelement face 1000000000\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n"},
        {"a.off", "OFF\n1000000000 1000000000 0\n0 0 0\n"}};
    for (const auto& [name, text] : meshes) {
        write_text(folder.path / name, text);
        const long before = peak_memory_kib();
        std::string refusal;
        try {
            load_mesh(folder.path / name);
        } catch (const std::runtime_error& error) {
            refusal = error.what();
        }
        EXPECT_NE(refusal.find("million"), std::string::npos) << name << ": " << refusal;
        EXPECT_LT(peak_memory_kib() - before, 200 * 1024) << name;
    }
}

/// Windows that the size limits allow, but that so few bytes cannot fill.
TEST(Extremes, an_exr_of_a_kilobyte_does_not_take_gigabytes) {
    const Folder folder;
    const std::filesystem::path file = folder.path / "a.exr";
    save_image(file, make_image(6, 5, 3, PixelType::F32));
    const std::string good = read_text(file);
    for (const std::string window : {"dataWindow", "displayWindow"}) {
        std::string bytes = good;
        const std::size_t at = bytes.find(window + std::string(1, '\0') + "box2i") + window.size() + 7 + 4;
        bytes.replace(at + 8, 8, little_endian(16383) + little_endian(16383));
        write_text(file, bytes);
        const long before = peak_memory_kib();
        EXPECT_THROW(load_image(file), std::runtime_error) << window;
        EXPECT_LT(peak_memory_kib() - before, 200 * 1024) << window;
    }
}

// What is missing of the machine.

TEST(Extremes, without_opengl_4_1_one_sentence_says_so) {
    const Folder folder;
    const Ended ended = run_patina(folder, {"render", "-", "-o", "a.png", "--size", "8x8"},
                                   {.environment = {{"MESA_GL_VERSION_OVERRIDE", "3.3"}}});
    if (ended.exit_status == 0) GTEST_SKIP() << "this driver is not Mesa";
    EXPECT_EQ(ended.exit_status, 1);
    EXPECT_EQ(std::count(ended.errors.begin(), ended.errors.end(), '\n'), 1) << ended.errors;
    EXPECT_NE(ended.errors.find("OpenGL 4.1"), std::string::npos) << ended.errors;
    EXPECT_FALSE(std::filesystem::exists(folder.path / "a.png"));
}

TEST(Extremes, a_picture_larger_than_the_disk_allows_leaves_nothing) {
    const Folder folder;
    const Ended ended = run_patina(
        folder, {"bake", "furnace", "-o", "out", "--size", "16", "--levels", "0.5"}, {.file_bytes = 2000});
    EXPECT_NE(ended.exit_status, 0);
    EXPECT_FALSE(std::filesystem::exists(folder.path / "out" / "bake.json"));
}

}  // namespace
}  // namespace patina
