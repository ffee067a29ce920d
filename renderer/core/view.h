// How a scene is looked at: light rotation, exposure, tone mapping, shading mode. Plain values with their
// names.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <optional>
#include <string_view>

namespace patina {

enum class Shading { Course, SplitSum, Fitted, Reference };
/// Of fitted shading: lobes swept over two prefiltered levels, or over four.
enum class Quality { Standard, High };
enum class Tonemap { None, Neutral, Aces };
enum class Background { Environment, Blurred, Plain };
/// Final is the shaded picture; the others show one ingredient.
enum class DebugView {
    Final,
    Albedo,
    Roughness,
    Metallic,
    Ao,
    NormalMap,
    Normal,
    Tangent,
    Uv,
    UvChecker,
    Diffuse,
    Specular,
    Emission
};

struct View {
    float env_rotation_deg = 0.0f;  ///< about +Y, counter-clockwise seen from above
    float exposure_ev = 0.0f;       ///< radiance is multiplied by 2^exposure_ev
    Tonemap tonemap = Tonemap::Neutral;
    Background background = Background::Environment;
    glm::vec3 plain_color{0.18f};  ///< linear, the plain background
    Shading shading = Shading::Fitted;
    Quality quality = Quality::Standard;  ///< of fitted shading
    DebugView debug = DebugView::Final;
    bool operator==(const View&) const = default;
};

/// Whether the picture gathers over many draws instead of being drawn at once.
inline bool is_reference(const View& view) {
    return view.shading == Shading::Reference && view.debug == DebugView::Final;
}

template <class T>
struct Named {
    T value;
    std::string_view id;       ///< on the command line and in files
    std::string_view title;    ///< in the interface
    std::string_view tooltip;  ///< one sentence for a student
};

inline constexpr std::array kShadings{
    Named<Shading>{Shading::Course, "course", "Course",
                   "The lecture's formulas to the letter, its simplifications included."},
    Named<Shading>{Shading::SplitSum, "split-sum", "Split sum",
                   "Prefiltered light times a BRDF table, with the energy of multiple scattering put back."},
    Named<Shading>{Shading::Fitted, "fitted", "Fitted",
                   "Reads the light where the true lobe lies and as wide as it is: near the full integral at "
                   "split sum's price."},
    Named<Shading>{
        Shading::Reference, "reference", "Reference",
        "The reflectance integral itself, sampled until it stands still: what the other modes approximate."},
};
inline constexpr std::array kQualities{
    Named<Quality>{Quality::Standard, "standard", "Standard",
                   "Fitted lobes with two looks into the prefiltered light."},
    Named<Quality>{Quality::High, "high", "High",
                   "Fitted lobes with four looks: closer to the integral, at a third more."},
};
inline constexpr std::array kTonemaps{
    Named<Tonemap>{Tonemap::None, "none", "None",
                   "Linear values clipped at 1, then sRGB: best for comparing with a photo."},
    Named<Tonemap>{Tonemap::Neutral, "neutral", "Neutral",
                   "Khronos PBR Neutral: keeps base colours, rolls off highlights."},
    Named<Tonemap>{Tonemap::Aces, "aces", "ACES",
                   "A filmic curve (ACES fit): contrasty, washes out saturated highlights."},
};
inline constexpr std::array kBackgrounds{
    Named<Background>{Background::Environment, "env", "Environment",
                      "Show the environment behind the object."},
    Named<Background>{Background::Blurred, "blurred", "Blurred", "Show the environment out of focus."},
    Named<Background>{Background::Plain, "none", "Plain",
                      "A plain mid-grey, so that colours are judged fairly."},
};
inline constexpr std::array kDebugViews{
    Named<DebugView>{DebugView::Final, "final", "Final", "The shaded picture."},
    Named<DebugView>{DebugView::Albedo, "albedo", "Albedo",
                     "Base colour after map and value, without light."},
    Named<DebugView>{DebugView::Roughness, "roughness", "Roughness",
                     "Perceptual roughness, black is a mirror."},
    Named<DebugView>{DebugView::Metallic, "metallic", "Metallic", "White is metal, black is not."},
    Named<DebugView>{DebugView::Ao, "ao", "Ambient occlusion",
                     "How much of the surroundings the surface sees."},
    Named<DebugView>{DebugView::NormalMap, "normal-map", "Normal map", "The tangent-space normal as stored."},
    Named<DebugView>{DebugView::Normal, "normal", "Normal", "The world-space normal that is shaded."},
    Named<DebugView>{DebugView::Tangent, "tangent", "Tangent", "The tangent that normal maps are turned by."},
    Named<DebugView>{DebugView::Uv, "uv", "UV", "Texture coordinates: red is u, green is v."},
    Named<DebugView>{DebugView::UvChecker, "uv-checker", "UV checker",
                     "A checkerboard: shows stretching and mirrored seams."},
    Named<DebugView>{DebugView::Diffuse, "diffuse", "Diffuse only",
                     "Only the diffuse part of the reflected light."},
    Named<DebugView>{DebugView::Specular, "specular", "Specular only",
                     "Only the specular part of the reflected light."},
    Named<DebugView>{DebugView::Emission, "emission", "Emission", "Only what the surface emits."},
};

template <class T, std::size_t n>
constexpr const Named<T>& named(const std::array<Named<T>, n>& table, T value) {
    for (const auto& row : table)
        if (row.value == value) return row;
    return table[0];
}
template <class T, std::size_t n>
constexpr std::optional<T> value_of(const std::array<Named<T>, n>& table, std::string_view id) {
    for (const auto& row : table)
        if (row.id == id) return row.value;
    return std::nullopt;
}

}  // namespace patina
