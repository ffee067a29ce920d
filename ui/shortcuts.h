// The one table of what the keyboard does: it drives the menus, the handling and the `?` sheet.
#pragma once

#include "ui/panel_context.h"

#include <array>
#include <string>
#include <string_view>

namespace patina::ui {

// clang-format off
enum class Action {
    New, Open, OpenEnvironment, OpenMesh, ImportMaps, Save, SaveAs, Revert, ExportRender, Quit,
    Undo, Redo,
    Frame, Home, OrbitLeft, OrbitRight, OrbitUp, OrbitDown, ZoomIn, ZoomOut, LightLeft, LightRight,
    ExposureUp, ExposureDown, NextEnvironment, PreviousEnvironment, NextMesh, NextTonemap, NextBackground, NextShading,
    Debug1, Debug2, Debug3, Debug4, Debug5, Debug6, Debug7, Debug8, Debug9, Debug10,
    ToggleLibrary, ToggleInspector, ToggleLog, Search, Shortcuts, About, CloseSheet,
    Compare, OpenComparison, SaveComparison, SaveComparisonAs, ExportReport
};

/// io.KeysDown's indices, which are GLFW's: letters and digits are their upper-case ASCII, the others as here.
enum Key : int {
    KeyNone = 0,
    KeyComma = 44, KeyMinus = 45, KeyPeriod = 46, KeyEqual = 61, KeyL = 76, KeyLeftBracket = 91, KeyRightBracket = 93,
    KeyEscape = 256, KeyEnter = 257, KeyTab = 258, KeyBackspace = 259, KeyDelete = 261,
    KeyRight = 262, KeyLeft = 263, KeyDown = 264, KeyUp = 265, KeyPageUp = 266, KeyPageDown = 267, KeyHome = 268,
    KeyEnd = 269, KeyF1 = 290, KeyPadSubtract = 333, KeyPadAdd = 334, KeyPadEnter = 335
};
enum Modifiers : int { ModNone = 0, ModCommand = 1, ModShift = 2 };   ///< Command: Ctrl, or Cmd on a Mac
// clang-format on

enum class Menu { None, File, Edit, View, Compare, Help };

struct Shortcut {
    Action action;
    int key;  ///< KeyNone: only in the menu
    int modifiers;
    Menu menu;                     ///< None: a second key of an action, or one without a menu line
    std::string_view title;        ///< as in the menu
    std::string_view description;  ///< one sentence
    bool repeats = false;          ///< while the key is held
};

// clang-format off
inline constexpr std::array kShortcuts{
    Shortcut{Action::New, 'N', ModCommand, Menu::File, "New", "Start from the default material."},
    Shortcut{Action::Open, 'O', ModCommand, Menu::File, "Open preset…", "Open a preset file."},
    Shortcut{Action::ImportMaps, 'I', ModCommand, Menu::File, "Import maps…", "Take the maps of a folder: each file is matched to its slot by its name."},
    Shortcut{Action::OpenEnvironment, KeyNone, ModNone, Menu::File, "Open environment…", "Light the object with an .hdr or .exr panorama."},
    Shortcut{Action::OpenMesh, KeyNone, ModNone, Menu::File, "Open mesh…", "Show the material on an OBJ, PLY, OFF or STL file."},
    Shortcut{Action::Save, 'S', ModCommand, Menu::File, "Save", "Write the preset to its file."},
    Shortcut{Action::SaveAs, 'S', ModCommand | ModShift, Menu::File, "Save as…", "Write the preset to another file."},
    Shortcut{Action::Revert, KeyNone, ModNone, Menu::File, "Revert to saved", "Go back to what the file holds; can be undone."},
    Shortcut{Action::ExportRender, 'E', ModCommand, Menu::File, "Export picture…", "Render what the viewport shows to a PNG or EXR file."},
    Shortcut{Action::Quit, 'Q', ModCommand, Menu::File, "Quit", "Leave Patina; unsaved changes are asked about."},
    Shortcut{Action::Undo, 'Z', ModCommand, Menu::Edit, "Undo", "Take the last change back; a whole drag is one change."},
    Shortcut{Action::Redo, 'Z', ModCommand | ModShift, Menu::Edit, "Redo", "Do again what was taken back."},
    Shortcut{Action::Redo, 'Y', ModCommand, Menu::None, "Redo", "Do again what was taken back."},
    Shortcut{Action::Search, 'F', ModCommand, Menu::Edit, "Search the library", "Type into the library's search field."},
    Shortcut{Action::Frame, 'F', ModNone, Menu::View, "Frame the object", "Centre the object at its usual distance, from the same side."},
    Shortcut{Action::Home, KeyHome, ModNone, Menu::View, "Reset the view", "Back to the first view, as a double-click on the viewport does."},
    Shortcut{Action::OrbitLeft, KeyLeft, ModNone, Menu::None, "Orbit left", "Turn the object to the left.", true},
    Shortcut{Action::OrbitRight, KeyRight, ModNone, Menu::None, "Orbit right", "Turn the object to the right.", true},
    Shortcut{Action::OrbitUp, KeyUp, ModNone, Menu::None, "Orbit up", "Look from further above.", true},
    Shortcut{Action::OrbitDown, KeyDown, ModNone, Menu::None, "Orbit down", "Look from further below.", true},
    Shortcut{Action::ZoomIn, KeyEqual, ModNone, Menu::None, "Zoom in", "Move closer.", true},
    Shortcut{Action::ZoomIn, KeyPadAdd, ModNone, Menu::None, "Zoom in", "Move closer.", true},
    Shortcut{Action::ZoomOut, KeyMinus, ModNone, Menu::None, "Zoom out", "Move away.", true},
    Shortcut{Action::ZoomOut, KeyPadSubtract, ModNone, Menu::None, "Zoom out", "Move away.", true},
    Shortcut{Action::LightLeft, KeyLeft, ModShift, Menu::None, "Light to the left", "Turn the environment 5° so that highlights go left.", true},
    Shortcut{Action::LightRight, KeyRight, ModShift, Menu::None, "Light to the right", "Turn the environment 5° so that highlights go right.", true},
    Shortcut{Action::ExposureUp, KeyPeriod, ModNone, Menu::None, "Brighter", "Raise the exposure by a quarter stop.", true},
    Shortcut{Action::ExposureDown, KeyComma, ModNone, Menu::None, "Darker", "Lower the exposure by a quarter stop.", true},
    Shortcut{Action::NextEnvironment, KeyPageDown, ModNone, Menu::View, "Next environment", "Light the object with the next environment of the library."},
    Shortcut{Action::PreviousEnvironment, KeyPageUp, ModNone, Menu::View, "Previous environment", "Light the object with the one before."},
    Shortcut{Action::NextMesh, 'M', ModNone, Menu::View, "Next mesh", "Show the material on the next mesh of the library."},
    Shortcut{Action::NextShading, 'S', ModNone, Menu::View, "Next shading mode", "Compare the lecture's formulas with the full model."},
    Shortcut{Action::NextTonemap, 'T', ModNone, Menu::View, "Next tone mapping", "Go through none, neutral and ACES."},
    Shortcut{Action::NextBackground, 'B', ModNone, Menu::View, "Next background", "Go through environment, blurred and plain grey."},
    Shortcut{Action::Debug1, '1', ModNone, Menu::None, "Final picture", "Show the shaded picture."},
    Shortcut{Action::Debug2, '2', ModNone, Menu::None, "Albedo", "Show only the base colour."},
    Shortcut{Action::Debug3, '3', ModNone, Menu::None, "Roughness", "Show only the roughness."},
    Shortcut{Action::Debug4, '4', ModNone, Menu::None, "Metallic", "Show only what is metal."},
    Shortcut{Action::Debug5, '5', ModNone, Menu::None, "Ambient occlusion", "Show only the ambient occlusion."},
    Shortcut{Action::Debug6, '6', ModNone, Menu::None, "Normal map", "Show the normal map as stored."},
    Shortcut{Action::Debug7, '7', ModNone, Menu::None, "Normal", "Show the normals that are shaded."},
    Shortcut{Action::Debug8, '8', ModNone, Menu::None, "Tangent", "Show the tangents."},
    Shortcut{Action::Debug9, '9', ModNone, Menu::None, "UV", "Show the texture coordinates."},
    Shortcut{Action::Debug10, '0', ModNone, Menu::None, "UV checker", "Show a checkerboard."},
    Shortcut{Action::ToggleLibrary, '1', ModCommand, Menu::View, "Library", "Show or hide the library on the left."},
    Shortcut{Action::ToggleInspector, '2', ModCommand, Menu::View, "Inspector", "Show or hide the inspector on the right."},
    Shortcut{Action::ToggleLog, 'L', ModCommand, Menu::View, "Log", "Show or hide what the program has said."},
    Shortcut{Action::Compare, 'C', ModNone, Menu::Compare, "Side by side", "Show several presets and lightings at once, or go back to the one view."},
    Shortcut{Action::OpenComparison, KeyNone, ModNone, Menu::Compare, "Open comparison…", "Open a sheet of views from its file."},
    Shortcut{Action::SaveComparison, KeyNone, ModNone, Menu::Compare, "Save comparison", "Write the sheet of views to its file."},
    Shortcut{Action::SaveComparisonAs, KeyNone, ModNone, Menu::Compare, "Save comparison as…", "Write the sheet of views to another file."},
    Shortcut{Action::ExportReport, KeyNone, ModNone, Menu::Compare, "Export report…", "Write the sheet with its values and photos as a web page or PDF document."},
    Shortcut{Action::Shortcuts, KeyF1, ModNone, Menu::Help, "Keyboard shortcuts", "Show this list; ? does it as well."},
    Shortcut{Action::About, KeyNone, ModNone, Menu::Help, "About Patina", "Version, graphics driver and licence."},
    Shortcut{Action::CloseSheet, KeyEscape, ModNone, Menu::None, "Close", "Close the list, file browser or drawer that is open."},
};
// clang-format on

/// "Ctrl+Shift+S", "F1", "+"; empty for KeyNone.
std::string key_text(const Shortcut& shortcut, bool mac);

/// Carries an action out: edits, or a request. Its menu line is disabled when can_act is false.
void act(PanelContext& context, Action action);
bool can_act(const PanelContext& context, Action action);

/// Acts on the keys pressed in this frame. Keys that type text into a field, and all keys while a question is
/// open, are left alone.
void handle_shortcuts(PanelContext& context);

/// The `?` sheet and the about box.
void draw_shortcut_sheet(PanelContext& context);
void draw_about(PanelContext& context);

}  // namespace patina::ui
