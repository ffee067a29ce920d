// Light on demand: what is held of an environment, whether a picture finds all it looks up there, and the
// worker's part of getting what is missing. Pure but for the files it reads; knows no document.
//
// Held light grows: levels are added to it, none is baked twice. What is missing is stood in for by the
// nearest there is, at first by a first light of few degrees.
#pragma once

#include "app/kept_environment.h"
#include "app/registry.h"
#include "renderer/ibl/cache.h"
#include "renderer/needed_light.h"
#include "renderer/renderer.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace patina {

struct HeldLight {
    EnvironmentFacts source;
    BakedEnvironment exact;                          ///< levels and irradiance as they were asked for
    BakedEnvironment coarse;                         ///< first light; empty where there was no need for one
    bool is_whole = false;                           ///< the source came with its levels: there are no others
    std::shared_ptr<const Environment> environment;  ///< for adding levels; none where it is decoded again
};

/// True if everything needed is exact.
bool serves(const HeldLight& held, const NeededLight& needed);
/// What of the settings is not there yet.
BakeSettings lacking(const HeldLight& held, const NeededLight& needed, const BakeSettings& settings);
/// What stands in where there is nothing: one texel of the mean as a level and as irradiance.
BakedEnvironment mean_light(const HeldLight& held);
/// What is drawn with: exact levels, between and beyond them coarse ones where those are nearly as good;
/// mean, the mean_light, where there is nothing. Always has a level and an irradiance.
LightView drawn_light(const HeldLight& held, const BakedEnvironment& mean);

struct LightOrder {
    std::string id;
    std::optional<NeededLight> needed;           ///< none: not known yet, whatever is there will do
    std::shared_ptr<const HeldLight> held = {};  ///< to be added to; none: nothing is there
    EnvironmentHandle drawn = {};                ///< held's, whose panorama is used again
    bool first_light = false;  ///< where nothing is held or on disk, a first light is enough for now
    bool skip = true;          ///< false: decodes what lies on disk ready for use, for comparison
};

/// Light of one environment that is there already.
struct LightAtHand {
    std::string key;
    std::shared_ptr<const HeldLight> held;
    EnvironmentHandle drawn;
};
/// Which key to want, and the order to fill where nothing by that key is there.
struct LightWish {
    std::string key;
    std::optional<LightOrder> order;
};
/// What is at hand if it serves, or if nothing is known of what is needed; otherwise what is to be made of
/// it. order: without held and drawn. base: what all keys of this environment begin with (reconcile_plan.h).
LightWish wish_for_light(LightOrder order, const std::string& base, const std::vector<LightAtHand>& at_hand,
                         const BakeSettings& settings);

struct ReadyLight {
    std::shared_ptr<const HeldLight> held;
    std::shared_ptr<const PreparedLight> light;
    bool from_disk = false;  ///< something was, and nothing had to be baked
    bool decoded = false;    ///< the source was
    bool was_kept = false;   ///< the panorama lay on disk, ready for use
    std::string keep_as;     ///< for keep_light; empty: it is there, or what it stands for cannot be told
    bool is_first_light = false;
    int levels_baked = 0;
    bool irradiance_baked = false;
    std::vector<std::string> notes;
};

/// nullopt only when stopped. Throws std::runtime_error with one sentence.
std::optional<ReadyLight> get_light(const Registry& registry, const LightOrder& order,
                                    const BakeSettings& settings, const BakeCache& cache,
                                    const BakeControl& control);

/// Keeps what was decoded for the next time, unless the source was changed meanwhile. Empty, or a sentence
/// for the user that says why it could not be kept, if ready's notes do not say so already. light: ready's.
std::string keep_light(const Registry& registry, const LightOrder& order, const ReadyLight& ready,
                       const PreparedLight& light, const BakeCache& cache);

/// In memory, textures and what is kept beside them.
std::uint64_t bytes_of(const HeldLight& held);

}  // namespace patina
