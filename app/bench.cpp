#include "app/bench.h"

#include "app/bench_stage.h"
#include "app/jobs.h"
#include "app/paths.h"
#include "app/temporary_folder.h"
#include "materials/material_io.h"
#include "materials/text_io.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace patina {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

struct FrameCase {
    std::string name;
    Scene scene;
};

/// What a frame may be asked for: every shading mode, then what features and the background add.
std::vector<FrameCase> frame_cases(SceneLoader& loader, const std::string& environment) {
    std::vector<FrameCase> cases;
    SceneOptions options;
    const auto add = [&](const std::string& name, const std::string& preset) {
        Scene scene = loader.scene(preset, options);
        scene.environment = loader.environment(environment);
        cases.push_back({name, std::move(scene)});
    };
    options.view.background = Background::Plain;
    options.view.shading = Shading::SplitSum;
    options.size_px = {};  // drawn in several sizes: maps with all detail
    add("split-sum", "-");
    for (const auto& mode : kShadings) {
        if (mode.value == Shading::SplitSum || mode.value == Shading::Reference) continue;
        options.view.shading = mode.value;
        add(std::string(mode.id), "-");
    }
    options.view.shading = Shading::Fitted;
    options.view.quality = Quality::High;
    add("fitted, high quality", "-");
    options.view.quality = Quality::Standard;
    options.overrides = {{"roughness", "0.02"}};
    add("fitted, near mirror", "-");
    options.view.shading = Shading::SplitSum;
    add("split-sum, near mirror", "-");
    options.overrides.clear();
    for (const fs::path& preset : shipped_presets())
        if (!map_sources(load_material(preset).material, preset).empty())
            add("split-sum, " + path_to_utf8(preset.stem()), path_to_utf8(preset));
    options.view.background = Background::Environment;
    add("split-sum, environment behind", "-");
    return cases;
}

}  // namespace

double median(std::vector<double> values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

double milliseconds(const std::function<void()>& action) {
    const auto start = std::chrono::steady_clock::now();
    action();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

std::vector<double> interleaved_medians_ms(const std::vector<std::function<void()>>& actions,
                                           int repetitions) {
    std::vector<std::vector<double>> times(actions.size());
    for (const auto& action : actions) action();
    for (int repetition = 0; repetition < repetitions; ++repetition)
        for (std::size_t k = 0; k < actions.size(); ++k) {
            const std::size_t i = repetition % 2 == 0 ? k : actions.size() - 1 - k;
            times[i].push_back(milliseconds(actions[i]));
        }
    std::vector<double> medians;
    medians.reserve(times.size());
    for (const auto& each : times) medians.push_back(median(each));
    return medians;
}

Json bench_frame(const BenchContext& context) {
    BenchStage stage;
    Renderer& renderer = stage.renderer;
    SceneLoader loader = stage.loader(context.registry);
    Json json{{"renderer", stage.context.description()},
              {"environment", context.environments.front()},
              {"cases", Json::array()}};
    std::vector<FrameCase> cases = frame_cases(loader, context.environments.front());
    std::printf("%-36s %8s %10s %10s\n", "frame", "size", "ms", "split-sum=1");
    for (const int side : {256, 512, 1024}) {
        const TargetHandle target = renderer.make_target({side, side});
        std::vector<std::function<void()>> actions;
        actions.reserve(cases.size());
        for (FrameCase& each : cases)
            actions.push_back([&] {
                renderer.draw(each.scene, *target);
                renderer.read_display(*target);  // waits until it is drawn
            });
        const std::vector<double> ms = interleaved_medians_ms(actions, context.repetitions());
        for (std::size_t i = 0; i < cases.size(); ++i) {
            std::printf("%-36s %8d %10.2f %10.2f\n", cases[i].name.c_str(), side, ms[i], ms[i] / ms[0]);
            json["cases"].push_back(
                {{"name", cases[i].name}, {"side_px", side}, {"ms", ms[i]}, {"ratio", ms[i] / ms[0]}});
        }
    }
    return json;
}

Json bench_light(const BenchContext& context) {
    const Jobs jobs(worker_count());
    const TemporaryFolder folder("patina-bench");
    const BakeCache cache{.folder = folder.path()};
    Json json{{"environments", Json::array()}};
    std::printf("%-36s %10s %10s %10s\n", "light (ms)", "load", "bake", "cached");
    for (const std::string& id : context.environments) {
        const Environment environment = load_environment(context.registry, id);
        const BakeControl control{.parallel_for = jobs.parallel_for()};
        const std::string key = bake_key(environment, drawing_bake_settings());
        const std::vector<double> ms = interleaved_medians_ms(
            {[&] { load_environment(context.registry, id); },
             [&] {
                 save_baked(cache, key, *bake_environment(environment, drawing_bake_settings(), control));
             },
             [&] { load_baked(cache, key); }},
            context.repetitions());
        std::printf("%-36s %10.1f %10.1f %10.1f\n", path_to_utf8(utf8_to_path(id).filename()).c_str(), ms[0],
                    ms[1], ms[2]);
        json["environments"].push_back({{"id", id},
                                        {"width", environment.width},
                                        {"height", environment.height},
                                        {"load_ms", ms[0]},
                                        {"bake_and_save_ms", ms[1]},
                                        {"cached_ms", ms[2]}});
    }
    return json;
}

}  // namespace patina
