// The accuracy meter: what each side of the viewport shows, how far the shading is from the reference, and
// what it costs.
#include "renderer/core/format.h"
#include "ui/ab_parts.h"
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "ui/workspace.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace patina::ui {
namespace {

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
    list.push_back({{Layer::Signed},
                    {"Signed difference", "Where the set shading is darker or brighter, in linear light."}});
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

/// Three digits, about: no clock of a frame is better than that.
std::string milliseconds(double ms) {
    return formatted(ms < 10.0 ? "%.2f ms" : ms < 100.0 ? "%.1f ms" : "%.0f ms", ms);
}

std::string headline(const AccuracyStatus& status) {
    if (!status.measured) return "Measuring…";
    return "IBL error " + percent(status.rms) + " rms · " + milliseconds(status.frame_ms);
}

std::string progress_of(const AccuracyStatus& status) {
    std::string text = "Reference: " + std::to_string(status.samples) + " samples a pixel";
    if (status.half_width > 0.0) text += ", known within " + percent(status.half_width);
    if (status.converged) return text + " (converged)";
    return text + (status.done ? " (at its limit)" : "…");
}

/// What one probably wants of the window that shows this.
request::ExportWhat exported(const Layer& layer) {
    if (layer.kind == Layer::Error) return request::ExportWhat::Error;
    if (layer.kind == Layer::Flip) return request::ExportWhat::Flip;
    return request::ExportWhat::Reference;
}

std::optional<DifferenceKind> map_of(const Layer& layer) {
    if (layer.kind == Layer::Error) return DifferenceKind::Relative;
    if (layer.kind == Layer::Flip) return DifferenceKind::Flip;
    if (layer.kind == Layer::Signed) return DifferenceKind::Signed;
    return std::nullopt;
}

void draw_legend(PanelContext& context, const Layer& layer, float x0, float y1) {
    if (const auto kind = map_of(layer)) draw_ramp_legend(context, legend_of(*kind), x0, y1);
}

/// The display picture stands in for what is not there.
void draw_layer(const PanelContext& context, Viewport::Picture wanted, const Rect& rect, glm::vec2 part) {
    const Viewport& view = context.viewport;
    if (!wanted.texture) wanted = {view.texture, view.bottom_up};
    draw_part(wanted, rect, part);
}

float split_x(const PanelContext& context, const Rect& rect) {
    return std::round(rect.x0 + context.ui.accuracy.split_at * rect.width());
}

}  // namespace

void draw_layers(PanelContext& context, const Rect& rect) {
    const AccuracySettings& accuracy = context.ui.accuracy;
    if (!accuracy.split || context.view.debug != DebugView::Final) {
        draw_layer(context,
                   context.view.debug == DebugView::Final ? context.viewport.left : Viewport::Picture{}, rect,
                   {0.0f, 1.0f});
        return;
    }
    if (accuracy.blink) {
        const bool second = blinks_to_second(context);
        draw_layer(context, second ? context.viewport.right : context.viewport.left, rect, {0.0f, 1.0f});
        return;
    }
    const float at = (split_x(context, rect) - rect.x0) / std::max(rect.width(), 1.0f);
    draw_layer(context, context.viewport.left, rect, {0.0f, at});
    draw_layer(context, context.viewport.right, rect, {at, 1.0f});
}

void draw_layer_marks(PanelContext& context, const Rect& rect) {
    const AccuracySettings& accuracy = context.ui.accuracy;
    if (context.view.debug != DebugView::Final) return;
    ImGui::PushFont(font_of(Face::Small));
    const float bottom = rect.y1 - px(10);
    draw_legend(context, accuracy.left, rect.x0 + px(10), bottom);
    if (accuracy.split && !accuracy.blink) {
        draw_split_line(context,
                        {.name = "viewport.split",
                         .at = accuracy.split_at,
                         .left = title_of(accuracy.left),
                         .right = title_of(accuracy.right)},
                        rect);
        draw_legend(context, accuracy.right, split_x(context, rect) + px(10), bottom);
    }
    ImGui::PopFont();
}

bool drag_split(PanelContext& context, const Rect& rect) {
    UiState& ui = context.ui;
    if (!ui.accuracy.split || ui.accuracy.blink) return false;
    return drag_split_line(rect, ui.split_drag, ui.accuracy.split_at);
}

void draw_accuracy_panel(PanelContext& context) {
    AccuracySettings& accuracy = context.ui.accuracy;
    const AccuracyStatus& status = context.viewport.accuracy;
    ImGui::PushFont(font_of(Face::Strong));
    text_line(context, headline(status));
    ImGui::PopFont();
    record(context, "accuracy.headline");
    if (status.measured) {
        text_line(context,
                  "95 % of values within " + percent(status.p95) + "  ·  largest " + percent(status.max) +
                      "  ·  mean FLIP " + formatted("%.3f", status.flip),
                  color::kMuted);
        record(context, "accuracy.figures");
    }
    text_line(context, progress_of(status), color::kMuted);
    record(context, "accuracy.progress");
    layer_combo(context, "accuracy.left", accuracy.split ? "Left of the line." : "What the viewport shows.",
                accuracy.left);
    ImGui::SameLine();
    checkbox(context, "accuracy.split", "Split with",
             "Show another picture right of a line that can be dragged.", accuracy.split);
    ImGui::SameLine();
    layer_combo(context, "accuracy.right", "Right of the line.", accuracy.right);
    ImGui::SameLine();
    if (button(context, "accuracy.export", "Export…", "Save the reference or a map of the error.")) {
        context.ui.export_what = exported(accuracy.left);
        open_browser(context, BrowserPurpose::ExportRender);
    }
    if (!accuracy.split) return;
    ImGui::SameLine();
    checkbox(context, "accuracy.blink", "Blink", "Both in turns, twice a second: what differs moves.",
             accuracy.blink);
}

}  // namespace patina::ui
