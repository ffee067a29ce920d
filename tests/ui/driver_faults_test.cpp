// The graphics driver gives up under a running editor: what the artist did is never lost, and one sentence
// says what happened.
#include "materials/material_io.h"
#include "renderer/core/image_io.h"
#include "tests/ui/editor_harness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#ifdef PATINA_GL_FAULT_SHIM

namespace {

using namespace patina;
using namespace patina::test;
namespace fs = std::filesystem;

/// Under the address sanitizer, whose library must come first, only if the program is told that it need not.
Program::Variables with_faults(Program::Variables variables) {
    variables["LD_PRELOAD"] = PATINA_GL_FAULT_SHIM;
    variables["ASAN_OPTIONS"] = "detect_leaks=0:verify_asan_link_order=0";
    return variables;
}

TEST(SlowDriverFaults, a_lost_context_ends_in_one_sentence_and_the_next_start_offers_the_work) {
    const Folder home;
    const fs::path sign = home / "ready.png", lost = home / "lost";
    std::ofstream(home / "gold.json") << R"({"name": "Gold", "roughness": {"value": 0.25}})";
    Program program(home,
                    drive_arguments(home, R"(
wait idle
drag material.metallic.bar 90 0
expect dirty
screenshot )" + sign.string() + R"(
wait 300 seconds
)",
                                    {(home / "gold.json").string()}),
                    with_faults({{"PATINA_GL_LOST", lost.string()}}));
    ASSERT_TRUE(wait_for_file(sign)) << program.wait().errors;
    std::ofstream(lost) << "now";
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(std::ranges::count(outcome.errors, '\n'), 1) << outcome.errors;
    EXPECT_NE(outcome.errors.find("driver was reset"), std::string::npos) << outcome.errors;
    const Outcome next = drive(home, R"(
wait idle
expect recovery=asked
click recovery.recover
wait idle
expect metallic>0.3
expect roughness=0.25
expect file~gold.json
key ctrl+s
wait until clean
)");
    EXPECT_EQ(next.status, 0) << next.errors;
    EXPECT_GT(load_material(home / "gold.json").material.metallic.value, 0.3f);
}

TEST(SlowDriverFaults, a_map_that_has_no_place_on_the_card_is_drawn_coarser_and_the_log_says_so) {
    const Folder home;
    const fs::path map = home / "noise.png";
    Image image = make_image(512, 512, 3, PixelType::U8);
    for (std::size_t i = 0; i < image.bytes.size(); ++i)
        image.bytes[i] = std::byte((i * 2654435761u >> 13) & 255u);
    save_image(map, image);
    const std::string preset = R"({"name": "Noise", "albedo": {"map": "noise.png"}})";
    std::ofstream(home / "noise.json") << preset;
    const auto outcome = [&](const char* most, const std::string& script) {
        Program program(home, drive_arguments(home, "wait idle\n" + script, {(home / "noise.json").string()}),
                        with_faults({{"PATINA_GL_MEMORY", most}}));
        return program.wait();
    };
    const Outcome coarser = outcome("100", R"(
expect albedo.state=ok
expect "log~noise.png: The graphics card has no memory left for the whole map"
expect "log~64×64 of 512×512"
expect clean
drag material.roughness.bar -60 0
wait idle
expect roughness<0.8
key ctrl+s
wait until clean
)");
    EXPECT_EQ(coarser.status, 0) << coarser.errors;
    EXPECT_EQ(load_material(home / "noise.json").material.albedo.map, "noise.png");
    const Outcome enough = outcome("512", "expect albedo.state=ok\nexpect log!~memory\n");
    EXPECT_EQ(enough.status, 0) << enough.errors;
}

}  // namespace

#endif
