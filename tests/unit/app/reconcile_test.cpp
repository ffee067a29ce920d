#include "app/reconcile_load.h"
#include "app/reconcile_plan.h"
#include "app/reconcile_supply.h"
#include "app/watch.h"
#include "materials/text_io.h"
#include "renderer/core/image_io.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <unistd.h>

namespace {

using namespace patina;
namespace fs = std::filesystem;

TEST(ReconcilePlan, keeps_what_is_shown_and_loads_what_is_not) {
    EXPECT_EQ(decide({}, false), (Decision{NextStep::Keep, false}));
    EXPECT_EQ(decide({.wanted = "a"}, false), (Decision{NextStep::Load, false}));
    EXPECT_EQ(decide({.wanted = "a", .shown = "a"}, true), (Decision{NextStep::Keep, false}));
    EXPECT_EQ(decide({.wanted = "b", .shown = "a"}, false), (Decision{NextStep::Load, false}));
    EXPECT_EQ(decide({.wanted = "b", .shown = "a"}, true), (Decision{NextStep::TakeFromMemory, false}));
    EXPECT_EQ(decide({.shown = "a"}, false), (Decision{NextStep::Clear, false}));
}

TEST(ReconcilePlan, lets_a_load_of_the_wanted_go_on_and_stops_any_other) {
    EXPECT_EQ(decide({.wanted = "a", .loading = "a"}, false), (Decision{NextStep::Keep, false}));
    EXPECT_EQ(decide({.wanted = "b", .loading = "a"}, false), (Decision{NextStep::Load, true}));
    EXPECT_EQ(decide({.wanted = "b", .shown = "b", .loading = "a"}, false), (Decision{NextStep::Keep, true}));
    EXPECT_EQ(decide({.loading = "a"}, false), (Decision{NextStep::Keep, true}));
    EXPECT_EQ(decide({.wanted = "b", .loading = "a", .failed = "b"}, false),
              (Decision{NextStep::Keep, true}));
}

TEST(ReconcilePlan, does_not_try_again_what_failed_until_it_is_another_version) {
    EXPECT_EQ(decide({.wanted = "a#0", .failed = "a#0"}, false), (Decision{NextStep::Keep, false}));
    EXPECT_EQ(decide({.wanted = "a#1", .failed = "a#0"}, false), (Decision{NextStep::Load, false}));
}

TEST(ReconcileMemory, drops_the_least_recently_used_beyond_its_bytes) {
    Memory<int> memory(100);
    memory.put("a", 1, 40);
    memory.put("b", 2, 40);
    EXPECT_EQ(memory.get("a"), 1);
    memory.put("c", 3, 40);
    EXPECT_FALSE(memory.contains("b"));
    EXPECT_TRUE(memory.contains("a"));
    EXPECT_EQ(memory.bytes(), 80u);
    memory.put("huge", 4, 1000);
    EXPECT_EQ(memory.size(), 1u);
    EXPECT_EQ(memory.get("huge"), 4);
    memory.put("huge", 5, 10);
    EXPECT_EQ(memory.bytes(), 10u);
}

/// A supply whose loads are finished by hand.
struct Workshop {
    Supply<int> supply{3, 1000};
    std::set<std::string> started;
    std::set<std::uint64_t> stopped;
    std::uint64_t next_id = 1;

    int update() {
        return supply.update(
            [&](const std::string& key) {
                started.insert(key);
                return next_id++;
            },
            [&](std::uint64_t id) { stopped.insert(id); });
    }
};

TEST(ReconcileSupply, keeps_the_last_good_value_until_the_new_one_is_there) {
    Workshop shop;
    shop.supply.want(0, "a");
    shop.update();
    EXPECT_TRUE(shop.supply.pending());
    shop.supply.finished("a", 1, 10);
    EXPECT_FALSE(shop.supply.pending());
    shop.supply.want(0, "b");
    shop.update();
    EXPECT_TRUE(shop.supply.pending());
    EXPECT_EQ(shop.supply.slot(0).value, 1);
    shop.supply.finished("b", 2, 10);
    EXPECT_EQ(shop.supply.slot(0).value, 2);
}

TEST(ReconcileSupply, switches_back_from_memory_without_a_load) {
    Workshop shop;
    for (const auto& [key, value] : {std::pair{"a", 1}, std::pair{"b", 2}}) {
        shop.supply.want(0, key);
        shop.update();
        shop.supply.finished(key, value, 10);
    }
    shop.started.clear();
    shop.supply.want(0, "a");
    EXPECT_EQ(shop.update(), 1);
    EXPECT_TRUE(shop.started.empty());
    EXPECT_EQ(shop.supply.slot(0).value, 1);
    EXPECT_FALSE(shop.supply.pending());
}

TEST(ReconcileSupply, loads_one_file_once_for_several_slots) {
    Workshop shop;
    for (std::size_t i = 0; i < 3; ++i) shop.supply.want(i, "orm");
    EXPECT_EQ(shop.update(), 2);  // two of them share the load
    EXPECT_EQ(shop.update(), 0);
    EXPECT_EQ(shop.next_id, 2u);
    shop.supply.want(1, "");
    shop.update();
    EXPECT_TRUE(shop.stopped.empty());
    shop.supply.finished("orm", 7, 10);
    EXPECT_EQ(shop.supply.slot(0).value, 7);
    EXPECT_EQ(shop.supply.slot(2).value, 7);
    EXPECT_FALSE(shop.supply.slot(1).value);
}

TEST(ReconcileSupply, stops_a_load_that_nobody_wants_any_more_and_ignores_its_late_result) {
    Workshop shop;
    shop.supply.want(0, "a");
    shop.update();
    shop.supply.want(0, "b");
    shop.update();
    EXPECT_EQ(shop.stopped, (std::set<std::uint64_t>{1}));
    shop.supply.finished("a", 1, 10);
    EXPECT_FALSE(shop.supply.slot(0).value);
    shop.supply.failed("a", "too late");
    EXPECT_EQ(shop.supply.slot(0).error, "");
    shop.supply.finished("b", 2, 10);
    EXPECT_EQ(shop.supply.slot(0).value, 2);
}

TEST(ReconcileSupply, keeps_the_last_good_value_after_a_failure_and_says_why) {
    Workshop shop;
    shop.supply.want(0, "a");
    shop.update();
    shop.supply.finished("a", 1, 10);
    shop.supply.want(0, "b");
    shop.update();
    shop.supply.failed("b", "b: truncated.");
    EXPECT_FALSE(shop.supply.pending());
    EXPECT_EQ(shop.supply.slot(0).value, 1);
    EXPECT_EQ(shop.supply.slot(0).error, "b: truncated.");
    shop.started.clear();
    shop.update();
    EXPECT_TRUE(shop.started.empty());
    shop.supply.want(0, "a");
    shop.update();
    EXPECT_EQ(shop.supply.slot(0).error, "");
}

TEST(Watch, reports_a_changed_file_once_and_only_when_it_has_settled) {
    Watch watch;
    watch.saw("a", {true, 1, 100});
    const auto poll = [&](FileStamp stamp) { return watch.changed({{"a", stamp}}); };
    EXPECT_TRUE(poll({true, 1, 100}).empty());
    EXPECT_TRUE(poll({true, 2, 10}).empty());   // being written
    EXPECT_TRUE(poll({true, 3, 60}).empty());   // still
    EXPECT_EQ(poll({true, 3, 60}).size(), 1u);  // done
    EXPECT_TRUE(poll({true, 3, 60}).empty());
    EXPECT_TRUE(poll({}).empty());
    EXPECT_EQ(poll({}).size(), 1u);  // gone
    EXPECT_TRUE(poll({true, 9, 1}).empty());
    EXPECT_EQ(poll({true, 9, 1}).size(), 1u);  // back
}

TEST(Watch, forgets_files_that_are_not_used_any_more) {
    Watch watch;
    watch.saw("a", {true, 1, 1});
    watch.saw("b", {true, 1, 1});
    watch.keep_only({"b", "c"});
    EXPECT_EQ(watch.files(), (std::vector<std::string>{"b"}));
    EXPECT_TRUE(watch.changed({{"a", {true, 2, 2}}}).empty());
}

TEST(Watch, stamps_what_is_there_and_what_is_not) {
    const fs::path file = fs::temp_directory_path() / ("patina_watch_" + std::to_string(::getpid()));
    EXPECT_EQ(stamp_of(file), FileStamp{});
    save_text(file, "one");
    const FileStamp first = stamp_of(file);
    EXPECT_TRUE(first.exists);
    EXPECT_EQ(first.bytes, 3u);
    save_text(file, "three");
    EXPECT_NE(stamp_of(file), first);
    fs::remove(file);
    EXPECT_EQ(stamp_of(fs::temp_directory_path()), FileStamp{});
}

TEST(ReconcileLoad, says_in_a_sentence_what_is_wrong_with_a_map) {
    const Registry registry = builtin_parts();
    const auto error_of = [&](const std::string& file) -> std::string {
        try {
            load_map(registry, {.file = file});
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_NE(error_of("/nowhere/rust.png").find("/nowhere/rust.png: there is no such file"),
              std::string::npos);
    EXPECT_NE(error_of("https://example.org/a.png").find("web address"), std::string::npos);
}

TEST(ReconcileLoad, makes_small_pictures_of_the_right_shape_and_brightness) {
    Image image = make_image(512, 100, 1, PixelType::U16);
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 512; ++x) set_texel(image, x, y, 0, x < 256 ? 0.25f : 0.75f);
    const Image small = small_picture(image, 128, false);
    EXPECT_EQ(small.width, 128);
    EXPECT_EQ(small.height, 25);
    EXPECT_EQ(small.channels, 3);
    EXPECT_NEAR(texel(small, 10, 10, 2), 0.25f, 0.003f);
    EXPECT_NEAR(texel(small, 120, 10, 1), 0.75f, 0.003f);
    EXPECT_NEAR(texel(small_picture(image, 128, true), 10, 10, 0), linear_to_srgb(0.25f), 0.003f);
    EXPECT_EQ(small_picture(make_image(3, 2, 4, PixelType::U8), 128, false).width, 3);
}

}  // namespace
