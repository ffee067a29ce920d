#include "tests/ui/panels_stage.h"

#include <gtest/gtest.h>

namespace patina::ui {

TEST(Panels, draw_every_page_and_ask_for_nothing_by_themselves) {
    Stage stage;
    for (const char* tab : {"presets", "environments", "meshes"}) {
        stage.ui.left_tab = tab;
        stage.frames(2);
    }
    for (const char* tab : {"material", "light", "view"}) {
        stage.ui.right_tab = tab;
        stage.frames(2);
    }
    stage.ui.drawer = "log";
    stage.frames(2);
    EXPECT_TRUE(stage.requests.empty());
    EXPECT_EQ(stage.material, Material{});
    EXPECT_EQ(stage.view, View{});
    EXPECT_EQ(stage.camera, Camera{});
}

}  // namespace patina::ui
