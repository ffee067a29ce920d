#include "renderer/lobes/fit_judge.h"

#include "renderer/brdf.h"
#include "renderer/core/camera.h"
#include "renderer/lobes/fit_solve.h"
#include "renderer/lobes/fit_truth.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace patina::lobes {

namespace {

constexpr float kReflectances[] = {1.0f, 0.04f};
constexpr double kDarkest = 1e-3;

struct Pixel {
    Frame frame;
    float NoV = 1.0f;
};

/// Where rays spread evenly over the sphere's disc meet it.
std::vector<Pixel> sphere_pixels(int count) {
    const Camera camera;
    const glm::vec3 eye = camera_position(camera), towards = glm::normalize(camera.target - eye);
    const Frame screen = frame_of(-towards, glm::vec3(0.0f, 1.0f, 0.0f));
    const double edge = 1.0 / std::sqrt(double(camera.distance) * camera.distance - 1.0);
    std::vector<Pixel> pixels;
    for (int i = 0; i < count; ++i) {
        const double radius = edge * std::sqrt((i + 0.5) / count);
        const double azimuth = 2.0 * std::numbers::pi * std::fmod(i * 0.6180339887498949, 1.0);
        const glm::vec3 ray = glm::normalize(towards + screen.T * float(radius * std::cos(azimuth)) +
                                             screen.B * float(radius * std::sin(azimuth)));
        const float along = glm::dot(ray, -eye);
        const float depth = std::sqrt(std::max(0.0f, 1.0f - (glm::dot(eye, eye) - along * along)));
        const glm::vec3 N = glm::normalize(eye + ray * (along - depth));
        pixels.push_back({frame_of(N, -ray), std::max(glm::dot(N, -ray), 1e-3f)});
    }
    return pixels;
}

/// All lights' part of the lobe, of the irradiance (E/π), true and as the renderer shades them.
struct LightSums {
    LobeSums truth, shaded;
    Lanes irradiance{};
};

LightSums sum_lights(const FitLight& light, const Pixel& pixel, double alpha) {
    LightSums sums;
    const double alpha2 = alpha * alpha;
    const Frame& f = pixel.frame;
    const auto local = [&](glm::vec3 d) {
        return glm::dvec3(glm::dot(d, f.T), glm::dot(d, f.B), glm::dot(d, f.N));
    };
    for (int e = 0; e < light.count; ++e) {
        for (const LightSample& sample : light.lights[e].samples) {
            const glm::dvec3 L = local(sample.direction);
            const Reflection r = reflection(pixel.NoV, L, alpha2);
            sums.truth.plain[e] += float(r.plain * sample.irradiance);
            sums.truth.fresnel[e] += float(r.fresnel * sample.irradiance);
            sums.irradiance[e] += float(std::max(L.z, 0.0) * sample.irradiance / std::numbers::pi);
        }
        for (const ExtractedLight& source : light.lights[e].lights) {
            const double widening = 0.125 * source.angular_radius_rad * source.angular_radius_rad;
            const Reflection r = reflection(pixel.NoV, local(source.direction), alpha2, widening);
            const float E = brdf::luminance(source.irradiance);
            sums.shaded.plain[e] += float(r.plain * E);
            sums.shaded.fresnel[e] += float(r.fresnel * E);
        }
    }
    return sums;
}

/// Squared relative errors of each reflectance, method and environment.
using Sums = std::array<std::array<Lanes, kMethods>, std::size(kReflectances)>;

struct Judged {
    const FitLight& light;
    std::span<const LobePair> nodes;
    int truth_samples;
};

/// Adds one pixel's.
void add_pixel(const Judged& judged, const Pixel& pixel, float roughness, Sums& sums) {
    const FitLight& light = judged.light;
    const double alpha = double(roughness) * roughness;
    const Lobe lobe = sample_lobe(pixel.NoV, alpha, judged.truth_samples);
    const LobeSums truth = sum_lobe(lobe, light, pixel.frame);
    const LightSums lights = sum_lights(light, pixel, alpha);
    const glm::vec2 ab(lobe.Ess - lobe.B, lobe.B);
    const float s = std::sqrt(1.0f - pixel.NoV * pixel.NoV);
    const glm::vec3 N = pixel.frame.N, R = pixel.frame.to_world({-s, 0.0f, pixel.NoV});
    Lanes irradiance{};
    light.irradiance[0].add_to(irradiance, N, 1.0f);
    for (int z = 0; z < 2; ++z) {
        const float f0 = kReflectances[z];
        const brdf::ReflectionWeights w =
            brdf::split_sum_weights(glm::vec3(z ? 0.8f : 1.0f), z ? 0.0f : 1.0f, ab);
        const LobeNode node = lobe_at(judged.nodes, pixel.NoV, roughness, brdf::fresnel_share(f0, ab));
        std::array<Lanes, kMethods> P{};
        light.add_prefiltered(P[0], R, std::log2(roughness), 1.0f);
        P[1] = lobe_radiance(light, node.two, false, {R, N, roughness});
        P[2] = lobe_radiance(light, node.four, true, {R, N, roughness});
        for (int e = 0; e < light.count; ++e) {
            const double rest = (w.multiple.x + w.diffuse.x) * (irradiance[e] + lights.irradiance[e]);
            const auto specular = [&](const LobeSums& x) {
                return f0 * x.plain[e] + (1.0 - f0) * x.fresnel[e];
            };
            const double t = specular(truth) + specular(lights.truth) + rest;
            for (int m = 0; m < kMethods; ++m) {
                const double x = w.single.x * P[m][e] + specular(lights.shaded) + rest;
                const double error = (x - t) / std::max(t, kDarkest);
                sums[z][m][e] += float(error * error);
            }
        }
    }
}

void add_means(const std::array<Lanes, kMethods>& squares, int environments, double pixels, Judgement& row) {
    for (int m = 0; m < kMethods; ++m) {
        for (int e = 0; e < environments; ++e) {
            const double mean = squares[m][e] / pixels;
            row.rms_of[m][e] = std::sqrt(mean);
            row.rms[m] += mean / environments;
        }
        row.rms[m] = std::sqrt(row.rms[m]);
    }
}

}  // namespace

std::vector<Judgement> judge(const FitLight& light, std::span<const LobePair> nodes,
                             const JudgeSettings& settings) {
    const std::vector<Pixel> pixels = sphere_pixels(settings.pixels);
    std::vector<Judgement> result;
    for (const float roughness : settings.roughness) {
        Sums sums{};
        for (const Pixel& pixel : pixels)
            add_pixel({light, nodes, settings.truth_samples}, pixel, roughness, sums);
        for (std::size_t z = 0; z < sums.size(); ++z) {
            Judgement row{roughness, kReflectances[z], {}, {}};
            add_means(sums[z], light.count, double(pixels.size()), row);
            result.push_back(row);
        }
    }
    return result;
}

}  // namespace patina::lobes
