#include "renderer/ibl/bake.h"

#include "renderer/ibl/kernel.h"
#include "renderer/ibl/level_plan.h"
#include "renderer/ibl/sampling.h"
#include "renderer/ibl/sh_transform.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace patina {
namespace {

constexpr int kLevelCount = 16;
constexpr float kSharpest = 0.0999f;  ///< smoother levels come from the standard transform
constexpr int kStandardBand = 600;
constexpr double kTruncation = 2e-4;  ///< relative rms of what a level leaves out

/// Smooth levels need fewer texels: bilinear reconstruction then errs less than the levels themselves.
int face_size(float roughness, int largest) {
    const int size = roughness < kSharpest ? 256 : roughness < 0.25f ? 128 : roughness < 0.6f ? 64 : 32;
    return std::min(size, largest);
}

}  // namespace

void serial_for(int count, const std::function<void(int)>& body) {
    for (int i = 0; i < count; ++i) body(i);
}

std::vector<float> standard_roughness_levels() {
    std::vector<float> levels;
    for (int i = 0; i < kLevelCount; ++i)
        levels.push_back(float(std::pow(10.0, double(i) / (kLevelCount - 1) - 1.0)));
    levels.back() = 1.0f;
    return levels;
}

std::optional<BakedEnvironment> bake_environment(const Environment& environment, const BakeSettings& settings,
                                                 const BakeControl& control) {
    assert(environment.width > 0 && environment.height > 0);
    BakedEnvironment baked;
    std::vector<std::vector<double>> zonal(settings.roughness.size() + 1);
    control.parallel_for(int(zonal.size()), [&](int i) {
        const double r = i < int(settings.roughness.size()) ? settings.roughness[i] : 1.0;
        if (r >= kSharpest) zonal[i] = ggx_zonal(r * r, kernel_band(r * r, kStandardBand));
    });
    if (control.stop.stop_requested()) return std::nullopt;
    const LegendreTables tables(kStandardBand, control.parallel_for);
    const RadianceStatistics statistics = radiance_statistics(environment, control.parallel_for);
    const Synthesis::Range range = {statistics.lowest, statistics.highest};
    const ShCoefficients coefficients = analyse(environment, tables, control);
    if (control.stop.stop_requested()) return std::nullopt;
    const std::vector<double> power = power_spectrum(coefficients);
    const double allowed_rms = kTruncation * statistics.error_scale;
    for (auto& kernel : zonal)
        if (!kernel.empty()) truncate(kernel, power, allowed_rms);
    Synthesis synthesis(coefficients, control);
    std::optional<CubePyramid> pyramid;
    for (std::size_t i = 0; i < settings.roughness.size(); ++i) {
        if (control.stop.stop_requested()) return std::nullopt;
        const float roughness = settings.roughness[i];
        const int size = face_size(roughness, settings.max_face_size);
        if (zonal[i].empty()) {
            if (!pyramid) pyramid.emplace(environment, 256, control.parallel_for);
            baked.levels.push_back(
                {roughness, prefilter_by_sampling(*pyramid, roughness, 256, size, control)});
        } else {
            baked.levels.push_back({roughness, synthesis.to_cube(zonal[i], size, range)});
        }
        control.progress(float(i + 1) / float(settings.roughness.size() + 1));
    }
    baked.irradiance = synthesis.to_cube(zonal.back(), face_size(1.0f, settings.max_face_size), range);
    if (control.stop.stop_requested()) return std::nullopt;
    control.progress(1.0f);
    return baked;
}

}  // namespace patina
