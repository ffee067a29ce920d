#include "renderer/lobes/fit_light.h"

#include "renderer/brdf.h"
#include "renderer/ibl/cube.h"
#include "renderer/ibl/lights.h"
#include "renderer/ibl/sampling.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace patina::lobes {

namespace {

constexpr int kSplit = 3;  ///< a light's texel is split kSplit × kSplit

void put(LaneCube& cube, const CubeMap& source, int lane, float scale) {
    for (int row = 0; row < 6 * source.size; ++row)
        for (int x = 0; x < source.size; ++x)
            cube.texels[cube.at(row / source.size, x, row % source.size)][lane] =
                scale * brdf::luminance(source.texels[std::size_t(row) * source.size + x]);
}

LaneCube halved(const LaneCube& source) {
    LaneCube result(source.size / 2);
    const auto mean_of_four = [&](int face, int x, int y) {
        double area = 0.0;
        Lanes sum{}, mean{};
        for (int k = 0; k < 4; ++k) {
            const int sx = 2 * x + k % 2, sy = 2 * y + k / 2;
            const double own = cube_texel_solid_angle(source.size, sx, sy);
            add_scaled(sum, source.texels[source.at(face, sx, sy)], float(own));
            area += own;
        }
        add_scaled(mean, sum, float(1.0 / area));
        return mean;
    };
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < result.size; ++y)
            for (int x = 0; x < result.size; ++x)
                result.texels[result.at(face, x, y)] = mean_of_four(face, x, y);
    result.fill_border();
    return result;
}

/// What was taken out of one environment, as many small lights.
std::vector<LightSample> samples_of(const Environment& environment, const LightExtraction& extraction,
                                    float scale) {
    const TexelGrid grid{environment.width, environment.height};
    std::vector<LightSample> samples;
    for (const auto& texels : extraction.texels) {
        for (const LightTexel& texel : texels) {
            const double area = grid.area(texel.y) / (kSplit * kSplit);
            const auto irradiance = float(scale * brdf::luminance(texel.excess) * area);
            for (int y = 0; y < kSplit; ++y)
                for (int x = 0; x < kSplit; ++x)
                    samples.push_back({glm::vec3(grid.direction(texel.x + (x + 0.5) / kSplit,
                                                                texel.y + (y + 0.5) / kSplit)),
                                       irradiance});
        }
    }
    return samples;
}

Environment residual_of(const Environment& environment, const LightExtraction& extraction) {
    Environment residual = environment;
    for (const auto& texels : extraction.texels)
        for (const LightTexel& texel : texels) {
            glm::vec3& radiance = residual.radiance[std::size_t(texel.y) * environment.width + texel.x];
            radiance = glm::max(radiance - texel.excess, glm::vec3(0.0f));
        }
    return residual;
}

void add_environment(FitLight& light, const Environment& environment, int lane) {
    BakeSettings settings;
    settings.extract_lights = true;
    const BakedEnvironment baked = *bake_environment(environment, settings, {});
    const RadianceStatistics statistics = radiance_statistics(view_of(environment), serial_for);
    const LightExtraction extraction = extract_lights(environment, statistics, {});
    const float scale = 1.0f / std::max(brdf::luminance(glm::vec3(statistics.mean_color)), 1e-12f);
    if (light.levels.empty()) {
        for (const PrefilteredLevel& level : baked.levels) light.levels.emplace_back(level.cube.size);
        light.irradiance.emplace_back(baked.irradiance.size);
    }
    for (std::size_t k = 0; k < baked.levels.size(); ++k)
        put(light.levels[k], baked.levels[k].cube, lane, scale);
    put(light.irradiance[0], baked.irradiance, lane, scale);
    const Environment residual = residual_of(environment, extraction);
    put(light.pyramid[0], resample_environment(residual, light.pyramid[0].size, serial_for), lane, scale);
    FitLights lights{baked.lights, samples_of(environment, extraction, scale)};
    for (ExtractedLight& source : lights.lights) source.irradiance *= scale;
    light.lights.push_back(std::move(lights));
}

}  // namespace

LaneCube::LaneCube(int face_size)
    : size(face_size), texels(std::size_t(6) * (face_size + 2) * (face_size + 2), Lanes{}) {}

void LaneCube::fill_border() {
    const auto across = [&](int face, int x, int y) {
        const auto center = [&](int i) { return (2.0f * float(i) + 1.0f) / float(size) - 1.0f; };
        const FacePoint p = face_point(face_direction({face, center(x), center(y)}));
        const auto index = [&](float c) {
            return std::clamp(int((c + 1.0f) * 0.5f * float(size)), 0, size - 1);
        };
        return texels[at(p.face, index(p.s), index(p.t))];
    };
    const auto outside = [&](int face, int x, int y) {
        const int inner_x = std::clamp(x, 0, size - 1), inner_y = std::clamp(y, 0, size - 1);
        if (x == inner_x || y == inner_y) return across(face, x, y);
        Lanes corner{};
        for (const Lanes& near :
             {texels[at(face, inner_x, inner_y)], across(face, x, inner_y), across(face, inner_x, y)})
            add_scaled(corner, near, 1.0f / 3.0f);
        return corner;
    };
    for (int face = 0; face < 6; ++face)
        for (int k = -1; k <= size; ++k)
            for (const glm::ivec2 texel : {glm::ivec2(-1, k), {size, k}, {k, -1}, {k, size}})
                texels[at(face, texel.x, texel.y)] = outside(face, texel.x, texel.y);
}

void LaneCube::add_to(Lanes& sum, glm::vec3 direction, float weight) const {
    const FacePoint p = face_point(direction);
    const float x = (p.s + 1.0f) * 0.5f * float(size) - 0.5f;
    const float y = (p.t + 1.0f) * 0.5f * float(size) - 0.5f;
    const int x0 = std::clamp(int(std::floor(x)), -1, size - 1);
    const int y0 = std::clamp(int(std::floor(y)), -1, size - 1);
    const float fx = x - float(x0), fy = y - float(y0);
    const Lanes* upper = &texels[at(p.face, x0, y0)];
    const Lanes* lower = upper + size + 2;
    const float a = (1.0f - fx) * (1.0f - fy) * weight, b = fx * (1.0f - fy) * weight;
    const float c = (1.0f - fx) * fy * weight, d = fx * fy * weight;
    for (int i = 0; i < kLanes; ++i)
        sum[i] += a * upper[0][i] + b * upper[1][i] + c * lower[0][i] + d * lower[1][i];
}

void FitLight::add_level(Lanes& sum, glm::vec3 direction, int level, float weight) const {
    levels[std::clamp(level, 0, int(levels.size()) - 1)].add_to(sum, direction, weight);
}

void FitLight::add_prefiltered(Lanes& sum, glm::vec3 direction, float log2_roughness, float weight) const {
    const float level = std::max(level_index(log2_roughness), 0.0f), lower = std::floor(level);
    add_level(sum, direction, int(lower), weight * (1.0f - level + lower));
    add_level(sum, direction, int(lower) + 1, weight * (level - lower));
}

float FitLight::level_index(float log2_roughness) {
    static const float first = std::log2(standard_roughness_levels().front());
    return brdf::kLevelsPerOctave * (log2_roughness - first);
}

void FitLight::add_filtered(Lanes& sum, glm::vec3 direction, double solid_angle, float weight) const {
    const double texel = 4.0 * std::numbers::pi / (6.0 * pyramid[0].size * pyramid[0].size);
    const double lod = std::clamp(0.5 * std::log2(solid_angle / texel), 0.0, double(pyramid.size() - 1));
    const int lower = int(lod);
    const float share = float(lod - lower);
    pyramid[lower].add_to(sum, direction, weight * (1.0f - share));
    if (share > 0.0f) pyramid[lower + 1].add_to(sum, direction, weight * share);
}

FitLight make_fit_light(const std::vector<Environment>& environments, int source_size) {
    assert(int(environments.size()) <= kLanes);
    FitLight light;
    light.count = int(environments.size());
    light.pyramid.emplace_back(source_size);
    for (int i = 0; i < light.count; ++i) add_environment(light, environments[i], i);
    for (auto* cubes : {&light.levels, &light.irradiance})
        for (LaneCube& cube : *cubes) cube.fill_border();
    light.pyramid[0].fill_border();
    while (light.pyramid.back().size > 4) light.pyramid.push_back(halved(light.pyramid.back()));
    return light;
}

}  // namespace patina::lobes
