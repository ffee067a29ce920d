#include "app/comparison_file.h"

#include "app/json_reader.h"
#include "app/paths.h"
#include "materials/json_text.h"
#include "materials/material_io.h"
#include "materials/text_io.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <stdexcept>

namespace patina {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr NumberRange kTurn{-360.0f, 360.0f};
constexpr NumberRange kStops{-30.0f, 30.0f};
constexpr NumberRange kShare{0.0f, 1.0f};
constexpr NumberRange kGain{0.0f, 100.0f};
constexpr NumberRange kAround{-10.0f, 10.0f};  ///< points may lie outside the picture
constexpr NumberRange kPlace{-1e6f, 1e6f};

// --- reading ---

void read_points(JsonObject& object, std::string_view key, std::array<glm::vec2, 4>& target) {
    const std::vector<glm::vec2> points = object.points(key, 4, kAround);
    for (std::size_t i = 0; i < points.size(); ++i) target[i] = points[i];
}

Photo read_photo(JsonObject object) {
    Photo photo;
    object.read_text("file", photo.file);
    if (photo.file.empty())
        object.document().fail(object.pointer_of("file"), "is missing; a photo is a file");
    object.read_text("title", photo.title);
    object.read_number("exposure_ev", kStops, photo.exposure_ev);
    object.read_vector("white_balance", kGain, photo.white_balance);
    object.read_number("opacity", kShare, photo.opacity);
    if (auto fit = object.object("fit")) {
        photo.fit.emplace();
        read_points(*fit, "photo", photo.fit->photo);
        read_points(*fit, "view", photo.fit->view);
        fit->unknown();
    }
    const std::vector<glm::vec2> corners = object.points("region", 2, kAround);
    if (corners.size() == 2) {
        if (!(corners[0].x < corners[1].x && corners[0].y < corners[1].y))
            object.document().fail(object.pointer_of("region"),
                                   "is empty; it must be the upper left and the lower right corner");
        photo.region = Region{corners[0].x, corners[0].y, corners[1].x, corners[1].y};
    }
    photo.unknown_json = object.unknown();
    return photo;
}

void read_camera(JsonObject object, Camera& camera) {
    object.read_number("yaw_deg", kTurn, camera.yaw_deg);
    object.read_number("pitch_deg", {-89.9f, 89.9f}, camera.pitch_deg);
    object.read_number("distance", {1e-3f, 1e4f}, camera.distance);
    object.read_number("fov_deg", {1.0f, 150.0f}, camera.fov_deg);
    object.read_vector("target", kPlace, camera.target);
    object.unknown();
}

/// All views are drawn at once, which the reference is not.
void read_shading(JsonObject& object, auto& shading) {
    constexpr auto one_draw = [] {
        std::array<Named<Shading>, kShadings.size() - 1> rows{};
        std::ranges::copy_if(kShadings, rows.begin(),
                             [](const auto& row) { return row.value != Shading::Reference; });
        return rows;
    }();
    object.read_choice("shading", one_draw, shading);
}

void read_lighting(JsonObject& object, Lighting& light) {
    object.read_text("environment", light.environment);
    if (light.environment.empty())
        object.document().fail(object.pointer_of("environment"), "is empty; it must name a light");
    object.read_number("rotation_deg", kTurn, light.rotation_deg);
    object.read_number("exposure_ev", kStops, light.exposure_ev);
    object.read_choice("tonemap", kTonemaps, light.tonemap);
    object.read_choice("background", kBackgrounds, light.background);
    object.read_vector("plain_color", kShare, light.plain_color);
    if (auto camera = object.object("camera")) {
        light.camera = Camera{};
        read_camera(std::move(*camera), *light.camera);
    }
    read_shading(object, light.shading);
    if (auto photo = object.object("photo")) light.photo = read_photo(std::move(*photo));
}

void read_preset(JsonObject& object, ComparedPreset& preset) {
    object.read_text("preset", preset.preset);
    if (preset.preset.empty())
        object.document().fail(object.pointer_of("preset"),
                               "is empty; it must be a preset's file or name, 'edited' or '-'");
}

void check_schema(JsonObject& root) {
    std::string schema;
    root.read_text("$schema", schema);
    static constexpr std::string_view before = "patina-comparison-";
    if (schema.empty() || schema == kComparisonSchema) return;
    const std::size_t at = schema.find(before);
    const long version =
        at == std::string::npos ? 0 : std::strtol(schema.c_str() + at + before.size(), nullptr, 10);
    if (version > kComparisonVersion)
        root.document().note("/$schema", "says version " + std::to_string(version) +
                                             ", this program knows version " +
                                             std::to_string(kComparisonVersion) +
                                             "; what it does not know is kept but not shown");
    else if (version < 1)
        root.document().fail("/$schema", "is '" + schema + "', not that of a Patina comparison");
}

// --- writing ---

Json json_of(glm::vec2 v) { return Json::array({shortest_number(v.x), shortest_number(v.y)}); }
Json json_of(glm::vec3 v) {
    return Json::array({shortest_number(v.x), shortest_number(v.y), shortest_number(v.z)});
}
Json json_of(const std::array<glm::vec2, 4>& points) {
    Json json = Json::array();
    for (const glm::vec2 point : points) json.push_back(json_of(point));
    return json;
}

Json json_of(const Photo& photo) {
    Json json;
    json["file"] = photo.file;
    if (!photo.title.empty()) json["title"] = photo.title;
    json["exposure_ev"] = shortest_number(photo.exposure_ev);
    json["white_balance"] = json_of(photo.white_balance);
    json["opacity"] = shortest_number(photo.opacity);
    if (photo.fit) json["fit"] = {{"photo", json_of(photo.fit->photo)}, {"view", json_of(photo.fit->view)}};
    if (photo.region)
        json["region"] = Json::array({json_of(glm::vec2{photo.region->x0, photo.region->y0}),
                                      json_of(glm::vec2{photo.region->x1, photo.region->y1})});
    add_unknown(json, photo.unknown_json);
    return json;
}

Json json_of(const Camera& camera) {
    return {{"yaw_deg", shortest_number(camera.yaw_deg)},
            {"pitch_deg", shortest_number(camera.pitch_deg)},
            {"distance", shortest_number(camera.distance)},
            {"fov_deg", shortest_number(camera.fov_deg)},
            {"target", json_of(camera.target)}};
}

void write_lighting(Json& json, const Lighting& light) {
    json["environment"] = light.environment;
    json["rotation_deg"] = shortest_number(light.rotation_deg);
    json["exposure_ev"] = shortest_number(light.exposure_ev);
    json["tonemap"] = named(kTonemaps, light.tonemap).id;
    json["background"] = named(kBackgrounds, light.background).id;
    if (light.plain_color != Lighting{}.plain_color) json["plain_color"] = json_of(light.plain_color);
    if (light.camera) json["camera"] = json_of(*light.camera);
    if (light.shading) json["shading"] = named(kShadings, *light.shading).id;
    if (light.photo) json["photo"] = json_of(*light.photo);
    add_unknown(json, light.unknown_json);
}

template <class Act>
void for_each_file(Comparison& comparison, Act act) {
    const auto of_light = [&](Lighting& light) {
        act(light.environment);
        if (light.photo) act(light.photo->file);
    };
    act(comparison.mesh);
    for (ComparedPreset& row : comparison.rows) act(row.preset);
    for (Lighting& light : comparison.columns) of_light(light);
    for (FreeView& view : comparison.views) {
        act(view.preset.preset);
        of_light(view.lighting);
    }
}

}  // namespace

LoadedComparison parse_comparison(std::string_view text, const std::string& name) {
    if (text.size() > kMaxComparisonBytes)
        throw std::runtime_error(name + ": the comparison is larger than the limit of " +
                                 std::to_string(kMaxComparisonBytes >> 20) + " MiB.");
    JsonDocument document(text, name);
    JsonObject root(document, document.root(), "");
    check_schema(root);
    LoadedComparison loaded;
    Comparison& comparison = loaded.comparison;
    root.read_text("title", comparison.title);
    root.read_text("author", comparison.author);
    root.read_text("remarks", comparison.remarks);
    root.read_text("mesh", comparison.mesh);
    read_shading(root, comparison.shading);
    root.read_choice("quality", kQualities, comparison.quality);
    if (auto camera = root.object("camera")) read_camera(std::move(*camera), comparison.camera);
    for (JsonObject& object : root.objects("rows", kMaxComparisonRows)) {
        ComparedPreset& row = comparison.rows.emplace_back();
        read_preset(object, row);
        object.read_text("title", row.title);
        row.unknown_json = object.unknown();
    }
    for (JsonObject& object : root.objects("columns", kMaxComparisonColumns)) {
        Lighting& light = comparison.columns.emplace_back();
        read_lighting(object, light);
        object.read_text("title", light.title);
        light.unknown_json = object.unknown();
    }
    for (JsonObject& object : root.objects("views", kMaxFreeViews)) {
        FreeView& view = comparison.views.emplace_back();
        read_preset(object, view.preset);
        read_lighting(object, view.lighting);
        object.read_text("title", view.preset.title);
        object.read_text("lighting_title", view.lighting.title);
        view.lighting.unknown_json = object.unknown();
    }
    if (comparison.rows.empty() != comparison.columns.empty())
        document.fail("", comparison.rows.empty() ? "has columns but no rows; name at least one preset"
                                                  : "has rows but no columns; name at least one lighting");
    if (comparison.rows.empty() && comparison.views.empty())
        document.fail("", "has no rows and columns and no views; there is nothing to compare");
    comparison.unknown_json = root.unknown();
    loaded.notes = document.take_notes();
    return loaded;
}

std::string to_json(const Comparison& comparison) {
    Json json;
    json["$schema"] = kComparisonSchema;
    json["title"] = comparison.title;
    json["author"] = comparison.author;
    if (!comparison.remarks.empty()) json["remarks"] = comparison.remarks;
    json["mesh"] = comparison.mesh;
    json["shading"] = named(kShadings, comparison.shading).id;
    if (comparison.quality != Comparison{}.quality)
        json["quality"] = named(kQualities, comparison.quality).id;
    json["camera"] = json_of(comparison.camera);
    json["rows"] = Json::array();
    for (const ComparedPreset& row : comparison.rows) {
        Json& each = json["rows"].emplace_back();
        each["preset"] = row.preset;
        if (!row.title.empty()) each["title"] = row.title;
        add_unknown(each, row.unknown_json);
    }
    json["columns"] = Json::array();
    for (const Lighting& light : comparison.columns) {
        Json& each = json["columns"].emplace_back();
        if (!light.title.empty()) each["title"] = light.title;
        write_lighting(each, light);
    }
    if (!comparison.views.empty()) json["views"] = Json::array();
    for (const FreeView& view : comparison.views) {
        Json& each = json["views"].emplace_back();
        each["preset"] = view.preset.preset;
        if (!view.preset.title.empty()) each["title"] = view.preset.title;
        if (!view.lighting.title.empty()) each["lighting_title"] = view.lighting.title;
        write_lighting(each, view.lighting);
    }
    add_unknown(json, comparison.unknown_json);
    return to_text(json);
}

Comparison with_full_paths(Comparison comparison, const fs::path& file) {
    for_each_file(comparison, [&](std::string& name) {
        const fs::path path = resolve_map(file, name);
        std::error_code ignored;
        const bool names_a_file = name.find('.') != std::string::npos || name.find('/') != std::string::npos;
        if (path.empty() || (!names_a_file && !fs::is_regular_file(path, ignored))) return;
        name = path_to_utf8(fs::absolute(path, ignored).lexically_normal());
    });
    return comparison;
}

Comparison with_relative_paths(Comparison comparison, const fs::path& file) {
    const fs::path shipped = (share_folder() / "presets").lexically_normal();
    for_each_file(comparison, [&](std::string& name) {
        const fs::path path = utf8_to_path(name);
        if (!path.is_absolute()) return;
        const bool is_shipped = path.parent_path() == shipped && path.extension() == ".json";
        name = is_shipped ? path_to_utf8(path.stem()) : relative_map(file, path);
    });
    return comparison;
}

LoadedComparison load_comparison(const fs::path& file) {
    LoadedComparison loaded = parse_comparison(load_text(file, kMaxComparisonBytes), path_to_utf8(file));
    loaded.comparison = with_full_paths(std::move(loaded.comparison), file);
    return loaded;
}

void save_comparison(const fs::path& file, const Comparison& comparison) {
    save_text(file, to_json(with_relative_paths(comparison, file)));
}

bool is_comparison_file(const fs::path& file) {
    std::error_code failure;
    if (file.extension() != ".json" || fs::file_size(file, failure) > kMaxComparisonBytes || failure)
        return false;
    const Json json = Json::parse(load_text(file, kMaxComparisonBytes), nullptr, false);
    if (!json.is_object()) return false;
    const auto schema = json.find("$schema");
    if (schema != json.end() && schema->is_string())
        return schema->get<std::string>().find("patina-comparison-") != std::string::npos;
    return json.contains("views") || (json.contains("rows") && json.contains("columns"));
}

}  // namespace patina
