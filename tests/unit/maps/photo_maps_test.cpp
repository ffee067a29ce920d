// Maps from a photo, each step against a truth that is known because the photo is computed.
#include "renderer/maps/photo_maps.h"

#include "renderer/core/homography.h"
#include "renderer/maps/even_light.h"
#include "renderer/maps/relief.h"
#include "renderer/maps/tile.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace patina {
namespace {

constexpr double kPi = std::numbers::pi;

/// Bumps of many sizes that do not repeat within the picture, about −1…1.
float bumps(double x, double y) {
    double sum = 0.0;
    for (int k = 1; k <= 6; ++k) {
        const double f = 3.0 * k + 0.37 * k * k, turn = 1.1 * k;
        sum += std::sin(2.0 * kPi * f * (x * std::cos(turn) + y * std::sin(turn)) + 2.3 * k) / k;
    }
    return float(sum / 2.0);
}

glm::vec3 stone(double x, double y) {
    const float light = 0.30f + 0.12f * bumps(x, y);
    return {light, 0.8f * light, 0.6f * light};
}

/// A lamp near the upper left, redder than the room, that falls off with the square of the distance.
glm::vec3 lamp(double x, double y) {
    const double away = (x + 0.2) * (x + 0.2) + (y + 0.4) * (y + 0.4) + 0.8;
    const double near = 1.6 / std::pow(away, 1.5);
    return {float(0.25 + near), float(0.25 + 0.8 * near), float(0.25 + 0.6 * near)};
}

template <class Color>
Colors painted(int width, int height, const Color& color) {
    Colors colors(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) colors.at(x, y) = color((x + 0.5) / width, (y + 0.5) / height);
    return colors;
}

Image picture(const Colors& colors) {
    Image image = make_image(colors.width, colors.height, 3, PixelType::F32);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) set_texel(image, x, y, c, colors.at(x, y)[c]);
    return image;
}

/// Root mean square of the logarithms of the ratio, each channel's mean ratio apart.
double unevenness(const Colors& found, const Colors& truth) {
    double worst = 0.0;
    for (int c = 0; c < 3; ++c) {
        double sum = 0.0, squares = 0.0;
        for (std::size_t i = 0; i < truth.values.size(); ++i) {
            const double ratio = std::log(double(found.values[i][c]) / double(truth.values[i][c]));
            sum += ratio;
            squares += ratio * ratio;
        }
        const double n = double(truth.values.size());
        worst = std::max(worst, std::sqrt(std::max(squares / n - sum / n * sum / n, 0.0)));
    }
    return worst;
}

double angle_deg(glm::vec3 a, glm::vec3 b) {
    return glm::degrees(std::atan2(double(glm::length(glm::cross(a, b))), double(glm::dot(a, b))));
}
double mean_angle(const Colors& a, const Colors& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.values.size(); ++i) sum += angle_deg(a.values[i], b.values[i]);
    return sum / double(a.values.size());
}

// ---- even light ----

TEST(EvenLight, a_lamps_gradient_is_taken_out_and_the_surface_stays) {
    const Colors truth = painted(256, 256, stone);
    const Colors lit = painted(256, 256, [](double x, double y) { return stone(x, y) * lamp(x, y); });
    const Colors even = evened(lit, 3);
    EXPECT_GT(unevenness(lit, truth), 0.3);
    EXPECT_LT(unevenness(even, truth), 0.02);
    RecordProperty("before", std::to_string(unevenness(lit, truth)));
    RecordProperty("after", std::to_string(unevenness(even, truth)));
}

TEST(EvenLight, each_channel_keeps_its_mean_level) {
    const Colors lit = painted(96, 64, [](double x, double y) { return stone(x, y) * lamp(x, y); });
    const Colors even = evened(lit, 2);
    for (int c = 0; c < 3; ++c) {
        double before = 0.0, after = 0.0;
        for (std::size_t i = 0; i < lit.values.size(); ++i) {
            before += double(lit.values[i][c]);
            after += double(even.values[i][c]);
        }
        EXPECT_NEAR(after / before, 1.0, 1e-4);
    }
}

TEST(EvenLight, stains_do_not_pull_the_light) {
    const auto stained = [](double x, double y) {
        const bool stain = x > 0.7 && x < 0.95 && y > 0.1 && y < 0.35;
        return stone(x, y) * (stain ? 0.15f : 1.0f);
    };
    const Colors lit = painted(192, 192, [&](double x, double y) { return stained(x, y) * lamp(x, y); });
    EXPECT_LT(unevenness(evened(lit, 3), painted(192, 192, stained)), 0.06);
}

TEST(EvenLight, degree_none_changes_nothing_and_one_pixel_is_no_trouble) {
    const Colors lit = painted(8, 8, lamp);
    EXPECT_EQ(evened(lit, 0).values, lit.values);
    for (const float value : {0.0f, 0.5f}) {
        const Colors one = painted(1, 1, [&](double, double) { return glm::vec3(value); });
        EXPECT_NEAR(evened(one, 4).at(0, 0).x, value, 1e-5f);
    }
}

// ---- tiles ----

struct Steps {
    float p99 = 0.0f, largest = 0.0f;
};
/// Differences between neighbours along x (or y); wrap: only those over the border.
Steps steps(const Colors& colors, bool along_x, bool wrap) {
    std::vector<float> all;
    const int width = colors.width, height = colors.height;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const bool border = along_x ? x == width - 1 : y == height - 1;
            if (border != wrap) continue;
            const glm::vec3 next = along_x ? colors.at((x + 1) % width, y) : colors.at(x, (y + 1) % height);
            all.push_back(glm::length(next - colors.at(x, y)));
        }
    std::ranges::sort(all);
    return {all[all.size() * 99 / 100], all.back()};
}

TEST(Tile, has_no_seam_above_the_textures_own_gradient) {
    const Colors source = painted(160, 200, [](double x, double y) { return stone(0.3 * x, 0.3 * y); });
    const Colors tile = tiled(source);
    ASSERT_EQ(tile.width, 128);
    ASSERT_EQ(tile.height, 160);
    for (const bool along_x : {true, false}) {
        const Steps own = steps(source, along_x, false), border = steps(tile, along_x, true),
                    inside = steps(tile, along_x, false), uncut = steps(source, along_x, true);
        EXPECT_GT(uncut.p99, 1.5f * own.largest) << "the source must show a seam, else this proves nothing";
        EXPECT_LE(border.p99, own.p99);
        EXPECT_LE(border.largest, own.largest);
        EXPECT_LE(inside.p99, own.p99 * 1.1f);
        EXPECT_LE(inside.largest, own.largest * 1.6f)
            << "where the overlap is grown together over few pixels";
    }
}

TEST(Tile, keeps_the_picture_away_from_the_borders) {
    const Colors source = painted(100, 80, stone);
    const Colors tile = tiled(source);
    for (int y = 20; y < tile.height; ++y)
        for (int x = 24; x < tile.width; ++x) EXPECT_EQ(tile.at(x, y), source.at(x, y));
}

TEST(Tile, of_what_is_tileable_already_is_itself) {
    const auto waves = [](double x, double y) {
        return glm::vec3(float(0.5 + 0.2 * std::sin(2.0 * kPi * 5.0 * x) * std::cos(2.0 * kPi * 5.0 * y)));
    };
    const Colors source = painted(160, 160, waves);  // a quarter more than four fifths: four periods of 32
    const Colors tile = tiled(source);
    ASSERT_EQ(tile.width, 128);
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 128; ++x) EXPECT_NEAR(tile.at(x, y).x, source.at(x, y).x, 1e-5f);
}

// ---- relief ----

/// A tileable field of smooth bumps, heights in widths.
Plane dunes(int size, float depth) {
    Plane height(size, size);
    std::mt19937 random(7);
    for (int k = 0; k < 40; ++k) {
        const auto pick = [&](int n) { return int(random() % unsigned(n)); };
        const int fx = pick(13) - 6, fy = pick(13) - 6;
        const double phase = 0.001 * pick(6283);
        const int f2 = fx * fx + fy * fy;
        if (f2 == 0) continue;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                height.at(x, y) +=
                    float(double(depth) / f2 *
                          std::sin(2.0 * kPi * (fx * (x + 0.5) + fy * (y + 0.5)) / size + phase));
    }
    return height;
}

Plane lambert(const Colors& normals, float azimuth_deg, float elevation_deg) {
    const float a = glm::radians(azimuth_deg), e = glm::radians(elevation_deg);
    const glm::vec3 light(std::cos(a) * std::cos(e), std::sin(a) * std::cos(e), std::sin(e));
    Plane log_light(normals.width, normals.height);
    for (std::size_t i = 0; i < normals.values.size(); ++i)
        log_light.values[i] = std::log(std::max(0.3f * glm::dot(normals.values[i], light), 1e-4f));
    return log_light;
}

TEST(Relief, normals_of_a_known_slope_point_away_from_what_rises) {
    Plane ramp(16, 16);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) ramp.at(x, y) = (0.5f * float(x) - 0.25f * float(y)) / 16.0f;
    const glm::vec3 expected = glm::normalize(glm::vec3(-0.5f, -0.25f, 1.0f));  // y of pictures runs down
    EXPECT_LT(angle_deg(normals_of(ramp, false).at(8, 8), expected), 0.01);
}

TEST(Relief, from_a_side_light_the_known_normals_come_back) {
    const Plane truth = dunes(128, 0.03f);
    const Colors normals = normals_of(truth, true);
    const Colors flat = painted(128, 128, [](double, double) { return glm::vec3(0, 0, 1); });
    const double before = mean_angle(normals, flat);
    ASSERT_GT(before, 8.0);
    for (const float azimuth : {0.0f, 65.0f, 90.0f, 200.0f}) {
        const MapSettings settings{.relief_from = ReliefFrom::Light,
                                   .light_azimuth_deg = azimuth,
                                   .light_elevation_deg = 50.0f,
                                   .relief_scale = 1.0f};
        const Plane found = relief_of(lambert(normals, azimuth, 50.0f), settings, fourier_transform());
        const double error = mean_angle(normals, normals_of(found, true));
        RecordProperty("azimuth_" + std::to_string(int(azimuth)), std::to_string(error));
        EXPECT_LT(error, 0.6 * before) << "flat would be off by " << before << " degrees";
    }
}

TEST(Relief, from_brightness_dark_is_deep_and_the_slope_is_as_strong_as_asked) {
    const Plane truth = dunes(128, 0.03f);
    Plane log_light = truth;  // as bright as it is high
    for (float& value : log_light.values) value = std::log(0.4f + 2.0f * value);
    const Plane found =
        relief_of(log_light, {.relief_scale = 1.0f, .relief_strength = 2.0f}, fourier_transform());
    double product = 0.0, a = 0.0, b = 0.0;
    for (std::size_t i = 0; i < truth.values.size(); ++i) {
        product += double(truth.values[i]) * double(found.values[i]);
        a += double(truth.values[i]) * double(truth.values[i]);
        b += double(found.values[i]) * double(found.values[i]);
    }
    EXPECT_GT(product / std::sqrt(a * b), 0.9);
    double squares = 0.0;
    for (const glm::vec3& n : normals_of(found, true).values)
        squares += double((n.x * n.x + n.y * n.y) / (n.z * n.z));
    EXPECT_NEAR(std::sqrt(squares / double(found.values.size())), 0.5, 0.01);
}

TEST(Relief, forms_larger_than_the_scale_are_left_out) {
    Plane light(128, 64);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 128; ++x)
            light.at(x, y) = float(std::sin(2.0 * kPi * x / 128.0) + 0.1 * std::sin(2.0 * kPi * x / 8.0));
    const Plane found = relief_of(light, {.relief_scale = 0.1f}, fourier_transform());
    const auto amplitude = [&](int waves) {
        double sum = 0.0;
        for (int x = 0; x < 128; ++x)
            sum += double(found.at(x, 32)) * std::sin(2.0 * kPi * waves * x / 128.0);
        return std::abs(sum);
    };
    EXPECT_LT(amplitude(1), 0.2 * amplitude(16));
}

TEST(Relief, a_picture_that_does_not_tile_is_no_worse_at_its_borders) {
    const Colors source = painted(96, 96, stone);
    Plane light(96, 96);
    for (std::size_t i = 0; i < light.values.size(); ++i) light.values[i] = std::log(source.values[i].x);
    for (const ReliefFrom from : {ReliefFrom::Brightness, ReliefFrom::Light}) {
        const Colors normals = normals_of(
            relief_of(light, {.tileable = false, .relief_from = from}, fourier_transform()), false);
        double inside = 0.0, border = 0.0;
        for (int i = 0; i < 96; ++i) {
            border += angle_deg(normals.at(i, 0), {0, 0, 1});
            inside += angle_deg(normals.at(i, 48), {0, 0, 1});
        }
        EXPECT_LT(border, 1.5 * inside + 1.0);
    }
}

TEST(Visibility, of_a_plain_is_one_and_at_the_foot_of_a_wall_is_half_hidden) {
    const MapSettings settings{.tileable = false, .ao_radius = 0.4f};
    const Plane plain(64, 64);
    EXPECT_FLOAT_EQ(visibility_of(plain, settings).at(10, 10), 1.0f);
    Plane wall(64, 64);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 32; ++x) wall.at(x, y) = 10.0f;
    const Plane seen = visibility_of(wall, settings);
    EXPECT_NEAR(seen.at(32, 32), 0.5f, 0.08f) << "half of the directions end at the wall";
    EXPECT_FLOAT_EQ(seen.at(63, 32), 1.0f) << "the wall is farther away than counts";
    EXPECT_FLOAT_EQ(seen.at(10, 32), 1.0f);
}

// ---- the whole ----

TEST(PhotoMaps, a_sample_in_perspective_comes_back_straight_and_even) {
    const Colors truth = painted(320, 320, stone);
    const FourPoints corners{glm::dvec2{70, 40}, {430, 60}, {460, 350}, {40, 370}};
    const FourPoints whole{glm::dvec2{0, 0}, {320, 0}, {320, 320}, {0, 320}};
    const Image lit = picture(painted(320, 320, [](double x, double y) { return stone(x, y) * lamp(x, y); }));
    const Image warped_photo = warped(lit, *homography(corners, whole), {500, 400});
    Image photo = make_image(500, 400, 3, PixelType::F32);
    for (int y = 0; y < 400; ++y)
        for (int x = 0; x < 500; ++x)
            for (int c = 0; c < 3; ++c) set_texel(photo, x, y, c, 0.5f * texel(warped_photo, x, y, c));
    MapSettings settings{.gain = glm::vec3(2.0f), .size_px = {256, 256}, .tileable = false};
    for (std::size_t i = 0; i < 4; ++i) settings.corners[i] = glm::vec2(corners[i] / glm::dvec2(500, 400));
    const auto maps = make_photo_maps(photo, settings, fourier_transform());
    ASSERT_TRUE(maps);
    const Colors expected = painted(256, 256, stone);
    double squares = 0.0, sum = 0.0;
    for (int y = 8; y < 248; ++y)
        for (int x = 8; x < 248; ++x) {
            const double ratio =
                std::log(double(srgb_to_linear(texel(maps->albedo, x, y, 1))) / double(expected.at(x, y).y));
            sum += ratio;
            squares += ratio * ratio;
        }
    const double n = 240.0 * 240.0;
    EXPECT_LT(std::sqrt(squares / n - sum / n * sum / n), 0.04);
    EXPECT_EQ(maps->height.type, PixelType::U16);
    EXPECT_EQ(maps->normal.type, PixelType::U16);
    EXPECT_EQ(maps->normal.channels, 3);
    EXPECT_GT(maps->depth, 0.0f);
}

TEST(PhotoMaps, of_a_tile_all_maps_tile) {
    const Image photo = picture(painted(300, 300, stone));
    const auto maps = make_photo_maps(photo, {.size_px = {128, 96}}, fourier_transform());
    ASSERT_TRUE(maps);
    for (const Image* map : {&maps->albedo, &maps->height, &maps->normal, &maps->roughness, &maps->ao}) {
        ASSERT_EQ(map->width, 128);
        ASSERT_EQ(map->height, 96);
        float border = 0.0f, inside = 0.0f;
        for (int y = 0; y < 96; ++y)
            for (int x = 0; x < 128; ++x) {
                const float step = std::abs(texel(*map, (x + 1) % 128, y, 0) - texel(*map, x, y, 0));
                (x == 127 ? border : inside) = std::max(x == 127 ? border : inside, step);
            }
        EXPECT_LE(border, inside) << "channels " << map->channels;
    }
}

TEST(PhotoMaps, removed_shading_leaves_a_flatter_albedo) {
    const Image photo = picture(painted(200, 200, stone));
    const auto spread = [&](float removed) {
        const auto maps =
            make_photo_maps(photo, {.size_px = {128, 128}, .shading_removed = removed, .relief_scale = 1.0f},
                            fourier_transform());
        double sum = 0.0, squares = 0.0;
        for (int y = 0; y < 128; ++y)
            for (int x = 0; x < 128; ++x) {
                const double value = double(texel(maps->albedo, x, y, 1));
                sum += value;
                squares += value * value;
            }
        const double n = 128.0 * 128.0;
        return std::sqrt(squares / n - sum / n * sum / n);
    };
    EXPECT_LT(spread(1.0f), 0.3 * spread(0.0f));
}

TEST(PhotoMaps, roughness_is_higher_where_the_grain_is_and_lower_where_it_shines) {
    std::mt19937 random(3);
    Colors colors(160, 160);
    for (int y = 0; y < 160; ++y)
        for (int x = 0; x < 160; ++x) {
            const float grain = x < 80 ? 0.1f * (float(random() % 1000) / 1000.0f - 0.5f) : 0.0f;
            const bool glint = x > 110 && x < 118 && y > 70 && y < 78;
            colors.at(x, y) = glm::vec3(glint ? 0.9f : 0.3f + grain);
        }
    const auto maps = make_photo_maps(
        picture(colors), {.size_px = {160, 160}, .even_degree = 0, .tileable = false}, fourier_transform());
    EXPECT_GT(texel(maps->roughness, 40, 80, 0), texel(maps->roughness, 140, 20, 0) + 0.05f);
    EXPECT_LT(texel(maps->roughness, 114, 74, 0), texel(maps->roughness, 140, 20, 0));
}

/// What went wrong, or nothing.
std::string failure(const Image& photo, const MapSettings& settings) {
    try {
        static_cast<void>(make_photo_maps(photo, settings, fourier_transform()));
        return {};
    } catch (const std::runtime_error& error) {
        return error.what();
    }
}

TEST(PhotoMaps, what_cannot_be_is_said) {
    const Image photo = picture(painted(64, 64, stone));
    MapSettings settings{.size_px = {32, 32}};
    settings.corners = {glm::vec2{0, 0}, {0.5f, 0.5f}, {1, 1}, {0, 1}};
    EXPECT_NE(failure(photo, settings).find("four-sided"), std::string::npos);
    settings.corners = {glm::vec2{0, 0}, {1, 1}, {1, 0}, {0, 1}};
    EXPECT_NE(failure(photo, settings).find("order"), std::string::npos) << "crossed";
    settings.corners = {glm::vec2{0, 0}, {0.1f, 0}, {0.1f, 0.1f}, {0, 0.1f}};
    EXPECT_NE(failure(photo, settings).find("nearer"), std::string::npos);
    const auto filled = [](float value, int side) {
        return picture(painted(side, side, [&](double, double) { return glm::vec3(value); }));
    };
    EXPECT_NE(failure(filled(0.5f, 1), {}).find("pixels wide"), std::string::npos);
    EXPECT_NE(failure(filled(0.0f, 64), {.size_px = {32, 32}}).find("black"), std::string::npos);
    EXPECT_NE(failure(filled(std::numeric_limits<float>::quiet_NaN(), 64), {.size_px = {32, 32}}).find("not"),
              std::string::npos);
}

TEST(PhotoMaps, a_plain_surface_and_broken_pixels_give_clean_maps) {
    Image photo = picture(painted(64, 64, [](double, double) { return glm::vec3(0.4f); }));
    set_texel(photo, 10, 10, 0, std::numeric_limits<float>::infinity());
    set_texel(photo, 20, 20, 1, -3.0f);
    set_texel(photo, 30, 30, 2, std::numeric_limits<float>::quiet_NaN());
    for (const ReliefFrom from : {ReliefFrom::Brightness, ReliefFrom::Light}) {
        const auto maps =
            make_photo_maps(photo, {.size_px = {48, 48}, .relief_from = from}, fourier_transform());
        ASSERT_TRUE(maps);
        for (const Image* map : {&maps->rectified, &maps->even, &maps->albedo, &maps->normal})
            for (int y = 0; y < map->height; ++y)
                for (int x = 0; x < map->width; ++x)
                    for (int c = 0; c < 3; ++c) ASSERT_TRUE(std::isfinite(texel(*map, x, y, c)));
        EXPECT_NEAR(srgb_to_linear(texel(maps->albedo, 40, 5, 0)), 0.4f, 0.05f);
    }
    const auto plain =
        make_photo_maps(picture(painted(64, 64, [](double, double) { return glm::vec3(0.4f); })),
                        {.size_px = {48, 48}}, fourier_transform());
    EXPECT_NEAR(texel(plain->normal, 24, 24, 2), 1.0f, 1e-4f);
    EXPECT_FLOAT_EQ(texel(plain->ao, 24, 24, 0), 1.0f);
}

TEST(PhotoMaps, stop_when_asked) {
    std::stop_source stop;
    stop.request_stop();
    EXPECT_FALSE(make_photo_maps(picture(painted(64, 64, stone)), {.size_px = {32, 32}}, fourier_transform(),
                                 {.stop = stop.get_token()}));
}

}  // namespace
}  // namespace patina
