// Whole files in and out of memory, with errors as one sentence that names the file and the way out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace patina {

/// The path as UTF-8 text, for messages and for libraries that take UTF-8.
std::string path_text(const std::filesystem::path& file);

/// The first max_bytes of a regular file (all of it where it is shorter). Throws std::runtime_error: missing,
/// a folder, not permitted, unreadable.
std::vector<std::byte> read_file(const std::filesystem::path& file,
                                 std::uint64_t max_bytes = ~std::uint64_t{0});

/// Writes to a temporary file in the same folder, flushes it to the disk and renames it over file: a reader
/// sees the old or the new contents, never a part. Symbolic links are followed. Throws std::runtime_error
/// and leaves nothing behind when that fails.
void write_file(const std::filesystem::path& file, std::span<const std::byte> bytes);

}  // namespace patina
