// Comparisons from and to text and disk: JSON version 1.
//
// Files are named relative to the comparison file with forward slashes, shipped presets by their name,
// built-in things by their id. A value keeps full paths; only the text has relative ones.
#pragma once

#include "renderer/core/comparison.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace patina {

inline constexpr int kComparisonVersion = 1;
inline constexpr std::string_view kComparisonSchema = "patina-comparison-1.schema.json";
inline constexpr std::size_t kMaxComparisonBytes = std::size_t{4} << 20;

struct LoadedComparison {
    Comparison comparison;
    std::vector<std::string>
        notes;  ///< what was tolerated: "NAME:LINE:COLUMN: /pointer …", one sentence each
};

/// Absent keys mean defaults; unknown keys are kept and noted; numbers out of range are clamped and noted.
/// Everything else that is wrong throws std::runtime_error "NAME:LINE:COLUMN: /pointer …". Files stay as
/// written.
LoadedComparison parse_comparison(std::string_view text, const std::string& name);
std::string to_json(const Comparison& comparison);

/// Files by full path, as seen from the comparison file; a name that is no file there stays what it is.
Comparison with_full_paths(Comparison comparison, const std::filesystem::path& file);
/// The opposite.
Comparison with_relative_paths(Comparison comparison, const std::filesystem::path& file);

LoadedComparison load_comparison(const std::filesystem::path& file);
/// Atomic.
void save_comparison(const std::filesystem::path& file, const Comparison& comparison);

/// Whether a JSON file says it is a comparison: by its $schema, or by its rows, columns or views. False for
/// what cannot be read.
bool is_comparison_file(const std::filesystem::path& file);

}  // namespace patina
