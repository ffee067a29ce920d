// Presets from and to disk: JSON version 1, and where the maps they name lie. Knows no picture: a map is only
// a path.
//
// A map's path is UTF-8 text with forward slashes, relative to the folder of the preset that names it (the
// preset as it was opened, not what a symbolic link points to); an absolute path is used as it is.
// Backslashes, as Windows writes them, are taken as slashes unless a file of exactly that name exists. A web
// address (http://, file://, …) is never fetched: it is noted, kept, and shown as a missing map.
#pragma once

#include "materials/material.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace patina {

inline constexpr int kPresetVersion = 1;
inline constexpr std::string_view kPresetSchema = "patina-material-1.schema.json";
inline constexpr std::size_t kMaxPresetBytes = std::size_t{4} << 20;

struct LoadedMaterial {
    Material material;
    std::vector<std::string>
        notes;  ///< what was tolerated: "NAME:LINE:COLUMN: /pointer …", one sentence each
};

/// Absent keys mean defaults; unknown keys are kept and noted; numbers out of range are clamped and noted.
/// Everything else that is wrong throws std::runtime_error "NAME:LINE:COLUMN: /pointer …".
LoadedMaterial parse_material(std::string_view text, const std::string& name);

/// The preset's text in its canonical form: every parameter is written, so that a later default cannot change
/// the look.
std::string to_json(const Material& material);

LoadedMaterial load_material(const std::filesystem::path& file);
void save_material(const std::filesystem::path& file, const Material& material);

/// True for "http://…", "file:…" and the like; a drive letter is none.
bool is_web_address(std::string_view map);

/// Where the map lies; empty for no map and for a web address. An empty preset_file (not saved yet) means the
/// current folder.
std::filesystem::path resolve_map(const std::filesystem::path& preset_file, std::string_view map);

/// The text by which a preset names that file: relative where there is a way, else absolute. An empty
/// preset_file gives an absolute path.
std::string relative_map(const std::filesystem::path& preset_file, const std::filesystem::path& map_file);

/// The material with its relative map paths rewritten so that a preset at `to` finds the maps that one at
/// `from` names.
Material rebase_maps(Material material, const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace patina
