// The parts of the window, one file each; workspace.cpp puts them together.
#pragma once

#include "ui/panel_context.h"

namespace patina::ui {

// Library.
void draw_presets_panel(PanelContext& context);
void draw_environments_panel(PanelContext& context);
void draw_meshes_panel(PanelContext& context);
// Inspector.
void draw_material_panel(PanelContext& context);
void draw_light_panel(PanelContext& context);
void draw_view_panel(PanelContext& context);
void draw_sheet_panel(PanelContext& context);
void draw_maps_panel(PanelContext& context);
// Drawer.
void draw_log_panel(PanelContext& context);
void draw_work_panel(PanelContext& context);
void draw_accuracy_panel(PanelContext& context);

// The viewport's part of the accuracy meter (panel_accuracy.cpp).
/// The display picture or what the settings ask for instead of it, on both sides of the split.
void draw_layers(PanelContext& context, const Rect& rect);
/// The split's line with its grip, the maps' legends.
void draw_layer_marks(PanelContext& context, const Rect& rect);
/// True while the mouse holds the split's line, which then follows it: nothing else may take the drag.
bool drag_split(PanelContext& context, const Rect& rect);

// Frame of the window.
float menu_height();
void draw_menu(PanelContext& context);
float toolbar_height(float width);
void draw_toolbar(PanelContext& context, const Rect& rect);
void draw_viewport(PanelContext& context, const Rect& rect);
/// The views side by side, in the viewport's place. Precondition: context.sheet.
void draw_sheet(PanelContext& context, const Rect& rect);
float status_line_height();
void draw_status_line(PanelContext& context, const Rect& rect);
void draw_file_browser(PanelContext& context, const Rect& rect);

// Questions over everything; Escape and Enter answer them.
void draw_import_sheet(PanelContext& context);
void draw_unsaved_question(PanelContext& context);
void draw_recovery_question(PanelContext& context);

}  // namespace patina::ui
