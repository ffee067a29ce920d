#include "renderer/ibl/cache.h"

#include "tests/unit/ibl/oracle.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <thread>

namespace patina {
namespace {

using namespace test;
namespace fs = std::filesystem;

const std::string kKey = "0123456789abcdef0123456789abcdef";

BakedEnvironment make_baked(float value = 1.0f, int size = 8) {
    BakedEnvironment baked;
    for (const float roughness : {0.1f, 0.5f, 1.0f}) {
        CubeMap cube{size, std::vector<glm::vec3>(std::size_t(6) * size * size)};
        for (std::size_t i = 0; i < cube.texels.size(); ++i)
            cube.texels[i] = glm::vec3(value * float(i), roughness, 1e30f);
        baked.levels.push_back({roughness, std::move(cube)});
    }
    baked.irradiance = {2, std::vector<glm::vec3>(24, glm::vec3(value))};
    baked.lights = {{{0, 1, 0}, {5, 6, 7}, 0.01f}};
    baked.notes = {"12 NaN texels set to 0", ""};
    return baked;
}

void expect_same(const BakedEnvironment& a, const BakedEnvironment& b) {
    ASSERT_EQ(a.levels.size(), b.levels.size());
    for (std::size_t i = 0; i < a.levels.size(); ++i) {
        EXPECT_EQ(a.levels[i].roughness, b.levels[i].roughness);
        EXPECT_EQ(a.levels[i].cube.size, b.levels[i].cube.size);
        EXPECT_EQ(a.levels[i].cube.texels, b.levels[i].cube.texels);
    }
    EXPECT_EQ(a.irradiance.size, b.irradiance.size);
    EXPECT_EQ(a.irradiance.texels, b.irradiance.texels);
    ASSERT_EQ(a.lights.size(), b.lights.size());
    for (std::size_t i = 0; i < a.lights.size(); ++i) {
        EXPECT_EQ(a.lights[i].direction, b.lights[i].direction);
        EXPECT_EQ(a.lights[i].irradiance, b.lights[i].irradiance);
        EXPECT_EQ(a.lights[i].angular_radius_rad, b.lights[i].angular_radius_rad);
    }
    EXPECT_EQ(a.notes, b.notes);
}

std::vector<fs::path> files_in(const fs::path& folder) {
    return {fs::directory_iterator(folder), fs::directory_iterator()};
}
std::vector<char> bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}
void write_bytes(const fs::path& file, const std::vector<char>& bytes) {
    std::ofstream(file, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
}

TEST(BakeCache, returns_bit_for_bit_what_was_kept) {
    const ScratchFolder scratch;
    const BakeCache cache{scratch.path() / "not" / "yet"};
    EXPECT_FALSE(load_baked(cache, kKey));
    EXPECT_EQ(save_baked(cache, kKey, make_baked()), "");
    const auto loaded = load_baked(cache, kKey);
    ASSERT_TRUE(loaded);
    expect_same(*loaded, make_baked());
}

TEST(BakeCache, refuses_a_file_cut_anywhere) {
    const ScratchFolder scratch;
    const BakeCache cache{scratch.path()};
    save_baked(cache, kKey, make_baked());
    const fs::path file = files_in(scratch.path()).at(0);
    const std::vector<char> whole = bytes_of(file);
    for (std::size_t length = 0; length < whole.size(); length += length < 120 ? 1 : 1997) {
        write_bytes(file, {whole.begin(), whole.begin() + std::ptrdiff_t(length)});
        EXPECT_FALSE(load_baked(cache, kKey)) << length;
    }
    std::vector<char> longer = whole;
    longer.push_back(0);
    write_bytes(file, longer);
    EXPECT_FALSE(load_baked(cache, kKey));
}

TEST(BakeCache, refuses_a_file_with_any_bit_flipped) {
    const ScratchFolder scratch;
    const BakeCache cache{scratch.path()};
    save_baked(cache, kKey, make_baked(1.0f, 2));
    const fs::path file = files_in(scratch.path()).at(0);
    const std::vector<char> whole = bytes_of(file);
    for (std::size_t i = 0; i < whole.size(); i += i < 200 ? 1 : 7) {
        std::vector<char> damaged = whole;
        damaged[i] = char(damaged[i] ^ (1 << (i % 8)));
        write_bytes(file, damaged);
        EXPECT_FALSE(load_baked(cache, kKey)) << "byte " << i;
    }
}

TEST(BakeCache, refuses_garbage_and_another_entry_under_the_same_name) {
    const ScratchFolder scratch;
    const BakeCache cache{scratch.path()};
    save_baked(cache, kKey, make_baked());
    const fs::path file = files_in(scratch.path()).at(0);
    const std::string other(32, 'f');
    fs::rename(file, scratch.path() / (other + file.extension().string()));
    EXPECT_FALSE(load_baked(cache, other));
    write_bytes(file, std::vector<char>(5000, 'x'));
    EXPECT_FALSE(load_baked(cache, kKey));
    fs::remove(file);
    fs::create_directory(file);
    EXPECT_FALSE(load_baked(cache, kKey));
}

TEST(BakeCache, lets_the_least_recently_used_go_first) {
    const ScratchFolder scratch;
    BakeCache cache{scratch.path()};
    const std::string a(32, 'a'), b(32, 'b'), c(32, 'c');
    save_baked(cache, a, make_baked());
    const std::uint64_t entry = fs::file_size(files_in(scratch.path()).at(0));
    save_baked(cache, b, make_baked());
    const auto now = fs::file_time_type::clock::now();
    for (const fs::path& file : files_in(scratch.path()))
        fs::last_write_time(file, now - std::chrono::hours(file.stem() == a ? 3 : 2));
    ASSERT_TRUE(load_baked(cache, a));  // used now, so b is the oldest
    cache.max_bytes = 2 * entry;
    save_baked(cache, c, make_baked());
    EXPECT_TRUE(load_baked(cache, a));
    EXPECT_FALSE(load_baked(cache, b));
    EXPECT_TRUE(load_baked(cache, c));
}

TEST(BakeCache, leaves_other_files_alone_and_clears_what_dead_writers_left) {
    const ScratchFolder scratch;
    const BakeCache cache{scratch.path()};
    write_bytes(scratch.path() / "holiday.jpg", {1, 2, 3});
    write_bytes(scratch.path() / "old.patina-tmp", {1});
    write_bytes(scratch.path() / "young.patina-tmp", {1});
    fs::last_write_time(scratch.path() / "old.patina-tmp",
                        fs::file_time_type::clock::now() - std::chrono::hours(5));
    save_baked(cache, kKey, make_baked());
    EXPECT_TRUE(fs::exists(scratch.path() / "holiday.jpg"));
    EXPECT_TRUE(fs::exists(scratch.path() / "young.patina-tmp"));
    EXPECT_FALSE(fs::exists(scratch.path() / "old.patina-tmp"));
}

TEST(BakeCache, says_so_when_it_cannot_write) {
    const ScratchFolder scratch;
    write_bytes(scratch.path() / "file", {1});
    const std::string in_the_way = save_baked({scratch.path() / "file" / "below"}, kKey, make_baked());
    EXPECT_NE(in_the_way.find("could not be kept"), std::string::npos);
    BakeCache tiny{scratch.path()};
    tiny.max_bytes = 100;
    EXPECT_NE(save_baked(tiny, kKey, make_baked()).find("larger than the cache"), std::string::npos);
    EXPECT_EQ(files_in(scratch.path()).size(), 1u);
}

TEST(BakeCache, serves_many_writers_and_readers_at_once) {
    const ScratchFolder scratch;
    const BakeCache cache{scratch.path()};
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&] {
            for (int i = 0; i < 20; ++i) {
                EXPECT_EQ(save_baked(cache, kKey, make_baked()), "");
                const auto loaded = load_baked(cache, kKey);
                ASSERT_TRUE(loaded);
                EXPECT_EQ(loaded->levels[1].cube.texels, make_baked().levels[1].cube.texels);
            }
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(files_in(scratch.path()).size(), 1u);
}

TEST(BakeCache, keys_differ_with_content_and_settings) {
    const Environment a = noise_panorama(8, 4, 1), b = noise_panorama(8, 4, 2);
    BakeSettings fewer;
    fewer.roughness.pop_back();
    fewer.irradiance = false;
    BakeSettings sized;
    sized.face_sizes.assign(sized.roughness.size(), 8);
    BakeSettings sized_fewer = sized;
    sized_fewer.face_sizes.pop_back();
    sized_fewer.roughness.pop_back();
    BakeSettings smaller;
    smaller.max_face_size = 64;
    EXPECT_EQ(bake_key(a, {}), bake_key(a, {}));
    EXPECT_NE(bake_key(a, {}), bake_key(b, {}));
    EXPECT_EQ(bake_key(a, {}), bake_key(a, fewer));
    EXPECT_NE(bake_key(a, {}), bake_key(a, sized));
    EXPECT_NE(bake_key(a, sized), bake_key(a, sized_fewer));
    EXPECT_NE(bake_key(a, {}), bake_key(a, smaller));
    EXPECT_EQ(bake_key(a, {}).size(), 32u);
}

TEST(BakeCache, bakes_once_then_reads) {
    const ScratchFolder scratch;
    const BakeCache cache{scratch.path()};
    const Environment environment = noise_panorama(16, 8, 3);
    BakeSettings settings;
    settings.roughness = {0.2f, 0.8f};
    settings.max_face_size = 16;
    const auto first = cached_bake(environment, settings, {}, cache);
    const auto second = cached_bake(environment, settings, {}, cache);
    ASSERT_TRUE(first && second);
    EXPECT_FALSE(first->from_disk);
    EXPECT_TRUE(second->from_disk);
    expect_same(first->baked, second->baked);
    write_bytes(files_in(scratch.path()).at(0), {'b', 'a', 'd'});
    const auto third = cached_bake(environment, settings, {}, cache);
    ASSERT_TRUE(third);
    EXPECT_FALSE(third->from_disk);
    expect_same(first->baked, third->baked);
}

TEST(BakeCache, serves_fewer_levels_from_an_entry_with_more) {
    const ScratchFolder scratch;
    const BakeCache cache{scratch.path()};
    const Environment environment = noise_panorama(16, 8, 3);
    BakeSettings all;
    all.roughness = {0.2f, 0.5f, 0.8f};
    all.max_face_size = 16;
    BakeSettings one = all;
    one.roughness = {0.5f};
    one.irradiance = false;
    const auto whole = cached_bake(environment, all, {}, cache);
    const auto part = cached_bake(environment, one, {}, cache);
    ASSERT_TRUE(whole && part);
    EXPECT_TRUE(part->from_disk);
    EXPECT_EQ(part->levels_baked, 0);
    ASSERT_EQ(part->baked.levels.size(), 1u);
    EXPECT_EQ(part->baked.levels[0].roughness, 0.5f);
    EXPECT_EQ(part->baked.levels[0].cube.texels, whole->baked.levels[1].cube.texels);
    EXPECT_EQ(part->baked.irradiance.size, 0);
}

TEST(BakeCache, selects_levels_in_the_order_asked_for_and_as_often) {
    const auto level = [](float roughness, float value) {
        return PrefilteredLevel{roughness, {1, std::vector<glm::vec3>(6, glm::vec3(value))}};
    };
    const BakedEnvironment entry{.levels = {level(0.2f, 2.0f), level(0.5f, 5.0f), level(0.8f, 8.0f)},
                                 .irradiance = {1, std::vector<glm::vec3>(6, glm::vec3(1.0f))}};
    BakeSettings settings;
    settings.roughness = {0.8f, 0.2f, 0.8f};
    settings.irradiance = false;
    ASSERT_TRUE(holds(entry, settings));
    const BakedEnvironment found = selected(entry, settings);
    ASSERT_EQ(found.levels.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(found.levels[i].cube.texels.at(5).x, 10.0f * settings.roughness[i]);
    EXPECT_EQ(found.irradiance.size, 0);
    settings.roughness = {0.2f, 0.5f, 0.8f};
    settings.irradiance = true;
    EXPECT_EQ(selected(entry, settings).irradiance.texels.size(), 6u);
    settings.roughness.push_back(0.9f);
    EXPECT_FALSE(holds(entry, settings));
    EXPECT_FALSE(holds({.levels = entry.levels}, {.roughness = {0.2f}, .face_sizes = {}}));
}

TEST(BakeCache, bakes_only_what_an_entry_lacks_and_adds_it) {
    const ScratchFolder scratch;
    const BakeCache cache{scratch.path()};
    const Environment environment = noise_panorama(16, 8, 3);
    BakeSettings one, wider;
    one.roughness = {0.5f};
    one.irradiance = false;
    wider.roughness = {0.2f, 0.5f, 0.8f};
    one.max_face_size = wider.max_face_size = 16;
    const auto first = cached_bake(environment, one, {}, cache);
    ASSERT_TRUE(first);
    EXPECT_EQ(first->levels_baked, 1);
    EXPECT_FALSE(first->irradiance_baked);
    EXPECT_EQ(first->baked.irradiance.size, 0);
    const auto second = cached_bake(environment, wider, {}, cache);
    ASSERT_TRUE(second);
    EXPECT_FALSE(second->from_disk);
    EXPECT_EQ(second->levels_baked, 2);
    EXPECT_TRUE(second->irradiance_baked);
    ASSERT_EQ(second->baked.levels.size(), 3u);
    EXPECT_EQ(second->baked.levels[1].cube.texels, first->baked.levels[0].cube.texels);
    EXPECT_EQ(files_in(scratch.path()).size(), 1u);
    const auto third = cached_bake(environment, wider, {}, cache);
    ASSERT_TRUE(third);
    EXPECT_TRUE(third->from_disk);
    expect_same(second->baked, third->baked);
}

TEST(BakeCache, bakes_and_keeps_nothing_where_nothing_is_asked_for) {
    const ScratchFolder scratch;
    BakeSettings nothing;
    nothing.roughness.clear();
    nothing.irradiance = false;
    const auto result = cached_bake(noise_panorama(16, 8, 3), nothing, {}, {scratch.path()});
    ASSERT_TRUE(result);
    EXPECT_TRUE(result->baked.levels.empty());
    EXPECT_EQ(result->baked.irradiance.size, 0);
    EXPECT_TRUE(files_in(scratch.path()).empty());
}

TEST(BakeCache, keeps_nothing_of_a_stopped_bake) {
    const ScratchFolder scratch;
    std::stop_source stop;
    stop.request_stop();
    BakeControl control;
    control.stop = stop.get_token();
    EXPECT_FALSE(cached_bake(noise_panorama(16, 8, 3), {}, control, {scratch.path()}));
    EXPECT_TRUE(files_in(scratch.path()).empty());
}

}  // namespace
}  // namespace patina
