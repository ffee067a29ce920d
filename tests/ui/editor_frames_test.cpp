// Frames on demand: what the window draws, and that it draws nothing else.
#include "tests/ui/editor_harness.h"

#include <gtest/gtest.h>

#include <iterator>

namespace {

using namespace patina::test;
namespace fs = std::filesystem;

TEST(Editor, draws_nothing_while_nothing_changes) {
    const Folder home;
    EXPECT_DRIVEN(drive(home, R"(
wait idle
mark
wait 60 turns                    # of the event loop, which looks at files now and then
expect frames=0
expect views=0
hover material.metallic.bar      # a hover draws the interface, not the picture
wait idle
expect frames>0
expect views=0
drag viewport 40 0
wait idle
expect views>0
mark
wait 40 turns
expect frames=0
)"));
}

TEST(SlowEditor, draws_nothing_once_the_reference_has_converged) {
    const Folder home;
    EXPECT_DRIVEN(drive(home, R"(
wait idle
click toolbar.shading
click toolbar.shading.reference
wait until views>3
wait idle
mark
wait 60 turns
expect frames=0
expect views=0
)",
                        {"-", "--env", "furnace", "--window", "420x300"}));
}

int files_in(const fs::path& folder) {
    return int(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(Editor, makes_the_small_pictures_that_are_seen_and_others_when_scrolled_to) {
    const Folder home;
    const auto made = [&](const std::string& script) {
        Program program(home, drive_arguments(home, script, {"--window", "900x420"}),
                        {{"PATINA_CACHE_DIR", (home / "cache").string()}});
        const Outcome outcome = program.wait();
        EXPECT_EQ(outcome.status, 0) << outcome.errors;
        return files_in(home / "cache" / "thumbnails");
    };
    const int seen = made("wait idle\nwait 1 seconds\nwait idle\n");
    EXPECT_GE(seen, 2);
    EXPECT_LT(seen, files_in(shipped_preset("gold").parent_path()) / 2);
    EXPECT_GT(made("wait idle\nclick library.presets.search\ntype rubber\nwait idle\nwait 1 seconds\n"
                   "wait idle\n"),
              seen);
}

TEST(Editor, draws_one_frame_for_a_tooltip_that_comes_by_itself) {
    const Folder home;
    start_small(home, 500, 360);
    EXPECT_DRIVEN(drive(home, R"(
wait idle
hover material.metallic.bar
mark
wait 1 seconds
expect frames>2                  # two in which layouts settle, and the tooltip's
expect frames<5
)"));
}

TEST(SlowEditor, draws_a_caret_that_changes_until_nobody_has_touched_anything_for_a_while) {
    const Folder home;
    start_small(home, 500, 360);
    EXPECT_DRIVEN(drive(home, R"(
wait idle
click material.name
wait 1 seconds
mark
wait 6 seconds
expect frames>8                  # twice in 1.2 seconds
expect frames<12
expect views=0
wait 4 seconds
mark
wait 3 seconds
expect frames=0
type x
wait 1 seconds
mark
wait 2 seconds
expect frames>1
)"));
}

TEST(Editor, draws_nothing_while_its_window_is_hidden_and_catches_up_when_it_is_back) {
    const Folder home;
    const fs::path file = home / "gold.json", sign = home / "ready.png";
    write_text(file, R"({"name": "Gold", "roughness": {"value": 0.25}})");
    Program program(home, drive_arguments(home, R"(
wait idle
screenshot )" + sign.string() + R"(
hide
mark
wait until roughness=0.75        # the file changed, and the document follows
wait 40 turns
expect frames=0
expect views=0
show
wait until views>0
expect frames>0
)",
                                          {file.string()}));
    ASSERT_TRUE(wait_for_file(sign)) << program.wait().errors;
    write_text(file, R"({"name": "Gold", "roughness": {"value": 0.75}, "metallic": {"value": 1}})");
    EXPECT_DRIVEN(program.wait());
}

}  // namespace
