#include "renderer/ibl/bench.h"

#include "renderer/ibl/panorama.h"
#include "renderer/ibl/reference.h"
#include "renderer/ibl/sampling.h"
#include "renderer/ibl/sh_simd.h"

#include <algorithm>
#include <chrono>

namespace patina {
namespace {

/// The median time of several runs; the last result stays.
template <class Work>
double median_ms(int repetitions, const Work& work) {
    std::vector<double> times;
    for (int i = 0; i < std::max(1, repetitions); ++i) {
        const auto start = std::chrono::steady_clock::now();
        work();
        const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
        times.push_back(time.count());
    }
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
}

class Bench {
public:
    Bench(const Environment& environment, const IblBenchOptions& options, std::stop_token stop)
        : environment_(environment), options_(options) {
        control_.parallel_for = options.parallel_for;
        control_.stop = std::move(stop);
    }

    std::optional<IblBenchEnvironment> run() {
        result_.id = environment_.id;
        result_.width = environment_.width;
        result_.height = environment_.height;
        const RadianceStatistics s = radiance_statistics(view_of(environment_), serial_for);
        result_.peak_over_mean =
            s.mean > 0.0 ? std::max({s.highest.x, s.highest.y, s.highest.z}) / s.mean : 0.0;
        run_transform();
        if (!stopped()) run_sampling();
        if (stopped()) return std::nullopt;
        mark_front();
        return result_;
    }

private:
    bool stopped() const { return control_.stop.stop_requested(); }

    void add(const std::string& method, const PrefilteredLevel& level, double time_ms) {
        PrefilterProbe probe;
        probe.texels = options_.error_texels;
        probe.parallel_for = options_.parallel_for;
        const PrefilterError e = prefilter_error(level.cube, level.roughness, environment_, probe);
        result_.levels.push_back({method, level.roughness, level.cube.size, time_ms, e.rms, e.p95, e.max});
    }

    void run_transform() {
        std::optional<BakedEnvironment> baked;
        const BakeSettings standard;
        result_.bake_ms = median_ms(options_.repetitions,
                                    [&] { baked = bake_environment(environment_, standard, control_); });
        if (!baked) return;
        result_.stages = baked->timings;
        BakeSettings chosen;
        chosen.roughness = options_.roughness;
        for (const float roughness : options_.roughness) {
            BakeSettings one;
            one.roughness = {roughness};
            const double time = median_ms(options_.repetitions,
                                          [&] { baked = bake_environment(environment_, one, control_); });
            if (!baked) return;
            add("transform", baked->levels[0], time);
        }
        std::optional<BakedEnvironment> first;
        result_.first_light_ms = median_ms(options_.repetitions,
                                           [&] { first = bake_first_light(environment_, chosen, control_); });
        if (!first) return;
        const double share = result_.first_light_ms / double(std::max<std::size_t>(1, first->levels.size()));
        for (const PrefilteredLevel& level : first->levels)
            if (!stopped()) add("first light", level, share);
    }

    void run_sampling() {
        const CubePyramid source(environment_, 256, options_.parallel_for);
        for (const int samples : options_.samples)
            for (const float roughness : options_.roughness) {
                if (stopped()) return;
                const int size = roughness < 0.25f ? 128 : roughness < 0.6f ? 64 : 32;
                PrefilteredLevel level{roughness, {}};
                const double time = median_ms(samples > 1000 ? 1 : options_.repetitions, [&] {
                    level.cube = prefilter_by_sampling(source, roughness, samples, size, control_);
                });
                add("sampling " + std::to_string(samples), level, time);
            }
    }

    void mark_front() {
        for (IblBenchLevel& level : result_.levels)
            level.on_front =
                std::none_of(result_.levels.begin(), result_.levels.end(), [&](const IblBenchLevel& other) {
                    return other.roughness == level.roughness && other.time_ms < level.time_ms &&
                           other.rms < level.rms;
                });
    }

    const Environment& environment_;
    const IblBenchOptions& options_;
    BakeControl control_;
    IblBenchEnvironment result_;
};

}  // namespace

std::optional<IblBenchEnvironment> ibl_bench(const Environment& environment, const IblBenchOptions& options,
                                             std::stop_token stop) {
    return Bench(environment, options, std::move(stop)).run();
}

std::string ibl_instruction_set() { return simd::instruction_set(); }

}  // namespace patina
