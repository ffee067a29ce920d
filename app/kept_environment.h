// An environment as it is wanted the next time, in the cache folder: what is known of it and its panorama
// ready for the GPU. One that was seen before is neither decoded nor filtered. Pure but for the cache.
#pragma once

#include "renderer/core/environment.h"
#include "renderer/gl/panorama.h"
#include "renderer/ibl/cache_entry_io.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace patina {

struct EnvironmentFacts {
    std::string title;
    int width = 0, height = 0;  ///< of the source
    float max_radiance = 0.0f;
    glm::vec3 mean{0.0f};            ///< radiance over the sphere
    std::uint64_t content_hash = 0;  ///< Environment's
    std::vector<std::string> notes;  ///< what was put right while decoding
};
EnvironmentFacts facts_of(const Environment& environment);

struct KeptEnvironment {
    EnvironmentFacts facts;
    PanoramaLevels panorama;
};

/// fingerprint: EnvironmentSource's, of what the id stands for now.
std::string kept_key(const std::string& id, std::uint64_t fingerprint);

/// nullopt when absent, truncated, foreign, of another version or with a wrong checksum: then decode again.
std::optional<KeptEnvironment> load_kept(const BakeCache& cache, const std::string& key);

/// Empty, or where it cannot be kept a sentence that says why; of the cache's room one entry takes a quarter
/// at most.
std::string save_kept(const BakeCache& cache, const std::string& key, const EnvironmentFacts& facts,
                      const PanoramaLevels& panorama);

}  // namespace patina
