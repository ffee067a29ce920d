// The report that the editor makes: of what the views show once all is loaded, drawn in short steps between
// frames, written by a worker.
#pragma once

#include "app/comparison_report.h"
#include "ui/panel_context.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace patina {

struct Editor;

/// Its views, once all that they show is there.
struct ReportDrawing {
    ReportDrawing(Editor& editor, Comparison shown, const std::filesystem::path& to);
    ~ReportDrawing() = default;
    ReportDrawing(const ReportDrawing&) = delete;
    ReportDrawing& operator=(const ReportDrawing&) = delete;

    SceneLoader loader;
    Comparison comparison;
    ComparisonScenes scenes;
    ComparisonReport report;
};
/// A report under way.
struct ReportWork {
    std::filesystem::path output;
    std::unique_ptr<ReportDrawing> drawing;  ///< null: waits for what the views need
    int shown_percent = 0;
};

/// Of the sheet that is shown, as UiState::report_reference says.
void export_report(Editor& editor, const std::string& file);
/// One step of the report that is being drawn; does nothing without one.
void step_report(Editor& editor);
/// step_report() has something to draw; otherwise a worker's end is waited for.
bool report_is_drawn(const Editor& editor);
/// What the status line says of it; nullopt without one.
std::optional<ui::JobLine> report_line(const Editor& editor);
/// False: the job is not the report's.
bool cancel_report(Editor& editor, std::uint64_t job);

}  // namespace patina
