#include "renderer/ibl/bake.h"

#include "renderer/ibl/sampling.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <utility>

namespace patina {
namespace {

constexpr int kLevelCount = 16;
constexpr int kSamples = 256;

/// Milliseconds since the last lap.
class StopWatch {
public:
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        return std::chrono::duration<double, std::milli>(now - std::exchange(last_, now)).count();
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Smooth levels need fewer texels: bilinear reconstruction then errs less than the levels themselves.
int face_size(float roughness, int largest) {
    const int size = roughness < 0.0999f ? 256 : roughness < 0.25f ? 128 : roughness < 0.6f ? 64 : 32;
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
    StopWatch watch;
    int source_size = 16;
    while (source_size < environment.width / 4 && source_size < 1024) source_size *= 2;
    const CubePyramid source(environment, source_size, control.parallel_for);
    BakedEnvironment baked;
    baked.timings.transform_ms = watch.lap();
    const float steps = float(settings.roughness.size() + 1);
    for (const float roughness : settings.roughness) {
        if (control.stop.stop_requested()) return std::nullopt;
        const int size = face_size(roughness, settings.max_face_size);
        baked.levels.push_back(
            {roughness, prefilter_by_sampling(source, roughness, kSamples, size, control)});
        control.progress(float(baked.levels.size()) / steps);
    }
    baked.timings.levels_ms = watch.lap();
    // At roughness 1 D is constant and the kernel is NoL: that level is E/π.
    baked.irradiance =
        prefilter_by_sampling(source, 1.0f, 4 * kSamples, face_size(1.0f, settings.max_face_size), control);
    baked.timings.irradiance_ms = watch.lap();
    if (control.stop.stop_requested()) return std::nullopt;
    control.progress(1.0f);
    return baked;
}

}  // namespace patina
