// Properties of light on its way from a file to prefiltered levels.
#include "app/stability.h"
#include "app/stability_scene.h"
#include "renderer/ibl/kernel.h"
#include "renderer/ibl/lights.h"
#include "renderer/ibl/sh_transform.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace patina {

namespace {

using glm::dvec3;
using glm::vec3;

BakeSettings few_levels() {
    BakeSettings settings;
    settings.roughness = {0.1f, 0.3f, 1.0f};
    settings.max_face_size = 16;
    return settings;
}

double mean_of(const Environment& environment, int channel) {
    const TexelGrid grid{environment.width, environment.height};
    double sum = 0.0;
    for (int y = 0; y < environment.height; ++y)
        for (int x = 0; x < environment.width; ++x)
            sum += grid.area(y) * environment.radiance[std::size_t(y) * environment.width + x][channel];
    return sum / (4.0 * std::numbers::pi);
}

/// A stored number that a file may hold, and where it must end.
Trial loader_repairs(Random& random, Stage&) {
    constexpr float inf = std::numeric_limits<float>::infinity();
    constexpr float odd[] = {0.0f, -0.0f, 1e-45f, -1e-30f, -5.0f, 65504.0f,
                             1e6f, 1e18f, 3e38f,  inf,     -inf,  std::numeric_limits<float>::quiet_NaN()};
    Image image = make_image(1 + random.below(9), 1 + random.below(9), 1 + random.below(4), PixelType::F32);
    std::size_t nan = 0, negative = 0, infinite = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < image.channels; ++c) {
                const float value = random.chance(0.3) ? odd[random.below(int(std::size(odd)))]
                                                       : float(random.log_between(1e-6, 1e6));
                set_texel(image, x, y, c, value);
                // Grey is spread over three channels before it is looked at; a second or fourth is alpha.
                const bool is_grey = image.channels < 3;
                if (is_grey ? c > 0 : c > 2) continue;
                const std::size_t times = is_grey ? 3 : 1;
                if (std::isnan(value))
                    nan += times;
                else if (value < 0.0f)
                    negative += times;
                else if (std::isinf(value))
                    infinite += times;
            }
    const Environment environment = make_environment(image, "x", "x");
    Trial trial;
    float largest = 0.0f;
    for (const vec3& texel : environment.radiance)
        for (int c = 0; c < 3; ++c) {
            trial.require(std::isfinite(texel[c]) && texel[c] >= 0.0f);
            largest = std::max(largest, texel[c]);
        }
    trial.require(largest <= 1e18f);
    const auto noted = [&](std::size_t count, const char* what) {
        const std::string start = std::to_string(count) + " " + what;
        return std::ranges::any_of(environment.notes,
                                   [&](const std::string& note) { return note.starts_with(start); });
    };
    trial.require(nan == 0 || noted(nan, "NaN"));
    trial.require(negative == 0 || noted(negative, "negative"));
    trial.require(infinite == 0 || noted(infinite, "infinite"));
    return trial;
}

Trial constant_stays(Random& random, Stage&) {
    const double value = random.log_between(1e-12, 1e12);
    const Environment environment =
        panorama_of([&](dvec3) { return dvec3(value); }, 1 + random.below(64), 1 + random.below(40));
    const auto baked = bake_environment(environment, few_levels(), {});
    const auto given = double(environment.radiance[0].x);
    Trial trial;
    for (const PrefilteredLevel& level : baked->levels)
        for (const vec3& texel : level.cube.texels) trial.add(std::abs(texel.y / given - 1.0));
    for (const vec3& texel : baked->irradiance.texels) trial.add(std::abs(texel.y / given - 1.0));
    return trial;
}

/// The zeroth coefficient, which no kernel changes, is the mean; and so is what texels of a smooth level say.
Trial mean_stays(Random& random, Stage&) {
    const Environment environment = any_panorama(random);
    const LegendreTables tables(8, serial_for);
    const ShCoefficients coefficients = analyse(view_of(environment), tables, {});
    Trial trial;
    for (int c = 0; c < 3; ++c) {
        const double mean = mean_of(environment, c);
        // c_0 = 1/√4π is part of the stored coefficient
        if (mean > 0.0) trial.add(std::abs(coefficients.at(0, 0)[std::size_t(2) * c] / mean - 1.0));
    }
    for (const double roughness : {0.1, 0.5, 1.0})
        trial.add(std::abs(ggx_zonal(roughness * roughness, 2)[0] - 1.0));
    return trial;
}

Trial mean_of_texels(Random& random, Stage&) {
    const Environment environment = panorama_of(SoftLight(random), 128, 64);
    BakeSettings settings;
    settings.roughness = {0.6f, 1.0f};
    settings.face_sizes = {128, 128};
    const auto baked = bake_environment(environment, settings, {});
    Trial trial;
    for (const PrefilteredLevel& level : baked->levels) {
        const int n = level.cube.size;
        for (int c = 0; c < 3; ++c) {
            double sum = 0.0;
            for (int i = 0; i < 6 * n * n; ++i)
                sum += cube_texel_solid_angle(n, i % n, i / n % n) * level.cube.texels[std::size_t(i)][c];
            trial.add(std::abs(sum / (4.0 * std::numbers::pi) / mean_of(environment, c) - 1.0));
        }
    }
    return trial;
}

/// Σ_{l>0} g_l² E_l for any spectrum E: every g_l must not rise with roughness, and some must fall.
Trial spectrum_falls(Random& random, Stage&) {
    const double sharp = random.log_between(0.06, 0.95);
    const double rough = std::min(1.0, sharp * random.log_between(1.02, 2.0));
    const std::vector<double> before = ggx_zonal(sharp * sharp, 64), after = ggx_zonal(rough * rough, 64);
    Trial trial;
    double sum_before = 0.0, sum_after = 0.0;
    for (std::size_t l = 1; l < std::min(before.size(), after.size()); ++l) {
        const double power = random.log_between(1e-3, 1.0) / double(l * l);
        sum_before += power * before[l] * before[l];
        sum_after += power * after[l] * after[l];
    }
    trial.require(sum_after < sum_before);
    return trial;
}

/// Whatever the picture: finite, not negative, between its darkest and brightest (by a thousandth of the
/// mean).
Trial bake_fuzz(Random& random, Stage&) {
    const Environment environment = any_panorama(random);
    vec3 lowest = environment.radiance[0], highest = lowest;
    for (const vec3& texel : environment.radiance) {
        lowest = glm::min(lowest, texel);
        highest = glm::max(highest, texel);
    }
    BakeSettings settings = few_levels();
    settings.extract_lights = random.chance(0.5);
    if (random.chance(0.1)) settings.roughness = {0.0f, 0.03f, 0.5f};
    const auto baked = bake_environment(environment, settings, {});
    Trial trial;
    const dvec3 slack =
        1e-3 * dvec3(mean_of(environment, 0), mean_of(environment, 1), mean_of(environment, 2));
    const auto check = [&](const CubeMap& cube) {
        for (const vec3& texel : cube.texels)
            for (int c = 0; c < 3; ++c)  // where lights were taken out, less than the darkest may be left
                trial.require(std::isfinite(texel[c]) && texel[c] >= 0.0f &&
                              texel[c] <= highest[c] + slack[c] &&
                              (!baked->lights.empty() || texel[c] >= lowest[c] - slack[c]));
    };
    for (const PrefilteredLevel& level : baked->levels) check(level.cube);
    check(baked->irradiance);
    for (const ExtractedLight& light : baked->lights)
        for (int c = 0; c < 3; ++c)
            trial.require(std::isfinite(light.irradiance[c]) && light.irradiance[c] >= 0.0f);
    return trial;
}

Trial power_of_two(Random& random, Stage&) {
    Environment environment =
        panorama_of(SoftLight(random), 2 * (1 + random.below(32)), 1 + random.below(32));
    if (random.chance(0.5))
        environment.radiance[std::size_t(random.below(int(environment.radiance.size())))] *= 1e5f;
    const auto before = bake_environment(environment, few_levels(), {});
    const auto factor = std::ldexp(1.0f, random.below(61) - 30);
    for (vec3& texel : environment.radiance) texel *= factor;
    const auto after = bake_environment(environment, few_levels(), {});
    Trial trial;
    for (std::size_t i = 0; i < before->levels.size(); ++i) {
        const auto& a = before->levels[i].cube.texels;
        const auto& b = after->levels[i].cube.texels;
        for (std::size_t k = 0; k < a.size(); ++k) trial.require(a[k] * factor == b[k]);
    }
    return trial;
}

/// Largest difference of coefficients, relative to the mean's.
Trial transform_is_linear(Random& random, Stage&) {
    const Environment a = panorama_of(SoftLight(random), 64, 32);
    const Environment b = sunny_panorama(64, random.log_between(1.0, 1e3), random);
    Environment sum = a;
    for (std::size_t i = 0; i < sum.radiance.size(); ++i) sum.radiance[i] += b.radiance[i];
    constexpr int band = 40;
    const LegendreTables tables(band, serial_for);
    const ShCoefficients ca = analyse(view_of(a), tables, {}), cb = analyse(view_of(b), tables, {}),
                         cs = analyse(view_of(sum), tables, {});
    const double scale = std::abs(cs.at(0, 0)[0]);
    Trial trial;
    for (int m = 0; m <= band; ++m)
        for (int l = m; l <= band; ++l)
            for (int part = 0; part < 6; ++part)
                trial.add(std::abs(double(ca.at(l, m)[part]) + cb.at(l, m)[part] - cs.at(l, m)[part]) /
                          scale);
    return trial;
}

/// A level's band is chosen by its picture's spectrum: each of the three bakes leaves out up to 7e-4 of its
/// mean (root mean square), so their sum may differ by that. Texels of one level are one case.
Trial bake_is_linear(Random& random, Stage&) {
    const Environment a = panorama_of(SoftLight(random), 64, 32), b = panorama_of(SoftLight(random), 64, 32);
    Environment sum = a;
    for (std::size_t i = 0; i < sum.radiance.size(); ++i) sum.radiance[i] += b.radiance[i];
    const auto ba = bake_environment(a, few_levels(), {}), bb = bake_environment(b, few_levels(), {}),
               bs = bake_environment(sum, few_levels(), {});
    Trial trial;
    for (std::size_t i = 0; i < bs->levels.size(); ++i) {
        const std::size_t count = bs->levels[i].cube.texels.size();
        double squares = 0.0;
        for (std::size_t k = 0; k < count; ++k) {
            const double parts = double(ba->levels[i].cube.texels[k].y) + bb->levels[i].cube.texels[k].y;
            squares += std::pow(parts - bs->levels[i].cube.texels[k].y, 2.0);
        }
        trial.add(std::sqrt(squares / double(count)) / mean_of(sum, 1));
    }
    return trial;
}

/// With the band held, levels of a sum are the levels' sum.
Trial synthesis_is_linear(Random& random, Stage&) {
    const Environment a = panorama_of(SoftLight(random), 64, 32), b = panorama_of(SoftLight(random), 64, 32);
    Environment sum = a;
    for (std::size_t i = 0; i < sum.radiance.size(); ++i) sum.radiance[i] += b.radiance[i];
    const int band = 8 + random.below(24);
    const double roughness = random.between(0.1, 1.0);
    std::vector<double> zonal = ggx_zonal(roughness * roughness, band);
    const LegendreTables tables(band, serial_for);
    const auto level_of = [&](const Environment& environment) {
        const ShCoefficients coefficients = analyse(view_of(environment), tables, {});
        const BakeControl control;
        const Synthesis::Range unbounded{vec3(-std::numeric_limits<float>::max()),
                                         vec3(std::numeric_limits<float>::max())};
        return Synthesis(coefficients, control).to_cube(zonal, 16, unbounded);
    };
    const CubeMap of_a = level_of(a), of_b = level_of(b), of_sum = level_of(sum);
    Trial trial;
    for (std::size_t i = 0; i < of_sum.texels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            trial.add(std::abs(double(of_a.texels[i][c]) + of_b.texels[i][c] - of_sum.texels[i][c]) /
                      mean_of(sum, c));
    return trial;
}

Trial yaw_is_a_phase(Random& random, Stage&) {
    const int width = 2 * (8 + random.below(40)), height = 8 + random.below(40), shift = random.below(width);
    const Environment environment = panorama_of(
        [&](dvec3) { return dvec3(random.uniform(), random.uniform(), random.uniform()); }, width, height);
    Environment turned = environment;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            turned.radiance[std::size_t(y) * width + (x + shift) % width] =
                environment.radiance[std::size_t(y) * width + x];
    const int band = 32;
    const LegendreTables tables(band, serial_for);
    const ShCoefficients a = analyse(view_of(environment), tables, {}),
                         b = analyse(view_of(turned), tables, {});
    const double scale = std::abs(a.at(0, 0)[0]);
    Trial trial;
    for (int m = 0; m <= band; ++m)
        for (int l = m; l <= band; ++l)
            for (int channel = 0; channel < 3; ++channel) {
                const double angle = -2.0 * std::numbers::pi * m * shift / width;
                const float* z = a.at(l, m) + std::size_t(2) * channel;
                const double re = z[0] * std::cos(angle) - z[1] * std::sin(angle);
                const double im = z[0] * std::sin(angle) + z[1] * std::cos(angle);
                trial.add(std::hypot(b.at(l, m)[std::size_t(2) * channel] - re,
                                     b.at(l, m)[std::size_t(2) * channel + 1] - im) /
                          scale);
            }
    return trial;
}

glm::dmat3 any_rotation(Random& random) {
    const dvec3 z = random.direction();
    dvec3 x = glm::cross(random.direction(), z);
    while (glm::dot(x, x) < 1e-4) x = glm::cross(random.direction(), z);
    x = glm::normalize(x);
    return {x, glm::cross(z, x), z};
}

/// E_l, relative to all of them; texels hold what is at their middle, which a turn samples elsewhere.
Trial rotation_keeps_the_spectrum(Random& random, Stage&) {
    const SoftLight light(random);
    const glm::dmat3 turn = any_rotation(random);
    const LegendreTables tables(24, serial_for);
    const auto spectrum = [&](const Environment& environment) {
        return power_spectrum(analyse(view_of(environment), tables, {}));
    };
    const std::vector<double> before = spectrum(panorama_of(light, 256, 128));
    const std::vector<double> after =
        spectrum(panorama_of([&](dvec3 d) { return light(turn * d); }, 256, 128));
    double total = 0.0;
    for (const double each : before) total += each;
    Trial trial;
    for (std::size_t l = 0; l < before.size(); ++l) trial.add(std::abs(before[l] - after[l]) / total);
    return trial;
}

/// A picture that depends on height alone stays so: opposite faces agree, and quarter turns of the poles'.
Trial zonal_stays_zonal(Random& random, Stage&) {
    std::vector<double> rows(64);
    for (double& row : rows) row = random.log_between(0.01, 100.0);
    const Environment environment = panorama_of(
        [&](dvec3 d) { return dvec3(rows[std::size_t(std::acos(d.y) / std::numbers::pi * 64.0)]); }, 128, 64);
    const auto baked = bake_environment(environment, few_levels(), {});
    Trial trial;
    for (const PrefilteredLevel& level : baked->levels) {
        const int n = level.cube.size;
        const auto at = [&](int face, int x, int y) {
            return double(level.cube.texels[(std::size_t(face) * n + y) * n + x].x);
        };
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                for (const int face : {1, 4, 5}) trial.add(std::abs(at(face, x, y) / at(0, x, y) - 1.0));
                for (const int pole : {2, 3})
                    trial.add(std::abs(at(pole, y, n - 1 - x) / at(pole, x, y) - 1.0));
            }
    }
    return trial;
}

/// What is taken out as lights and what is left are the picture.
Trial lights_conserve(Random& random, Stage&) {
    Environment environment =
        sunny_panorama(2 * (4 + random.below(40)), random.log_between(10.0, 1e6), random);
    for (int i = random.below(5); i > 0; --i)
        environment.radiance[std::size_t(random.below(int(environment.radiance.size())))] *=
            float(random.log_between(10.0, 1e5));
    const LightExtraction extraction =
        extract_lights(environment, radiance_statistics(view_of(environment), serial_for), {});
    Environment sum = environment;
    for (int y = 0; y < sum.height; ++y)
        std::copy_n(extraction.residual.rows[std::size_t(y)], sum.width,
                    sum.radiance.begin() + std::ptrdiff_t(y) * sum.width);
    Trial trial;
    for (const auto& light : extraction.texels)
        for (const LightTexel& texel : light)
            sum.radiance[std::size_t(texel.y) * sum.width + texel.x] += texel.excess;
    for (std::size_t i = 0; i < sum.radiance.size(); ++i)
        for (int c = 0; c < 3; ++c)
            trial.add(std::abs(double(sum.radiance[i][c]) - environment.radiance[i][c]) /
                      std::max(double(environment.radiance[i][c]), 1e-30));
    return trial;
}

}  // namespace

std::vector<Property> light_properties() {
    return {
        {"loader-repairs", "NaN, negative and Inf are mended and counted", 0.0, 20000, loader_repairs},
        {"constant-light", "a constant environment stays constant, relative", 1e-5, 50000, constant_stays},
        {"mean-light", "no level's kernel changes the mean, relative", 1e-5, 2000, mean_stays},
        {"mean-texels", "texels of smooth levels have the mean, relative", 1e-5, 60, mean_of_texels},
        {"spectrum-falls", "rougher levels hold less detail", 0.0, 200, spectrum_falls},
        {"bake-fuzz", "levels are finite, ≥ 0 and within the picture's range", 0.0, 200000, bake_fuzz},
        {"power-of-two", "bake(2ⁿ L) = 2ⁿ bake(L), bit for bit", 0.0, 50000, power_of_two},
        {"transform-linear", "transform(A + B) = its parts' sum, of the mean", 1e-5, 20000,
         transform_is_linear},
        {"synthesis-linear", "a sum's level = its parts' sum at one band, of the mean", 1e-5, 20000,
         synthesis_is_linear},
        {"bake-linear", "bake(A + B) = its parts' sum, rms of the mean", 2.1e-3, 60, bake_is_linear},
        {"yaw-phase", "yaw by whole texels is a phase, of the mean", 1e-6, 20000, yaw_is_a_phase},
        {"rotation-spectrum", "a rotation keeps the power spectrum", 1e-4, 250, rotation_keeps_the_spectrum},
        {"zonal", "a zonal environment stays zonal, relative", 1e-5, 50000, zonal_stays_zonal},
        {"lights-conserve", "extracted and residual make the picture, relative", 1e-6, 20000,
         lights_conserve},
    };
}

}  // namespace patina
