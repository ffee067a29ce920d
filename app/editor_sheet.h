// Views side by side in the editor: what they need, what the panels see of them, and their file. The
// comparison itself is part of the document, so that it can be undone.
#pragma once

#include "app/editor_report.h"
#include "app/reconcile.h"
#include "renderer/core/comparison.h"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace patina {

struct Editor;

/// A preset that a row shows, read from its file once.
struct SheetPreset {
    Material material;  ///< maps by full path
    std::string error;  ///< one sentence; the material is then the default one
};

/// Where a sheet lives.
struct SheetFile {
    std::filesystem::path path;       ///< empty: never saved
    std::optional<Comparison> saved;  ///< what it holds, or what the sheet began as; none: not known
};

struct EditorSheet {
    std::map<int, SheetFile> files;      ///< by Document::sheet_opened: undo may bring an earlier one back
    std::optional<Comparison> put_away;  ///< while the one view is shown
    std::map<std::string, SheetPreset> presets;
    std::shared_ptr<ReportWork> report;  ///< being drawn
};

/// What the panels edit in place: the document's own values, or those of the sheet's selected view.
struct ViewBinding {
    int selected = -1;  ///< view of the sheet; −1: the document's own
    View view;
    Camera camera;
    std::string environment, mesh;
};
ViewBinding bind_view(const Editor& editor);
/// Takes over what changed since bind_view. all_lights: a turn of the light is every view's.
void take_binding(Editor& editor, const ViewBinding& before, const ViewBinding& after, bool all_lights);

/// Of the sheet's views, as many as are shown; empty without a sheet. Reads presets that are new.
std::vector<WantedPicture> wanted_pictures(Editor& editor);
/// How that view is looked at; and from where, before it is fitted to the view's shape.
const Camera& camera_of_sheet(const Editor& editor, std::size_t view);
View view_of_sheet(const Editor& editor, std::size_t view);

/// Of the document's sheet.
const SheetFile& sheet_file(const Editor& editor);
void show_sheet(Editor& editor, bool shown);
/// What was shown before is left to undo.
void open_sheet(Editor& editor, const std::string& file);
void save_sheet(Editor& editor);
bool save_sheet_as(Editor& editor, const std::string& file);
/// False: no sheet is shown, or its selected view shows the edited material.
bool set_sheet_preset(Editor& editor, const std::string& file);
void set_light(Editor& editor, const std::string& environment);
void set_mesh(Editor& editor, const std::string& mesh);
/// That is shown or put away.
const std::optional<Comparison>& current_sheet(const Editor& editor);
/// Something of it would be lost; a new sheet that nobody has changed is not.
bool sheet_unsaved(const Editor& editor);
/// Its title, or its file's name.
std::string sheet_name(const Editor& editor);
/// A sheet that a crash left unsaved.
void restore_sheet(Editor& editor, Comparison comparison, const std::filesystem::path& file);

}  // namespace patina
