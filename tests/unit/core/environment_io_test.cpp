#include "renderer/core/environment_io.h"

#include "tests/unit/core/image_test_support.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace patina {
namespace {

namespace fs = std::filesystem;
using test::bytes_of;
using test::contains;
using test::gradient;
using test::TempFolder;

TEST(EnvironmentIo, file_becomes_an_environment_named_after_it) {
    const TempFolder folder;
    Image image = gradient(8, 4, 3, PixelType::F32);
    save_image(folder / "sunny day.exr", image);
    const Environment environment = load_environment_file(folder / "sunny day.exr");
    EXPECT_EQ(environment.title, "sunny day");
    EXPECT_EQ(environment.id, path_text(folder / "sunny day.exr"));
    EXPECT_EQ(environment.radiance[9].y, texel(image, 1, 1, 1));
    EXPECT_EQ(environment.content_hash, make_environment(image, "", "").content_hash);
    EXPECT_TRUE(environment.notes.empty());
}

TEST(EnvironmentIo, broken_pixels_of_a_file_are_repaired_and_counted) {
    const TempFolder folder;
    Image image = gradient(8, 4, 1, PixelType::F32);
    const float largest = 80.0f;
    set_texel(image, 7, 3, 0, largest);
    set_texel(image, 2, 2, 0, std::numeric_limits<float>::quiet_NaN());
    set_texel(image, 3, 2, 0, -4.0f);
    set_texel(image, 4, 2, 0, std::numeric_limits<float>::infinity());
    save_image(folder / "broken.exr", image);
    const Environment environment = load_environment_file(folder / "broken.exr");
    EXPECT_EQ(environment.notes.size(), 3u);
    EXPECT_EQ(environment.radiance[8 * 2 + 2], glm::vec3(0.0f));
    EXPECT_EQ(environment.radiance[8 * 2 + 3], glm::vec3(0.0f));
    EXPECT_EQ(environment.radiance[8 * 2 + 4], glm::vec3(largest));
}

TEST(EnvironmentIo, notes_of_the_picture_come_along) {
    const TempFolder folder;
    save_image(folder / "a.exr", gradient(8, 4, 3, PixelType::F32));
    fs::rename(folder / "a.exr", folder / "a.hdr");
    const Environment environment = load_environment_file(folder / "a.hdr");
    ASSERT_EQ(environment.notes.size(), 1u);
    EXPECT_TRUE(contains(environment.notes[0], "in spite of its name"));
}

TEST(EnvironmentIo, missing_file_is_an_error_that_names_it) {
    const TempFolder folder;
    try {
        load_environment_file(folder / "none.hdr");
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_TRUE(contains(error.what(), "none.hdr"));
    }
}

TEST(EnvironmentIo, lists_blenders_panoramas_by_name_without_opening_them) {
    const TempFolder folder;
    const auto put = [&](const char* where) {
        fs::create_directories((folder / where).parent_path());
        write_file(folder / where, bytes_of("not a picture"));
    };
    put("debian/datafiles/studiolights/world/city.exr");
    put("debian/datafiles/studiolights/world/night.exr");
    put("debian/datafiles/studiolights/world/license.txt");
    put("debian/datafiles/studiolights/matcap/clay.exr");
    put("windows/Blender 3.4/3.4/datafiles/studiolights/world/forest.exr");
    put("mac/4.1/datafiles/studiolights/world/city.exr");
    const std::array<fs::path, 4> folders{folder / "debian", folder / "missing", folder / "windows",
                                          folder / "mac"};
    const std::vector<EnvironmentFile> found = list_blender_studio_lights(folders);
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(found[0].id, "blender-city");
    EXPECT_EQ(found[0].title, "City (Blender)");
    EXPECT_EQ(found[0].file, folder / "debian/datafiles/studiolights/world/city.exr");
    EXPECT_EQ(found[1].id, "blender-forest");
    EXPECT_EQ(found[2].id, "blender-night");
}

TEST(EnvironmentIo, looking_for_blender_where_there_is_none_finds_nothing) {
    EXPECT_TRUE(list_blender_studio_lights(std::span<const fs::path>()).empty());
    for (const EnvironmentFile& light : list_blender_studio_lights()) EXPECT_TRUE(fs::exists(light.file));
}

}  // namespace
}  // namespace patina
