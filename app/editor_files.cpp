#include "app/comparison_file.h"
#include "app/editor_state.h"
#include "app/paths.h"
#include "app/reconcile_load.h"
#include "materials/material_io.h"
#include "materials/text_io.h"

#include <exception>

namespace patina {

namespace fs = std::filesystem;

namespace {

void start_document(Editor& editor, DocumentFile file) {
    editor.document.material = file.saved;
    editor.file = std::move(file);
    editor.saved_view = {};
    editor.history.reset(editor.document);
    editor.import_sheet.reset();
    ++editor.opened;
    ++editor.changes;
}

void carry_out_waiting(Editor& editor) {
    const std::optional<ui::Request> request = std::exchange(editor.waiting, std::nullopt);
    editor.unsaved.reset();
    ++editor.changes;
    if (!request) return;
    if (std::holds_alternative<ui::request::New>(*request)) {
        start_document(editor, {});
        say_status(editor, "A new material.");
    } else if (const auto* sheet = std::get_if<ui::request::OpenSheet>(&*request)) {
        open_sheet(editor, sheet->file);
    } else if (const auto* open = std::get_if<ui::request::Open>(&*request)) {
        open_file(editor, utf8_to_path(open->file));
    } else if (std::holds_alternative<ui::request::Quit>(*request)) {
        editor.quit = true;
    }
}

/// What the request would lose, from `first` on, that nobody has answered for yet.
std::optional<ui::Unsaved> next_loss(const Editor& editor, ui::Unsaved first) {
    const bool comparison = std::holds_alternative<ui::request::OpenSheet>(*editor.waiting);
    const bool quit = std::holds_alternative<ui::request::Quit>(*editor.waiting);
    if (first == ui::Unsaved::Material && !comparison && is_dirty(editor.document, editor.file))
        return ui::Unsaved::Material;
    if ((comparison || quit) && sheet_unsaved(editor)) return ui::Unsaved::Comparison;
    return std::nullopt;
}

/// Asks about what would be lost, or does what waits.
void go_on(Editor& editor, ui::Unsaved first) {
    const std::optional<ui::Unsaved> loss = next_loss(editor, first);
    if (!loss) return carry_out_waiting(editor);
    const bool material = *loss == ui::Unsaved::Material;
    editor.unsaved = {.title = material ? document_title(editor.document, editor.file) : sheet_name(editor),
                      .action = editor.waiting_action,
                      .what = *loss};
    ++editor.changes;
}

void ask(Editor& editor, ui::Request request, const std::string& action) {
    editor.waiting = std::move(request);
    editor.waiting_action = action;
    go_on(editor, ui::Unsaved::Material);
}

/// Presets that ship are the program's, not the artist's: saving one asks for another place.
bool is_shipped(const fs::path& file) {
    std::error_code ignored;
    const fs::path home = fs::weakly_canonical(share_folder(), ignored);
    const fs::path relative = fs::weakly_canonical(file, ignored).lexically_relative(home);
    return !home.empty() && !relative.empty() && *relative.begin() != "..";
}

DocumentFile read_document(Editor& editor, const fs::path& file) {
    LoadedMaterial loaded = load_material(file);
    for (const std::string& note : loaded.notes) log_line(editor, ui::Severity::Warning, note);
    DocumentFile read{.path = file, .as_written = std::move(loaded.material)};
    read.saved = with_full_map_paths(read.as_written, file);
    return read;
}

}  // namespace

void ask_new(Editor& editor) { ask(editor, ui::request::New{}, "start a new material"); }
void ask_open(Editor& editor, const std::string& file) {
    if (is_comparison_file(utf8_to_path(file))) return ask_open_sheet(editor, file);
    if (set_sheet_preset(editor, file)) return;
    ask(editor, ui::request::Open{file}, "open " + path_to_utf8(utf8_to_path(file).stem()));
}
void ask_open_sheet(Editor& editor, const std::string& file) {
    ask(editor, ui::request::OpenSheet{file}, "open " + path_to_utf8(utf8_to_path(file).stem()));
}
void ask_quit(Editor& editor) { ask(editor, ui::request::Quit{}, "close Patina"); }

/// What was asked about last is saved, or was given up.
void carry_on(Editor& editor) {
    const bool material = !editor.unsaved || editor.unsaved->what == ui::Unsaved::Material;
    editor.unsaved.reset();
    if (material)
        go_on(editor, ui::Unsaved::Comparison);
    else
        carry_out_waiting(editor);
}

void answer_unsaved(Editor& editor, ui::request::Choice choice) {
    if (!editor.unsaved) return;
    const ui::UnsavedQuestion asked = *editor.unsaved;
    ++editor.changes;
    if (choice == ui::request::Choice::Discard) return carry_on(editor);
    editor.unsaved.reset();
    if (choice == ui::request::Choice::Cancel) return editor.waiting.reset();
    // Carries on once it has succeeded, perhaps after a name was chosen.
    const bool material = asked.what == ui::Unsaved::Material;
    if (material)
        save(editor);
    else
        save_sheet(editor);
    const bool still = material ? is_dirty(editor.document, editor.file) : sheet_unsaved(editor);
    if (!editor.browser.open && still && !editor.unsaved) editor.waiting.reset();
}

void drop_stale_wait(Editor& editor) {
    if (editor.waiting && !editor.unsaved && !editor.browser.open) editor.waiting.reset();
}

bool open_file(Editor& editor, const fs::path& file) {
    try {
        std::error_code failure;
        const fs::path full = fs::absolute(file, failure).lexically_normal();
        const std::size_t log_before = editor.status.log.size();
        const FileStamp stamp = stamp_of(full);
        DocumentFile read = read_document(editor, full);
        start_document(editor, std::move(read));
        editor.watch.saw(path_to_utf8(full), stamp);
        if (!is_shipped(full)) remember(editor.settings.recent, path_to_utf8(full));
        const std::size_t notes = editor.status.log.size() - log_before;
        log_line(editor, notes > 0 ? ui::Severity::Warning : ui::Severity::Info,
                 "Opened " + path_to_utf8(full.filename()) +
                     (notes == 0   ? "."
                      : notes == 1 ? " with a note."
                                   : " with " + std::to_string(notes) + " notes."));
        fill_catalog(editor);
        return true;
    } catch (const std::exception& error) {
        log_line(editor, ui::Severity::Error, error.what());
        std::error_code ignored;
        if (!fs::exists(file, ignored)) std::erase(editor.settings.recent, path_to_utf8(file));
        fill_catalog(editor);
        return false;
    }
}

bool save_file(Editor& editor, const fs::path& chosen) {
    fs::path file = chosen;
    if (file.extension() != ".json") file += ".json";
    try {
        std::error_code failure;
        file = fs::absolute(file, failure).lexically_normal();
        const Material written =
            with_preset_map_paths(editor.document.material, file, editor.file.as_written);
        save_material(file, written);
        editor.file = {.path = file, .as_written = written, .saved = editor.document.material};
        editor.watch.saw(path_to_utf8(file), stamp_of(file));
        remember(editor.settings.recent, path_to_utf8(file));
        editor.thumbnails.forget(Thumbnails::Kind::Preset, path_to_utf8(file));
        editor.sheet.presets.erase(path_to_utf8(file));
        log_line(editor, ui::Severity::Info, "Saved " + path_to_utf8(file.filename()) + ".");
        fill_catalog(editor);
    } catch (const std::exception& error) {
        log_line(editor, ui::Severity::Error, error.what());
        editor.waiting.reset();
        return false;
    }
    if (editor.waiting) carry_on(editor);
    return true;
}

void save(Editor& editor) {
    const fs::path& file = editor.file.path;
    if (!file.empty() && !is_shipped(file)) {
        save_file(editor, file);
        return;
    }
    open_browser(editor, ui::BrowserPurpose::SavePreset);
    if (!file.empty())
        say_status(editor, "This preset belongs to Patina; choose a place for your own version of it.");
}

void revert(Editor& editor) { editor.document.material = editor.file.saved; }

void reread_preset(Editor& editor) {
    const fs::path file = editor.file.path;
    const std::string name = path_to_utf8(file.filename());
    std::error_code ignored;
    if (!fs::exists(file, ignored)) {
        log_line(editor, ui::Severity::Warning, name + " was removed from the disk; save it to keep it.");
        return;
    }
    try {
        const bool was_dirty = is_dirty(editor.document, editor.file);
        DocumentFile read = read_document(editor, file);
        if (read.saved == editor.file.saved) return;
        editor.thumbnails.forget(Thumbnails::Kind::Preset, path_to_utf8(file));
        editor.file = std::move(read);
        if (!was_dirty) editor.document.material = editor.file.saved;
        log_line(editor, was_dirty ? ui::Severity::Warning : ui::Severity::Info,
                 was_dirty ? name + " was changed on disk; Revert takes it over, Save replaces it."
                           : name + " was changed on disk and read again.");
    } catch (const std::exception& error) {
        log_line(editor, ui::Severity::Error, error.what());
    }
}

}  // namespace patina
