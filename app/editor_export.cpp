// Pictures of the view, of the reference and of what the shading misses, into files.
#include "app/accuracy.h"
#include "app/editor_state.h"
#include "app/paths.h"
#include "app/sheet.h"
#include "materials/text_io.h"
#include "renderer/core/format.h"
#include "ui/ab_parts.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>

namespace patina {

namespace fs = std::filesystem;
using ui::request::ExportWhat;

namespace {

constexpr int kMaxPictureSide = 16384;

struct Exported {
    Image image;
    ImageMetadata metadata;
};

Exported picture_of_view(Editor& editor, glm::ivec2 size, bool radiance) {
    size = glm::clamp(size, glm::ivec2(1), glm::ivec2(kMaxPictureSide));
    const TargetHandle target = editor.renderer.make_target(size);
    editor.renderer.draw(editor.reconciler.detailed_scene(editor.camera, editor.document.view, size.y),
                         *target);
    return {radiance ? editor.renderer.read_radiance(*target) : editor.renderer.read_display(*target), {}};
}

std::shared_ptr<const AccuracyPictures> measured_pictures(const Editor& editor, ExportWhat what) {
    auto pictures = editor.accuracy_pictures ? editor.accuracy_pictures() : nullptr;
    if (!pictures)
        throw std::runtime_error(
            "There is no reference yet: choose Reference in the toolbar or open Accuracy below, and export "
            "again.");
    if (what != ExportWhat::Reference && !pictures->measured)
        throw std::runtime_error(
            "The error is not measured yet: open Accuracy below, wait for its figures, and export again.");
    return pictures;
}

std::string percent(double share) { return formatted("%.2f %%", 100.0 * share); }

/// The map with its title above and its ramp of colours below.
Image with_legend(const Image& map, const std::string& title, const ui::RampLegend& legend) {
    Image ramp = make_image(256, 1, 3, PixelType::U8);
    for (int x = 0; x < ramp.width; ++x) {
        const glm::vec3 color = legend.color(float(x) / 255.0f);
        for (int c = 0; c < 3; ++c) set_texel(ramp, x, 0, c, color[c]);
    }
    Sheet sheet(1, 1, {map.width, map.height}, PixelType::U8, true);
    sheet.set_row_title(0, title);
    sheet.set_cell(0, 0, map);
    sheet.set_footer(legend.begin, ramp, legend.end);
    return sheet.image();
}

Exported picture_of_error(const MeasuredError& measured, ExportWhat what, bool radiance) {
    const bool flip = what == ExportWhat::Flip;
    const std::string mode(named(kShadings, measured.mode).title);
    const std::string title =
        flip ? mode + ": mean FLIP " + std::to_string(std::lround(1000.0 * measured.mean_flip)) + "/1000"
             : mode + ": " + percent(measured.error.rms) + " rms error";
    Exported made;
    if (radiance)
        made.image = flip ? measured.flip : measured.relative;
    else
        made.image = with_legend(flip ? measured.flip_map : measured.error_map, title,
                                 ui::legend_of(flip ? DifferenceKind::Flip : DifferenceKind::Relative));
    made.metadata = {{"ImageDescription",
                      title + " against the reference of " + std::to_string(measured.samples) + " samples; " +
                          "p95 " + percent(measured.error.p95) + ", max " + percent(measured.error.max)}};
    return made;
}

Exported exported(Editor& editor, const ui::request::ExportRender& request, bool radiance) {
    // What the viewport gathers is there already; another size would have to begin anew.
    const ExportWhat what = request.what == ExportWhat::Picture && is_reference(editor.document.view)
                                ? ExportWhat::Reference
                                : request.what;
    if (what == ExportWhat::Picture)
        return picture_of_view(editor, {request.width, request.height}, radiance);
    const auto pictures = measured_pictures(editor, what);
    if (what != ExportWhat::Reference) return picture_of_error(*pictures->measured, what, radiance);
    return {radiance ? pictures->radiance : pictures->display,
            {{"ImageDescription", "Reference of " + std::to_string(pictures->samples) + " samples a pixel"}}};
}

}  // namespace

void export_picture(Editor& editor, const ui::request::ExportRender& request) {
    try {
        const fs::path file = utf8_to_path(request.file);
        const ImageExporter& exporter = image_exporter(editor.registry, file);
        if (!editor.reconciler.drawable())
            throw std::runtime_error("There is no picture yet; wait for the light and export again.");
        auto made =
            std::make_shared<Exported>(exported(editor, request, exporter.extensions.front() == "exr"));
        made->metadata.insert(made->metadata.begin(),
                              {{"Software", "Patina"},
                               {"Title", document_title(editor.document, editor.file)},
                               {"Environment", editor.document.environment}});
        editor.jobs.start(
            "Writing " + path_to_utf8(file.filename()),
            [&editor, &exporter, file, made](JobContext&) -> Jobs::Done {
                exporter.save(file, made->image, made->metadata);
                return [&editor, file, made] {
                    log_line(editor, ui::Severity::Info,
                             "Exported " + path_to_utf8(file.filename()) + " (" +
                                 std::to_string(made->image.width) + " × " +
                                 std::to_string(made->image.height) + ").");
                };
            },
            [&editor](const std::string& error) { log_line(editor, ui::Severity::Error, error); });
    } catch (const std::exception& error) {
        log_line(editor, ui::Severity::Error, error.what());
    }
}

}  // namespace patina
