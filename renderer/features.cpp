#include "renderer/features.h"

#include "renderer/brdf.h"

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

    {Feature::Course, "HAS_COURSE"},
    {Feature::Debug, "HAS_DEBUG"},
    {Feature::Fitted, "HAS_FITTED"},
    {Feature::FourLevels, "HAS_FOUR_LEVELS"},
};
constexpr Features kAll = (1u << 12) - 1;

/// With all that they imply. Debug views are looked at one at a time and may share what costs nothing but
/// time.
Features completed(Features features) {
    if (has(features, Feature::Debug)) features |= Features(Feature::Sharp) | Features(Feature::Emission);
    if (has(features, Feature::EmissionMap)) features |= Features(Feature::Emission);
    if (has(features, Feature::Course))
        features &= ~(Features(Feature::Fitted) | Features(Feature::FourLevels));
    if (!has(features, Feature::Fitted)) features &= ~Features(Feature::FourLevels);
    return features;
}

}  // namespace

Features features_of(const Material& material, const MapRanges& maps, const View& view,
                     float sharpest_roughness) {
    Features features = 0;
    const auto add = [&](bool wanted, Feature feature) {
        if (wanted) features |= Features(feature);
    };
    const auto is_bound = [&](MapSlot slot) { return maps[std::size_t(slot)].has_value(); };
    const bool emits = material.emission.value != glm::vec3(0.0f);
    add(is_bound(MapSlot::Albedo) && material.albedo.value != glm::vec3(0.0f), Feature::AlbedoMap);
    add(is_bound(MapSlot::Roughness) && material.roughness.value != 0.0f, Feature::RoughnessMap);
    add(is_bound(MapSlot::Metallic) && material.metallic.value != 0.0f, Feature::MetallicMap);
    add(is_bound(MapSlot::Ao) && material.ao.value != 0.0f, Feature::AoMap);
    add(is_bound(MapSlot::Normal) && material.normal.value != 0.0f, Feature::NormalMap);
    add(is_bound(MapSlot::Emission) && emits, Feature::EmissionMap);
    add(emits, Feature::Emission);
    // What is drawn where the reference is not there yet.
    const bool fitted = view.shading == Shading::Fitted || view.shading == Shading::Reference;
    const float reach = fitted ? brdf::kCoreReach : 1.0f;
    const ValueRange roughness = scalar_range(material.roughness, maps[std::size_t(MapSlot::Roughness)]);
    add(roughness.low < reach * sharpest_roughness, Feature::Sharp);
    add(view.shading == Shading::Course, Feature::Course);
    add(fitted, Feature::Fitted);
    add(fitted && view.quality == Quality::High, Feature::FourLevels);
    add(view.debug != DebugView::Final, Feature::Debug);
    return completed(features);
}

Features reference_features(Features features) {
    Features read = 0;
    for (const Feature feature :
         {Feature::AlbedoMap, Feature::RoughnessMap, Feature::MetallicMap, Feature::AoMap, Feature::NormalMap,
          Feature::EmissionMap, Feature::Emission})
        read |= features & Features(feature);
    return read;
}

std::vector<Features> all_features() {
    std::vector<Features> result;
    for (Features features = 0; features <= kAll; ++features) {
        if (completed(features) == features) result.push_back(features);
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
