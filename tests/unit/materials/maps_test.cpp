// The generated maps: deterministic, tileable, and true to one height field.
#include "materials/maps/noise.h"
#include "materials/maps/recipes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>

namespace patina::maps {

namespace {

/// FNV-1a.
std::uint64_t fingerprint(const std::vector<MapPicture>& pictures) {
    std::uint64_t h = 0xcbf29ce484222325u;
    for (const MapPicture& picture : pictures)
        for (const std::uint16_t value : picture.values) {
            h = (h ^ (value & 0xFFu)) * 0x100000001b3u;
            h = (h ^ (value >> 8)) * 0x100000001b3u;
        }
    return h;
}

int value(const MapPicture& picture, int x, int y, int c) {
    return picture.values[static_cast<std::size_t>(
        ((y & (picture.size - 1)) * picture.size + (x & (picture.size - 1))) * picture.channels + c)];
}

/// Mean absolute step from column x to the next, and from row x to the next.
double step_at(const MapPicture& picture, int at, bool columns) {
    double sum = 0.0;
    for (int i = 0; i < picture.size; ++i)
        for (int c = 0; c < picture.channels; ++c)
            sum += columns ? std::abs(value(picture, at + 1, i, c) - value(picture, at, i, c))
                           : std::abs(value(picture, i, at + 1, c) - value(picture, i, at, c));
    return sum / (picture.size * picture.channels);
}

Surface bump(float height) {
    return make_surface(64, [&](glm::vec2 uv) {
        const glm::vec2 d = uv - glm::vec2(0.5f);
        SurfacePoint point;
        point.height = height * std::max(0.0f, 1.0f - 16.0f * (d.x * d.x + d.y * d.y));
        return point;
    });
}

}  // namespace

TEST(GeneratedMaps, every_recipe_makes_pictures_of_the_size_asked_for) {
    std::set<std::string> files;
    for (const MapRecipe& recipe : map_recipes())
        for (const MapPicture& picture : recipe.make(64)) {
            EXPECT_TRUE(picture.file.starts_with(recipe.name)) << picture.file;
            EXPECT_TRUE(picture.file.ends_with(".png")) << picture.file;
            EXPECT_TRUE(files.insert(picture.file).second) << picture.file;
            EXPECT_EQ(picture.size, 64);
            EXPECT_TRUE(picture.channels == 1 || picture.channels == 3);
            EXPECT_EQ(picture.values.size(), static_cast<std::size_t>(64 * 64 * picture.channels));
            const int most = picture.bits == 16 ? 65535 : 255;
            for (const std::uint16_t v : picture.values) ASSERT_LE(v, most) << picture.file;
        }
    EXPECT_GE(files.size(), 20u);
}

TEST(GeneratedMaps, are_the_same_bytes_on_every_machine) {
    const std::map<std::string_view, std::uint64_t> expected{
        {"brushed-steel", 0x05696f9d2a5cff65u}, {"worn-paint", 0xa26d2c72797b7b85u},
        {"rusted-iron", 0xb785daa41064bbf4u},   {"hammered-copper", 0x046500d394a87b6bu},
        {"glazed-tiles", 0x6c5827e9f7e2c9d7u},  {"terrazzo", 0xd5cbb1ae0e9fcf83u},
        {"woven-cloth", 0x5dfb71b43b3b68b1u},   {"oak-planks", 0x12ddd97db724c4c3u},
        {"cooling-lava", 0xa4d44bb33cc7dd89u},
    };
    for (const MapRecipe& recipe : map_recipes())
        EXPECT_EQ(fingerprint(recipe.make(128)), expected.at(recipe.name)) << recipe.name;
}

TEST(GeneratedMaps, repeat_without_a_seam) {
    for (const MapRecipe& recipe : map_recipes())
        for (const MapPicture& picture : recipe.make(128))
            for (const bool columns : {true, false}) {
                double largest = 0.0;
                for (int i = 0; i + 1 < picture.size; ++i)
                    largest = std::max(largest, step_at(picture, i, columns));
                // The edge is one more draw from the same steps; a seam would stand far out of them.
                EXPECT_LE(step_at(picture, picture.size - 1, columns), 1.2 * largest)
                    << picture.file << (columns ? " left to right" : " top to bottom");
            }
}

TEST(GeneratedMaps, normals_are_unit_length_and_look_up) {
    for (const MapRecipe& recipe : map_recipes())
        for (const MapPicture& picture : recipe.make(128)) {
            if (picture.file.find("-normal") == std::string::npos) continue;
            const float most = picture.bits == 16 ? 65535.0f : 255.0f;
            for (std::size_t i = 0; i < picture.values.size(); i += 3) {
                glm::vec3 n;
                for (int c = 0; c < 3; ++c)
                    n[c] = 2.0f * static_cast<float>(picture.values[i + static_cast<std::size_t>(c)]) / most -
                           1.0f;
                ASSERT_NEAR(n.x * n.x + n.y * n.y + n.z * n.z, 1.0f, 4.0f / most * 1.8f) << picture.file;
                ASSERT_GT(n.z, 0.0f) << picture.file;
            }
        }
}

TEST(GeneratedMaps, a_hill_faces_up_on_its_upper_side_the_opengl_way_and_down_the_directx_way) {
    const MapPicture gl = normal_map("n.png", bump(0.1f), GreenPoints::Up, 8);
    EXPECT_GT(value(gl, 32, 20, 1), 150) << "the side towards the picture's top";
    EXPECT_LT(value(gl, 32, 44, 1), 105);
    EXPECT_LT(value(gl, 20, 32, 0), 105) << "the left side faces left";
    EXPECT_GT(value(gl, 44, 32, 0), 150);
    EXPECT_EQ(value(gl, 2, 2, 0), 128);
    EXPECT_EQ(value(gl, 2, 2, 2), 255);
    const MapPicture dx = normal_map("n.png", bump(0.1f), GreenPoints::Down, 16);
    EXPECT_LT(value(dx, 32, 20, 1), 25000);
    EXPECT_GT(value(dx, 44, 32, 0), 40000);
}

TEST(GeneratedMaps, a_slope_of_one_tilts_its_normal_by_45_degrees) {
    const Surface ramp = make_surface(64, [](glm::vec2 uv) {
        SurfacePoint point;
        point.height = uv.x;
        return point;
    });
    const MapPicture picture = normal_map("n.png", ramp, GreenPoints::Up, 16);
    EXPECT_NEAR(value(picture, 32, 32, 0), 65535.0 * (0.5 - 0.5 * std::sqrt(0.5)), 2.0);
    EXPECT_NEAR(value(picture, 32, 32, 2), 65535.0 * (0.5 + 0.5 * std::sqrt(0.5)), 2.0);
}

TEST(GeneratedMaps, ambient_occlusion_is_open_on_the_flat_and_known_at_the_foot_of_a_wall) {
    for (const float open : ambient_occlusion(bump(0.0f))) ASSERT_EQ(open, 1.0f);
    // In front of an endless high wall half of the slices see nothing of the sky.
    const Surface wall = make_surface(64, [](glm::vec2 uv) {
        SurfacePoint point;
        point.height = uv.x > 0.5f ? 1000.0f : 0.0f;
        return point;
    });
    const std::vector<float> open = ambient_occlusion(wall);
    EXPECT_NEAR(open[32 * 64 + 31], 9.0f / 16.0f, 1e-3f) << "7 of 16 slices meet the wall, 2 run along it";
    EXPECT_EQ(open[32 * 64 + 48], 1.0f);
}

TEST(GeneratedMaps, colours_are_srgb_encoded) {
    const Surface grey = make_surface(64, [](glm::vec2 uv) {
        SurfacePoint point;
        point.albedo = uv.y < 0.5f ? glm::vec3(0.0f, 0.5f, 1.0f) : glm::vec3(0.18f, 0.002f, 2.0f);
        return point;
    });
    const MapPicture picture = albedo_map("c.png", grey);
    EXPECT_EQ(value(picture, 0, 0, 0), 0);
    EXPECT_EQ(value(picture, 0, 0, 1), 188);
    EXPECT_EQ(value(picture, 0, 0, 2), 255);
    EXPECT_EQ(value(picture, 0, 63, 0), 118);
    EXPECT_EQ(value(picture, 0, 63, 1), 7);
    EXPECT_EQ(value(picture, 0, 63, 2), 255);
}

TEST(GeneratedMaps, packed_maps_hold_occlusion_roughness_metallic_and_gloss_is_the_opposite_of_roughness) {
    const Surface surface = make_surface(64, [](glm::vec2) {
        SurfacePoint point;
        point.roughness = 0.25f;
        point.metallic = 1.0f;
        return point;
    });
    const MapPicture orm = orm_map("o.png", surface);
    EXPECT_EQ(value(orm, 5, 5, 0), 255);
    EXPECT_EQ(value(orm, 5, 5, 1), 64);
    EXPECT_EQ(value(orm, 5, 5, 2), 255);
    EXPECT_EQ(value(glossiness_map("g.png", surface), 5, 5, 0), 191);
}

TEST(MapNoise, repeats_across_the_unit_square_and_keeps_its_range) {
    for (int i = 0; i < 2000; ++i) {
        const glm::vec2 uv{random01(i, 0, 5), random01(i, 1, 5)};
        const float here = fractal_noise(uv, 7, 5, 9);
        EXPECT_NEAR(here, fractal_noise(uv + glm::vec2(1.0f, 0.0f), 7, 5, 9), 2e-3f);
        EXPECT_NEAR(here, fractal_noise(uv - glm::vec2(0.0f, 1.0f), 7, 5, 9), 2e-3f);
        EXPECT_LE(std::abs(here), 1.6f);
        const Cell cell = cell_noise(uv, 9, 0.9f, 3);
        EXPECT_EQ(cell.id, cell_noise(uv + glm::vec2(1.0f), 9, 0.9f, 3).id);
        EXPECT_GE(cell.to_border, -1e-4f);
        EXPECT_LT(cell.to_border, 1.0f);
    }
}

}  // namespace patina::maps
