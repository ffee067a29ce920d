// What views side by side cost: one turn of the light drawn in one view, and in nine of the same area
// together.
#include "app/bench.h"
#include "app/headless.h"
#include "app/jobs.h"
#include "app/paths.h"
#include "app/scene_loader.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cstdio>

namespace patina {

using Json = nlohmann::ordered_json;

namespace {

constexpr std::array kLights{"studio", "sky", "sunset"};
constexpr std::array kPresets{"gold", "worn-paint", "porcelain"};
constexpr int kSidePx = 900;

/// Turns the light of each scene a little, draws them all, and waits until they are drawn.
void turn_and_draw(Renderer& renderer, std::vector<Scene>& scenes, const std::vector<TargetHandle>& targets) {
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        scenes[i].view.env_rotation_deg += 3.0f;
        renderer.draw(scenes[i], *targets[i]);
    }
    renderer.read_display(*targets.back());
}

}  // namespace

Json bench_views(const BenchContext& context) {
    HeadlessContext gl;
    Renderer renderer;
    const Jobs jobs(worker_count());
    SceneLoader loader(renderer, context.registry,
                       {.parallel_for = jobs.parallel_for(), .cache = {.folder = cache_folder() / "ibl"}});
    std::vector<Scene> scenes;
    for (const char* preset : kPresets)
        for (const char* light : kLights) {
            scenes.push_back(loader.scene(preset, SceneOptions{}));
            scenes.back().environment = loader.environment(light);
        }
    const int third = kSidePx / 3;
    std::vector<TargetHandle> small(scenes.size());
    for (TargetHandle& target : small) target = renderer.make_target({third, third});
    const std::vector<TargetHandle> large{renderer.make_target({kSidePx, kSidePx})};
    const std::vector<TargetHandle> single{renderer.make_target({third, third})};
    std::vector<Scene> one{scenes.front()};
    std::vector<Scene> one_small{scenes.front()};
    const std::vector<double> ms = interleaved_medians_ms(
        {[&] { turn_and_draw(renderer, one, large); }, [&] { turn_and_draw(renderer, one_small, single); },
         [&] { turn_and_draw(renderer, scenes, small); }},
        context.repetitions());
    constexpr std::array names{"one view, 900", "one view, 300", "nine views, 300 each"};
    Json json{{"renderer", gl.description()}, {"cases", Json::array()}};
    std::printf("%-36s %10s %14s\n", "views: a turn of the light", "ms", "one view=1");
    for (std::size_t i = 0; i < names.size(); ++i) {
        std::printf("%-36s %10.2f %14.2f\n", names[i], ms[i], ms[i] / ms[0]);
        json["cases"].push_back({{"name", names[i]}, {"ms", ms[i]}, {"ratio", ms[i] / ms[0]}});
    }
    return json;
}

}  // namespace patina
