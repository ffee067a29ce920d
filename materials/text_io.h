// Whole text files from and to disk: bounded reading, atomic writing, and paths as UTF-8 text. Knows nothing
// of what the text means. Every failure is a std::runtime_error with one sentence that names the file and the
// way out.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace patina {

/// UTF-8 and forward slashes ↔ the system's own path.
std::string path_to_utf8(const std::filesystem::path& path);
std::filesystem::path utf8_to_path(std::string_view text);

/// The whole of a regular file of at most max_bytes.
std::string load_text(const std::filesystem::path& file, std::size_t max_bytes);

/// Replaces the file's contents in one step: a temporary file in the same folder, flushed to the disk, then
/// renamed over it. Whatever goes wrong, the old file stays as it was and no temporary file is left. A
/// symbolic link stays a link: the file it points to is replaced. The permissions of an existing file are
/// kept.
void save_text(const std::filesystem::path& file, std::string_view text);

}  // namespace patina
