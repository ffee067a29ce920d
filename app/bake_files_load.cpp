// Reading a bake back: every size, key and type is checked before it is believed.
#include "app/bake_files.h"
#include "materials/json_text.h"
#include "materials/text_io.h"
#include "renderer/core/file_io.h"
#include "renderer/core/image_io.h"
#include "renderer/shaders/blocks.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string_view>

namespace patina {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr std::uint64_t kMaxJsonBytes = std::uint64_t{1} << 20;
constexpr int kMaxFace = 4096;
constexpr std::size_t kMaxLights = 1024;
constexpr float kWideRatio = 1.5f;  ///< levels further apart are interpolated visibly

/// bake.json while it is read: values by JSON pointer, and errors that say where.
class Manifest {
public:
    explicit Manifest(const fs::path& file) : name_(path_to_utf8(file)) {
        const std::vector<std::byte> bytes = read_file(file, kMaxJsonBytes + 1);
        if (bytes.size() > kMaxJsonBytes)
            throw std::runtime_error(name_ +
                                     ": is larger than a bake.json can be; bake the environment again");
        text_.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        std::vector<std::string> repeated;
        json_ = parse_json(text_, name_, repeated);
        if (!repeated.empty()) fail(repeated.front(), "appears twice");
    }

    [[noreturn]] void fail(const std::string& pointer, const std::string& what) const {
        const TextPosition at = position_of(text_, Json::json_pointer(pointer));
        std::string key = pointer.substr(std::min<std::size_t>(1, pointer.size()));
        std::ranges::replace(key, '/', '.');
        throw std::runtime_error(name_ + ":" + std::to_string(at.line) + ":" + std::to_string(at.column) +
                                 ": " + key + " " + what);
    }
    bool has(const std::string& pointer) const { return json_.contains(Json::json_pointer(pointer)); }
    const Json& value(const std::string& pointer) const {
        if (!has(pointer)) fail(pointer, "is missing");
        return json_.at(Json::json_pointer(pointer));
    }
    std::size_t array_size(const std::string& pointer, std::size_t most) const {
        const Json& list = value(pointer);
        if (!list.is_array()) fail(pointer, "is not a list");
        if (list.size() > most) fail(pointer, "has more than " + std::to_string(most) + " entries");
        return list.size();
    }
    double number(const std::string& pointer, double low, double high) const {
        const Json& found = value(pointer);
        if (!found.is_number()) fail(pointer, "is not a number");
        const double number = found.get<double>();
        if (!(number >= low && number <= high)) {
            Json limits = Json::array({low, high});
            fail(pointer, "is " + found.dump() + "; it lies within " + limits.dump());
        }
        return number;
    }
    glm::vec3 vector(const std::string& pointer, double low, double high) const {
        if (array_size(pointer, 3) != 3) fail(pointer, "does not have three entries");
        glm::vec3 result;
        for (int i = 0; i < 3; ++i) result[i] = float(number(pointer + "/" + std::to_string(i), low, high));
        return result;
    }
    /// A file beside bake.json; nothing that leads out of its folder.
    std::string file_name(const std::string& pointer) const {
        const Json& found = value(pointer);
        if (!found.is_string()) fail(pointer, "is not a file name");
        std::string name = found.get<std::string>();
        if (name.empty() || name == "." || name == ".." || name.find_first_of("/\\:") != std::string::npos)
            fail(pointer, "is not the plain name of a file beside bake.json");
        return name;
    }

private:
    std::string name_;
    std::string text_;
    Json json_;
};

/// The face strip that KEY/file names and KEY/size describes.
CubeMap load_strip(const Manifest& manifest, const std::string& key, const fs::path& folder) {
    const double number = manifest.number(key + "/size", 1, kMaxFace);
    const int size = int(number);
    if (number != size) manifest.fail(key + "/size", "is not a whole number");
    const fs::path file = folder / utf8_to_path(manifest.file_name(key + "/file"));
    const auto fail = [&](const std::string& what) {
        throw std::runtime_error(path_to_utf8(file) + ": " + what + "; bake the environment again");
    };
    const Image strip = load_image(file).image;
    if (strip.width != 6 * size || strip.height != size)
        fail("is " + std::to_string(strip.width) + "x" + std::to_string(strip.height) + ", not the " +
             std::to_string(6 * size) + "x" + std::to_string(size) + " that bake.json promises");
    if (strip.type != PixelType::F32 || strip.channels != 3) fail("does not hold three floats a pixel");
    CubeMap cube{size, std::vector<glm::vec3>(std::size_t(6) * size * size)};
    const std::size_t row = sizeof(glm::vec3) * std::size_t(size);
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < size; ++y)
            std::memcpy(cube.texels.data() + (std::size_t(face) * size + y) * size,
                        strip.bytes.data() + (std::size_t(y) * 6 + face) * row, row);
    for (const glm::vec3& texel : cube.texels)
        for (int c = 0; c < 3; ++c)
            if (!std::isfinite(texel[c]) || texel[c] < 0.0f)
                fail("holds light that is negative or not finite");
    return cube;
}

std::vector<PrefilteredLevel> load_levels(const Manifest& manifest, const fs::path& folder) {
    if (!manifest.has("/levels") && manifest.has("/ktx"))
        manifest.fail("/ktx",
                      "says that this is a bake for other programs; bake with --format exr to read it back");
    const std::size_t count = manifest.array_size("/levels", blocks::kMaxLevels - 1);
    if (count == 0) manifest.fail("/levels", "is empty");
    std::vector<PrefilteredLevel> levels;
    for (std::size_t i = 0; i < count; ++i) {
        const std::string key = "/levels/" + std::to_string(i);
        const auto roughness = float(manifest.number(key + "/roughness", 0.0, 1.0));
        if (!levels.empty() && roughness <= levels.back().roughness)
            manifest.fail(key + "/roughness", "is not above the one before");
        levels.push_back({roughness, load_strip(manifest, key, folder)});
    }
    return levels;
}

std::vector<ExtractedLight> load_lights(const Manifest& manifest) {
    std::vector<ExtractedLight> lights;
    const std::size_t count = manifest.array_size("/lights", kMaxLights);
    for (std::size_t i = 0; i < count; ++i) {
        const std::string key = "/lights/" + std::to_string(i);
        const glm::vec3 direction = manifest.vector(key + "/direction", -1.001, 1.001);
        if (std::abs(glm::length(direction) - 1.0f) > 1e-3f)
            manifest.fail(key + "/direction", "does not have length 1");
        constexpr double largest = 3.4e38;
        lights.push_back({glm::normalize(direction), manifest.vector(key + "/irradiance", 0.0, largest),
                          float(manifest.number(key + "/angular_radius", 0.0, std::numbers::pi / 2.0))});
    }
    return lights;
}

struct FacePoint {
    int face = 0;
    float s = 0.0f, t = 0.0f;  ///< −1…1
};
FacePoint face_point(glm::vec3 d) {
    const glm::vec3 a = glm::abs(d);
    if (a.x >= a.y && a.x >= a.z) return {d.x > 0 ? 0 : 1, (d.x > 0 ? -d.z : d.z) / a.x, -d.y / a.x};
    if (a.y >= a.z) return {d.y > 0 ? 2 : 3, d.x / a.y, (d.y > 0 ? d.z : -d.z) / a.y};
    return {d.z > 0 ? 4 : 5, (d.z > 0 ? d.x : -d.x) / a.z, -d.y / a.z};
}

glm::vec3 nearest(const CubeMap& cube, glm::vec3 direction) {
    const FacePoint p = face_point(direction);
    const auto index = [&](float c) {
        return std::clamp(int((c + 1.0f) * 0.5f * float(cube.size)), 0, cube.size - 1);
    };
    return cube.texels[(std::size_t(p.face) * cube.size + index(p.t)) * cube.size + index(p.s)];
}

/// Bilinear, across edges too: the four texels are found by direction, half a texel to every side.
glm::vec3 smooth(const CubeMap& cube, glm::vec3 direction) {
    const FacePoint p = face_point(direction);
    const float x = (p.s + 1.0f) * 0.5f * float(cube.size) - 0.5f;
    const float y = (p.t + 1.0f) * 0.5f * float(cube.size) - 0.5f;
    const auto plane = [&](float column, float row) {
        const float s = (2.0f * column + 1.0f) / float(cube.size) - 1.0f;
        const float t = (2.0f * row + 1.0f) / float(cube.size) - 1.0f;
        const std::array<glm::vec3, 6> directions{glm::vec3(1, -t, -s), glm::vec3(-1, -t, s),
                                                  glm::vec3(s, 1, t),   glm::vec3(s, -1, -t),
                                                  glm::vec3(s, -t, 1),  glm::vec3(-s, -t, -1)};
        return nearest(cube, directions[std::size_t(p.face)]);
    };
    const float x0 = std::floor(x);
    const float y0 = std::floor(y);
    return glm::mix(glm::mix(plane(x0, y0), plane(x0 + 1, y0), x - x0),
                    glm::mix(plane(x0, y0 + 1), plane(x0 + 1, y0 + 1), x - x0), y - y0);
}

double texel_solid_angle(const Environment& panorama, int y) {
    const double top = std::numbers::pi * y / panorama.height;
    const double bottom = std::numbers::pi * (y + 1) / panorama.height;
    return 2.0 * std::numbers::pi / panorama.width * (std::cos(top) - std::cos(bottom));
}

glm::vec3 texel_direction(const Environment& panorama, int x, int y) {
    return equirect_to_direction(
        {(float(x) + 0.5f) / float(panorama.width), (float(y) + 0.5f) / float(panorama.height)});
}

/// As a disc of uniform radiance, at least one texel wide; what it sends equals the light's irradiance.
void draw_light(Environment& panorama, const ExtractedLight& light) {
    const float texel = std::numbers::pi_v<float> / float(panorama.height);
    const float cosine = std::cos(std::max(light.angular_radius_rad, 0.75f * texel));
    std::vector<std::size_t> inside;
    double sent = 0.0;
    for (int y = 0; y < panorama.height; ++y)
        for (int x = 0; x < panorama.width; ++x) {
            const float towards = glm::dot(texel_direction(panorama, x, y), light.direction);
            if (towards < cosine) continue;
            inside.push_back(std::size_t(y) * panorama.width + x);
            sent += texel_solid_angle(panorama, y) * double(towards);
        }
    for (const std::size_t at : inside)
        panorama.radiance[at] += glm::vec3(glm::dvec3(light.irradiance) / sent);
}

Environment make_panorama(const CubeMap& cube, const std::vector<ExtractedLight>& lights) {
    Environment panorama;
    panorama.width = std::clamp(4 * cube.size, 64, 4096);
    panorama.height = panorama.width / 2;
    panorama.radiance.reserve(std::size_t(panorama.width) * panorama.height);
    for (int y = 0; y < panorama.height; ++y)
        for (int x = 0; x < panorama.width; ++x)
            panorama.radiance.push_back(smooth(cube, texel_direction(panorama, x, y)));
    for (const ExtractedLight& light : lights) draw_light(panorama, light);
    panorama.content_hash = environment_hash(panorama);
    return panorama;
}

/// The levels the renderer can look up, from the sharpest usable one to roughness 1.
void complete_levels(BakedLight& light, const std::string& name) {
    std::vector<PrefilteredLevel>& levels = light.baked.levels;
    std::erase_if(levels, [](const PrefilteredLevel& level) { return level.roughness < kSharpestUsable; });
    if (levels.empty() || levels.back().roughness < 1.0f) levels.push_back({1.0f, light.baked.irradiance});
    float widest = 1.0f;
    for (std::size_t i = 1; i < levels.size(); ++i)
        widest = std::max(widest, levels[i].roughness / levels[i - 1].roughness);
    if (widest > kWideRatio)
        light.environment.notes.push_back(
            name +
            ": its levels lie far apart, so reflections between them are approximate; "
            "bake without --levels for the standard ones");
}

}  // namespace

bool is_bake(const fs::path& path) {
    std::error_code ignored;
    if (path.filename() == "bake.json") return true;
    return fs::is_directory(path, ignored) && fs::exists(path / "bake.json", ignored);
}

BakedLight load_bake(const fs::path& path) {
    std::error_code ignored;
    const fs::path file = fs::is_directory(path, ignored) ? path / "bake.json" : path;
    const fs::path folder = file.parent_path();
    const Manifest manifest(file);
    BakedLight light;
    light.baked.levels = load_levels(manifest, folder);
    light.baked.irradiance = load_strip(manifest, "/irradiance", folder);
    light.baked.lights = load_lights(manifest);
    light.environment = make_panorama(light.baked.levels.front().cube, light.baked.lights);
    light.environment.id = path_to_utf8(path);
    light.environment.title = path_to_utf8(fs::absolute(folder, ignored).filename());
    complete_levels(light, path_to_utf8(path));
    return light;
}

}  // namespace patina
