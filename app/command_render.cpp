// patina render and patina compare: presets under environments, to a picture.
#include "app/commands.h"
#include "app/console.h"
#include "app/headless.h"
#include "app/jobs.h"
#include "app/paths.h"
#include "app/scene_loader.h"
#include "app/sheet.h"

namespace patina {

namespace {

bool wants_radiance(const std::string& output) { return path_from_utf8(output).extension() == ".exr"; }

/// Everything a headless picture needs, in the order it must live.
struct Studio {
    HeadlessContext context;
    Renderer renderer;
    Jobs jobs{worker_count()};
    ProgressLine progress;
    SceneLoader loader;

    Studio(const Registry& registry, const SceneOptions& options)
        : loader(renderer, registry,
                 {.parallel_for = jobs.parallel_for(),
                  .cache = {.folder = cache_folder() / "ibl"},
                  .allow_missing_maps = options.allow_missing_maps,
                  .note =
                      [this](const std::string& sentence) {
                          progress.clear();
                          say(sentence);
                      },
                  .progress = [this](const std::string& what,
                                     float fraction) { progress.show(what, fraction); }}) {}

    Image picture(const Scene& scene, RenderTarget& target, bool radiance) {
        renderer.draw(scene, target);
        return radiance ? renderer.read_radiance(target) : renderer.read_display(target);
    }
};

ImageMetadata described(const std::string& what) {
    return {{"Software", "Patina " PATINA_VERSION}, {"ImageDescription", what}};
}

}  // namespace

int run_render(const RenderArgs& args, const Registry& registry) {
    const ImageExporter& exporter = image_exporter(registry, path_from_utf8(args.output));
    Studio studio(registry, args.scene);
    Scene scene = studio.loader.scene(args.presets.front(), args.scene);
    scene.environment = studio.loader.environment(args.scene.environments.front());
    const TargetHandle target = studio.renderer.make_target(args.scene.size_px);
    const Image image = studio.picture(scene, *target, wants_radiance(args.output));
    exporter.save(path_from_utf8(args.output), image,
                  described(scene.material.name + " under " + args.scene.environments.front()));
    return 0;
}

int run_compare(const RenderArgs& args, const Registry& registry) {
    const ImageExporter& exporter = image_exporter(registry, path_from_utf8(args.output));
    const bool radiance = wants_radiance(args.output);
    Studio studio(registry, args.scene);
    Sheet sheet(int(args.scene.environments.size()), int(args.presets.size()), args.scene.size_px,
                radiance ? PixelType::F32 : PixelType::U8);
    for (std::size_t x = 0; x < args.scene.environments.size(); ++x)
        sheet.set_column_title(int(x), environment_title(registry, args.scene.environments[x]));
    const TargetHandle target = studio.renderer.make_target(args.scene.size_px);
    for (std::size_t y = 0; y < args.presets.size(); ++y) {
        Scene scene = studio.loader.scene(args.presets[y], args.scene);
        sheet.set_row_title(int(y), scene.material.name);
        for (std::size_t x = 0; x < args.scene.environments.size(); ++x) {
            scene.environment = studio.loader.environment(args.scene.environments[x]);
            sheet.set_cell(int(x), int(y), studio.picture(scene, *target, radiance));
        }
    }
    studio.progress.clear();
    exporter.save(path_from_utf8(args.output), sheet.image(), described("Presets under several lightings"));
    say("wrote " + args.output);
    return 0;
}

}  // namespace patina
