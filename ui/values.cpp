#include "ui/values.h"

#include "renderer/core/image.h"
#include "ui/icons.h"
#include "ui/widgets.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace patina::ui {
namespace {

std::string part(std::string_view name, const char* what) { return std::string(name) + "." + what; }

float to_fraction(const NumberRow& row, float value) {
    const float v = std::clamp(value, row.min, row.max);
    if (row.logarithmic) return std::log(v / row.min) / std::log(row.max / row.min);
    return (v - row.min) / (row.max - row.min);
}

float from_fraction(const NumberRow& row, float fraction) {
    if (row.wraps)
        fraction -= std::floor(fraction);
    else
        fraction = std::clamp(fraction, 0.0f, 1.0f);
    if (row.logarithmic) {
        const float value = row.min * std::pow(row.max / row.min, fraction);
        const float step = std::pow(10.0f, std::floor(std::log10(value)) - 1.0f);  // two significant digits
        return std::clamp(std::round(value / step) * step, row.min, row.max);
    }
    const float value = row.min + fraction * (row.max - row.min);
    return std::clamp(std::round(value / row.step) * row.step, row.min, row.max);
}

/// Moves the held bar: as far from where the drag began as the mouse, a tenth of it with Shift.
bool drag_bar(PanelContext& context, const NumberRow& row, float& value, float width) {
    const ImGuiIO& io = ImGui::GetIO();
    BarDrag& drag = context.ui.bar_drag;
    if (ImGui::IsItemActivated() || drag.fine != io.KeyShift) {
        drag = {io.MousePos.x, to_fraction(row, value), io.KeyShift};
        return false;
    }
    if (!ImGui::IsMouseDragging(ImGuiMouseButton_Left, px(2))) return false;
    const float moved = (io.MousePos.x - drag.from_x) / width * (drag.fine ? 0.1f : 1.0f);
    const float next = from_fraction(row, drag.from_fraction + moved);
    if (next == value) return false;
    value = next;
    return true;
}

bool number_field(PanelContext& context, const NumberRow& row, float& value, float width) {
    ImGui::PushID(row.name.data(), row.name.data() + row.name.size());
    ImGui::SetNextItemWidth(width);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(px(6), ImGui::GetStyle().FramePadding.y));
    float typed = value;
    const bool edited =
        ImGui::InputFloat("##number", &typed, 0.0f, 0.0f, row.format, ImGuiInputTextFlags_AutoSelectAll);
    ImGui::PopStyleVar();
    ImGui::PopID();
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), row.format, static_cast<double>(value));
    const float needed = ImGui::CalcTextSize(text.data()).x + px(8);
    finish_item(context, part(row.name, "number"), row.tooltip, std::max(0.0f, needed - width));
    if (!edited || !std::isfinite(typed)) return false;
    typed = std::clamp(typed, row.hard_min, row.hard_max);
    const bool changed = typed != value;
    value = typed;
    return changed;
}

/// Shows the encoded colour in ImGui's picker; writes back only the channels it changed.
bool pick_color(glm::vec3& value) {
    std::array<float, 3> encoded{};
    for (int c = 0; c < 3; ++c) encoded[static_cast<std::size_t>(c)] = linear_to_srgb(value[c]);
    std::array<float, 3> before = encoded;
    constexpr ImGuiColorEditFlags flags = ImGuiColorEditFlags_NoSidePreview | ImGuiColorEditFlags_NoAlpha |
                                          ImGuiColorEditFlags_DisplayRGB | ImGuiColorEditFlags_DisplayHSV |
                                          ImGuiColorEditFlags_PickerHueBar |
                                          ImGuiColorEditFlags_NoSmallPreview | ImGuiColorEditFlags_NoLabel;
    ImGui::SetNextItemWidth(px(220));
    if (!ImGui::ColorPicker3("##picker", encoded.data(), flags)) return false;
    bool changed = false;
    for (int c = 0; c < 3; ++c) {
        const auto i = static_cast<std::size_t>(c);
        if (encoded[i] == before[i]) continue;
        value[c] = srgb_to_linear(std::clamp(encoded[i], 0.0f, 1.0f));
        changed = true;
    }
    return changed;
}

bool swatch(PanelContext& context, const ColorRow& row, glm::vec3& value, float width) {
    const float height = ImGui::GetFrameHeight();
    if (ImGui::InvisibleButton("##swatch", {width, height})) ImGui::OpenPopup("picker");
    const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    const auto byte = [](float linear) {
        return static_cast<int>(std::lround(255.0f * std::clamp(linear_to_srgb(linear), 0.0f, 1.0f)));
    };
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw->AddRectFilled(min, max, IM_COL32(byte(value.x), byte(value.y), byte(value.z), 255), px(4));
    if (row.faded) draw->AddRectFilled(min, max, color::kVeil, px(4));
    draw->AddRect(min, max, ImGui::IsItemHovered() ? color::kMuted : color::kOutline, px(4));
    std::array<char, 96> linear{};
    std::snprintf(linear.data(), linear.size(), "\nLinear %.3f, %.3f, %.3f", static_cast<double>(value.x),
                  static_cast<double>(value.y), static_cast<double>(value.z));
    const bool double_clicked = ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
    finish_item(context, part(row.name, "swatch"), std::string(row.tooltip) + linear.data());
    bool changed = false;
    if (ImGui::BeginPopup("picker")) {
        changed = pick_color(value);
        ImGui::EndPopup();
    }
    if (double_clicked && value != row.reset) {
        value = row.reset;
        changed = true;
    }
    return changed;
}

bool code_field(PanelContext& context, const ColorRow& row, glm::vec3& value, float width) {
    std::array<char, 16> text{};
    const std::array<char, 8> code = color_code(value);
    std::copy(code.begin(), code.end(), text.begin());
    ImGui::SetNextItemWidth(width);
    const bool edited =
        ImGui::InputText("##code", text.data(), text.size(),
                         ImGuiInputTextFlags_AutoSelectAll | ImGuiInputTextFlags_CharsUppercase |
                             ImGuiInputTextFlags_CharsNoBlank);
    finish_item(context, part(row.name, "code"),
                "The colour as sRGB code, as image editors write it: #C8A45C.");
    if (!edited) return false;
    const std::optional<glm::vec3> typed = color_of_code(text.data());
    if (!typed || color_code(*typed) == code) return false;
    value = *typed;
    return true;
}

}  // namespace

float label_width() { return px(106); }

LabelAction row_label(PanelContext& context, const RowLabel& label) {
    const float height = ImGui::GetFrameHeight(), dot = px(10);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::PushID(label.name.data(), label.name.data() + label.name.size());
    const float width = label.width > 0.0f ? label.width : label_width();
    ImGui::InvisibleButton("##label", {width, height});
    LabelAction action = LabelAction::None;
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
        action = LabelAction::Reset;
    const ImVec2 size = ImGui::CalcTextSize(label.text.data(), label.text.data() + label.text.size());
    ImDrawList* draw = ImGui::GetWindowDrawList();
    if (label.changed) draw->AddCircleFilled({at.x + px(3), at.y + height / 2}, px(2.5f), color::kAccent);
    const ImVec2 text_at{at.x + dot, std::round(at.y + (height - size.y) / 2)};
    const float room = width - dot - px(4);
    ImGui::PushStyleColor(ImGuiCol_Text,
                          ImGui::IsItemHovered() ? color::kText : IM_COL32(196, 196, 197, 255));
    ImGui::RenderTextEllipsis(draw, text_at, {text_at.x + room, text_at.y + size.y}, text_at.x + room,
                              text_at.x + room, label.text.data(), label.text.data() + label.text.size(),
                              &size);
    ImGui::PopStyleColor();
    finish_item(context, part(label.name, "label"), label.tooltip, std::max(0.0f, size.x - room));
    if (ImGui::BeginPopupContextItem("##menu")) {
        if (ImGui::MenuItem("Reset to default", nullptr, false, !label.at_default))
            action = LabelAction::Reset;
        finish_item(context, part(label.name, "reset"),
                    "The value of a new material; a double-click does the same.");
        if (ImGui::MenuItem("Back to the saved value", nullptr, false, label.changed))
            action = LabelAction::Revert;
        finish_item(context, part(label.name, "revert"), "The value that the file holds.");
        ImGui::EndPopup();
    }
    ImGui::PopID();
    ImGui::SameLine(0.0f, 0.0f);
    return action;
}

bool number_bar(PanelContext& context, const NumberRow& row, float& value, float width) {
    ImGui::PushID(row.name.data(), row.name.data() + row.name.size());
    const float height = ImGui::GetFrameHeight();
    ImGui::InvisibleButton("##bar", {width, height});
    const bool active = ImGui::IsItemActive(), hovered = ImGui::IsItemHovered();
    bool changed = active && drag_bar(context, row, value, width);
    if (hovered && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && value != row.reset) {
        value = row.reset;
        changed = true;
        context.ui.bar_drag.from_fraction = to_fraction(row, value);
    }
    ImGui::PopID();
    const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw->AddRectFilled(min, max, hovered || active ? color::kFieldHover : color::kField, px(4));
    // A bar whose range has a zero inside is filled from there.
    const float zero = row.logarithmic || row.min >= 0.0f ? 0.0f : to_fraction(row, 0.0f);
    const float here = to_fraction(row, value);
    const float x0 = min.x + width * std::min(zero, here), x1 = min.x + width * std::max(zero, here);
    if (x1 - x0 > 0.5f) {
        draw->PushClipRect({x0, min.y}, {x1, max.y}, true);
        draw->AddRectFilled(min, max, active ? color::kAccentDim : color::kFill, px(4));
        draw->PopClipRect();
    }
    const float x = std::clamp(min.x + width * here, min.x + 1.0f, max.x - px(2));
    draw->AddRectFilled({x - px(1), min.y + px(4)}, {x + px(1), max.y - px(4)},
                        active    ? color::kAccent
                        : hovered ? color::kText
                                  : color::kMuted,
                        px(1));
    if (hovered || active) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    finish_item(context, part(row.name, "bar"), row.tooltip);
    return changed;
}

bool number_value(PanelContext& context, const NumberRow& row, float& value, float width) {
    const float number = px(row.number_width), gap = px(6);
    const float full = width > 0.0f ? width : ImGui::GetContentRegionAvail().x;
    const float bar = std::max(px(24), full - number - gap);
    bool changed = number_bar(context, row, value, bar);
    ImGui::SameLine(0.0f, gap);
    changed |= number_field(context, row, value, number);
    return changed;
}

bool text_row(PanelContext& context, const TextRow& row, std::string& text) {
    const LabelAction action = row_label(context, {.name = row.name,
                                                   .text = row.label,
                                                   .tooltip = row.tooltip,
                                                   .changed = row.changed,
                                                   .at_default = text.empty(),
                                                   .width = row.width});
    const bool emptied = action == LabelAction::Reset && !text.empty();
    if (emptied) text.clear();
    return text_field(context, row.name, text, row.tooltip, {.hint = row.hint}) || emptied;
}

bool number_row(PanelContext& context, const NumberRow& row, float& value) {
    const LabelAction action = row_label(context, {.name = row.name,
                                                   .text = row.label,
                                                   .tooltip = row.tooltip,
                                                   .changed = value != row.saved,
                                                   .at_default = value == row.reset});
    const bool changed = apply_label(action, row.reset, row.saved, value);
    return number_value(context, row, value) || changed;
}

bool color_value(PanelContext& context, const ColorRow& row, glm::vec3& value, float width) {
    ImGui::PushID(row.name.data(), row.name.data() + row.name.size());
    const float code = px(80), gap = px(6);
    const float full = width > 0.0f ? width : ImGui::GetContentRegionAvail().x;
    bool changed = swatch(context, row, value, std::max(px(24), full - code - gap));
    ImGui::SameLine(0.0f, gap);
    changed |= code_field(context, row, value, code);
    ImGui::PopID();
    return changed;
}

bool color_row(PanelContext& context, const ColorRow& row, glm::vec3& value) {
    const LabelAction action = row_label(context, {.name = row.name,
                                                   .text = row.label,
                                                   .tooltip = row.tooltip,
                                                   .changed = value != row.saved,
                                                   .at_default = value == row.reset});
    const bool changed = apply_label(action, row.reset, row.saved, value);
    return color_value(context, row, value) || changed;
}

std::array<char, 8> color_code(const glm::vec3& linear) {
    const auto byte = [](float v) {
        return static_cast<unsigned>(std::lround(255.0f * std::clamp(linear_to_srgb(v), 0.0f, 1.0f)));
    };
    std::array<char, 8> code{};
    std::snprintf(code.data(), code.size(), "#%02X%02X%02X", byte(linear.x) & 255u, byte(linear.y) & 255u,
                  byte(linear.z) & 255u);
    return code;
}

std::optional<glm::vec3> color_of_code(std::string_view code) {
    if (!code.empty() && code.front() == '#') code.remove_prefix(1);
    if (code.size() != 6) return std::nullopt;
    glm::vec3 linear{0.0f};
    for (int c = 0; c < 3; ++c) {
        int byte = 0;
        for (const char digit : code.substr(2 * static_cast<std::size_t>(c), 2)) {
            const bool number = digit >= '0' && digit <= '9';
            const char letter = static_cast<char>(digit & ~0x20);
            if (!number && (letter < 'A' || letter > 'F')) return std::nullopt;
            byte = 16 * byte + (number ? digit - '0' : letter - 'A' + 10);
        }
        linear[c] = srgb_to_linear(static_cast<float>(byte) / 255.0f);
    }
    return linear;
}

}  // namespace patina::ui
