#include "app/autosave.h"

#include "app/settings.h"
#include "materials/text_io.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <unistd.h>

#ifndef _WIN32
#include <sys/wait.h>
#endif

namespace {

using namespace patina;
namespace fs = std::filesystem;

class Folder {
public:
    Folder() {
        static int count = 0;
        path_ = fs::temp_directory_path() /
                ("patina_autosave_" + std::to_string(::getpid()) + "_" + std::to_string(count++));
        fs::create_directories(path_);
    }
    ~Folder() { fs::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

Recovery some_work() {
    Recovery work{.file = "/presets/größe.json", .unix_time_s = 1700000000};
    work.document.material.name = "Rust, \"wet\"";
    work.document.material.roughness = {.value = 0.123456789f, .map = "/maps/r.png", .invert = true};
    work.document.material.unknown_json = R"({"vendor":{"x":1}})";
    work.document.environment = "/env/sky.hdr";
    work.document.mesh = "quad";
    work.document.view = {.env_rotation_deg = 33.25f,
                          .exposure_ev = -1.5f,
                          .tonemap = Tonemap::Aces,
                          .background = Background::Plain,
                          .plain_color = {0.1f, 0.2f, 0.3f},
                          .shading = Shading::Course,
                          .debug = DebugView::Roughness};
    return work;
}

/// Leaves a recovery file behind as a killed editor would: the lock goes, the file stays.
void crash_with(const fs::path& folder, const std::string& text) {
    const pid_t child = ::fork();
    if (child == 0) {
        RecoveryFiles files(folder);
        files.write(text);
        ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
}

TEST(Autosave, reads_back_every_value_it_wrote) {
    const auto read = parse_recovery(to_json(some_work()));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->document, some_work().document);
    EXPECT_EQ(read->file, some_work().file);
    EXPECT_EQ(read->unix_time_s, 1700000000);
}

TEST(Autosave, does_not_take_anything_else_for_a_recovery_file) {
    for (const char* text : {"", "{", "[]", "{}", "null", R"({"patina_recovery": 2, "material": {}})",
                             R"({"patina_recovery": 1})", R"({"patina_recovery": 1, "material": 7})"})
        EXPECT_FALSE(parse_recovery(text)) << text;
    const std::string whole = to_json(some_work());
    EXPECT_FALSE(parse_recovery(whole.substr(0, whole.size() / 2)));
}

TEST(Autosave, waits_for_a_quiet_moment_but_not_for_ever) {
    AutosaveClock clock;
    EXPECT_FALSE(clock.due(1000.0));
    EXPECT_FALSE(clock.due_in_s(0.0));
    clock.changed(10.0);
    EXPECT_FALSE(clock.due(10.5));
    EXPECT_DOUBLE_EQ(*clock.due_in_s(10.5), AutosaveClock::kQuietSeconds - 0.5);
    EXPECT_TRUE(clock.due(10.0 + AutosaveClock::kQuietSeconds));
    clock.written();
    EXPECT_FALSE(clock.due(100.0));
    double now = 200.0;
    while (!clock.due(now)) clock.changed(now += 0.1);
    EXPECT_NEAR(now, 200.0 + AutosaveClock::kAtLeastEverySeconds, 0.3);
}

TEST(Autosave, finds_what_a_killed_editor_left) {
    const Folder folder;
    crash_with(folder.path(), to_json(some_work()));
    RecoveryFiles files(folder.path());
    EXPECT_EQ(files.problem(), "");
    const auto orphan = files.claim_orphan();
    ASSERT_TRUE(orphan);
    EXPECT_EQ(orphan->recovery.document, some_work().document);
    files.discard(*orphan);
    EXPECT_FALSE(fs::exists(orphan->file));
    EXPECT_FALSE(files.claim_orphan());
}

TEST(Autosave, leaves_the_file_of_a_living_editor_alone) {
    const Folder folder;
    RecoveryFiles first(folder.path());
    first.write(to_json(some_work()));
    RecoveryFiles second(folder.path());
    EXPECT_FALSE(second.claim_orphan());
    second.write(to_json(some_work()));
    EXPECT_FALSE(first.claim_orphan());
}

TEST(Autosave, offers_a_lost_document_to_one_editor_only_and_again_later) {
    const Folder folder;
    crash_with(folder.path(), to_json(some_work()));
    {
        RecoveryFiles first(folder.path());
        ASSERT_TRUE(first.claim_orphan());
        RecoveryFiles second(folder.path());
        EXPECT_FALSE(second.claim_orphan());
    }
    RecoveryFiles next_day(folder.path());
    EXPECT_TRUE(next_day.claim_orphan());
}

TEST(Autosave, offers_the_newest_of_several) {
    const Folder folder;
    for (const int time : {20, 40, 30}) {
        Recovery work = some_work();
        work.unix_time_s = time;
        crash_with(folder.path(), to_json(work));
    }
    RecoveryFiles files(folder.path());
    for (const int time : {40, 30, 20}) {
        const auto orphan = files.claim_orphan();
        ASSERT_TRUE(orphan);
        EXPECT_EQ(orphan->recovery.unix_time_s, time);
        files.discard(*orphan);
    }
    EXPECT_FALSE(files.claim_orphan());
}

TEST(Autosave, leaves_nothing_behind_after_a_clean_end) {
    const Folder folder;
    {
        RecoveryFiles files(folder.path());
        files.write(to_json(some_work()));
        files.remove();
        files.write(to_json(some_work()));
        files.remove();
    }
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(Autosave, survives_an_end_that_was_not_clean) {
    const Folder folder;
    { RecoveryFiles(folder.path()).write(to_json(some_work())); }
    RecoveryFiles next(folder.path());
    EXPECT_TRUE(next.claim_orphan());
}

TEST(Autosave, skips_a_broken_file_without_deleting_it) {
    const Folder folder;
    crash_with(folder.path(), "{ half a fi");
    RecoveryFiles files(folder.path());
    EXPECT_FALSE(files.claim_orphan());
    int left = 0;
    for (const auto& entry : fs::directory_iterator(folder.path()))
        left += entry.path().extension() == ".json";
    EXPECT_EQ(left, 1);
}

TEST(Autosave, says_so_where_nothing_can_be_kept) {
    const Folder folder;
    save_text(folder.path() / "file", "x");
    RecoveryFiles files(folder.path() / "file" / "state");
    EXPECT_NE(files.problem().find("PATINA_STATE_DIR"), std::string::npos);
    files.write("x");
    files.remove();
    EXPECT_FALSE(files.claim_orphan());
}

TEST(Settings, come_back_as_they_were_saved) {
    const Folder folder;
    Settings settings{.window_width = 1234,
                      .maximized = true,
                      .environment = "/größe.hdr",
                      .recent = {"/a.json", "/b.json"},
                      .library_width = 300.5f,
                      .show_inspector = false};
    save_settings(folder.path() / "new", settings);
    const ParsedSettings loaded = load_settings(folder.path() / "new");
    EXPECT_EQ(loaded.settings, settings);
    EXPECT_TRUE(loaded.notes.empty());
}

TEST(Settings, start_afresh_with_a_note_when_they_are_corrupt) {
    const Folder folder;
    EXPECT_TRUE(load_settings(folder.path()).notes.empty());
    save_text(folder.path() / "settings.json", "{\"window_width\": 12");
    const ParsedSettings loaded = load_settings(folder.path());
    EXPECT_EQ(loaded.settings, Settings{});
    EXPECT_EQ(loaded.notes.size(), 1u);
}

TEST(Settings, take_over_what_is_right_and_note_what_is_not) {
    const ParsedSettings parsed = parse_settings(
        R"({"window_width": -5, "window_height": 800, "recent": "x", "environment": 3, "library_width": 1e30,
            "mesh": "quad", "maximized": "yes"})");
    Settings expected;
    expected.window_height = 800;
    expected.mesh = "quad";
    EXPECT_EQ(parsed.settings, expected);
    EXPECT_EQ(parsed.notes.size(), 5u);
}

TEST(Settings, remember_recent_files_newest_first_each_once_and_not_too_many) {
    std::vector<std::string> list;
    for (int i = 0; i < 30; ++i) remember(list, std::to_string(i % 15), 10);
    EXPECT_EQ(list.size(), 10u);
    EXPECT_EQ(list.front(), "14");
    remember(list, "9", 10);
    EXPECT_EQ(list.front(), "9");
    EXPECT_EQ(std::count(list.begin(), list.end(), "9"), 1);
}

}  // namespace
