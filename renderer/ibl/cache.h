// Baked light on disk: content-addressed, bounded, never trusted.
#pragma once

#include "renderer/ibl/bake.h"
#include "renderer/ibl/cache_entry_io.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace patina {

/// Key over the environment's content hash, the settings and the baker's version. Which levels are asked for
/// and whether irradiance is, does not enter (unless their sizes are given): one entry holds what was ever
/// baked of an environment, and grows.
std::string bake_key(const Environment& environment, const BakeSettings& settings);
/// The same of an environment that is known by its content_hash and size alone.
std::string bake_key(std::uint64_t content_hash, glm::ivec2 size_px, const BakeSettings& settings);

/// nullopt when absent, truncated, foreign, of another version or with a wrong checksum: then bake again.
std::optional<BakedEnvironment> load_baked(const BakeCache& cache, const std::string& key);

/// Temporary file, then rename. A folder that cannot be written is no error (returns a sentence that says so,
/// else empty).
std::string save_baked(const BakeCache& cache, const std::string& key, const BakedEnvironment& baked);

/// Whether an entry holds the settings' levels and irradiance.
bool holds(const BakedEnvironment& entry, const BakeSettings& settings);
/// These, nothing else. Precondition: it holds them.
BakedEnvironment selected(BakedEnvironment entry, const BakeSettings& settings);
/// The settings of what an entry lacks.
BakeSettings lacking(const BakedEnvironment& entry, const BakeSettings& settings);
/// What either holds; where both hold a level, added's. Precondition: the same environment and settings but
/// for what was asked for.
BakedEnvironment merged(BakedEnvironment entry, BakedEnvironment added);

struct CachedBake {
    BakedEnvironment baked;
    bool from_disk = false;  ///< nothing had to be baked
    int levels_baked = 0;
    bool irradiance_baked = false;
    std::string note;  ///< why the result could not be kept, if so
};
/// Load, or bake what is not there and save. nullopt only when stopped.
std::optional<CachedBake> cached_bake(const Environment& environment, const BakeSettings& settings,
                                      const BakeControl& control, const BakeCache& cache);

}  // namespace patina
