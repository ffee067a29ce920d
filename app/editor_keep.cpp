#include "app/editor_state.h"
#include "materials/text_io.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <exception>

namespace patina {

namespace {

constexpr double kWatchEverySeconds = 0.5;
constexpr double kRestlessSeconds = 3600.0;

std::string time_in_words(std::int64_t unix_time_s) {
    const auto then = static_cast<std::time_t>(unix_time_s);
    const std::time_t now = std::time(nullptr);
    const auto local = [](std::time_t time) {
        std::tm parts{};
#ifdef _WIN32
        localtime_s(&parts, &time);
#else
        localtime_r(&time, &parts);
#endif
        return parts;
    };
    const std::tm a = local(then), b = local(now);
    std::array<char, 32> text{};
    const bool today = a.tm_year == b.tm_year && a.tm_yday == b.tm_yday;
    std::strftime(text.data(), text.size(), today ? "today at %H:%M" : "on %Y-%m-%d at %H:%M", &a);
    return text.data();
}

/// One write or removal at a time, on a worker: a disk that flushes slowly must not stall the window.
void bring_recovery_file_up_to_date(Editor& editor) {
    if (editor.kept == editor.to_keep || editor.jobs.is_running(editor.autosave_job)) return;
    editor.kept = editor.to_keep;
    editor.autosave_job = editor.jobs.start(
        "",
        [&recovery = editor.recovery, text = editor.to_keep](JobContext&) -> Jobs::Done {
            if (text)
                recovery.write(*text);
            else
                recovery.remove();
            return {};
        },
        [&editor](const std::string& error) {
            log_line(editor, ui::Severity::Warning, "Unsaved work is not kept for a crash: " + error);
        });
}

Recovery recovery_of(const Editor& editor) {
    Recovery recovery{editor.document, editor.file.path, {}, std::time(nullptr)};
    recovery.document.sheet.reset();
    if (sheet_unsaved(editor)) {
        recovery.document.sheet = current_sheet(editor);
        recovery.sheet_file = sheet_file(editor).path;
    }
    return recovery;
}

}  // namespace

bool keep_now(Editor& editor) {
    try {
        editor.to_keep = to_json(recovery_of(editor));
        editor.recovery.write(*editor.to_keep);
        editor.kept = editor.to_keep;
        return true;
    } catch (const std::exception& error) {
        log_line(editor, ui::Severity::Warning, error.what());
        return false;
    }
}

void offer_recovery(Editor& editor) {
    if (!editor.recovery.problem().empty())
        log_line(editor, ui::Severity::Warning, editor.recovery.problem());
    editor.orphan = editor.recovery.claim_orphan();
    if (!editor.orphan) return;
    const Recovery& found = editor.orphan->recovery;
    const std::string title =
        found.file.empty() ? found.document.material.name : path_to_utf8(found.file.stem());
    editor.recovery_question = {.title = found.document.sheet ? title + " and its comparison" : title,
                                .when = time_in_words(found.unix_time_s)};
    ++editor.changes;
}

void answer_recovery(Editor& editor, ui::request::Recovery answer) {
    if (!editor.orphan) return;
    const RecoveryFiles::Orphan orphan = *std::exchange(editor.orphan, std::nullopt);
    editor.recovery_question.reset();
    ++editor.changes;
    if (answer == ui::request::Recovery::Later) return;
    if (answer == ui::request::Recovery::Recover) {
        const Recovery& found = orphan.recovery;
        std::error_code ignored;
        const bool opened = !found.file.empty() && std::filesystem::exists(found.file, ignored) &&
                            open_file(editor, found.file);
        if (!opened) {
            editor.file = {.path = found.file};
            ++editor.opened;
        }
        editor.document = found.document;
        if (found.document.sheet) restore_sheet(editor, *found.document.sheet, found.sheet_file);
        editor.history.record(editor.document, false);
        editor.autosave_seen = editor.document;
        log_line(editor, ui::Severity::Info, "Recovered the unsaved changes; save them to keep them.");
        if (!keep_now(editor)) return;  // the old file goes only when this editor's own one holds the work
    }
    editor.recovery.discard(orphan);
    offer_recovery(editor);
}

bool has_unsaved_work(const Editor& editor) {
    return is_dirty(editor.document, editor.file) || sheet_unsaved(editor);
}

void keep_work(Editor& editor, double now_s) {
    const bool dirty = has_unsaved_work(editor);
    if (!dirty) {
        editor.to_keep.reset();
        editor.autosave.written();
        editor.autosave_seen = editor.document;
    } else if (!(editor.autosave_seen == editor.document)) {
        editor.autosave.changed(now_s);
        editor.autosave_seen = editor.document;
    }
    if (dirty && editor.autosave.due(now_s)) {
        editor.to_keep = to_json(recovery_of(editor));
        editor.autosave.written();
    }
    bring_recovery_file_up_to_date(editor);
}

void watch_files(Editor& editor, double now_s) {
    for (const auto& [file, stamp] : editor.reconciler.take_files_read()) editor.watch.saw(file, stamp);
    if (now_s < editor.next_watch_s || editor.jobs.is_running(editor.watch_job)) return;
    editor.next_watch_s = now_s + kWatchEverySeconds;
    std::vector<std::string> wanted{editor.document.mesh, editor.document.environment};
    if (!editor.file.path.empty()) wanted.push_back(path_to_utf8(editor.file.path));
    for (const ui::MapStatus& map : editor.reconciler.maps()) wanted.push_back(map.full_path);
    editor.watch.keep_only(wanted);
    const std::vector<std::string> files = editor.watch.files();
    if (files.empty()) return;
    editor.watch_job = editor.jobs.start("", [&editor, files](JobContext&) -> Jobs::Done {
        std::vector<std::pair<std::string, FileStamp>> polled;
        polled.reserve(files.size());
        for (const std::string& file : files) polled.emplace_back(file, stamp_of(utf8_to_path(file)));
        return [&editor, polled = std::move(polled)] {
            for (const std::string& file : editor.watch.changed(polled)) {
                if (file == path_to_utf8(editor.file.path))
                    reread_preset(editor);
                else
                    editor.reconciler.reload(file);
                ++editor.changes;
            }
        };
    });
}

double next_errand_s(const Editor& editor, double now_s) {
    double wait = std::max(0.0, editor.next_watch_s - now_s);
    wait = std::min(wait, editor.autosave.due_in_s(now_s).value_or(kRestlessSeconds));
    return wait;
}

}  // namespace patina
