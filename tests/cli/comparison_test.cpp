// Comparison files on the command line: sheets with photos, reports, and what is said when something is
// wrong.
#include "renderer/core/image_io.h"
#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace patina {
namespace {

using test::Outcome;
using test::Workspace;

constexpr const char* kSheet = R"({"title": "Two <metals>", "author": "Ada",
    "rows": [{"preset": "gold"}, {"preset": "mine.json"}],
    "columns": [{"environment": "furnace", "tonemap": "none",
                 "photo": {"file": "shot.png", "region": [[0.4, 0.4], [0.6, 0.6]]}},
                {"environment": "furnace", "exposure_ev": -1}],
    "views": [{"preset": "-", "environment": "furnace", "title": "Alone"}]})";

void write_sheet(const Workspace& work) {
    work.write("sheet.json", kSheet);
    work.write("mine.json", R"({"name": "Mine", "albedo": {"value": [0.5, 0.5, 0.5]}})");
    // The photo is what the first view shows, so nothing differs there.
    const Outcome shot = work.run(
        {"render", "gold", "-o", "shot.png", "--size", "48x48", "--env", "furnace", "--tonemap", "none"});
    ASSERT_EQ(shot.exit_status, 0) << shot.errors;
}

TEST(CompareFile, draws_rows_columns_photos_and_further_views) {
    const Workspace work;
    write_sheet(work);
    const Outcome outcome = work.run({"compare", "sheet.json", "-o", "sheet.png", "--size", "48x48"});
    ASSERT_EQ(outcome.exit_status, 0) << outcome.errors;
    const Image sheet = load_image(work.path("sheet.png")).image;
    // Four columns (view, photo, difference, view) of 48 and gaps of 4; three rows with titles, and the
    // legend.
    EXPECT_EQ(sheet.width, 4 + 4 * (48 + 4));
    EXPECT_EQ(sheet.height, 4 + 16 + 3 * (48 + 16 + 4) + 16);
    const auto middle = [&](int column, int row) {
        return texel(sheet, 4 + column * 52 + 24, 4 + 16 + row * 68 + 16 + 24, 1);
    };
    EXPECT_NEAR(middle(0, 0), middle(1, 0), 0.02f) << "the photo is the render";
    EXPECT_LT(middle(2, 0), 0.05f) << "so their difference is black";
    EXPECT_GT(middle(2, 1) + texel(sheet, 4 + 2 * 52 + 24, 4 + 16 + 68 + 16 + 24, 0), 0.2f)
        << "grey is not gold";
    EXPECT_LT(middle(3, 0), middle(0, 0) - 0.1f) << "a stop darker";
}

TEST(CompareFile, takes_only_the_size_besides) {
    const Workspace work;
    work.write("sheet.json", kSheet);
    const Outcome outcome = work.run({"compare", "sheet.json", "-o", "sheet.png", "--env", "sky"});
    EXPECT_EQ(outcome.exit_status, 1);
    EXPECT_NE(outcome.errors.find("sheet.json: a comparison file sets"), std::string::npos) << outcome.errors;
    EXPECT_EQ(work.files(), std::vector<std::string>{"sheet.json"});
}

TEST(CompareFile, a_missing_photo_is_named) {
    const Workspace work;
    work.write(
        "sheet.json",
        R"({"rows": [{"preset": "-"}], "columns": [{"environment": "furnace", "photo": {"file": "no.jpg"}}]})");
    const Outcome outcome = work.run({"compare", "sheet.json", "-o", "sheet.png", "--size", "32x32"});
    EXPECT_EQ(outcome.exit_status, 1);
    EXPECT_NE(outcome.errors.find("no.jpg"), std::string::npos) << outcome.errors;
    EXPECT_EQ(work.files(), std::vector<std::string>{"sheet.json"});
}

TEST(CompareFile, the_edited_preset_is_the_editors_alone) {
    const Workspace work;
    work.write("sheet.json", R"({"rows": [{"preset": "edited"}], "columns": [{"environment": "furnace"}]})");
    const Outcome outcome = work.run({"compare", "sheet.json", "-o", "sheet.png", "--size", "32x32"});
    EXPECT_EQ(outcome.exit_status, 1);
    EXPECT_NE(outcome.errors.find("being edited"), std::string::npos) << outcome.errors;
}

TEST(ReportCommand, writes_a_page_and_a_pdf) {
    const Workspace work;
    write_sheet(work);
    const Outcome page = work.run({"report", "sheet.json", "-o", "r.html", "--size", "48", "--no-hints"});
    ASSERT_EQ(page.exit_status, 0) << page.errors;
    const std::string html = work.read("r.html");
    EXPECT_NE(html.find("<h1>Two &lt;metals&gt;</h1>"), std::string::npos);
    for (const char* text :
         {"Ada", "Alone", "Material: Gold", "Against the photos", "patina report sheet.json -o r.html",
          "patina render gold --mesh sphere --env furnace"})
        EXPECT_NE(html.find(text), std::string::npos) << text;
    const Outcome document =
        work.run({"report", "sheet.json", "-o", "r.pdf", "--size", "48", "--no-hints", "--stats", "s.json"});
    ASSERT_EQ(document.exit_status, 0) << document.errors;
    EXPECT_NE(work.read("s.json").find("\"views_drawn\""), std::string::npos);
    EXPECT_TRUE(work.read("r.pdf").starts_with("%PDF-"));
}

TEST(ReportCommand, credits_whom_an_environments_file_names) {
    const Workspace work;
    Image image = make_image(8, 4, 3, PixelType::F32);
    for (int i = 0; i < 8 * 4 * 3; ++i) set_texel(image, i / 3 % 8, i / 24, i % 3, 0.5f);
    save_image(work.path("court.exr"), image, {{"owner", "Ada Lovelace"}});
    work.write("sheet.json", R"({"rows": [{"preset": "-"}], "columns": [{"environment": "court.exr"}]})");
    const Outcome page = work.run({"report", "sheet.json", "-o", "r.html", "--size", "32", "--no-hints"});
    ASSERT_EQ(page.exit_status, 0) << page.errors;
    EXPECT_NE(work.read("r.html").find("8×4 pixels; Ada Lovelace"), std::string::npos);
}

TEST(ReportCommand, says_what_it_can_write_before_it_works) {
    const Workspace work;
    work.write("sheet.json", kSheet);
    const Outcome outcome = work.run({"report", "sheet.json", "-o", "r.doc"});
    EXPECT_EQ(outcome.exit_status, 1);
    EXPECT_NE(outcome.errors.find(".html or .pdf"), std::string::npos) << outcome.errors;
    EXPECT_EQ(work.run({"report", "sheet.json"}).exit_status, 2);
}

TEST(Turntable, draws_a_whole_turn_in_numbered_pictures) {
    const Workspace work;
    const Outcome outcome = work.run({"render", "-", "-o", "turn.png", "--size", "32x32", "--env", "test",
                                      "--turntable", "4", "--turn", "light", "--tonemap", "none"});
    ASSERT_EQ(outcome.exit_status, 0) << outcome.errors;
    EXPECT_EQ(work.files(),
              (std::vector<std::string>{"turn-001.png", "turn-002.png", "turn-003.png", "turn-004.png"}));
    ASSERT_EQ(work.run({"render", "-", "-o", "half.png", "--size", "32x32", "--env", "test", "--env-rotation",
                        "180", "--tonemap", "none"})
                  .exit_status,
              0);
    const Image third = load_image(work.path("turn-003.png")).image,
                half = load_image(work.path("half.png")).image;
    EXPECT_EQ(third.bytes, half.bytes);
    EXPECT_NE(third.bytes, load_image(work.path("turn-001.png")).image.bytes);
}

bool ffmpeg_is_installed() { return std::system("ffmpeg -version > /dev/null 2>&1") == 0; }

TEST(Turntable, becomes_a_video_and_goes_on_where_it_was_ended) {
    if (!ffmpeg_is_installed()) GTEST_SKIP() << "ffmpeg is not installed: no video can be joined here";
    const Workspace work;
    const std::vector<std::string> turn{"--size", "32x32", "--env", "furnace", "--turntable", "3"};
    const auto run = [&](const char* output, const std::vector<std::string>& more) {
        std::vector<std::string> words{"render", "-", "-o", output};
        words.insert(words.end(), turn.begin(), turn.end());
        words.insert(words.end(), more.begin(), more.end());
        return work.run(words);
    };
    const Outcome first = run("turn.mp4", {});
    ASSERT_EQ(first.exit_status, 0) << first.errors;
    EXPECT_EQ(work.files(), std::vector<std::string>{"turn.mp4"}) << "no frames are left";
    EXPECT_EQ(work.read("turn.mp4").substr(4, 4), "ftyp");
    // Frames that an ended run has left are taken over, and none of a longer one comes into the video.
    std::filesystem::create_directories(work.path("again.mp4.frames"));
    ASSERT_EQ(run("again.mp4.frames/frame.png", {"--up-to-date"}).exit_status, 0);
    std::filesystem::copy_file(work.path("again.mp4.frames/frame-003.png"),
                               work.path("again.mp4.frames/frame-004.png"));
    const Outcome again = run("again.mp4", {});
    ASSERT_EQ(again.exit_status, 0) << again.errors;
    EXPECT_NE(again.errors.find("is up to date"), std::string::npos) << again.errors;
    EXPECT_EQ(work.read("again.mp4"), work.read("turn.mp4"));
}

TEST(Turntable, says_so_where_no_video_can_be_made) {
    const Workspace work;
    const std::string path = std::getenv("PATH") ? std::getenv("PATH") : "";
    ::setenv("PATH", work.folder().c_str(), 1);
    const Outcome outcome = work.run(
        {"render", "-", "-o", "turn.mp4", "--size", "16x16", "--env", "furnace", "--turntable", "2"});
    ::setenv("PATH", path.c_str(), 1);
    EXPECT_EQ(outcome.exit_status, 1);
    EXPECT_NE(outcome.errors.find("needs ffmpeg"), std::string::npos) << outcome.errors;
    EXPECT_TRUE(work.files().empty());
}

TEST(UpToDate, pictures_are_made_again_only_when_something_in_them_changed) {
    const Workspace work;
    work.write("mine.json", R"({"name": "Mine", "albedo": {"value": [0.5, 0.5, 0.5]}})");
    const std::vector<std::string> command{"render", "mine.json", "-o",      "a.png",       "--size",
                                           "16x16",  "--env",     "furnace", "--up-to-date"};
    const auto says_up_to_date = [&](std::vector<std::string> words) {
        const Outcome outcome = work.run(words);
        EXPECT_EQ(outcome.exit_status, 0) << outcome.errors;
        return outcome.errors.find("is up to date") != std::string::npos;
    };
    EXPECT_FALSE(says_up_to_date(command));
    const std::string first = work.read("a.png");
    EXPECT_TRUE(says_up_to_date(command));
    EXPECT_EQ(work.read("a.png"), first);
    std::vector<std::string> brighter = command;
    brighter.insert(brighter.end(), {"--exposure", "1"});
    EXPECT_FALSE(says_up_to_date(brighter));
    EXPECT_FALSE(says_up_to_date(command)) << "it is the brighter one now";
    work.write("mine.json", R"({"name": "Mine", "albedo": {"value": [0.5, 0.5, 0.6]}})");
    EXPECT_FALSE(says_up_to_date(command));
    work.write("a.png", "damaged");
    EXPECT_FALSE(says_up_to_date(command));
}

TEST(UpToDate, the_recipe_for_many_pictures_makes_each_once) {
    const Workspace work;
    for (const char* name : {"one", "two"})
        work.write(std::string(name) + ".json", std::string("{\"name\": \"") + name + "\"}");
    const std::string command = "cd '" + work.folder().string() +
                                "' && PATINA_CACHE_DIR=.cache JOBS=2 PATINA='" PATINA_PROGRAM
                                "' OPTIONS='--size 16x16' sh '" PATINA_SOURCE_DIR
                                "/docs/many.sh' out 'furnace test' one.json two.json 2> said.txt";
    ASSERT_EQ(std::system(command.c_str()), 0) << work.read("said.txt");
    for (const char* file :
         {"out/one-furnace.png", "out/one-test.png", "out/two-furnace.png", "out/two-test.png"})
        EXPECT_FALSE(work.read(file).empty()) << file;
    ASSERT_EQ(std::system(command.c_str()), 0);
    const std::string said = work.read("said.txt");
    std::size_t kept = 0;
    for (std::size_t at = said.find("is up to date"); at != std::string::npos;
         at = said.find("is up to date", at + 1))
        ++kept;
    EXPECT_EQ(kept, 4u) << said;
}

TEST(ReportCommand, says_on_request_how_far_the_shading_is_from_the_reference) {
    const Workspace work;
    work.write("one.json", R"({"rows": [{"preset": "gold"}], "columns": [{"environment": "studio"}]})");
    const Outcome outcome =
        work.run({"report", "one.json", "-o", "r.html", "--size", "48", "--no-hints", "--reference", "16"});
    ASSERT_EQ(outcome.exit_status, 0) << outcome.errors;
    const std::string page = work.read("r.html");
    const std::size_t at = page.find("Against the reference");
    ASSERT_NE(at, std::string::npos);
    const std::string section = page.substr(at, 1500);
    EXPECT_NE(section.find("16 points a pixel"), std::string::npos);
    EXPECT_EQ(section.find(">0.00 %<"), std::string::npos) << "nothing is known to the last digit";
}

}  // namespace
}  // namespace patina
