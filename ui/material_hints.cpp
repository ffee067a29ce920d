#include "ui/material_hints.h"

#include "renderer/core/image.h"

namespace patina::ui {
namespace {

// Measured surfaces, in 8-bit sRGB codes of their luminance: charcoal is about 30, fresh snow 243; bare
// metals reflect from about 180 on.
constexpr float kDarkest = 30.0f, kBrightest = 243.0f, kDarkestMetal = 180.0f;
constexpr float kMetal = 0.9f, kNoMetal = 0.1f;

float srgb_code_of_luminance(const glm::vec3& linear) {
    return 255.0f * linear_to_srgb(0.2126f * linear.x + 0.7152f * linear.y + 0.0722f * linear.z);
}

}  // namespace

std::string_view albedo_hint(const Material& material) {
    if (!material.albedo.map.empty() || !material.metallic.map.empty()) return {};
    const float code = srgb_code_of_luminance(material.albedo.value);
    if (material.metallic.value >= kMetal)
        return code < kDarkestMetal ? "Darker than any bare metal: real ones are above sRGB 180." : "";
    if (material.metallic.value > kNoMetal) return {};
    if (code < kDarkest) return "Darker than charcoal: real surfaces stay above sRGB 30.";
    if (code > kBrightest) return "Brighter than fresh snow: real surfaces stay below sRGB 243.";
    return {};
}

std::string_view metallic_hint(const Material& material) {
    const float value = material.metallic.value;
    if (!material.metallic.map.empty() || value <= kNoMetal || value >= kMetal) return {};
    return "A surface is metal or it is not; values in between belong into a map.";
}

}  // namespace patina::ui
