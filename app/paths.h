// Where the program finds and keeps things: shipped data, cache, state. Only names folders; creates none.
#pragma once

#include <filesystem>
#include <string>

namespace patina {

/// Shipped presets and data: PATINA_SHARE_DIR, else ../share/patina beside the executable's folder.
std::filesystem::path share_folder();
/// Things that can be made again (baked light, thumbnails): PATINA_CACHE_DIR, else XDG_CACHE_HOME/patina,
/// ~/.cache/patina,
/// ~/Library/Caches/patina or %LOCALAPPDATA%\patina\cache.
std::filesystem::path cache_folder();
/// Things that must not be lost (recovery file, settings): PATINA_STATE_DIR, else XDG_STATE_HOME/patina,
/// ~/.local/state/patina, ~/Library/Application Support/patina or %LOCALAPPDATA%\patina\state.
std::filesystem::path state_folder();

/// For names of further files: what the file is called, with '_' for all but letters, digits, '-' and what is
/// not ASCII; otherwise where nothing is left.
std::string plain_stem(const std::filesystem::path& file, const std::string& otherwise);

}  // namespace patina
