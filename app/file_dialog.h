// What the file browser lists: folders and files as they are, no opinion on types. Opens no file.
#pragma once

#include "ui/panel_context.h"

#include <filesystem>
#include <string>
#include <vector>

namespace patina {

struct FolderListing {
    std::string folder;  ///< absolute, '/'
    std::vector<ui::BrowserEntry> entries;
    std::string error;  ///< one sentence if it cannot be read
};
/// Never throws. Hidden files are left out.
FolderListing list_files(const std::filesystem::path& folder);

/// Home, its usual folders that exist, the file system's root or drives, removable media; then extra, each
/// once.
std::vector<ui::BrowserPlace> browser_places(const std::vector<ui::BrowserPlace>& extra);

/// The user's home folder, else the current one.
std::filesystem::path home_folder();

/// Shows a file or folder in the system's file manager. False if none could be started.
bool reveal_in_file_manager(const std::filesystem::path& path);

}  // namespace patina
