#include "materials/material_io.h"

#include "materials/params.h"
#include "materials/text_io.h"
#include "tests/unit/materials/temporary_folder.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>
#include <limits>

namespace patina {

namespace fs = std::filesystem;

namespace {

LoadedMaterial parsed(std::string_view text) { return parse_material(text, "m.json"); }
std::string refusal(std::string_view text) {
    return failure_of([&] { parsed(text); });
}
bool mentions(const std::vector<std::string>& notes, std::string_view text) {
    return std::any_of(notes.begin(), notes.end(),
                       [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

constexpr std::string_view kRustedIron = R"({
  "$schema": "patina-material-1.schema.json",
  "name": "Rusted iron",
  "source": "Measured on a gate",
  "albedo":    { "value": [1, 1, 1], "map": "rust_albedo.png", "color_space": "srgb" },
  "roughness": { "value": 0.25, "map": "rust_orm.png", "channel": "g", "invert": true },
  "metallic":  { "value": 1.0, "map": "rust_orm.png", "channel": "b" },
  "ao":        { "value": 0.5, "map": "rust_orm.png", "channel": "r" },
  "normal":    { "value": 1.5, "map": "rust_nor_dx.png", "convention": "directx" },
  "emission":  { "value": [0, 12.5, 0], "map": "glow.exr", "color_space": "linear" },
  "uv":        { "scale": [2, 3], "offset": [0.5, -0.25], "rotation_deg": 90 }
})";

}  // namespace

TEST(MaterialIo, reads_every_key_of_version_1) {
    const auto [material, notes] = parsed(kRustedIron);
    EXPECT_TRUE(notes.empty()) << notes[0];
    Material expected;
    expected.name = "Rusted iron";
    expected.source = "Measured on a gate";
    expected.albedo = {{1, 1, 1}, "rust_albedo.png", ColorSpace::Srgb};
    expected.roughness = {0.25f, "rust_orm.png", Channel::G, true};
    expected.metallic = {1.0f, "rust_orm.png", Channel::B, false};
    expected.ao = {0.5f, "rust_orm.png", Channel::R, false};
    expected.normal = {1.5f, "rust_nor_dx.png", NormalConvention::DirectX};
    expected.emission = {{0, 12.5f, 0}, "glow.exr", ColorSpace::Linear};
    expected.uv = {{2, 3}, {0.5f, -0.25f}, 90.0f};
    EXPECT_EQ(material, expected);
}

TEST(MaterialIo, absent_keys_mean_defaults) {
    for (const char* text : {"{}", "\xEF\xBB\xBF{}", " {\"uv\": {}, \"albedo\": {} } \r\n"}) {
        const auto [material, notes] = parsed(text);
        EXPECT_EQ(material, Material{});
        EXPECT_TRUE(notes.empty());
    }
}

TEST(MaterialIo, writes_a_canonical_form_that_a_person_can_read) {
    EXPECT_EQ(to_json(parsed(kRustedIron).material), R"({
  "$schema": "patina-material-1.schema.json",
  "name": "Rusted iron",
  "source": "Measured on a gate",
  "albedo": { "value": [1, 1, 1], "map": "rust_albedo.png", "color_space": "srgb" },
  "roughness": { "value": 0.25, "map": "rust_orm.png", "channel": "g", "invert": true },
  "metallic": { "value": 1, "map": "rust_orm.png", "channel": "b" },
  "ao": { "value": 0.5, "map": "rust_orm.png", "channel": "r" },
  "normal": { "value": 1.5, "map": "rust_nor_dx.png", "convention": "directx" },
  "emission": { "value": [0, 12.5, 0], "map": "glow.exr", "color_space": "linear" },
  "uv": { "scale": [2, 3], "offset": [0.5, -0.25], "rotation_deg": 90 }
}
)");
    EXPECT_EQ(to_json(Material{}), R"({
  "$schema": "patina-material-1.schema.json",
  "name": "Untitled",
  "albedo": { "value": [0.8, 0.8, 0.8] },
  "roughness": { "value": 0.5 },
  "metallic": { "value": 0 },
  "ao": { "value": 1 },
  "normal": { "value": 1 },
  "emission": { "value": [0, 0, 0] },
  "uv": { "scale": [1, 1], "offset": [0, 0], "rotation_deg": 0 }
}
)");
}

namespace {

/// A float of any magnitude that the range allows: random bits where they fit, random fractions of the range
/// elsewhere.
float random_value(const ParamRange& range, std::mt19937& random) {
    const auto bits = static_cast<std::uint32_t>(random());
    float value = 0.0f;
    std::memcpy(&value, &bits, sizeof value);
    if (value >= range.min && value <= range.max) return value;
    return range.min + (range.max - range.min) * static_cast<float>(random() % 65537) / 65536.0f;
}
std::string random_text(std::mt19937& random) {
    static constexpr std::array kPieces{"a",  "B",  "7",  " ",    "/",    "ü", "木", "😀",
                                        "\"", "\\", "\n", "\x01", ".png", "$", "~"};
    std::string text;
    for (auto length = random() % 8; length > 0; --length) text += kPieces[random() % kPieces.size()];
    return text;
}
template <class T, std::size_t n>
void randomize(T* value, const std::array<Choice<T>, n>& choices, std::mt19937& random) {
    if (value) *value = choices[random() % n].value;
}
Material random_material(std::mt19937& random) {
    Material material;
    material.name = random_text(random);
    material.source = random_text(random);
    for (const MaterialParam& param : kMaterialParams)
        for (float& value : values_of(param, material)) value = random_value(param.range, random);
    for (const MaterialSlot& slot : material_slots()) {
        const MapRef ref = slot.edit(material);
        *ref.map = random_text(random);
        randomize(ref.color_space, kColorSpaces, random);
        randomize(ref.channel, kChannels, random);
        randomize(ref.convention, kNormalConventions, random);
        if (ref.invert) *ref.invert = random() % 2 == 0;
    }
    if (random() % 2 == 0)
        material.unknown_json =
            R"({"$schema":"x","normal":{"tilt":)" + std::to_string(random()) + R"(},"later":{"a":[1,0.1]}})";
    return material;
}

}  // namespace

TEST(MaterialIo, every_material_reads_back_equal_to_the_last_bit) {
    std::mt19937 random(7);
    for (int i = 0; i < 2000; ++i) {
        const Material material = random_material(random);
        const std::string text = to_json(material);
        ASSERT_EQ(parsed(text).material, material) << text;
        ASSERT_EQ(to_json(parsed(text).material), text);
    }
}

TEST(MaterialIo, every_row_of_the_table_reaches_the_text) {
    for (const MaterialParam& param : kMaterialParams) {
        Material material;
        values_of(param, material)[0] = 0.375f;
        EXPECT_NE(to_json(material), to_json(Material{})) << param.key;
        EXPECT_EQ(parsed(to_json(material)).material, material) << param.key;
    }
}

TEST(MaterialIo, unknown_keys_are_noted_with_their_place_and_kept_at_any_depth) {
    const std::string_view text = R"({
  "name": "x",
  "vendor": { "id": 12345678901234567890, "tags": ["a", null] },
  "albedo": { "value": [1, 1, 1], "tint/er": true },
  "uv": { "wrap": { "u": "mirror" }, "scale": [2, 2] },
  "clearcoat": 1e-300
})";
    const auto [material, notes] = parsed(text);
    ASSERT_EQ(notes.size(), 4u);
    EXPECT_EQ(notes[0],
              "m.json:3:13: /vendor is not known to this version; it is kept when the preset is saved.");
    EXPECT_TRUE(mentions(notes, "m.json:4:46: /albedo/tint~1er "));
    EXPECT_TRUE(mentions(notes, "m.json:5:19: /uv/wrap "));
    EXPECT_TRUE(mentions(notes, "/clearcoat "));

    const auto before = nlohmann::json::parse(text);
    const auto after = nlohmann::json::parse(to_json(material));
    const auto leaves = before.flatten();
    for (const auto& [pointer, value] : leaves.items())
        EXPECT_EQ(after.at(nlohmann::json::json_pointer(pointer)), value) << pointer;
    EXPECT_EQ(parsed(to_json(material)).material, material);
}

TEST(MaterialIo, a_known_key_set_later_wins_over_an_unknown_one_of_that_name) {
    Material material;
    material.unknown_json = R"({"roughness": {"value": 0.9, "grain": 2}, "name": "not this", "uv": 5})";
    const auto json = nlohmann::json::parse(to_json(material));
    EXPECT_EQ(json["roughness"]["value"], 0.5);
    EXPECT_EQ(json["roughness"]["grain"], 2);
    EXPECT_EQ(json["name"], "Untitled");
    EXPECT_EQ(json["uv"]["scale"][0], 1);
    material.unknown_json = "broken";
    EXPECT_EQ(to_json(material), to_json(Material{}));
}

TEST(MaterialIo, a_newer_version_is_noted_and_its_name_kept) {
    const auto [material, notes] =
        parsed(R"({"$schema": "https://x/patina-material-2.schema.json", "sheen": 1})");
    EXPECT_TRUE(mentions(notes, "m.json:1:13: /$schema says version 2, this program knows version 1"));
    EXPECT_NE(to_json(material).find("https://x/patina-material-2.schema.json"), std::string::npos);
    EXPECT_NE(to_json(material).find("sheen"), std::string::npos);
    EXPECT_TRUE(
        mentions(parsed(R"({"$schema": "other.json", "name": "x"})").notes, "not that of a Patina material"));
    EXPECT_TRUE(parsed(R"({"$schema": "patina-material-1.schema.json"})").notes.empty());
    EXPECT_TRUE(parsed(R"({"$schema": "../schemas/patina-material-1.schema.json"})").notes.empty());
}

TEST(MaterialIo, numbers_out_of_range_are_clamped_and_noted) {
    const auto [material, notes] = parsed(R"({
  "albedo": { "value": [1.5, 0.5, -1] },
  "roughness": { "value": 7 },
  "uv": { "rotation_deg": -1e30 }
})");
    EXPECT_EQ(material.albedo.value, glm::vec3(1.0f, 0.5f, 0.0f));
    EXPECT_EQ(material.roughness.value, 1.0f);
    EXPECT_EQ(material.uv.rotation_deg, -360.0f);
    ASSERT_EQ(notes.size(), 4u);
    EXPECT_EQ(notes[0], "m.json:2:25: /albedo/value/0 is 1.5, outside from 0 to 1; taken as 1.");
    EXPECT_EQ(notes[2], "m.json:3:27: /roughness/value is 7, outside from 0 to 1; taken as 1.");
    EXPECT_EQ(parsed(to_json(material)).material, material);
    EXPECT_TRUE(parsed(to_json(material)).notes.empty());
}

TEST(MaterialIo, wrong_types_are_errors_that_name_file_place_and_what_is_wanted) {
    const struct {
        const char *text, *says;
    } cases[] = {
        {"[]", "m.json:1:1: the document is an array of 0; a material preset is a JSON object."},
        {"null", "m.json:1:1: the document is null; a material preset is a JSON object."},
        {R"({"name": 5})", "m.json:1:10: /name is a number; it must be text."},
        {R"({"albedo": [1,1,1]})", "m.json:1:12: /albedo is an array of 3; it must be an object."},
        {R"({"roughness": 0.5})", "m.json:1:15: /roughness is a number; it must be an object."},
        {R"({"albedo": {"value": 0.5}})",
         "m.json:1:22: /albedo/value is a number; it must be an array of 3 numbers."},
        {R"({"albedo": {"value": [1,1]}})",
         "/albedo/value is an array of 2; it must be an array of 3 numbers."},
        {R"({"albedo": {"value": [1,1,"1"]}})",
         "m.json:1:27: /albedo/value/2 is text; it must be a number from 0 to 1."},
        {R"({"roughness": {"value": [0.5]}})",
         "/roughness/value is an array of 1; it must be a number from 0 to 1."},
        {R"({"roughness": {"value": true}})", "/roughness/value is true; it must be a number"},
        {R"({"roughness": {"value": null}})", "/roughness/value is null; it must be a number"},
        {R"({"roughness": {"value": 1e39}})",
         "/roughness/value is 1e+39, too large a number; it must be one from 0 to 1."},
        {R"({"roughness": {"map": null}})", "/roughness/map is null; it must be text."},
        {R"({"roughness": {"invert": 1}})", "/roughness/invert is a number; it must be true or false."},
        {R"({"roughness": {"channel": "h"}})",
         "/roughness/channel is 'h'; it must be 'r' or 'g' or 'b' or 'a'."},
        {R"({"normal": {"convention": "vulkan"}})", "is 'vulkan'; it must be 'opengl' or 'directx'."},
        {R"({"albedo": {"color_space": 1}})", "/albedo/color_space is a number; it must be text."},
        {R"({"uv": {"scale": 2}})", "m.json:1:18: /uv/scale is a number; it must be an array of 2 numbers."},
        {R"({"uv": 3})", "/uv is a number; it must be an object."},
        {R"({"$schema": 1})", "/$schema is a number; it must be text."},
        {R"({"asset": {"version": "2.0"}, "meshes": []})", "has none of the keys of a material preset"},
        {R"({"$schema": "https://json-schema.org/draft/2020-12/schema", "title": "x"})",
         "has none of the keys of a material preset"},
        {"{\n\n  \"uv\": {\"scale\": [1, \"a\nb\"]}}", "m.json:3:25: not valid JSON"},
    };
    for (const auto& [text, says] : cases) {
        const std::string sentence = refusal(text);
        EXPECT_NE(sentence.find(says), std::string::npos) << text << " → " << sentence;
        EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
    }
}

TEST(MaterialIo, names_of_choices_are_read_in_any_case) {
    const Material material =
        parsed(R"({"normal": {"convention": "DirectX"}, "albedo": {"color_space": "sRGB"}})").material;
    EXPECT_EQ(material.normal.convention, NormalConvention::DirectX);
}

TEST(MaterialIo, repeated_keys_are_noted_once_and_the_last_counts) {
    const auto [material, notes] = parsed(R"({"name": "a", "name": "b", "name": "c"})");
    EXPECT_EQ(material.name, "c");
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_EQ(notes[0], "m.json:1:36: /name is there more than once; the last one counts.");
}

TEST(MaterialIo, a_flood_of_notes_ends_with_a_count) {
    std::string text = "{\"name\": \"x\"";
    for (int i = 0; i < 1000; ++i) text += ",\"k" + std::to_string(i) + "\":0";
    const auto notes = parsed(text + "}").notes;
    ASSERT_EQ(notes.size(), 51u);
    EXPECT_EQ(notes.back(), "m.json: 950 more notes of this kind.");
}

TEST(MaterialIo, refuses_more_text_than_a_preset_can_be) {
    EXPECT_NE(refusal(std::string(kMaxPresetBytes + 1, ' ')).find("larger than the limit of 4 MiB"),
              std::string::npos);
    const TemporaryFolder folder;
    write_file(folder / "big.json", std::string(kMaxPresetBytes + 1, ' '));
    EXPECT_NE(failure_of([&] { load_material(folder / "big.json"); }).find("limit of 4096 KiB"),
              std::string::npos);
}

TEST(MaterialIo, no_cut_of_a_preset_crashes_the_reader) {
    const std::string text = to_json(parsed(kRustedIron).material);
    for (std::size_t length = 0; length + 2 < text.size(); ++length)
        EXPECT_FALSE(refusal(std::string_view(text).substr(0, length)).empty()) << length;
}

TEST(MaterialIo, no_change_of_a_byte_crashes_the_reader) {
    const std::string text = to_json(parsed(kRustedIron).material);
    std::mt19937 random(3);
    for (int i = 0; i < 5000; ++i) {
        std::string broken = text;
        for (auto changes = 1 + random() % 4; changes > 0; --changes)
            broken[random() % broken.size()] =
                static_cast<char>(random() % 2 ? random() % 256 : "{}[],:\"\\0-e"[random() % 11]);
        const std::string sentence = refusal(broken);
        EXPECT_TRUE(sentence.empty() || sentence.starts_with("m.json")) << sentence;
        EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
    }
}

TEST(MaterialIo, a_material_with_numbers_that_are_none_still_saves_as_a_valid_preset) {
    Material material;
    material.roughness.value = std::numeric_limits<float>::quiet_NaN();
    material.emission.value.x = std::numeric_limits<float>::infinity();
    material.albedo.value.y = 3.0f;
    material.albedo.map = "\xFF.png";
    const auto [again, notes] = parsed(to_json(material));
    EXPECT_EQ(again.roughness.value, 0.5f);
    EXPECT_EQ(again.emission.value.x, 0.0f);
    EXPECT_EQ(again.albedo.value.y, 1.0f);
    EXPECT_TRUE(notes.empty());
}

TEST(MaterialIo, saves_and_loads_a_file_and_names_it_in_errors) {
    const TemporaryFolder folder;
    const fs::path file = folder / fs::path(u8"Rostiges Eisen – 鉄.json");
    const Material material = parsed(kRustedIron).material;
    save_material(file, material);
    EXPECT_EQ(load_material(file).material, material);
    write_file(file, "{\"albedo\": 1}");
    EXPECT_TRUE(failure_of([&] { load_material(file); }).starts_with(path_to_utf8(file) + ":1:12: /albedo"));
}

TEST(MaterialIo, a_failed_save_keeps_the_old_preset) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "preset.json");
    EXPECT_FALSE(failure_of([&] { save_material(folder / "preset.json", Material{}); }).empty());
    EXPECT_TRUE(fs::is_directory(folder / "preset.json"));
    EXPECT_EQ(folder.count(), 1u);
}

}  // namespace patina
