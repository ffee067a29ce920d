// patina report: a comparison as a web page or a PDF document to hand in.
#include "app/commands.h"
#include "app/comparison_file.h"
#include "app/comparison_report.h"
#include "app/stats.h"
#include "materials/text_io.h"

namespace patina {

int run_report(const ReportArgs& args, const Registry& registry) {
    const std::filesystem::path output = utf8_to_path(args.output);
    const std::filesystem::path file = utf8_to_path(args.comparison);
    require_report_file(output);
    LoadedComparison loaded = load_comparison(file);
    for (const std::string& note : loaded.notes) say(note);
    Studio studio(registry, {});
    ComparisonScenes scenes(studio.renderer, studio.loader, registry, loaded.comparison, {});
    ComparisonReport making(scenes, registry, loaded.comparison,
                            {.file = file,
                             .output = output,
                             .renderer = studio.context.description(),
                             .picture_px = args.picture_px,
                             .hints = !args.no_hints,
                             .reference_samples = args.reference_samples});
    do studio.progress.show("drawing the views", making.progress());
    while (making.step());
    save_report(output, making.finish());
    studio.progress.clear();
    write_stats(args.stats, studio.renderer.work());
    say("wrote " + args.output);
    return 0;
}

}  // namespace patina
