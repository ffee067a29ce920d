#include "renderer/core/environment.h"

#include "renderer/core/hash.h"

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace patina {
namespace {

/// No light is brighter; leaves room for squares and sums in single precision.
constexpr float kMaxRadiance = 1e18f;

struct Repairs {
    std::size_t nan = 0, negative = 0, infinite = 0, huge = 0;
};

std::string counted(std::size_t count, std::string_view what, std::string_view remedy) {
    return std::to_string(count) + " " + std::string(what) +
           (count == 1 ? " value was set to " : " values were set to ") + std::string(remedy);
}

/// What each stored value decodes to, for the unsigned types.
std::vector<float> make_srgb_table(PixelType type) {
    const int count = type == PixelType::U8 ? 256 : 65536;
    std::vector<float> table(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
        table[i] = srgb_to_linear(static_cast<float>(i) / static_cast<float>(count - 1));
    return table;
}

/// Grey spread, alpha dropped. decode(index of a channel value in the image) → linear value.
template <class Decode>
std::vector<glm::vec3> spread_channels(const Image& image, Decode decode) {
    const std::size_t count = static_cast<std::size_t>(image.width) * image.height;
    const std::size_t channels = image.channels;
    std::vector<glm::vec3> radiance(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t first = i * channels;
        radiance[i] = channels < 3 ? glm::vec3(decode(first))
                                   : glm::vec3(decode(first), decode(first + 1), decode(first + 2));
    }
    return radiance;
}

std::vector<glm::vec3> linear_pixels(const Image& image) {
    if (image.type == PixelType::F32) {
        const auto* values = reinterpret_cast<const float*>(image.bytes.data());
        return spread_channels(image, [=](std::size_t i) { return values[i]; });
    }
    const std::vector<float> table = make_srgb_table(image.type);
    if (image.type == PixelType::U8) {
        const auto* values = reinterpret_cast<const std::uint8_t*>(image.bytes.data());
        return spread_channels(image, [&](std::size_t i) { return table[values[i]]; });
    }
    const auto* values = reinterpret_cast<const std::uint16_t*>(image.bytes.data());
    return spread_channels(image, [&](std::size_t i) { return table[values[i]]; });
}

float repaired(float value, float largest, Repairs& repairs) {
    if (value >= 0.0f && value <= kMaxRadiance) return value;
    if (std::isnan(value)) {
        ++repairs.nan;
        return 0.0f;
    }
    if (value < 0.0f) {
        ++repairs.negative;
        return 0.0f;
    }
    ++(std::isinf(value) ? repairs.infinite : repairs.huge);
    return largest;
}

Repairs repair(std::vector<glm::vec3>& radiance) {
    float largest = 0.0f;
    for (const glm::vec3& texel : radiance)
        for (int c = 0; c < 3; ++c)
            if (std::isfinite(texel[c])) largest = std::max(largest, texel[c]);
    largest = std::min(largest, kMaxRadiance);
    Repairs repairs;
    for (glm::vec3& texel : radiance)
        for (int c = 0; c < 3; ++c) texel[c] = repaired(texel[c], largest, repairs);
    return repairs;
}

void note_shape(const Image& image, std::vector<std::string>& notes) {
    if (image.type != PixelType::F32)
        notes.emplace_back(std::string(image.type == PixelType::U8 ? "8" : "16") +
                           "-bit picture, taken as sRGB-encoded: bright lights are clipped at 1");
    if (image.width != 2 * image.height)
        notes.emplace_back(std::to_string(image.width) + "×" + std::to_string(image.height) +
                           " is not 2:1; it is stretched over the full panorama");
}

void note_repairs(const Repairs& repairs, std::vector<std::string>& notes) {
    if (repairs.nan) notes.push_back(counted(repairs.nan, "NaN", "0"));
    if (repairs.negative) notes.push_back(counted(repairs.negative, "negative", "0"));
    if (repairs.infinite) notes.push_back(counted(repairs.infinite, "infinite", "the largest finite one"));
    if (repairs.huge) notes.push_back(counted(repairs.huge, "absurdly large", "1e18"));
}

}  // namespace

std::uint64_t environment_hash(const Environment& environment) {
    const std::array<int, 2> size{environment.width, environment.height};
    return hash_bytes(std::as_bytes(std::span(environment.radiance)),
                      hash_bytes(std::as_bytes(std::span(size))));
}

glm::vec3 equirect_to_direction(glm::vec2 uv) {
    const float azimuth = (uv.x - 0.5f) * 2.0f * std::numbers::pi_v<float>;
    const float polar = uv.y * std::numbers::pi_v<float>;
    return {std::sin(azimuth) * std::sin(polar), std::cos(polar), -std::cos(azimuth) * std::sin(polar)};
}

glm::vec2 direction_to_equirect(glm::vec3 direction) {
    const float across = std::hypot(direction.x, direction.z);
    const float azimuth = across > 0.0f ? std::atan2(direction.x, -direction.z) : 0.0f;
    // atan2 of sine and cosine is acos(y) without its loss of digits near the poles.
    const float polar = std::atan2(across, direction.y);
    const float u = 0.5f + azimuth / (2.0f * std::numbers::pi_v<float>);
    return {u < 1.0f ? u : 0.0f, std::clamp(polar / std::numbers::pi_v<float>, 0.0f, 1.0f)};
}

Image radiance_image(const Environment& environment) {
    Image image = make_image(environment.width, environment.height, 3, PixelType::F32);
    std::memcpy(image.bytes.data(), environment.radiance.data(), image.bytes.size());
    return image;
}

Environment make_environment(const Image& image, std::string id, std::string title) {
    if (image.empty() || image.width < 1 || image.height < 1 || image.channels < 1)
        throw std::runtime_error(title + ": the picture has no pixels; choose another environment");
    Environment environment{
        .id = std::move(id), .title = std::move(title), .width = image.width, .height = image.height};
    note_shape(image, environment.notes);
    environment.radiance = linear_pixels(image);
    note_repairs(repair(environment.radiance), environment.notes);
    environment.content_hash = environment_hash(environment);
    return environment;
}

}  // namespace patina
