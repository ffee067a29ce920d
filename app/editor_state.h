// The editor as one struct and the verbs that change it. Knows the renderer through reconcile, but no window:
// what only a window can do is left in fields for the loop to carry out.
#pragma once

#include "app/autosave.h"
#include "app/document.h"
#include "app/editor_ab.h"
#include "app/editor_maps.h"
#include "app/editor_photo.h"
#include "app/editor_sheet.h"
#include "app/jobs.h"
#include "app/reconcile.h"
#include "app/registry.h"
#include "app/settings.h"
#include "app/thumbnails.h"
#include "app/undo.h"
#include "app/watch.h"
#include "renderer/renderer.h"
#include "ui/panel_context.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace patina {

struct AccuracyPictures;

/// What a preset in the library shows before it is opened.
struct PresetEntry {
    std::filesystem::path file;
    std::string title, description, group;
};

struct Editor {
    Editor(const Registry& registry, Renderer& renderer, Jobs& jobs, Settings settings,
           bool skip = true);  ///< skip: as in SceneOptions

    const Registry& registry;
    Renderer& renderer;
    Jobs& jobs;
    Settings settings;

    Document document;
    Camera camera;
    DocumentFile file;
    View saved_view;  ///< as the document was opened with
    History history;
    std::uint64_t opened = 0;  ///< documents so far
    Reconciler reconciler;
    Thumbnails thumbnails;
    EditorSheet sheet;
    EditorPhotos photos;
    EditorMaps maps;
    EditorAb ab;
    ui::ProbeValues probe;  ///< what is under the mouse

    std::function<std::shared_ptr<const AccuracyPictures>()>
        accuracy_pictures;  ///< set by who owns the meter

    // The interface's side.
    ui::UiState ui;
    ui::FileBrowser browser;
    std::optional<ui::ImportSheet> import_sheet;
    ui::Catalog catalog;
    ui::Status status;
    std::optional<std::vector<PresetEntry>> presets;  ///< none before they are read
    std::uint64_t changes =
        0;  ///< grows with everything that the interface shows and that came from no input

    // Questions, and what waits for the answer.
    std::optional<ui::UnsavedQuestion> unsaved;
    std::optional<ui::Request> waiting;  ///< New, Open, OpenSheet or Quit
    std::string waiting_action;          ///< that in words
    std::optional<ui::RecoveryQuestion> recovery_question;
    std::optional<RecoveryFiles::Orphan> orphan;

    RecoveryFiles recovery;
    AutosaveClock autosave;
    Document autosave_seen;              ///< the document when it was last looked at
    std::optional<std::string> kept;     ///< what the recovery file holds; empty: there is none
    std::optional<std::string> to_keep;  ///< what it should hold
    Jobs::Id autosave_job = 0;

    Watch watch;
    Jobs::Id watch_job = 0;
    double next_watch_s = 0.0;

    // For the loop.
    bool quit = false;
    std::optional<std::string> clipboard;
};

// editor_log.cpp
void log_line(Editor& editor, ui::Severity severity, const std::string& sentence);
/// Says it in the status line only.
void say_status(Editor& editor, const std::string& sentence);

// editor_files.cpp: new, open, save, and the question before work is lost
void ask_new(Editor& editor);
void ask_open(Editor& editor, const std::string& file);
void ask_open_sheet(Editor& editor, const std::string& file);
void ask_quit(Editor& editor);
/// After a save that something waits for.
void carry_on(Editor& editor);
void answer_unsaved(Editor& editor, ui::request::Choice choice);
/// False if it failed; the document is then as it was and the log says why.
bool open_file(Editor& editor, const std::filesystem::path& file);
bool save_file(Editor& editor, const std::filesystem::path& file);
void save(Editor& editor);
void revert(Editor& editor);
/// The browser was closed without a name while something waited for the save: nothing waits any more.
void drop_stale_wait(Editor& editor);
/// The preset itself changed on disk.
void reread_preset(Editor& editor);

// editor_keep.cpp: autosave, recovery, watching files
void offer_recovery(Editor& editor);
void answer_recovery(Editor& editor, ui::request::Recovery answer);
bool has_unsaved_work(const Editor& editor);
void keep_work(Editor& editor, double now_s);
/// Without waiting for a quiet moment: the program is about to end badly. False if it could not be kept.
bool keep_now(Editor& editor);
void watch_files(Editor& editor, double now_s);
/// Seconds until one of them wants the loop again.
double next_errand_s(const Editor& editor, double now_s);

// editor_import.cpp: what files on the window mean
void take_dropped(Editor& editor, const ui::request::Dropped& dropped);
void propose_maps(Editor& editor, const std::vector<std::string>& files);
void apply_import_sheet(Editor& editor);
void assign_map(Editor& editor, MapSlot slot, const std::string& file);
/// This map is here now; other missing maps of the same old folder may be beside it.
void locate_map(Editor& editor, MapSlot slot, const std::string& file);
void use_environment(Editor& editor, const std::string& file);
void use_mesh(Editor& editor, const std::string& file);

// editor_catalog.cpp: what there is to choose from
void read_presets(Editor& editor);
void fill_catalog(Editor& editor);

// editor_browse.cpp: the file browser's listing, and pictures to disk
void list_folder(Editor& editor, const std::string& folder);
void make_folder(Editor& editor, const std::string& folder);
void open_browser(Editor& editor, ui::BrowserPurpose purpose);
void export_picture(Editor& editor, const ui::request::ExportRender& request);

// editor_requests.cpp
void carry_out(Editor& editor, const ui::Requests& requests);
/// Once a frame after the panels: undo steps, what failed and falls back.
void settle(Editor& editor, bool item_held);

}  // namespace patina
