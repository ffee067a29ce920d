#include "ui/workspace.h"

#include "ui/dialogs.h"
#include "ui/icons.h"
#include "ui/layout.h"
#include "ui/panels.h"
#include "ui/shortcuts.h"
#include "ui/widgets.h"

#include <imgui.h>

#include <algorithm>
#include <string>
#include <vector>

namespace patina::ui {
namespace {

const Panel* find_panel(const std::vector<Panel>& panels, Side side, const std::string& id) {
    const auto found = std::find_if(panels.begin(), panels.end(),
                                    [&](const Panel& panel) { return panel.side == side && panel.id == id; });
    return found == panels.end() ? nullptr : &*found;
}

std::vector<Tab> tabs_of(const std::vector<Panel>& panels, Side side) {
    std::vector<Tab> tabs;
    for (const Panel& panel : panels)
        if (panel.side == side) tabs.push_back({panel.id, panel.title, panel.description});
    return tabs;
}

/// Tabs, and under them the chosen page in a part that scrolls.
void draw_pages(PanelContext& context, const char* name, Side side, const Rect& rect, std::string& current) {
    if (rect.width() <= 0.0f) return;
    begin_region(context, name, rect, {.padding = {0.0f, 0.0f}, .flags = ImGuiWindowFlags_NoScrollWithMouse});
    const std::vector<Tab> tabs = tabs_of(context.panels, side);
    tab_strip(context, name, tabs, current);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(px(12), px(10)));
    ImGui::SetCursorScreenPos({rect.x0, rect.y0 + px(33)});
    ImGui::BeginChild(current.c_str(), {0.0f, 0.0f}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
    ImGui::PopStyleVar();
    if (const Panel* panel = find_panel(context.panels, side, current)) panel->draw(context);
    ImGui::EndChild();
    end_region();
}

void draw_drawer(PanelContext& context, const Rect& rect) {
    if (rect.height() <= 0.0f) return;
    begin_region(context, "drawer", rect,
                 {.padding = {0.0f, 0.0f}, .flags = ImGuiWindowFlags_NoScrollWithMouse});
    const std::vector<Tab> tabs = tabs_of(context.panels, Side::Bottom);
    const float strip =
        std::min(rect.width() - px(60), px(110) * static_cast<float>(std::max<std::size_t>(1, tabs.size())));
    ImGui::BeginChild("##tabs", {strip, px(33)}, false, ImGuiWindowFlags_NoScrollbar);
    tab_strip(context, "drawer", tabs, context.ui.drawer);
    ImGui::EndChild();
    ImGui::SetCursorScreenPos({rect.x1 - px(36), rect.y0 + px(5)});
    const bool close = icon_button(context, "drawer.close", icon::kDown, "Close the drawer (Esc).");
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(px(12), px(8)));
    ImGui::SetCursorScreenPos({rect.x0, rect.y0 + px(33)});
    ImGui::BeginChild(context.ui.drawer.c_str(), {0.0f, 0.0f}, false,
                      ImGuiWindowFlags_AlwaysUseWindowPadding);
    ImGui::PopStyleVar();
    if (const Panel* panel = find_panel(context.panels, Side::Bottom, context.ui.drawer))
        panel->draw(context);
    ImGui::EndChild();
    end_region();
    if (close) context.ui.drawer.clear();
}

struct Splitter {
    const char* name;
    Rect rect;
    float direction;    ///< a movement to the right or down makes the part larger (1) or smaller (−1)
    bool vertical;      ///< moves up and down
    float least, most;  ///< at scale 1
};

void draw_splitter(PanelContext& context, const Splitter& splitter, float& size) {
    const Rect& rect = splitter.rect;
    if (rect.width() <= 0.0f || rect.height() <= 0.0f) return;
    begin_region(context, splitter.name, rect, {.background = color::kLine, .padding = {0.0f, 0.0f}});
    ImGui::InvisibleButton("##grip", {rect.width(), rect.height()});
    const bool hot = ImGui::IsItemHovered() || ImGui::IsItemActive();
    if (hot) ImGui::SetMouseCursor(splitter.vertical ? ImGuiMouseCursor_ResizeNS : ImGuiMouseCursor_ResizeEW);
    if (hot)
        ImGui::GetWindowDrawList()->AddRectFilled({rect.x0, rect.y0}, {rect.x1, rect.y1}, color::kAccentDim);
    if (ImGui::IsItemActive()) {
        const ImVec2 moved = ImGui::GetIO().MouseDelta;
        const float change = splitter.direction * (splitter.vertical ? moved.y : moved.x) / context.scale;
        size = std::clamp(size + change, splitter.least, splitter.most);
    }
    record(context, splitter.name);
    end_region();
}

void draw_splitters(PanelContext& context, const Layout& layout) {
    UiState& ui = context.ui;
    draw_splitter(context, {"splitter.library", layout.library_splitter, 1.0f, false, 180.0f, 640.0f},
                  ui.library_width);
    draw_splitter(context, {"splitter.inspector", layout.inspector_splitter, -1.0f, false, 312.0f, 640.0f},
                  ui.inspector_width);
    draw_splitter(context, {"splitter.drawer", layout.drawer_splitter, -1.0f, true, 90.0f, 600.0f},
                  ui.drawer_height);
}

Layout layout_of(const PanelContext& context, glm::vec2 size) {
    const LayoutInput input{.width = size.x,
                            .height = size.y,
                            .scale = context.scale,
                            .menu_height = menu_height(),
                            .status_height = status_line_height(),
                            .toolbar_height = toolbar_height};
    Layout layout = compute_layout(context.ui, input);
    if (context.browser.open && layout.viewport.width() < px(560)) {  // a list of files needs some width
        UiState without_library = context.ui;
        without_library.show_library = false;
        layout = compute_layout(without_library, input);
    }
    return layout;
}

void take_drop(PanelContext& context) {
    if (!context.drop) return;
    context.requests.push_back(
        request::Dropped{context.drop->files, context.ui.hit_slot, context.ui.hit_view});
    context.browser.open = false;
    context.result.wants_redraw = true;
}

}  // namespace

std::vector<Panel> builtin_panels() {
    return {
        {"presets", "Presets", "Materials to start from.", Side::Left, draw_presets_panel},
        {"environments", "Environments", "Panoramas that light the object.", Side::Left,
         draw_environments_panel},
        {"meshes", "Meshes", "Shapes that wear the material.", Side::Left, draw_meshes_panel},
        {"material", "Material", "Values and maps of the material.", Side::Right, draw_material_panel},
        {"light", "Light", "The environment: turn it, expose it, show it.", Side::Right, draw_light_panel},
        {"view", "View", "Shading, camera and mesh.", Side::Right, draw_view_panel},
        {"sheet", "Compare", "Views side by side: presets, lightings, photos and the report.", Side::Right,
         draw_sheet_panel},
        {"maps", "Maps", "Albedo, normal, roughness and occlusion maps from a photo.", Side::Right,
         draw_maps_panel},
        {"log", "Log", "What the program has said.", Side::Bottom, draw_log_panel},
        {"work", "Work", "What was computed, and what was skipped and why.", Side::Bottom, draw_work_panel},
        {"accuracy", "Accuracy", "How far the shading is from the reference, and what it costs.",
         Side::Bottom, draw_accuracy_panel},
    };
}

void draw_workspace(PanelContext& context) {
    if (context.recorder) context.recorder->items.clear();
    context.result = {};
    if (context.drop) {
        context.ui.hit_slot.reset();
        context.ui.hit_view.reset();
    }
    close_list_on_escape(context);
    handle_shortcuts(context);
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const Layout layout = layout_of(context, {size.x, size.y});
    draw_menu(context);
    draw_pages(context, "library", Side::Left, layout.library, context.ui.left_tab);
    draw_pages(context, "inspector", Side::Right, layout.inspector, context.ui.right_tab);
    if (context.browser.open) {
        draw_file_browser(context,
                          {layout.toolbar.x0, layout.toolbar.y0, layout.viewport.x1, layout.viewport.y1});
    } else {
        draw_toolbar(context, layout.toolbar);
        if (context.sheet)
            draw_sheet(context, layout.viewport);
        else
            draw_viewport(context, layout.viewport);
    }
    context.ui.accuracy.meter = context.ui.drawer == "accuracy";
    draw_drawer(context, layout.drawer);
    draw_splitters(context, layout);
    draw_status_line(context, layout.status);
    draw_shortcut_sheet(context);
    draw_about(context);
    draw_import_sheet(context);
    draw_recovery_question(context);
    draw_unsaved_question(context);
    take_drop(context);
    context.result.item_active = ImGui::IsAnyItemActive();
}

}  // namespace patina::ui
