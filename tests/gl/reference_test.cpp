// The reference picture against the double-precision sum over texels, and how it gathers, stops and begins
// anew.
#include "renderer/reference.h"

#include "renderer/gl/reference.h"
#include "renderer/ibl/reflection.h"
#include "tests/gl/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <vector>

namespace patina {
namespace {

using namespace test;

/// A square that fills the picture and is shaded as if its normal were N.
MeshHandle facing(glm::vec3 N) {
    Mesh mesh;
    for (const glm::vec2 corner : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
        mesh.vertices.push_back({.position = {2.0f * corner, 0.0f}, .normal = N, .uv = corner});
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return renderer().upload_mesh(mesh);
}

EnvironmentHandle only_panorama(const Environment& environment) {
    return renderer().upload_environment(environment,
                                         make_baked([](glm::vec3, float) { return glm::vec3(0.0f); }, 8));
}

/// A dark room, a coloured sky, a softbox and a small lamp. Values that half floats hold exactly.
Environment lit_room(int width) {
    Environment environment = make_panorama(
        [](glm::vec3 d) {
            if (glm::dot(d, glm::normalize(glm::vec3(2.0f, 1.0f, 1.5f))) > 0.95f) return glm::vec3(12.0f);
            if (d.y > 0.1f) return glm::vec3(0.25f, 0.375f, 0.75f);
            return glm::vec3(0.125f, 0.0625f, 0.03125f);
        },
        width);
    environment.radiance[std::size_t(environment.height / 4) * width + width / 3] = {512.0f, 384.0f, 256.0f};
    return environment;
}

struct Configuration {
    glm::vec3 N{0.0f, 0.0f, 1.0f};
    Material material;
    float rotation_deg = 0.0f;
};

Configuration random_configuration(std::mt19937& random) {
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    Configuration c;
    const float cosine = 0.03f + 0.97f * unit(random), turn = 6.2831853f * unit(random);
    const float sine = std::sqrt(1.0f - cosine * cosine);
    c.N = {sine * std::cos(turn), sine * std::sin(turn), cosine};
    c.material.roughness.value = 0.05f + 0.95f * unit(random);
    c.material.metallic.value = unit(random) < 0.4f ? 1.0f : unit(random) < 0.5f ? 0.0f : unit(random);
    for (int i = 0; i < 3; ++i) c.material.albedo.value[i] = 0.02f + 0.98f * unit(random);
    c.rotation_deg = 360.0f * unit(random);
    return c;
}

struct Estimate {
    glm::vec3 radiance{0.0f};
    ConfidenceInterval known;
};
Estimate sampled(const Configuration& c, const EnvironmentHandle& light, int samples) {
    Scene scene = make_scene(light, facing(c.N));
    scene.material = c.material;
    scene.view.env_rotation_deg = c.rotation_deg;
    Reference reference(renderer(), {1, 1},
                        {.max_samples = samples, .tolerance = 0.0, .pixel_filter = false});
    reference.restart(scene);
    reference.finish();
    const TargetHandle target = renderer().make_target({1, 1}, 1, TargetPrecision::Full);
    reference.write(*target);
    return {pixel(renderer().read_radiance(*target), 0, 0), *reference.progress().confidence};
}

glm::dvec3 exact(const Configuration& c, const Environment& environment) {
    // What the environment turns by, N and V turn back.
    const double angle = glm::radians(double(c.rotation_deg));
    const auto turned = [&](glm::dvec3 d) {
        return glm::dvec3(std::cos(angle) * d.x - std::sin(angle) * d.z, d.y,
                          std::sin(angle) * d.x + std::cos(angle) * d.z);
    };
    const Material& m = c.material;
    return ReflectionReference(environment)
        .radiance(turned(glm::normalize(glm::dvec3(c.N))), turned({0.0, 0.0, 1.0}),
                  {glm::dvec3(m.albedo.value), double(m.metallic.value), double(m.roughness.value)});
}

double mean_of(glm::dvec3 c) { return (c.x + c.y + c.z) / 3.0; }

/// Errors relative to the truth of count random configurations; each within what its own interval allows.
std::vector<double> errors_of(int count, int samples) {
    const Environment environment = lit_room(64);
    const EnvironmentHandle light = only_panorama(environment);
    std::mt19937 random(20);
    std::vector<double> errors;
    for (int i = 0; i < count; ++i) {
        const Configuration c = random_configuration(random);
        const Estimate estimate = sampled(c, light, samples);
        const glm::dvec3 truth = exact(c, environment);
        const double error = mean_of(glm::dvec3(estimate.radiance)) / mean_of(truth) - 1.0;
        errors.push_back(error);
        // Three 95 % intervals of seven degrees of freedom are passed once in 10 000; the table adds 0.1 %.
        EXPECT_LT(std::abs(error), 3.0 * estimate.known.max + 1e-3)
            << i << ": roughness " << c.material.roughness.value << " metallic " << c.material.metallic.value
            << " NoV " << c.N.z;
    }
    return errors;
}

double rms_of(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double each : values) sum += each * each;
    return std::sqrt(sum / double(values.size()));
}

TEST(Reference, agrees_with_the_double_precision_sum) { EXPECT_LT(rms_of(errors_of(16, 16384)), 2e-3); }

TEST(SlowReference, agrees_with_the_double_precision_sum_on_500_configurations) {
    const std::vector<double> errors = errors_of(500, 65536);
    double mean = 0.0;
    for (const double each : errors) mean += each / double(errors.size());
    std::printf("mean %.5f %%, rms %.5f %%\n", 100.0 * mean, 100.0 * rms_of(errors));
    EXPECT_LT(rms_of(errors), 1e-3);
    EXPECT_LT(std::abs(mean), 1e-4 + 3.0 * rms_of(errors) / std::sqrt(double(errors.size())));
}

/// A ball of few triangles, which is what a software renderer is slow at.
MeshHandle coarse_ball() {
    constexpr int rows = 12, columns = 24;
    Mesh mesh;
    for (int y = 0; y <= rows; ++y)
        for (int x = 0; x <= columns; ++x) {
            const float theta = float(M_PI) * float(y) / rows, phi = 2.0f * float(M_PI) * float(x) / columns;
            const glm::vec3 p{std::sin(theta) * std::sin(phi), std::cos(theta),
                              std::sin(theta) * std::cos(phi)};
            mesh.vertices.push_back({.position = p, .normal = p});
        }
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const auto at = [&](int dx, int dy) { return std::uint32_t((y + dy) * (columns + 1) + x + dx); };
            for (const std::uint32_t i : {at(0, 0), at(0, 1), at(1, 1), at(0, 0), at(1, 1), at(1, 0)})
                mesh.indices.push_back(i);
        }
    return renderer().upload_mesh(mesh);
}

Scene metal_ball(float roughness) {
    Scene scene = make_scene(constant_light(1.0f), coarse_ball());
    scene.material.albedo.value = glm::vec3(1.0f);
    scene.material.metallic.value = 1.0f;
    scene.material.roughness.value = roughness;
    return scene;
}

Image picture_of(const Scene& scene, glm::ivec2 size, const ReferenceOptions& options) {
    return renderer().read_radiance(*draw_reference(renderer(), scene, size, options));
}

TEST(Reference, a_white_ball_in_a_white_room_cannot_be_seen) {
    for (const float metallic : {0.0f, 1.0f})
        for (const float roughness : {0.0f, 0.1f, 0.4f, 1.0f}) {
            Scene scene = metal_ball(roughness);
            scene.material.metallic.value = metallic;
            const Image image = picture_of(scene, glm::ivec2(24), {.max_samples = 2048, .tolerance = 0.0});
            double sum = 0.0;
            for (int y = 0; y < 24; ++y)
                for (int x = 0; x < 24; ++x) {
                    sum += double(texel(image, x, y, 1)) / (24 * 24);
                    EXPECT_NEAR(texel(image, x, y, 1), 1.0f, 0.03f) << roughness << " at " << x << ", " << y;
                }
            EXPECT_NEAR(sum, 1.0, 2e-3) << roughness << " metallic " << metallic;
        }
}

TEST(Reference, gives_the_same_bytes_twice) {
    Scene scene = metal_ball(0.3f);
    scene.environment = only_panorama(lit_room(64));
    const ReferenceOptions options{.max_samples = 64, .tolerance = 0.0};
    EXPECT_EQ(picture_of(scene, {40, 24}, options).bytes, picture_of(scene, {40, 24}, options).bytes);
}

ReferenceEstimates estimates_of(const Scene& scene, const ReferenceOptions& options) {
    Reference reference(renderer(), glm::ivec2(24), options);
    reference.restart(scene);
    reference.finish();
    return reference.estimates();
}

/// Of the pixels of several pictures, those whose own interval holds the truth.
double share_known_as_stated(const Scene& scene, ReferenceOptions options) {
    const ReferenceEstimates truth =
        estimates_of(scene, {.max_samples = 32768, .tolerance = 0.0, .seed = 1000});
    int within = 0, all = 0;
    for (options.seed = 1; options.seed <= 6; ++options.seed) {
        const ReferenceEstimates found = estimates_of(scene, options);
        for (std::size_t i = 0; i < found.mean.size(); ++i) {
            if (found.half_width[i] < 0.0f || !(truth.mean[i] > 0.0f)) continue;
            within += std::abs(found.mean[i] / truth.mean[i] - 1.0f) <= found.half_width[i];
            ++all;
        }
    }
    std::printf("%d points at most, to %g: %.4f\n", options.max_samples, options.tolerance,
                double(within) / all);
    return double(within) / all;
}

TEST(Reference, pixels_are_as_far_from_the_truth_as_it_says) {
    Scene scene = metal_ball(0.1f);  // of flat triangles whose edges and mirrored lamps divide pixels
    scene.environment = only_panorama(lit_room(64));
    for (const int samples : {512, 1536, 2048}) {
        EXPECT_GT(share_known_as_stated(scene, {.max_samples = samples, .tolerance = 0.0}), 0.95) << samples;
    }
    scene.material.roughness.value = 0.4f;
    EXPECT_GT(share_known_as_stated(scene, {.max_samples = 512, .tolerance = 0.0}), 0.95);
}

TEST(Reference, pixels_that_rest_are_as_far_from_the_truth_as_it_says) {
    // It looks again and again, and stops where it looks well: what it says then is to hold, too.
    Scene scene = metal_ball(0.2f);
    scene.environment = only_panorama(lit_room(64));
    for (const double tolerance : {0.05, 0.02})
        EXPECT_GT(share_known_as_stated(scene, {.max_samples = 16384, .tolerance = tolerance}), 0.945)
            << tolerance;
}

TEST(Reference, draws_from_the_lamp_that_is_mirrored) {
    // A dozen lamps all around, each of which dazzles a part of the ball.
    const Environment lamps = make_panorama(
        [](glm::vec3 d) {
            const float turn = std::atan2(d.x, d.z) * 6.0f / float(M_PI);
            return glm::vec3(std::abs(turn - std::round(turn)) < 0.12f && std::abs(d.y) < 0.5f ? 16.0f
                                                                                               : 0.125f);
        },
        128);
    Scene scene = metal_ball(0.25f);
    scene.environment = only_panorama(lamps);
    Reference reference(renderer(), glm::ivec2(24), {.max_samples = 256, .tolerance = 0.0});
    reference.restart(scene);
    reference.finish();
    EXPECT_LT(reference.progress().confidence->median, 0.17);  // 0.126; drawn from all alike 0.235
}

TEST(Reference, edges_are_covered_by_their_share) {
    Scene scene = make_scene(nullptr, sphere());
    scene.material.emission.value = glm::vec3(1.0f);
    scene.view.plain_color = glm::vec3(0.0f);
    const Image image = picture_of(scene, glm::ivec2(48), {.max_samples = 256, .tolerance = 0.0});
    double area = 0.0;
    int partly = 0;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 48; ++x) {
            const double v = double(texel(image, x, y, 0));
            area += v;
            partly += v > 0.01 && v < 0.99;
        }
    // The silhouette of the unit sphere from 4.5 away under a vertical field of view of 30°.
    const double radius = 24.0 * std::tan(std::asin(1.0 / 4.5)) / std::tan(glm::radians(15.0));
    EXPECT_NEAR(area, M_PI * radius * radius, 0.005 * area);
    EXPECT_GT(partly, 60);
    EXPECT_LT(partly, 260);
}

TEST(Reference, what_is_hidden_is_not_counted) {
    // Two squares one behind the other, the far one drawn last.
    Mesh mesh;
    for (const float z : {0.2f, -0.2f})
        for (const glm::vec2 corner : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
            mesh.vertices.push_back({.position = {2.0f * corner, z}, .normal = {0.0f, 0.0f, 1.0f}});
    for (const std::uint32_t first : {4u, 0u})
        for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
    Scene scene = make_scene(nullptr, renderer().upload_mesh(mesh));
    scene.material.emission.value = glm::vec3(0.5f);
    const Image image = picture_of(scene, glm::ivec2(8), {.max_samples = 16, .tolerance = 0.0});
    EXPECT_NEAR(texel(image, 4, 4, 0), 0.5f, 1e-5f);
}

TEST(Reference, occlusion_scales_the_environment_and_emission_is_added) {
    Scene scene = make_scene(constant_light(1.0f), facing({0.0f, 0.0f, 1.0f}));
    const ReferenceOptions options{.max_samples = 1024, .tolerance = 0.0};
    const float plain = center(picture_of(scene, glm::ivec2(1), options)).x;
    scene.material.ao.value = 0.25f;
    scene.material.emission.value = glm::vec3(2.0f, 0.0f, 0.0f);
    const glm::vec3 seen = center(picture_of(scene, glm::ivec2(1), options));
    EXPECT_NEAR(seen.y, 0.25f * plain, 1e-5f);
    EXPECT_NEAR(seen.x, 0.25f * plain + 2.0f, 1e-5f);
}

TEST(Reference, stops_when_it_is_known_well_enough_and_begins_anew) {
    Scene scene = metal_ball(0.5f);
    scene.mesh = facing({0.0f, 0.6f, 0.8f});
    Reference reference(renderer(), {16, 16}, {.max_samples = 1 << 16, .tolerance = 0.02});
    reference.restart(scene);
    reference.finish();
    EXPECT_TRUE(reference.progress().converged);
    EXPECT_LT(reference.progress().samples, 1 << 16);
    EXPECT_LE(reference.progress().confidence->p95, 0.02);
    const int samples = reference.progress().samples;
    reference.draw();
    EXPECT_EQ(reference.progress().samples, samples) << "drawn although done";

    const TargetHandle target = renderer().make_target({16, 16}, 1, TargetPrecision::Full);
    reference.write(*target);
    const Image first = renderer().read_radiance(*target);
    scene.view.exposure_ev = 2.0f;
    reference.restart(scene);
    EXPECT_EQ(reference.progress().samples, 0);
    EXPECT_FALSE(reference.progress().done);
    reference.finish();
    EXPECT_EQ(reference.progress().samples, samples) << "exposure scales, it does not change the sampling";
    reference.write(*target);
    EXPECT_NEAR(texel(renderer().read_radiance(*target), 8, 8, 0), 4.0f * texel(first, 8, 8, 0), 1e-4f);
}

TEST(Reference, stops_at_its_limit) {
    Reference reference(renderer(), {8, 8}, {.max_samples = 40, .tolerance = 1e-9});
    Scene scene = metal_ball(0.5f);
    scene.environment = only_panorama(lit_room(64));
    reference.restart(scene);
    reference.finish();
    EXPECT_EQ(reference.progress().samples, 40);
    EXPECT_TRUE(reference.progress().done);
    EXPECT_FALSE(reference.progress().converged);
}

TEST(Reference, slices_that_follow_the_clock_give_the_same_integral) {
    Scene scene = metal_ball(0.4f);
    scene.environment = only_panorama(lit_room(64));
    const ReferenceOptions options{.max_samples = 256, .tolerance = 0.0, .pixel_filter = false};
    Reference reference(renderer(), {12, 12}, options);
    reference.restart(scene);
    while (!reference.progress().done) reference.draw_for(1e-4);
    EXPECT_EQ(reference.progress().samples, 256);
    const TargetHandle target = renderer().make_target({12, 12}, 1, TargetPrecision::Full);
    reference.write(*target);
    const Image clocked = renderer().read_radiance(*target);
    const Image whole = picture_of(scene, {12, 12}, options);
    for (int i = 0; i < 12; ++i)
        EXPECT_NEAR(texel(clocked, i, i, 0), texel(whole, i, i, 0), 1e-4f * (1.0f + texel(whole, i, i, 0)));
}

}  // namespace
}  // namespace patina
