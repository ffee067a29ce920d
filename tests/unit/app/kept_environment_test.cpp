#include "app/kept_environment.h"

#include "app/reconcile_load.h"
#include "app/temporary_folder.h"
#include "renderer/ibl/cache.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <iterator>

namespace patina {
namespace {

namespace fs = std::filesystem;

const std::string kKey(32, 'a');

/// A sky with a lamp small enough to be kept apart.
Environment lamp_sky(int width = 64) {
    Environment environment{.id = "lamp", .title = "Lamp", .width = width, .height = width / 2};
    for (int i = 0; i < width * width / 2; ++i)
        environment.radiance.emplace_back(0.2f + 0.001f * float(i % 97), 0.3f, 0.4f);
    environment.radiance[std::size_t(width) * 9 + 7] = glm::vec3(90000.0f, 80000.0f, 70000.0f);
    environment.notes = {"12 NaN values were set to 0", ""};
    environment.content_hash = environment_hash(environment);
    return environment;
}

void expect_same(const PanoramaLevels& a, const PanoramaLevels& b) {
    EXPECT_EQ(a.exponent, b.exponent);
    ASSERT_EQ(a.levels.size(), b.levels.size());
    for (std::size_t i = 0; i < a.levels.size(); ++i) {
        EXPECT_EQ(a.levels[i].width, b.levels[i].width);
        EXPECT_EQ(a.levels[i].height, b.levels[i].height);
        EXPECT_EQ(a.levels[i].rgba, b.levels[i].rgba);
    }
    ASSERT_EQ(a.lights.size(), b.lights.size());
    for (std::size_t i = 0; i < a.lights.size(); ++i) {
        EXPECT_EQ(a.lights[i].direction, b.lights[i].direction);
        EXPECT_EQ(a.lights[i].irradiance, b.lights[i].irradiance);
        EXPECT_EQ(a.lights[i].angular_radius_rad, b.lights[i].angular_radius_rad);
    }
}

void expect_same(const EnvironmentFacts& a, const EnvironmentFacts& b) {
    EXPECT_EQ(a.title, b.title);
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    EXPECT_EQ(a.max_radiance, b.max_radiance);
    EXPECT_EQ(a.mean, b.mean);
    EXPECT_EQ(a.content_hash, b.content_hash);
    EXPECT_EQ(a.notes, b.notes);
}

/// A cache with that environment in it, by kKey.
struct Kept {
    explicit Kept(const Environment& environment = lamp_sky())
        : facts(facts_of(environment)), panorama(make_panorama_levels(environment)) {
        EXPECT_EQ(save_kept(cache, kKey, facts, panorama), "");
    }
    fs::path file() const { return folder.path() / (kKey + ".patina-environment"); }
    std::vector<char> bytes() const {
        std::ifstream in(file(), std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    void write(const std::vector<char>& bytes) const {
        const fs::path target = file();
        std::ofstream(target, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
    }

    TemporaryFolder folder{"patina-kept"};
    BakeCache cache{.folder = folder.path()};
    EnvironmentFacts facts;
    PanoramaLevels panorama;
};

TEST(KeptEnvironment, comes_back_bit_for_bit) {
    for (const int width : {2, 64, 100}) {
        const Environment environment =
            width < 64 ? Environment{.title = "", .width = 2, .height = 3, .radiance = {6, glm::vec3(0.5f)}}
                       : lamp_sky(width);
        const Kept kept(environment);
        const auto loaded = load_kept(kept.cache, kKey);
        ASSERT_TRUE(loaded) << width;
        expect_same(loaded->facts, kept.facts);
        expect_same(loaded->panorama, kept.panorama);
    }
    EXPECT_FALSE(Kept().panorama.lights.empty());
}

TEST(KeptEnvironment, tells_what_a_decoded_one_tells) {
    const Environment environment = lamp_sky();
    const EnvironmentFacts facts = facts_of(environment);
    EXPECT_EQ(facts.max_radiance, 90000.0f);
    EXPECT_EQ(facts.content_hash, environment.content_hash);
    const Environment flat{.width = 4, .height = 3, .radiance = {12, glm::vec3(0.25f, 1.0f, 3.0f)}};
    EXPECT_NEAR(facts_of(flat).mean.z, 3.0f, 1e-6f);
}

TEST(KeptEnvironment, gives_the_small_picture_that_decoding_gives) {
    const Environment environment = lamp_sky();
    const Image decoded = small_panorama(environment, 16);
    const Image kept = small_panorama(make_panorama_levels(environment), 16);
    ASSERT_EQ(kept.bytes.size(), decoded.bytes.size());
    for (std::size_t i = 0; i < decoded.bytes.size(); ++i)
        EXPECT_NEAR(int(kept.bytes[i]), int(decoded.bytes[i]), 1) << i;
}

TEST(KeptEnvironment, refuses_a_file_cut_anywhere_or_longer) {
    const Kept kept;
    const std::vector<char> whole = kept.bytes();
    for (std::size_t length = 0; length < whole.size(); length += length < 200 ? 1 : 997) {
        kept.write({whole.begin(), whole.begin() + std::ptrdiff_t(length)});
        EXPECT_FALSE(load_kept(kept.cache, kKey)) << length;
    }
    std::vector<char> longer = whole;
    longer.push_back(0);
    kept.write(longer);
    EXPECT_FALSE(load_kept(kept.cache, kKey));
    kept.write(whole);
    EXPECT_TRUE(load_kept(kept.cache, kKey));
}

TEST(KeptEnvironment, refuses_a_file_with_any_bit_flipped) {
    const Kept kept;
    const std::vector<char> whole = kept.bytes();
    for (std::size_t i = 0; i < whole.size(); i += i < 300 ? 1 : 13) {
        std::vector<char> damaged = whole;
        damaged[i] = char(damaged[i] ^ (1 << (i % 8)));
        kept.write(damaged);
        EXPECT_FALSE(load_kept(kept.cache, kKey)) << "byte " << i;
    }
}

TEST(KeptEnvironment, is_not_mistaken_for_baked_light_nor_for_another_one) {
    const Kept kept;
    EXPECT_FALSE(load_baked(kept.cache, kKey));
    const std::string other(32, 'b');
    const fs::path file = kept.file();
    fs::copy_file(file, kept.folder.path() / (other + file.extension().string()));
    EXPECT_FALSE(load_kept(kept.cache, other));
    fs::copy_file(file, kept.folder.path() / (kKey + ".patina-ibl"));
    EXPECT_FALSE(load_baked(kept.cache, kKey));
    EXPECT_TRUE(load_kept(kept.cache, kKey));
}

TEST(KeptEnvironment, is_known_by_its_name_and_contents) {
    EXPECT_EQ(kept_key("a.hdr", 1), kept_key("a.hdr", 1));
    EXPECT_NE(kept_key("a.hdr", 1), kept_key("a.hdr", 2));
    EXPECT_NE(kept_key("a.hdr", 1), kept_key("b.hdr", 1));
    EXPECT_EQ(kept_key("a.hdr", 1).size(), 32u);
}

TEST(KeptEnvironment, says_so_when_it_cannot_be_kept) {
    const Environment environment = lamp_sky();
    const EnvironmentFacts facts = facts_of(environment);
    const PanoramaLevels panorama = make_panorama_levels(environment);
    const TemporaryFolder folder("patina-kept");
    std::ofstream(folder.path() / "file") << "x";
    const BakeCache in_the_way{.folder = folder.path() / "file" / "below"};
    EXPECT_NE(save_kept(in_the_way, kKey, facts, panorama).find("could not be kept"), std::string::npos);
    // All of it would fit, but not into a quarter.
    const BakeCache tiny{.folder = folder.path() / "tiny", .max_bytes = 40000};
    EXPECT_NE(save_kept(tiny, kKey, facts, panorama).find("too large"), std::string::npos);
    EXPECT_FALSE(fs::exists(tiny.folder));
}

TEST(KeptEnvironment, shares_the_room_with_baked_light) {
    Kept kept;
    const std::uint64_t bytes = fs::file_size(kept.file());
    const auto now = fs::file_time_type::clock::now();
    BakedEnvironment baked;
    baked.irradiance = {1, std::vector<glm::vec3>(6)};
    save_baked(kept.cache, kKey, baked);
    for (const auto& entry : fs::directory_iterator(kept.folder.path()))
        fs::last_write_time(entry, now - std::chrono::hours(entry.path() == kept.file() ? 2 : 3));
    ASSERT_TRUE(load_baked(kept.cache, kKey));  // used now, so the panorama is the oldest
    kept.cache.max_bytes = bytes + 100;
    save_baked(kept.cache, std::string(32, 'c'), baked);
    EXPECT_FALSE(load_kept(kept.cache, kKey));
    EXPECT_TRUE(load_baked(kept.cache, kKey));
}

}  // namespace
}  // namespace patina
