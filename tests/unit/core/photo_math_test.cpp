// Homographies, colour differences, balancing and comparing photos: against published values and known
// truths.
#include "renderer/core/color_difference.h"
#include "renderer/core/homography.h"
#include "renderer/core/photo.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace patina {
namespace {

Image painted(int width, int height, auto color) {
    Image image = make_image(width, height, 3, PixelType::F32);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::vec3 value = color(float(x) + 0.5f, float(y) + 0.5f);
            for (int c = 0; c < 3; ++c) set_texel(image, x, y, c, value[c]);
        }
    return image;
}
Image covered(const Image& image) {
    Image result = make_image(image.width, image.height, 4, PixelType::F32);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < 3; ++c) set_texel(result, x, y, c, texel(image, x, y, c));
            set_texel(result, x, y, 3, 1.0f);
        }
    return result;
}

TEST(Homography, maps_the_four_points_exactly_and_its_inverse_maps_them_back) {
    const FourPoints from{glm::dvec2{12, 7}, {3801, 240}, {3620, 2911}, {170, 2500}};
    const FourPoints to{glm::dvec2{0, 0}, {512, 0}, {512, 384}, {0, 384}};
    const auto h = homography(from, to);
    ASSERT_TRUE(h);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_LT(glm::distance(mapped(*h, from[i]), to[i]), 1e-8);
        EXPECT_LT(glm::distance(mapped(glm::inverse(*h), to[i]), from[i]), 1e-7);
    }
}

TEST(Homography, recovers_a_known_perspective_between_the_points) {
    const glm::dmat3 truth(1.1, 0.05, 2e-4, -0.1, 0.93, -1e-4, 20.0, -7.0, 1.0);
    const FourPoints from{glm::dvec2{0, 0}, {640, 0}, {640, 480}, {0, 480}};
    FourPoints to;
    for (std::size_t i = 0; i < 4; ++i) to[i] = mapped(truth, from[i]);
    const auto h = homography(from, to);
    ASSERT_TRUE(h);
    for (const glm::dvec2 point : {glm::dvec2{320, 240}, {17, 401}, {600, 90}})
        EXPECT_LT(glm::distance(mapped(*h, point), mapped(truth, point)), 1e-9);
}

TEST(Homography, three_points_on_a_line_have_none) {
    const FourPoints square{glm::dvec2{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    EXPECT_FALSE(homography({glm::dvec2{0, 0}, {1, 1}, {2, 2}, {0, 1}}, square));
    EXPECT_FALSE(homography(square, {glm::dvec2{5, 5}, {5, 5}, {1, 1}, {0, 1}}));
}

TEST(Homography, a_warped_picture_shows_at_each_pixel_what_lies_there_in_the_photo) {
    const Image photo =
        painted(400, 300, [](float x, float y) { return glm::vec3(x / 400.0f, y / 300.0f, 0.25f); });
    const FourPoints view{glm::dvec2{0, 0}, {64, 0}, {64, 48}, {0, 48}};
    const FourPoints in_photo{glm::dvec2{40, 30}, {350, 60}, {330, 270}, {70, 240}};
    const auto h = homography(view, in_photo);
    ASSERT_TRUE(h);
    const Image result = warped(photo, *h, {64, 48});
    for (const glm::ivec2 at : {glm::ivec2{5, 5}, {32, 24}, {60, 40}}) {
        const glm::dvec2 truth = mapped(*h, glm::dvec2(at) + 0.5);
        EXPECT_NEAR(texel(result, at.x, at.y, 0) * 400.0f, truth.x, 0.5);
        EXPECT_NEAR(texel(result, at.x, at.y, 1) * 300.0f, truth.y, 0.5);
        EXPECT_EQ(texel(result, at.x, at.y, 3), 1.0f);
    }
}

TEST(Homography, what_the_photo_does_not_cover_is_marked) {
    const Image photo = painted(10, 10, [](float, float) { return glm::vec3(0.5f); });
    const Image result = warped(photo, glm::dmat3(1, 0, 0, 0, 1, 0, -5.0, 0, 1), {20, 10});
    EXPECT_EQ(texel(result, 2, 5, 3), 0.0f);
    EXPECT_EQ(texel(result, 10, 5, 3), 1.0f);
    EXPECT_FLOAT_EQ(texel(result, 10, 5, 1), 0.5f);
    EXPECT_EQ(texel(result, 18, 5, 3), 0.0f);
}

TEST(ColorDifference, agrees_with_the_published_pairs_of_ciede2000) {
    struct Row {
        glm::vec3 a, b;
        float difference;
    };
    // Sharma, Wu, Dalal (2005), table 1.
    const Row rows[] = {
        {{50, 2.6772f, -79.7751f}, {50, 0, -82.7485f}, 2.0425f},
        {{50, 3.1571f, -77.2803f}, {50, 0, -82.7485f}, 2.8615f},
        {{50, 2.8361f, -74.02f}, {50, 0, -82.7485f}, 3.4412f},
        {{50, -1.3802f, -84.2814f}, {50, 0, -82.7485f}, 1.0000f},
        {{50, 0, 0}, {50, -1, 2}, 2.3669f},
        {{50, 2.49f, -0.001f}, {50, -2.49f, 0.0009f}, 7.1792f},
        {{50, 2.49f, -0.001f}, {50, -2.49f, 0.0011f}, 7.2195f},
        {{50, -0.001f, 2.49f}, {50, 0.0009f, -2.49f}, 4.8045f},
        {{50, -0.001f, 2.49f}, {50, 0.0011f, -2.49f}, 4.7461f},
        {{50, 2.5f, 0}, {50, 0, -2.5f}, 4.3065f},
        {{50, 2.5f, 0}, {73, 25, -18}, 27.1492f},
        {{50, 2.5f, 0}, {61, -5, 29}, 22.8977f},
        {{50, 2.5f, 0}, {56, -27, -3}, 31.9030f},
        {{50, 2.5f, 0}, {58, 24, 15}, 19.4535f},
        {{60.2574f, -34.0099f, 36.2677f}, {60.4626f, -34.1751f, 39.4387f}, 1.2644f},
        {{63.0109f, -31.0961f, -5.8663f}, {62.8187f, -29.7946f, -4.0864f}, 1.2630f},
        {{61.2901f, 3.7196f, -5.3901f}, {61.4292f, 2.2480f, -4.9620f}, 1.8731f},
        {{35.0831f, -44.1164f, 3.7933f}, {35.0232f, -40.0716f, 1.5901f}, 1.8645f},
        {{22.7233f, 20.0904f, -46.6940f}, {23.0331f, 14.9730f, -42.5619f}, 2.0373f},
        {{36.4612f, 47.8580f, 18.3852f}, {36.2715f, 50.5065f, 21.2231f}, 1.4146f},
        {{90.8027f, -2.0831f, 1.4410f}, {91.1528f, -1.6435f, 0.0447f}, 1.4441f},
        {{90.9257f, -0.5406f, -0.9208f}, {88.6381f, -0.8985f, -0.7239f}, 1.5381f},
        {{6.7747f, -0.2908f, -2.4247f}, {5.8714f, -0.0985f, -2.2286f}, 0.6377f},
        {{2.0776f, 0.0795f, -1.1350f}, {0.9033f, -0.0636f, -0.5514f}, 0.9082f},
    };
    for (const Row& row : rows) {
        EXPECT_NEAR(delta_e_2000(row.a, row.b), row.difference, 2e-4f);
        EXPECT_NEAR(delta_e_2000(row.b, row.a), row.difference, 2e-4f);
    }
}

TEST(ColorDifference, white_is_white_and_grey_has_no_hue) {
    EXPECT_NEAR(lab_of(glm::vec3(1.0f)).x, 100.0f, 1e-4f);
    const glm::vec3 grey = lab_of(glm::vec3(0.18f));
    EXPECT_NEAR(grey.x, 49.496f, 1e-2f);
    EXPECT_NEAR(grey.y, 0.0f, 1e-4f);
    EXPECT_NEAR(grey.z, 0.0f, 1e-4f);
    EXPECT_EQ(delta_e_2000(grey, grey), 0.0f);
}

TEST(PhotoBalance, a_grey_card_gives_back_the_cameras_gain_and_tint) {
    const glm::vec3 card(0.18f), cast{1.6f, 1.0f, 0.7f};
    const float gain = std::exp2(-1.3f);
    const auto balance = balance_to(card * cast * gain, card);
    ASSERT_TRUE(balance);
    const glm::vec3 restored = card * cast * gain * balance->white_balance * std::exp2(balance->exposure_ev);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(restored[c], 0.18f, 1e-5f);
    EXPECT_NEAR(balance->white_balance.x / balance->white_balance.y, 1.0f / 1.6f, 1e-5f);
    EXPECT_NEAR(balance->exposure_ev, 1.3f - std::log2(luminance(cast)), 1e-4f);
}

TEST(PhotoBalance, a_clipped_or_black_patch_gives_none) {
    EXPECT_FALSE(balance_to({1.0f, 0.8f, 0.8f}, glm::vec3(0.9f)));
    EXPECT_FALSE(balance_to({0.2f, 0.0f, 0.2f}, glm::vec3(0.18f)));
}

TEST(PhotoPatch, leaves_scratches_out_and_stays_inside) {
    Image photo = painted(40, 40, [](float, float) { return glm::vec3(0.2f, 0.3f, 0.4f); });
    for (int c = 0; c < 3; ++c) set_texel(photo, 20, 20, c, 50.0f);
    const auto color = patch_color(photo, {20.5f, 20.5f}, 4.0f);
    ASSERT_TRUE(color);
    EXPECT_NEAR(color->y, 0.3f, 1e-6f);
    EXPECT_TRUE(patch_color(photo, {0.0f, 39.9f}, 4.0f));
    EXPECT_FALSE(patch_color(photo, {-1.0f, 5.0f}, 4.0f));
    EXPECT_FALSE(patch_color(photo, {5.0f, 40.0f}, 4.0f));
}

TEST(PhotoInView, without_a_fit_it_lies_in_the_middle_undistorted) {
    const Image photo = painted(200, 100, [](float x, float) { return glm::vec3(x / 200.0f); });
    const Image view = photo_in_view(Photo{.file = "a.png"}, photo, {100, 100});
    EXPECT_EQ(texel(view, 50, 20, 3), 0.0f);
    EXPECT_EQ(texel(view, 50, 30, 3), 1.0f);
    EXPECT_EQ(texel(view, 50, 76, 3), 0.0f);
    EXPECT_NEAR(texel(view, 50, 50, 0), 0.5f, 0.01f);
    EXPECT_NEAR(texel(view, 10, 50, 0), 0.105f, 0.01f);
}

TEST(PhotoInView, exposure_and_white_balance_multiply) {
    const Image photo = painted(8, 8, [](float, float) { return glm::vec3(0.1f); });
    const Image view =
        photo_in_view(Photo{.file = "a", .exposure_ev = 2.0f, .white_balance = {1, 2, 3}}, photo, {8, 8});
    EXPECT_NEAR(texel(view, 4, 4, 0), 0.4f, 1e-6f);
    EXPECT_NEAR(texel(view, 4, 4, 1), 0.8f, 1e-6f);
    EXPECT_NEAR(texel(view, 4, 4, 2), 1.2f, 1e-6f);
}

TEST(PhotoInView, a_degenerate_fit_is_said_with_the_photos_name) {
    Photo photo{.file = "shot.jpg", .fit = PhotoFit{}};
    photo.fit->photo[2] = {0.5f, 0.0f};
    try {
        photo_in_view(photo, painted(8, 8, [](float, float) { return glm::vec3(0.1f); }), {8, 8});
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("shot.jpg"), std::string::npos);
    }
}

TEST(PhotoResidual, is_nothing_for_the_same_picture_and_counts_only_the_region) {
    const Image render =
        painted(20, 10, [](float x, float y) { return glm::vec3(x / 40.0f, y / 20.0f, 0.3f); });
    const Residual same = residual_of(covered(render), render, std::nullopt);
    EXPECT_EQ(same.pixels, 200);
    EXPECT_EQ(same.delta_e, 0.0f);
    EXPECT_EQ(same.luminance_rms, 0.0f);
    Image other = render;
    for (int c = 0; c < 3; ++c) set_texel(other, 12, 5, c, 1.0f);
    EXPECT_GT(residual_of(covered(render), other, std::nullopt).delta_e, 0.0f);
    const Residual left = residual_of(covered(render), other, Region{0.0f, 0.0f, 0.5f, 1.0f});
    EXPECT_EQ(left.pixels, 50) << "half of the square in the middle";
    EXPECT_EQ(left.delta_e, 0.0f);
    EXPECT_EQ(residual_of(covered(render), other, Region{0.5f, 0.5f, 0.5f, 0.5f}).pixels, 0);
}

TEST(PhotoResidual, says_which_is_brighter_and_by_how_much) {
    const Image photo = painted(8, 8, [](float, float) { return glm::vec3(0.2f); });
    const Image render = painted(8, 8, [](float, float) { return glm::vec3(0.25f); });
    const Residual residual = residual_of(covered(photo), render, std::nullopt);
    EXPECT_NEAR(residual.luminance_bias, 0.25f, 1e-4f);
    EXPECT_NEAR(residual.luminance_rms, 0.25f, 1e-4f);
    EXPECT_NEAR(residual.delta_e_95, residual.delta_e, 1e-5f);
}

TEST(PhotoInView, what_is_no_number_is_not_there) {
    Image photo = painted(8, 8, [](float, float) { return glm::vec3(0.2f); });
    set_texel(photo, 1, 1, 0, std::numeric_limits<float>::quiet_NaN());
    set_texel(photo, 6, 6, 2, std::numeric_limits<float>::infinity());
    const Image view = photo_in_view({}, photo, {8, 8});
    EXPECT_EQ(texel(view, 1, 1, 3), 0.0f);
    EXPECT_EQ(texel(view, 6, 6, 3), 0.0f);
    EXPECT_EQ(texel(view, 4, 4, 3), 1.0f);
    const Residual residual =
        residual_of(view, painted(8, 8, [](float, float) { return glm::vec3(0.2f); }), {});
    EXPECT_LT(residual.pixels, 64);
    EXPECT_GT(residual.pixels, 30);
    EXPECT_NEAR(residual.delta_e, 0.0f, 1e-4f);
    EXPECT_TRUE(patch_color(photo, {1.5f, 1.5f}, 2.0f)) << "of what is left";
    EXPECT_FALSE(patch_color(photo, {1.5f, 1.5f}, 0.0f));
}

TEST(PhotoResidual, its_picture_holds_the_same_differences) {
    const Image photo = painted(8, 8, [](float x, float) { return glm::vec3(x / 10.0f); });
    const Image render = painted(8, 8, [](float x, float) { return glm::vec3(x / 10.0f + 0.05f); });
    Image picture;
    const Residual residual = residual_of(covered(photo), render, Region{0.0f, 0.0f, 1.0f, 0.5f}, &picture);
    float sum = 0.0f;
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 8; ++x) sum += texel(picture, x, y, 0);
    EXPECT_NEAR(sum / 32.0f, residual.delta_e, 1e-4f);
    EXPECT_LT(texel(picture, 3, 6, 0), 0.0f) << "outside of the region";
    const Image heat = heat_picture(picture, 10.0f);
    EXPECT_NEAR(texel(heat, 3, 6, 0), 0.5f, 0.01f) << "grey is not compared";
    EXPECT_GT(texel(heat, 3, 2, 2), 0.1f);
    const Image light =
        luminance_picture(covered(photo), render, Region{0.0f, 0.0f, 1.0f, 0.5f}, kLuminanceWhite);
    EXPECT_NEAR(texel(light, 3, 6, 0), 0.5f, 0.01f);
    EXPECT_GT(texel(light, 3, 2, 0), texel(light, 3, 2, 2)) << "brighter is red";
    const Image darker = luminance_picture(covered(render), photo, std::nullopt, kLuminanceWhite);
    EXPECT_LT(texel(darker, 3, 2, 0), texel(darker, 3, 2, 2)) << "darker is blue";
}

TEST(PhotoEstimate, finds_the_bottom_of_a_parabola_between_the_trials) {
    const auto at = [](float x) { return Trial{x, 2.0f + 30.0f * (x - 0.07f) * (x - 0.07f) * 10.0f}; };
    const std::array trials{at(-0.1f), at(0.0f), at(0.1f), at(0.2f)};
    const auto estimate = estimate_offset(trials);
    ASSERT_TRUE(estimate);
    EXPECT_NEAR(estimate->offset, 0.07f, 1e-4f);
    EXPECT_NEAR(estimate->delta_e, 2.0f, 1e-3f);
    EXPECT_TRUE(estimate->clear);
}

TEST(PhotoEstimate, says_nothing_clear_where_nothing_helps) {
    const std::array flat{Trial{-0.1f, 3.1f}, Trial{0.0f, 3.0f}, Trial{0.1f, 3.1f}};
    EXPECT_FALSE(estimate_offset(flat)->clear);
    const auto faint = [](float floor) {
        return std::array{Trial{-0.1f, floor + 0.6f}, Trial{0.0f, floor + 0.3f}, Trial{0.1f, floor},
                          Trial{0.2f, floor + 0.3f}};
    };
    EXPECT_TRUE(estimate_offset(faint(0.02f))->clear) << "it explains all there is";
    EXPECT_FALSE(estimate_offset(faint(1.0f))->clear) << "a photo's noise hides as much";
    const std::array without_now{Trial{-0.1f, 3.1f}, Trial{0.05f, 3.0f}, Trial{0.1f, 3.1f}};
    EXPECT_FALSE(estimate_offset(without_now));
    EXPECT_FALSE(estimate_offset(std::span(flat).first(2)));
}

TEST(CameraExif, is_read_from_what_cameras_write) {
    const std::vector<std::pair<std::string, std::string>> metadata{{"Make", "Canon"},
                                                                    {"Model", "Canon EOS 80D"},
                                                                    {"ExposureTime", "0.008"},
                                                                    {"FNumber", "5.6"},
                                                                    {"Exif:PhotographicSensitivity", "200"},
                                                                    {"Exif:FocalLength", "50"},
                                                                    {"DateTime", "2026:04:01"}};
    const CameraExif exif = exif_of(metadata);
    EXPECT_EQ(describe(exif), "Canon EOS 80D, 1/125 s, f/5.6, ISO 200, 50 mm");
    ASSERT_TRUE(exposure_value(exif));
    EXPECT_NEAR(*exposure_value(exif), std::log2(5.6f * 5.6f / 0.008f) - 1.0f, 1e-4f);
    EXPECT_EQ(describe(exif_of({})), "");
    EXPECT_FALSE(exposure_value(exif_of({})));
    const std::vector<std::pair<std::string, std::string>> fraction{{"ExposureTime", "1/30"}};
    EXPECT_EQ(describe(exif_of(fraction)), "1/30 s");
}

TEST(PhotoInView, views_of_any_shape_mean_the_square_in_their_middle) {
    EXPECT_EQ(pixel_of({0.0, 1.0}, {300, 100}), glm::dvec2(100.0, 100.0));
    EXPECT_EQ(pixel_of({0.5, 0.0}, {100, 300}), glm::dvec2(50.0, 100.0));
    Photo photo{.file = "a.png", .fit = PhotoFit{}};
    const auto square = view_to_photo(photo, {80, 60}, {100, 100}),
               wide = view_to_photo(photo, {80, 60}, {300, 100});
    ASSERT_TRUE(square && wide);
    EXPECT_LT(glm::distance(mapped(*square, {25, 75}), mapped(*wide, {125, 75})), 1e-9);
}

TEST(PhotoInView, a_first_fit_frames_what_is_drawn_and_leaves_the_photo_where_it_is) {
    constexpr glm::ivec2 size{400, 300}, view{256, 256};
    const PhotoFit flat = first_fit(true, Camera{}, size);
    // The quad spans ±1 at distance 4.5 under 30°: ±1/(4.5·tan 15°) of the half picture.
    const float half = 0.5f / (4.5f * std::tan(0.2617994f));
    EXPECT_NEAR(flat.view[0].x, 0.5f - half, 1e-4f);
    EXPECT_NEAR(flat.view[2].y, 0.5f + half, 1e-4f);
    const PhotoFit round = first_fit(false, Camera{}, size);
    EXPECT_LT(round.view[0].x, flat.view[0].x);  // the sphere's outline is nearer than its middle
    EXPECT_GT(round.view[0].x, flat.view[0].x - 0.02f);
    const auto unfitted = view_to_photo({.file = "a.png"}, size, view);
    for (const bool is_flat : {true, false}) {
        const Photo photo{.file = "a.png", .fit = first_fit(is_flat, Camera{.yaw_deg = 20.0f}, size)};
        const auto fitted = view_to_photo(photo, size, view);
        ASSERT_TRUE(fitted && unfitted);
        for (const glm::dvec2 at : {glm::dvec2{0, 0}, {256, 0}, {40, 200}, {128, 128}})
            EXPECT_LT(glm::distance(mapped(*fitted, at), mapped(*unfitted, at)), 0.01);
    }
}

}  // namespace
}  // namespace patina
