// `patina bench ibl`: run time against error of prefiltering, method by method.
#include "app/bench.h"
#include "app/jobs.h"
#include "app/paths.h"
#include "app/scene_loader.h"
#include "renderer/ibl/bench.h"

#include <nlohmann/json.hpp>

#include <cstdio>

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

}  // namespace

Json bench_ibl(const BenchContext& context) {
    const Jobs jobs(worker_count());
    IblBenchOptions options;
    options.parallel_for = jobs.parallel_for();
    options.repetitions = context.repetitions();
    if (context.quick) {
        options.roughness = {0.1f, 0.3f, 1.0f};
        options.samples = {64, 1024};
        options.error_texels = 20;
    }
    Json json{{"instruction_set", ibl_instruction_set()}, {"environments", Json::array()}};
    for (const std::string& id : context.environments) {
        const auto result = ibl_bench(load_environment(context.registry, id), options, {});
        if (!result) continue;
        print_environment(*result);
        json["environments"].push_back(to_json(*result));
    }
    return json;
}

}  // namespace patina
