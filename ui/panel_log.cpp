// The log: everything the program has said since its start, newest at the bottom.
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/widgets.h"

#include <imgui.h>

#include <string>

namespace patina::ui {
namespace {

void draw_line(const LogLine& line) {
    const bool error = line.severity == Severity::Error, warning = line.severity == Severity::Warning;
    const ImU32 tint = error ? color::kError : warning ? color::kWarning : color::kFaint;
    ImGui::PushStyleColor(ImGuiCol_Text, color::kFaint);
    ImGui::TextUnformatted(line.time.c_str());
    ImGui::PopStyleColor();
    ImGui::SameLine(0.0f, px(10));
    ImGui::PushStyleColor(ImGuiCol_Text, tint);
    ImGui::TextUnformatted(error ? icon::kError : warning ? icon::kWarning : icon::kInfo);
    ImGui::PopStyleColor();
    ImGui::SameLine(0.0f, px(8));
    text_wrapped(line.count > 1 ? line.text + "  ×" + std::to_string(line.count) : line.text,
                 error || warning ? color::kText : color::kMuted);
}

std::string whole_text(const std::vector<LogLine>& log) {
    std::string text;
    for (const LogLine& line : log) text += line.time + "  " + line.text + "\n";
    return text;
}

}  // namespace

void draw_log_panel(PanelContext& context) {
    const auto& log = context.status.log;
    context.ui.log_seen = log.size();
    checkbox(context, "log.problems", "Only problems", "Hide what went well.", context.ui.log_only_problems);
    ImGui::SameLine();
    if (button(context, "log.copy", "Copy", "Put the whole log on the clipboard, for a report.",
               {.emphasis = Emphasis::Quiet, .enabled = !log.empty()}))
        context.requests.push_back(request::CopyText{whole_text(log)});
    ImGui::SameLine();
    if (button(context, "log.clear", "Clear", "Empty the log.",
               {.emphasis = Emphasis::Quiet, .enabled = !log.empty()}))
        context.requests.push_back(request::ClearLog{});
    ImGui::BeginChild("##lines");
    const bool at_end = ImGui::GetScrollY() >= ImGui::GetScrollMaxY();
    int shown = 0;
    for (const LogLine& line : log) {
        if (context.ui.log_only_problems && line.severity == Severity::Info) continue;
        draw_line(line);
        ++shown;
    }
    if (shown == 0) text_line(context, log.empty() ? "Nothing yet." : "No problems.", color::kFaint);
    if (at_end) ImGui::SetScrollHereY(1.0f);
    ImGui::EndChild();
}

}  // namespace patina::ui
