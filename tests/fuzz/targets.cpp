#include "tests/fuzz/targets.h"

#include "app/autosave.h"
#include "app/bake_files.h"
#include "app/comparison_file.h"
#include "app/kept_environment.h"
#include "app/settings.h"
#include "materials/material_io.h"
#include "renderer/core/hash.h"
#include "renderer/core/image_io.h"
#include "renderer/core/mesh.h"
#include "renderer/core/mesh_io.h"
#include "renderer/ibl/cache.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <unistd.h>

namespace patina::fuzz {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void defect(const std::string& what) {
    std::fprintf(stderr, "defect: %s\n", what.c_str());
    std::abort();
}
void require(bool holds, const char* what) {
    if (!holds) defect(what);
}

struct OwnFolder {
    fs::path path = fs::temp_directory_path() / ("patina-fuzz-" + std::to_string(getpid()));
    OwnFolder() { fs::create_directories(path); }
    ~OwnFolder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
};

void write_bytes(const std::string& path, std::string_view bytes) {
    std::ofstream(path, std::ios::binary | std::ios::trunc)
        .write(bytes.data(), std::streamsize(bytes.size()));
}

/// What is read once reads back the same from its own text.
void read_preset(const std::string&, std::string_view bytes) {
    const Material material = parse_material(bytes, "x.json").material;
    const std::string text = to_json(material);
    const Material again = parse_material(text, "x.json").material;
    require(to_json(again) == text, "a preset's own text reads back differently");
    for (const std::string* map : {&material.albedo.map, &material.normal.map, &material.roughness.map})
        static_cast<void>(resolve_map("/folder/x.json", *map));
    static_cast<void>(rebase_maps(material, "/folder/x.json", "/other/y.json"));
}
void read_settings(const std::string&, std::string_view bytes) {
    static_cast<void>(parse_settings(to_json(parse_settings(bytes).settings)));
}
void read_recovery(const std::string&, std::string_view bytes) {
    if (const auto recovery = parse_recovery(bytes))
        require(parse_recovery(to_json(*recovery)).has_value(), "a recovery's own text is not read back");
}
void read_comparison(const std::string&, std::string_view bytes) {
    const std::string text = to_json(parse_comparison(bytes, "x").comparison);
    require(to_json(parse_comparison(text, "x").comparison) == text,
            "a comparison's own text reads back differently");
}

void read_picture(const std::string& path, std::string_view bytes) {
    write_bytes(path, bytes);
    static_cast<void>(load_image_info(path));
    const Image image = load_image(path).image;
    require(image.width > 0 && image.height > 0 && image.channels >= 1 && image.channels <= 4 &&
                image.bytes.size() ==
                    std::size_t(image.width) * image.height * image.channels * bytes_per_channel(image.type),
            "a picture's pixels do not match its size");
    static_cast<void>(load_image_metadata(path));
    if (image.bytes.size() < (1u << 20)) {
        const Environment environment = make_environment(image, "x", "x");
        for (const glm::vec3& texel : environment.radiance)
            for (int c = 0; c < 3; ++c)
                require(std::isfinite(texel[c]) && texel[c] >= 0.0f, "an environment holds no light");
    }
}

void read_mesh(const std::string& path, std::string_view bytes) {
    write_bytes(path, bytes);
    Mesh mesh = load_mesh(path);
    if (mesh.vertices.size() < 10000) make_tangents(mesh);
    require(!mesh.indices.empty() && mesh.indices.size() % 3 == 0, "a mesh has no whole triangles");
    for (const std::uint32_t index : mesh.indices)
        require(index < mesh.vertices.size(), "an index points past the vertices");
    for (const Vertex& v : mesh.vertices)
        for (const float x : {v.position.x, v.position.y, v.position.z, v.normal.x, v.normal.y, v.normal.z,
                              v.uv.x, v.uv.y, v.tangent.x, v.tangent.y, v.tangent.z, v.tangent.w})
            require(std::isfinite(x), "a mesh holds a number that is not finite");
}

/// An entry whose header is made to agree with itself: what lies behind the checksum is reached, too. The
/// cache that holds it.
BakeCache cache_with(const std::string& path, std::string_view bytes, const std::string& key) {
    const fs::path folder = fs::path(path).parent_path() / "cache";
    fs::create_directories(folder);
    constexpr std::size_t header = 88, key_at = 16, size_at = 48, hash_at = 80;
    std::string entry(bytes);
    if (entry.size() >= header) {
        std::memcpy(entry.data() + key_at, key.data(), key.size());
        const std::uint64_t size = entry.size();
        std::memcpy(entry.data() + size_at, &size, sizeof size);
        const std::uint64_t hash = hash_bytes(std::as_bytes(std::span(entry.data(), hash_at)));
        std::memcpy(entry.data() + hash_at, &hash, sizeof hash);
    }
    write_bytes((folder / (key + fs::path(path).extension().string())).string(), entry);
    return {.folder = folder};
}

void read_cache(const std::string& path, std::string_view bytes) {
    const std::string key(32, 'a');
    if (const auto baked = load_baked(cache_with(path, bytes, key), key))
        for (const PrefilteredLevel& level : baked->levels)
            require(level.cube.texels.size() == std::size_t(6) * level.cube.size * level.cube.size,
                    "a level's texels do not match its size");
}

void read_environment_cache(const std::string& path, std::string_view bytes) {
    const std::string key(32, 'a');
    const auto kept = load_kept(cache_with(path, bytes, key), key);
    if (!kept) return;
    require(!kept->panorama.levels.empty(), "a panorama without levels");
    for (const PanoramaLevels::Level& level : kept->panorama.levels)
        require(level.rgba.size() == std::size_t(4) * level.width * level.height,
                "a level's texels do not match its size");
}

/// bake.json beside two good face strips.
void read_bake(const std::string& path, std::string_view bytes) {
    const fs::path folder = fs::path(path).parent_path() / "bake";
    if (!fs::exists(folder)) {
        fs::create_directories(folder);
        save_image(folder / "level_00.exr", make_image(24, 4, 3, PixelType::F32));
        save_image(folder / "irradiance.exr", make_image(24, 4, 3, PixelType::F32));
    }
    write_bytes((folder / "bake.json").string(), bytes);
    const BakedLight light = load_bake(folder);
    require(!light.baked.levels.empty() && light.baked.irradiance.size > 0, "baked light without levels");
}

constexpr Target kTargets[] = {
    {"preset", "x.json", read_preset},     {"settings", "x.json", read_settings},
    {"recovery", "x.json", read_recovery}, {"comparison", "x.json", read_comparison},
    {"png", "x.png", read_picture},        {"jpeg", "x.jpg", read_picture},
    {"tiff", "x.tif", read_picture},       {"targa", "x.tga", read_picture},
    {"bmp", "x.bmp", read_picture},        {"exr", "x.exr", read_picture},
    {"hdr", "x.hdr", read_picture},        {"obj", "x.obj", read_mesh},
    {"ply", "x.ply", read_mesh},           {"off", "x.off", read_mesh},
    {"stl", "x.stl", read_mesh},           {"cache", "x.patina-ibl", read_cache},
    {"bake", "bake.json", read_bake},      {"kept", "x.patina-environment", read_environment_cache},
};

}  // namespace

std::span<const Target> targets() { return kTargets; }
const Target* find_target(std::string_view name) {
    for (const Target& target : kTargets)
        if (target.name == name) return &target;
    return nullptr;
}

void try_bytes(const Target& target, std::string_view bytes) {
    static const OwnFolder folder;
    try {
        target.read((folder.path / target.file).string(), bytes);
    } catch (const std::runtime_error& error) {
        const std::string sentence = error.what();
        if (sentence.empty() || sentence.find('\n') != std::string::npos)
            defect("an error is not one sentence: \"" + sentence + "\"");
    } catch (const std::exception& error) {
        defect(std::string("an exception of another kind: ") + error.what());
    }
}

}  // namespace patina::fuzz
