#include "app/editor_report.h"

#include "app/editor_state.h"
#include "app/paths.h"
#include "materials/text_io.h"

#include <exception>
#include <limits>
#include <memory>
#include <utility>

namespace patina {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kReportJob = std::numeric_limits<std::uint64_t>::max();  ///< none of Jobs'
constexpr int kReferenceSamples = 16384;                                         ///< a pixel, at most

/// The sheet with files in the place of what is being edited.
Comparison reported_sheet(const Editor& editor) {
    Comparison comparison = *editor.document.sheet;
    comparison.camera = editor.camera;
    const fs::path& edited = editor.file.path;
    for (const ViewPlace place : places_of(comparison)) {
        ComparedPreset& preset = preset_at(comparison, place);
        if (preset.preset != kEditedPreset) continue;
        if (is_dirty(editor.document, editor.file))
            throw std::runtime_error(
                "The sheet shows the material that is being edited; save it first, so that "
                "the report can name its file.");
        preset.preset = edited.empty() ? "-" : path_to_utf8(edited);
    }
    return comparison;
}

/// All that the sheet's views show is there.
bool views_are_ready(Editor& editor) {
    if (!editor.document.sheet) throw std::runtime_error("The report was given up: its sheet was closed.");
    if (editor.reconciler.pending()) return false;
    const Comparison& sheet = *editor.document.sheet;
    const std::vector<ViewPlace> places = places_of(sheet);
    for (std::size_t view = 0; view < std::min(places.size(), kMaxFurtherPictures); ++view) {
        const auto preset = editor.sheet.presets.find(preset_at(sheet, places[view]).preset);
        std::string error = preset != editor.sheet.presets.end() ? preset->second.error : "";
        if (error.empty()) error = editor.reconciler.error_of(view);
        if (!error.empty()) throw std::runtime_error("The report needs every view: " + error);
        const std::optional<Photo>& photo = lighting_at(sheet, places[view]).photo;
        if (!editor.reconciler.drawable(view) || (photo && !loaded_photo(editor, photo->file))) return false;
    }
    return true;
}

/// The views as they are now, whatever is edited while they are drawn. Those beyond what is shown are left to
/// the loader.
void give_what_is_shown(Editor& editor, ReportDrawing& drawing) {
    const Comparison& sheet = drawing.comparison;
    const std::vector<ViewPlace> places = places_of(sheet);
    for (std::size_t view = 0; view < std::min(places.size(), kMaxFurtherPictures); ++view) {
        const Lighting& light = lighting_at(sheet, places[view]);
        drawing.scenes.give(places[view],
                            editor.reconciler.scene_of(view, camera_of(sheet, light), view_of(sheet, light)));
        if (light.photo)
            drawing.scenes.give_photo(light.photo->file, loaded_photo(editor, light.photo->file));
    }
}

/// Maps are decoded for their thumbnails and pictures compressed: nothing for the window's thread.
void write_report(Editor& editor, const std::shared_ptr<ReportWork>& work) {
    editor.jobs.start(
        "Writing " + path_to_utf8(work->output.filename()),
        [&editor, work](JobContext& context) -> Jobs::Done {
            const Report report = work->drawing->report.finish();
            if (!context.stop.stop_requested()) save_report(work->output, report);
            return [&editor, work] {
                log_line(editor, ui::Severity::Info,
                         "Exported " + path_to_utf8(work->output.filename()) + ".");
            };
        },
        [&editor](const std::string& error) { log_line(editor, ui::Severity::Error, error); });
}

}  // namespace

ReportDrawing::ReportDrawing(Editor& editor, Comparison shown, const fs::path& to)
    : loader(editor.renderer, editor.registry,
             {.parallel_for = editor.jobs.parallel_for(),
              .cache = {.folder = cache_folder() / "ibl"},
              .note = [&editor](const std::string& note) { log_line(editor, ui::Severity::Info, note); }}),
      comparison(std::move(shown)),
      scenes(editor.renderer, loader, editor.registry, comparison, {}),
      report(scenes, editor.registry, comparison,
             {.file = sheet_file(editor).path,
              .output = to,
              .renderer = editor.status.renderer,
              .reference_samples = editor.ui.report_reference ? kReferenceSamples : 0}) {
    give_what_is_shown(editor, *this);
}

void export_report(Editor& editor, const std::string& file) {
    if (!editor.document.sheet) return;
    try {
        fs::path output = utf8_to_path(file);
        require_report_file(output);
        reported_sheet(editor);  // says at once where there can be none
        editor.sheet.report = std::make_shared<ReportWork>(ReportWork{.output = std::move(output)});
        ++editor.changes;
    } catch (const std::exception& error) {
        log_line(editor, ui::Severity::Error, error.what());
    }
}

void step_report(Editor& editor) {
    if (!editor.sheet.report) return;
    const std::shared_ptr<ReportWork> work = editor.sheet.report;
    try {
        if (!work->drawing) {
            if (!views_are_ready(editor)) return;
            work->drawing = std::make_unique<ReportDrawing>(editor, reported_sheet(editor), work->output);
            return;
        }
        const bool more = work->drawing->report.step();
        const int percent = int(100.0f * work->drawing->report.progress());
        if (std::exchange(work->shown_percent, percent) != percent) ++editor.changes;
        if (more) return;
        write_report(editor, work);
    } catch (const std::exception& error) {
        log_line(editor, ui::Severity::Error, error.what());
    }
    ++editor.changes;
    editor.sheet.report.reset();
}

bool report_is_drawn(const Editor& editor) { return editor.sheet.report && editor.sheet.report->drawing; }

std::optional<ui::JobLine> report_line(const Editor& editor) {
    if (!editor.sheet.report) return std::nullopt;
    if (!report_is_drawn(editor))
        return ui::JobLine{
            .id = kReportJob, .label = "The report waits for what its views show", .progress = -1.0f};
    const ComparisonReport& report = editor.sheet.report->drawing->report;
    return ui::JobLine{.id = kReportJob,
                       .label = "Drawing the report: view " +
                                std::to_string(std::min(report.done() + 1, report.views())) + " of " +
                                std::to_string(report.views()),
                       .progress = report.progress()};
}

bool cancel_report(Editor& editor, std::uint64_t job) {
    if (job != kReportJob) return false;
    editor.sheet.report.reset();
    return true;
}

}  // namespace patina
