#include "app/reconcile_light.h"

#include "app/reconcile_plan.h"

#include <algorithm>
#include <utility>

namespace patina {

namespace {

constexpr std::size_t kKeptTexels = std::size_t{2048} * 1024;  ///< of an environment kept for adding levels
constexpr float kCoarseIsFine = 0.4f;                          ///< first light differs little from there on
constexpr float kDecodeShare = 0.1f, kBakeShare = 0.85f;       ///< of the progress

std::vector<float> roughness_of(const std::vector<PrefilteredLevel>& levels) {
    std::vector<float> roughness;
    roughness.reserve(levels.size());
    for (const PrefilteredLevel& level : levels) roughness.push_back(level.roughness);
    return roughness;
}

std::size_t amount(const HeldLight& held) {
    return 2 * held.exact.levels.size() + (held.exact.irradiance.size > 0 ? 1 : 0);
}

/// As part of a key.
std::string describe(const BakeSettings& added) {
    std::string text = added.irradiance ? "E" : "";
    for (const float roughness : added.roughness) text += " " + std::to_string(roughness);
    return text + ";";
}

void add_notes(std::vector<std::string>& notes, const std::vector<std::string>& more) {
    notes.insert(notes.end(), more.begin(), more.end());
}

/// One light, while it is made.
struct LightTask {
    const Registry& registry;
    const LightOrder& order;
    const BakeSettings& settings;
    const BakeCache& cache;
    BakeControl control;
    HeldLight held = {};
    ReadyLight ready = {};
    std::shared_ptr<const Environment> environment = {};  ///< once it is decoded
    std::optional<PanoramaLevels> panorama = {};          ///< if it was kept
};

void decode(LightTask& task) {
    LoadedLight loaded = load_light(task.registry, task.order.id);
    task.environment = std::make_shared<Environment>(std::move(loaded.environment));
    task.ready.decoded = true;
    if (!loaded.baked || task.order.held) return;
    task.held.exact = std::move(*loaded.baked);
    task.held.exact.levels = close_gaps(std::move(task.held.exact.levels));
    task.held.is_whole = task.ready.from_disk = true;
}

/// What is known of the source: it is held, was kept, or is decoded.
void begin(LightTask& task) {
    HeldLight& held = task.held;
    ReadyLight& ready = task.ready;
    if (task.order.held) {
        held = *task.order.held;
        task.environment = held.environment;
        return;
    }
    const auto fingerprint =
        task.order.skip ? environment_fingerprint(task.registry, task.order.id) : std::nullopt;
    if (fingerprint) ready.keep_as = kept_key(task.order.id, *fingerprint);
    if (std::optional<KeptEnvironment> kept =
            fingerprint ? load_kept(task.cache, ready.keep_as) : std::nullopt) {
        held.source = std::move(kept->facts);
        task.panorama = std::move(kept->panorama);
        ready.was_kept = true;
        ready.keep_as.clear();
    } else {
        decode(task);
        held.source = facts_of(*task.environment);
    }
    add_notes(ready.notes, held.source.notes);
    add_notes(ready.notes, held.exact.notes);
}

/// From the disk. False if it is not there.
bool take_what_is_there(LightTask& task) {
    HeldLight& held = task.held;
    const std::optional<NeededLight>& needed = task.order.needed;
    const BakeSettings wanted = needed ? lacking(held, *needed, task.settings) : task.settings;
    if (needed && wanted.roughness.empty() && !wanted.irradiance) return true;
    const std::string key =
        bake_key(held.source.content_hash, {held.source.width, held.source.height}, task.settings);
    std::optional<BakedEnvironment> entry = load_baked(task.cache, key);
    if (!entry || (needed && !holds(*entry, wanted))) return false;
    held.exact =
        merged(std::move(held.exact), needed ? selected(std::move(*entry), wanted) : std::move(*entry));
    task.ready.from_disk = true;
    return true;
}

/// False if it was stopped.
bool bake_what_is_missing(LightTask& task) {
    HeldLight& held = task.held;
    ReadyLight& ready = task.ready;
    if (!task.environment) decode(task);
    if (task.order.first_light && !task.order.held) {
        auto coarse = bake_first_light(*task.environment, task.settings, task.control);
        if (!coarse) return false;
        held.coarse = std::move(*coarse);
        ready.is_first_light = true;
        return true;
    }
    const BakeSettings wanted = lacking(held, task.order.needed.value_or(all_light()), task.settings);
    auto bake = cached_bake(*task.environment, wanted, task.control, task.cache);
    if (!bake) return false;
    add_notes(ready.notes, bake->baked.notes);
    if (!bake->note.empty()) ready.notes.push_back(bake->note);
    ready.from_disk = bake->from_disk;
    ready.levels_baked = bake->levels_baked;
    ready.irradiance_baked = bake->irradiance_baked;
    held.exact = merged(std::move(held.exact), std::move(bake->baked));
    return true;
}

std::shared_ptr<const PreparedLight> prepare(LightTask& task) {
    auto light = std::make_shared<PreparedLight>();
    if (task.order.drawn) {
        light->panorama_of = task.order.drawn;
    } else if (task.panorama) {
        light->panorama = std::move(*task.panorama);
    } else {
        if (!task.environment) decode(task);
        light->panorama = make_panorama_levels(*task.environment);
    }
    const BakedEnvironment mean = mean_light(task.held);
    light->levels = make_light_levels(drawn_light(task.held, mean), task.control.parallel_for);
    if (!task.held.is_whole) light->levels.sharpest = kSharpestLevel;
    return light;
}

}  // namespace

bool serves(const HeldLight& held, const NeededLight& needed) {
    if (held.is_whole) return true;
    return (!needed.irradiance || held.exact.irradiance.size > 0) &&
           missing_levels(needed, roughness_of(held.exact.levels)).empty();
}

BakeSettings lacking(const HeldLight& held, const NeededLight& needed, const BakeSettings& settings) {
    BakeSettings rest = settings;
    rest.roughness = missing_levels(needed, roughness_of(held.exact.levels));
    rest.irradiance = needed.irradiance && held.exact.irradiance.size == 0;
    return rest;
}

BakedEnvironment mean_light(const HeldLight& held) {
    const CubeMap mean{1, std::vector<glm::vec3>(6, held.source.mean)};
    return {.levels = {{kSharpestLevel, mean}}, .irradiance = mean};
}

LightView drawn_light(const HeldLight& held, const BakedEnvironment& mean) {
    LightView drawn = view_of(held.exact);
    const bool is_first = drawn.levels.empty();
    if (is_first) drawn.lights = held.coarse.lights;
    // Beside others, coarse levels must have all light: what was taken out of either would count twice, or
    // not.
    if (is_first || (drawn.lights.empty() && held.coarse.lights.empty())) {
        for (const PrefilteredLevel& level : held.coarse.levels) {
            const auto same = [&](const PrefilteredLevel& each) { return each.roughness == level.roughness; };
            if ((is_first || level.roughness >= kCoarseIsFine) &&
                std::none_of(held.exact.levels.begin(), held.exact.levels.end(), same))
                drawn.levels.push_back(&level);
        }
        std::ranges::stable_sort(drawn.levels, {}, &PrefilteredLevel::roughness);
    }
    if (drawn.levels.empty()) drawn.levels.push_back(&mean.levels.front());
    if (drawn.irradiance->size == 0) drawn.irradiance = &held.coarse.irradiance;
    if (drawn.irradiance->size == 0) drawn.irradiance = &mean.irradiance;
    return drawn;
}

LightWish wish_for_light(LightOrder order, const std::string& base, const std::vector<LightAtHand>& at_hand,
                         const BakeSettings& settings) {
    const auto more = [](const LightAtHand& a, const LightAtHand& b) {
        return amount(*a.held) < amount(*b.held);
    };
    const auto best = std::max_element(at_hand.begin(), at_hand.end(), more);
    if (best == at_hand.end()) return {base + kVersionMark, std::move(order)};
    if (!order.needed || serves(*best->held, *order.needed)) return {best->key, std::nullopt};
    order.held = best->held;
    order.drawn = best->drawn;
    const BakeSettings added = lacking(*best->held, *order.needed, settings);
    return {best->key + describe(added), std::move(order)};
}

std::optional<ReadyLight> get_light(const Registry& registry, const LightOrder& order,
                                    const BakeSettings& settings, const BakeCache& cache,
                                    const BakeControl& control) {
    LightTask task{registry, order, settings, cache, control};
    task.control.progress = [&](float fraction) { control.progress(kDecodeShare + kBakeShare * fraction); };
    begin(task);
    if (control.stop.stop_requested()) return std::nullopt;
    control.progress(kDecodeShare);
    // With the texels of what is held at hand, baking looks on the disk itself.
    const bool is_there =
        task.held.is_whole || ((!order.held || !task.environment) && take_what_is_there(task));
    if (!is_there && !bake_what_is_missing(task)) return std::nullopt;
    if (control.stop.stop_requested()) return std::nullopt;
    ReadyLight ready = std::move(task.ready);
    ready.light = prepare(task);
    const bool is_small = task.environment && task.environment->radiance.size() <= kKeptTexels;
    if (!task.held.is_whole && is_small) task.held.environment = task.environment;
    ready.held = std::make_shared<HeldLight>(std::move(task.held));
    return ready;
}

std::string keep_light(const Registry& registry, const LightOrder& order, const ReadyLight& ready,
                       const PreparedLight& light, const BakeCache& cache) {
    if (ready.keep_as.empty()) return {};
    const auto now = environment_fingerprint(registry, order.id);
    if (!now || kept_key(order.id, *now) != ready.keep_as)
        return order.id + " was changed while it was read.";
    std::string why_not = save_kept(cache, ready.keep_as, ready.held->source, light.panorama);
    return std::ranges::find(ready.notes, why_not) == ready.notes.end() ? why_not : std::string();
}

std::uint64_t bytes_of(const HeldLight& held) {
    std::uint64_t texels = held.environment ? held.environment->radiance.size() : 0;
    for (const BakedEnvironment* baked : {&held.exact, &held.coarse}) {
        texels += baked->irradiance.texels.size();
        for (const PrefilteredLevel& level : baked->levels) texels += level.cube.texels.size();
    }
    return texels * sizeof(glm::vec3);
}

}  // namespace patina
