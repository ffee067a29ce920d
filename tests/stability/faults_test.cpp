// What a failing machine leaves behind: processes killed at every single operation on files, disks that are
// full or broken from any operation on, folders that cannot be written, caches shared and damaged.
#include "app/autosave.h"
#include "app/settings.h"
#include "materials/material_io.h"
#include "renderer/core/image_io.h"
#include "renderer/ibl/cache.h"
#include "tests/stability/process.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sys/stat.h>
#include <unistd.h>

namespace patina {
namespace {

namespace fs = std::filesystem;
using namespace test;

/// Runs the saver with one operation going wrong; at = 0: none.
Ended save(const Folder& folder, const std::vector<std::string>& words, const std::string& kind, int at) {
    std::vector<std::string> all{PATINA_SAVER};
    all.insert(all.end(), words.begin(), words.end());
    return run_process(all, {.environment = {{"LD_PRELOAD", PATINA_FAULT_SHIM},
                                             {"ASAN_OPTIONS", "detect_leaks=0:verify_asan_link_order=0"},
                                             {"PATINA_FAULT_FOLDER", folder.path.string()},
                                             {"PATINA_FAULT_KIND", kind},
                                             {"PATINA_FAULT_AT", std::to_string(at)},
                                             {"PATINA_FAULT_COUNT", folder.path.string() + "-count"}}});
}
int operations(const Folder& folder, const std::vector<std::string>& words) {
    const Ended ended = save(folder, words, "none", 0);
    EXPECT_EQ(ended.exit_status, 0) << ended.errors;
    const fs::path count = folder.path.string() + "-count";
    const int number = std::atoi(read_text(count).c_str());
    fs::remove(count);
    return number;
}

std::string preset_name(const fs::path& file) { return load_material(file).material.name; }

TEST(Faults, a_save_killed_at_any_operation_leaves_the_old_or_the_new_preset) {
    const Folder folder;
    const fs::path file = folder.path / "mine.json";
    Material old;
    old.name = "old";
    save_material(file, old);
    const int count = operations(folder, {"preset", file.string(), "new"});
    ASSERT_GE(count, 4);  // created, written, flushed, renamed at the least
    std::set<std::string> seen;
    for (int at = 1; at <= count; ++at) {
        save_material(file, old);
        EXPECT_EQ(save(folder, {"preset", file.string(), "new"}, "kill", at).exit_status, 137);
        seen.insert(preset_name(file));
        EXPECT_TRUE(seen.contains("old") || seen.contains("new"));
        EXPECT_LE(seen.size(), 2u) << *seen.begin();
    }
    EXPECT_TRUE(seen.contains("old"));
    // The next save is not hindered by what the killed ones left.
    EXPECT_EQ(save(folder, {"preset", file.string(), "new"}, "none", 0).exit_status, 0);
    EXPECT_EQ(preset_name(file), "new");
}

TEST(SlowFaults, a_full_or_broken_disk_keeps_the_old_preset_says_so_and_leaves_nothing_behind) {
    const Folder folder;
    const fs::path file = folder.path / "mine.json";
    Material old;
    old.name = "old";
    save_material(file, old);
    const int count = operations(folder, {"preset", file.string(), "new"});
    for (const std::string kind : {"full", "broken"})
        for (int at = 1; at <= count; ++at) {
            save_material(file, old);
            const Ended ended = save(folder, {"preset", file.string(), "new"}, kind, at);
            const std::string name = preset_name(file);
            EXPECT_EQ(name, ended.exit_status == 0 ? "new" : "old") << kind << " at " << at;
            if (ended.exit_status != 0) {
                EXPECT_EQ(std::ranges::count(ended.errors, '\n'), 1) << ended.errors;
                EXPECT_NE(ended.errors.find("mine.json"), std::string::npos) << ended.errors;
            }
            EXPECT_EQ(files_below(folder.path), std::vector<std::string>{"mine.json"})
                << kind << " at " << at;
        }
}

TEST(Faults, settings_and_recovery_files_survive_a_kill_at_any_operation) {
    const Folder folder;
    const auto old_settings = [&] {
        Settings settings;
        settings.last_folder = "old";
        save_settings(folder.path, settings);
    };
    old_settings();
    const int count = operations(folder, {"settings", folder.path.string(), "new"});
    for (int at = 1; at <= count; ++at) {
        old_settings();
        EXPECT_EQ(save(folder, {"settings", folder.path.string(), "new"}, "kill", at).exit_status, 137);
        const ParsedSettings found = load_settings(folder.path);
        EXPECT_TRUE(found.settings.last_folder == "old" || found.settings.last_folder == "new");
        EXPECT_TRUE(found.notes.empty());
    }
    const Folder state;
    const std::vector<std::string> words{"recovery", state.path.string(), "work"};
    EXPECT_EQ(save(state, words, "none", 0).exit_status, 0);  // leaves the work of an editor that crashed
    bool again = true;
    for (int at = 1; again && at < 40; ++at) again = save(state, words, "kill", at).exit_status == 137;
    EXPECT_FALSE(again);
    int orphans = 0;
    RecoveryFiles files(state.path);
    while (const auto orphan = files.claim_orphan()) {
        EXPECT_EQ(orphan->recovery.document.material.name, "work");
        files.discard(*orphan);
        ASSERT_LT(++orphans, 60);
    }
    EXPECT_GE(orphans, 2);  // the whole one, and those killed after the rename
}

void expect_computed_again(const std::string& what) {
    const Folder folder;
    const std::vector<std::string> words{what, (folder.path / "cache").string()};
    const int count = operations(folder, words);
    ASSERT_GE(count, 3);
    for (const std::string kind : {"kill", "full", "broken"})
        for (int at = 1; at <= count; ++at) {
            fs::remove_all(folder.path / "cache");
            const Ended ended = save(folder, words, kind, at);
            if (kind != "kill" && ended.exit_status != 0) {
                EXPECT_NE(ended.errors.find("could not be kept"), std::string::npos) << ended.errors;
            }
            const Ended next = save(folder, words, "none", 0);
            EXPECT_EQ(next.exit_status, 0) << next.errors;
            const Ended third = save(folder, words, "none", 0);
            EXPECT_EQ(third.output, "found\n") << kind << " at " << at;
        }
}

TEST(SlowFaults, a_cache_write_that_fails_or_is_killed_is_computed_again) {
    expect_computed_again("light");
    expect_computed_again("environment");
}

TEST(SlowFaults, a_picture_is_written_whole_or_not_at_all) {
    const Folder folder;
    const fs::path file = folder.path / "a.exr";
    const std::vector<std::string> words{"picture", file.string(), "0.5"};
    const int count = operations(folder, words);
    for (const std::string kind : {"kill", "full", "broken"})
        for (int at = 1; at <= count; ++at) {
            fs::remove_all(folder.path);
            fs::create_directory(folder.path);
            const Ended ended = save(folder, words, kind, at);
            if (fs::exists(file)) {
                EXPECT_EQ(texel(load_image(file).image, 3, 3, 0), 0.5f) << kind << " at " << at;
            }
            if (kind == "kill" || ended.exit_status == 0) continue;
            EXPECT_FALSE(fs::exists(file));
            EXPECT_TRUE(files_below(folder.path).empty()) << kind << " at " << at;
        }
}

TEST(Faults, leftovers_of_a_process_with_the_same_number_do_not_hinder_a_save) {
    // In a container process numbers start over: a save may find the temporary file of a killed one.
    const Folder folder;
    for (int i = 0; i < 2000; ++i)
        write_text(folder.path / (".patina-" + std::to_string(getpid()) + "-" + std::to_string(i) + ".tmp"),
                   "half");
    Material material;
    material.name = "mine";
    ASSERT_NO_THROW(save_material(folder.path / "mine.json", material));
    EXPECT_EQ(preset_name(folder.path / "mine.json"), "mine");
}

TEST(Faults, folders_that_are_gone_or_closed_cost_one_sentence) {
    const Folder folder;
    const fs::path gone = folder.path / "gone";
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"preset", (gone / "a.json").string(), "x"},
          {"picture", (gone / "a.exr").string(), "1"},
          {"preset", "/proc/a.json", "x"},
          {"picture", "/proc/a.exr", "1"},
          {"settings", "/proc/nothing", "x"},
          {"light", "/proc/nothing"},
          {"environment", "/proc/nothing"},
          {"preset", "/dev/full", "x"},
          {"preset", folder.path.string(), "x"}}) {
        const Ended ended = save(folder, words, "none", 0);
        EXPECT_EQ(ended.exit_status, 1) << words[0] << " " << words[1];
        EXPECT_EQ(std::ranges::count(ended.errors, '\n'), 1) << ended.errors;
    }
    if (geteuid() == 0) return;  // who may do anything cannot be kept out
    const fs::path closed = folder.path / "closed";
    fs::create_directory(closed);
    chmod(closed.c_str(), 0500);
    EXPECT_EQ(save(folder, {"preset", (closed / "a.json").string(), "x"}, "none", 0).exit_status, 1);
    chmod(closed.c_str(), 0700);
}

Environment small_environment(float radiance) {
    Environment environment;
    environment.width = 16;
    environment.height = 8;
    environment.radiance.assign(128, glm::vec3(radiance));
    environment.content_hash = environment_hash(environment);
    return environment;
}

/// Any one bit of an entry turned, any length cut off: found out, baked again, the same light.
TEST(Faults, every_damaged_cache_entry_is_noticed) {
    const Folder folder;
    const BakeCache cache{.folder = folder.path};
    BakeSettings settings;
    settings.roughness = {0.6f, 1.0f};
    settings.face_sizes = {4, 4};
    settings.max_face_size = 4;
    const Environment environment = small_environment(0.75f);
    const std::string key = bake_key(environment, settings);
    const auto whole = cached_bake(environment, settings, {}, cache);
    ASSERT_TRUE(whole && whole->note.empty());
    const fs::path entry = folder.path / files_below(folder.path).at(0);
    const std::string bytes = read_text(entry);
    ASSERT_GT(bytes.size(), 1000u);
    for (std::size_t i = 0; i < bytes.size(); i += i < 256 ? 1 : 7) {
        std::string damaged = bytes;
        damaged[i] = char(damaged[i] ^ (1 << (i % 8)));
        write_text(entry, damaged);
        ASSERT_FALSE(load_baked(cache, key)) << "bit " << i % 8 << " of byte " << i;
        write_text(entry, bytes.substr(0, i));
        ASSERT_FALSE(load_baked(cache, key)) << "cut off at " << i;
    }
    write_text(entry, bytes + "x");
    ASSERT_FALSE(load_baked(cache, key));
    EXPECT_FALSE(cached_bake(environment, settings, {}, cache)->from_disk);
    EXPECT_EQ(read_text(entry), bytes);
    EXPECT_TRUE(cached_bake(environment, settings, {}, cache)->from_disk);
}

TEST(Faults, processes_that_share_a_cache_do_not_disturb_each_other) {
    const Folder folder;
    const std::string cache = (folder.path / "cache").string();
    std::vector<Child> children;
    for (int i = 0; i < 6; ++i)
        for (const char* what : {"light", "environment"})
            children.push_back(start_process({PATINA_SAVER, what, cache}, {}));
    for (Child& child : children) {
        const Ended ended = wait_for(child);
        EXPECT_EQ(ended.exit_status, 0) << ended.errors;
    }
    EXPECT_EQ(files_below(folder.path).size(), 2u);
    for (const char* what : {"light", "environment"})
        EXPECT_EQ(run_process({PATINA_SAVER, what, cache}, {}).output, "found\n");
}

}  // namespace
}  // namespace patina
