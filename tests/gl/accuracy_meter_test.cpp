// The meter in the viewport: when it asks for further frames, and when it no longer draws.
#include "app/accuracy.h"
#include "tests/gl/scene.h"

#include <gtest/gtest.h>

#include <thread>

namespace patina {
namespace {

using namespace test;

TEST(AccuracyMeter, asks_for_frames_until_the_reference_stands_still_and_draws_nothing_afterwards) {
    Jobs jobs(1);
    AccuracyMeter meter(renderer(), jobs);
    Scene scene = make_scene(constant_light(1.0f), sphere());
    scene.view.shading = Shading::Reference;
    const auto turn = [&] {
        jobs.poll();
        meter.update(scene, glm::ivec2(8), {}, false);
    };
    turn();
    EXPECT_TRUE(meter.busy());
    while (meter.busy()) {
        turn();
        std::this_thread::yield();
    }
    EXPECT_TRUE(meter.status().done);
    const WorkLedger before = renderer().work();
    EXPECT_GT(before.reference_points, 0u);
    for (int i = 0; i < 10; ++i) turn();
    EXPECT_FALSE(meter.busy());
    EXPECT_EQ(renderer().work(), before);
    scene.view.exposure_ev += 1.0f;
    turn();
    EXPECT_TRUE(meter.busy());
}

}  // namespace
}  // namespace patina
