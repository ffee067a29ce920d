#include "ui/widgets.h"

#include "ui/icons.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace patina::ui {
namespace {

constexpr float kTooltipDelay = 0.45f;  // seconds

Rect to_rect(const ImVec2& min, const ImVec2& max) { return {min.x, min.y, max.x, max.y}; }
Rect to_rect(const ImRect& rect) { return to_rect(rect.Min, rect.Max); }

Rect intersection(const Rect& a, const Rect& b) {
    const Rect r{std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
    return r.x1 > r.x0 && r.y1 > r.y0 ? r : Rect{};
}

void push_id(std::string_view name) { ImGui::PushID(name.data(), name.data() + name.size()); }

int grow_string(ImGuiInputTextCallbackData* data) {
    if (data->EventFlag == ImGuiInputTextFlags_CallbackResize) {
        auto& text = *static_cast<std::string*>(data->UserData);
        text.resize(static_cast<std::size_t>(data->BufTextLen));
        data->Buf = text.data();
    }
    return 0;
}

void draw_tab(PanelContext& context, std::string_view strip, const Tab& tab, const Rect& rect,
              std::string& current) {
    push_id(tab.id);
    ImGui::SetCursorScreenPos({rect.x0, rect.y0});
    if (ImGui::InvisibleButton("##tab", {rect.width(), rect.height()})) current = tab.id;
    ImGui::PopID();
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const bool chosen = tab.id == current, hovered = ImGui::IsItemHovered();
    const char* begin = tab.title.data();
    const char* end = begin + tab.title.size();
    ImGui::PushFont(font_of(chosen ? Face::Strong : Face::Body));
    const ImVec2 size = ImGui::CalcTextSize(begin, end);
    const float inset = std::max(2.0f, (rect.width() - size.x) / 2);
    const ImVec2 at{std::round(rect.x0 + inset), std::round((rect.y0 + rect.y1 - size.y) / 2)};
    ImGui::PushStyleColor(ImGuiCol_Text, chosen || hovered ? color::kText : color::kMuted);
    ImGui::RenderTextEllipsis(draw, at, {rect.x1, rect.y1}, rect.x1, rect.x1, begin, end, &size);
    ImGui::PopStyleColor();
    ImGui::PopFont();
    if (chosen) {
        const float edge = std::max(0.0f, inset - px(6));
        draw->AddRectFilled({rect.x0 + edge, rect.y1 - px(2)}, {rect.x1 - edge, rect.y1}, color::kAccent,
                            px(1));
    }
    finish_item(context, std::string(strip) + "." + std::string(tab.id), tab.tooltip,
                std::max(0.0f, size.x - rect.width()));
}

}  // namespace

void record(PanelContext& context, std::string_view name, std::string_view tooltip, float missing_width) {
    if (!context.recorder) return;
    const ImGuiWindow* window = ImGui::GetCurrentWindowRead();
    RecordedItem item;
    item.rect = to_rect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax());
    item.visible = intersection(item.rect, to_rect(window->ClipRect));
    item.panel = to_rect(window->InnerRect);
    item.enabled = (ImGui::GetItemFlags() & ImGuiItemFlags_Disabled) == 0;
    item.missing_width = missing_width;
    item.tooltip = tooltip;
    context.recorder->items.insert_or_assign(std::string(name), std::move(item));
}

void record_rect(PanelContext& context, std::string_view name, const Rect& rect) {
    if (context.recorder)
        context.recorder->items.insert_or_assign(std::string(name), RecordedItem{rect, rect, rect});
}

void redraw_in(PanelContext& context, double seconds) {
    constexpr double after = 0.01;  // a frame just before the change would be followed by another
    context.result.redraw_in_s = std::min(context.result.redraw_in_s, seconds + after);
}

void explain(PanelContext& context, std::string_view text, TextureId picture) {
    const ImGuiContext& imgui = *ImGui::GetCurrentContext();
    if (text.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    if (imgui.ActiveId != 0) return;
    const bool has_timer = imgui.HoveredId != 0 && imgui.HoveredId == ImGui::GetItemID();
    if (has_timer && imgui.HoveredIdTimer < kTooltipDelay)
        return redraw_in(context, static_cast<double>(kTooltipDelay - imgui.HoveredIdTimer));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(px(10), px(7)));
    ImGui::BeginTooltip();
    if (picture) ImGui::Image(std::bit_cast<ImTextureID>(picture), {px(220), px(220)});
    ImGui::PushTextWrapPos(px(300));
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
    ImGui::PopStyleVar();
}

void finish_item(PanelContext& context, std::string_view name, std::string_view tooltip,
                 float missing_width) {
    record(context, name, tooltip, missing_width);
    explain(context, tooltip);
}

void begin_region(PanelContext& context, std::string_view name, const Rect& rect, const RegionStyle& style) {
    constexpr ImGuiWindowFlags fixed =
        ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
        ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoFocusOnAppearing;
    ImGui::SetNextWindowPos({rect.x0, rect.y0});
    ImGui::SetNextWindowSize({std::max(1.0f, rect.width()), std::max(1.0f, rect.height())});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, style.background);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(px(style.padding.x), px(style.padding.y)));
    const std::string title = "##" + std::string(name);
    ImGui::Begin(title.c_str(), nullptr, fixed | style.flags);
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
    record_rect(context, "panel." + std::string(name), rect);
}

void end_region() { ImGui::End(); }

void text_line(PanelContext& context, std::string_view text, ImU32 text_color, float width) {
    const float available = width > 0.0f ? width : ImGui::GetContentRegionAvail().x;
    const ImVec2 size = ImGui::CalcTextSize(text.data(), text.data() + text.size());
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::PushStyleColor(ImGuiCol_Text, text_color);
    ImGui::Dummy({std::min(size.x, std::max(1.0f, available)), size.y});
    ImGui::RenderTextEllipsis(ImGui::GetWindowDrawList(), at, {at.x + available, at.y + size.y},
                              at.x + available, at.x + available, text.data(), text.data() + text.size(),
                              &size);
    ImGui::PopStyleColor();
    if (size.x > available) explain(context, text);
}

void text_wrapped(std::string_view text, ImU32 text_color, Face face, float width) {
    ImGui::PushFont(font_of(face));
    ImGui::PushStyleColor(ImGuiCol_Text, text_color);
    ImGui::PushTextWrapPos(width > 0.0f ? ImGui::GetCursorPosX() + width : 0.0f);
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    ImGui::PopFont();
}

void heading(std::string_view text) {
    ImGui::Dummy({0.0f, px(2)});
    ImGui::PushFont(font_of(Face::Strong));
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
    ImGui::PopFont();
}

bool button(PanelContext& context, std::string_view name, std::string_view text, std::string_view tooltip,
            const ButtonStyle& style) {
    push_id(name);
    const bool primary = style.emphasis == Emphasis::Primary;
    const bool quiet = style.emphasis == Emphasis::Quiet;
    if (primary) {
        ImGui::PushStyleColor(ImGuiCol_Button, color::kAccent);
        ImGui::PushStyleColor(ImGuiCol_ButtonHovered, IM_COL32(98, 206, 180, 255));
        ImGui::PushStyleColor(ImGuiCol_ButtonActive, color::kAccentDim);
        ImGui::PushStyleColor(ImGuiCol_Text, color::kAccentText);
    } else if (quiet) {
        ImGui::PushStyleColor(ImGuiCol_Button, IM_COL32(0, 0, 0, 0));
        ImGui::PushStyleColor(ImGuiCol_ButtonHovered, color::kButton);
        ImGui::PushStyleColor(ImGuiCol_ButtonActive, color::kButtonHover);
        ImGui::PushStyleColor(ImGuiCol_Text, color::kMuted);
    }
    ImGui::BeginDisabled(!style.enabled);
    const std::string label(text);
    const bool pressed = ImGui::Button(label.c_str(), {style.width, 0.0f});
    ImGui::EndDisabled();
    if (primary || quiet) ImGui::PopStyleColor(4);
    ImGui::PopID();
    const float needed = ImGui::CalcTextSize(label.c_str()).x + 2.0f;
    finish_item(context, name, tooltip, std::max(0.0f, needed - ImGui::GetItemRectSize().x));
    return pressed;
}

bool icon_button(PanelContext& context, std::string_view name, const char* icon, std::string_view tooltip,
                 bool enabled) {
    push_id(name);
    const float side = ImGui::GetFrameHeight();
    ImGui::BeginDisabled(!enabled);
    const bool pressed = ImGui::InvisibleButton("##icon", {side, side});
    ImGui::EndDisabled();
    ImGui::PopID();
    const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const bool hovered = enabled && ImGui::IsItemHovered();
    if (hovered)
        draw->AddRectFilled(min, max, ImGui::IsItemActive() ? color::kButtonHover : color::kButton, px(4));
    const ImVec2 size = ImGui::CalcTextSize(icon);
    const ImVec2 at{std::round((min.x + max.x - size.x) / 2), std::round((min.y + max.y - size.y) / 2)};
    draw->AddText(at, !enabled ? color::kOutline : hovered ? color::kText : color::kMuted, icon);
    finish_item(context, name, tooltip);
    return pressed;
}

bool checkbox(PanelContext& context, std::string_view name, const char* text, std::string_view tooltip,
              bool& value) {
    push_id(name);
    ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, 1.0f);
    const bool changed = ImGui::Checkbox(text, &value);
    ImGui::PopStyleVar();
    ImGui::PopID();
    finish_item(context, name, tooltip);
    return changed;
}

bool text_field(PanelContext& context, std::string_view name, std::string& text, std::string_view tooltip,
                const TextFieldStyle& style) {
    push_id(name);
    const ImVec2 padding = ImGui::GetStyle().FramePadding;
    const float left = style.icon ? px(24) : padding.x;
    ImGui::SetNextItemWidth(style.width > 0.0f ? style.width : ImGui::GetContentRegionAvail().x);
    if (style.take_focus) ImGui::SetKeyboardFocusHere();
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(left, padding.y));
    const bool changed =
        ImGui::InputTextWithHint("##text", style.hint, text.data(), text.capacity() + 1,
                                 style.flags | ImGuiInputTextFlags_CallbackResize, grow_string, &text);
    ImGui::PopStyleVar();
    ImGui::PopID();
    if (style.icon) {
        const ImVec2 min = ImGui::GetItemRectMin();
        ImGui::GetWindowDrawList()->AddText({min.x + px(7), min.y + padding.y}, color::kFaint, style.icon);
    }
    finish_item(context, name, tooltip);
    return changed;
}

bool search_field(PanelContext& context, std::string_view name, std::string& text, const char* hint,
                  bool take_focus) {
    const bool filled = !text.empty();
    const float side = ImGui::GetFrameHeight();
    const float width = ImGui::GetContentRegionAvail().x - (filled ? side : 0.0f);
    bool changed =
        text_field(context, name, text, "Type a few letters; every word has to occur.",
                   {.hint = hint, .icon = icon::kSearch, .width = width, .take_focus = take_focus});
    if (filled) {
        ImGui::SameLine(0.0f, 0.0f);
        if (icon_button(context, std::string(name) + ".clear", icon::kClose, "Show everything again.")) {
            text.clear();
            changed = true;
        }
    }
    return changed;
}

bool segmented(PanelContext& context, std::string_view name, std::span<const Option> options, int& index,
               float width) {
    push_id(name);
    const int count = static_cast<int>(options.size());
    const float full = width > 0.0f ? width : ImGui::GetContentRegionAvail().x;
    const float height = ImGui::GetFrameHeight();
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw->AddRectFilled(origin, {origin.x + full, origin.y + height}, color::kField, px(4));
    bool changed = false;
    for (int i = 0; i < count; ++i) {
        const Option& option = options[static_cast<std::size_t>(i)];
        const float x0 = std::round(full * static_cast<float>(i) / static_cast<float>(count));
        const float x1 = std::round(full * static_cast<float>(i + 1) / static_cast<float>(count));
        if (i > 0) ImGui::SameLine(0.0f, 0.0f);
        ImGui::PushID(i);
        if (ImGui::InvisibleButton("##option", {x1 - x0, height}) && index != i) {
            index = i;
            changed = true;
        }
        ImGui::PopID();
        const bool hovered = ImGui::IsItemHovered();
        const ImVec2 min{origin.x + x0 + 2.0f, origin.y + 2.0f},
            max{origin.x + x1 - 2.0f, origin.y + height - 2.0f};
        if (i == index)
            draw->AddRectFilled(min, max, color::kButtonHover, px(3));
        else if (hovered)
            draw->AddRectFilled(min, max, color::kCardHover, px(3));
        const ImVec2 size =
            ImGui::CalcTextSize(option.title.data(), option.title.data() + option.title.size());
        const ImVec2 at{std::round((min.x + max.x - size.x) / 2), std::round((min.y + max.y - size.y) / 2)};
        draw->AddText(at, i == index ? color::kText : color::kMuted, option.title.data(),
                      option.title.data() + option.title.size());
        finish_item(context, recorded_name(name, option.title), option.tooltip,
                    std::max(0.0f, size.x - (max.x - min.x)));
    }
    ImGui::PopID();
    return changed;
}

namespace {

/// What a closed combo shows: icon, title cut to fit, chevron. Drawn over ImGui's empty frame.
float draw_combo_preview(const Rect& rect, const ComboStyle& style, std::string_view title) {
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const float pad = ImGui::GetStyle().FramePadding.x, y = rect.y0 + ImGui::GetStyle().FramePadding.y;
    float x = rect.x0 + pad;
    if (style.icon) {
        draw->AddText({x, y}, color::kMuted, style.icon);
        x += px(22);
    }
    const ImVec2 arrow = ImGui::CalcTextSize(icon::kDown);
    draw->AddText({rect.x1 - arrow.x - px(6), y}, color::kMuted, icon::kDown);
    const float end = rect.x1 - arrow.x - px(8);
    const ImVec2 size = ImGui::CalcTextSize(title.data(), title.data() + title.size());
    ImGui::RenderTextEllipsis(draw, {x, y}, {end, rect.y1}, end, end, title.data(),
                              title.data() + title.size(), &size);
    return std::max(0.0f, x + size.x - end);
}

}  // namespace

bool combo(PanelContext& context, std::string_view name, std::span<const Option> options, int& index,
           const ComboStyle& style) {
    push_id(name);
    const bool valid = index >= 0 && index < static_cast<int>(options.size());
    const std::string_view title = !style.preview.empty() ? style.preview
                                   : valid                ? options[static_cast<std::size_t>(index)].title
                                                          : std::string_view{};
    const float width = style.width > 0.0f ? style.width : ImGui::GetContentRegionAvail().x;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const Rect rect{at.x, at.y, at.x + width, at.y + ImGui::GetFrameHeight()};
    ImGui::SetNextItemWidth(width);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(px(8), px(8)));
    const bool open =
        ImGui::BeginCombo("##combo", "", ImGuiComboFlags_HeightLargest | ImGuiComboFlags_NoArrowButton);
    ImGui::PopStyleVar();
    bool changed = false;
    if (open) {
        for (int i = 0; i < static_cast<int>(options.size()); ++i) {
            const Option& option = options[static_cast<std::size_t>(i)];
            ImGui::PushID(i);
            if (ImGui::Selectable(std::string(option.title).c_str(), i == index)) {
                changed = index != i;
                index = i;
            }
            ImGui::PopID();
            finish_item(context, recorded_name(name, option.title), option.tooltip);
        }
        ImGui::EndCombo();
    }
    ImGui::PopID();
    const float missing = draw_combo_preview(rect, style, title);
    finish_item(context, name, style.tooltip, missing);
    return changed;
}

void tab_strip(PanelContext& context, std::string_view name, std::span<const Tab> tabs,
               std::string& current) {
    if (tabs.empty()) return;
    if (std::none_of(tabs.begin(), tabs.end(), [&](const Tab& tab) { return tab.id == current; }))
        current = tabs[0].id;
    ImGui::PushFont(font_of(Face::Strong));
    std::vector<ImVec2> sizes;
    float words = 0.0f;
    for (const Tab& tab : tabs) {
        sizes.push_back(ImGui::CalcTextSize(tab.title.data(), tab.title.data() + tab.title.size()));
        words += sizes.back().x;
    }
    ImGui::PopFont();
    const float height = px(32), full = ImGui::GetContentRegionAvail().x;
    const float spare = (full - words) / static_cast<float>(tabs.size());  // negative: the words are cut
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    ImDrawList* draw = ImGui::GetWindowDrawList();
    push_id(name);
    float x = origin.x;
    for (std::size_t i = 0; i < tabs.size(); ++i) {
        const float width = std::max(px(12), sizes[i].x + spare);
        draw_tab(context, name, tabs[i], {x, origin.y, x + width, origin.y + height}, current);
        x += width;
    }
    ImGui::PopID();
    draw->AddLine({origin.x, origin.y + height}, {origin.x + full, origin.y + height}, color::kLine);
}

void draw_thumbnail(const Rect& rect, TextureId texture, const char* placeholder, ImU32 outline) {
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const ImVec2 min{rect.x0, rect.y0}, max{rect.x1, rect.y1};
    if (texture) {
        draw->AddImageRounded(std::bit_cast<ImTextureID>(texture), min, max, {0, 0}, {1, 1}, IM_COL32_WHITE,
                              px(4));
    } else {
        draw->AddRectFilled(min, max, color::kField, px(4));
        if (placeholder) {
            const ImVec2 size = ImGui::CalcTextSize(placeholder);
            draw->AddText(
                {std::round((min.x + max.x - size.x) / 2), std::round((min.y + max.y - size.y) / 2)},
                color::kFaint, placeholder);
        }
    }
    if (outline) draw->AddRect(min, max, outline, px(4));
}

bool card(PanelContext& context, std::string_view name, const CatalogItem& item, const CardStyle& style) {
    push_id(name);
    const float picture = std::round(style.width / style.aspect);
    const float text_height = font_of(Face::Small)->FontSize * ImGui::GetIO().FontGlobalScale;
    const float pad = px(4);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool pressed = ImGui::InvisibleButton("##card", {style.width, picture + text_height + 2.0f * pad});
    ImGui::PopID();
    if (ImGui::IsItemVisible()) context.result.cards_seen.push_back(item.id);
    const bool hovered = ImGui::IsItemHovered();
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const ImVec2 max = ImGui::GetItemRectMax();
    if (hovered || style.selected)
        draw->AddRectFilled({at.x - pad, at.y - pad}, {max.x + pad, max.y}, color::kCard, px(6));
    draw_thumbnail({at.x, at.y, at.x + style.width, at.y + picture}, item.thumbnail, style.placeholder);
    if (style.selected)
        draw->AddRect({at.x - pad + 1, at.y - pad + 1}, {max.x + pad - 1, max.y - 1}, color::kAccent, px(6),
                      0, px(1.5f));
    ImGui::PushFont(font_of(Face::Small));
    const char* begin = item.title.data();
    const char* end = begin + item.title.size();
    const ImVec2 size = ImGui::CalcTextSize(begin, end);
    const float inset = std::max(0.0f, std::round((style.width - size.x) / 2));
    ImGui::PushStyleColor(ImGuiCol_Text, style.selected || hovered ? color::kText : color::kMuted);
    ImGui::RenderTextEllipsis(draw, {at.x + inset, at.y + picture + pad}, {at.x + style.width, max.y},
                              at.x + style.width, at.x + style.width, begin, end, &size);
    ImGui::PopStyleColor();
    ImGui::PopFont();
    const std::string about = item.title + (item.description.empty() ? "" : "\n" + item.description);
    finish_item(context, name, about);
    return pressed;
}

void progress_bar(float fraction, const ImVec2& size) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::Dummy(size);
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw->AddRectFilled(at, {at.x + size.x, at.y + size.y}, color::kButton, size.y / 2);
    const bool known = fraction >= 0.0f;
    const float filled = size.x * (known ? std::clamp(fraction, 0.0f, 1.0f) : 1.0f);
    if (filled >= 1.0f)
        draw->AddRectFilled(at, {at.x + filled, at.y + size.y}, known ? color::kAccent : color::kAccentDim,
                            size.y / 2);
}

}  // namespace patina::ui
