// The work drawer.
#include "tests/ui/panels_stage.h"

#include <gtest/gtest.h>

namespace patina::ui {
namespace {

TEST(WorkPanel, tells_every_counter_and_what_was_skipped_and_why) {
    Stage stage;
    stage.work.levels_baked = 12345;
    skip(stage.work, "irradiance", "a mirror scatters nothing");
    skip(stage.work, "irradiance", "a mirror scatters nothing");
    stage.ui.drawer = "work";
    stage.frames(3);
    ASSERT_TRUE(stage.has("work.copy"));
    stage.click("work.copy");
    const auto* copied = stage.asked<request::CopyText>();
    ASSERT_TRUE(copied);
    for (const LedgerRow& row : kLedgerRows)
        EXPECT_NE(copied->text.find(std::string(row.label) + "\t"), std::string::npos) << row.label;
    EXPECT_NE(copied->text.find("Roughness levels baked\t12345\n"), std::string::npos);
    EXPECT_NE(copied->text.find("Skipped\tirradiance: a mirror scatters nothing\t2\n"), std::string::npos);
    stage.click("work.clear");
    EXPECT_TRUE(stage.asked<request::ClearWork>());
}

}  // namespace
}  // namespace patina::ui
