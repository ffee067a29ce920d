// The comparison file: what is written comes back, what is wrong is said with its place, and the schema
// agrees.
#include "app/comparison_file.h"

#include "app/paths.h"
#include "materials/text_io.h"
#include "tests/unit/materials/schema_validator.h"
#include "tests/unit/materials/temporary_folder.h"

#include <gtest/gtest.h>

namespace patina {
namespace {

namespace fs = std::filesystem;

Comparison everything() {
    Comparison c;
    c.title = "Rust, twice \"quoted\"";
    c.author = "Ada";
    c.remarks = "Line one\nline two";
    c.mesh = "quad";
    c.camera = {
        .yaw_deg = 12.5f, .pitch_deg = -3.0f, .distance = 5.25f, .fov_deg = 40.0f, .target = {0, 0.1f, 0}};
    c.shading = Shading::Course;
    c.rows = {{.preset = "gold"}, {.preset = "-", .title = "Nothing"}, {}};
    Photo photo{.file = "shots/a.jpg", .title = "Desk"};
    photo.fit = PhotoFit{.photo = {glm::vec2{0.1f, 0.2f}, {0.9f, 0.15f}, {0.95f, 0.9f}, {0.05f, 0.8f}},
                         .view = {glm::vec2{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    photo.exposure_ev = 0.3f;
    photo.white_balance = {1.1f, 1.0f, 0.8f};
    photo.region = Region{0.2f, 0.3f, 0.7f, 0.8f};
    photo.opacity = 0.5f;
    c.columns = {{.environment = "studio"},
                 {.title = "Evening",
                  .environment = "sunset",
                  .rotation_deg = -90.0f,
                  .exposure_ev = 1.5f,
                  .tonemap = Tonemap::None,
                  .background = Background::Plain,
                  .plain_color = {0.1f, 0.2f, 0.3f},
                  .camera = Camera{.yaw_deg = -40.0f, .distance = 3.0f},
                  .shading = Shading::Course,
                  .photo = photo}};
    c.views = {{{.preset = "copper", .title = "Own"}, {.title = "Its light", .environment = "night"}}};
    return c;
}

SchemaValidator schema() {
    return SchemaValidator(nlohmann::json::parse(
        read_file(fs::path(PATINA_SOURCE_DIR) / "materials" / "presets" / std::string(kComparisonSchema))));
}

std::string failure(const std::string& text) {
    return failure_of([&] { parse_comparison(text, "s.json"); });
}
constexpr const char* kGrid = R"("rows": [{}], "columns": [{}])";

TEST(ComparisonFile, gives_back_what_was_written) {
    const Comparison c = everything();
    const LoadedComparison back = parse_comparison(to_json(c), "s.json");
    EXPECT_EQ(back.comparison, c);
    EXPECT_TRUE(back.notes.empty()) << back.notes.front();
    EXPECT_EQ(to_json(back.comparison), to_json(c));
}

TEST(ComparisonFile, satisfies_its_schema) {
    const auto problems = schema().problems_of(nlohmann::json::parse(to_json(everything())));
    EXPECT_TRUE(problems.empty()) << problems.front();
    EXPECT_FALSE(
        schema().problems_of(nlohmann::json::parse(R"({"columns": [{"exposure_ev": 99}]})")).empty());
}

TEST(ComparisonFile, every_key_it_writes_is_in_the_schema) {
    const nlohmann::json written = nlohmann::json::parse(to_json(everything()));
    const nlohmann::json text = nlohmann::json::parse(
        read_file(fs::path(PATINA_SOURCE_DIR) / "materials" / "presets" / std::string(kComparisonSchema)));
    const auto expect_known = [](const nlohmann::json& object, const nlohmann::json& properties) {
        for (const auto& [key, value] : object.items()) EXPECT_TRUE(properties.contains(key)) << key;
    };
    expect_known(written, text["properties"]);
    expect_known(written["camera"], text["$defs"]["camera"]["properties"]);
    expect_known(written["columns"][1]["camera"], text["$defs"]["camera"]["properties"]);
    expect_known(written["columns"][1], text["$defs"]["lighting"]["properties"]);
    expect_known(written["columns"][1]["photo"], text["$defs"]["photo"]["properties"]);
    for (const auto& row : kTonemaps)
        EXPECT_TRUE(std::ranges::count(text["$defs"]["lighting"]["properties"]["tonemap"]["enum"], row.id));
    for (const auto& row : kBackgrounds)
        EXPECT_TRUE(
            std::ranges::count(text["$defs"]["lighting"]["properties"]["background"]["enum"], row.id));
}

TEST(ComparisonFile, keeps_keys_of_a_newer_version_where_they_stood) {
    const std::string text = R"({"future": [1], "rows": [{"preset": "gold", "x": 1}],
        "columns": [{"environment": "sky", "y": {"z": 2}, "photo": {"file": "a.png", "w": true}}]})";
    const LoadedComparison loaded = parse_comparison(text, "s.json");
    EXPECT_EQ(loaded.notes.size(), 4u);
    const nlohmann::json saved = nlohmann::json::parse(to_json(loaded.comparison));
    EXPECT_EQ(saved["future"][0], 1);
    EXPECT_EQ(saved["rows"][0]["x"], 1);
    EXPECT_EQ(saved["columns"][0]["y"]["z"], 2);
    EXPECT_EQ(saved["columns"][0]["photo"]["w"], true);
}

TEST(ComparisonFile, says_file_line_and_place_of_what_is_wrong) {
    EXPECT_TRUE(failure("{\n  \"rows\": [{}],\n  \"columns\": [{\"tonemap\": \"loud\"}]\n}")
                    .starts_with("s.json:3:27: /columns/0/tonemap is 'loud'; it must be 'none' or 'neutral'"))
        << failure("{\n  \"rows\": [{}],\n  \"columns\": [{\"tonemap\": \"loud\"}]\n}");
    EXPECT_NE(failure(R"({"rows": 3})").find("/rows is a number"), std::string::npos);
    EXPECT_NE(failure(R"({"rows": [3], "columns": [{}]})").find("/rows/0 is a number"), std::string::npos);
    EXPECT_NE(failure(R"({"rows": [{}]})").find("no columns"), std::string::npos);
    EXPECT_NE(failure("{}").find("nothing to compare"), std::string::npos);
    for (const char* reference : {R"({"shading": "reference", "rows": [{}], "columns": [{}]})",
                                  R"({"rows": [{}], "columns": [{"shading": "reference"}]})"})
        EXPECT_NE(failure(reference).find("shading is 'reference'; it must be 'course' or"),
                  std::string::npos);
    EXPECT_NE(failure("[]").find("must be an object"), std::string::npos);
    EXPECT_NE(failure("{\"rows\": [").find("s.json:1:"), std::string::npos);
    EXPECT_NE(failure(R"({"$schema": "patina-material-1.schema.json", "rows": [{}], "columns": [{}]})")
                  .find("not that of a Patina comparison"),
              std::string::npos);
    EXPECT_NE(
        failure(R"({"rows": [{}], "columns": [{"photo": {}}]})").find("/columns/0/photo/file is missing"),
        std::string::npos);
    EXPECT_NE(failure(R"({"rows": [{}], "columns": [{"photo": {"file": "a", "region": [[1, 1], [0, 0]]}}]})")
                  .find("region is empty"),
              std::string::npos);
}

TEST(ComparisonFile, clamps_numbers_with_a_note) {
    const LoadedComparison loaded =
        parse_comparison(R"({"rows": [{}], "columns": [{"exposure_ev": 99}]})", "s.json");
    EXPECT_EQ(loaded.comparison.columns[0].exposure_ev, 30.0f);
    ASSERT_EQ(loaded.notes.size(), 1u);
    EXPECT_NE(loaded.notes[0].find("taken as 30"), std::string::npos);
}

TEST(ComparisonFile, a_newer_version_is_read_with_a_note) {
    const LoadedComparison loaded = parse_comparison(
        std::string(R"({"$schema": "patina-comparison-7.schema.json", )") + kGrid + "}", "s.json");
    ASSERT_EQ(loaded.notes.size(), 1u);
    EXPECT_NE(loaded.notes[0].find("version 7"), std::string::npos);
}

TEST(ComparisonFile, files_are_written_relative_and_shipped_presets_by_name) {
    const TemporaryFolder folder;
    fs::create_directories(folder / "shots");
    Comparison c = everything();
    c.rows = {{.preset = path_to_utf8(share_folder() / "presets" / "gold.json")},
              {.preset = path_to_utf8(folder.path() / "mine.json")},
              {.preset = std::string(kEditedPreset)}};
    c.columns[1].photo->file = path_to_utf8(folder.path() / "shots" / "a.jpg");
    const fs::path file = folder / "s.json";
    save_comparison(file, c);
    const nlohmann::json written = nlohmann::json::parse(read_file(file));
    EXPECT_EQ(written["rows"][0]["preset"], "gold");
    EXPECT_EQ(written["rows"][1]["preset"], "mine.json");
    EXPECT_EQ(written["rows"][2]["preset"], "edited");
    EXPECT_EQ(written["columns"][0]["environment"], "studio");
    EXPECT_EQ(written["columns"][1]["photo"]["file"], "shots/a.jpg");
    const Comparison back = load_comparison(file).comparison;
    EXPECT_EQ(utf8_to_path(back.rows[1].preset), (folder / "mine.json").lexically_normal());
    EXPECT_EQ(back.rows[0].preset, "gold");
    EXPECT_EQ(back.columns[0].environment, "studio");
    EXPECT_EQ(utf8_to_path(back.columns[1].photo->file), (folder / "shots/a.jpg").lexically_normal());
    EXPECT_EQ(folder.count(), 2u);  // no temporary file is left
}

TEST(ComparisonFile, is_told_from_a_preset) {
    const TemporaryFolder folder;
    save_comparison(folder / "s.json", everything());
    write_file(folder / "p.json", R"({"name": "Plain"})");
    write_file(folder / "broken.json", "{");
    write_file(folder / "bare.json", std::string("{") + kGrid + "}");
    EXPECT_TRUE(is_comparison_file(folder / "s.json"));
    EXPECT_TRUE(is_comparison_file(folder / "bare.json"));
    EXPECT_FALSE(is_comparison_file(folder / "p.json"));
    EXPECT_FALSE(is_comparison_file(folder / "broken.json"));
    EXPECT_FALSE(is_comparison_file(folder / "none.json"));
}

}  // namespace
}  // namespace patina
