// The measurement of run time against error: that it measures what it says.
#include "renderer/ibl/bench.h"

#include "renderer/ibl/panorama.h"
#include "renderer/ibl/reference.h"
#include "renderer/ibl/sampling.h"
#include "tests/unit/ibl/oracle.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace patina {
namespace {

using namespace test;

TEST(IblBench, measures_every_method_at_every_roughness) {
    const Environment environment = noise_panorama(64, 32, 7);
    IblBenchOptions options;
    options.roughness = {0.4f, 1.0f};
    options.bands = {8, 64};
    options.samples = {16, 256};
    options.direct_widths = {64};
    options.repetitions = 1;
    options.error_texels = 6;
    const auto result = ibl_bench(environment, options, {});
    ASSERT_TRUE(result);
    EXPECT_EQ(result->levels.size(), 2u * (1 + 2 + 2 + 1 + 1));
    const auto error = [&](const std::string& method, float roughness) {
        for (const IblBenchLevel& level : result->levels)
            if (level.method == method && level.roughness == roughness) return level.rms;
        ADD_FAILURE() << method << " is missing";
        return 0.0;
    };
    for (const float r : options.roughness) {
        EXPECT_LE(error("transform", r), 1e-3);
        EXPECT_LE(error("transform 64", r), 2e-3);
        EXPECT_LE(error("direct 64", r), 0.01);
        EXPECT_LE(error("first light", r), 0.01);
    }
    EXPECT_GT(error("transform 8", 0.4f), 2.0 * error("transform 64", 0.4f));
    EXPECT_GT(error("sampling 16", 0.4f), error("transform", 0.4f));
    EXPECT_TRUE(std::ranges::any_of(result->levels, &IblBenchLevel::on_front));
}

TEST(IblBench, fetch_errors_fall_with_the_size_of_the_faces) {
    const auto errors =
        ibl_fetch_errors(sunny_panorama(128, 64, 100.0, 0.1), {0.2f}, {16, 32, 64}, serial_for);
    ASSERT_EQ(errors.size(), 3u);
    EXPECT_GT(errors[0].rms, 2.0 * errors[1].rms);
    EXPECT_GT(errors[1].rms, 2.0 * errors[2].rms);
}

TEST(IblBench, resizing_keeps_the_light) {
    const Environment environment = noise_panorama(48, 24, 2);
    for (const int width : {16, 96}) {
        const Environment resized = ibl_resized(environment, width);
        EXPECT_EQ(resized.width, width);
        EXPECT_EQ(resized.height, width / 2);
        EXPECT_NEAR(mean_radiance(resized).y / mean_radiance(environment).y, 1.0, 0.01);
    }
}

TEST(Sampling, in_some_directions_is_what_a_whole_level_holds) {
    const Environment environment = noise_panorama(32, 16, 5);
    const CubePyramid source(environment, 16, serial_for);
    const CubeMap level = prefilter_by_sampling(source, 0.5f, 32, 8, {});
    const std::vector<glm::vec3> some =
        sample_prefiltered(source, 0.5f, 32, {cube_texel_direction(8, 3, 2, 5)}, {});
    EXPECT_EQ(some[0], level.texels[(3 * 8 + 5) * 8 + 2]);
}

TEST(FirstLight, of_a_large_picture_reads_some_rows_only) {
    // 1024 rows: every other one is looked at, so what the others hold does not matter.
    Environment environment = constant_panorama(4, 1024, glm::vec3(2.0f));
    for (int y = 0; y < 1024; y += 2)
        for (int x = 0; x < 4; ++x) environment.radiance[std::size_t(y) * 4 + x] = glm::vec3(5.0f);
    const auto first = bake_first_light(environment, {}, {});
    ASSERT_TRUE(first);
    EXPECT_NEAR(first->irradiance.texels[0].y, 2.0f, 1e-4f);
}

}  // namespace
}  // namespace patina
