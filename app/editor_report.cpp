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
constexpr int kReferenceSamples = 256;  ///< a pixel; the report says how well that knows the reference

/// The sheet with files in the place of what is being edited.
Comparison reported_sheet(const Editor& editor) {
    Comparison comparison = *editor.document.sheet;
    comparison.camera = editor.camera;
    const fs::path& edited = editor.file.path;
    for (const ViewPlace place : places_of(comparison)) {
        ComparedPreset& preset = preset_at(comparison, place);
        if (preset.preset != kEditedPreset) continue;
        if (edited.empty() || is_dirty(editor.document, editor.file))
            throw std::runtime_error(
                "The sheet shows the material that is being edited; save it first, so that "
                "the report can name its file.");
        preset.preset = path_to_utf8(edited);
    }
    return comparison;
}

/// Maps are decoded for their thumbnails and pictures compressed: nothing for the window's thread.
void write_report(Editor& editor, const std::shared_ptr<ReportWork>& work) {
    editor.jobs.start(
        "Writing " + path_to_utf8(work->output.filename()),
        [&editor, work](JobContext& context) -> Jobs::Done {
            const Report report = work->report.finish();
            if (!context.stop.stop_requested()) save_report(work->output, report);
            return [&editor, work] {
                log_line(editor, ui::Severity::Info,
                         "Exported " + path_to_utf8(work->output.filename()) + ".");
            };
        },
        [&editor](const std::string& error) { log_line(editor, ui::Severity::Error, error); });
}

}  // namespace

ReportWork::ReportWork(Editor& editor, Comparison shown, fs::path to)
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
              .reference_samples = editor.ui.report_reference ? kReferenceSamples : 0}),
      output(std::move(to)) {}

void export_report(Editor& editor, const std::string& file) {
    if (!editor.document.sheet) return;
    try {
        fs::path output = utf8_to_path(file);
        require_report_name(output);
        editor.sheet.report = std::make_shared<ReportWork>(editor, reported_sheet(editor), output);
        ++editor.changes;
    } catch (const std::exception& error) {
        log_line(editor, ui::Severity::Error, error.what());
    }
}

void step_report(Editor& editor) {
    if (!editor.sheet.report) return;
    const std::shared_ptr<ReportWork> work = editor.sheet.report;
    try {
        const bool more = work->report.step();
        const int percent = int(100.0f * work->report.progress());
        if (std::exchange(work->shown_percent, percent) != percent) ++editor.changes;
        if (more) return;
        write_report(editor, work);
    } catch (const std::exception& error) {
        log_line(editor, ui::Severity::Error, error.what());
    }
    ++editor.changes;
    editor.sheet.report.reset();
}

std::optional<ui::JobLine> report_line(const Editor& editor) {
    if (!editor.sheet.report) return std::nullopt;
    const ComparisonReport& report = editor.sheet.report->report;
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
