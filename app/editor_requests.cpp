#include "app/editor_state.h"
#include "app/file_dialog.h"
#include "app/paths.h"
#include "app/reconcile_load.h"
#include "materials/params.h"
#include "materials/text_io.h"

#include <algorithm>

namespace patina {

namespace {

template <class... Ts>
struct Overloaded : Ts... {
    using Ts::operator()...;
};
template <class... Ts>
Overloaded(Ts...) -> Overloaded<Ts...>;

namespace ask_for = ui::request;

void step(Editor& editor, const std::optional<Document>& document, const std::string& what,
          const char* verb) {
    if (!document) return;
    editor.document = *document;
    say_status(editor, what.empty() ? std::string(verb) + "." : std::string(verb) + ": " + what + ".");
}

void clear_map(Editor& editor, MapSlot slot) { map_of(editor.document.material, slot).map->clear(); }

void cancel_job(Editor& editor, Jobs::Id job) {
    if (!cancel_report(editor, job) && !editor.reconciler.cancel(job)) editor.jobs.stop(job);
    log_line(editor, ui::Severity::Info, "Cancelled.");
}

void change_sheet(Editor& editor, const ask_for::ChangeSheet& asked) {
    if (!editor.document.sheet) return;
    Comparison& sheet = *editor.document.sheet;
    const std::vector<ViewPlace> places = places_of(sheet);
    if (std::size_t(asked.view) >= places.size()) return;
    const ViewPlace place = places[std::size_t(asked.view)];
    std::optional<ViewPlace> next;  // what is selected then
    switch (asked.change) {
        using enum ask_for::SheetChange;
        case AddLight: {
            Lighting light = lighting_at(sheet, place);
            light.photo.reset();
            sheet = with_column_after(std::move(sheet), place.column, light);
            next = ViewPlace{.row = std::max(place.row, 0), .column = place.column + 1};
            say_status(editor, "Choose a light for the new column in the library.");
            break;
        }
        case AddPreset:
            sheet = with_row_after(std::move(sheet), place.row, {.preset = "-"});
            next = ViewPlace{.row = place.row + 1, .column = std::max(place.column, 0)};
            editor.ui.left_tab = "presets";
            say_status(editor, "Choose a preset for the new row in the library.");
            break;
        case Duplicate:
            sheet = with_duplicate(std::move(sheet), place);
            next = ViewPlace{.free = place.free >= 0 ? place.free + 1 : int(sheet.views.size()) - 1};
            break;
        case Remove:
            sheet = without(std::move(sheet), place);
            break;
        case ShowEdited:
            preset_at(sheet, place) = {};
            break;
        case RemovePhoto:
            lighting_at(sheet, place).photo.reset();
            break;
    }
    const std::vector<ViewPlace> now = places_of(sheet);
    const auto found = next ? std::find(now.begin(), now.end(), *next) : now.end();
    if (found != now.end()) editor.ui.sheet_selected = int(found - now.begin());
}

void save_as(Editor& editor, const std::string& file) {
    editor.browser.open = false;
    save_file(editor, utf8_to_path(file));
}

// What is done when a panel asks.

auto document_verbs(Editor& editor) {
    return Overloaded{[&editor](const ask_for::New&) { ask_new(editor); },
                      [&editor](const ask_for::Open& r) { ask_open(editor, r.file); },
                      [&editor](const ask_for::Save&) { save(editor); },
                      [&editor](const ask_for::SaveAs& r) { save_as(editor, r.file); },
                      [&editor](const ask_for::Revert&) { revert(editor); },
                      [&editor](const ask_for::Undo&) {
                          const std::string what = editor.history.undo_what(editor.document);
                          step(editor, editor.history.undo(editor.document), what, "Undone");
                      },
                      [&editor](const ask_for::Redo&) {
                          const std::string what = editor.history.redo_what(editor.document);
                          step(editor, editor.history.redo(editor.document), what, "Redone");
                      },
                      [&editor](const ask_for::Quit&) { ask_quit(editor); },
                      [&editor](const ask_for::AnswerUnsaved& r) { answer_unsaved(editor, r.choice); },
                      [&editor](const ask_for::AnswerRecovery& r) { answer_recovery(editor, r.recovery); },
                      [&editor](const ask_for::ClearRecent&) {
                          editor.settings.recent.clear();
                          fill_catalog(editor);
                      }};
}

auto material_verbs(Editor& editor) {
    return Overloaded{[&editor](const ask_for::AssignMap& r) { assign_map(editor, r.slot, r.file); },
                      [&editor](const ask_for::ClearMap& r) { clear_map(editor, r.slot); },
                      [&editor](const ask_for::ReloadMap& r) {
                          editor.reconciler.reload(*map_of(editor.document.material, r.slot).map);
                      },
                      [&editor](const ask_for::LocateMap& r) { locate_map(editor, r.slot, r.file); },
                      [&editor](const ask_for::Dropped& r) { take_dropped(editor, r); },
                      [&editor](const ask_for::ImportMaps& r) { propose_maps(editor, r.files); },
                      [&editor](const ask_for::ApplyImport&) { apply_import_sheet(editor); },
                      [&editor](const ask_for::CancelImport&) { editor.import_sheet.reset(); },
                      [&editor](const ask_for::LoadEnvironment& r) { use_environment(editor, r.file); },
                      [&editor](const ask_for::LoadMesh& r) { use_mesh(editor, r.file); }};
}

auto comparison_verbs(Editor& editor) {
    return Overloaded{
        [&editor](const ask_for::ShowSheet& r) { show_sheet(editor, r.shown); },
        [&editor](const ask_for::ChangeSheet& r) { change_sheet(editor, r); },
        [&editor](const ask_for::OpenSheet& r) { ask_open_sheet(editor, r.file); },
        [&editor](const ask_for::SaveSheet&) { save_sheet(editor); },
        [&editor](const ask_for::SaveSheetAs& r) { save_sheet_as(editor, r.file); },
        [&editor](const ask_for::SetPhoto& r) { set_photo(editor, editor.ui.sheet_selected, r.file); },
        [&editor](const ask_for::PickCard& r) { pick_card(editor, r); },
        [&editor](const ask_for::SetMapPhoto& r) { set_map_photo(editor, r.file); },
        [&editor](const ask_for::MapPhotoOfView&) { take_map_photo_of_view(editor); },
        [&editor](const ask_for::PickMapCard& r) { pick_map_card(editor, r); },
        [&editor](const ask_for::MakeMaps&) { make_maps(editor); }};
}

auto other_verbs(Editor& editor) {
    return Overloaded{[&editor](const ask_for::ExportRender& r) { export_picture(editor, r); },
                      [&editor](const ask_for::ExportReport& r) { export_report(editor, r.file); },
                      [&editor](const ask_for::Reveal& r) {
                          if (!reveal_in_file_manager(utf8_to_path(r.path)))
                              log_line(editor, ui::Severity::Warning,
                                       "No file manager could be started to show " + r.path + ".");
                      },
                      [&editor](const ask_for::CancelJob& r) { cancel_job(editor, r.id); },
                      [&editor](const ask_for::ClearLog&) { editor.status.log.clear(); },
                      [&editor](const ask_for::ClearWork&) { editor.renderer.work() = {}; },
                      [&editor](const ask_for::CopyText& r) { editor.clipboard = r.text; },
                      [&editor](const ask_for::ListFolder& r) { list_folder(editor, r.folder); },
                      [&editor](const ask_for::MakeFolder& r) { make_folder(editor, r.folder); }};
}

}  // namespace

void carry_out(Editor& editor, const ui::Requests& requests) {
    const Overloaded verbs{document_verbs(editor), material_verbs(editor), comparison_verbs(editor),
                           other_verbs(editor)};
    for (const ui::Request& request : requests) std::visit(verbs, request);
    if (!requests.empty()) ++editor.changes;
}

void settle(Editor& editor, bool item_held) {
    if (editor.history.record(editor.document, item_held)) ++editor.changes;
    // Light or a mesh that could not be had: back to what is shown, and no undo step for it.
    const auto fall_back = [&](const std::optional<std::string>& shown, std::string& id,
                               const char* otherwise) {
        if (!shown || id == otherwise) return;
        id = shown->empty() ? otherwise : *shown;
        editor.history.amend(editor.document);
        fill_catalog(editor);
    };
    fall_back(editor.reconciler.fallback_environment(), editor.document.environment, "studio");
    fall_back(editor.reconciler.fallback_mesh(), editor.document.mesh, "sphere");
    drop_stale_wait(editor);
}

}  // namespace patina
