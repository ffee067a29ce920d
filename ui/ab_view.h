// Two views of the sheet, or a view and its photo, in the place of the enlarged one.
#pragma once

#include "ui/panel_context.h"

namespace patina::ui {

/// Whether that view is enlarged and held against another picture that is there.
bool ab_shown(const PanelContext& context, int view);
/// Over the view's own picture.
void draw_ab(PanelContext& context, int view, const Rect& rect);
/// After the view's item: true while its line is dragged.
bool drag_ab(PanelContext& context, const Rect& rect);
/// In the bar: what it is held against, and how.
void draw_ab_choice(PanelContext& context);
/// What lies under the mouse, and which picture it is of; call with the view's item the last one.
void probe_view(PanelContext& context, int view, const Rect& rect);
void draw_probe(PanelContext& context, const Rect& rect);

}  // namespace patina::ui
