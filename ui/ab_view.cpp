#include "ui/ab_view.h"

#include "ui/ab_parts.h"
#include "ui/viewport_parts.h"
#include "ui/widgets.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace patina::ui {
namespace {

constexpr std::array kHows{
    Named<AbHow>{AbHow::Split, "split", "Split", "One left, the other right of a line that can be dragged."},
    Named<AbHow>{AbHow::Blink, "blink", "Blink", "In turns, twice a second: what differs moves."},
    Named<AbHow>{AbHow::Signed, "signed", "Signed",
                 "Where the second is darker (blue) or brighter (red), in linear light."},
    Named<AbHow>{AbHow::Relative, "relative", "Relative", "The difference, as a share of the first."},
    Named<AbHow>{AbHow::Flip, "flip", "FLIP", "How different the two look when one flips between them."},
};

std::optional<DifferenceKind> map_of(AbHow how) {
    if (how == AbHow::Signed) return DifferenceKind::Signed;
    if (how == AbHow::Relative) return DifferenceKind::Relative;
    if (how == AbHow::Flip) return DifferenceKind::Flip;
    return std::nullopt;
}

std::string title_of(const PanelContext& context, int view) {
    if (view == kAgainstPhoto) return "Photo";
    const SheetCell& cell = context.sheet_cells[std::size_t(view)];
    return std::to_string(view + 1) + "  " + cell.preset + " · " + cell.light;
}

/// What the view is held against; no texture where it is not there.
Viewport::Picture second_picture(const PanelContext& context, int view) {
    const int against = context.ui.ab.against;
    if (against == kAgainstPhoto) return {context.sheet_cells[std::size_t(view)].photo, false};
    if (against < 0 || std::size_t(against) >= context.sheet_cells.size() || against == view) return {};
    return {context.sheet_cells[std::size_t(against)].texture, context.viewport.bottom_up};
}

}  // namespace

bool ab_shown(const PanelContext& context, int view) {
    return context.ui.sheet_enlarged == view && second_picture(context, view).texture != 0;
}

void draw_ab(PanelContext& context, int view, const Rect& rect) {
    const AbSettings& ab = context.ui.ab;
    const Viewport::Picture second = second_picture(context, view);
    ImGui::PushFont(font_of(Face::Small));
    if (ab.how == AbHow::Split) {
        draw_part(second, rect, {ab.split_at, 1.0f});
        draw_split_line(context,
                        {.name = "sheet.split",
                         .at = ab.split_at,
                         .left = title_of(context, view),
                         .right = title_of(context, ab.against)},
                        rect);
    } else if (ab.how == AbHow::Blink) {
        const bool shows_second = blinks_to_second(context);
        if (shows_second) draw_part(second, rect, {0.0f, 1.0f});
        draw_chip({rect.x0 + px(8), rect.y0 + px(8)}, title_of(context, shows_second ? ab.against : view),
                  rect.width() - px(16));
    } else if (const auto kind = map_of(ab.how)) {
        if (context.ab_map.texture) draw_part(context.ab_map, rect, {0.0f, 1.0f});
        draw_ramp_legend(context, legend_of(*kind), rect.x0 + px(10), rect.y1 - px(10));
        draw_chip({rect.x0 + px(8), rect.y0 + px(8)},
                  title_of(context, view) + "   against   " + title_of(context, ab.against),
                  rect.width() - px(16));
    }
    ImGui::PopFont();
}

bool drag_ab(PanelContext& context, const Rect& rect) {
    AbSettings& ab = context.ui.ab;
    if (ab.how != AbHow::Split || !ab_shown(context, context.ui.sheet_enlarged)) return false;
    return drag_split_line(rect, ab.split_held, ab.split_at);
}

void draw_ab_choice(PanelContext& context) {
    AbSettings& ab = context.ui.ab;
    const int view = context.ui.sheet_enlarged;
    std::vector<int> choices{kAgainstNothing};
    if (context.sheet_cells[std::size_t(view)].photo) choices.push_back(kAgainstPhoto);
    for (int other = 0; other < int(context.sheet_cells.size()); ++other)
        if (other != view) choices.push_back(other);
    std::vector<std::string> titles;
    int index = 0;
    for (std::size_t i = 0; i < choices.size(); ++i) {
        titles.push_back(choices[i] == kAgainstNothing ? "Alone" : title_of(context, choices[i]));
        if (choices[i] == ab.against) index = int(i);
    }
    std::vector<Option> options;
    options.reserve(titles.size());
    for (const std::string& title : titles) options.push_back({title, "What the view is held against."});
    if (combo(context, "sheet.against", options, index,
              {.width = std::min(px(190), 0.4f * ImGui::GetContentRegionAvail().x),
               .tooltip = "Hold the view against another one, or against its photo."})) {
        ab.against = choices[std::size_t(index)];
        context.ui.photo_tool = PhotoTool::None;
    }
    if (ab.against == kAgainstNothing) return;
    ImGui::SameLine();
    int how = index_of(kHows, ab.how);
    if (segmented(context, "sheet.how", options_of(kHows), how,
                  std::min(px(300), ImGui::GetContentRegionAvail().x))) {
        ab.how = kHows[std::size_t(how)].value;
        context.ui.photo_tool = PhotoTool::None;
    }
}

void probe_view(PanelContext& context, int view, const Rect& rect) {
    if (!ImGui::IsItemHovered()) return;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    context.result.probed =
        ProbedPoint{view, {(mouse.x - rect.x0) / rect.width(), (mouse.y - rect.y0) / rect.height()}};
}

void draw_probe(PanelContext& context, const Rect& rect) {
    const ProbeValues& values = context.probe;
    ImGui::PushFont(font_of(Face::Small));
    const float line = ImGui::GetFontSize() + px(14);
    float y = rect.y1 - px(4);
    const auto chip = [&](const char* name, std::string_view side, const std::optional<PixelValue>& value) {
        if (!value) return;
        const std::string text = value_text(side, *value);
        const float width = ImGui::CalcTextSize(text.c_str()).x + px(16);
        y -= line;
        draw_chip({rect.x1 - width - px(8), y}, text);
        record_rect(context, name, {rect.x1 - width - px(8), y, rect.x1 - px(8), y + line});
    };
    chip("probe.second", "B", values.second);
    chip("probe.first", values.second ? "A" : "", values.first);
    ImGui::PopFont();
}

}  // namespace patina::ui
