#include "ui/ab_parts.h"

#include "renderer/core/format.h"
#include "renderer/core/metrics.h"
#include "ui/viewport_parts.h"
#include "ui/widgets.h"

#include <imgui.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace patina::ui {
namespace {

/// Beside the line, as far as the rectangle leaves room.
void draw_side_title(const std::string& text, float x, const Rect& rect, bool to_the_left) {
    if (text.empty()) return;
    const float room = (to_the_left ? x - rect.x0 : rect.x1 - x) - px(16);
    const float width = std::min(ImGui::CalcTextSize(text.c_str()).x + px(16), room);
    draw_chip({to_the_left ? x - width - px(8) : x + px(8), rect.y0 + px(10)}, text, room);
}

float line_x(const Rect& rect, float at) { return std::round(rect.x0 + at * rect.width()); }

}  // namespace

void draw_part(const Viewport::Picture& picture, const Rect& rect, glm::vec2 part) {
    const float v0 = picture.bottom_up ? 1.0f : 0.0f;
    ImGui::GetWindowDrawList()->AddImage(
        std::bit_cast<ImTextureID>(picture.texture), {rect.x0 + part.x * rect.width(), rect.y0},
        {rect.x0 + part.y * rect.width(), rect.y1}, {part.x, v0}, {part.y, 1.0f - v0});
}

void draw_split_line(PanelContext& context, const SplitLine& line, const Rect& rect) {
    const float x = line_x(rect, line.at), middle = std::round((rect.y0 + rect.y1) / 2);
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw->AddRectFilled({x - px(1), rect.y0}, {x + px(1), rect.y1}, color::kText);
    draw->AddCircleFilled({x, middle}, px(7), color::kAccent);
    record_rect(context, line.name, {x - px(6), middle - px(12), x + px(6), middle + px(12)});
    draw_side_title(line.left, x, rect, true);
    draw_side_title(line.right, x, rect, false);
}

bool drag_split_line(const Rect& rect, bool& held, float& at) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool at_line = std::abs(io.MousePos.x - line_x(rect, at)) <= px(6);
    if (ImGui::IsItemActivated()) held = at_line && io.MouseDown[ImGuiMouseButton_Left];
    if (!ImGui::IsItemActive()) held = false;
    if (held || (at_line && ImGui::IsItemHovered())) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (!held) return false;
    const float least = std::min(px(8) / std::max(rect.width(), 1.0f), 0.5f);
    at = std::clamp((io.MousePos.x - rect.x0) / std::max(rect.width(), 1.0f), least, 1.0f - least);
    return true;
}

bool blinks_to_second(PanelContext& context) {
    const double phase = std::fmod(ImGui::GetTime(), 1.0);
    redraw_in(context, (phase < 0.5 ? 0.5 : 1.0) - phase);
    return phase >= 0.5;
}

void draw_ramp_legend(PanelContext& context, const RampLegend& legend, float x0, float y1) {
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const float ramp = px(120), height = ImGui::GetFontSize(), pad = px(6);
    const float left = ImGui::CalcTextSize(legend.begin.c_str()).x,
                right = ImGui::CalcTextSize(legend.end.c_str()).x;
    const float y0 = y1 - height - 2.0f * pad;
    const float width = left + ramp + right + 4.0f * pad;
    draw->AddRectFilled({x0, y0}, {x0 + width, y1}, color::kShade, px(5));
    draw->AddText({x0 + pad, y0 + pad}, color::kText, legend.begin.c_str());
    constexpr int steps = 24;
    const float from = x0 + left + 2.0f * pad;
    for (int i = 0; i < steps; ++i) {
        const glm::vec3 c = legend.color((static_cast<float>(i) + 0.5f) / steps);
        draw->AddRectFilled({from + ramp * static_cast<float>(i) / steps, y0 + pad},
                            {from + ramp * static_cast<float>(i + 1) / steps, y1 - pad},
                            ImGui::ColorConvertFloat4ToU32({c.x, c.y, c.z, 1.0f}));
    }
    draw->AddText({from + ramp + pad, y0 + pad}, color::kText, legend.end.c_str());
    record_rect(context, legend.name, {x0, y0, x0 + width, y1});
}

glm::vec3 diverging_color(float t) {
    glm::vec3 c;
    diverging(2.0 * double(t) - 1.0, &c.x);
    return c;
}

RampLegend legend_of(DifferenceKind kind) {
    const auto light = [](float t) {
        glm::vec3 c;
        viridis(double(t), &c.x);
        return c;
    };
    switch (kind) {
        case DifferenceKind::Signed:
            return {"viewport.legend.signed", formatted("darker by %.2f", kSignedWhite),
                    formatted("brighter by %.2f", kSignedWhite), diverging_color};
        case DifferenceKind::Relative:
            return {"viewport.legend.error", "error 0", formatted("≥ %.1f %%", 100.0 * kErrorWhite), light};
        case DifferenceKind::Flip:
            break;
    }
    return {"viewport.legend.flip", "FLIP 0", formatted("≥ %.1f", kFlipWhite), light};
}

std::string value_text(std::string_view side, const PixelValue& value) {
    return std::string(side) + formatted("  %.3f %.3f %.3f  =  %d %d %d", double(value.radiance.x),
                                         double(value.radiance.y), double(value.radiance.z), value.display.x,
                                         value.display.y, value.display.z);
}

}  // namespace patina::ui
