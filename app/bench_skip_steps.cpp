// `patina bench skip`, what an artist does: one step after another in one process.
#include "app/bench_skip.h"
#include "app/bench_stage.h"
#include "app/stats.h"
#include "app/temporary_folder.h"
#include "app/view_pace.h"
#include "materials/text_io.h"
#include "renderer/core/image_io.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <utility>
#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

namespace patina {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr int kSidePx = 512;

/// MiB that this process has allocated, the driver's part included where it draws in software; 0 where the C
/// library does not tell.
double allocated_mib() {
#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 33)
    const struct mallinfo2 info = mallinfo2();
    return double(info.uordblks + info.hblkhd) / 1048576.0;
#else
    return 0.0;
#endif
}

/// One way of doing a step, with skipping or without.
struct Cost {
    std::vector<double> ms;
    double mib = 0.0;  ///< allocated when the step is done
    WorkLedger work;   ///< of one step
};

Json to_json(const Cost& cost) {
    return {{"ms", median(cost.ms)}, {"mib", cost.mib}, {"work", to_json(cost.work).at("work")}};
}

/// costs: with skipping and without.
Json row_of(const std::string& name, const std::array<Cost, 2>& costs) {
    return {{"name", name},
            {"skip", to_json(costs[0])},
            {"no_skip", to_json(costs[1])},
            {"ratio", median(costs[0].ms) / median(costs[1].ms)}};
}

void print_head(const char* what) {
    std::printf("\n%-34s %9s %9s %6s  %9s %9s\n", what, "ms", "no skip", "ratio", "MiB", "no skip");
}
void print_row(const Json& row) {
    const auto value = [&](const char* side, const char* key) { return row[side][key].get<double>(); };
    std::printf("%-34s %9.1f %9.1f %6.2f  %9.1f %9.1f\n", row["name"].get<std::string>().c_str(),
                value("skip", "ms"), value("no_skip", "ms"), row["ratio"].get<double>(), value("skip", "mib"),
                value("no_skip", "mib"));
}

// --- a step of the hand ---

/// Draws all, and waits until they are drawn.
void draw_all_views(Renderer& renderer, const std::vector<Scene>& scenes,
                    const std::vector<TargetHandle>& targets) {
    for (std::size_t i = 0; i < scenes.size(); ++i)
        renderer.draw(scenes[i], *targets[i], scenes.size() > 1 ? Reuse::Expected : Reuse::IfRepeated);
    renderer.read_display(*targets.back());
}

struct Step {
    std::string name;
    std::vector<std::string> presets, lights;
    int side_px = kSidePx;
    void (*change)(Scene&) = nullptr;
};

void turn_light(Scene& scene) { scene.view.env_rotation_deg += 3.0f; }
void move_slider(Scene& scene) {
    float& value = scene.material.roughness.value;
    value = value > 0.9f ? 0.4f : value + 0.01f;
}
void orbit(Scene& scene) { scene.camera.yaw_deg += 2.0f; }

/// Pixels a side of each of nine views.
int third_of(const BenchContext& context) { return context.quick ? 200 : 300; }

std::vector<Step> steps(int third_px) {
    const std::vector<std::string> one{"studio"}, three{"studio", "sky", "sunset"},
        four{"studio", "sky", "sunset", "night"};
    const std::string third = std::to_string(third_px), whole = std::to_string(3 * third_px);
    return {{"slider drag, plastic", {"plastic-glossy-red"}, one, kSidePx, move_slider},
            {"slider drag, worn paint", {"worn-paint"}, one, kSidePx, move_slider},
            {"light rotation, plastic", {"plastic-glossy-red"}, one, kSidePx, turn_light},
            {"light rotation, worn paint", {"worn-paint"}, one, kSidePx, turn_light},
            {"orbit, worn paint", {"worn-paint"}, one, kSidePx, orbit},
            {"light rotation, 4 views", {"worn-paint"}, four, kSidePx, turn_light},
            {"orbit, 4 views", {"worn-paint"}, four, kSidePx, orbit},
            {"light rotation, 1 view of " + whole, {"gold"}, one, 3 * third_px, turn_light},
            {"light rotation, 1 view of " + third, {"gold"}, one, third_px, turn_light},
            {"light rotation, 9 views of " + third,
             {"gold", "worn-paint", "porcelain"},
             three,
             third_px,
             turn_light}};
}

struct StepViews {
    std::vector<Scene> scenes;
    std::vector<TargetHandle> targets;
};

StepViews views_of(const Step& step, SceneLoader& loader, Renderer& renderer) {
    StepViews views;
    for (const std::string& preset : step.presets)
        for (const std::string& light : step.lights) {
            views.scenes.push_back(loader.scene(preset, SceneOptions{.size_px = glm::ivec2(step.side_px)}));
            views.scenes.back().environment = loader.environment(light);
            views.targets.push_back(renderer.make_target(glm::ivec2(step.side_px)));
        }
    return views;
}

/// Adds the fastest of some, after one that compiles and may rasterise.
void add_step(const Step& step, StepViews& views, Renderer& renderer, int times, Cost& cost) {
    double fastest = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= times; ++k) {
        for (Scene& scene : views.scenes) step.change(scene);
        const WorkLedger before = renderer.work();
        const double ms = milliseconds([&] { draw_all_views(renderer, views.scenes, views.targets); });
        cost.work = since(renderer.work(), before);
        if (k > 0) fastest = std::min(fastest, ms);
    }
    cost.ms.push_back(fastest);
    cost.mib = allocated_mib();
}

Json bench_steps(BenchStage& stage, const BenchContext& context) {
    SceneLoader loader = stage.loader(context.registry);
    Json rows = Json::array();
    print_head("one step");
    for (const Step& step : steps(third_of(context))) {
        StepViews views = views_of(step, loader, stage.renderer);
        std::array<Cost, 2> costs;
        for (int i = 0; i < context.repetitions(); ++i)
            for (const int which : {i % 2, 1 - i % 2}) {
                stage.renderer.set_reuse(which == 0);
                add_step(step, views, stage.renderer, context.quick ? 1 : 3, costs[std::size_t(which)]);
            }
        rows.push_back(row_of(step.name, costs));
        print_row(rows.back());
    }
    stage.renderer.set_reuse(true);
    return rows;
}

/// What sharing costs and saves, from the steps above.
Json shared_views(const Json& steps, int third_px) {
    const auto ms = [&](const std::string& name, const char* side) {
        for (const Json& row : steps)
            if (row.at("name").get<std::string>().starts_with(name))
                return row.at(side).at("ms").get<double>();
        throw std::logic_error("bench skip: there is no step '" + name + "'");
    };
    const double orbit = ms("orbit, 4 views", "skip");
    const auto one_of = [&](int side_px) {
        return ms("light rotation, 9 views", "skip") /
               ms("light rotation, 1 view of " + std::to_string(side_px), "skip");
    };
    const std::array<std::pair<const char*, double>, 4> rows{
        {{"4 views rasterised once and shaded / shaded alone", orbit / ms("light rotation, 4 views", "skip")},
         {"4 views rasterised once and shaded / 4 independent", orbit / ms("orbit, 4 views", "no_skip")},
         {"light of 9 views turned / of one of them", one_of(third_px)},
         {"light of 9 views turned / of one as large as all", one_of(3 * third_px)}}};
    Json json = Json::array();
    std::printf("\n");
    for (const auto& [name, ratio] : rows) {
        std::printf("%-56s %6.2f\n", name, ratio);
        json.push_back({{"name", name}, {"ratio", ratio}});
    }
    return json;
}

// --- a preset's maps, from their files to the GPU ---

Json bench_maps(BenchStage& stage, const BenchContext& context) {
    std::array<Cost, 2> costs;
    const std::string mesh = context.mesh.empty() ? "sphere" : context.mesh;
    const auto load = [&](bool skip, Cost& cost) {
        SceneLoader loader(stage.renderer, context.registry, {.skip = skip});
        loader.mesh(mesh, true);
        const double before_mib = allocated_mib();
        const WorkLedger before = stage.renderer.work();
        Scene scene;
        cost.ms.push_back(milliseconds(
            [&] { scene = loader.scene(context.preset, {.mesh = mesh, .size_px = glm::ivec2(kSidePx)}); }));
        cost.mib = allocated_mib() - before_mib;
        cost.work = since(stage.renderer.work(), before);
    };
    for (int i = 0; i < context.repetitions(); ++i)
        for (const int which : {i % 2, 1 - i % 2}) load(which == 0, costs[std::size_t(which)]);
    Json row = row_of("its maps, from file to GPU", costs);
    print_head("maps");
    print_row(row);
    return row;
}

// --- another environment, until the picture under it is there ---

/// Milliseconds of one visit to an environment, from a picture under another one.
struct Visit {
    double light = 0.0;  ///< until its light is on the GPU
    double first = 0.0;  ///< until the editor's first picture under it is drawn and read back
    double seen = 0.0;   ///< likewise a good picture, drawn at once
    double drawn = 0.0;  ///< of that, drawing: the same change once more, with both lights there
    double mib = 0.0;    ///< allocated for it
    WorkLedger work;
};

struct SwitchRun {
    static constexpr std::array kNames{"cold", "disk cache", "memory"};
    std::array<std::array<std::vector<Visit>, kNames.size()>, 2> visits;  ///< with skipping and without
    std::vector<double> decode;
};

Visit visit_environment(BenchStage& stage, SceneLoader& loader, const Scene& before,
                        const std::string& environment) {
    const Pace first = ViewPace(Renderer::is_software()).while_moving();
    const auto target_at = [&](Pace pace) {
        return stage.renderer.make_target(drawn_px(pace, glm::ivec2(kSidePx)), samples_a_pixel(pace));
    };
    const TargetHandle first_target = target_at(first), target = target_at(Pace::Good);
    const auto draw = [&](const Scene& scene, RenderTarget& into) {
        stage.renderer.draw(scene, into, Reuse::IfRepeated);
        stage.renderer.read_display(into);
    };
    Scene scene = before;
    Visit visit;
    draw(before, *first_target);
    draw(before, *target);
    const double before_mib = allocated_mib();
    const WorkLedger work = stage.renderer.work();
    visit.seen = milliseconds([&] {
        visit.light = milliseconds(
            [&] { scene.environment = loader.environment(environment, loader.needed_light(scene)); });
        draw(scene, *target);
    });
    visit.mib = allocated_mib() - before_mib;
    visit.work = since(stage.renderer.work(), work);
    draw(before, *target);
    visit.drawn = milliseconds([&] { draw(scene, *target); });
    visit.first = visit.light + milliseconds([&] { draw(scene, *first_target); });
    return visit;
}

SwitchRun run_switch(BenchStage& stage, const BenchContext& context, const std::string& environment) {
    SwitchRun run;
    const EnvironmentHandle before = stage.loader(context.registry).environment("furnace");
    for (int i = 0; i < context.repetitions() + 2; ++i) {
        run.decode.push_back(milliseconds([&] { load_environment(context.registry, environment); }));
        for (const int which : {i % 2, 1 - i % 2}) {
            const TemporaryFolder cache("patina-skip");
            stage.renderer.set_reuse(which == 0);
            auto& visits = run.visits[std::size_t(which)];
            for (const std::size_t from : {0u, 1u}) {  // nowhere, disk
                SceneLoader loader(stage.renderer, context.registry,
                                   {.parallel_for = stage.jobs.parallel_for(),
                                    .cache = {.folder = cache.path()},
                                    .skip = which == 0});
                Scene scene = loader.scene("plastic-glossy-red", SceneOptions{});
                scene.environment = before;
                visits[from].push_back(visit_environment(stage, loader, scene, environment));
                if (from == 1) visits[2].push_back(visit_environment(stage, loader, scene, environment));
            }
        }
    }
    stage.renderer.set_reuse(true);
    return run;
}

Json to_json(const std::vector<Visit>& visits) {
    const auto median_of = [&](auto value) {
        std::vector<double> values(visits.size());
        std::ranges::transform(visits, values.begin(), value);
        return median(std::move(values));
    };
    return {{"light_ready_ms", median_of(&Visit::light)},
            {"first_picture_ms", median_of(&Visit::first)},
            {"drawing_ms", median_of(&Visit::drawn)},
            {"seen_ms", median_of(&Visit::seen)},
            {"seen_less_drawing_ms", median_of([](const Visit& each) { return each.seen - each.drawn; })},
            {"mib", median_of(&Visit::mib)},
            {"work", to_json(visits.back().work).at("work")}};
}

Json bench_switch(BenchStage& stage, const BenchContext& context, const std::string& environment) {
    const SwitchRun run = run_switch(stage, context, environment);
    const double decode = median(run.decode);
    const std::string name = path_to_utf8(utf8_to_path(environment).filename());
    Json json{{"environment", name}, {"decode_ms", decode}, {"cases", Json::array()}};
    std::printf("\n%-34s %8s %8s %8s %8s %10s %8s %6s %8s   (decoding alone %.1f ms)\n",
                ("environment " + name).c_str(), "light ms", "first", "drawing", "seen ms", "less draw",
                "no skip", "MiB", "no skip", decode);
    for (std::size_t from = 0; from < SwitchRun::kNames.size(); ++from) {
        const Json own = to_json(run.visits[0][from]), all = to_json(run.visits[1][from]);
        const auto value = [](const Json& side, const char* key) { return side.at(key).get<double>(); };
        std::printf("%-34s %8.1f %8.1f %8.1f %8.1f %10.1f %8.1f %6.1f %8.1f\n", SwitchRun::kNames[from],
                    value(own, "light_ready_ms"), value(own, "first_picture_ms"), value(own, "drawing_ms"),
                    value(own, "seen_ms"), value(own, "seen_less_drawing_ms"), value(all, "seen_ms"),
                    value(own, "mib"), value(all, "mib"));
        json["cases"].push_back({{"name", SwitchRun::kNames[from]}, {"skip", own}, {"no_skip", all}});
    }
    return json;
}

}  // namespace

void bench_skip_steps(const BenchContext& context, Json& json) {
    BenchStage stage;
    json["renderer"] = stage.context.description();
    json["steps"] = bench_steps(stage, context);
    json["shared_views"] = shared_views(json["steps"], third_of(context));
    if (!context.preset.empty()) json["maps"] = bench_maps(stage, context);
    const TemporaryFolder folder("patina-skip");
    const fs::path large = folder.path() / "studio-4k.exr";  // as a photographer's panorama
    save_image(large, radiance_image(builtin_environments().front().make(4096)));
    json["environment_switch"] = Json::array();
    for (const std::string& environment : {context.environments.back(), path_to_utf8(large)})
        json["environment_switch"].push_back(bench_switch(stage, context, environment));
}

}  // namespace patina
