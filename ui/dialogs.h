// What the questions share: a centred sheet over a dimmed window, answered by buttons or keys.
#pragma once

#include "ui/panel_context.h"

#include <string_view>

namespace patina::ui {

/// width: display units, at most the window's. end_question when it returned true.
bool begin_question(PanelContext& context, const char* id, std::string_view title, float width);
void end_question();

/// Was Enter (but not to end typing) or Escape pressed?
bool enter_pressed();
bool escape_pressed(const PanelContext& context);

/// Escape closes an open list, menu or colour picker before anything else hears of it.
void close_list_on_escape(PanelContext& context);

/// Moves the cursor so that width display units end at the right edge.
void align_right(float width);

}  // namespace patina::ui
