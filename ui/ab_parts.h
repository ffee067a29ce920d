// What showing two pictures in one view is made of, wherever they come from: parts of pictures beside a line
// that can be dragged, blinking, and ramps that explain maps of differences.
#pragma once

#include "ui/panel_context.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <functional>
#include <string>
#include <string_view>

namespace patina::ui {

/// The picture between two fractions of the view's width, over that part of rect.
void draw_part(const Viewport::Picture& picture, const Rect& rect, glm::vec2 part);

/// The line at that fraction of the width with its grip, recorded as name, and what is on its sides.
struct SplitLine {
    std::string_view name;
    float at = 0.5f;
    std::string left, right;
};
void draw_split_line(PanelContext& context, const SplitLine& line, const Rect& rect);
/// After the view's item: true while the mouse holds the line, which then follows it.
bool drag_split_line(const Rect& rect, bool& held, float& at);

/// Which of two pictures that take turns is to be seen now: they change twice a second.
bool blinks_to_second(PanelContext& context);

/// A chip with a ramp of colours between two texts, its lower left corner at (x0, y1); recorded as name.
struct RampLegend {
    std::string_view name;
    std::string begin, end;
    std::function<glm::vec3(float t)> color;  ///< sRGB code values 0…1 at 0…1
};
void draw_ramp_legend(PanelContext& context, const RampLegend& legend, float x0, float y1);
/// From darker to brighter; sRGB code values at 0…1.
glm::vec3 diverging_color(float t);
/// The ramps of a map of differences.
RampLegend legend_of(DifferenceKind kind);

/// "A 0.412 0.398 0.377 = 168 165 161": linear radiance, and display values in 0…255.
std::string value_text(std::string_view side, const PixelValue& value);

}  // namespace patina::ui
