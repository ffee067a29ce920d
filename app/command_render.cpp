// patina render and patina compare: presets under environments, to a picture.
#include "app/commands.h"
#include "app/comparison_file.h"
#include "app/comparison_sheet.h"
#include "app/made_from.h"
#include "app/sheet.h"
#include "app/stats.h"
#include "app/studio.h"
#include "app/video.h"
#include "materials/text_io.h"
#include "renderer/core/angles.h"

#include <algorithm>
#include <stdexcept>

namespace patina {

namespace fs = std::filesystem;

namespace {

bool wants_radiance(const std::string& output) { return utf8_to_path(output).extension() == ".exr"; }

}  // namespace

namespace {

/// A video's frames lie in a folder of their own until ffmpeg has joined them. One that was left there
/// because the program was ended is taken up again: frames that are up to date are kept.
struct FrameFolder {
    fs::path path;
    explicit FrameFolder(const fs::path& video) : path(video) {
        path += ".frames";
        fs::create_directories(path);
    }
    ~FrameFolder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    FrameFolder(const FrameFolder&) = delete;
    FrameFolder& operator=(const FrameFolder&) = delete;
};

SceneOptions turned(SceneOptions options, int frame, const RenderArgs& args) {
    const float degrees = 360.0f * float(frame) / float(args.turntable);
    float& angle = args.turn_light ? options.view.env_rotation_deg : options.camera.yaw_deg;
    angle = wrap_degrees(angle + degrees);
    return options;
}

/// The picture of these options, unless it is there already.
struct Shot {
    fs::path file;
    SceneOptions scene;
    std::string made_from;
};
std::vector<Shot> missing_shots(const RenderArgs& args, const fs::path& output) {
    std::vector<Shot> shots;
    const int frames = std::max(args.turntable, 1);
    for (int frame = 0; frame < frames; ++frame) {
        Shot shot{.file = output, .scene = args.scene};
        if (args.turntable > 0) {
            shot.file = frame_file(output, frame + 1, frames);
            shot.scene = turned(args.scene, frame, args);
        }
        if (args.up_to_date) {
            RenderArgs one = args;
            one.scene = shot.scene;
            shot.made_from = made_from(one);
            if (is_up_to_date(shot.file, shot.made_from)) continue;
        }
        shots.push_back(std::move(shot));
    }
    return shots;
}

ImageMetadata described_with(const std::string& what, const std::string& made_from) {
    ImageMetadata metadata = described(what);
    if (!made_from.empty()) metadata.emplace_back(kMadeFromKey, made_from);
    return metadata;
}

/// Nothing was to do, which the ledger says, too.
void say_up_to_date(const RenderArgs& args, const fs::path& output) {
    write_stats(args.stats, {});
    say(path_to_utf8(output) + " is up to date");
}

void render_shots(const RenderArgs& args, const Registry& registry, const fs::path& output) {
    const ImageExporter& exporter = image_exporter(registry, output);
    const std::vector<Shot> shots = missing_shots(args, output);
    if (shots.empty()) return say_up_to_date(args, output);
    Studio studio(registry, args.scene, MeshAhead(registry, args.scene.mesh));
    Scene scene = studio.loader.scene(args.presets.front(), args.scene);
    scene.environment =
        studio.loader.environment(args.scene.environments.front(), studio.loader.needed_light(scene));
    for (std::size_t i = 0; i < shots.size(); ++i) {
        if (args.turntable > 0) studio.progress.show("drawing", float(i) / float(shots.size()));
        scene.camera = shots[i].scene.camera;
        scene.view = shots[i].scene.view;
        const bool same_surface = args.turn_light && shots.size() > 1;
        const Image image = studio.picture(scene, args.scene.size_px, output.extension() == ".exr",
                                           same_surface ? Reuse::Standing : Reuse::Within);
        exporter.save(shots[i].file, image,
                      described_with(scene.material.name + " under " + args.scene.environments.front(),
                                     shots[i].made_from));
    }
    write_stats(args.stats, studio.renderer.work());
}

void render_video(const RenderArgs& args, const Registry& registry) {
    const fs::path video = utf8_to_path(args.output);
    if (!has_ffmpeg())
        throw std::runtime_error(args.output +
                                 ": a video needs ffmpeg, which is not installed; write numbered pictures "
                                 "instead (-o turn.png)");
    const FrameFolder folder(video);
    RenderArgs pictures = args;
    pictures.up_to_date = true;
    render_shots(pictures, registry, folder.path / "frame.png");
    const std::size_t digits = std::max<std::size_t>(3, std::to_string(args.turntable).size());
    join_frames(folder.path / ("frame-%0" + std::to_string(digits) + "d.png"), args.turntable, video);
    say("wrote " + args.output);
}

}  // namespace

int run_render(const RenderArgs& args, const Registry& registry) {
    if (args.turntable > 0 && is_video(utf8_to_path(args.output)))
        render_video(args, registry);
    else
        render_shots(args, registry, utf8_to_path(args.output));
    return 0;
}

namespace {

int compare_file(const RenderArgs& args, const Registry& registry) {
    const std::filesystem::path file = utf8_to_path(args.presets.front());
    const ImageExporter& exporter = image_exporter(registry, utf8_to_path(args.output));
    LoadedComparison loaded = load_comparison(file);
    for (const std::string& note : loaded.notes) say(note);
    require_own_settings(args.scene, args.presets.front());
    const std::string made = args.up_to_date ? made_from(args) : std::string{};
    if (args.up_to_date && is_up_to_date(utf8_to_path(args.output), made)) {
        say_up_to_date(args, utf8_to_path(args.output));
        return 0;
    }
    Studio studio(registry, args.scene);
    const Image sheet = draw_comparison_sheet(
        studio, registry, loaded.comparison,
        {.cell_px = args.scene.size_px, .radiance = wants_radiance(args.output), .scene = args.scene});
    studio.progress.clear();
    exporter.save(utf8_to_path(args.output), sheet, described_with(loaded.comparison.title, made));
    write_stats(args.stats, studio.renderer.work());
    say("wrote " + args.output);
    return 0;
}

}  // namespace

int run_compare(const RenderArgs& args, const Registry& registry) {
    if (args.presets.size() == 1 && is_comparison_file(utf8_to_path(args.presets.front())))
        return compare_file(args, registry);
    const ImageExporter& exporter = image_exporter(registry, utf8_to_path(args.output));
    const bool radiance = wants_radiance(args.output);
    const std::string made = args.up_to_date ? made_from(args) : std::string{};
    if (args.up_to_date && is_up_to_date(utf8_to_path(args.output), made)) {
        say_up_to_date(args, utf8_to_path(args.output));
        return 0;
    }
    Studio studio(registry, args.scene, MeshAhead(registry, args.scene.mesh));
    Sheet sheet(int(args.scene.environments.size()), int(args.presets.size()), args.scene.size_px,
                radiance ? PixelType::F32 : PixelType::U8);
    for (std::size_t x = 0; x < args.scene.environments.size(); ++x)
        sheet.set_column_title(int(x), environment_title(registry, args.scene.environments[x]));
    const Reuse reuse = args.scene.environments.size() > 1 ? Reuse::Standing : Reuse::Within;
    std::vector<Scene> rows;
    NeededLight needed;  // of the whole sheet, so that each light is baked once
    for (const std::string& preset : args.presets) {
        rows.push_back(studio.loader.scene(preset, args.scene));
        needed = combined(needed, studio.loader.needed_light(rows.back()));
    }
    for (std::size_t y = 0; y < rows.size(); ++y) {
        Scene& scene = rows[y];
        sheet.set_row_title(int(y), scene.material.name);
        for (std::size_t x = 0; x < args.scene.environments.size(); ++x) {
            scene.environment = studio.loader.environment(args.scene.environments[x], needed);
            sheet.set_cell(int(x), int(y), studio.picture(scene, args.scene.size_px, radiance, reuse));
        }
    }
    studio.progress.clear();
    exporter.save(utf8_to_path(args.output), sheet.image(),
                  described_with("Presets under several lightings", made));
    write_stats(args.stats, studio.renderer.work());
    say("wrote " + args.output);
    return 0;
}

}  // namespace patina
