// The menu bar, drawn from the table of shortcuts, with the document's title in its middle.
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/shortcuts.h"
#include "ui/widgets.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace patina::ui {
namespace {

constexpr float kPadY = 6.0f;

std::string menu_line_name(std::string_view menu, std::string_view title) {
    std::string name = recorded_name("menu." + std::string(menu), title);
    const std::size_t dots = name.find("…");
    return dots == std::string::npos ? name : name.substr(0, dots);
}

bool is_checked(const PanelContext& context, Action action) {
    switch (action) {
        case Action::ToggleLibrary:
            return context.ui.show_library;
        case Action::ToggleInspector:
            return context.ui.show_inspector;
        case Action::ToggleLog:
            return !context.ui.drawer.empty();
        case Action::Compare:
            return context.sheet != nullptr;
        default:
            return false;
    }
}

std::string line_title(const PanelContext& context, const Shortcut& shortcut) {
    std::string title(shortcut.title);
    const Status& status = context.status;
    if (shortcut.action == Action::Undo && !status.undo_what.empty()) return title + " " + status.undo_what;
    if (shortcut.action == Action::Redo && !status.redo_what.empty()) return title + " " + status.redo_what;
    return title;
}

bool starts_group(Action action) {
    constexpr std::array starts{Action::ImportMaps,   Action::Save,          Action::ExportRender,
                                Action::Quit,         Action::Search,        Action::NextEnvironment,
                                Action::NextShading,  Action::ToggleLibrary, Action::OpenComparison,
                                Action::ExportReport, Action::About};
    return std::find(starts.begin(), starts.end(), action) != starts.end();
}

void draw_recent(PanelContext& context) {
    const bool open = ImGui::BeginMenu("Open recent", !context.catalog.recent.empty());
    record(context, "menu.file.open_recent");
    if (!open) return;
    for (const std::string& file : context.catalog.recent) {
        ImGui::PushID(file.c_str());
        if (ImGui::MenuItem(std::string(file_name_of(file)).c_str()))
            context.requests.push_back(request::Open{file});
        ImGui::PopID();
        finish_item(context, "menu.file.recent." + std::string(file_name_of(file)), file);
    }
    ImGui::Separator();
    if (ImGui::MenuItem("Forget these")) context.requests.push_back(request::ClearRecent{});
    finish_item(context, "menu.file.recent.forget", "Empty this list; no file is touched.");
    ImGui::EndMenu();
}

void draw_debug_views(PanelContext& context) {
    const bool open = ImGui::BeginMenu("Show");
    record(context, "menu.view.show");
    if (!open) return;
    for (std::size_t i = 0; i < kDebugViews.size(); ++i) {
        const auto& row = kDebugViews[i];
        const std::string key = i < 10 ? std::to_string((i + 1) % 10) : "";
        if (ImGui::MenuItem(std::string(row.title).c_str(), key.c_str(), context.view.debug == row.value))
            context.view.debug = row.value;
        finish_item(context, recorded_name("menu.view.show", row.title), row.tooltip);
    }
    ImGui::EndMenu();
}

void draw_one_menu(PanelContext& context, Menu menu, const char* title) {
    const bool open = ImGui::BeginMenu(title);
    record(context, recorded_name("menu", title));
    if (!open) return;
    if (menu == Menu::View) draw_debug_views(context);
    bool first = menu != Menu::View;
    for (const Shortcut& shortcut : kShortcuts) {
        if (shortcut.menu != menu) continue;
        if (!first && starts_group(shortcut.action)) ImGui::Separator();
        first = false;
        const bool mac = ImGui::GetIO().ConfigMacOSXBehaviors;
        if (ImGui::MenuItem(line_title(context, shortcut).c_str(), key_text(shortcut, mac).c_str(),
                            is_checked(context, shortcut.action), can_act(context, shortcut.action)))
            act(context, shortcut.action);
        finish_item(context, menu_line_name(recorded_name("", title).substr(1), shortcut.title),
                    shortcut.description);
        if (shortcut.action == Action::Open) draw_recent(context);
    }
    ImGui::EndMenu();
}

void draw_title(PanelContext& context) {
    const Status& status = context.status;
    const float left = ImGui::GetCursorScreenPos().x + px(12);
    const float right = ImGui::GetIO().DisplaySize.x - px(12);
    const std::string& title = status.title.empty() ? context.material.name : status.title;
    ImGui::PushFont(font_of(Face::Strong));
    const ImVec2 size = ImGui::CalcTextSize(title.c_str());
    const float x = std::max(left, std::round((ImGui::GetIO().DisplaySize.x - size.x) / 2));
    const float y = std::round((menu_height() - size.y) / 2);
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw->PushClipRect({left, 0.0f}, {right, menu_height()}, true);
    draw->AddText({x, y}, color::kText, title.c_str());
    if (status.dirty)
        draw->AddCircleFilled({x + size.x + px(9), std::round(menu_height() / 2)}, px(3), color::kAccent);
    draw->PopClipRect();
    ImGui::PopFont();
}

}  // namespace

float menu_height() { return ImGui::GetFontSize() + 2.0f * px(kPadY); }

void draw_menu(PanelContext& context) {
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(px(8), px(kPadY)));
    const bool open = ImGui::BeginMainMenuBar();
    ImGui::PopStyleVar();
    if (!open) return;
    record_rect(context, "panel.menu", {0.0f, 0.0f, ImGui::GetIO().DisplaySize.x, menu_height()});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(px(8), px(8)));
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(px(14), px(8)));
    draw_one_menu(context, Menu::File, "File");
    draw_one_menu(context, Menu::Edit, "Edit");
    draw_one_menu(context, Menu::View, "View");
    draw_one_menu(context, Menu::Compare, "Compare");
    draw_one_menu(context, Menu::Help, "Help");
    ImGui::PopStyleVar(2);
    draw_title(context);
    ImGui::EndMainMenuBar();
}

}  // namespace patina::ui
