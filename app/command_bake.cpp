// patina bake: the light the renderer uses, as files for any program.
#include "app/bake_files.h"
#include "app/commands.h"
#include "app/console.h"
#include "app/jobs.h"
#include "app/ktx.h"
#include "app/stats.h"
#include "materials/text_io.h"
#include "renderer/core/file_io.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <span>
#include <stdexcept>

namespace patina {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

double milliseconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// A folder that appears under its name only when commit() is called: files are written beside it first.
class StagedFolder {
public:
    explicit StagedFolder(fs::path target) : target_(std::move(target)) {
        std::error_code error;
        if (fs::exists(target_, error) && !fs::is_directory(target_, error))
            throw std::runtime_error(path_to_utf8(target_) +
                                     ": is a file; name a folder to write the bake into");
        if (fs::is_directory(target_, error) && !fs::is_empty(target_, error) &&
            !fs::exists(target_ / "bake.json", error))
            throw std::runtime_error(
                path_to_utf8(target_) +
                ": holds other files; name a new folder, an empty one or an earlier bake");
        staging_ = target_;
        staging_ += ".patina-part";
        fs::remove_all(staging_, error);
        if (!fs::create_directories(staging_, error))
            throw std::runtime_error(path_to_utf8(target_) + ": cannot be created (" + error.message() +
                                     "); choose a folder that you may write to");
    }
    ~StagedFolder() {
        std::error_code ignored;
        fs::remove_all(staging_, ignored);
    }
    StagedFolder(const StagedFolder&) = delete;
    StagedFolder& operator=(const StagedFolder&) = delete;

    const fs::path& path() const { return staging_; }
    void commit() {
        std::error_code error;
        fs::path old = target_;
        old += ".patina-old";
        fs::remove_all(old, error);
        if (fs::exists(target_, error)) fs::rename(target_, old, error);
        fs::rename(staging_, target_, error);
        if (error) {
            std::error_code ignored;
            fs::rename(old, target_, ignored);
            throw std::runtime_error(path_to_utf8(target_) + ": cannot be replaced (" + error.message() +
                                     ")");
        }
        fs::remove_all(old, error);
    }

private:
    fs::path target_;
    fs::path staging_;
};

struct Timed {
    Environment environment;
    double decode_ms = 0.0;
};
Timed load_timed(const Registry& registry, const std::string& id) {
    const auto start = std::chrono::steady_clock::now();
    LoadedLight light = load_light(registry, id);
    if (light.baked)
        throw std::runtime_error(id + ": is baked light already; name the picture it was baked from");
    return {std::move(light.environment), milliseconds_since(start)};
}

std::optional<BakedEnvironment> bake_as_asked(const Environment& environment, const BakeArgs& args,
                                              const BakeControl& control) {
    if (args.format == "ktx") return bake_for_ktx(environment, args.size, control);
    BakeSettings settings;
    settings.max_face_size = args.size;
    settings.extract_lights = !args.keep_lights;
    if (!args.roughness.empty()) settings.roughness = args.roughness;
    return bake_environment(environment, settings, control);
}

}  // namespace

int run_bake(const BakeArgs& args, const Registry& registry) {
    const auto [environment, decode_ms] = load_timed(registry, args.environment);
    for (const std::string& note : environment.notes) say(args.environment + ": " + note);

    StagedFolder folder(utf8_to_path(args.output));
    const Jobs jobs(worker_count());
    ProgressLine progress;
    const std::optional<BakedEnvironment> baked =
        bake_as_asked(environment, args,
                      {.parallel_for = jobs.parallel_for(),
                       .progress = [&](float f) { progress.show("baking", f); },
                       .stop = {}});
    if (!baked) throw std::runtime_error(args.environment + ": the bake was stopped");
    progress.clear();
    for (const std::string& note : baked->notes) say(args.environment + ": " + note);

    const auto start = std::chrono::steady_clock::now();
    Json json = args.format == "ktx"
                    ? write_bake_ktx(folder.path(), environment, *baked)
                    : write_bake_exr(folder.path(), environment, *baked, jobs.parallel_for());
    const BakeTimings& timings = baked->timings;
    json["timings_ms"] = {{"decode", decode_ms},         {"transform", timings.transform_ms},
                          {"levels", timings.levels_ms}, {"irradiance", timings.irradiance_ms},
                          {"lights", timings.lights_ms}, {"write", milliseconds_since(start)}};
    const std::string text = json.dump(2) + "\n";
    write_file(folder.path() / "bake.json", std::as_bytes(std::span(text)));
    folder.commit();
    WorkLedger work{.environments_decoded = 1};
    count_bake(work, *baked);
    write_stats(args.stats, work);
    return 0;
}

}  // namespace patina
