// The accuracy drawer and the viewport's split.
#include "tests/ui/panels_stage.h"

#include <gtest/gtest.h>

namespace patina::ui {
namespace {

struct Meter : Stage {
    Meter() {
        viewport.texture = 7;
        ui.drawer = "accuracy";
        frames(3);
    }
};

TEST(AccuracyPanel, measures_only_while_it_is_open) {
    Stage stage;
    EXPECT_FALSE(stage.ui.accuracy.meter);
    stage.ui.drawer = "accuracy";
    stage.frames(2);
    EXPECT_TRUE(stage.ui.accuracy.meter);
    EXPECT_TRUE(stage.has("accuracy.headline"));
    stage.ui.drawer.clear();
    stage.frames(2);
    EXPECT_FALSE(stage.ui.accuracy.meter);
}

TEST(AccuracyPanel, chooses_what_both_sides_show) {
    Meter stage;
    stage.click("accuracy.left");
    stage.click("accuracy.left.course");
    EXPECT_EQ(stage.ui.accuracy.left.kind, Layer::Mode);
    EXPECT_EQ(stage.ui.accuracy.left.mode, Shading::Course);
    stage.click("accuracy.right");
    stage.click("accuracy.right.flip");
    EXPECT_EQ(stage.ui.accuracy.right.kind, Layer::Flip);
    EXPECT_FALSE(stage.has("viewport.split"));
    stage.click("accuracy.split");
    EXPECT_TRUE(stage.ui.accuracy.split);
    stage.frames(2);
    EXPECT_TRUE(stage.has("viewport.split"));
    EXPECT_TRUE(stage.has("viewport.legend.flip"));
    EXPECT_FALSE(stage.has("viewport.legend.error"));
}

TEST(AccuracyPanel, the_line_is_dragged_and_the_camera_stays) {
    Meter stage;
    stage.ui.accuracy.split = true;
    stage.frames(2);
    const Camera before = stage.camera;
    stage.drag("viewport.split", {60.0f, 0.0f});
    EXPECT_GT(stage.ui.accuracy.split_at, 0.52f);
    EXPECT_EQ(stage.camera, before);
    stage.drag("viewport.split", {-4000.0f, 0.0f});
    EXPECT_GT(stage.ui.accuracy.split_at, 0.0f);
    EXPECT_LT(stage.ui.accuracy.split_at, 0.1f);
    stage.ui.accuracy.split = false;
    stage.frames(2);
    stage.drag("viewport", {40.0f, 0.0f});
    EXPECT_FALSE(stage.camera == before);
}

}  // namespace
}  // namespace patina::ui
