// patina bake: the light the renderer uses, as files for any program.
#include "app/commands.h"
#include "app/console.h"
#include "app/jobs.h"
#include "app/paths.h"
#include "renderer/core/file_io.h"
#include "renderer/core/image_io.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstring>
#include <stdexcept>

namespace patina {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

double milliseconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// Six faces side by side, +X −X +Y −Y +Z −Z, each in OpenGL's orientation.
Image face_strip(const CubeMap& cube) {
    Image strip = make_image(6 * cube.size, cube.size, 3, PixelType::F32);
    const std::size_t row = sizeof(glm::vec3) * std::size_t(cube.size);
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < cube.size; ++y)
            std::memcpy(strip.bytes.data() + std::size_t(y * 6 + face) * row,
                        cube.texels.data() + std::size_t(face * cube.size + y) * std::size_t(cube.size), row);
    return strip;
}

Image brdf_picture(const BrdfTable& table) {
    Image picture = make_image(table.size, table.size, 3, PixelType::F32);
    for (int y = 0; y < table.size; ++y)
        for (int x = 0; x < table.size; ++x) {
            const glm::vec2 ab = table.ab[std::size_t(y * table.size + x)];
            set_texel(picture, x, y, 0, ab.x);
            set_texel(picture, x, y, 1, ab.y);
        }
    return picture;
}

/// A folder that appears under its name only when commit() is called: files are written beside it first.
class StagedFolder {
public:
    explicit StagedFolder(fs::path target) : target_(std::move(target)) {
        std::error_code error;
        if (fs::exists(target_, error) && !fs::is_directory(target_, error))
            throw std::runtime_error(utf8_from_path(target_) +
                                     ": is a file; name a folder to write the bake into");
        if (fs::is_directory(target_, error) && !fs::is_empty(target_, error) &&
            !fs::exists(target_ / "bake.json", error))
            throw std::runtime_error(
                utf8_from_path(target_) +
                ": holds other files; name a new folder, an empty one or an earlier bake");
        staging_ = target_;
        staging_ += ".patina-part";
        fs::remove_all(staging_, error);
        if (!fs::create_directories(staging_, error))
            throw std::runtime_error(utf8_from_path(target_) + ": cannot be created (" + error.message() +
                                     "); choose a folder that you may write to");
    }
    ~StagedFolder() {
        std::error_code ignored;
        fs::remove_all(staging_, ignored);
    }
    StagedFolder(const StagedFolder&) = delete;
    StagedFolder& operator=(const StagedFolder&) = delete;

    const fs::path& path() const { return staging_; }
    void commit() {
        std::error_code error;
        fs::path old = target_;
        old += ".patina-old";
        fs::remove_all(old, error);
        if (fs::exists(target_, error)) fs::rename(target_, old, error);
        fs::rename(staging_, target_, error);
        if (error) {
            std::error_code ignored;
            fs::rename(old, target_, ignored);
            throw std::runtime_error(utf8_from_path(target_) + ": cannot be replaced (" + error.message() +
                                     ")");
        }
        fs::remove_all(old, error);
    }

private:
    fs::path target_;
    fs::path staging_;
};

Json light_json(const ExtractedLight& light) {
    const auto triple = [](glm::vec3 v) { return Json::array({v.x, v.y, v.z}); };
    return {{"direction", triple(light.direction)},
            {"irradiance", triple(light.irradiance)},
            {"angular_radius", light.angular_radius_rad}};
}

/// Writes the pictures and fills everything of bake.json but the timings.
Json write_pictures(const fs::path& folder, const Environment& environment, const BakedEnvironment& baked) {
    Json json;
    json["source"] = {{"id", environment.id}, {"width", environment.width}, {"height", environment.height}};
    json["size"] = 0;
    json["levels"] = Json::array();
    int largest = 0;
    for (std::size_t k = 0; k < baked.levels.size(); ++k) {
        const PrefilteredLevel& level = baked.levels[k];
        const std::string number = std::to_string(k);
        const std::string file = "level_" + std::string(number.size() < 2 ? "0" : "") + number + ".exr";
        save_image(folder / file, face_strip(level.cube));
        json["levels"].push_back({{"file", file}, {"size", level.cube.size}, {"roughness", level.roughness}});
        largest = std::max(largest, level.cube.size);
    }
    json["size"] = largest;
    save_image(folder / "irradiance.exr", face_strip(baked.irradiance));
    json["irradiance"] = {{"file", "irradiance.exr"}, {"size", baked.irradiance.size}};
    const BrdfTable table = bake_brdf_table();
    save_image(folder / "brdf.exr", brdf_picture(table));
    json["brdf"] = {{"file", "brdf.exr"}, {"size", table.size}, {"x", "sqrt(NoV)"}, {"y", "roughness"}};
    json["lights"] = Json::array();
    for (const ExtractedLight& light : baked.lights) json["lights"].push_back(light_json(light));
    return json;
}

}  // namespace

int run_bake(const BakeArgs& args, const Registry& registry) {
    auto start = std::chrono::steady_clock::now();
    const Environment environment = load_environment(registry, args.environment);
    const double decode_ms = milliseconds_since(start);
    for (const std::string& note : environment.notes) say(args.environment + ": " + note);

    BakeSettings settings;
    settings.max_face_size = args.size;
    if (!args.roughness.empty()) settings.roughness = args.roughness;
    StagedFolder folder(path_from_utf8(args.output));
    const Jobs jobs(worker_count());
    ProgressLine progress;
    const std::optional<BakedEnvironment> baked =
        bake_environment(environment, settings,
                         {.parallel_for = jobs.parallel_for(),
                          .progress = [&](float f) { progress.show("baking", f); },
                          .stop = {}});
    if (!baked) throw std::runtime_error(args.environment + ": the bake was stopped");
    progress.clear();
    for (const std::string& note : baked->notes) say(args.environment + ": " + note);

    start = std::chrono::steady_clock::now();
    Json json = write_pictures(folder.path(), environment, *baked);
    const BakeTimings& timings = baked->timings;
    json["timings_ms"] = {{"decode", decode_ms},         {"transform", timings.transform_ms},
                          {"levels", timings.levels_ms}, {"irradiance", timings.irradiance_ms},
                          {"lights", timings.lights_ms}, {"write", milliseconds_since(start)}};
    const std::string text = json.dump(2) + "\n";
    write_file(folder.path() / "bake.json", std::as_bytes(std::span(text)));
    folder.commit();
    return 0;
}

}  // namespace patina
