#include "app/map_files.h"

#include "app/studio.h"
#include "materials/text_io.h"
#include "renderer/core/image_io.h"

#include <array>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace patina {

namespace fs = std::filesystem;

namespace {

/// A folder beside the files' own that goes with what is left in it.
class Aside {
public:
    explicit Aside(const fs::path& folder) : path_(folder / ".maps.patina-part") {
        std::error_code error;
        fs::remove_all(path_, error);
        if (!fs::create_directories(path_, error))
            throw std::runtime_error(path_to_utf8(folder) + ": cannot be written to (" + error.message() +
                                     "); choose a folder that you may write to");
    }
    ~Aside() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    Aside(const Aside&) = delete;
    Aside& operator=(const Aside&) = delete;
    fs::path of(const fs::path& file) const { return path_ / file.filename(); }

private:
    fs::path path_;
};

struct MapFile {
    const Image* image;
    fs::path file;
    std::string what;
};
std::vector<MapFile> map_list(const PhotoMaps& maps, const MapFiles& files) {
    std::array<char, 64> depth{};
    std::snprintf(depth.data(), depth.size(), "Height, %.5f widths from black to white",
                  static_cast<double>(maps.depth));
    std::vector<MapFile> list;
    for (MapFile& each : std::array{MapFile{&maps.albedo, files.albedo, "Albedo"},
                                    MapFile{&maps.height, files.height, depth.data()},
                                    MapFile{&maps.normal, files.normal, "Normals, +Y up (OpenGL)"},
                                    MapFile{&maps.roughness, files.roughness, "Roughness, an estimate"},
                                    MapFile{&maps.ao, files.ao, "Ambient occlusion"}})
        if (!each.file.empty()) list.push_back(std::move(each));
    return list;
}

}  // namespace

std::vector<fs::path> MapFiles::all() const {
    std::vector<fs::path> files;
    for (const fs::path& file : {albedo, height, normal, roughness, ao})
        if (!file.empty()) files.push_back(file);
    return files;
}

MapFiles map_files(const fs::path& folder, const std::string& name, const MapChoice& choice) {
    const auto file = [&](bool chosen, const char* role) {
        return chosen ? folder / utf8_to_path(name + "_" + role + ".png") : fs::path();
    };
    return {file(choice.albedo, "albedo"), file(choice.normal, "height"), file(choice.normal, "normal"),
            file(choice.roughness, "roughness"), file(choice.ao, "ao")};
}

std::string free_map_name(const fs::path& folder, const std::string& name, const MapChoice& choice) {
    const auto taken = [&](const std::string& candidate) {
        for (const fs::path& file : map_files(folder, candidate, choice).all())
            if (std::error_code ignored; fs::exists(fs::symlink_status(file, ignored))) return true;
        return false;
    };
    std::string candidate = name;
    for (int number = 2; taken(candidate); ++number) candidate = name + "-" + std::to_string(number);
    return candidate;
}

void require_absent(const MapFiles& files) {
    for (const fs::path& file : files.all())
        if (std::error_code ignored; fs::exists(fs::symlink_status(file, ignored)))
            throw std::runtime_error(path_to_utf8(file) +
                                     ": exists already; choose another name, or --force to replace it");
}

void save_maps(const PhotoMaps& maps, const MapFiles& files, const std::string& source) {
    const std::vector<MapFile> list = map_list(maps, files);
    if (list.empty()) return;
    const fs::path folder = list.front().file.parent_path();
    const Aside aside(folder.empty() ? fs::path(".") : folder);
    for (const MapFile& each : list)
        save_image(aside.of(each.file), *each.image, described(each.what + ", made from " + source));
    for (const MapFile& each : list) {
        std::error_code error;
        fs::rename(aside.of(each.file), each.file, error);
        if (error)
            throw std::runtime_error(path_to_utf8(each.file) + ": cannot be written (" + error.message() +
                                     "); choose another name or folder");
    }
}

Material with_map_files(Material material, const MapFiles& files) {
    if (!files.albedo.empty())
        material.albedo = {.value = glm::vec3(1.0f), .map = path_to_utf8(files.albedo)};
    const auto scalar = [](ScalarSlot& slot, const fs::path& file) {
        if (!file.empty()) slot = {.value = 1.0f, .map = path_to_utf8(file), .channel = Channel::R};
    };
    scalar(material.roughness, files.roughness);
    scalar(material.ao, files.ao);
    if (!files.normal.empty()) material.normal = {.value = 1.0f, .map = path_to_utf8(files.normal)};
    return material;
}

}  // namespace patina
