// Baked light on disk: content-addressed, bounded, never trusted. The only file access in renderer/ibl.
#pragma once

#include "renderer/ibl/bake.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace patina {

struct BakeCache {
    std::filesystem::path folder;                        ///< created when first written
    std::uint64_t max_bytes = std::uint64_t{512} << 20;  ///< oldest entries are removed beyond this
};

/// Key over the environment's content hash, the settings and the baker's version.
std::string bake_key(const Environment& environment, const BakeSettings& settings);

/// nullopt when absent, truncated, foreign, of another version or with a wrong checksum: then bake again.
std::optional<BakedEnvironment> load_baked(const BakeCache& cache, const std::string& key);

/// Temporary file, then rename. A folder that cannot be written is no error (returns a sentence that says so,
/// else empty).
std::string save_baked(const BakeCache& cache, const std::string& key, const BakedEnvironment& baked);

struct CachedBake {
    BakedEnvironment baked;
    bool from_disk = false;
    std::string note;  ///< why the result could not be kept, if so
};
/// Load, or bake and save. nullopt only when stopped.
std::optional<CachedBake> cached_bake(const Environment& environment, const BakeSettings& settings,
                                      const BakeControl& control, const BakeCache& cache);

}  // namespace patina
