// `patina bench skip`: what is saved by computing only what a picture needs. Every scenario is run as it is
// and with skipping off, in turn, and the pictures are compared.
#include "app/bench.h"
#include "app/bench_process.h"
#include "app/bench_stage.h"
#include "app/jobs.h"
#include "app/paths.h"
#include "app/stats.h"
#include "app/temporary_folder.h"
#include "materials/text_io.h"
#include "renderer/core/file_io.h"
#include "renderer/core/image_io.h"
#include "renderer/core/module_io.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

namespace patina {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr int kSidePx = 512;

double milliseconds(const std::function<void()>& action) {
    const auto begin = std::chrono::steady_clock::now();
    action();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

// --- whole commands, each a process: time, memory, ledger ---

struct CommandCase {
    std::string name;
    std::string arguments;
};

std::vector<CommandCase> command_cases(const BenchContext& context) {
    const std::string render = "render ";
    const std::string compare = "compare ";
    const std::string views = " --env ";
    std::vector<CommandCase> cases{
        {"uniform plastic", render + "plastic-glossy-red --env sky"},
        {"full metal", render + "gold --env sky"},
        {"textured, no normal map", render + "terrazzo --env sky"},
        {"everything on", render + "cooling-lava --env sky --mesh shaderball"},
        {"1 view", compare + "worn-paint" + views + "studio"},
        {"2 views", compare + "worn-paint" + views + "studio sky"},
        {"4 views", compare + "worn-paint" + views + "studio sky sunset night"},
        {"9 views", compare + "worn-paint gold porcelain" + views + "studio sky sunset"},
        {"14 views", compare + "worn-paint gold" + views + "studio sky sunset overcast night furnace test"}};
    if (context.preset.empty()) return cases;
    const std::string mesh = context.mesh.empty() ? "" : " --mesh " + quoted(utf8_to_path(context.mesh));
    cases.push_back({path_to_utf8(utf8_to_path(context.preset).filename()),
                     render + quoted(utf8_to_path(context.preset)) + " --env studio" + mesh});
    cases.push_back({"the same without maps", render + "- --env studio" + mesh});
    return cases;
}

struct CommandRun {
    double wall_ms = 0.0, cpu_ms = 0.0, peak_mib = 0.0;
    std::string work;  ///< the ledger, as JSON
};

CommandRun run_once(const CommandCase& each, bool skip, const fs::path& folder) {
    std::error_code ignored;
    fs::remove_all(folder / "cache", ignored);
    const fs::path stats = folder / "stats.json";
    const fs::path picture = folder / (skip ? "skip.png" : "all.png");
    const std::string command = quoted(program_folder() / "patina") + " " + each.arguments + " --size " +
                                std::to_string(kSidePx) + "x" + std::to_string(kSidePx) + " -o " +
                                quoted(picture) + " --stats " + quoted(stats) + (skip ? "" : " --no-skip") +
                                " 2> " + quoted(folder / "said.txt");
    CommandRun run;
    int status = 0;
    run.wall_ms = milliseconds([&] { status = std::system(command.c_str()); });
    if (status != 0) throw std::runtime_error("bench skip: " + each.name + " failed: " + command);
    const std::vector<std::byte> bytes = read_file(stats);
    const Json json = Json::parse(reinterpret_cast<const char*>(bytes.data()),
                                  reinterpret_cast<const char*>(bytes.data() + bytes.size()));
    run.cpu_ms = 1e3 * json.at("cpu_s").get<double>();
    run.peak_mib = json.at("peak_memory_bytes").get<double>() / 1048576.0;
    run.work = json.at("work").dump();
    return run;
}

struct PictureDifference {
    int largest = 0;  ///< of 8-bit codes
    int pixels = 0;   ///< that are not the same
};

PictureDifference difference(const fs::path& one, const fs::path& other) {
    const Image a = load_image(one).image;
    const Image b = load_image(other).image;
    if (a.bytes.size() != b.bytes.size()) return {255, a.width * a.height};
    PictureDifference found;
    const std::size_t channels = std::size_t(a.channels);
    for (std::size_t at = 0; at < a.bytes.size(); at += channels) {
        int largest = 0;
        for (std::size_t i = at; i < at + channels; ++i)
            largest = std::max(largest, std::abs(int(a.bytes[i]) - int(b.bytes[i])));
        found.largest = std::max(found.largest, largest);
        found.pixels += largest > 0 ? 1 : 0;
    }
    return found;
}

Json summary(const std::vector<CommandRun>& runs) {
    std::vector<double> wall, cpu, peak;
    for (const CommandRun& run : runs) {
        wall.push_back(run.wall_ms);
        cpu.push_back(run.cpu_ms);
        peak.push_back(run.peak_mib);
    }
    return {{"wall_ms", median(wall)},
            {"cpu_ms", median(cpu)},
            {"peak_mib", median(peak)},
            {"work", Json::parse(runs.front().work)}};
}

Json bench_commands(const BenchContext& context, int repetitions) {
    const TemporaryFolder folder("patina-skip");
    const char* shared_cache = std::getenv("XDG_CACHE_HOME");  // where the driver keeps compiled shaders, too
    const std::string before = shared_cache ? shared_cache : "";
    set_variable("XDG_CACHE_HOME", path_to_utf8(folder.path() / "cache"));
    set_variable("PATINA_CACHE_DIR", path_to_utf8(folder.path() / "cache" / "patina"));
    Json rows = Json::array();
    std::printf("%-28s %9s %9s %6s  %9s %9s %6s  %s\n", "picture, whole command", "CPU ms", "no skip",
                "ratio", "peak MiB", "no skip", "ratio", "pixels that differ, most");
    for (const CommandCase& each : command_cases(context)) {
        std::array<std::vector<CommandRun>, 2> runs;
        for (int i = 0; i < repetitions; ++i)
            for (const int which : {i % 2, 1 - i % 2})
                runs[std::size_t(which)].push_back(run_once(each, which == 0, folder.path()));
        const PictureDifference other = difference(folder.path() / "skip.png", folder.path() / "all.png");
        Json row{{"name", each.name},
                 {"skip", summary(runs[0])},
                 {"no_skip", summary(runs[1])},
                 {"largest_code_step", other.largest},
                 {"different_pixels", other.pixels}};
        const auto value = [&](const char* side, const char* key) { return row[side][key].get<double>(); };
        std::printf("%-28s %9.0f %9.0f %6.2f  %9.0f %9.0f %6.2f  %d, %d\n", each.name.c_str(),
                    value("skip", "cpu_ms"), value("no_skip", "cpu_ms"),
                    value("skip", "cpu_ms") / value("no_skip", "cpu_ms"), value("skip", "peak_mib"),
                    value("no_skip", "peak_mib"), value("skip", "peak_mib") / value("no_skip", "peak_mib"),
                    other.pixels, other.largest);
        rows.push_back(std::move(row));
    }
    set_variable("XDG_CACHE_HOME", before);
    return rows;
}

// --- what an artist does, in one process: time of a step ---

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

std::vector<Step> steps() {
    const std::vector<std::string> one{"studio"}, three{"studio", "sky", "sunset"},
        four{"studio", "sky", "sunset", "night"};
    const int third = 300;
    return {
        {"slider drag, plastic", {"plastic-glossy-red"}, one, kSidePx, move_slider},
        {"slider drag, worn paint", {"worn-paint"}, one, kSidePx, move_slider},
        {"light rotation, plastic", {"plastic-glossy-red"}, one, kSidePx, turn_light},
        {"light rotation, worn paint", {"worn-paint"}, one, kSidePx, turn_light},
        {"orbit, worn paint", {"worn-paint"}, one, kSidePx, orbit},
        {"light rotation, 4 views", {"worn-paint"}, four, kSidePx, turn_light},
        {"orbit, 4 views", {"worn-paint"}, four, kSidePx, orbit},
        {"light rotation, 1 view of 900", {"gold"}, one, 3 * third, turn_light},
        {"light rotation, 1 view of 300", {"gold"}, one, third, turn_light},
        {"light rotation, 9 views of 300", {"gold", "worn-paint", "porcelain"}, three, third, turn_light}};
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

/// Of three, after one that compiles and may rasterise.
double fastest_ms(const Step& step, StepViews& views, Renderer& renderer) {
    double fastest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 4; ++k) {
        for (Scene& scene : views.scenes) step.change(scene);
        const double ms = milliseconds([&] { draw_all_views(renderer, views.scenes, views.targets); });
        if (k > 0) fastest = std::min(fastest, ms);
    }
    return fastest;
}

Json bench_steps(BenchStage& stage, const BenchContext& context) {
    SceneLoader loader = stage.loader(context.registry);
    Json rows = Json::array();
    std::printf("\n%-34s %9s %9s %6s\n", "one step", "ms", "no skip", "ratio");
    for (const Step& step : steps()) {
        StepViews views = views_of(step, loader, stage.renderer);
        std::array<std::vector<double>, 2> ms;
        for (int i = 0; i < context.repetitions(); ++i)
            for (const int which : {i % 2, 1 - i % 2}) {
                stage.renderer.set_reuse(which == 0);
                ms[std::size_t(which)].push_back(fastest_ms(step, views, stage.renderer));
            }
        const double skip = median(ms[0]), all = median(ms[1]);
        std::printf("%-34s %9.1f %9.1f %6.2f\n", step.name.c_str(), skip, all, skip / all);
        rows.push_back({{"name", step.name}, {"skip_ms", skip}, {"no_skip_ms", all}, {"ratio", skip / all}});
    }
    stage.renderer.set_reuse(true);
    return rows;
}

/// What sharing costs and saves, from the steps above.
Json shared_views(const Json& steps) {
    const auto ms = [&](const char* name, const char* key) {
        for (const Json& row : steps)
            if (row.at("name") == name) return row.at(key).get<double>();
        return 0.0;
    };
    const double orbit = ms("orbit, 4 views", "skip_ms");
    const double nine = ms("light rotation, 9 views of 300", "skip_ms");
    const std::array<std::pair<const char*, double>, 4> rows{
        {{"4 views rasterised once and shaded / shaded alone",
          orbit / ms("light rotation, 4 views", "skip_ms")},
         {"4 views rasterised once and shaded / 4 independent", orbit / ms("orbit, 4 views", "no_skip_ms")},
         {"light of 9 views turned / of one of them", nine / ms("light rotation, 1 view of 300", "skip_ms")},
         {"light of 9 views turned / of one as large as all",
          nine / ms("light rotation, 1 view of 900", "skip_ms")}}};
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
    std::array<std::vector<double>, 2> ms;
    const auto load = [&](bool skip) {
        SceneLoader loader(stage.renderer, context.registry, {.skip = skip});
        loader.mesh(context.mesh.empty() ? "sphere" : context.mesh, true);
        const SceneOptions options{.mesh = context.mesh.empty() ? "sphere" : context.mesh,
                                   .size_px = glm::ivec2(kSidePx)};
        return milliseconds([&] { loader.scene(context.preset, options); });
    };
    for (int i = 0; i < context.repetitions(); ++i)
        for (const int which : {i % 2, 1 - i % 2}) ms[std::size_t(which)].push_back(load(which == 0));
    const double skip = median(ms[0]), all = median(ms[1]);
    std::printf("\n%-34s %9.1f %9.1f %6.2f\n", "its maps, from file to GPU", skip, all, skip / all);
    return {{"skip_ms", skip}, {"no_skip_ms", all}, {"ratio", skip / all}};
}

// --- another environment, until the picture under it is there ---

/// Milliseconds of one visit to an environment, from a picture under another one.
struct Visit {
    double light = 0.0;  ///< until its light is on the GPU
    double seen = 0.0;   ///< until the picture under it is drawn and read back
    double drawn = 0.0;  ///< of that, drawing: the same change once more, with both lights there
};

/// Of many visits.
double median_of(const std::vector<Visit>& visits, double (*value)(const Visit&)) {
    std::vector<double> values;
    for (const Visit& visit : visits) values.push_back(value(visit));
    return median(std::move(values));
}

struct SwitchRun {
    static constexpr std::array kNames{"cold", "disk cache", "memory"};
    std::array<std::array<std::vector<Visit>, kNames.size()>, 2> visits;  ///< with skipping and without
    std::vector<double> decode;
};

Visit visit_environment(BenchStage& stage, SceneLoader& loader, const Scene& before,
                        const std::string& environment) {
    const TargetHandle target = stage.renderer.make_target(glm::ivec2(kSidePx));
    const auto draw = [&](const Scene& scene) {
        stage.renderer.draw(scene, *target, Reuse::IfRepeated);
        stage.renderer.read_display(*target);
    };
    Scene scene = before;
    Visit visit;
    draw(before);
    visit.seen = milliseconds([&] {
        visit.light = milliseconds(
            [&] { scene.environment = loader.environment(environment, loader.needed_light(scene)); });
        draw(scene);
    });
    draw(before);
    visit.drawn = milliseconds([&] { draw(scene); });
    return visit;
}

SwitchRun run_switch(BenchStage& stage, const BenchContext& context, const std::string& environment) {
    SwitchRun run;
    const EnvironmentHandle before = stage.loader(context.registry).environment("furnace");
    for (int i = 0; i < context.repetitions(); ++i) {
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

Json bench_switch(BenchStage& stage, const BenchContext& context) {
    const std::string& environment = context.environments.back();
    const SwitchRun run = run_switch(stage, context, environment);
    const double decode = median(run.decode);
    Json json{{"environment", environment}, {"decode_ms", decode}, {"cases", Json::array()}};
    std::printf("\n%-34s %9s %9s %9s %9s %9s   (decoding alone %.1f ms)\n",
                ("environment " + path_to_utf8(utf8_to_path(environment).filename())).c_str(), "light ms",
                "drawing", "seen ms", "less draw", "no skip", decode);
    for (std::size_t from = 0; from < SwitchRun::kNames.size(); ++from) {
        const auto& own = run.visits[0][from];
        const double light = median_of(own, [](const Visit& each) { return each.light; });
        const double drawn = median_of(own, [](const Visit& each) { return each.drawn; });
        const double seen = median_of(own, [](const Visit& each) { return each.seen; });
        const double less = median_of(own, [](const Visit& each) { return each.seen - each.drawn; });
        const double all = median_of(run.visits[1][from], [](const Visit& each) { return each.seen; });
        std::printf("%-34s %9.1f %9.1f %9.1f %9.1f %9.1f\n", SwitchRun::kNames[from], light, drawn, seen,
                    less, all);
        json["cases"].push_back({{"name", SwitchRun::kNames[from]},
                                 {"light_ready_ms", light},
                                 {"drawing_ms", drawn},
                                 {"skip_ms", seen},
                                 {"skip_less_drawing_ms", less},
                                 {"no_skip_ms", all}});
    }
    return json;
}

}  // namespace

Json bench_skip(const BenchContext& context) {
    Json json{{"renderer", ""}, {"commands", bench_commands(context, context.quick ? 1 : 3)}};
    BenchStage stage;
    json["renderer"] = stage.context.description();
    json["steps"] = bench_steps(stage, context);
    json["shared_views"] = shared_views(json["steps"]);
    if (!context.preset.empty()) json["maps"] = bench_maps(stage, context);
    json["environment_switch"] = bench_switch(stage, context);
    return json;
}

}  // namespace patina
