// Everything of the program that reads what a stranger wrote, as functions over bytes. Each ends well or
// throws std::runtime_error with one sentence; whatever else happens is a defect, and is reported by
// std::abort().
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace patina::fuzz {

struct Target {
    std::string_view name;  ///< also its folder in the corpus
    std::string_view file;  ///< what the bytes are called where a file is read
    void (*read)(const std::string& path, std::string_view bytes);
};
std::span<const Target> targets();
const Target* find_target(std::string_view name);

/// Reads the bytes by the target; keeps the files it needs in a folder of this process, removed at its end.
/// Aborts, after saying why, on a defect.
void try_bytes(const Target& target, std::string_view bytes);

}  // namespace patina::fuzz
