#include "app/reconcile_light.h"

#include "app/reconcile_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <unistd.h>

namespace patina {
namespace {

namespace fs = std::filesystem;

/// A folder for baked light and a small gradient to bake, "sky"; "ready" comes with its levels.
struct Workshop {
    Workshop() { registry.environments.push_back(source()); }
    ~Workshop() {
        std::error_code ignored;
        fs::remove_all(cache.folder, ignored);
    }
    Workshop(const Workshop&) = delete;
    Workshop& operator=(const Workshop&) = delete;

    static Environment sky() {
        Environment environment;
        environment.width = 32;
        environment.height = 16;
        environment.title = "Sky";
        environment.content_hash = 7;
        for (int i = 0; i < 32 * 16; ++i)
            environment.radiance.emplace_back(1.0f + 0.01f * float(i / 32), 1.0f, 2.0f);
        return environment;
    }
    EnvironmentSource source() {
        return {.name = "test",
                .description = "",
                .list = [] { return std::vector<EnvironmentItem>{}; },
                .accepts = [](const std::string& id) { return id == "sky"; },
                .load =
                    [this](const std::string&) {
                        ++decoded;
                        return sky();
                    },
                .fingerprint = [this](const std::string&) { return fingerprint; }};
    }
    std::optional<ReadyLight> get(const LightOrder& order) {
        return get_light(registry, order, settings, cache, {});
    }
    /// As whoever shows the light does; all of it is kept.
    std::optional<ReadyLight> visit(const LightOrder& order) {
        const auto ready = get(order);
        EXPECT_EQ(keep_light(registry, order, *ready, *ready->light, cache), "");
        return ready;
    }

    Registry registry;
    BakeSettings settings{.max_face_size = 16, .face_sizes = {}};
    BakeCache cache{.folder = fs::temp_directory_path() / ("patina-light-" + std::to_string(::getpid()))};
    int decoded = 0;
    std::optional<std::uint64_t> fingerprint;  ///< of "sky"; none: it is not kept
};

void expect_same(const PreparedLight& a, const PreparedLight& b) {
    EXPECT_EQ(a.panorama.exponent, b.panorama.exponent);
    ASSERT_EQ(a.panorama.levels.size(), b.panorama.levels.size());
    for (std::size_t i = 0; i < a.panorama.levels.size(); ++i)
        EXPECT_EQ(a.panorama.levels[i].rgba, b.panorama.levels[i].rgba);
    EXPECT_EQ(a.levels.roughness, b.levels.roughness);
    EXPECT_EQ(a.levels.sharpest, b.levels.sharpest);
    ASSERT_EQ(a.levels.levels.size(), b.levels.levels.size());
    for (std::size_t i = 0; i < a.levels.levels.size(); ++i)
        EXPECT_EQ(a.levels.levels[i].rgba, b.levels.levels[i].rgba);
    EXPECT_EQ(a.levels.irradiance.rgba, b.levels.irradiance.rgba);
}

NeededLight one_roughness(float roughness, bool irradiance = true) {
    return {{{roughness, roughness}}, irradiance};
}

TEST(DemandedLight, begins_with_a_first_light_and_bakes_the_one_level_that_is_needed) {
    Workshop shop;
    LightOrder order{.id = "sky", .needed = one_roughness(0.37f), .first_light = true};
    const auto first = shop.get(order);
    ASSERT_TRUE(first);
    EXPECT_TRUE(first->is_first_light);
    EXPECT_EQ(first->levels_baked, 0);
    EXPECT_TRUE(first->held->exact.levels.empty());
    EXPECT_EQ(first->light->levels.roughness.size(), standard_roughness_levels().size());
    EXPECT_FALSE(serves(*first->held, *order.needed));

    order.held = first->held;
    const auto exact = shop.get(order);
    ASSERT_TRUE(exact);
    EXPECT_FALSE(exact->is_first_light);
    EXPECT_EQ(exact->levels_baked, 1);
    EXPECT_TRUE(exact->irradiance_baked);
    EXPECT_TRUE(serves(*exact->held, *order.needed));
    EXPECT_EQ(shop.decoded, 1);
}

TEST(DemandedLight, adds_levels_without_baking_any_twice) {
    Workshop shop;
    LightOrder order{.id = "sky", .needed = one_roughness(0.37f)};
    order.held = shop.get(order)->held;
    order.needed = one_roughness(0.4f);
    const auto wider = shop.get(order);
    EXPECT_EQ(wider->levels_baked, 2);
    EXPECT_FALSE(wider->irradiance_baked);
    EXPECT_EQ(wider->held->exact.levels.size(), 3u);
    EXPECT_TRUE(serves(*wider->held, one_roughness(0.37f)));
    order.held = wider->held;
    order.needed = all_light();
    const auto all = shop.get(order);
    EXPECT_TRUE(serves(*all->held, one_roughness(0.9f)));
    EXPECT_EQ(std::size_t(all->levels_baked), standard_roughness_levels().size() - 2);
}

TEST(DemandedLight, comes_from_the_disk_without_a_first_light) {
    Workshop shop;
    shop.get({.id = "sky", .needed = all_light()});
    const auto again =
        shop.get({.id = "sky", .needed = one_roughness(standard_roughness_levels()[4]), .first_light = true});
    ASSERT_TRUE(again);
    EXPECT_TRUE(again->from_disk);
    EXPECT_FALSE(again->is_first_light);
    EXPECT_EQ(again->held->exact.levels.size(), 1u);
    const auto whatever = shop.get({.id = "sky", .first_light = true});
    EXPECT_EQ(whatever->held->exact.levels.size(), standard_roughness_levels().size());
    EXPECT_TRUE(whatever->held->coarse.levels.empty());
}

TEST(DemandedLight, bakes_nothing_for_a_mirror) {
    Workshop shop;
    const auto mirror = shop.get({.id = "sky", .needed = NeededLight{}, .first_light = true});
    ASSERT_TRUE(mirror);
    EXPECT_FALSE(mirror->is_first_light);
    EXPECT_EQ(mirror->levels_baked, 0);
    EXPECT_FALSE(mirror->irradiance_baked);
    EXPECT_FALSE(fs::exists(shop.cache.folder));
    EXPECT_EQ(mirror->light->levels.levels.size(), 1u);  // one texel, so that there is something to bind
    EXPECT_EQ(mirror->light->levels.sharpest, kSharpestLevel);
    EXPECT_NEAR(mirror->held->source.mean.y, 1.0f, 1e-5f);
    EXPECT_NEAR(mirror->held->source.mean.z, 2.0f, 1e-5f);
}

TEST(DemandedLight, is_drawn_with_coarse_levels_only_where_they_are_nearly_as_good) {
    Workshop shop;
    LightOrder order{.id = "sky", .needed = one_roughness(0.2f), .first_light = true};
    order.held = shop.get(order)->held;
    HeldLight held = *shop.get(order)->held;
    const BakedEnvironment mean = mean_light(held);
    const LightView drawn = drawn_light(held, mean);
    EXPECT_EQ(drawn.levels.front()->roughness, 0.2f);
    EXPECT_GE(drawn.levels[1]->roughness, 0.4f);
    EXPECT_EQ(drawn.levels.back()->roughness, 1.0f);
    held.exact.lights = {{{0, 1, 0}, {5, 6, 7}, 0.01f}};  // which coarse levels hold too
    EXPECT_EQ(drawn_light(held, mean).levels.size(), 1u);
    held.exact.lights.clear();
    held.coarse.lights = {{{0, 1, 0}, {5, 6, 7}, 0.03f}};  // which exact levels hold too
    EXPECT_EQ(drawn_light(held, mean).levels.size(), 1u);
}

TEST(DemandedLight, shows_the_lights_of_a_first_light) {
    Workshop shop;
    LightOrder order{.id = "sky", .needed = one_roughness(0.2f), .first_light = true};
    HeldLight held = *shop.get(order)->held;
    held.coarse.lights = {{{0, 1, 0}, {5, 6, 7}, 0.03f}};
    const BakedEnvironment mean = mean_light(held);
    ASSERT_EQ(drawn_light(held, mean).lights.size(), 1u);
    EXPECT_EQ(drawn_light(held, mean).lights[0].irradiance, glm::vec3(5, 6, 7));
}

TEST(DemandedLight, reads_a_large_source_again_to_add_to_it) {
    Workshop shop;
    LightOrder order{.id = "sky", .needed = one_roughness(0.37f)};
    HeldLight held = *shop.get(order)->held;
    held.environment = nullptr;
    order.held = std::make_shared<HeldLight>(held);
    order.needed = one_roughness(0.8f);
    EXPECT_EQ(shop.get(order)->levels_baked, 2);
    EXPECT_EQ(shop.decoded, 2);
}

TEST(KeptLight, is_neither_decoded_nor_filtered_at_the_second_visit_and_is_the_same) {
    Workshop shop;
    shop.fingerprint = 1;
    const LightOrder order{.id = "sky", .needed = one_roughness(0.37f)};
    const auto first = shop.visit(order);
    EXPECT_TRUE(first->decoded);
    EXPECT_FALSE(first->was_kept);
    const auto second = shop.visit(order);
    EXPECT_FALSE(second->decoded);
    EXPECT_TRUE(second->was_kept);
    EXPECT_TRUE(second->from_disk);
    EXPECT_EQ(second->levels_baked, 0);
    EXPECT_TRUE(second->keep_as.empty());
    EXPECT_EQ(shop.decoded, 1);
    expect_same(*first->light, *second->light);
    EXPECT_EQ(second->held->source.title, "Sky");
    EXPECT_EQ(second->held->source.mean, first->held->source.mean);
    EXPECT_EQ(second->notes, first->notes);
}

TEST(KeptLight, is_decoded_for_a_level_that_is_not_there) {
    Workshop shop;
    shop.fingerprint = 1;
    shop.visit({.id = "sky", .needed = one_roughness(0.37f)});
    const auto other = shop.visit({.id = "sky", .needed = one_roughness(0.7f), .first_light = true});
    EXPECT_TRUE(other->was_kept);
    EXPECT_TRUE(other->is_first_light);
    EXPECT_EQ(shop.decoded, 2);
    LightOrder order{.id = "sky", .needed = one_roughness(0.37f)};
    order.held = shop.visit(order)->held;  // ready from the disk, without its texels
    EXPECT_EQ(shop.decoded, 2);
    EXPECT_FALSE(order.held->environment);
    order.needed = one_roughness(standard_roughness_levels()[10]);
    const auto added = shop.visit(order);
    EXPECT_TRUE(added->decoded);
    EXPECT_GT(added->levels_baked, 0);
    EXPECT_TRUE(added->held->environment);
    order.held = nullptr;
    const auto again = shop.visit(order);  // what was added lies on the disk now
    EXPECT_FALSE(again->decoded);
    EXPECT_EQ(again->levels_baked, 0);
}

TEST(KeptLight, serves_a_mirror_without_any_bake) {
    Workshop shop;
    shop.fingerprint = 1;
    shop.visit({.id = "sky", .needed = NeededLight{}});
    const auto mirror = shop.visit({.id = "sky", .needed = NeededLight{}});
    EXPECT_TRUE(mirror->was_kept);
    EXPECT_EQ(shop.decoded, 1);
}

TEST(KeptLight, is_made_again_when_the_source_changed_or_the_entry_is_damaged) {
    Workshop shop;
    shop.fingerprint = 1;
    const LightOrder order{.id = "sky", .needed = one_roughness(0.37f)};
    const auto first = shop.visit(order);
    shop.fingerprint = 2;
    EXPECT_TRUE(shop.visit(order)->decoded);
    EXPECT_FALSE(shop.visit(order)->decoded);
    for (const auto& entry : fs::directory_iterator(shop.cache.folder)) fs::resize_file(entry, 200);
    const auto again = shop.visit(order);
    EXPECT_TRUE(again->decoded);
    EXPECT_EQ(again->levels_baked, first->levels_baked);
    expect_same(*first->light, *again->light);
    EXPECT_FALSE(shop.visit(order)->decoded);
}

TEST(KeptLight, is_not_kept_of_a_source_that_changed_while_it_was_read) {
    Workshop shop;
    shop.fingerprint = 1;
    const LightOrder order{.id = "sky", .needed = NeededLight{}};
    const auto ready = shop.get(order);
    shop.fingerprint = 2;
    EXPECT_NE(keep_light(shop.registry, order, *ready, *ready->light, shop.cache), "");
    EXPECT_FALSE(fs::exists(shop.cache.folder));
}

TEST(KeptLight, says_once_why_it_could_not_be_kept) {
    Workshop shop;
    shop.fingerprint = 1;
    shop.cache.folder = "/dev/null/light";
    const LightOrder mirror{.id = "sky", .needed = NeededLight{}};
    const auto unbaked = shop.get(mirror);
    EXPECT_TRUE(unbaked->notes.empty());
    EXPECT_NE(
        keep_light(shop.registry, mirror, *unbaked, *unbaked->light, shop.cache).find("/dev/null/light"),
        std::string::npos);
    const LightOrder rough{.id = "sky", .needed = one_roughness(0.37f)};
    const auto baked = shop.get(rough);
    ASSERT_EQ(baked->notes.size(), 1u);  // of the levels: the same sentence
    EXPECT_EQ(keep_light(shop.registry, rough, *baked, *baked->light, shop.cache), "");
}

TEST(KeptLight, is_decoded_all_the_same_where_nothing_is_skipped) {
    Workshop shop;
    shop.fingerprint = 1;
    const LightOrder order{.id = "sky", .needed = one_roughness(0.37f)};
    shop.visit(order);
    LightOrder whole = order;
    whole.skip = false;
    const auto ready = shop.visit(whole);
    EXPECT_TRUE(ready->decoded);
    expect_same(*shop.visit(order)->light, *ready->light);
}

TEST(LightWish, is_what_is_at_hand_where_that_serves) {
    const std::string base = std::string("sky") + kVersionMark + "0";
    const LightOrder order{.id = "sky", .needed = one_roughness(0.5f, false), .first_light = true};
    const LightWish cold = wish_for_light(order, base, {}, {});
    EXPECT_EQ(base_of(cold.key), base);
    ASSERT_TRUE(cold.order);
    EXPECT_TRUE(cold.order->first_light);
    EXPECT_FALSE(cold.order->held);

    auto coarse = std::make_shared<HeldLight>();
    coarse->coarse.levels = {{0.5f, {}}};
    auto exact = std::make_shared<HeldLight>();
    exact->exact.levels = {{0.5f, {}}};
    const LightWish finer = wish_for_light(order, base, {{cold.key, coarse, {}}}, {});
    ASSERT_TRUE(finer.order);
    EXPECT_EQ(finer.order->held, coarse);
    EXPECT_NE(finer.key, cold.key);
    EXPECT_EQ(base_of(finer.key), base);

    const LightWish there = wish_for_light(order, base, {{cold.key, coarse, {}}, {finer.key, exact, {}}}, {});
    EXPECT_EQ(there.key, finer.key);
    EXPECT_FALSE(there.order);

    LightOrder unknown = order;
    unknown.needed = std::nullopt;
    EXPECT_FALSE(wish_for_light(unknown, base, {{cold.key, coarse, {}}}, {}).order);
    EXPECT_TRUE(wish_for_light(unknown, base, {}, {}).order);

    auto whole = std::make_shared<HeldLight>();
    whole->is_whole = true;
    EXPECT_FALSE(wish_for_light(order, base, {{cold.key, whole, {}}}, {}).order);
}

TEST(LightWish, has_another_key_for_other_levels) {
    auto held = std::make_shared<HeldLight>();
    held->exact.levels = {{0.5f, {}}};
    const auto key = [&](const NeededLight& needed) {
        return wish_for_light({.id = "sky", .needed = needed}, "sky\n0", {{"sky\n0\n", held, {}}}, {}).key;
    };
    EXPECT_NE(key(one_roughness(0.3f, false)), key(one_roughness(0.7f, false)));
    EXPECT_NE(key(one_roughness(0.3f, false)), key(one_roughness(0.3f, true)));
    EXPECT_EQ(key(one_roughness(0.30f, false)), key(one_roughness(0.31f, false)));
}

}  // namespace
}  // namespace patina
