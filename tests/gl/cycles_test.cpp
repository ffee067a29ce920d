// The reference against another renderer: Blender's Cycles, where it is installed.
#include "app/temporary_folder.h"
#include "renderer/core/image_io.h"
#include "renderer/reference.h"
#include "tests/gl/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <vector>

namespace patina {
namespace {

using namespace test;
namespace fs = std::filesystem;

constexpr int kSize = 48;
constexpr int kWidth = 128;  ///< of the panorama

/// A dark room with a coloured sky and two softboxes, one behind the camera and one low beside it.
Environment room() {
    return make_panorama(
        [](glm::vec3 d) {
            if (glm::dot(d, glm::normalize(glm::vec3(2.0f, 1.0f, 1.5f))) > 0.93f) return glm::vec3(12.0f);
            if (glm::dot(d, glm::normalize(glm::vec3(-2.0f, -0.5f, 0.5f))) > 0.9f)
                return glm::vec3(4.0f, 2.0f, 1.0f);
            if (d.y > 0.1f) return glm::vec3(0.25f, 0.375f, 0.75f);
            return glm::vec3(0.125f, 0.0625f, 0.03125f);
        },
        kWidth);
}

/// Parts of the panorama's texels, in each of which the radiance is constant.
struct Patch {
    glm::dvec3 direction;
    glm::dvec3 power;  ///< radiance · solid angle
};
std::vector<Patch> patches(const Environment& environment, int split) {
    const int width = environment.width * split, height = environment.height * split;
    std::vector<Patch> result;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double theta = M_PI * (y + 0.5) / height, phi = 2.0 * M_PI * (x + 0.5) / width - M_PI;
            const double solid =
                2.0 * M_PI / width * (std::cos(M_PI * y / height) - std::cos(M_PI * (y + 1) / height));
            const glm::vec3 radiance =
                environment.radiance[std::size_t(y / split) * environment.width + x / split];
            result.push_back(
                {{std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)},
                 solid * glm::dvec3(radiance)});
        }
    return result;
}

/// One bounce between white microfacets: ∫ L D G1(V) G1(L) / 4 NoV dω, G1 = 2c / (c + √(α² + (1 − α²) c²))
/// (Walter et al. 2007).
glm::dvec3 one_bounce(glm::dvec3 N, glm::dvec3 V, double roughness, const std::vector<Patch>& light) {
    const double alpha = roughness * roughness, alpha2 = alpha * alpha;
    const auto lambda = [&](double c) { return 2.0 / (c + std::sqrt(alpha2 + (1.0 - alpha2) * c * c)); };
    const double NoV = glm::dot(N, V);
    glm::dvec3 sum(0.0);
    for (const Patch& patch : light) {
        const double NoL = glm::dot(N, patch.direction);
        if (NoL <= 0.0) continue;
        const double NoH = glm::dot(N, glm::normalize(V + patch.direction));
        const double t = NoH * NoH * (alpha2 - 1.0) + 1.0;
        sum += patch.power * (alpha2 / (M_PI * t * t) * lambda(NoV) * lambda(NoL) * NoL / 4.0);
    }
    return sum;
}

struct Seen {
    int x = 0, y = 0;  ///< row 0 at the top
    glm::dvec3 value{0.0};
};
/// Every third pixel that lies within the sphere, its area in 3×3 places.
std::vector<Seen> summed(double roughness, const Environment& environment) {
    const std::vector<Patch> light = patches(environment, 4);
    const Camera camera;
    constexpr int parts = 3;
    const glm::vec3 eye = camera_position(camera);
    std::vector<Seen> seen;
    for (int y = 1; y < kSize; y += 3)
        for (int x = 1; x < kSize; x += 3) {
            const double r = std::hypot(x + 0.5 - kSize / 2.0, y + 0.5 - kSize / 2.0) / (kSize / 2.0);
            if (r > 0.78) continue;  // the outline is at sin⁻¹(1/4.5) of 15°, .85
            Seen pixel{.x = x, .y = y};
            for (int i = 0; i < parts * parts; ++i) {
                const glm::vec3 ray = ray_through(camera, glm::ivec2(parts * kSize), parts * x + i % parts,
                                                  parts * y + i / parts);
                const glm::dvec3 N(eye + hit_unit_sphere(eye, ray) * ray);
                pixel.value +=
                    one_bounce(glm::normalize(N), -glm::dvec3(ray), roughness, light) / double(parts * parts);
            }
            seen.push_back(pixel);
        }
    return seen;
}

Image by_cycles(const fs::path& folder, const std::string& distribution, double roughness) {
    const auto quoted = [](const fs::path& path) { return " '" + path.string() + "'"; };
    const fs::path out = folder / (distribution + std::to_string(roughness) + ".exr");
    const std::string command =
        "blender -b --factory-startup -P" + quoted(PATINA_SOURCE_DIR "/tests/cycles/render_sphere.py") +
        " --" + quoted(folder / "room.exr") + " " + distribution + " " + std::to_string(roughness) + " " +
        std::to_string(kSize) + " 1024" + quoted(out) + " >" + quoted(folder / "log") + " 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return load_image(out).image;
}

Image by_patina(const Environment& environment, float roughness) {
    Scene scene = make_scene(renderer().upload_environment(
                                 environment, make_baked([](glm::vec3, float) { return glm::vec3(0.0f); })),
                             sphere());
    scene.material.albedo.value = glm::vec3(1.0f);
    scene.material.metallic.value = 1.0f;
    scene.material.roughness.value = roughness;
    return renderer().read_radiance(*draw_reference(renderer(), scene, glm::ivec2(kSize), {}));
}

struct Difference {
    double rms = 0.0, mean = 0.0;  ///< of luminance over truth − 1
};
template <class A, class B>
Difference difference(const std::vector<Seen>& where, const A& value, const B& truth) {
    Difference result;
    for (const Seen& pixel : where) {
        const glm::dvec3 weights(0.2126, 0.7152, 0.0722);
        const double error = glm::dot(weights, value(pixel)) / glm::dot(weights, truth(pixel)) - 1.0;
        result.rms += error * error / double(where.size());
        result.mean += error / double(where.size());
    }
    result.rms = std::sqrt(result.rms);
    return result;
}
auto of(const Image& image) {
    return [&](const Seen& seen) { return glm::dvec3(pixel(image, seen.x, seen.y)); };
}

TEST(SlowCycles, sees_the_same_white_sphere) {
    if (std::system("blender --version >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "Blender is not installed (package blender)";
    const TemporaryFolder folder("patina-cycles");
    const Environment environment = room();
    save_image(folder.path() / "room.exr", radiance_image(environment));
    for (const double roughness : {0.3, 0.5, 0.8}) {
        const std::vector<Seen> sum = summed(roughness, environment);
        const Image ggx = by_cycles(folder.path(), "GGX", roughness);
        const Image multi = by_cycles(folder.path(), "MULTI_GGX", roughness);
        const Image patina = by_patina(environment, float(roughness));
        const Difference same = difference(sum, of(ggx), [](const Seen& seen) { return seen.value; });
        const Difference against_ggx = difference(sum, of(patina), of(ggx));
        const Difference against_multi = difference(sum, of(patina), of(multi));
        std::printf(
            "roughness %.1f: Cycles' GGX against the sum %.2f %% rms (mean %+.2f), the reference against "
            "Cycles' GGX %.2f %% (%+.2f), against MULTI_GGX %.2f %% (%+.2f)\n",
            roughness, 100 * same.rms, 100 * same.mean, 100 * against_ggx.rms, 100 * against_ggx.mean,
            100 * against_multi.rms, 100 * against_multi.mean);
        EXPECT_LT(same.rms, 0.01) << roughness;
        EXPECT_LT(std::abs(same.mean), 2e-3) << roughness;
    }
}

}  // namespace
}  // namespace patina
