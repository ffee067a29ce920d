#include "renderer/surface_cache.h"

#include <gtest/gtest.h>

namespace patina {
namespace {

struct Surface {
    int number = 0;
    std::uint64_t bytes = 1;
};

SurfaceKey seen_from(float yaw_deg, int samples = 4) {
    SurfaceKey key{.size_px = {64, 64}, .samples = samples};
    key.camera.yaw_deg = yaw_deg;
    return key;
}

std::shared_ptr<Surface> surface(int number) { return std::make_shared<Surface>(Surface{number}); }

TEST(SurfaceCache, finds_what_was_kept_of_the_same_camera) {
    SurfaceCache<Surface> cache;
    EXPECT_FALSE(cache.find(seen_from(0.0f)));
    cache.keep(seen_from(0.0f), surface(1));
    EXPECT_EQ(cache.find(seen_from(0.0f))->number, 1);
    EXPECT_FALSE(cache.find(seen_from(1.0f)));
}

TEST(SurfaceCache, gives_back_what_a_moving_camera_left_behind) {
    SurfaceCache<Surface> cache;
    cache.keep(seen_from(0.0f), surface(1));
    EXPECT_FALSE(cache.take_old(seen_from(1.0f)));  // the last one is what the picture shows
    cache.find(seen_from(1.0f));
    cache.keep(seen_from(1.0f), surface(2));
    EXPECT_FALSE(cache.take_old(seen_from(2.0f, 1)));  // another kind of surface
    const auto old = cache.take_old(seen_from(2.0f));
    ASSERT_TRUE(old);
    EXPECT_EQ(old->number, 1);
    EXPECT_EQ(cache.size(), 1u);
    EXPECT_FALSE(cache.find(seen_from(0.0f)));
    EXPECT_TRUE(cache.find(seen_from(1.0f)));
}

TEST(SurfaceCache, leaves_what_is_still_shown) {
    SurfaceCache<Surface> cache;
    const auto shown = surface(1);
    cache.keep(seen_from(0.0f), shown);
    cache.find(seen_from(1.0f));
    cache.keep(seen_from(1.0f), surface(2));
    EXPECT_FALSE(cache.take_old(seen_from(2.0f)));
    EXPECT_EQ(cache.size(), 2u);
}

TEST(SurfaceCache, forgets_what_many_pictures_passed_by) {
    SurfaceCache<Surface> cache;
    cache.keep(seen_from(0.0f), surface(1));
    for (int i = 0; i < 40; ++i) cache.find(seen_from(1.0f));
    EXPECT_EQ(cache.size(), 0u);
}

}  // namespace
}  // namespace patina
