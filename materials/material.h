// A physically based material as plain values: what the editor edits, a preset stores and the renderer
// shades. Knows no file, no image and no GPU; a map is only the text of its path.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <string>

namespace patina {

enum class ColorSpace { Srgb, Linear };
enum class Channel { R, G, B, A };
/// Which way a normal map's green channel points: OpenGL +Y up in the picture, DirectX +Y down.
enum class NormalConvention { OpenGl, DirectX };

/// The slots a map can be put in, in the order they are shown.
enum class MapSlot { Albedo, Roughness, Metallic, Ao, Normal, Emission };
inline constexpr int kMapSlots = 6;

/// An RGB parameter. The value is scene-linear and multiplies the decoded map.
struct ColorSlot {
    glm::vec3 value{1.0f};                      ///< linear, ≥ 0
    std::string map;                            ///< path as the preset writes it (UTF-8, '/'); empty: no map
    ColorSpace color_space = ColorSpace::Srgb;  ///< how the map's 8-bit or float values are encoded
    bool operator==(const ColorSlot&) const = default;
};

/// A one-channel parameter: value · (invert ? 1 − map[channel] : map[channel]).
struct ScalarSlot {
    float value = 1.0f;  ///< 0…1
    std::string map;     ///< path as the preset writes it; empty: no map
    Channel channel = Channel::R;
    bool invert = false;  ///< true for a glossiness map in the roughness slot
    bool operator==(const ScalarSlot&) const = default;
};

/// Tangent-space normal map; value scales the x and y of the decoded normal (glTF normalTexture.scale).
struct NormalSlot {
    float value = 1.0f;  ///< 0…4, 0 is flat
    std::string map;
    NormalConvention convention = NormalConvention::OpenGl;
    bool operator==(const NormalSlot&) const = default;
};

/// KHR_texture_transform's order: uv' = offset + rotate(scale · uv). (0,0) is the picture's lower-left
/// corner.
struct UvTransform {
    glm::vec2 scale{1.0f};
    glm::vec2 offset{0.0f};
    float rotation_deg = 0.0f;  ///< counter-clockwise as seen on the surface
    bool operator==(const UvTransform&) const = default;
};

struct Material {
    std::string name = "Untitled";
    std::string source;  ///< where the values come from; shown, not used
    ColorSlot albedo{.value = glm::vec3{0.8f}};
    ScalarSlot roughness{.value = 0.5f, .channel = Channel::G};
    ScalarSlot metallic{.value = 0.0f, .channel = Channel::B};
    ScalarSlot ao{.value = 1.0f};
    NormalSlot normal;
    ColorSlot emission{.value = glm::vec3{0.0f}};  ///< radiance added to the surface, ≥ 0, may exceed 1
    UvTransform uv;
    std::string
        unknown_json;  ///< keys this version does not know, as one JSON object; kept on save; empty: none
    bool operator==(const Material&) const = default;
};

}  // namespace patina
