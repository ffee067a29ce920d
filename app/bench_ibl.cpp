// `patina bench ibl`: run time against error of prefiltering, method by method; scaling, memory, the cache
// and the faces' sizes.
#include "app/bench.h"
#include "app/jobs.h"
#include "app/paths.h"
#include "app/scene_loader.h"
#include "app/temporary_folder.h"
#include "renderer/ibl/bench.h"
#include "renderer/ibl/cache.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#if __has_include(<sys/resource.h>)
#include <sys/resource.h>
#endif

namespace patina {

using Json = nlohmann::ordered_json;

namespace {

void print_environment(const IblBenchEnvironment& e) {
    std::printf("%s, %d × %d, peak/mean %.0f: bake %.1f ms, first light %.1f ms\n", e.id.c_str(), e.width,
                e.height, e.peak_over_mean, e.bake_ms, e.first_light_ms);
    std::printf("  %-16s %9s %6s %10s %9s %9s %9s\n", "method", "roughness", "face", "ms", "rms %", "p95 %",
                "max %");
    for (const IblBenchLevel& level : e.levels)
        std::printf("%s %-16s %9.3f %6d %10.2f %9.4f %9.4f %9.4f\n", level.on_front ? "*" : " ",
                    level.method.c_str(), double(level.roughness), level.face_size, level.time_ms,
                    100.0 * level.rms, 100.0 * level.p95, 100.0 * level.max);
}

Json to_json(const IblBenchEnvironment& e) {
    Json json{{"id", e.id},
              {"width", e.width},
              {"height", e.height},
              {"peak_over_mean", e.peak_over_mean},
              {"bake_ms", e.bake_ms},
              {"first_light_ms", e.first_light_ms},
              {"stages_ms",
               {{"transform", e.stages.transform_ms},
                {"levels", e.stages.levels_ms},
                {"irradiance", e.stages.irradiance_ms},
                {"lights", e.stages.lights_ms}}},
              {"levels", Json::array()}};
    for (const IblBenchLevel& level : e.levels)
        json["levels"].push_back({{"method", level.method},
                                  {"roughness", level.roughness},
                                  {"face_size", level.face_size},
                                  {"ms", level.time_ms},
                                  {"rms", level.rms},
                                  {"p95", level.p95},
                                  {"max", level.max},
                                  {"on_front", level.on_front}});
    return json;
}

/// The most memory the process has held so far; 0 where the system does not say.
double peak_mib() {
#if __has_include(<sys/resource.h>)
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
    return double(usage.ru_maxrss) / 1048576.0;
#else
    return double(usage.ru_maxrss) / 1024.0;
#endif
#else
    return 0.0;
#endif
}

/// Time and memory by the panorama's width, on one thread and on all.
Json scaling(const BenchContext& context, const Environment& source, const ParallelFor& all) {
    Json rows = Json::array();
    std::printf("%-10s %8s %10s %12s %14s %12s\n", "size", "threads", "bake ms", "first ms", "ns a texel",
                "memory MiB");
    for (const int width :
         context.quick ? std::vector{512, 1024, 2048} : std::vector{512, 1024, 2048, 4096, 8192}) {
        const Environment environment = ibl_resized(source, width);
        const double before = peak_mib();
        for (const bool is_serial : {true, false}) {
            const BakeControl control{.parallel_for = is_serial ? ParallelFor(serial_for) : all, .stop = {}};
            const std::vector<double> ms =
                interleaved_medians_ms({[&] { bake_environment(environment, {}, control); },
                                        [&] { bake_first_light(environment, {}, control); }},
                                       3);
            const double texels = double(environment.width) * environment.height;
            const int threads = is_serial ? 1 : worker_count();
            const double memory = std::max(0.0, peak_mib() - before);
            std::printf("%4dx%-5d %8d %10.1f %12.2f %14.1f %12.1f\n", environment.width, environment.height,
                        threads, ms[0], ms[1], ms[0] * 1e6 / texels, memory);
            rows.push_back({{"width", environment.width},
                            {"height", environment.height},
                            {"threads", threads},
                            {"bake_ms", ms[0]},
                            {"first_light_ms", ms[1]},
                            {"peak_growth_mib", memory}});
        }
    }
    return rows;
}

/// What keeping a bake costs, and what reading it back saves.
Json cache_times(const BenchContext& context, const Environment& environment, const ParallelFor& all) {
    const TemporaryFolder folder("patina-bench");
    const BakeCache cache{.folder = folder.path()};
    const BakeControl control{.parallel_for = all, .stop = {}};
    const std::vector<double> ms =
        interleaved_medians_ms({[&] {
                                    std::error_code ignored;
                                    std::filesystem::remove_all(folder.path(), ignored);
                                    cached_bake(environment, {}, control, cache);
                                },
                                [&] { cached_bake(environment, {}, control, cache); }},
                               context.repetitions());
    std::printf("cache: cold (bake and keep) %.1f ms, warm %.2f ms\n", ms[0], ms[1]);
    return {{"cold_ms", ms[0]}, {"warm_ms", ms[1]}};
}

Json fetch_errors(const BenchContext& context, const Environment& environment, const ParallelFor& all) {
    const std::vector<float> roughness =
        context.quick ? std::vector{0.1f, 0.3f}
                      : std::vector{0.1f, 0.117f, 0.136f, 0.158f, 0.185f, 0.215f, 0.25f,
                                    0.3f, 0.4f,   0.54f,  0.63f,  0.74f,  1.0f};
    Json rows = Json::array();
    std::printf("%-10s %6s %22s\n", "roughness", "face", "bilinear look-up rms %");
    for (const IblFetchError& each : ibl_fetch_errors(environment, roughness, {32, 64, 128}, all)) {
        std::printf("%-10.3f %6d %22.3f\n", double(each.roughness), each.face_size, 100.0 * each.rms);
        rows.push_back({{"roughness", each.roughness}, {"face_size", each.face_size}, {"rms", each.rms}});
    }
    return rows;
}

}  // namespace

Json bench_ibl(const BenchContext& context) {
    const Jobs jobs(worker_count());
    IblBenchOptions options;
    options.parallel_for = jobs.parallel_for();
    options.repetitions = 3;
    if (context.quick) {
        options.roughness = {0.1f, 0.3f, 1.0f};
        options.bands = {128};
        options.samples = {64, 1024};
        options.direct_widths = {128};
        options.error_texels = 20;
    }
    Json json{{"instruction_set", ibl_instruction_set()},
              {"threads", worker_count()},
              {"environments", Json::array()}};
    const Environment first = load_environment(context.registry, context.environments.front());
    json["scaling"] = scaling(context, first, options.parallel_for);  // first, while little memory was held
    json["cache_ms"] = cache_times(context, first, options.parallel_for);
    json["fetch"] = fetch_errors(context, first, options.parallel_for);
    for (const std::string& id : context.environments) {
        const auto result = ibl_bench(load_environment(context.registry, id), options, {});
        if (!result) continue;
        print_environment(*result);
        json["environments"].push_back(to_json(*result));
    }
    return json;
}

}  // namespace patina
