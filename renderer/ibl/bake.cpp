#include "renderer/ibl/bake.h"

#include "renderer/ibl/kernel.h"
#include "renderer/ibl/level_plan.h"
#include "renderer/ibl/lights.h"
#include "renderer/ibl/near_field.h"
#include "renderer/ibl/sampling.h"
#include "renderer/ibl/sh_transform.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>

namespace patina {
namespace {

constexpr int kLevelCount = 16;
constexpr float kStandardSharpest = 0.0999f;  ///< smoother levels need no more than the standard band
constexpr int kStandardBand = 600;
constexpr double kStrongLight = 2e4;           ///< of the mean: a light that reaches beyond the standard band
constexpr float kTransformSharpest = 0.0749f;  ///< sharper levels are transformed only far from their middle
constexpr int kSharpBand = 1000;
constexpr double kTruncation = 7e-4;  ///< relative rms of what a level leaves out

constexpr int kMostFirstRows = 512;  ///< that a first light looks at
/// A sun in a first light's panorama lies in up to four texels of 2.8°.
constexpr double kSmearedLight = 0.05;

/// How much of it all is computed.
struct Plan {
    int band = kStandardBand;
    int largest_face = 256;
    bool irradiance = true;
    std::optional<KernelSplit> split;  ///< levels the transform cannot do whole get what is far, or nothing
};

/// Smooth levels need fewer texels: bilinear reconstruction then errs less than the levels themselves.
int face_size(float roughness, int largest) {
    const int size = roughness < kStandardSharpest ? 256
                     : roughness < 0.25f           ? 128
                     : roughness < 0.6f            ? 64
                                                   : 32;
    return std::min(size, largest);
}

/// Of a level of the settings.
int level_size(const BakeSettings& settings, std::size_t level, int largest) {
    if (!settings.face_sizes.empty()) return settings.face_sizes[level];
    return face_size(settings.roughness[level], std::min(largest, settings.max_face_size));
}

bool is_transformed(float roughness) { return roughness >= kTransformSharpest; }

/// Calls progress with shares of the work done; only ever from the thread that bakes.
struct Progress {
    const BakeControl& control;
    double total, done = 0.0;
    void add(double share) { control.progress(float(std::min(1.0, (done += share) / total))); }
};

/// Milliseconds since it was made or last asked.
class Stopwatch {
public:
    double lap_ms() {
        const auto now = std::chrono::steady_clock::now();
        const std::chrono::duration<double, std::milli> lap = now - start_;
        start_ = now;
        return lap.count();
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// What a level costs, in arbitrary units.
double level_cost(float roughness) { return roughness < 0.25f ? 3.0 : 1.0; }

/// The kernels of all levels, then that of the irradiance; empty where there is nothing to transform.
std::vector<std::vector<double>> make_kernels(const std::vector<float>& roughness, const Plan& plan,
                                              const BakeControl& control) {
    std::vector<std::vector<double>> kernels(roughness.size() + 1);
    control.parallel_for(int(kernels.size()), [&](int i) {
        // At roughness 1 D is constant and the kernel is NoL: that level is E/π.
        const bool is_irradiance = i == int(roughness.size());
        const double r = is_irradiance ? 1.0 : roughness[i], alpha = r * r;
        const bool is_repeated = i > 0 && !is_irradiance && roughness[i] == roughness[i - 1];
        if (is_repeated || control.stop.stop_requested() || (is_irradiance && !plan.irradiance)) return;
        if (is_transformed(float(r)))
            kernels[i] = ggx_zonal(alpha, kernel_band(alpha, plan.band));
        else if (plan.split && r > 0.0)
            kernels[i] = ggx_far_zonal(alpha, *plan.split, plan.band);
    });
    return kernels;
}

/// Levels and irradiance of what the extraction left, by the transform; levels it cannot do are left empty,
/// or hold their far part.
std::optional<BakedEnvironment> transform_levels(const RadianceView& view,
                                                 const RadianceStatistics& statistics,
                                                 const BakeSettings& settings, const Plan& plan,
                                                 Progress& progress) {
    const BakeControl& control = progress.control;
    Stopwatch stopwatch;
    BakedEnvironment baked;
    std::vector<std::vector<double>> kernels = make_kernels(settings.roughness, plan, control);
    std::size_t degrees = 0;
    for (const std::vector<double>& kernel : kernels) degrees = std::max(degrees, kernel.size());
    if (degrees == 0) {  // copies only
        for (const float roughness : settings.roughness) baked.levels.push_back({roughness, {}});
        return baked;
    }
    const LegendreTables tables(int(degrees) - 1, control.parallel_for);
    if (control.stop.stop_requested()) return std::nullopt;
    const ShCoefficients coefficients = analyse(view, tables, control);
    if (control.stop.stop_requested()) return std::nullopt;
    progress.add(3.0);
    const std::vector<double> power = power_spectrum(coefficients);
    Synthesis synthesis(coefficients, control);
    const auto make_level = [&](std::vector<double>& kernel, int size) {
        const float share = float(kernel.front());  // of the whole kernel: 1 but for far parts
        const Synthesis::Range range = {share * statistics.lowest, share * statistics.highest};
        truncate(kernel, power, kTruncation * statistics.error_scale);
        return synthesis.to_cube(kernel, size, range);
    };
    baked.timings.transform_ms = stopwatch.lap_ms();
    const int irradiance_size = face_size(1.0f, std::min(plan.largest_face, settings.max_face_size));
    if (plan.irradiance) baked.irradiance = make_level(kernels.back(), irradiance_size);
    baked.timings.irradiance_ms = stopwatch.lap_ms();
    for (std::size_t i = 0; i < settings.roughness.size(); ++i) {
        const float roughness = settings.roughness[i];
        PrefilteredLevel level{roughness, {}};
        const int size = level_size(settings, i, plan.largest_face);
        if (roughness == 1.0f && size == baked.irradiance.size)
            level.cube = baked.irradiance;
        else if (i > 0 && roughness == settings.roughness[i - 1] && size == baked.levels.back().cube.size)
            level.cube = baked.levels.back().cube;
        else if (!kernels[i].empty())
            level.cube = make_level(kernels[i], size);
        baked.levels.push_back(std::move(level));
        if (control.stop.stop_requested()) return std::nullopt;
        progress.add(level_cost(roughness));
    }
    baked.timings.levels_ms = stopwatch.lap_ms();
    return baked;
}

/// What levels are finished with.
struct Sources {
    const Environment& environment;
    const LightExtraction& extraction;
    const std::optional<NearField>& near;
    const std::optional<KernelSplit>& split;
};

/// What the transform leaves to do: the near part of sharp levels, copies at roughness 0, lights that were
/// only taken out to be put back exactly. False when stopped.
bool finish_levels(const Sources& sources, const BakeSettings& settings, const BakeControl& control,
                   BakedEnvironment& baked) {
    const bool put_back = !settings.extract_lights;
    Stopwatch stopwatch;
    for (std::size_t i = 0; i < baked.levels.size(); ++i) {
        PrefilteredLevel& level = baked.levels[i];
        const bool is_split = !is_transformed(level.roughness);
        if (level.roughness <= 0.0f)
            level.cube = resample_environment(
                sources.environment, level_size(settings, i, settings.max_face_size), control.parallel_for);
        else if (is_split)
            sources.near->add(double(level.roughness) * level.roughness, *sources.split, level.cube, control);
        baked.timings.levels_ms += stopwatch.lap_ms();
        if (put_back)
            fold_back(sources.extraction, level.roughness, is_split ? sources.split : std::nullopt,
                      level.cube, control);
        baked.timings.lights_ms += stopwatch.lap_ms();
        if (control.stop.stop_requested()) return false;
    }
    if (put_back) fold_back(sources.extraction, 1.0f, std::nullopt, baked.irradiance, control);
    baked.timings.lights_ms += stopwatch.lap_ms();
    return !control.stop.stop_requested();
}

}  // namespace

void serial_for(int count, const std::function<void(int)>& body) {
    for (int i = 0; i < count; ++i) body(i);
}

std::vector<float> standard_roughness_levels() {
    std::vector<float> levels;
    levels.reserve(kLevelCount);
    for (int i = 0; i < kLevelCount; ++i)
        levels.push_back(float(std::pow(10.0, double(i) / (kLevelCount - 1) - 1.0)));
    levels.back() = 1.0f;
    return levels;
}

std::optional<BakedEnvironment> bake_environment(const Environment& environment, const BakeSettings& settings,
                                                 const BakeControl& control) {
    assert(environment.width > 0 && environment.height > 0);
    assert(settings.face_sizes.empty() || settings.face_sizes.size() == settings.roughness.size());
    Progress progress{control, 4.0};
    for (const float roughness : settings.roughness) progress.total += level_cost(roughness);
    Stopwatch stopwatch;
    RadianceStatistics statistics = radiance_statistics(view_of(environment), control.parallel_for);
    const glm::vec3 peak = statistics.highest;
    const bool is_strong = std::max({peak.x, peak.y, peak.z}) > kStrongLight * statistics.mean;
    const float sharpest = settings.roughness.empty() ? 1.0f : settings.roughness.front();
    // A small bright light has energy in every degree, and a cut-off spectrum would turn it into rings.
    LightExtraction extraction;
    extraction.residual = view_of(environment);
    if (settings.extract_lights || is_strong || sharpest < kStandardSharpest)
        extraction = extract_lights(environment, statistics, {});
    if (!extraction.lights.empty())
        statistics = radiance_statistics(extraction.residual, control.parallel_for);
    const double extract_ms = stopwatch.lap_ms();

    Plan plan = {.band = sharpest < kStandardSharpest ? kSharpBand : kStandardBand,
                 .irradiance = settings.irradiance,
                 .split = {}};
    std::optional<NearField> near;
    if (std::ranges::any_of(settings.roughness, [](float r) { return r > 0.0f && !is_transformed(r); })) {
        near.emplace(settings.extract_lights ? extraction.residual : view_of(environment), control);
        plan.split = near->split();
    }
    std::optional<BakedEnvironment> baked =
        transform_levels(extraction.residual, statistics, settings, plan, progress);
    if (!baked || !finish_levels({environment, extraction, near, plan.split}, settings, control, *baked))
        return std::nullopt;
    if (settings.extract_lights) baked->lights = extraction.lights;
    baked->timings.lights_ms += extract_ms;
    progress.add(progress.total);
    return baked;
}

std::optional<BakedEnvironment> bake_first_light(const Environment& environment, const BakeSettings& settings,
                                                 const BakeControl& control) {
    RadianceView some = view_of(environment);  // reading all of a large picture would take longer than this
    const int step = std::max(1, environment.height / kMostFirstRows);
    for (int y = 0; y < environment.height / step; ++y)
        some.rows[y] = some.rows[std::size_t(y) * step + step / 2];
    some.height = environment.height / step;
    const Environment small = reduce(some, 128, 64, control.parallel_for);
    BakeSettings smooth = settings;  // sharper levels hold the sharpest that few degrees can
    constexpr float sharpest = 0.25f;
    for (float& roughness : smooth.roughness) roughness = std::max(roughness, sharpest);
    Progress progress{control, 4.0 + double(settings.roughness.size()) * 3.0};
    const Plan plan = {.band = 32, .largest_face = 32};
    RadianceStatistics statistics = radiance_statistics(view_of(small), control.parallel_for);
    LightExtraction extraction;
    extraction.residual = view_of(small);
    if (settings.extract_lights) {  // of so few degrees a small sun would be rings all over the object
        extraction = extract_lights(small, statistics, {.largest_rms_radius_rad = kSmearedLight});
        statistics = radiance_statistics(extraction.residual, control.parallel_for);
    }
    std::optional<BakedEnvironment> baked =
        transform_levels(extraction.residual, statistics, smooth, plan, progress);
    if (!baked) return std::nullopt;
    baked->lights = extraction.lights;
    for (std::size_t i = 0; i < settings.roughness.size(); ++i)
        baked->levels[i].roughness = settings.roughness[i];
    progress.add(progress.total);
    return baked;
}

}  // namespace patina
