// The window's whole content, and how it looks. Between ImGui::NewFrame and ImGui::Render.
#pragma once

#include "ui/panel_context.h"

#include <vector>

struct ImFontAtlas;

namespace patina::ui {

/// The panels that ship: presets, environments, meshes · material, light, view · log.
std::vector<Panel> builtin_panels();

/// Lays out menu bar, library, viewport with its toolbar, inspector, status line, drawer, sheets and
/// questions, and handles the keyboard shortcuts. io.KeysDown is expected to be indexed by GLFW's key codes.
void draw_workspace(PanelContext& context);

/// Opens the file browser for a purpose and asks for its folder.
void open_browser(PanelContext& context, BrowserPurpose purpose, MapSlot slot = MapSlot::Albedo);

/// Draws the fonts' characters unless they are there in this size, in pixels of the screen per one at 96 dpi.
/// Needs no ImGui context.
void build_fonts(ImFontAtlas& atlas, float scale);

/// Sets style and fonts of the current ImGui context; the font texture has to be uploaded again afterwards.
/// scale: of the interface (1 = 96 dpi). framebuffer_scale: pixels a display unit (2 on a Retina Mac, else
/// 1).
void apply_theme(float scale, float framebuffer_scale = 1.0f);

}  // namespace patina::ui
