#include "app/reconcile_light.h"

#include "app/reconcile_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>
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

/// Rows share their solid angle, 2π (cos θ₀ − cos θ₁).
glm::vec3 mean_radiance(const Environment& environment) {
    glm::dvec3 sum(0.0);
    for (int y = 0; y < environment.height; ++y) {
        glm::dvec3 row(0.0);
        for (int x = 0; x < environment.width; ++x)
            row += glm::dvec3(environment.radiance[std::size_t(y) * environment.width + x]);
        const double upper = std::cos(std::numbers::pi * y / environment.height);
        const double lower = std::cos(std::numbers::pi * (y + 1) / environment.height);
        sum += row * (0.5 * (upper - lower) / environment.width);
    }
    return glm::vec3(sum);
}

float largest_radiance(const Environment& environment) {
    float largest = 0.0f;
    for (const glm::vec3& radiance : environment.radiance)
        largest = std::max({largest, radiance.x, radiance.y, radiance.z});
    return largest;
}

CubeMap one_texel(glm::vec3 radiance) { return {1, std::vector<glm::vec3>(6, radiance)}; }

HeldLight describe(const Environment& environment) {
    HeldLight held{.title = environment.title, .width = environment.width, .height = environment.height};
    held.max_radiance = largest_radiance(environment);
    held.mean = mean_radiance(environment);
    return held;
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

/// The source, where it has to be read, and what it brought along.
struct Source {
    std::shared_ptr<const Environment> environment;
    std::optional<BakedEnvironment> baked;
};

Source open_source(const Registry& registry, const LightOrder& order) {
    if (order.held && order.held->environment) return {order.held->environment, std::nullopt};
    LoadedLight loaded = load_light(registry, order.id);
    return {std::make_shared<Environment>(std::move(loaded.environment)), std::move(loaded.baked)};
}

/// What light is made from, and how.
struct LightTask {
    const Environment& environment;
    const LightOrder& order;
    const BakeSettings& settings;
    const BakeCache& cache;
    BakeControl control;
};

/// From the disk. False if it is not there.
bool take_what_is_there(const LightTask& task, HeldLight& held, ReadyLight& ready) {
    std::optional<BakedEnvironment> entry = load_baked(task.cache, bake_key(task.environment, task.settings));
    if (task.order.needed) {
        const BakeSettings wanted = lacking(held, *task.order.needed, task.settings);
        if (wanted.roughness.empty() && !wanted.irradiance) return true;
        if (entry) entry = selected(*entry, wanted);
    }
    if (!entry) return false;
    held.exact = std::move(*entry);
    ready.from_disk = true;
    return true;
}

/// False if it was stopped.
bool bake_what_is_missing(const LightTask& task, HeldLight& held, ReadyLight& ready) {
    if (task.order.first_light && !task.order.held) {
        auto coarse = bake_first_light(task.environment, task.settings, task.control);
        if (!coarse) return false;
        held.coarse = std::move(*coarse);
        ready.is_first_light = true;
        return true;
    }
    const BakeSettings wanted = lacking(held, task.order.needed.value_or(all_light()), task.settings);
    auto bake = cached_bake(task.environment, wanted, task.control, task.cache);
    if (!bake) return false;
    add_notes(ready.notes, bake->baked.notes);
    if (!bake->note.empty()) ready.notes.push_back(bake->note);
    ready.from_disk = bake->from_disk;
    ready.levels_baked = bake->levels_baked;
    ready.irradiance_baked = bake->irradiance_baked;
    held.exact = merged(held.exact, bake->baked);
    return true;
}

std::shared_ptr<const PreparedLight> prepare(const HeldLight& held, const Environment& environment,
                                             const LightOrder& order) {
    auto light = std::make_shared<PreparedLight>();
    if (order.drawn)
        light->panorama_of = order.drawn;
    else
        light->panorama = make_panorama_levels(environment);
    light->levels = make_light_levels(drawn_light(held));
    if (!held.is_whole) light->levels.sharpest = kSharpestLevel;
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

BakedEnvironment drawn_light(const HeldLight& held) {
    BakedEnvironment drawn = held.exact;
    const bool is_first = drawn.levels.empty();
    // Coarse levels hold all light: beside lights that were taken out it would count twice.
    if (is_first || drawn.lights.empty()) {
        for (const PrefilteredLevel& level : held.coarse.levels) {
            const auto same = [&](const PrefilteredLevel& each) { return each.roughness == level.roughness; };
            if ((is_first || level.roughness >= kCoarseIsFine) &&
                std::none_of(held.exact.levels.begin(), held.exact.levels.end(), same))
                drawn.levels.push_back(level);
        }
        std::stable_sort(drawn.levels.begin(), drawn.levels.end(),
                         [](const auto& a, const auto& b) { return a.roughness < b.roughness; });
    }
    if (drawn.levels.empty()) drawn.levels = {{kSharpestLevel, one_texel(held.mean)}};
    if (drawn.irradiance.size == 0) drawn.irradiance = held.coarse.irradiance;
    if (drawn.irradiance.size == 0) drawn.irradiance = one_texel(held.mean);
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
    Source source = open_source(registry, order);
    if (control.stop.stop_requested()) return std::nullopt;
    control.progress(kDecodeShare);
    const Environment& environment = *source.environment;
    HeldLight held = order.held ? *order.held : describe(environment);
    ReadyLight ready;
    if (!order.held) add_notes(ready.notes, environment.notes);
    LightTask task{environment, order, settings, cache, control};
    task.control.progress = [&](float fraction) { control.progress(kDecodeShare + kBakeShare * fraction); };
    if (source.baked) {
        held.exact = std::move(*source.baked);
        held.is_whole = ready.from_disk = true;
        add_notes(ready.notes, held.exact.notes);
    } else if (order.held || !take_what_is_there(task, held, ready)) {
        if (!bake_what_is_missing(task, held, ready)) return std::nullopt;
    }
    if (control.stop.stop_requested()) return std::nullopt;
    ready.light = prepare(held, environment, order);
    if (!held.is_whole && environment.radiance.size() <= kKeptTexels) held.environment = source.environment;
    ready.held = std::make_shared<HeldLight>(std::move(held));
    return ready;
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
