// The picture and what the mouse does on it: orbit, pan, zoom, turn the light. Edits camera and view, nothing
// else.
#include "ui/ab_view.h"
#include "ui/icons.h"
#include "ui/navigation.h"
#include "ui/panels.h"
#include "ui/shortcuts.h"
#include "ui/viewport_parts.h"
#include "ui/widgets.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

namespace patina::ui {

void handle_view_mouse(PanelContext& context, const Rect& rect) {
    const ImGuiIO& io = ImGui::GetIO();
    UiState& ui = context.ui;
    const bool active = ImGui::IsItemActive();
    if (ImGui::IsItemActivated()) {
        ui.viewport_drag = true;
        ui.rotating_light = io.MouseDown[ImGuiMouseButton_Right] || io.KeyCtrl || io.KeysDown[KeyL];
    }
    if (!active) ui.viewport_drag = ui.rotating_light = false;
    if (context.sheet ? drag_ab(context, rect) : drag_split(context, rect)) {
        ui.viewport_drag = ui.rotating_light = false;
        return;
    }
    if (ui.viewport_drag && (io.MouseDelta.x != 0.0f || io.MouseDelta.y != 0.0f)) {
        const glm::vec2 moved{io.MouseDelta.x / context.scale, io.MouseDelta.y / context.scale};
        if (ui.rotating_light)
            turn_light(context.view, moved);
        else if (io.MouseDown[ImGuiMouseButton_Middle] || io.KeyShift)
            pan(context.camera, {io.MouseDelta.x / rect.height(), io.MouseDelta.y / rect.height()});
        else
            orbit(context.camera, moved);
    }
    if (!ImGui::IsItemHovered()) return;
    if (io.MouseWheel != 0.0f) zoom(context.camera, io.MouseWheel);
}

namespace {

void draw_picture(PanelContext& context, const Rect& rect) {
    ImDrawList* draw = ImGui::GetWindowDrawList();
    if (context.viewport.texture) {
        draw_layers(context, rect);
        return;
    }
    const std::string text =
        context.status.jobs.empty() ? "No picture yet" : context.status.jobs.front().label + "…";
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    draw->AddText(
        {std::round((rect.x0 + rect.x1 - size.x) / 2), std::round((rect.y0 + rect.y1 - size.y) / 2)},
        IM_COL32(30, 30, 30, 255), text.c_str());
}

}  // namespace

bool draw_chip(const ImVec2& at, const std::string& text, float max_width) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const ImVec2 pad{px(8), px(4)};
    const float room = max_width > 0.0f ? max_width - 2.0f * pad.x : size.x;
    if (room < px(12)) return false;
    const float width = std::min(size.x, room);
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw->AddRectFilled(at, {at.x + width + 2.0f * pad.x, at.y + size.y + 2.0f * pad.y}, color::kShade,
                        px(5));
    const ImVec2 from{at.x + pad.x, at.y + pad.y};
    ImGui::RenderTextEllipsis(draw, from, {from.x + room, from.y + size.y}, from.x + room, from.x + room,
                              text.data(), text.data() + text.size(), &size);
    return size.x <= room;
}

namespace {

void draw_overlays(PanelContext& context, const Rect& rect) {
    const float inset = px(10);
    ImGui::PushFont(font_of(Face::Small));
    if (context.view.debug != DebugView::Final)
        draw_chip(
            {rect.x0 + inset, rect.y0 + inset},
            std::string(named(kDebugViews, context.view.debug).title) + "  ·  press 1 for the final picture");
    if (!context.ui.viewport_used) {
        const std::string hint =
            "Drag: orbit   ·   Shift-drag: pan   ·   Wheel: zoom   ·   Right-drag: turn the light";
        const ImVec2 size = ImGui::CalcTextSize(hint.c_str());
        if (size.x + 2.0f * inset + px(16) < rect.width())
            draw_chip(
                {std::round((rect.x0 + rect.x1 - size.x) / 2 - px(8)), rect.y1 - inset - size.y - px(8)},
                hint);
    } else if (context.ui.rotating_light) {
        const int degrees = static_cast<int>(std::lround(context.view.env_rotation_deg));
        draw_chip({rect.x0 + inset, rect.y1 - inset - ImGui::GetFontSize() - px(8)},
                  "Light " + std::to_string(degrees) + "°");
    }
    ImGui::PopFont();
}

void draw_drop_hint(const PanelContext& context, const Rect& rect) {
    if (!context.drag_over || !rect.contains(context.drag_over->x, context.drag_over->y)) return;
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw->AddRectFilled({rect.x0, rect.y0}, {rect.x1, rect.y1}, color::kShade);
    draw->AddRect({rect.x0 + px(3), rect.y0 + px(3)}, {rect.x1 - px(3), rect.y1 - px(3)}, color::kAccent,
                  px(6), 0, px(2));
    const char* text = "Drop maps, a folder, a preset, a mesh or an environment";
    const ImVec2 size = ImGui::CalcTextSize(text);
    draw->AddText(
        {std::round((rect.x0 + rect.x1 - size.x) / 2), std::round((rect.y0 + rect.y1 - size.y) / 2)},
        color::kText, text);
}

}  // namespace

void draw_viewport(PanelContext& context, const Rect& rect) {
    begin_region(context, "viewport", rect,
                 {.background = color::kSurround,
                  .padding = {0.0f, 0.0f},
                  .flags = ImGuiWindowFlags_NoScrollWithMouse});
    const ImVec2 pixels = ImGui::GetIO().DisplayFramebufferScale;
    context.result.viewport_size_px = {std::max(1, static_cast<int>(std::lround(rect.width() * pixels.x))),
                                       std::max(1, static_cast<int>(std::lround(rect.height() * pixels.y)))};
    ImGui::InvisibleButton("##picture", {std::max(1.0f, rect.width()), std::max(1.0f, rect.height())},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    record(context, "viewport");
    const bool moved_before = context.ui.viewport_drag;
    handle_view_mouse(context, rect);
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
        act(context, Action::Home);
    context.ui.viewport_used |= moved_before || (ImGui::IsItemHovered() && ImGui::GetIO().MouseWheel != 0.0f);
    context.result.viewport_active = context.ui.viewport_drag;
    probe_view(context, -1, rect);
    draw_picture(context, rect);
    draw_overlays(context, rect);
    draw_layer_marks(context, rect);
    if (context.ui.accuracy.meter || context.ui.accuracy.split) draw_probe(context, rect);
    draw_drop_hint(context, rect);
    end_region();
}

}  // namespace patina::ui
