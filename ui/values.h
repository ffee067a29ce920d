// Rows that show and edit one value: label, bar, number; or label, colour swatch, code. A dot marks what
// differs from the saved value, a double-click resets to the default, the right button offers both.
#pragma once

#include "ui/panel_context.h"

#include <glm/vec3.hpp>

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace patina::ui {

/// The label column of a row: text with its changed mark; a double-click on it, or the menu of the right
/// button, returns what to do. Leaves the cursor where the value goes.
enum class LabelAction { None, Reset, Revert };
struct RowLabel {
    std::string_view name;
    std::string_view text;
    std::string_view tooltip;
    bool changed = false;
    bool at_default = true;
    float width = 0.0f;  ///< display units; 0: label_width()
};
LabelAction row_label(PanelContext& context, const RowLabel& label);
float label_width();

struct NumberRow {
    std::string_view name;  ///< recorded: "<name>.label", "<name>.bar", "<name>.number"
    std::string_view label;
    std::string_view tooltip;
    float min = 0.0f, max = 1.0f;  ///< ends of the bar
    float hard_min = 0.0f;         ///< limits of what may be typed
    float hard_max = 1.0f;
    float reset = 0.0f;
    float saved = 0.0f;
    const char* format = "%.3f";
    float step = 0.001f;         ///< dragging rounds to it
    bool logarithmic = false;    ///< min > 0
    float number_width = 62.0f;  ///< of the typed number, at scale 1
    bool wraps = false;          ///< past max goes on at min: angles
};
/// Returns whether value was changed in this frame. value is only written when edited.
bool number_row(PanelContext& context, const NumberRow& row, float& value);

struct TextRow {
    std::string_view name;  ///< recorded: "<name>.label", and the field by the name itself
    std::string_view label;
    std::string_view tooltip;
    const char* hint = "";  ///< what stands there while it is empty
    bool changed = false;
    float width = 0.0f;  ///< of the label, display units; 0: label_width()
};
/// Returns whether text was changed in this frame; resetting empties it.
bool text_row(PanelContext& context, const TextRow& row, std::string& text);

/// The bar alone, width display units wide; and bar and number on what is left of the line, without a label.
bool number_bar(PanelContext& context, const NumberRow& row, float& value, float width);
bool number_value(PanelContext& context, const NumberRow& row, float& value, float width = 0.0f);
/// What a label's menu asked for.
template <class T>
bool apply_label(LabelAction action, const T& reset, const T& saved, T& value) {
    if (action == LabelAction::None) return false;
    const T& next = action == LabelAction::Reset ? reset : saved;
    if (value == next) return false;
    value = next;
    return true;
}

struct ColorRow {
    std::string_view name;  ///< recorded: "<name>.label", "<name>.swatch", "<name>.code"
    std::string_view label;
    std::string_view tooltip;
    glm::vec3 reset{1.0f};
    glm::vec3 saved{1.0f};
    bool faded = false;  ///< the colour has no effect at present
};
/// value is scene-linear; shown and edited sRGB-encoded. Channels that were not edited keep their exact
/// value.
bool color_row(PanelContext& context, const ColorRow& row, glm::vec3& value);
/// Swatch and code on what is left of the line, without a label.
bool color_value(PanelContext& context, const ColorRow& row, glm::vec3& value, float width = 0.0f);

/// "#C8A45C" of a scene-linear colour, and back (nullopt: not a colour).
std::array<char, 8> color_code(const glm::vec3& linear);
std::optional<glm::vec3> color_of_code(std::string_view code);

}  // namespace patina::ui
