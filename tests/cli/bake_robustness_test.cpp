// Pictures as they come: suns, broken texels, odd sizes, every compression of OpenEXR. What is repaired is
// counted, what comes out is right.
#include "renderer/core/image_io.h"
#include "tests/cli/program.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace patina {
namespace {

using test::Outcome;
using test::Workspace;

Image filled(int width, int height, float value) {
    Image image = make_image(width, height, 3, PixelType::F32);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) set_texel(image, x, y, c, value);
    return image;
}

struct Extent {
    float lowest = std::numeric_limits<float>::infinity(), highest = 0.0f;
};
/// Of a face strip; fails on what is not finite.
Extent extent(const Workspace& work, const std::string& file) {
    const Image strip = load_image(work.folder() / "out" / file).image;
    Extent e;
    for (int y = 0; y < strip.height; ++y)
        for (int x = 0; x < strip.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const float value = texel(strip, x, y, c);
                EXPECT_TRUE(std::isfinite(value)) << file;
                e.lowest = std::min(e.lowest, value);
                e.highest = std::max(e.highest, value);
            }
    return e;
}

Outcome bake(const Workspace& work, const std::string& picture) {
    Outcome outcome =
        work.run({"bake", picture, "-o", "out", "--levels", "0.3,1", "--size", "16", "--keep-lights"});
    EXPECT_EQ(outcome.exit_status, 0) << outcome.errors;
    return outcome;
}

TEST(BakeRobustness, a_sun_a_million_times_brighter_is_finite_and_right) {
    const Workspace work;
    Image sky = filled(64, 32, 1.0f);
    for (int c = 0; c < 3; ++c) set_texel(sky, 40, 16, c, 1e6f);
    save_image(work.folder() / "sun.exr", sky);
    bake(work, "sun.exr");
    // E/π towards the sun, which stands next to the horizon: the sky's 1 and its solid angle · 1e6/π.
    constexpr double pi = std::numbers::pi;
    const double area = 2.0 * pi / 64 * (std::cos(16 * pi / 32) - std::cos(17 * pi / 32));
    const Extent irradiance = extent(work, "irradiance.exr");
    EXPECT_NEAR(irradiance.highest / (1.0 + 1e6 * area / pi), 1.0, 0.01);
    EXPECT_GE(irradiance.lowest, 0.99f);
}

TEST(BakeRobustness, broken_texels_are_counted_and_leave_the_rest_right) {
    const Workspace work;
    Image sky = filled(64, 32, 1.0f);
    set_texel(sky, 3, 4, 0, std::numeric_limits<float>::quiet_NaN());
    set_texel(sky, 5, 6, 1, std::numeric_limits<float>::infinity());
    set_texel(sky, 7, 8, 2, -2.0f);
    set_texel(sky, 9, 8, 2, -3.0f);
    save_image(work.folder() / "broken.exr", sky);
    const std::string notes = bake(work, "broken.exr").errors;
    EXPECT_NE(notes.find("1 NaN"), std::string::npos) << notes;
    EXPECT_NE(notes.find("2 negative"), std::string::npos) << notes;
    EXPECT_NE(notes.find("infinit"), std::string::npos) << notes;
    const Extent level = extent(work, "level_01.exr");
    EXPECT_GT(level.lowest, 0.95f);
    EXPECT_LT(level.highest, 1.05f);
}

TEST(BakeRobustness, any_size_is_a_whole_panorama) {
    for (const auto& [width, height] : {std::pair{1, 1}, {2, 1}, {1023, 512}, {1000, 600}}) {
        const Workspace work;
        save_image(work.folder() / "odd.exr", filled(width, height, 0.5f));
        const Outcome outcome = bake(work, "odd.exr");
        for (const char* file : {"level_00.exr", "level_01.exr", "irradiance.exr"}) {
            const Extent e = extent(work, file);
            EXPECT_NEAR(e.lowest, 0.5f, 1e-5f) << width << 'x' << height;
            EXPECT_NEAR(e.highest, 0.5f, 1e-5f) << width << 'x' << height;
        }
        if (width != 2 * height) {
            EXPECT_NE(outcome.errors.find(std::to_string(width)), std::string::npos) << outcome.errors;
        }
    }
}

TEST(BakeRobustness, every_compression_of_openexr_is_read) {
    const int width = 64, height = 32;
    std::vector<float> pixels;
    for (int i = 0; i < width * height; ++i)  // bright above, dark below
        for (int c = 0; c < 3; ++c) pixels.push_back(i < width * height / 2 ? 2.0f + 0.5f * float(c) : 0.25f);
    for (const char* compression :
         {"none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"}) {
        const Workspace work;
        const std::string file = work.path("sky.exr");
        OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::HALF);
        spec.attribute("compression", compression);
        const auto out = OIIO::ImageOutput::create(file);
        ASSERT_TRUE(out && out->open(file, spec)) << compression;
        ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, pixels.data())) << compression;
        ASSERT_TRUE(out->close());
        bake(work, "sky.exr");
        const Extent irradiance = extent(work, "irradiance.exr");  // straight up in blue, straight down
        EXPECT_NEAR(irradiance.highest, 3.0f, 0.05f) << compression;
        EXPECT_NEAR(irradiance.lowest, 0.25f, 0.02f) << compression;
    }
}

}  // namespace
}  // namespace patina
