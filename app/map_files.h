// Maps made from a photo as files, and the material that wears them. Knows no window.
#pragma once

#include "materials/material.h"
#include "renderer/core/map_settings.h"
#include "renderer/maps/photo_maps.h"

#include <filesystem>
#include <string>
#include <vector>

namespace patina {

inline constexpr int kMapPhotoPx = 4096;  ///< larger photos are halved until no side is longer

/// Where the maps of that name lie; files of maps that are not chosen are empty. The height has no slot, but
/// goes with the normal map.
struct MapFiles {
    std::filesystem::path albedo, height, normal, roughness, ao;
    std::vector<std::filesystem::path> all() const;  ///< those that are not empty
};
/// FOLDER/NAME_albedo.png and so on.
MapFiles map_files(const std::filesystem::path& folder, const std::string& name, const MapChoice& choice);
/// name, else name-2, name-3 …, the first of which none of the files exists.
std::string free_map_name(const std::filesystem::path& folder, const std::string& name,
                          const MapChoice& choice);
/// Throws std::runtime_error that names the first of the files that exists.
void require_absent(const MapFiles& files);

/// All of them or none: written aside, then moved to their names. Makes the folder where it is missing.
/// source: what the files say they were made from.
void save_maps(const PhotoMaps& maps, const MapFiles& files, const std::string& source);

/// The material with those maps by full path in its slots, whose values become 1.
Material with_map_files(Material material, const MapFiles& files);

}  // namespace patina
