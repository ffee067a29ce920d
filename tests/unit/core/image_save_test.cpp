// What becomes of the old picture, links and leftovers when a picture is saved.
#include "renderer/core/image_io.h"
#include "tests/unit/core/image_test_support.h"

#include <gtest/gtest.h>

#ifdef __linux__
#include <csignal>
#include <sys/resource.h>
#endif

namespace patina {
namespace {

namespace fs = std::filesystem;
using test::bytes_of;
using test::contains;
using test::expect_equal;
using test::gradient;
using test::TempFolder;

TEST(ImageIo, refuses_to_save_what_the_format_cannot_hold) {
    const TempFolder folder;
    EXPECT_THROW(save_image(folder / "a.png", gradient(2, 2, 3, PixelType::F32)), std::runtime_error);
    EXPECT_THROW(save_image(folder / "a.exr", gradient(2, 2, 3, PixelType::U8)), std::runtime_error);
    EXPECT_THROW(save_image(folder / "a.jpg", gradient(2, 2, 3, PixelType::U8)), std::runtime_error);
    EXPECT_THROW(save_image(folder / "a", gradient(2, 2, 3, PixelType::U8)), std::runtime_error);
    EXPECT_THROW(save_image(folder / "a.png", Image{}), std::runtime_error);
    EXPECT_EQ(folder.files(), 0u);
}

TEST(ImageIo, saving_into_a_missing_folder_or_onto_a_folder_fails_and_leaves_nothing) {
    const TempFolder folder;
    EXPECT_THROW(save_image(folder / "missing" / "a.png", gradient(2, 2, 3, PixelType::U8)),
                 std::runtime_error);
    fs::create_directory(folder / "folder.png");
    EXPECT_THROW(save_image(folder / "folder.png", gradient(2, 2, 3, PixelType::U8)), std::runtime_error);
    EXPECT_EQ(folder.files(), 1u);
}

TEST(ImageIo, saving_replaces_the_old_picture_and_leaves_no_temporary_file) {
    const TempFolder folder;
    write_file(folder / "a.png", bytes_of("old"));
    save_image(folder / "a.png", gradient(2, 2, 3, PixelType::U8));
    expect_equal(load_image(folder / "a.png").image, gradient(2, 2, 3, PixelType::U8));
    EXPECT_EQ(folder.files(), 1u);
}

#ifdef __linux__
TEST(ImageIo, saving_through_a_link_writes_where_it_leads) {
    const TempFolder folder;
    const Image picture = gradient(2, 2, 3, PixelType::U8);
    write_file(folder / "a.png", bytes_of("old"));
    fs::create_symlink("a.png", folder / "link.png");
    fs::create_symlink("link.png", folder / "second.png");
    save_image(folder / "second.png", picture);
    EXPECT_TRUE(fs::is_symlink(folder / "second.png") && fs::is_symlink(folder / "link.png"));
    expect_equal(load_image(folder / "a.png").image, picture);
    fs::create_symlink("round.png", folder / "circle.png");
    fs::create_symlink("circle.png", folder / "round.png");
    EXPECT_THROW(save_image(folder / "round.png", picture), std::runtime_error);
    fs::create_symlink("/dev/full", folder / "full.png");
    EXPECT_THROW(save_image(folder / "full.png", picture), std::runtime_error);
    EXPECT_TRUE(fs::is_symlink(folder / "full.png"));
}

TEST(ImageIo, a_name_may_be_as_long_as_the_disk_allows) {
    const TempFolder folder;
    save_image(folder / (std::string(251, 'n') + ".png"), gradient(2, 2, 3, PixelType::U8));
    EXPECT_EQ(folder.files(), 1u);
}

/// While it lives, files end after a few bytes, as on a full disk.
class TinyDisk {
public:
    TinyDisk() {
        getrlimit(RLIMIT_FSIZE, &before_);
        rlimit tiny = before_;
        tiny.rlim_cur = 100;
        setrlimit(RLIMIT_FSIZE, &tiny);
        std::signal(SIGXFSZ, SIG_IGN);  // NOLINT(cert-err33-c)
    }
    ~TinyDisk() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, SIG_DFL);  // NOLINT(cert-err33-c)
    }
    TinyDisk(const TinyDisk&) = delete;
    TinyDisk& operator=(const TinyDisk&) = delete;
    TinyDisk(TinyDisk&&) = delete;
    TinyDisk& operator=(TinyDisk&&) = delete;

private:
    rlimit before_{};
};

TEST(ImageIo, a_full_disk_is_an_error_that_leaves_the_old_picture_and_nothing_else) {
    const TempFolder folder;
    const Image old = gradient(2, 2, 3, PixelType::U8);
    save_image(folder / "a.png", old);
    std::string message;
    {
        const TinyDisk disk;
        try {
            save_image(folder / "a.png", gradient(64, 64, 3, PixelType::U8));
        } catch (const std::runtime_error& error) {
            message = error.what();
        }
    }
    EXPECT_TRUE(contains(message, "free some space")) << message;
    expect_equal(load_image(folder / "a.png").image, old);
    EXPECT_EQ(folder.files(), 1u);
}
#endif

}  // namespace
}  // namespace patina
