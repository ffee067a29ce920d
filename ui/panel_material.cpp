// The inspector's material page, drawn from the table of parameters: a card for each map slot, rows for the
// rest.
#include "materials/params.h"
#include "ui/icons.h"
#include "ui/material_hints.h"
#include "ui/panels.h"
#include "ui/values.h"
#include "ui/widgets.h"
#include "ui/workspace.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

namespace patina::ui {
namespace {

constexpr float kThumb = 50.0f;        // at scale 1
constexpr double kFlashSeconds = 0.8;  // a card lights up when something was dropped on it

std::string name_of(std::string_view key, const char* what = nullptr) {
    std::string name = "material." + std::string(key);
    return what ? name + "." + what : name;
}

template <class T, std::size_t n>
bool choose(PanelContext& context, const std::string& name, const std::array<Choice<T>, n>& table, T& value,
            float width) {
    std::array<Option, n> options;
    int index = 0;
    for (std::size_t i = 0; i < n; ++i) {
        options[i] = {table[i].title, table[i].tooltip};
        if (table[i].value == value) index = static_cast<int>(i);
    }
    if (!segmented(context, name, options, index, width)) return false;
    value = table[static_cast<std::size_t>(index)].value;
    return true;
}

bool choose_channel(PanelContext& context, const std::string& name, Channel& value, float width) {
    static constexpr std::array letters{"R", "G", "B", "A"};
    std::array<Option, letters.size()> options;
    for (std::size_t i = 0; i < letters.size(); ++i) options[i] = {letters[i], kChannels[i].tooltip};
    int index = static_cast<int>(value);
    if (!segmented(context, name, options, index, width)) return false;
    value = kChannels[static_cast<std::size_t>(index)].value;
    return true;
}

NumberRow number_of(const MaterialParam& param, std::string_view name, float reset, float saved) {
    return {.name = name,
            .label = param.label,
            .tooltip = param.tooltip,
            .min = param.range.slider_min,
            .max = param.range.slider_max,
            .hard_min = param.range.min,
            .hard_max = param.range.max,
            .reset = reset,
            .saved = saved,
            .format = param.unit == "°" ? "%.1f°" : "%.3f",
            .step = param.unit == "°"                                        ? 0.5f
                    : param.range.slider_max - param.range.slider_min > 5.0f ? 0.01f
                                                                             : 0.001f};
}

/// Where a value's row lies.
struct Line {
    float left, width;
};

// ---- colours that may exceed 1: a colour and its strength ----

float strength_of(const glm::vec3& color) { return std::max({color.x, color.y, color.z}); }

void draw_bright_color(PanelContext& context, const MaterialParam& param, glm::vec3& value,
                       const glm::vec3& saved, const Line& line) {
    const float strength = strength_of(value);
    glm::vec3& memory = context.ui.emission_color;
    if (strength > 0.0f) memory = value / strength;
    glm::vec3 tint = memory;
    const std::string name = name_of(param.key);
    const ColorRow color{.name = name,
                         .tooltip = param.tooltip,
                         .reset = glm::vec3{1.0f},
                         .saved = tint,
                         .faded = strength == 0.0f};
    if (color_value(context, color, tint, line.width)) {
        const float peak = strength_of(tint);
        memory = peak > 0.0f ? tint / peak : glm::vec3{1.0f};
        value = tint * (strength > 0.0f ? strength : 1.0f);
    }
    const std::string strength_name = name_of(param.key, "strength");
    NumberRow row = number_of(param, strength_name, 0.0f, strength_of(saved));
    row.step = 0.05f;
    row.tooltip = "How bright it glows: 1 is as bright as a white sheet in unit light; a lamp is far beyond.";
    float edited = strength;
    ImGui::SetCursorScreenPos({line.left, ImGui::GetCursorScreenPos().y});
    if (number_value(context, row, edited, line.width)) value = memory * edited;
}

// ---- one card ----

/// A rounded background drawn behind what is laid out between its construction and close().
class Card {
public:
    Card() : min_(ImGui::GetCursorScreenPos()), width_(ImGui::GetContentRegionAvail().x) {
        splitter_.Split(ImGui::GetWindowDrawList(), 2);
        splitter_.SetCurrentChannel(ImGui::GetWindowDrawList(), 1);
        ImGui::SetCursorScreenPos({min_.x + px(8), min_.y + px(8)});
        ImGui::BeginGroup();
    }
    float left() const { return min_.x + px(8); }
    float right() const { return min_.x + width_ - px(8); }
    /// Ends the layout; then the card's size is known.
    Rect measure() {
        ImGui::EndGroup();
        bottom_ = ImGui::GetItemRectMax().y + px(8);
        return {min_.x, min_.y, min_.x + width_, bottom_};
    }
    void close(bool highlighted) {
        ImDrawList* draw = ImGui::GetWindowDrawList();
        splitter_.SetCurrentChannel(draw, 0);
        const ImVec2 max{min_.x + width_, bottom_};
        draw->AddRectFilled(min_, max, highlighted ? color::kCardHover : color::kCard, px(6));
        if (highlighted) draw->AddRect(min_, max, color::kAccent, px(6), 0, px(2));
        splitter_.Merge(draw);
        ImGui::SetCursorScreenPos(min_);
        ImGui::Dummy({width_, bottom_ - min_.y});
    }

private:
    ImDrawListSplitter splitter_;
    ImVec2 min_;
    float width_;
    float bottom_ = 0.0f;
};

void draw_invitation(const Rect& rect) {
    static constexpr std::array lines{"Drop an", "image", "here"};
    ImGui::PushFont(font_of(Face::Small));
    const float line = ImGui::GetFontSize() + 1.0f;
    float y = std::round((rect.y0 + rect.y1 - line * static_cast<float>(lines.size())) / 2);
    for (const char* text : lines) {
        const float x = std::round((rect.x0 + rect.x1 - ImGui::CalcTextSize(text).x) / 2);
        ImGui::GetWindowDrawList()->AddText({x, y}, color::kFaint, text);
        y += line;
    }
    ImGui::PopFont();
}

void draw_map_thumbnail(PanelContext& context, const MaterialSlot& slot, const MapStatus& map) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float side = px(kThumb);
    const bool empty = map.state == MapState::None;
    const bool bad = map.state == MapState::Missing || map.state == MapState::Broken;
    const std::string name = name_of(slot.key, "thumbnail");
    ImGui::PushID(name.c_str());
    const bool pressed = ImGui::InvisibleButton("##thumbnail", {side, side});
    ImGui::PopID();
    const char* placeholder = bad ? icon::kWarning : empty ? nullptr : icon::kWorking;
    const Rect rect{at.x, at.y, at.x + side, at.y + side};
    draw_thumbnail(rect, map.thumbnail, placeholder,
                   bad                      ? color::kWarning
                   : ImGui::IsItemHovered() ? color::kMuted
                                            : color::kOutline);
    if (empty) draw_invitation(rect);
    const std::string about = empty ? std::string(slot.tooltip) + " Drop one here, or click to choose a file."
                              : map.full_path.empty() ? std::string(slot.tooltip)
                                                      : map.full_path + "\n" + bytes_text(map.file_bytes);
    finish_item(context, name, about);
    if (pressed)
        open_browser(context, bad ? BrowserPurpose::LocateMap : BrowserPurpose::AssignMap, slot.slot);
}

/// Browse, reload or locate, and clear, at the right end of the title line.
void draw_map_buttons(PanelContext& context, const MaterialSlot& slot, const MapStatus& map, float right) {
    const float side = ImGui::GetFrameHeight();
    const bool has_map = map.state != MapState::None;
    ImGui::SameLine();
    ImGui::SetCursorScreenPos({right - side * (has_map ? 2.0f : 1.0f), ImGui::GetCursorScreenPos().y});
    if (icon_button(context, name_of(slot.key, "browse"), icon::kBrowse,
                    "Choose a picture file for this slot."))
        open_browser(context, BrowserPurpose::AssignMap, slot.slot);
    if (!has_map) return;
    ImGui::SameLine(0.0f, 0.0f);
    if (icon_button(context, name_of(slot.key, "clear"), icon::kClose,
                    "Take the map out of this slot; the value stays."))
        context.requests.push_back(request::ClearMap{slot.slot});
}

std::string facts_of(const MapStatus& map) {
    static constexpr std::array channel_names{"", "grey", "grey+A", "RGB", "RGBA"};
    if (map.state == MapState::Loading) return "Loading…";
    if (map.width <= 0) return "";
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "%d × %d  ·  %d-bit %s", map.width, map.height, map.bits,
                  channel_names[static_cast<std::size_t>(std::clamp(map.channels, 0, 4))]);
    return text.data();
}

void draw_map_options(PanelContext& context, const MaterialSlot& slot, const MapRef& ref, float right) {
    const float width = right - ImGui::GetCursorScreenPos().x;
    if (ref.color_space)
        choose(context, name_of(slot.key, "color_space"), kColorSpaces, *ref.color_space, width);
    if (ref.convention)
        choose(context, name_of(slot.key, "convention"), kNormalConventions, *ref.convention, width);
    if (!ref.channel) return;
    const float invert = px(84);
    choose_channel(context, name_of(slot.key, "channel"), *ref.channel, width - invert);
    ImGui::SameLine(0.0f, px(10));
    checkbox(context, name_of(slot.key, "invert"), "Invert",
             "Take 1 − the map: for a glossiness map in the roughness slot.", *ref.invert);
}

void draw_map_problem(PanelContext& context, const MaterialSlot& slot, const MapStatus& map, float width) {
    text_wrapped(map.message, color::kWarning, Face::Small, width);
    if (button(context, name_of(slot.key, "locate"), "Locate file…",
               "Show where the file is now; other missing maps beside it are found as well."))
        open_browser(context, BrowserPurpose::LocateMap, slot.slot);
    ImGui::SameLine();
    if (button(context, name_of(slot.key, "reload"), "Try again", "Read the file once more.",
               {.emphasis = Emphasis::Quiet}))
        context.requests.push_back(request::ReloadMap{slot.slot});
}

/// The map's name, its facts at the right end of the same line, and how it is read.
void draw_map_lines(PanelContext& context, const MaterialSlot& slot, const MapStatus& map, const MapRef& ref,
                    float right) {
    ImGui::PushFont(font_of(Face::Small));
    const std::string facts = facts_of(map);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float facts_width = ImGui::CalcTextSize(facts.c_str()).x;
    text_line(context, file_name_of(*ref.map), color::kText, right - at.x - facts_width - px(10));
    ImGui::GetWindowDrawList()->AddText({right - facts_width, at.y}, color::kMuted, facts.c_str());
    ImGui::PopFont();
    if (map.state == MapState::Missing || map.state == MapState::Broken)
        draw_map_problem(context, slot, map, right - at.x);
    draw_map_options(context, slot, ref, right);
}

void draw_hint(std::string_view text, float width) {
    if (text.empty()) return;
    text_wrapped(std::string(icon::kInfo) + "  " + std::string(text), color::kWarning, Face::Small, width);
}

/// Value and map of one slot are as saved?
bool slot_changed(const PanelContext& context, const MaterialParam& param, MapSlot slot) {
    const auto now = values_of(param, std::as_const(context.material));
    const auto saved = values_of(param, context.saved_material);
    if (!std::equal(now.begin(), now.end(), saved.begin())) return true;
    const ConstMapRef a = map_of(std::as_const(context.material), slot),
                      b = map_of(context.saved_material, slot);
    if (*a.map != *b.map) return true;
    if (a.map->empty()) return false;
    const auto differ = [](const auto* x, const auto* y) { return x && y && *x != *y; };
    return differ(a.color_space, b.color_space) || differ(a.channel, b.channel) ||
           differ(a.invert, b.invert) || differ(a.convention, b.convention);
}

void draw_slot_value(PanelContext& context, const MaterialParam& param, const MaterialSlot& slot,
                     const Line& line) {
    const Material defaults;
    const auto now = values_of(param, context.material);
    const auto saved = values_of(param, context.saved_material);
    const auto reset = values_of(param, defaults);
    const std::string name = name_of(slot.key);
    if (param.kind != ParamKind::Color) {
        number_value(context, number_of(param, name, reset[0], saved[0]), now[0], line.width);
        return;
    }
    glm::vec3 value{now[0], now[1], now[2]};
    const glm::vec3 saved_value{saved[0], saved[1], saved[2]};
    if (param.range.max > 1.0f) {
        draw_bright_color(context, param, value, saved_value, line);
    } else {
        const ColorRow row{.name = name,
                           .tooltip = param.tooltip,
                           .reset = {reset[0], reset[1], reset[2]},
                           .saved = saved_value};
        color_value(context, row, value, line.width);
    }
    for (int c = 0; c < 3; ++c) now[static_cast<std::size_t>(c)] = value[c];
}

void draw_slot_title(PanelContext& context, const MaterialParam& param, const MaterialSlot& slot,
                     float right) {
    const MapStatus& map = context.maps[static_cast<std::size_t>(slot.slot)];
    const float side = ImGui::GetFrameHeight(), left = ImGui::GetCursorScreenPos().x;
    const std::string name = name_of(slot.key);
    const float buttons = side * (map.state == MapState::None ? 1.0f : 2.0f);
    ImGui::PushFont(font_of(Face::Strong));
    const LabelAction action = row_label(context, {.name = name,
                                                   .text = param.label,
                                                   .tooltip = param.tooltip,
                                                   .changed = slot_changed(context, param, slot.slot),
                                                   .at_default = is_default(param, context.material),
                                                   .width = right - left - buttons});
    ImGui::PopFont();
    if (action == LabelAction::Reset) reset(param, context.material);
    if (action == LabelAction::Revert) {
        const auto from = values_of(param, context.saved_material);
        std::copy(from.begin(), from.end(), values_of(param, context.material).begin());
    }
    draw_map_buttons(context, slot, map, right);
}

/// Is something dragged over this card, or was just dropped on it? Notes which slot a drop hits.
bool is_drop_target(PanelContext& context, MapSlot slot, const Rect& card) {
    const ImVec2 min = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    const Rect window{min.x, min.y, min.x + size.x, min.y + size.y};
    const auto inside = [&](const glm::vec2& at) {
        return card.contains(at.x, at.y) && window.contains(at.x, at.y);
    };
    UiState& ui = context.ui;
    if (context.drop && inside(context.drop->position)) {
        ui.hit_slot = slot;
        ui.hit_time = ImGui::GetTime();
    }
    const double flashed = ImGui::GetTime() - ui.hit_time;
    const bool flashing = ui.hit_slot == slot && flashed < kFlashSeconds;
    if (flashing) redraw_in(context, kFlashSeconds - flashed);
    return flashing || (context.drag_over && inside(*context.drag_over));
}

void draw_slot_card(PanelContext& context, const MaterialParam& param, std::string_view hint) {
    const MaterialSlot& slot = slot_row(*param.slot);
    const MapStatus& map = context.maps[static_cast<std::size_t>(slot.slot)];
    const MapRef ref = map_of(context.material, slot.slot);
    Card card;
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    draw_map_thumbnail(context, slot, map);
    const float left = origin.x + px(kThumb + 8);
    ImGui::SetCursorScreenPos({left, origin.y});
    draw_slot_title(context, param, slot, card.right());
    const Line line{left + px(10), card.right() - left - px(10)};
    ImGui::SetCursorScreenPos({line.left, origin.y + ImGui::GetFrameHeight() + px(5)});
    draw_slot_value(context, param, slot, line);
    if (!ref.map->empty() || !hint.empty())
        ImGui::SetCursorScreenPos(
            {card.left(), std::max(ImGui::GetCursorScreenPos().y, origin.y + px(kThumb + 5))});
    if (!ref.map->empty()) draw_map_lines(context, slot, map, ref, card.right());
    draw_hint(hint, card.right() - card.left());
    const Rect rect = card.measure();
    card.close(is_drop_target(context, slot.slot, rect));
    record(context, name_of(slot.key, "card"));
}

// ---- rows without a map ----

void draw_plain_row(PanelContext& context, const MaterialParam& param) {
    static constexpr std::array axes{"x", "y", "z"};
    const Material defaults;
    const auto now = values_of(param, context.material);
    const auto saved = values_of(param, context.saved_material);
    const auto reset = values_of(param, defaults);
    for (std::size_t c = 0; c < now.size(); ++c) {
        const std::string name = now.size() > 1 ? name_of(param.key, axes[c]) : name_of(param.key);
        const std::string label = now.size() > 1 ? std::string(param.label) + (c == 0 ? " across" : " up")
                                                 : std::string(param.label);
        NumberRow row = number_of(param, name, reset[c], saved[c]);
        row.label = label;
        row.logarithmic = param.range.slider_min > 0.0f;
        row.wraps = param.unit == "°";
        number_row(context, row, now[c]);
    }
}

void draw_header(PanelContext& context) {
    const bool renamed = context.material.name != context.saved_material.name;
    text_row(context,
             {.name = "material.name",
              .label = "Name",
              .tooltip = "The material's name, as the library shows it.",
              .hint = "Untitled",
              .changed = renamed,
              .width = px(56)},
             context.material.name);
    if (!context.material.source.empty()) text_wrapped(context.material.source, color::kMuted, Face::Small);
    if (button(context, "material.import", "Import maps of a folder…",
               "Choose the folder of a scanned material: each file is matched to its slot by its name. "
               "Dropping it works too.",
               {.width = ImGui::GetContentRegionAvail().x}))
        open_browser(context, BrowserPurpose::ImportFolder);
}

std::string_view hint_of(const Material& material, std::string_view key) {
    if (key == "albedo") return albedo_hint(material);
    if (key == "metallic") return metallic_hint(material);
    return {};
}

}  // namespace

void draw_material_panel(PanelContext& context) {
    draw_header(context);
    for (const MaterialParam& param : kMaterialParams)
        if (param.slot) draw_slot_card(context, param, hint_of(context.material, param.key));
    for (const auto& group : kParamGroups) {
        const auto belongs = [&](const MaterialParam& param) {
            return !param.slot && param.group == group.value;
        };
        if (std::none_of(kMaterialParams.begin(), kMaterialParams.end(), belongs)) continue;
        heading(group.title);
        for (const MaterialParam& param : kMaterialParams)
            if (belongs(param)) draw_plain_row(context, param);
    }
}

}  // namespace patina::ui
