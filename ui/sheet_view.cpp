// Views side by side in the viewport's place: one camera, each its own light and preset. Edits the selected
// view through the context as the viewport does.
#include "ui/ab_view.h"
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/photo_overlay.h"
#include "ui/viewport_parts.h"
#include "ui/widgets.h"
#include "ui/workspace.h"

#include <imgui.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

namespace patina::ui {
namespace {

constexpr float kGap = 3.0f, kBarPad = 5.0f;

struct Grid {
    int columns = 1, rows = 1;
};

/// As the comparison's own grid where everything in it is seen, else what fills the region best: so does a
/// single row or column of views that would become slits.
Grid grid_of(const Comparison& sheet, std::size_t views, float aspect) {
    constexpr float slit = 2.5f;
    Grid own{std::max(1, int(sheet.columns.size())), int(sheet.rows.size())};
    const bool whole = sheet.views.empty() && views == sheet.rows.size() * sheet.columns.size();
    const float cell = aspect * float(own.rows) / float(own.columns);
    const bool slits = std::min(own.rows, own.columns) == 1 && std::max(cell, 1.0f / cell) > slit;
    if (whole && !slits) return own;
    const int columns = grid_columns(views, aspect, 1.0f);
    return {columns, (int(views) + columns - 1) / columns};
}

Rect cell_rect(const Rect& rect, const Grid& grid, int index) {
    const float gap = std::round(px(kGap));
    const float width = (rect.width() - gap * float(grid.columns - 1)) / float(grid.columns);
    const float height = (rect.height() - gap * float(grid.rows - 1)) / float(grid.rows);
    const int column = index % grid.columns, row = index / grid.columns;
    const float left = rect.x0 + float(column) * (width + gap);
    const float top = rect.y0 + float(row) * (height + gap);
    return {std::round(left), std::round(top), std::round(left + width), std::round(top + height)};
}

void draw_cell_picture(const SheetCell& cell, const Rect& rect, const PanelContext& context) {
    ImDrawList* draw = ImGui::GetWindowDrawList();
    if (cell.texture) {
        const float v0 = context.viewport.bottom_up ? 1.0f : 0.0f;
        draw->AddImage(std::bit_cast<ImTextureID>(cell.texture), {rect.x0, rect.y0}, {rect.x1, rect.y1},
                       {0.0f, v0}, {1.0f, 1.0f - v0});
    }
    const std::string text = !cell.error.empty() ? cell.error : cell.texture ? std::string{} : "Loading…";
    if (text.empty()) return;
    ImGui::PushFont(font_of(Face::Small));
    ImGui::SetCursorScreenPos({rect.x0 + px(12), rect.y0 + px(44)});
    text_wrapped(text, cell.error.empty() ? IM_COL32(30, 30, 30, 255) : color::kError, Face::Small,
                 rect.width() - px(24));
    ImGui::PopFont();
}

/// In one line, or below each other where the view is narrow. False: something of it is not seen.
bool draw_title(const SheetCell& cell, const Rect& rect) {
    const std::string all =
        cell.preset + "  ·  " + cell.light + (cell.residual.empty() ? "" : "  ·  " + cell.residual);
    const ImVec2 at{rect.x0 + px(8), rect.y0 + px(8)};
    const float room = rect.width() - px(16), line = ImGui::GetFontSize() + px(10);
    if (ImGui::CalcTextSize(all.c_str()).x + px(16) <= room || rect.height() < 3.0f * line)
        return draw_chip(at, all, room);
    float y = at.y;
    bool seen = true;
    for (const std::string* part : {&cell.preset, &cell.light, &cell.residual}) {
        if (part->empty()) continue;
        seen &= draw_chip({at.x, y}, *part, room);
        y += line;
    }
    return seen;
}

void draw_cell_labels(PanelContext& context, const SheetCell& cell, const Rect& rect, bool selected) {
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw->PushClipRect({rect.x0, rect.y0}, {rect.x1, rect.y1}, true);
    ImGui::PushFont(font_of(Face::Small));
    const bool seen = draw_title(cell, rect);
    if (selected && context.ui.rotating_light) {
        const int degrees = static_cast<int>(std::lround(context.view.env_rotation_deg));
        draw_chip(
            {rect.x0 + px(8), rect.y1 - ImGui::GetFontSize() - px(18)},
            "Light " + std::to_string(degrees) + "°" + (context.result.turn_all_lights ? ", all views" : ""),
            rect.width() - px(16));
    }
    ImGui::PopFont();
    draw->PopClipRect();
    if (!seen && !context.ui.viewport_drag) explain(context, cell.preset + "  ·  " + cell.light);
    if (selected)
        draw->AddRect({rect.x0 + 1.0f, rect.y0 + 1.0f}, {rect.x1 - 1.0f, rect.y1 - 1.0f}, color::kAccent,
                      0.0f, 0, px(2));
}

void draw_cell(PanelContext& context, int view, const Rect& rect) {
    const SheetCell& cell = context.sheet_cells[std::size_t(view)];
    UiState& ui = context.ui;
    ImGui::PushID(view);
    use_photo_tool(context, view, rect);  // its points take the mouse before the view does
    ImGui::SetCursorScreenPos({rect.x0, rect.y0});
    ImGui::InvisibleButton("##view", {std::max(1.0f, rect.width()), std::max(1.0f, rect.height())},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    record(context, "sheet.view." + std::to_string(view + 1));
    if (ImGui::IsItemActivated()) ui.sheet_selected = view;
    const bool selected = ui.sheet_selected == view;
    const bool tool = photo_tool_active(context, view);
    if (tool) {
        handle_photo_mouse(context, view, rect);
    } else if (selected || ImGui::IsItemHovered()) {
        const bool held = ImGui::IsItemActive();
        if (held || ImGui::IsItemHovered()) handle_view_mouse(context, rect);
        context.result.viewport_active |= held && ui.viewport_drag;
    }
    if (!tool && ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
        ui.sheet_enlarged = ui.sheet_enlarged == view ? -1 : view;
    if (!tool) probe_view(context, view, rect);
    if (context.drop && rect.contains(context.drop->position.x, context.drop->position.y)) ui.hit_view = view;
    const ImVec2 pixels = ImGui::GetIO().DisplayFramebufferScale;
    const glm::ivec2 size{std::max(1, int(std::lround(rect.width() * pixels.x))),
                          std::max(1, int(std::lround(rect.height() * pixels.y)))};
    context.result.sheet.push_back({view, size});
    const bool enlarged = ui.sheet_enlarged == view;
    if (enlarged && ui.ab.against >= 0) context.result.sheet.push_back({ui.ab.against, size});
    const bool ab = !tool && ab_shown(context, view);
    draw_cell_picture(cell, rect, context);
    if (ab)
        draw_ab(context, view, rect);
    else
        draw_photo(context, view, rect);
    if (!ab) draw_cell_labels(context, cell, rect, selected && context.sheet_cells.size() > 1);
    if (enlarged) draw_probe(context, rect);
    ImGui::PopID();
}

void change(PanelContext& context, request::SheetChange what) {
    context.requests.push_back(request::ChangeSheet{what, context.ui.sheet_selected});
    context.ui.sheet_enlarged = -1;
}

void draw_bar(PanelContext& context) {
    using enum request::SheetChange;
    UiState& ui = context.ui;
    const auto with_icon = [](const char* icon, const char* text) { return std::string(icon) + "  " + text; };
    if (ui.sheet_enlarged >= 0) {
        if (button(context, "sheet.back", with_icon(icon::kBack, "All views"),
                   "Back to all views; so does a double-click or Escape."))
            ui.sheet_enlarged = -1;
    } else if (button(context, "sheet.close", with_icon(icon::kBack, "One view"),
                      "Back to the one view; the sheet is kept (C).")) {
        context.requests.push_back(request::ShowSheet{false});
    }
    if (ui.sheet_enlarged >= 0) {
        ImGui::SameLine();
        draw_ab_choice(context);
        return;
    }
    const bool room = context.sheet_cells.size() < 16;
    ImGui::SameLine();
    if (button(context, "sheet.add_light", with_icon(icon::kAdd, "Light"),
               "Another lighting beside the selected one, as a column for every preset.", {.enabled = room}))
        change(context, AddLight);
    ImGui::SameLine();
    if (button(context, "sheet.add_preset", with_icon(icon::kAdd, "Preset"),
               "Another preset below the selected one, as a row under every lighting; then choose it in the "
               "library.",
               {.enabled = room}))
        change(context, AddPreset);
    ImGui::SameLine();
    if (icon_button(context, "sheet.duplicate", icon::kCopy,
                    "A copy of the selected view, with a preset and a lighting of its own.", room))
        change(context, Duplicate);
    ImGui::SameLine();
    if (icon_button(context, "sheet.remove", icon::kTrash,
                    "Remove the selected view: its column, or its row where there is one column.",
                    context.sheet_cells.size() > 1))
        change(context, Remove);
    ImGui::SameLine();
    checkbox(context, "sheet.turn_all", "Turn all lights",
             "Turning the light turns that of every view; Alt does the same while it is held.",
             ui.sheet_turn_all);
}

}  // namespace

void draw_sheet(PanelContext& context, const Rect& rect) {
    UiState& ui = context.ui;
    const int views = int(context.sheet_cells.size());
    ui.photo_held = false;
    ui.sheet_selected = std::clamp(ui.sheet_selected, 0, std::max(0, views - 1));
    if (ui.sheet_enlarged >= views) ui.sheet_enlarged = -1;
    if (ui.ab.against >= views || ui.ab.against == ui.sheet_enlarged) ui.ab.against = kAgainstNothing;
    context.result.turn_all_lights = ui.sheet_turn_all || ImGui::GetIO().KeyAlt;
    const float bar = ImGui::GetFrameHeight() + 2.0f * px(kBarPad);
    const Rect bar_rect{rect.x0, rect.y0, rect.x1, std::min(rect.y1, rect.y0 + bar)};
    begin_region(context, "sheet_bar", bar_rect, {.background = color::kBar, .padding = {8.0f, kBarPad}});
    draw_bar(context);
    end_region();
    const Rect grid_rect{rect.x0, bar_rect.y1, rect.x1, rect.y1};
    if (grid_rect.height() < 2.0f) return;
    begin_region(context, "sheet", grid_rect,
                 {.background = color::kLine,
                  .padding = {0.0f, 0.0f},
                  .flags = ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoScrollbar});
    if (ui.sheet_enlarged >= 0) {
        draw_cell(context, ui.sheet_enlarged, grid_rect);
    } else {
        const Grid grid = grid_of(*context.sheet, std::size_t(views), grid_rect.width() / grid_rect.height());
        for (int view = 0; view < views; ++view) draw_cell(context, view, cell_rect(grid_rect, grid, view));
    }
    end_region();
}

}  // namespace patina::ui
