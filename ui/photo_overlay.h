// A photo on a view of the sheet: laid over it, pointed into, fitted by four points. Edits the photo in
// place.
#pragma once

#include "ui/panel_context.h"

namespace patina::ui {

/// The tool in hand on the selected view's photo, before the view's own button: true if it uses the mouse
/// here. view_hovered and view_held come from that button in the frame before.
void use_photo_tool(PanelContext& context, int view, const Rect& rect);
/// Overlay, wipe, difference, or the whole photo with its points; over the view's picture.
void draw_photo(PanelContext& context, int view, const Rect& rect);
/// A tool other than none is in hand for this view: the mouse is not the camera's.
bool photo_tool_active(const PanelContext& context, int view);
/// The mouse on the view's own button while a tool is in hand.
void handle_photo_mouse(PanelContext& context, int view, const Rect& rect);

/// The inspector's rows for the selected view's photo.
void draw_photo_rows(PanelContext& context, int view);

}  // namespace patina::ui
