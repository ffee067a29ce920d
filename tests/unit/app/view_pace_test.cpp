#include "app/view_pace.h"

#include <gtest/gtest.h>

namespace {

using namespace patina;

TEST(ViewPace, moves_with_the_best_picture_that_is_quick_enough) {
    ViewPace pace;
    EXPECT_EQ(pace.while_moving(), Pace::Good);
    pace.took(Pace::Good, 0.02);
    EXPECT_EQ(pace.while_moving(), Pace::Good);
    pace.took(Pace::Good, 0.09);
    EXPECT_EQ(pace.while_moving(), Pace::Quick);
    pace.took(Pace::Quick, 0.03);
    EXPECT_EQ(pace.while_moving(), Pace::Quick);
    pace.took(Pace::Quick, 0.06);
    EXPECT_EQ(pace.while_moving(), Pace::Rough);
    pace.took(Pace::Rough, 0.5);
    EXPECT_EQ(pace.while_moving(), Pace::Rough);
}

TEST(ViewPace, gives_a_quick_picture_that_was_slow_once_another_try) {
    ViewPace pace;
    pace.took(Pace::Good, 0.2);
    pace.took(Pace::Quick, 0.15);
    EXPECT_EQ(pace.while_moving(), Pace::Rough);
    pace.took(Pace::Good, 0.08);
    EXPECT_EQ(pace.while_moving(), Pace::Rough);
    pace.took(Pace::Good, 0.08);
    EXPECT_EQ(pace.while_moving(), Pace::Quick);
    pace.took(Pace::Good, 0.03);
    EXPECT_EQ(pace.while_moving(), Pace::Good);
}

TEST(ViewPace, takes_software_for_slow_until_it_has_shown_how_fast_it_is) {
    ViewPace pace(true);
    EXPECT_EQ(pace.while_moving(), Pace::Rough);
    pace.took(Pace::Rough, 0.01);
    EXPECT_EQ(pace.while_moving(), Pace::Rough);
    pace.took(Pace::Good, 0.02);
    EXPECT_EQ(pace.while_moving(), Pace::Good);
    EXPECT_EQ(ViewPace(false).while_moving(), Pace::Good);
}

}  // namespace
