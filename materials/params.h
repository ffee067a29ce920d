// The table of a material's parameters and map slots. Presets, panels, `--set`, reset and the round-trip test
// walk it, so a new parameter is a field in material.h and a row here. Knows no file and no interface.
#pragma once

#include "materials/material.h"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace patina {

/// A value of an enumeration with its names.
template <class T>
struct Choice {
    T value;
    std::string_view id;       ///< in presets and after --set
    std::string_view title;    ///< in the interface
    std::string_view tooltip;  ///< one sentence for a student
};
inline constexpr std::array kColorSpaces{
    Choice<ColorSpace>{
        ColorSpace::Srgb, "srgb", "sRGB",
        "Stored with the display's curve, as photos and painted colours are; decoded before lighting."},
    Choice<ColorSpace>{ColorSpace::Linear, "linear", "Linear",
                       "Stored as plain amounts of light, as EXR and HDR pictures are."},
};
inline constexpr std::array kChannels{
    Choice<Channel>{Channel::R, "r", "Red", "Read the map's red channel (a grey picture has only this one)."},
    Choice<Channel>{Channel::G, "g", "Green", "Read the map's green channel (roughness in packed maps)."},
    Choice<Channel>{Channel::B, "b", "Blue", "Read the map's blue channel (metallic in packed maps)."},
    Choice<Channel>{Channel::A, "a", "Alpha", "Read the map's alpha channel."},
};
inline constexpr std::array kNormalConventions{
    Choice<NormalConvention>{
        NormalConvention::OpenGl, "opengl", "OpenGL (+Y)",
        "Green points up in the picture: bumps look lit from above in the green channel."},
    Choice<NormalConvention>{
        NormalConvention::DirectX, "directx", "DirectX (−Y)",
        "Green points down in the picture; taken the wrong way round, bumps become dents."},
};
template <class T, std::size_t n>
constexpr const Choice<T>& choice(const std::array<Choice<T>, n>& choices, T value) {
    for (const auto& row : choices)
        if (row.value == value) return row;
    return choices[0];
}
template <class T, std::size_t n>
constexpr std::optional<T> choice_of(const std::array<Choice<T>, n>& choices, std::string_view id) {
    for (const auto& row : choices)
        if (row.id == id) return row.value;
    return std::nullopt;
}

enum class ParamKind { Scalar, Color, Vector2 };
constexpr int components(ParamKind kind) {
    return kind == ParamKind::Scalar ? 1 : kind == ParamKind::Vector2 ? 2 : 3;
}

/// Where a panel shows it.
enum class ParamGroup { Surface, Emission, Placement };
inline constexpr std::array kParamGroups{
    Choice<ParamGroup>{ParamGroup::Surface, "surface", "Surface",
                       "What the surface does with the light that meets it."},
    Choice<ParamGroup>{ParamGroup::Emission, "emission", "Emission",
                       "Light that the surface gives off by itself."},
    Choice<ParamGroup>{ParamGroup::Placement, "placement", "Map placement",
                       "How all maps lie on the surface."},
};

struct ParamRange {
    float min, max;  ///< what is legal: presets are clamped to it, --set refuses what is outside
    float slider_min, slider_max;  ///< what is usual
};

/// Points at a parameter's first float inside a material; the others follow.
struct ParamField {
    float* (*edit)(Material&);
    const float* (*read)(const Material&);
    template <class Member>
    // NOLINTNEXTLINE(google-explicit-constructor): rows of the table read as the member they point at
    constexpr ParamField(Member member) : edit(member), read(member) {}
};

struct MaterialParam {
    std::string_view key;  ///< after --set; a dot is a level of the preset's JSON
    std::string_view label;
    std::string_view tooltip;  ///< one sentence for a student
    ParamKind kind;
    ParamRange range;
    std::string_view unit;
    ParamGroup group;
    std::optional<MapSlot> slot;  ///< the map that this value multiplies; the JSON value is then key/value
    ParamField field;
};

// clang-format off
inline constexpr std::array kMaterialParams{
    MaterialParam{"albedo", "Albedo",
        "The share of light reflected in red, green and blue: the body colour of a non-metal, the mirror colour of a metal.",
        ParamKind::Color, {0, 1, 0, 1}, "", ParamGroup::Surface, MapSlot::Albedo,
        [](auto& m) { return &m.albedo.value.x; }},
    MaterialParam{"roughness", "Roughness",
        "How much the microscopic facets are tilted: 0 is a mirror, 1 is matte; perceptual, the facets' alpha is its square.",
        ParamKind::Scalar, {0, 1, 0, 1}, "", ParamGroup::Surface, MapSlot::Roughness,
        [](auto& m) { return &m.roughness.value; }},
    MaterialParam{"metallic", "Metallic",
        "1 for a metal, which only mirrors and tints what it mirrors, 0 for everything else; in between only where both mix.",
        ParamKind::Scalar, {0, 1, 0, 1}, "", ParamGroup::Surface, MapSlot::Metallic,
        [](auto& m) { return &m.metallic.value; }},
    MaterialParam{"ao", "Ambient occlusion",
        "How much of the light from all around reaches crevices too fine for the mesh: 1 is open, 0 is closed.",
        ParamKind::Scalar, {0, 1, 0, 1}, "", ParamGroup::Surface, MapSlot::Ao,
        [](auto& m) { return &m.ao.value; }},
    MaterialParam{"normal", "Normal strength",
        "How steep the normal map's fine relief looks: 0 is flat, 1 is as baked.",
        ParamKind::Scalar, {0, 4, 0, 2}, "", ParamGroup::Surface, MapSlot::Normal,
        [](auto& m) { return &m.normal.value; }},
    MaterialParam{"emission", "Emission",
        "Light the surface gives off by itself; 1 looks as bright as a white sheet in unit light, lamps go far beyond.",
        ParamKind::Color, {0, 100000, 0, 10}, "", ParamGroup::Emission, MapSlot::Emission,
        [](auto& m) { return &m.emission.value.x; }},
    MaterialParam{"uv.scale", "Repeats",
        "How often the maps repeat across the mesh's texture coordinates; a negative number mirrors them.",
        ParamKind::Vector2, {-1000, 1000, 0.1f, 10}, "", ParamGroup::Placement, std::nullopt,
        [](auto& m) { return &m.uv.scale.x; }},
    MaterialParam{"uv.offset", "Offset",
        "How far the maps are pushed along the texture coordinates; 1 is one whole tile.",
        ParamKind::Vector2, {-1000, 1000, -1, 1}, "", ParamGroup::Placement, std::nullopt,
        [](auto& m) { return &m.uv.offset.x; }},
    MaterialParam{"uv.rotation_deg", "Rotation",
        "How far the maps are turned on the surface, counter-clockwise.",
        ParamKind::Scalar, {-360, 360, -180, 180}, "°", ParamGroup::Placement, std::nullopt,
        [](auto& m) { return &m.uv.rotation_deg; }},
};
// clang-format on

/// The parameter of that key, or null.
const MaterialParam* find_param(std::string_view key);

/// A parameter's numbers inside a material: 1, 2 or 3 of them.
std::span<float> values_of(const MaterialParam& param, Material& material);
std::span<const float> values_of(const MaterialParam& param, const Material& material);
bool is_default(const MaterialParam& param, const Material& material);
void reset(const MaterialParam& param, Material& material);

/// A slot's map and how it is read; what a slot does not have is null.
template <class Text, class Space, class Chan, class Bool, class Convention>
struct BasicMapRef {
    Text* map = nullptr;
    Space* color_space = nullptr;
    Chan* channel = nullptr;
    Bool* invert = nullptr;
    Convention* convention = nullptr;
};
using MapRef = BasicMapRef<std::string, ColorSpace, Channel, bool, NormalConvention>;
using ConstMapRef =
    BasicMapRef<const std::string, const ColorSpace, const Channel, const bool, const NormalConvention>;

struct MaterialSlot {
    MapSlot slot;
    std::string_view key;  ///< the JSON object, and the parameter that multiplies the map
    std::string_view label;
    std::string_view tooltip;  ///< one sentence for a student
    MapRef (*edit)(Material&);
};
/// In the order of MapSlot.
std::span<const MaterialSlot> material_slots();
const MaterialSlot& slot_row(MapSlot slot);
MapRef map_of(Material& material, MapSlot slot);
ConstMapRef map_of(const Material& material, MapSlot slot);
/// Back to the defaults: no map, how it is read, and the value that multiplied it.
void reset_slot(Material& material, MapSlot slot);

/// What `--set key=text` does: the numbers of a parameter ("0.8,0.1,0.1"; one number fills a colour or a
/// vector), or a slot's settings "roughness.map", ".channel", ".invert", ".color_space", ".convention".
/// Throws std::runtime_error with a sentence that names the keys there are, or the range.
void set_parameter(Material& material, std::string_view key, std::string_view text);

}  // namespace patina
