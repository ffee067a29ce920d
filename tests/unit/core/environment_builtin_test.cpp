#include "renderer/core/builtin_env.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

namespace patina {
namespace {

constexpr double kPi = std::numbers::pi;

const BuiltinEnvironment& builtin(std::string_view id) {
    const auto all = builtin_environments();
    return *std::find_if(all.begin(), all.end(), [&](const BuiltinEnvironment& row) { return row.id == id; });
}

/// Made once for all tests.
const Environment& made(std::string_view id, int width = kBuiltinEnvironmentWidth) {
    static std::map<std::pair<std::string_view, int>, Environment> all;
    const auto [at, missing] = all.try_emplace({builtin(id).id, width});
    if (missing) at->second = builtin(id).make(width);
    return at->second;
}
constexpr int kSmall = 37;

glm::vec3 seen(const Environment& environment, glm::vec3 direction) {
    const glm::vec2 uv = direction_to_equirect(glm::normalize(direction));
    const int x =
        std::min(static_cast<int>(uv.x * static_cast<float>(environment.width)), environment.width - 1);
    const int y =
        std::min(static_cast<int>(uv.y * static_cast<float>(environment.height)), environment.height - 1);
    return environment.radiance[static_cast<std::size_t>(y) * environment.width + x];
}

float brightest(const Environment& environment) {
    float most = 0.0f;
    for (const glm::vec3& texel : environment.radiance) most = std::max({most, texel.x, texel.y, texel.z});
    return most;
}

float mean(const Environment& environment) {
    const glm::dvec3 mean = total_energy(environment) / (4.0 * kPi);
    return static_cast<float>((mean.x + mean.y + mean.z) / 3.0);
}

TEST(BuiltinEnvironments, come_in_the_order_shown_with_a_sentence_each) {
    std::string ids;
    for (const BuiltinEnvironment& row : builtin_environments()) {
        ids += std::string(row.id) + " ";
        EXPECT_FALSE(row.title.empty());
        EXPECT_EQ(row.description.back(), '.');
    }
    EXPECT_EQ(ids, "studio sky sunset overcast night furnace test ");
}

TEST(BuiltinEnvironments, are_finite_positive_of_the_promised_size_and_carry_their_hash) {
    for (const BuiltinEnvironment& row : builtin_environments())
        for (const int width : {kSmall, 1}) {
            const Environment& environment = made(row.id, width);
            EXPECT_EQ(environment.id, row.id);
            EXPECT_EQ(environment.title, row.title);
            EXPECT_EQ(environment.width, std::max(width, 2));
            EXPECT_EQ(environment.height, std::max(width, 2) / 2);
            ASSERT_EQ(environment.radiance.size(),
                      static_cast<std::size_t>(environment.width) * environment.height);
            EXPECT_EQ(environment.content_hash, environment_hash(environment));
            EXPECT_TRUE(std::all_of(environment.radiance.begin(), environment.radiance.end(),
                                    [](const glm::vec3& texel) {
                                        const float least = std::min({texel.x, texel.y, texel.z});
                                        return least >= 0.0f && std::isfinite(texel.x + texel.y + texel.z);
                                    }))
                << row.id;
        }
}

TEST(BuiltinEnvironments, are_the_same_on_every_run_and_differ_from_one_another) {
    std::map<std::uint64_t, std::string_view> hashes;
    for (const BuiltinEnvironment& row : builtin_environments()) {
        const Environment& environment = made(row.id, kSmall);
        EXPECT_EQ(environment.content_hash, row.make(kSmall).content_hash);
        EXPECT_TRUE(hashes.emplace(environment.content_hash, row.id).second) << row.id;
    }
}

TEST(BuiltinEnvironments, have_changed_if_this_fails_then_raise_the_environment_version) {
    ASSERT_EQ(kEnvironmentVersion, 1);  // of these sums
    const std::map<std::string_view, double> sums{
        {"studio", 546.3069}, {"sky", 826.0110},      {"sunset", 691.0366}, {"overcast", 978.6907},
        {"night", 214.2769},  {"furnace", 1301.8611}, {"test", 701.3670}};
    for (const BuiltinEnvironment& row : builtin_environments()) {
        double sum = 0.0;
        std::size_t i = 0;
        for (const glm::vec3& texel : made(row.id, kSmall).radiance)
            sum += (1.0 + std::cos(0.37 * double(i++))) *
                   std::log1p(double(texel.x) + 2.0 * double(texel.y) + 3.0 * double(texel.z));
        EXPECT_NEAR(sum, sums.at(row.id), 1e-5 * sum) << row.id;
    }
}

void expect_same_energy(const std::vector<int>& widths) {
    for (const BuiltinEnvironment& row : builtin_environments()) {
        const glm::dvec3 reference = total_energy(made(row.id));
        for (const int width : widths) {
            const glm::dvec3 energy = total_energy(made(row.id, width));
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(energy[c] / reference[c], 1.0, 0.005) << row.id << " " << width;
        }
    }
}

TEST(BuiltinEnvironments, hold_the_same_energy_when_small) { expect_same_energy({kSmall}); }

TEST(SlowBuiltinEnvironments, hold_the_same_energy_at_every_width) {
    expect_same_energy({64, 333, 512, 699, 700, 1500, 3000});
}

TEST(BuiltinEnvironments, are_exposed_for_0_ev) {
    for (const BuiltinEnvironment& row : builtin_environments()) {
        const float brightness = mean(made(row.id));
        EXPECT_GT(brightness, 0.3f) << row.id;
        EXPECT_LT(brightness, 1.01f) << row.id;
    }
}

TEST(BuiltinEnvironments, dynamic_range_is_what_each_is_for) {
    const auto range = [](std::string_view id) {
        const Environment& environment = made(id);
        return brightest(environment) / mean(environment);
    };
    EXPECT_GT(range("studio"), 100.0f);
    EXPECT_LT(range("studio"), 1000.0f);
    EXPECT_GT(range("sky"), 1e4f);
    EXPECT_GT(range("night"), 1000.0f);
    EXPECT_LT(range("overcast"), 3.0f);
    EXPECT_EQ(range("furnace"), 1.0f);
}

TEST(BuiltinEnvironments, furnace_is_one_everywhere) {
    for (const glm::vec3& texel : made("furnace").radiance) EXPECT_EQ(texel, glm::vec3(1.0f));
}

TEST(BuiltinEnvironments, overcast_is_three_times_brighter_above_than_at_the_horizon) {
    const Environment& environment = made("overcast");
    const float above = seen(environment, {0.0f, 1.0f, 0.0f}).y;
    EXPECT_NEAR(seen(environment, {1.0f, 0.002f, 0.0f}).y / above, 1.0f / 3.0f, 0.01f);
    EXPECT_NEAR(seen(environment, {0.0f, 0.5f, 0.8660254f}).y / above, 2.0f / 3.0f, 0.01f);
    EXPECT_GT(seen(environment, {0.0f, -1.0f, 0.0f}).y, 0.1f * above) << "the ground is not black";
}

TEST(BuiltinEnvironments, night_lamps_have_different_colours) {
    const Environment& environment = made("night");
    const glm::vec3 red = seen(environment, {5.0f, 0.3f, -1.3f});
    const glm::vec3 cyan = seen(environment, {3.6f, 1.2f, -3.4f});
    const glm::vec3 sodium = seen(environment, {-4.2f, 3.0f, -4.4f});
    EXPECT_GT(red.x, 5.0f * red.z);
    EXPECT_GT(cyan.z, 5.0f * cyan.x);
    EXPECT_GT(sodium.x, 5.0f * sodium.z);
    EXPECT_GT(sodium.x, 100.0f);
}

// --- the labelled directions ---

TEST(BuiltinEnvironments, test_directions_have_their_colours) {
    const Environment& environment = made("test");
    // Beside the grid lines, outside the plates.
    const auto at = [&](glm::vec3 axis, glm::vec3 aside) { return seen(environment, axis + 0.72f * aside); };
    const glm::vec3 tilt(0.05f, 0.06f, 0.07f);
    const glm::vec3 plus_x = at({1, 0, 0}, tilt + glm::vec3(0, 1, 0));
    const glm::vec3 minus_x = at({-1, 0, 0}, tilt + glm::vec3(0, 1, 0));
    const glm::vec3 plus_y = at({0, 1, 0}, tilt + glm::vec3(1, 0, 0));
    const glm::vec3 minus_y = at({0, -1, 0}, tilt + glm::vec3(1, 0, 0));
    const glm::vec3 plus_z = at({0, 0, 1}, tilt + glm::vec3(0, 1, 0));
    const glm::vec3 minus_z = at({0, 0, -1}, tilt + glm::vec3(0, 1, 0));
    EXPECT_TRUE(plus_x.x > 2 * plus_x.y && plus_x.x > 2 * plus_x.z) << "+X red";
    EXPECT_TRUE(minus_x.x < minus_x.y && minus_x.x < minus_x.z) << "-X cyan";
    EXPECT_TRUE(plus_y.y > 2 * plus_y.x && plus_y.y > 2 * plus_y.z) << "+Y green";
    EXPECT_TRUE(minus_y.y < minus_y.x && minus_y.y < minus_y.z) << "-Y magenta";
    EXPECT_TRUE(plus_z.z > 2 * plus_z.x && plus_z.z > 2 * plus_z.y) << "+Z blue";
    EXPECT_TRUE(minus_z.z < minus_z.x && minus_z.z < minus_z.y) << "-Z yellow";
}

/// What one sees looking along forward: rows top to bottom, '#' where the label is white.
std::string label_picture(const Environment& environment, glm::vec3 forward, glm::vec3 up) {
    const glm::vec3 right = glm::cross(forward, up);
    std::string picture;
    for (float y = 0.2f; y > -0.21f; y -= 0.1f) {
        for (float x = -0.36f; x < 0.37f; x += 0.08f)
            picture += seen(environment, forward + x * right + y * up).y > 1.5f ? '#' : '.';
        picture += '\n';
    }
    return picture;
}

TEST(BuiltinEnvironments, test_labels_read_upright_and_unmirrored_from_inside) {
    const Environment& environment = made("test");
    const std::string plus_z = label_picture(environment, {0, 0, 1}, {0, 1, 0});
    const std::string minus_z = label_picture(environment, {0, 0, -1}, {0, 1, 0});
    // Z, unlike its mirror image, has its stroke from the lower left to the upper right.
    const auto cell = [](const std::string& picture, int row, int column) {
        return picture[row * 11 + column];
    };
    for (const std::string& picture : {plus_z, minus_z}) {
        EXPECT_EQ(cell(picture, 1, 8), '#') << picture;
        EXPECT_EQ(cell(picture, 3, 6), '#') << picture;
        EXPECT_EQ(cell(picture, 1, 6), '.') << picture;
        EXPECT_EQ(cell(picture, 3, 8), '.') << picture;
    }
    // Y has its fork above.
    for (const auto& [forward, up] : {std::pair(glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)),
                                      std::pair(glm::vec3(0, -1, 0), glm::vec3(0, 0, -1))}) {
        const std::string picture = label_picture(environment, forward, up);
        EXPECT_EQ(cell(picture, 0, 5), '#') << picture;
        EXPECT_EQ(cell(picture, 0, 9), '#') << picture;
        EXPECT_EQ(cell(picture, 4, 7), '#') << picture;
        EXPECT_EQ(cell(picture, 4, 5), '.') << picture;
    }
    // A plus has an upright stroke, a minus has not; the sign stands to the left.
    for (const glm::vec3 axis : {glm::vec3(1, 0, 0), glm::vec3(0, 0, 1)}) {
        const std::string plus = label_picture(environment, axis, {0, 1, 0});
        const std::string minus = label_picture(environment, -axis, {0, 1, 0});
        EXPECT_EQ(cell(plus, 2, 0), '#') << plus;
        EXPECT_EQ(cell(minus, 2, 0), '#') << minus;
        EXPECT_NE(plus, minus);
    }
}

// --- round lights ---

TEST(Disc, has_exact_energy_at_every_width_and_place) {
    for (const int width : {2, 7, 64, 1000})
        for (const glm::vec3 direction :
             {glm::vec3(0, 1, 0), glm::vec3(0, -1, 0), glm::vec3(0, 0, 1), glm::vec3(0, 0, -1),
              glm::vec3(0.3f, 0.9f, -0.1f), glm::vec3(-0.001f, 1.0f, 0.001f)})
            for (const float radius : {0.0005f, 0.0046f, 0.1f}) {
                Environment environment{.width = width, .height = width / 2};
                environment.radiance.resize(static_cast<std::size_t>(environment.width) * environment.height);
                add_disc(environment, {.direction = glm::normalize(direction),
                                       .angular_radius = radius,
                                       .radiance = {3.0f, 2.0f, 1.0f},
                                       .limb_darkening = 0.6f});
                const double expected = 3.0 * 2.0 * kPi * (1.0 - std::cos(static_cast<double>(radius)));
                EXPECT_NEAR(total_energy(environment).x / expected, 1.0, 1e-5) << width << " " << radius;
            }
}

TEST(Disc, sits_where_it_points_and_nowhere_else) {
    Environment environment{.width = 1024, .height = 512};
    environment.radiance.resize(1024 * 512);
    const glm::vec3 direction = glm::normalize(glm::vec3(-0.5f, 0.6f, 0.62f));
    add_disc(environment, {.direction = direction, .angular_radius = 0.03f, .radiance = glm::vec3(1.0f)});
    glm::dvec3 centroid(0.0);
    for (int y = 0; y < 512; ++y)
        for (int x = 0; x < 1024; ++x) {
            const glm::vec3 d = equirect_to_direction((glm::vec2(x, y) + 0.5f) / glm::vec2(1024.0f, 512.0f));
            const double energy = environment.radiance[static_cast<std::size_t>(y) * 1024 + x].x *
                                  texel_solid_angle(environment, y);
            centroid += energy * glm::dvec3(d);
            if (glm::length(d - direction) > 0.04f) {
                ASSERT_EQ(energy, 0.0);
            }
        }
    EXPECT_LT(glm::length(glm::normalize(centroid) - glm::dvec3(direction)), 2e-4);
    EXPECT_NEAR(seen(environment, direction).x, 1.0f, 0.01f);
}

}  // namespace
}  // namespace patina
