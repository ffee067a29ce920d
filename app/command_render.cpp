// patina render and patina compare: presets under environments, to a picture.
#include "app/commands.h"
#include "app/comparison_file.h"
#include "app/comparison_sheet.h"
#include "app/paths.h"
#include "app/sheet.h"
#include "app/stats.h"
#include "app/studio.h"

#include <stdexcept>

namespace patina {

namespace {

bool wants_radiance(const std::string& output) { return path_from_utf8(output).extension() == ".exr"; }

}  // namespace

int run_render(const RenderArgs& args, const Registry& registry) {
    const ImageExporter& exporter = image_exporter(registry, path_from_utf8(args.output));
    Studio studio(registry, args.scene);
    Scene scene = studio.loader.scene(args.presets.front(), args.scene);
    scene.environment =
        studio.loader.environment(args.scene.environments.front(), studio.loader.needed_light(scene));
    const TargetHandle target = studio.renderer.make_target(args.scene.size_px);
    const Image image = studio.picture(scene, *target, wants_radiance(args.output));
    exporter.save(path_from_utf8(args.output), image,
                  described(scene.material.name + " under " + args.scene.environments.front()));
    write_stats(args.stats, studio.renderer.work());
    return 0;
}

namespace {

int compare_file(const RenderArgs& args, const Registry& registry) {
    const std::filesystem::path file = path_from_utf8(args.presets.front());
    const ImageExporter& exporter = image_exporter(registry, path_from_utf8(args.output));
    LoadedComparison loaded = load_comparison(file);
    for (const std::string& note : loaded.notes) say(note);
    require_own_settings(args.scene, args.presets.front());
    Studio studio(registry, args.scene);
    const Image sheet = draw_comparison_sheet(
        studio, registry, loaded.comparison,
        {.cell_px = args.scene.size_px, .radiance = wants_radiance(args.output), .scene = args.scene});
    studio.progress.clear();
    exporter.save(path_from_utf8(args.output), sheet, described(loaded.comparison.title));
    write_stats(args.stats, studio.renderer.work());
    say("wrote " + args.output);
    return 0;
}

}  // namespace

int run_compare(const RenderArgs& args, const Registry& registry) {
    if (args.presets.size() == 1 && is_comparison_file(path_from_utf8(args.presets.front())))
        return compare_file(args, registry);
    const ImageExporter& exporter = image_exporter(registry, path_from_utf8(args.output));
    const bool radiance = wants_radiance(args.output);
    Studio studio(registry, args.scene);
    Sheet sheet(int(args.scene.environments.size()), int(args.presets.size()), args.scene.size_px,
                radiance ? PixelType::F32 : PixelType::U8);
    for (std::size_t x = 0; x < args.scene.environments.size(); ++x)
        sheet.set_column_title(int(x), environment_title(registry, args.scene.environments[x]));
    const TargetHandle target = studio.renderer.make_target(args.scene.size_px);
    NeededLight needed;  // of the whole sheet, so that each light is baked once
    for (const std::string& preset : args.presets)
        needed = combined(needed, studio.loader.needed_light(preset, args.scene));
    for (std::size_t y = 0; y < args.presets.size(); ++y) {
        Scene scene = studio.loader.scene(args.presets[y], args.scene);
        sheet.set_row_title(int(y), scene.material.name);
        for (std::size_t x = 0; x < args.scene.environments.size(); ++x) {
            scene.environment = studio.loader.environment(args.scene.environments[x], needed);
            sheet.set_cell(int(x), int(y), studio.picture(scene, *target, radiance));
        }
    }
    studio.progress.clear();
    exporter.save(path_from_utf8(args.output), sheet.image(), described("Presets under several lightings"));
    write_stats(args.stats, studio.renderer.work());
    say("wrote " + args.output);
    return 0;
}

}  // namespace patina
