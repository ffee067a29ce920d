// The work drawer: what was computed, group by group, and what was skipped and why.
#include "ui/panels.h"
#include "ui/widgets.h"

#include <imgui.h>

#include <string>
#include <string_view>
#include <vector>

namespace patina::ui {
namespace {

std::vector<std::string_view> groups() {
    std::vector<std::string_view> names;
    for (const LedgerRow& row : kLedgerRows)
        if (names.empty() || names.back() != row.group) names.push_back(row.group);
    return names;
}

/// The label, and its number at the right edge of the column.
void draw_row(PanelContext& context, const std::string& label, const std::string& number, bool none) {
    const float right = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - px(16);
    const float width = ImGui::CalcTextSize(number.c_str()).x;
    text_line(context, label, none ? color::kFaint : color::kMuted,
              ImGui::GetContentRegionAvail().x - width - px(26));
    ImGui::SameLine();
    ImGui::SetCursorPosX(right - width);
    ImGui::PushStyleColor(ImGuiCol_Text, none ? color::kFaint : color::kText);
    ImGui::TextUnformatted(number.c_str());
    ImGui::PopStyleColor();
}

void draw_group(PanelContext& context, std::string_view group) {
    heading(group);
    for (const LedgerRow& row : kLedgerRows)
        if (row.group == group)
            draw_row(context, std::string(row.label), ledger_text(row, *context.work),
                     context.work->*row.member == 0);
}

void draw_skipped(PanelContext& context) {
    heading("Skipped");
    if (context.work->skipped.empty()) text_line(context, "Nothing yet.", color::kFaint);
    for (const SkippedWork& each : context.work->skipped) {
        const std::string times = each.times > 1 ? "  ×" + std::to_string(each.times) : "";
        text_wrapped(each.what + ": " + each.why + times, color::kMuted);
    }
}

std::string whole_text(const WorkLedger& work) {
    std::string text;
    for (const LedgerRow& row : kLedgerRows)
        text += std::string(row.label) + "\t" + std::to_string(work.*row.member) + "\n";
    for (const SkippedWork& each : work.skipped)
        text += "Skipped\t" + each.what + ": " + each.why + "\t" + std::to_string(each.times) + "\n";
    return text;
}

}  // namespace

void draw_work_panel(PanelContext& context) {
    if (!context.work) return;
    if (button(context, "work.clear", "Count from here",
               "Set every counter to zero: what follows is the next deed's work.",
               {.emphasis = Emphasis::Quiet}))
        context.requests.push_back(request::ClearWork{});
    ImGui::SameLine();
    if (button(context, "work.copy", "Copy", "Put the counters on the clipboard, for a report.",
               {.emphasis = Emphasis::Quiet}))
        context.requests.push_back(request::CopyText{whole_text(*context.work)});
    const std::vector<std::string_view> names = groups();
    // A column narrower than this has no room for its labels: then they stand below each other.
    const bool wide = ImGui::GetContentRegionAvail().x > px(900);
    if (wide && ImGui::BeginTable("##groups", static_cast<int>(names.size()) + 1)) {
        for (const std::string_view name : names) {
            ImGui::TableNextColumn();
            draw_group(context, name);
        }
        ImGui::TableNextColumn();
        draw_skipped(context);
        ImGui::EndTable();
    } else if (!wide) {
        for (const std::string_view name : names) draw_group(context, name);
        draw_skipped(context);
    }
}

}  // namespace patina::ui
