// What the editor remembers between two starts, as plain values and as JSON. Nothing in it is worth failing
// for: what cannot be read is left at its default, with a note.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace patina {

inline constexpr std::size_t kRecentFiles = 12;

struct Settings {
    int window_width = 1440;  ///< screen units
    int window_height = 900;
    bool maximized = false;
    std::string mesh = "sphere";
    std::string environment = "studio";
    std::vector<std::string> recent;               ///< presets by full path, newest first
    std::vector<std::string> opened_environments;  ///< files that were used, newest first
    std::vector<std::string> opened_meshes;
    std::string last_folder;  ///< where the file browser was
    float library_width = 244.0f;
    float inspector_width = 348.0f;
    float drawer_height = 190.0f;
    bool show_library = true;
    bool show_inspector = true;
    bool operator==(const Settings&) const = default;
};

struct ParsedSettings {
    Settings settings;
    std::vector<std::string> notes;  ///< one sentence for each thing that could not be taken over
};
/// Never throws.
ParsedSettings parse_settings(std::string_view text);
std::string to_json(const Settings& settings);

/// Never throws; a file that is not there is no note.
ParsedSettings load_settings(const std::filesystem::path& folder);
/// Atomic; makes the folder. Throws std::runtime_error with one sentence.
void save_settings(const std::filesystem::path& folder, const Settings& settings);

/// Puts a path at the front of such a list, once, and bounds the list.
void remember(std::vector<std::string>& list, const std::string& path, std::size_t limit = kRecentFiles);

}  // namespace patina
