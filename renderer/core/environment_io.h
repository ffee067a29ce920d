// Environments from disk: any picture image_io reads, and the HDR panoramas that Blender installs.
#pragma once

#include "renderer/core/environment.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace patina {

/// The picture as a full panorama; its id is the path as UTF-8, its title the file's name without extension.
/// What the picture's loader tolerated comes first in notes. Throws as load_image does.
Environment load_environment_file(const std::filesystem::path& file);

/// Of the file's bytes as they are, read but not decoded; nullopt where it cannot be read.
std::optional<std::uint64_t> environment_file_hash(const std::filesystem::path& file);

struct EnvironmentFile {
    std::string id;     ///< "blender-city"
    std::string title;  ///< "City (Blender)"
    std::filesystem::path file;
};

/// Blender's studio-light panoramas where Blender is installed, by name; opens no file.
std::vector<EnvironmentFile> list_blender_studio_lights();
/// The same below the given folders: FOLDER[/*[/*]]/datafiles/studiolights/world/*.{exr,hdr}; the first of a
/// name wins.
std::vector<EnvironmentFile> list_blender_studio_lights(std::span<const std::filesystem::path> folders);

}  // namespace patina
