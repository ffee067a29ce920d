#include "renderer/features.h"

#include <utility>

namespace patina {

namespace {

constexpr std::pair<Feature, const char*> kDefines[] = {
    {Feature::AlbedoMap, "HAS_ALBEDO_MAP"},
    {Feature::RoughnessMap, "HAS_ROUGHNESS_MAP"},
    {Feature::MetallicMap, "HAS_METALLIC_MAP"},
    {Feature::AoMap, "HAS_AO_MAP"},
    {Feature::NormalMap, "HAS_NORMAL_MAP"},
    {Feature::EmissionMap, "HAS_EMISSION_MAP"},
    {Feature::Emission, "HAS_EMISSION"},
    {Feature::Sharp, "HAS_SHARP"},
    {Feature::Lights, "HAS_LIGHTS"},
    {Feature::Course, "HAS_COURSE"},
    {Feature::Debug, "HAS_DEBUG"},
};
constexpr Features kAll = (1u << 11) - 1;

constexpr Features kSharedByDebugViews =
    Features(Feature::Sharp) | Features(Feature::Lights) | Features(Feature::Emission);

/// Debug views are looked at one at a time: they share what costs nothing but time.
Features shared_for_debug(Features features) {
    return has(features, Feature::Debug) ? features | kSharedByDebugViews : features;
}

}  // namespace

Features features_of(const Material& material, const std::bitset<kMapSlots>& bound, const View& view,
                     const LightTraits& light) {
    Features features = 0;
    const auto add = [&](bool wanted, Feature feature) {
        if (wanted) features |= Features(feature);
    };
    const auto is_bound = [&](MapSlot slot) { return bound[std::size_t(slot)]; };
    const bool emits = material.emission.value != glm::vec3(0.0f);
    const bool rough_map = is_bound(MapSlot::Roughness) && material.roughness.value != 0.0f;
    add(is_bound(MapSlot::Albedo) && material.albedo.value != glm::vec3(0.0f), Feature::AlbedoMap);
    add(rough_map, Feature::RoughnessMap);
    add(is_bound(MapSlot::Metallic) && material.metallic.value != 0.0f, Feature::MetallicMap);
    add(is_bound(MapSlot::Ao) && material.ao.value != 0.0f, Feature::AoMap);
    add(is_bound(MapSlot::Normal) && material.normal.value != 0.0f, Feature::NormalMap);
    add(is_bound(MapSlot::Emission) && emits, Feature::EmissionMap);
    add(emits, Feature::Emission);
    add(light.sharpest_roughness > 0.0f && (rough_map || material.roughness.value < light.sharpest_roughness),
        Feature::Sharp);
    add(light.has_lights, Feature::Lights);
    add(view.shading == Shading::Course, Feature::Course);
    add(view.debug != DebugView::Final, Feature::Debug);
    return shared_for_debug(features);
}

std::vector<Features> all_features() {
    std::vector<Features> result;
    for (Features features = 0; features <= kAll; ++features) {
        const bool reachable = shared_for_debug(features) == features &&
                               (!has(features, Feature::EmissionMap) || has(features, Feature::Emission));
        if (reachable) result.push_back(features);
    }
    return result;
}

std::vector<std::string> defines_of(Features features) {
    std::vector<std::string> defines;
    for (const auto& [feature, define] : kDefines)
        if (has(features, feature)) defines.emplace_back(define);
    return defines;
}

bool is_data_view(DebugView view) {
    switch (view) {
        case DebugView::Final:
        case DebugView::Diffuse:
        case DebugView::Specular:
        case DebugView::Emission:
            return false;
        default:
            return true;
    }
}

}  // namespace patina
