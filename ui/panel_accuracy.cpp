// The accuracy meter: what each side of the viewport shows, how far the shading is from the reference, and
// what it costs.
#include "renderer/core/metrics.h"
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/widgets.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace patina::ui {
namespace {

std::string formatted(const char* format, double value) {
    std::array<char, 48> text{};
    std::snprintf(text.data(), text.size(), format, value);
    return text.data();
}
std::string percent(double share) {
    return formatted(share < 0.001 ? "%.3f %%" : share < 0.1 ? "%.2f %%" : "%.1f %%", 100.0 * share);
}

struct Choice {
    Layer layer;
    Option option;
};
std::vector<Choice> choices() {
    std::vector<Choice> list{
        {{Layer::View}, {"As set", "The picture with the shading mode of the toolbar."}}};
    for (const auto& mode : kShadings)
        list.push_back({{Layer::Mode, mode.value}, {mode.title, mode.tooltip}});
    list.push_back({{Layer::Error}, {"Relative error", "Distance of the set shading from the reference."}});
    list.push_back({{Layer::Flip}, {"FLIP", "How different the two look when one flips between them."}});
    return list;
}
bool same(const Layer& a, const Layer& b) {
    return a.kind == b.kind && (a.kind != Layer::Mode || a.mode == b.mode);
}

void layer_combo(PanelContext& context, const char* name, const char* tooltip, Layer& layer) {
    const std::vector<Choice> list = choices();
    std::vector<Option> options;
    int index = 0;
    for (const Choice& choice : list) {
        if (same(choice.layer, layer)) index = static_cast<int>(options.size());
        options.push_back(choice.option);
    }
    if (combo(context, name, options, index, {.width = px(150), .tooltip = tooltip}))
        layer = list[static_cast<std::size_t>(index)].layer;
}

std::string title_of(const Layer& layer) {
    for (const Choice& choice : choices())
        if (same(choice.layer, layer)) return std::string(choice.option.title);
    return {};
}

std::string headline(const AccuracyStatus& status) {
    if (!status.measured) return "Measuring…";
    return "IBL error " + percent(status.rms) + " rms · " + formatted("%.2f ms", status.frame_ms);
}

std::string progress_of(const AccuracyStatus& status) {
    std::string text = "Reference: " + std::to_string(status.samples) + " samples a pixel";
    if (status.half_width > 0.0) text += ", known within " + percent(status.half_width);
    if (status.converged) return text + " (converged)";
    return text + (status.done ? " (at its limit)" : "…");
}

/// A chip with a ramp from 0 to the end's value.
void draw_legend(PanelContext& context, const Layer& layer, float x0, float y1) {
    if (layer.kind != Layer::Error && layer.kind != Layer::Flip) return;
    const bool error = layer.kind == Layer::Error;
    const std::string begin = error ? "error 0" : "FLIP 0";
    const std::string end = error ? "≥ " + percent(kErrorWhite) : "≥ " + formatted("%.1f", kFlipWhite);
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const float ramp = px(120), height = ImGui::GetFontSize(), pad = px(6);
    const float left = ImGui::CalcTextSize(begin.c_str()).x, right = ImGui::CalcTextSize(end.c_str()).x;
    const float y0 = y1 - height - 2.0f * pad;
    const float width = left + ramp + right + 4.0f * pad;
    draw->AddRectFilled({x0, y0}, {x0 + width, y1}, color::kShade, px(5));
    draw->AddText({x0 + pad, y0 + pad}, color::kText, begin.c_str());
    constexpr int steps = 24;
    const float from = x0 + left + 2.0f * pad;
    for (int i = 0; i < steps; ++i) {
        std::array<float, 3> c{};
        viridis((i + 0.5) / steps, c.data());
        draw->AddRectFilled({from + ramp * static_cast<float>(i) / steps, y0 + pad},
                            {from + ramp * static_cast<float>(i + 1) / steps, y1 - pad},
                            ImGui::ColorConvertFloat4ToU32({c[0], c[1], c[2], 1.0f}));
    }
    draw->AddText({from + ramp + pad, y0 + pad}, color::kText, end.c_str());
    record_rect(context, error ? "viewport.legend.error" : "viewport.legend.flip", {x0, y0, x0 + width, y1});
}

void draw_side_title(const Layer& layer, float x, float y, bool to_the_left) {
    const std::string text = title_of(layer);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const float x0 = to_the_left ? x - size.x - px(20) : x + px(8);
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw->AddRectFilled({x0, y}, {x0 + size.x + px(12), y + size.y + px(6)}, color::kShade, px(4));
    draw->AddText({x0 + px(6), y + px(3)}, color::kText, text.c_str());
}

void draw_part(const PanelContext& context, const Viewport::Picture& wanted, const Rect& rect,
               glm::vec2 part) {
    const Viewport& view = context.viewport;
    const TextureId texture = wanted.texture ? wanted.texture : view.texture;
    const bool bottom_up = wanted.texture ? wanted.bottom_up : view.bottom_up;
    const float v0 = bottom_up ? 1.0f : 0.0f;
    ImGui::GetWindowDrawList()->AddImage(
        std::bit_cast<ImTextureID>(texture), {rect.x0 + part.x * rect.width(), rect.y0},
        {rect.x0 + part.y * rect.width(), rect.y1}, {part.x, v0}, {part.y, 1.0f - v0});
}

float split_x(const PanelContext& context, const Rect& rect) {
    return std::round(rect.x0 + context.ui.accuracy.split_at * rect.width());
}

}  // namespace

void draw_layers(PanelContext& context, const Rect& rect) {
    const AccuracySettings& accuracy = context.ui.accuracy;
    if (!accuracy.split || context.view.debug != DebugView::Final) {
        draw_part(context,
                  context.view.debug == DebugView::Final ? context.viewport.left : Viewport::Picture{}, rect,
                  {0.0f, 1.0f});
        return;
    }
    const float at = (split_x(context, rect) - rect.x0) / std::max(rect.width(), 1.0f);
    draw_part(context, context.viewport.left, rect, {0.0f, at});
    draw_part(context, context.viewport.right, rect, {at, 1.0f});
}

void draw_layer_marks(PanelContext& context, const Rect& rect) {
    const AccuracySettings& accuracy = context.ui.accuracy;
    if (context.view.debug != DebugView::Final) return;
    ImGui::PushFont(font_of(Face::Small));
    const float bottom = rect.y1 - px(10);
    draw_legend(context, accuracy.left, rect.x0 + px(10), bottom);
    if (accuracy.split) {
        const float x = split_x(context, rect), middle = std::round((rect.y0 + rect.y1) / 2);
        ImDrawList* draw = ImGui::GetWindowDrawList();
        draw->AddRectFilled({x - px(1), rect.y0}, {x + px(1), rect.y1}, color::kText);
        draw->AddCircleFilled({x, middle}, px(7), color::kAccent);
        record_rect(context, "viewport.split", {x - px(6), middle - px(12), x + px(6), middle + px(12)});
        draw_side_title(accuracy.left, x, rect.y0 + px(10), true);
        draw_side_title(accuracy.right, x, rect.y0 + px(10), false);
        draw_legend(context, accuracy.right, x + px(10), bottom);
    }
    ImGui::PopFont();
}

bool drag_split(PanelContext& context, const Rect& rect) {
    UiState& ui = context.ui;
    const ImGuiIO& io = ImGui::GetIO();
    const bool at_line = std::abs(io.MousePos.x - split_x(context, rect)) <= px(6);
    if (ImGui::IsItemActivated())
        ui.split_drag = ui.accuracy.split && at_line && io.MouseDown[ImGuiMouseButton_Left];
    if (!ImGui::IsItemActive()) ui.split_drag = false;
    if (ui.accuracy.split && (ui.split_drag || (at_line && ImGui::IsItemHovered())))
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (!ui.split_drag) return false;
    const float least = std::min(px(8) / std::max(rect.width(), 1.0f), 0.5f);
    ui.accuracy.split_at =
        std::clamp((io.MousePos.x - rect.x0) / std::max(rect.width(), 1.0f), least, 1.0f - least);
    return true;
}

void draw_accuracy_panel(PanelContext& context) {
    AccuracySettings& accuracy = context.ui.accuracy;
    const AccuracyStatus& status = context.viewport.accuracy;
    ImGui::PushFont(font_of(Face::Strong));
    text_line(context, headline(status));
    ImGui::PopFont();
    record(context, "accuracy.headline");
    if (status.measured)
        text_line(context,
                  "95 % of values within " + percent(status.p95) + "  ·  largest " + percent(status.max) +
                      "  ·  mean FLIP " + formatted("%.3f", status.flip),
                  color::kMuted);
    record(context, "accuracy.figures");
    text_line(context, progress_of(status), color::kMuted);
    record(context, "accuracy.progress");
    layer_combo(context, "accuracy.left", accuracy.split ? "Left of the line." : "What the viewport shows.",
                accuracy.left);
    ImGui::SameLine();
    checkbox(context, "accuracy.split", "Split with",
             "Show another picture right of a line that can be dragged.", accuracy.split);
    ImGui::SameLine();
    layer_combo(context, "accuracy.right", "Right of the line.", accuracy.right);
}

}  // namespace patina::ui
