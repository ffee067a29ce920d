#include "renderer/core/flip.h"

#include "renderer/core/metrics.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

namespace patina {
namespace {

Image picture(int size, const std::function<std::array<float, 3>(int x, int y)>& color) {
    Image image = make_image(size, size, 3, PixelType::F32);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            for (int c = 0; c < 3; ++c) set_texel(image, x, y, c, color(x, y)[std::size_t(c)]);
    return image;
}
Image plain(float r, float g, float b, int size = 24) {
    return picture(size, [&](int, int) { return std::array{r, g, b}; });
}
Image scaled(const Image& image, float factor) {
    return picture(image.width, [&](int x, int y) {
        return std::array{factor * texel(image, x, y, 0), factor * texel(image, x, y, 1),
                          factor * texel(image, x, y, 2)};
    });
}
/// A slope with a bright square.
Image scene() {
    return picture(32, [](int x, int y) {
        const float base = 0.2f + 0.01f * float(x);
        return x > 12 && x < 18 && y > 9 && y < 20 ? std::array{6.0f, 5.0f, 3.0f}
                                                   : std::array{base, 0.3f, 0.5f - 0.01f * float(y)};
    });
}

TEST(Flip, is_nothing_for_equal_pictures) {
    EXPECT_EQ(mean_value(flip(plain(0.3f, 0.5f, 0.1f), plain(0.3f, 0.5f, 0.1f))), 0.0);
    EXPECT_EQ(mean_value(hdr_flip(scene(), scene())), 0.0);
}

TEST(Flip, is_largest_between_the_extremes_of_the_display) {
    // By its definition the distance of pure green from pure blue is 1.
    EXPECT_NEAR(mean_value(flip(plain(0, 1, 0), plain(0, 0, 1))), 1.0, 5e-3);
    // Black and white lie at 100^0.7 of the scale on which that pair lies at its end and 0.95 at 0.4 of it.
    const double end = std::pow(203.5, 0.7), at = std::pow(100.0, 0.7);
    const double expected =
        at < 0.4 * end ? 0.95 / (0.4 * end) * at : 0.95 + 0.05 * (at - 0.4 * end) / (0.6 * end);
    EXPECT_NEAR(mean_value(flip(plain(0, 0, 0), plain(1, 1, 1))), expected, 0.02);
}

TEST(Flip, is_symmetric_and_within_0_and_1) {
    const Image a = scaled(scene(), 0.15f), b = picture(32, [](int x, int y) {
                                                const float v = (x / 4 + y / 4) % 2 == 0 ? 0.9f : 0.1f;
                                                return std::array{v, 0.4f, 1.0f - v};
                                            });
    const Image ab = flip(a, b), ba = flip(b, a);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            EXPECT_NEAR(texel(ab, x, y, 0), texel(ba, x, y, 0), 1e-5f);
            EXPECT_GE(texel(ab, x, y, 0), 0.0f);
            EXPECT_LE(texel(ab, x, y, 0), 1.0f);
        }
    EXPECT_GT(mean_value(ab), 0.1);
}

TEST(Flip, grows_with_the_difference) {
    double last = 0.0;
    for (const float step : {0.01f, 0.03f, 0.1f, 0.3f}) {
        const double now = mean_value(flip(plain(0.4f, 0.4f, 0.4f), plain(0.4f + step, 0.4f, 0.4f)));
        EXPECT_GT(now, last) << step;
        last = now;
    }
}

TEST(Flip, sees_fine_patterns_less_than_coarse_ones) {
    const auto stripes = [](int width) {
        return picture(48, [width](int x, int) {
            const float v = x / width % 2 == 0 ? 0.55f : 0.45f;
            return std::array{v, v, v};
        });
    };
    const Image grey = plain(0.5f, 0.5f, 0.5f, 48);
    EXPECT_LT(mean_value(flip(grey, stripes(1), 120.0)), 0.6 * mean_value(flip(grey, stripes(12), 120.0)));
}

TEST(Flip, an_edge_weighs_more_than_the_same_difference_spread_out) {
    const Image grey = plain(0.5f, 0.5f, 0.5f, 48);
    const Image edge = picture(48, [](int x, int) {
        const float v = x < 24 ? 0.45f : 0.55f;
        return std::array{v, v, v};
    });
    const Image error = flip(grey, edge);
    EXPECT_GT(texel(error, 21, 24, 0), 1.1f * texel(error, 4, 24, 0));
}

TEST(Flip, exposures_span_from_the_brightest_to_the_median) {
    const FlipExposures exposures = flip_exposures(scene());
    EXPECT_LT(exposures.first_ev, exposures.last_ev);
    EXPECT_GE(exposures.count, 2);
    const FlipExposures brighter = flip_exposures(scaled(scene(), 8.0f));
    EXPECT_NEAR(brighter.first_ev, exposures.first_ev - 3.0, 1e-4);
    EXPECT_NEAR(brighter.last_ev, exposures.last_ev - 3.0, 1e-4);
    EXPECT_EQ(brighter.count, exposures.count);
}

TEST(Flip, of_radiance_does_not_depend_on_its_unit) {
    const Image reference = scene();
    const Image test = picture(32, [&](int x, int y) {
        return std::array{1.1f * texel(reference, x, y, 0), texel(reference, x, y, 1),
                          texel(reference, x, y, 2)};
    });
    EXPECT_NEAR(mean_value(hdr_flip(scaled(reference, 64.0f), scaled(test, 64.0f))),
                mean_value(hdr_flip(reference, test)), 2e-4);
}

TEST(Metrics, are_what_they_are_defined_as) {
    const Image reference = plain(1.0f, 2.0f, 4.0f, 4);
    Image test = reference;
    set_texel(test, 1, 1, 2, 6.0f);  // 50 % in one of 48 values
    const PictureError error = picture_error(test, reference);
    EXPECT_EQ(error.pixels, 16u);
    EXPECT_NEAR(error.rms, 0.5 / std::sqrt(48.0), 1e-6);
    EXPECT_NEAR(error.max, 0.5, 1e-6);
    EXPECT_NEAR(error.p95, 0.0, 1e-6);
    EXPECT_NEAR(texel(relative_error(test, reference), 1, 1, 0), 0.5f / 3.0f, 1e-6f);
    Image mask = make_image(4, 4, 1, PixelType::U8);
    set_texel(mask, 0, 0, 0, 1.0f);
    EXPECT_EQ(picture_error(test, reference, mask).rms, 0.0);
    EXPECT_EQ(picture_error(test, reference, mask).pixels, 1u);
}

TEST(Metrics, darkness_is_measured_against_a_thousandth_of_the_mean) {
    Image reference = plain(1.0f, 1.0f, 1.0f, 2);
    for (int c = 0; c < 3; ++c) set_texel(reference, 0, 0, c, 0.0f);
    Image test = reference;
    for (int c = 0; c < 3; ++c) set_texel(test, 0, 0, c, 7.5e-4f);
    EXPECT_NEAR(picture_error(test, reference).max, 1.0, 1e-5);
}

TEST(Metrics, the_map_gets_lighter_at_an_even_pace) {
    double last = -1.0;
    for (int i = 0; i <= 20; ++i) {
        float c[3];
        viridis(i / 20.0, c);
        const auto linear = [](float v) { return double(srgb_to_linear(v)); };
        const double Y = 0.2126 * linear(c[0]) + 0.7152 * linear(c[1]) + 0.0722 * linear(c[2]);
        const double L = 116.0 * std::cbrt(Y) - 16.0;
        if (i > 0) {
            EXPECT_GT(L - last, 2.0) << i;
            EXPECT_LT(L - last, 6.0) << i;
        }
        last = L;
    }
    const Image values = plain(0.0f, 0.0f, 0.0f, 2);
    EXPECT_EQ(texel(viridis_picture(values, 1.0), 0, 0, 2), texel(viridis_picture(values, 0.5), 0, 0, 2));
}

TEST(DifferencePicture, is_grey_where_nothing_differs_and_tells_darker_from_brighter) {
    Image reference = make_image(8, 8, 3, PixelType::F32), test = reference;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            for (int c = 0; c < 3; ++c) {
                set_texel(reference, x, y, c, 0.5f);
                set_texel(test, x, y, c, x < 2 ? 0.1f : x > 5 ? 0.9f : 0.5f);
            }
    EXPECT_NEAR(texel(signed_difference(test, reference), 0, 0, 0), -0.4f, 1e-6f);
    const Image map = difference_picture(test, reference, DifferenceKind::Signed);
    EXPECT_GT(texel(map, 0, 4, 2), texel(map, 0, 4, 0) + 0.3f) << "darker is blue";
    EXPECT_GT(texel(map, 7, 4, 0), texel(map, 7, 4, 2) + 0.3f) << "brighter is red";
    EXPECT_EQ(texel(map, 4, 4, 0), texel(map, 4, 4, 2)) << "equal is grey";
    const Image relative = difference_picture(test, reference, DifferenceKind::Relative);
    EXPECT_GT(texel(relative, 0, 4, 1), texel(relative, 4, 4, 1) + 0.3f);
    const Image seen = difference_picture(test, reference, DifferenceKind::Flip);
    EXPECT_GT(texel(seen, 0, 4, 1), texel(seen, 4, 4, 1));
}

}  // namespace
}  // namespace patina
