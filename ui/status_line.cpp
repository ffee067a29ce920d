// The line at the bottom that always says what the program is doing; a click on it opens the drawer.
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/widgets.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace patina::ui {
namespace {

ImU32 severity_color(Severity severity) {
    return severity == Severity::Error     ? color::kError
           : severity == Severity::Warning ? color::kWarning
                                           : color::kMuted;
}

/// Draws centred text and moves on; returns its width.
void put_text(const std::string& text, ImU32 text_color, float height) {
    const ImVec2 at = ImGui::GetCursorScreenPos(), size = ImGui::CalcTextSize(text.c_str());
    ImGui::GetWindowDrawList()->AddText({at.x, std::round(at.y + (height - size.y) / 2)}, text_color,
                                        text.c_str());
    ImGui::Dummy({size.x, height});
    ImGui::SameLine(0.0f, px(8));
}

void draw_jobs(PanelContext& context, float height) {
    const JobLine& job = context.status.jobs.front();
    put_text(icon::kWorking, color::kAccent, height);
    std::string text = job.label;
    if (context.status.jobs.size() > 1)
        text += " and " + std::to_string(context.status.jobs.size() - 1) + " more";
    put_text(text, color::kText, height);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::SetCursorScreenPos({at.x, std::round(at.y + (height - px(5)) / 2)});
    progress_bar(job.progress, {px(140), px(5)});
    ImGui::SetCursorScreenPos({at.x + px(148), at.y});
    if (job.progress >= 0.0f) {
        std::array<char, 16> percent{};
        std::snprintf(percent.data(), percent.size(), "%.0f %%",
                      std::floor(100.0 * static_cast<double>(job.progress) + 0.001));
        put_text(percent.data(), color::kMuted, height);
    }
    if (job.can_cancel) {
        ImGui::SetCursorScreenPos(
            {ImGui::GetCursorScreenPos().x, at.y + std::round((height - ImGui::GetFrameHeight()) / 2)});
        if (icon_button(context, "status.cancel", icon::kClose, "Stop this; the last good picture stays."))
            context.requests.push_back(request::CancelJob{job.id});
    }
}

void draw_text(const PanelContext& context, float height) {
    const Status& status = context.status;
    if (status.severity != Severity::Info)
        put_text(status.severity == Severity::Error ? icon::kError : icon::kWarning,
                 severity_color(status.severity), height);
    put_text(status.text.empty() ? "Ready" : status.text, severity_color(status.severity), height);
}

/// Problems that were logged and not yet seen, and the frame counter, at the right end.
void draw_right(PanelContext& context, const Rect& rect, float height) {
    std::size_t problems = 0;
    const auto& log = context.status.log;
    for (std::size_t i = std::min<std::size_t>(context.ui.log_seen, log.size()); i < log.size(); ++i)
        problems += log[i].severity != Severity::Info;
    const std::string frames = std::to_string(context.status.frames_rendered) +
                               (context.status.frames_rendered == 1 ? " frame" : " frames");
    float x = rect.x1 - px(12) - ImGui::CalcTextSize(frames.c_str()).x;
    ImGui::SetCursorScreenPos({x, rect.y0});
    put_text(frames, color::kFaint, height);
    record(context, "status.frames");
    if (problems == 0) return;
    const std::string notes =
        std::string(icon::kWarning) + "  " + std::to_string(problems) + (problems == 1 ? " note" : " notes");
    x -= ImGui::CalcTextSize(notes.c_str()).x + px(20);
    ImGui::SetCursorScreenPos({x, rect.y0});
    put_text(notes, color::kWarning, height);
    record(context, "status.notes");
}

}  // namespace

float status_line_height() { return px(28); }

void draw_status_line(PanelContext& context, const Rect& rect) {
    begin_region(context, "status", rect, {.background = color::kBar, .padding = {12.0f, 0.0f}});
    const float height = rect.height();
    ImGui::SetCursorScreenPos({rect.x0, rect.y0});
    if (ImGui::InvisibleButton("##line", {rect.width(), height}))
        context.ui.drawer = context.ui.drawer.empty() ? "log" : "";
    ImGui::SetItemAllowOverlap();
    finish_item(context, "status", "What the program is doing. Click to see what it has said so far.");
    ImGui::SetCursorScreenPos({rect.x0 + px(12), rect.y0});
    const float room = rect.width() - px(150);
    ImGui::PushClipRect({rect.x0, rect.y0}, {rect.x0 + room, rect.y1}, true);
    if (context.status.jobs.empty())
        draw_text(context, height);
    else
        draw_jobs(context, height);
    ImGui::PopClipRect();
    draw_right(context, rect, height);
    end_region();
}

}  // namespace patina::ui
