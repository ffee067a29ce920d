// Plots on disk.
#pragma once

#include "app/plot.h"

#include <filesystem>

namespace patina {

/// Writes STEM.svg and STEM.png (each atomically) and gives their paths. Throws std::runtime_error with one
/// sentence.
std::vector<std::filesystem::path> save_plot(const std::filesystem::path& stem, const Plot& plot);

}  // namespace patina
