#include "app/undo.h"

#include <gtest/gtest.h>

namespace {

using patina::Document;
using patina::History;

Document rough(float value) {
    Document document;
    document.material.roughness.value = value;
    return document;
}

TEST(Undo, goes_back_and_forth) {
    History history(rough(0.5f));
    EXPECT_FALSE(history.can_undo(rough(0.5f)));
    EXPECT_TRUE(history.record(rough(0.4f), false));
    EXPECT_TRUE(history.record(rough(0.3f), false));
    EXPECT_EQ(history.undo(rough(0.3f)), rough(0.4f));
    EXPECT_EQ(history.undo(rough(0.4f)), rough(0.5f));
    EXPECT_EQ(history.undo(rough(0.5f)), std::nullopt);
    EXPECT_EQ(history.redo(rough(0.5f)), rough(0.4f));
    EXPECT_EQ(history.redo(rough(0.4f)), rough(0.3f));
    EXPECT_EQ(history.redo(rough(0.3f)), std::nullopt);
}

TEST(Undo, takes_a_drag_as_one_step_that_ends_when_nothing_is_held) {
    History history(rough(0.5f));
    for (int i = 1; i <= 100; ++i) EXPECT_FALSE(history.record(rough(0.5f - 0.001f * float(i)), true));
    EXPECT_TRUE(history.record(rough(0.4f), false));
    EXPECT_EQ(history.size(), 2u);
    EXPECT_EQ(history.undo(rough(0.4f)), rough(0.5f));
}

TEST(Undo, is_no_step_when_a_drag_comes_back_to_where_it_began) {
    History history(rough(0.5f));
    history.record(rough(0.1f), true);
    EXPECT_FALSE(history.record(rough(0.5f), false));
    EXPECT_EQ(history.size(), 1u);
}

TEST(Undo, undoes_a_change_that_is_not_a_step_yet) {
    History history(rough(0.5f));
    history.record(rough(0.2f), true);
    EXPECT_TRUE(history.can_undo(rough(0.2f)));
    EXPECT_EQ(history.undo_what(rough(0.2f)), "Roughness");
    EXPECT_EQ(history.undo(rough(0.2f)), rough(0.5f));
    EXPECT_EQ(history.redo(rough(0.5f)), rough(0.2f));
}

TEST(Undo, drops_what_could_be_redone_at_the_next_change) {
    History history(rough(0.5f));
    history.record(rough(0.4f), false);
    history.undo(rough(0.4f));
    EXPECT_TRUE(history.can_redo(rough(0.5f)));
    EXPECT_EQ(history.redo_what(rough(0.5f)), "Roughness");
    history.record(rough(0.9f), false);
    EXPECT_FALSE(history.can_redo(rough(0.9f)));
    EXPECT_EQ(history.redo(rough(0.9f)), std::nullopt);
    EXPECT_EQ(history.undo(rough(0.9f)), rough(0.5f));
}

TEST(Undo, is_bounded_and_forgets_the_oldest_first) {
    History history(rough(0.0f), 10);
    for (int i = 1; i <= 100; ++i) history.record(rough(float(i)), false);
    EXPECT_EQ(history.size(), 10u);
    Document now = rough(100.0f);
    int steps = 0;
    while (const auto back = history.undo(now)) {
        now = *back;
        ++steps;
    }
    EXPECT_EQ(steps, 9);
    EXPECT_EQ(now, rough(91.0f));
}

TEST(Undo, starts_afresh_with_another_document) {
    History history(rough(0.5f));
    history.record(rough(0.4f), false);
    history.reset(rough(0.7f));
    EXPECT_FALSE(history.can_undo(rough(0.7f)));
    EXPECT_FALSE(history.can_redo(rough(0.7f)));
}

TEST(Undo, amends_a_step_without_adding_one_and_drops_one_that_then_changes_nothing) {
    History history(rough(0.5f));
    history.record(rough(0.4f), false);
    history.amend(rough(0.3f));
    EXPECT_EQ(history.size(), 2u);
    EXPECT_EQ(history.undo(rough(0.3f)), rough(0.5f));
    history.record(rough(0.1f), false);
    history.amend(rough(0.5f));
    EXPECT_EQ(history.size(), 1u);
    EXPECT_FALSE(history.can_undo(rough(0.5f)));
}

TEST(Undo, covers_light_mesh_and_view_as_well) {
    Document document;
    History history(document);
    document.environment = "sky";
    history.record(document, false);
    document.mesh = "quad";
    history.record(document, false);
    document.view.exposure_ev = 2.0f;
    history.record(document, false);
    EXPECT_EQ(history.undo_what(document), "Exposure");
    document = *history.undo(document);
    EXPECT_EQ(history.undo_what(document), "Mesh");
    document = *history.undo(document);
    EXPECT_EQ(history.undo_what(document), "Environment");
    EXPECT_EQ(*history.undo(document), Document{});
}

}  // namespace
