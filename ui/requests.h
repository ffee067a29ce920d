// What the artist asks for, as a plain list of values. Panels append; the app carries out and clears. Knows
// no ImGui.
//
// Paths are UTF-8 text with forward slashes. Values that are edited in place (material, view, camera, mesh
// and environment id) are no requests: the app sees them change by comparing documents.
#pragma once

#include "materials/material.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace patina::ui {

namespace request {

// The document. New, Open and Quit may find unsaved changes: the app then sets PanelContext::unsaved and
// waits for Answer.
struct New {};
struct Open {
    std::string file;  ///< a preset
};
struct Save {};  ///< to the document's file; without one the app opens the browser for SaveAs
struct SaveAs {
    std::string file;
};
struct Revert {};  ///< back to what the file holds; undoable
struct Undo {};
struct Redo {};
struct Quit {};
enum class Choice { Save, Discard, Cancel };
struct AnswerUnsaved {
    Choice choice = Choice::Cancel;
};
enum class Recovery { Recover, Discard, Later };
struct AnswerRecovery {
    Recovery recovery = Recovery::Later;  ///< Later: kept, and asked for again at the next start
};
struct ClearRecent {};

// Maps.
struct AssignMap {  ///< put this file into this slot, as it is
    MapSlot slot = MapSlot::Albedo;
    std::string file;
};
struct ClearMap {
    MapSlot slot = MapSlot::Albedo;
};
struct ReloadMap {  ///< read it again from disk
    MapSlot slot = MapSlot::Albedo;
};
struct LocateMap {  ///< the missing file is here; other missing maps may lie beside it
    MapSlot slot = MapSlot::Albedo;
    std::string file;
};
struct Reveal {  ///< show it in the system's file manager
    std::string path;
};
/// Files or folders dropped on the window; slot: the slot under the mouse, if any. The app tells presets,
/// maps, folders, meshes and environments apart and may open the import sheet.
struct Dropped {
    std::vector<std::string> files;
    std::optional<MapSlot> slot;
    std::optional<int> view;  ///< of the sheet, under the mouse: a single picture becomes its photo
};
struct ImportMaps {  ///< propose an assignment for this folder or these files
    std::vector<std::string> files;
};
struct ApplyImport {};  ///< take PanelContext::import_sheet as it now stands, then reset it
struct CancelImport {};

// Light and shape from files; ids of the catalog are set directly in the context.
struct LoadEnvironment {
    std::string file;
};
struct LoadMesh {
    std::string file;
};

// Pictures, work, files.
/// The view as set; or, in the size of the viewport, the reference as it has gathered and what the shading
/// misses of it.
enum class ExportWhat { Picture, Reference, Error, Flip };
struct ExportRender {
    std::string file;  ///< .png: display picture, .exr: scene-linear radiance
    int width = 0;     ///< of ExportWhat::Picture
    int height = 0;
    ExportWhat what = ExportWhat::Picture;
};
// Views side by side.
struct ShowSheet {
    bool shown = true;  ///< without a sheet of before, one of two lights is made
};
enum class SheetChange { AddLight, AddPreset, Duplicate, Remove, ShowEdited, RemovePhoto };
struct ChangeSheet {
    SheetChange change = SheetChange::AddLight;
    int view = 0;  ///< at which
};
struct OpenSheet {
    std::string file;
};
struct SaveSheet {};  ///< to its file; without one the app opens the browser
struct SaveSheetAs {
    std::string file;
};
struct SetPhoto {  ///< of the selected view's light
    std::string file;
};
struct PickCard {  ///< a card's colour sets exposure and white balance of that view's photo
    int view = 0;
    glm::vec2 point{0.0f};  ///< fraction of the photo
    bool white = false;     ///< white paper instead of an 18 % grey card
};
struct SetMapPhoto {  ///< that maps are made from
    std::string file;
};
struct MapPhotoOfView {};  ///< the photo of the sheet's selected view, with its points and balance
struct PickMapCard {
    glm::vec2 point{0.0f};  ///< fraction of the photo
};
struct MakeMaps {};  ///< as UiState::maps says, beside the preset
struct ExportReport {
    std::string file;  ///< .html or .pdf
};
struct CancelJob {
    std::uint64_t id = 0;
};
struct ClearLog {};
struct ClearWork {};  ///< the work ledger counts from here
struct CopyText {     ///< to the clipboard
    std::string text;
};
/// Open PanelContext::browser's folder, or another one; the app fills browser.folder, entries and error.
struct ListFolder {
    std::string folder;  ///< empty: where the app thinks best for browser.purpose
};
struct MakeFolder {
    std::string folder;
};

}  // namespace request

using Request =
    std::variant<request::New, request::Open, request::Save, request::SaveAs, request::Revert, request::Undo,
                 request::Redo, request::Quit, request::AnswerUnsaved, request::AnswerRecovery,
                 request::ClearRecent, request::AssignMap, request::ClearMap, request::ReloadMap,
                 request::LocateMap, request::Reveal, request::Dropped, request::ImportMaps,
                 request::ApplyImport, request::CancelImport, request::LoadEnvironment, request::LoadMesh,
                 request::ExportRender, request::ShowSheet, request::ChangeSheet, request::OpenSheet,
                 request::SaveSheet, request::SaveSheetAs, request::SetPhoto, request::PickCard,
                 request::SetMapPhoto, request::MapPhotoOfView, request::PickMapCard, request::MakeMaps,
                 request::ExportReport, request::CancelJob, request::ClearLog, request::ClearWork,
                 request::CopyText, request::ListFolder, request::MakeFolder>;
using Requests = std::vector<Request>;

/// The first request of type T, or nullptr.
template <class T>
const T* find_request(const Requests& requests) {
    for (const Request& request : requests)
        if (const T* found = std::get_if<T>(&request)) return found;
    return nullptr;
}

}  // namespace patina::ui
