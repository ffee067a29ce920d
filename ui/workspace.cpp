#include "ui/workspace.h"

#include <imgui.h>

namespace patina::ui {

std::vector<Panel> builtin_panels() { return {}; }

void draw_workspace(PanelContext& context) {
    if (context.recorder) context.recorder->items.clear();
    const ImGuiViewport* viewport = ImGui::GetMainViewport();
    ImGui::SetNextWindowPos(viewport->Pos);
    ImGui::SetNextWindowSize(viewport->Size);
    ImGui::Begin("workspace", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings);
    ImGui::TextUnformatted(context.status.title.c_str());
    ImGui::End();
    context.result.item_active = ImGui::IsAnyItemActive();
}

void open_browser(PanelContext& context, BrowserPurpose purpose, MapSlot slot) {
    context.browser.open = true;
    context.browser.purpose = purpose;
    context.browser.slot = slot;
    context.requests.push_back(request::ListFolder{});
}

void apply_theme(float scale, float framebuffer_scale) {
    (void)framebuffer_scale;
    ImGui::GetStyle() = ImGuiStyle{};
    ImGui::GetStyle().ScaleAllSizes(scale);
}

}  // namespace patina::ui
