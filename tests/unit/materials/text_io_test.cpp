#include "materials/text_io.h"

#include "tests/unit/materials/temporary_folder.h"

#ifndef _WIN32
#include <csignal>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace patina {

namespace fs = std::filesystem;

TEST(TextIo, gives_back_what_was_saved) {
    const TemporaryFolder folder;
    const fs::path file = folder / fs::path(u8"Grünspan €.json");
    const std::string text("a\r\n\0b\xFF", 6);
    save_text(file, text);
    EXPECT_EQ(load_text(file, 100), text);
    save_text(file, "");
    EXPECT_EQ(load_text(file, 100), "");
    EXPECT_EQ(folder.count(), 1u) << "no temporary file is left";
}

TEST(TextIo, paths_are_utf8_text_with_forward_slashes) {
    const fs::path path = fs::path(u8"größe") / fs::path(u8"木.png");
    EXPECT_EQ(path_to_utf8(path), "größe/木.png");
    EXPECT_EQ(utf8_to_path("größe/木.png"), path);
}

TEST(TextIo, refuses_to_read_what_is_missing_too_large_or_no_file) {
    const TemporaryFolder folder;
    write_file(folder / "big.json", std::string(2000, ' '));
    EXPECT_EQ(load_text(folder / "big.json", 2000).size(), 2000u);
    EXPECT_NE(
        failure_of([&] { load_text(folder / "big.json", 1999); }).find("larger than the limit of 1 KiB"),
        std::string::npos);
    const std::string missing = failure_of([&] { load_text(folder / "none.json", 10); });
    EXPECT_NE(missing.find("none.json"), std::string::npos);
    EXPECT_NE(missing.find("No such file"), std::string::npos) << missing;
    EXPECT_NE(failure_of([&] { load_text(folder.path(), 10); }).find("it is a folder"), std::string::npos);
}

TEST(TextIo, refuses_to_save_onto_a_folder_or_below_a_file) {
    const TemporaryFolder folder;
    write_file(folder / "file", "old");
    EXPECT_NE(failure_of([&] { save_text(folder.path(), "x"); }).find("it is a folder"), std::string::npos);
    const std::string below = failure_of([&] { save_text(folder / "file/x.json", "x"); });
    EXPECT_NE(below.find("Cannot save"), std::string::npos);
    EXPECT_NE(below.find("Not a directory"), std::string::npos) << below;
    const std::string nowhere = failure_of([&] { save_text(folder / "none/x.json", "x"); });
    EXPECT_NE(nowhere.find("No such file or directory"), std::string::npos) << nowhere;
    EXPECT_EQ(read_file(folder / "file"), "old");
    EXPECT_EQ(folder.count(), 1u);
}

#ifndef _WIN32

namespace {

/// Runs the action in a process of its own, which may change its limits and its user; true if it says so.
template <class Action>
bool in_child(Action&& action) {
    const pid_t child = fork();
    if (child == 0) _exit(action() ? 0 : 1);
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

TEST(TextIo, a_full_disk_keeps_the_old_file_and_leaves_nothing_behind) {
    const TemporaryFolder folder;
    const fs::path file = folder / "preset.json";
    save_text(file, "old");
    EXPECT_TRUE(in_child([&] {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{4096, 4096};
        setrlimit(RLIMIT_FSIZE, &limit);
        const std::string sentence = failure_of([&] { save_text(file, std::string(100000, 'x')); });
        return sentence.find("File too large") != std::string::npos &&
               sentence.find('\n') == std::string::npos;
    }));
    EXPECT_EQ(read_file(file), "old");
    EXPECT_EQ(folder.count(), 1u);
}

TEST(TextIo, a_read_only_folder_keeps_the_old_file) {
    const TemporaryFolder folder;
    const fs::path file = folder / "preset.json";
    save_text(file, "old");
    fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read |
                                       fs::perms::others_exec);
    EXPECT_TRUE(in_child([&] {
        static constexpr uid_t kNobody = 65534;
        if (geteuid() == 0 && seteuid(kNobody) != 0) return false;
        return failure_of([&] { save_text(file, "new"); }).find("Permission denied") != std::string::npos;
    }));
    EXPECT_EQ(read_file(file), "old");
    EXPECT_EQ(folder.count(), 1u);
    fs::permissions(folder.path(), fs::perms::owner_all);
}

TEST(TextIo, a_device_or_pipe_is_neither_read_nor_replaced) {
    const TemporaryFolder folder;
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_NE(failure_of([&] { load_text(folder / "pipe", 10); }).find("not a regular file"),
              std::string::npos);
    EXPECT_NE(failure_of([&] { save_text(folder / "pipe", "x"); }).find("not a regular file"),
              std::string::npos);
    EXPECT_NE(failure_of([&] { save_text("/dev/full", "x"); }).find("not a regular file"), std::string::npos);
    EXPECT_TRUE(fs::is_fifo(folder / "pipe"));
}

TEST(TextIo, a_symbolic_link_stays_one_and_its_target_is_replaced) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "real");
    write_file(folder / "real/preset.json", "old");
    fs::create_symlink("real/preset.json", folder / "link.json");
    save_text(folder / "link.json", "new");
    EXPECT_TRUE(fs::is_symlink(folder / "link.json"));
    EXPECT_EQ(read_file(folder / "real/preset.json"), "new");

    fs::create_symlink("real/later.json", folder / "dangling.json");
    save_text(folder / "dangling.json", "made");
    EXPECT_TRUE(fs::is_symlink(folder / "dangling.json"));
    EXPECT_EQ(read_file(folder / "real/later.json"), "made");

    fs::create_symlink("circle.json", folder / "circle.json");
    EXPECT_NE(failure_of([&] { save_text(folder / "circle.json", "x"); }).find("circle"), std::string::npos);
}

TEST(TextIo, keeps_the_permissions_of_the_file_it_replaces) {
    const TemporaryFolder folder;
    const fs::path file = folder / "preset.json";
    save_text(file, "old");
    fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
    save_text(file, "new");
    EXPECT_EQ(fs::status(file).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

#endif

}  // namespace patina
