// The report that the editor makes: drawn in short steps between frames, written by a worker.
#pragma once

#include "app/comparison_report.h"
#include "ui/panel_context.h"

#include <filesystem>
#include <optional>
#include <string>

namespace patina {

struct Editor;

/// A report under way.
struct ReportWork {
    ReportWork(Editor& editor, Comparison shown, std::filesystem::path to);
    ~ReportWork() = default;
    ReportWork(const ReportWork&) = delete;
    ReportWork& operator=(const ReportWork&) = delete;

    SceneLoader loader;
    Comparison comparison;
    ComparisonScenes scenes;
    ComparisonReport report;
    std::filesystem::path output;
    int shown_percent = 0;
};

/// Of the sheet that is shown, as UiState::report_reference says.
void export_report(Editor& editor, const std::string& file);
/// One step of the report that is being drawn; does nothing without one.
void step_report(Editor& editor);
/// What the status line says of it; nullopt without one.
std::optional<ui::JobLine> report_line(const Editor& editor);
/// False: the job is not the report's.
bool cancel_report(Editor& editor, std::uint64_t job);

}  // namespace patina
