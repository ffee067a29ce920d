// The two questions that may stop the artist: unsaved changes, and recovery after a crash. Enter and Escape
// answer them.
#include "ui/dialogs.h"

#include "ui/panels.h"
#include "ui/shortcuts.h"
#include "ui/widgets.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <string>

namespace patina::ui {

bool begin_question(PanelContext& context, const char* id, std::string_view title, float width) {
    if (!ImGui::IsPopupOpen(id)) ImGui::OpenPopup(id);
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({window.x / 2, window.y * 0.45f}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(width, window.x - px(32)), 0.0f});
    ImGui::SetNextWindowSizeConstraints({0.0f, 0.0f}, {window.x, window.y - px(32)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(px(20), px(18)));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, px(8));
    constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                       ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;
    const bool open = ImGui::BeginPopupModal(id, nullptr, flags);
    ImGui::PopStyleVar(2);
    context.result.wants_redraw |= ImGui::GetCurrentContext()->DimBgRatio < 1.0f;
    if (!open) return false;
    const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    record_rect(context, "panel.question", {at.x, at.y, at.x + size.x, at.y + size.y});
    ImGui::PushFont(font_of(Face::Strong));
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(title.data(), title.data() + title.size());
    ImGui::PopTextWrapPos();
    ImGui::PopFont();
    return true;
}

void end_question() { ImGui::EndPopup(); }

bool enter_pressed() {
    if (ImGui::GetIO().WantTextInput) return false;
    return ImGui::IsKeyPressed(KeyEnter, false) || ImGui::IsKeyPressed(KeyPadEnter, false);
}

bool escape_pressed(const PanelContext& context) {
    return !context.escape_taken && !ImGui::GetIO().WantTextInput && ImGui::IsKeyPressed(KeyEscape, false);
}

void close_list_on_escape(PanelContext& context) {
    const ImVector<ImGuiPopupData>& open = ImGui::GetCurrentContext()->OpenPopupStack;
    if (!ImGui::IsKeyPressed(KeyEscape, false) || ImGui::GetIO().WantTextInput || open.empty()) return;
    const ImGuiWindow* top = open.back().Window;
    if (!top || (top->Flags & ImGuiWindowFlags_Modal)) return;
    ImGui::ClosePopupsExceptModals();
    context.escape_taken = true;
}

void align_right(float width) {
    const float room = ImGui::GetContentRegionAvail().x;
    if (room > width) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room - width);
}

void draw_unsaved_question(PanelContext& context) {
    if (!context.unsaved) return;
    const UnsavedQuestion& question = *context.unsaved;
    const char* of =
        question.what == Unsaved::Material ? "Save the changes to “" : "Save the changes to the comparison “";
    if (!begin_question(context, "##unsaved", of + question.title + "”?", px(440))) return;
    text_wrapped("You are about to " + question.action + ". What is not saved would be lost.", color::kMuted);
    ImGui::Dummy({0.0f, px(8)});
    using request::Choice;
    const float width = px(110), gap = ImGui::GetStyle().ItemSpacing.x;
    std::optional<Choice> choice;
    align_right(3.0f * width + 2.0f * gap);
    if (button(context, "unsaved.discard", "Don’t save", "Go on and lose the changes.", {.width = width}))
        choice = Choice::Discard;
    ImGui::SameLine();
    if (button(context, "unsaved.cancel", "Cancel", "Go back to the material (Esc).", {.width = width}) ||
        escape_pressed(context))
        choice = Choice::Cancel;
    ImGui::SameLine();
    if (button(context, "unsaved.save", "Save", "Save first, then go on (Enter).",
               {.emphasis = Emphasis::Primary, .width = width}) ||
        enter_pressed())
        choice = Choice::Save;
    if (choice) {
        context.requests.push_back(request::AnswerUnsaved{*choice});
        ImGui::CloseCurrentPopup();
    }
    end_question();
}

void draw_recovery_question(PanelContext& context) {
    if (!context.recovery || context.unsaved) return;
    const RecoveryQuestion& question = *context.recovery;
    if (!begin_question(context, "##recovery", "Patina did not end properly last time", px(480))) return;
    text_wrapped("Unsaved work on “" + question.title + "” was kept " + question.when + ". Continue with it?",
                 color::kMuted);
    ImGui::Dummy({0.0f, px(8)});
    using request::Recovery;
    const float width = px(110), gap = ImGui::GetStyle().ItemSpacing.x;
    std::optional<Recovery> answer;
    align_right(3.0f * width + 2.0f * gap);
    if (button(context, "recovery.discard", "Throw away", "Delete the kept work and start afresh.",
               {.width = width}))
        answer = Recovery::Discard;
    ImGui::SameLine();
    if (button(context, "recovery.later", "Not now", "Start afresh; it is offered again next time (Esc).",
               {.width = width}) ||
        escape_pressed(context))
        answer = Recovery::Later;
    ImGui::SameLine();
    if (button(context, "recovery.recover", "Recover", "Continue with the kept work (Enter).",
               {.emphasis = Emphasis::Primary, .width = width}) ||
        enter_pressed())
        answer = Recovery::Recover;
    if (answer) {
        context.requests.push_back(request::AnswerRecovery{*answer});
        ImGui::CloseCurrentPopup();
    }
    end_question();
}

}  // namespace patina::ui
