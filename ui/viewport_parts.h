// What the viewport and the sheet of views have in common.
#pragma once

#include "ui/panel_context.h"

#include <imgui.h>

#include <string>

namespace patina::ui {

/// Orbit, pan, zoom and turn the light with the mouse on the last item, which shows the view in rect.
void handle_view_mouse(PanelContext& context, const Rect& rect);

/// A dark label on a picture, at most max_width display units wide (0: as wide as it gets). False: something
/// of the text is not seen.
bool draw_chip(const ImVec2& at, const std::string& text, float max_width = 0.0f);

}  // namespace patina::ui
