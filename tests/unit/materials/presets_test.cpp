// The shipped presets and their schema.
#include "materials/maps/recipes.h"
#include "materials/material_io.h"
#include "materials/params.h"
#include "materials/text_io.h"
#include "tests/unit/materials/schema_validator.h"
#include "tests/unit/materials/temporary_folder.h"

#include <algorithm>
#include <cctype>
#include <set>

namespace patina {

namespace fs = std::filesystem;

namespace {

const fs::path kPresetFolder = fs::path(PATINA_SOURCE_DIR) / "materials" / "presets";

std::vector<fs::path> shipped() {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(kPresetFolder))
        if (!entry.path().filename().string().ends_with(".schema.json")) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}
SchemaValidator schema() {
    return SchemaValidator(nlohmann::json::parse(read_file(kPresetFolder / std::string(kPresetSchema))));
}
std::set<std::string> generated_maps() {
    static constexpr int kSmall = 64;
    std::set<std::string> files;
    for (const maps::MapRecipe& recipe : maps::map_recipes())
        for (const maps::MapPicture& picture : recipe.make(kSmall)) files.insert("maps/" + picture.file);
    return files;
}

}  // namespace

TEST(ShippedPresets, are_read_without_a_note_and_written_back_byte_for_byte) {
    EXPECT_GE(shipped().size(), 36u);
    for (const fs::path& file : shipped()) {
        const auto [material, notes] = load_material(file);
        EXPECT_TRUE(notes.empty()) << notes[0];
        EXPECT_EQ(to_json(material), read_file(file)) << file;
    }
}

TEST(ShippedPresets, satisfy_the_schema) {
    const SchemaValidator validator = schema();
    for (const fs::path& file : shipped()) {
        const auto problems = validator.problems_of(nlohmann::json::parse(read_file(file)));
        EXPECT_TRUE(problems.empty()) << file << ": " << problems[0];
    }
}

TEST(ShippedPresets, have_kebab_case_file_names_names_of_their_own_and_a_source) {
    std::set<std::string> names;
    for (const fs::path& file : shipped()) {
        const std::string stem = file.stem().string();
        EXPECT_TRUE(std::all_of(stem.begin(), stem.end(), [](unsigned char c) {
            return std::islower(c) || c == '-';
        })) << stem;
        const Material material = load_material(file).material;
        EXPECT_TRUE(names.insert(material.name).second) << material.name;
        EXPECT_GT(material.source.size(), 40u) << stem;
        EXPECT_TRUE(material.source.ends_with('.')) << stem;
    }
}

TEST(ShippedPresets, are_metals_or_not_and_keep_to_what_is_physical) {
    for (const fs::path& file : shipped()) {
        const Material material = load_material(file).material;
        EXPECT_TRUE(!material.metallic.map.empty() || material.metallic.value == 0.0f ||
                    material.metallic.value == 1.0f)
            << file;
        if (!material.albedo.map.empty()) continue;
        for (int c = 0; c < 3; ++c) {
            const bool metal = material.metallic.value == 1.0f;
            const float least = metal ? 0.3f : 0.01f;
            const float most = metal ? 1.0f : 0.9f;
            EXPECT_GE(material.albedo.value[c], least) << file;
            EXPECT_LE(material.albedo.value[c], most) << file;
        }
    }
}

TEST(ShippedPresets, name_only_maps_that_are_generated_and_leave_none_unused) {
    std::set<std::string> used;
    for (const fs::path& file : shipped()) {
        Material material = load_material(file).material;
        for (const MaterialSlot& slot : material_slots())
            if (const std::string& map = *slot.edit(material).map; !map.empty()) used.insert(map);
    }
    EXPECT_EQ(used, generated_maps());
}

TEST(ShippedPresets, exercise_every_slot_and_every_way_to_read_a_map) {
    std::set<MapSlot> mapped;
    std::set<Channel> channels;
    bool directx = false, inverted = false, scaled = false, turned = false, shifted = false, packed = false;
    for (const fs::path& file : shipped()) {
        Material m = load_material(file).material;
        for (const MaterialSlot& slot : material_slots())
            if (!slot.edit(m).map->empty()) mapped.insert(slot.slot);
        for (const ScalarSlot* slot : {&m.roughness, &m.metallic, &m.ao})
            if (!slot->map.empty()) channels.insert(slot->channel);
        directx |= !m.normal.map.empty() && m.normal.convention == NormalConvention::DirectX;
        inverted |= m.roughness.invert;
        scaled |= m.uv.scale.x != m.uv.scale.y;
        turned |= m.uv.rotation_deg != 0.0f;
        shifted |= m.uv.offset != glm::vec2(0.0f);
        packed |= !m.roughness.map.empty() && m.roughness.map == m.metallic.map && m.metallic.map == m.ao.map;
    }
    EXPECT_EQ(mapped.size(), static_cast<std::size_t>(kMapSlots));
    EXPECT_EQ(channels, (std::set<Channel>{Channel::R, Channel::G, Channel::B}));
    EXPECT_TRUE(directx && inverted && scaled && turned && shifted && packed);
}

TEST(PresetSchema, knows_every_parameter_with_the_range_of_the_table) {
    const SchemaValidator validator = schema();
    const auto root = nlohmann::json::parse(read_file(kPresetFolder / std::string(kPresetSchema)));
    for (const MaterialParam& param : kMaterialParams) {
        nlohmann::json here = root;
        std::string key(param.key);
        for (std::size_t start = 0; start != std::string::npos;) {
            const std::size_t dot = key.find('.', start);
            const std::string part = key.substr(start, dot == std::string::npos ? dot : dot - start);
            ASSERT_TRUE(here["properties"].contains(part)) << param.key;
            here = validator.resolved(here["properties"][part]);
            start = dot == std::string::npos ? dot : dot + 1;
        }
        if (param.slot) here = validator.resolved(here["properties"]["value"]);
        if (param.kind != ParamKind::Scalar) {
            EXPECT_EQ(here["minItems"], components(param.kind)) << param.key;
            EXPECT_EQ(here["maxItems"], components(param.kind)) << param.key;
            here = here["items"];
        }
        EXPECT_EQ(here["minimum"], param.range.min) << param.key;
        EXPECT_EQ(here["maximum"], param.range.max) << param.key;
    }
}

TEST(PresetSchema, knows_every_way_to_read_a_map) {
    const SchemaValidator validator = schema();
    for (const MaterialSlot& slot : material_slots()) {
        Material material;
        const MapRef ref = slot.edit(material);
        const auto accepts = [&](const std::string& key, const nlohmann::json& value) {
            return validator.problems_of({{std::string(slot.key), {{key, value}}}}).empty();
        };
        const auto knows = [&](const auto& choices, const auto* field, const char* key) {
            if (!field) return;
            for (const auto& row : choices) EXPECT_TRUE(accepts(key, row.id)) << slot.key << " " << row.id;
            EXPECT_FALSE(accepts(key, "nonsense")) << slot.key << " " << key;
        };
        knows(kColorSpaces, ref.color_space, "color_space");
        knows(kChannels, ref.channel, "channel");
        knows(kNormalConventions, ref.convention, "convention");
        EXPECT_TRUE(accepts("map", "a.png"));
        EXPECT_FALSE(accepts("map", 5));
        EXPECT_EQ(accepts("invert", "nonsense"), ref.invert == nullptr);
    }
}

TEST(PresetSchema, rejects_whatever_the_reader_rejects) {
    const SchemaValidator validator = schema();
    for (const char* text : {"[]",
                             "null",
                             "5",
                             R"({"name": 5})",
                             R"({"source": []})",
                             R"({"albedo": [1,1,1]})",
                             R"({"albedo": null})",
                             R"({"roughness": 0.5})",
                             R"({"albedo": {"value": 0.5}})",
                             R"({"albedo": {"value": [1,1]}})",
                             R"({"albedo": {"value": [1,1,1,1]}})",
                             R"({"albedo": {"value": [1,1,"1"]}})",
                             R"({"albedo": {"value": {}}})",
                             R"({"emission": {"value": [1,null,1]}})",
                             R"({"roughness": {"value": [0.5]}})",
                             R"({"roughness": {"value": true}})",
                             R"({"ao": {"value": null}})",
                             R"({"metallic": {"map": null}})",
                             R"({"metallic": {"map": ["a.png"]}})",
                             R"({"roughness": {"invert": 1}})",
                             R"({"ao": {"invert": "true"}})",
                             R"({"roughness": {"channel": "h"}})",
                             R"({"metallic": {"channel": 0}})",
                             R"({"normal": {"convention": "vulkan"}})",
                             R"({"normal": {"value": [1]}})",
                             R"({"albedo": {"color_space": 1}})",
                             R"({"emission": {"color_space": "aces"}})",
                             R"({"uv": {"scale": 2}})",
                             R"({"uv": {"offset": [0]}})",
                             R"({"uv": {"rotation_deg": "90"}})",
                             R"({"uv": 3})",
                             R"({"$schema": 1})"}) {
        EXPECT_FALSE(failure_of([&] { parse_material(text, "m.json"); }).empty()) << text;
        EXPECT_FALSE(validator.problems_of(nlohmann::json::parse(text)).empty()) << text;
    }
}

TEST(PresetSchema, rejects_what_the_reader_has_to_clamp_and_accepts_what_it_keeps) {
    const SchemaValidator validator = schema();
    for (const char* text : {R"({"albedo": {"value": [1.5,0,0]}})", R"({"roughness": {"value": -0.1}})",
                             R"({"normal": {"value": 5}})", R"({"uv": {"scale": [1, 2000]}})",
                             R"({"uv": {"rotation_deg": 720}})"}) {
        EXPECT_EQ(parse_material(text, "m.json").notes.size(), 1u) << text;
        EXPECT_FALSE(validator.problems_of(nlohmann::json::parse(text)).empty()) << text;
    }
    for (const char* text :
         {"{}", R"({"name": "", "vendor": 5})", R"({"uv": {"wrap": "mirror"}, "albedo": {"tint": [1]}})"})
        EXPECT_TRUE(validator.problems_of(nlohmann::json::parse(text)).empty()) << text;
}

TEST(PresetSchema, the_validator_refuses_keywords_it_does_not_check) {
    EXPECT_THROW(SchemaValidator(nlohmann::json::parse(R"({"properties": {"a": {"pattern": "x"}}})")),
                 std::runtime_error);
    EXPECT_THROW(SchemaValidator(nlohmann::json::parse(R"({"items": {"$ref": "#/$defs/none"}})")),
                 std::exception);
}

}  // namespace patina
