#include "app/bake_files.h"

#include "app/ktx.h"
#include "app/paths.h"
#include "materials/text_io.h"
#include "renderer/core/file_io.h"
#include "renderer/core/image_io.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

namespace patina {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

/// Six faces side by side, +X −X +Y −Y +Z −Z, each in OpenGL's orientation.
Image face_strip(const CubeMap& cube) {
    Image strip = make_image(6 * cube.size, cube.size, 3, PixelType::F32);
    const std::size_t row = sizeof(glm::vec3) * std::size_t(cube.size);
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < cube.size; ++y)
            std::memcpy(strip.bytes.data() + (std::size_t(y) * 6 + face) * row,
                        cube.texels.data() + (std::size_t(face) * cube.size + y) * cube.size, row);
    return strip;
}

Image brdf_picture(const BrdfTable& table) {
    Image picture = make_image(table.size, table.size, 3, PixelType::F32);
    for (int y = 0; y < table.size; ++y)
        for (int x = 0; x < table.size; ++x) {
            const glm::vec2 ab = table.ab[std::size_t(y) * table.size + x];
            set_texel(picture, x, y, 0, ab.x);
            set_texel(picture, x, y, 1, ab.y);
        }
    return picture;
}

Json triple(glm::vec3 v) { return Json::array({v.x, v.y, v.z}); }

Json light_json(const ExtractedLight& light) {
    return {{"direction", triple(light.direction)},
            {"irradiance", triple(light.irradiance)},
            {"angular_radius", light.angular_radius_rad}};
}

Json source_json(const Environment& environment) {
    return {{"id", environment.id}, {"width", environment.width}, {"height", environment.height}};
}

}  // namespace

Json write_bake_exr(const fs::path& folder, const Environment& environment, const BakedEnvironment& baked,
                    const ParallelFor& parallel_for) {
    Json json{{"source", source_json(environment)}, {"size", 0}, {"levels", Json::array()}};
    struct Strip {
        std::string file;
        const CubeMap* cube;
    };
    std::vector<Strip> strips;
    int largest = 0;
    for (std::size_t k = 0; k < baked.levels.size(); ++k) {
        const PrefilteredLevel& level = baked.levels[k];
        const std::string number = std::to_string(k);
        strips.push_back(
            {"level_" + std::string(number.size() < 2 ? "0" : "") + number + ".exr", &level.cube});
        json["levels"].push_back(
            {{"file", strips.back().file}, {"size", level.cube.size}, {"roughness", level.roughness}});
        largest = std::max(largest, level.cube.size);
    }
    json["size"] = largest;
    strips.push_back({"irradiance.exr", &baked.irradiance});
    json["irradiance"] = {{"file", "irradiance.exr"}, {"size", baked.irradiance.size}};
    json["brdf"] = {{"file", "brdf.exr"}, {"size", kBrdfTableSize}, {"x", "sqrt(NoV)"}, {"y", "roughness"}};
    // Compressing takes longer than baking. The table is one more task: it is computed first.
    parallel_for(int(strips.size()) + 1, [&](int task) {
        if (task == 0)
            save_image(folder / "brdf.exr", brdf_picture(bake_brdf_table()));
        else
            save_image(folder / strips[std::size_t(task) - 1].file,
                       face_strip(*strips[std::size_t(task) - 1].cube));
    });
    json["lights"] = Json::array();
    for (const ExtractedLight& light : baked.lights) json["lights"].push_back(light_json(light));
    return json;
}

Json write_bake_ktx(const fs::path& folder, const Environment& environment, const BakedEnvironment& baked) {
    const int exponent = ktx_exponent(baked, environment.id);
    const std::string stem = plain_stem(utf8_to_path(environment.id), "environment") + "_ibl";
    write_file(folder / utf8_to_path(stem + ".ktx"), to_ktx1(baked, exponent));
    write_file(folder / utf8_to_path(stem + ".ktx2"), to_ktx2(baked, exponent));
    Json json{
        {"source", source_json(environment)},
        {"size", baked.levels.front().cube.size},
        {"ktx", {{"file", stem + ".ktx"}, {"orientation", "texel at d: light from d"}}},
        {"ktx2", {{"file", stem + ".ktx2"}, {"orientation", "texel at (-x, y, z): light from (x, y, z)"}}},
        {"scale", std::ldexp(1.0, exponent)},
        {"mips", Json::array()},
        {"irradiance_sh", Json::array()},
        {"lights", Json::array()}};
    for (const PrefilteredLevel& level : baked.levels)
        json["mips"].push_back({{"size", level.cube.size}, {"roughness", level.roughness}});
    for (const glm::vec3& coefficient : irradiance_coefficients(baked.irradiance))
        json["irradiance_sh"].push_back(triple(coefficient));
    return json;
}

}  // namespace patina
