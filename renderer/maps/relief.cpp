#include "renderer/maps/relief.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace patina {

namespace {

constexpr float kSlopeOfBrightness = 0.25f;
constexpr float kUnseen = 0.15f;
constexpr int kRounds = 2;
constexpr float kTwoPi = 2.0f * std::numbers::pi_v<float>;
constexpr int kDirections = 16, kSteps = 10;

Image picture_of(const Plane& plane, bool mirrored) {
    const int times = mirrored ? 2 : 1;
    Image image = make_image(times * plane.width, times * plane.height, 1, PixelType::F32);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            set_texel(image, x, y, 0,
                      plane.at(std::min(x, image.width - 1 - x + (mirrored ? 0 : image.width)),
                               std::min(y, image.height - 1 - y + (mirrored ? 0 : image.height))));
    return image;
}

float frequency(int i, int size) { return float(2 * i <= size ? i : i - size) / float(size); }

/// Root mean square of the slopes along x and y together.
float slope_of(const Plane& height, bool tileable) {
    double squares = 0.0;
    for (const glm::vec3& n : normals_of(height, tileable).values) {
        const double x = double(n.x / n.z), y = double(n.y / n.z);
        squares += x * x + y * y;
    }
    return float(std::sqrt(squares / double(height.values.size())));
}

/// To nothing towards the borders of a picture that is not tileable: a mirrored slope would be lit from the
/// other side.
Plane faded(Plane picture) {
    const auto weight = [](int i, int size) {
        const float inside = 16.0f * (float(std::min(i, size - 1 - i)) + 0.5f) / float(size);
        return inside >= 1.0f ? 1.0f : inside * inside * (3.0f - 2.0f * inside);
    };
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            picture.at(x, y) *= weight(x, picture.width) * weight(y, picture.height);
    return picture;
}

/// From the derivative along l (pixels, y downwards) to the height in pixels.
Filter integral_along(glm::vec2 l) {
    return [l](float fx, float fy) -> std::complex<float> {
        const float along = kTwoPi * (fx * l.x + fy * l.y);
        const float all = kUnseen * kTwoPi * std::sqrt(fx * fx + fy * fy);
        const float below = along * along + all * all;
        return below > 0.0f ? std::complex<float>(0.0f, -along / below) : 0.0f;
    };
}

/// log_light: of the forms that count. A matt surface's light, 1 where it is flat, is
/// (1 − tan t · ∂h/∂l) / √(1 + |∇h|²); the root is taken from the height of the round before.
Plane lit_relief(Plane log_light, const MapSettings& settings, const FourierTransform& fourier) {
    const float azimuth = glm::radians(settings.light_azimuth_deg);
    const float gain =
        -std::tan(glm::radians(settings.light_elevation_deg)) / float(log_light.width);  // −1 / tan t
    const Filter integral = integral_along({std::cos(azimuth), -std::sin(azimuth)});
    if (!settings.tileable) log_light = faded(std::move(log_light));
    Plane height(log_light.width, log_light.height);
    for (int round = 0; round < kRounds; ++round) {
        const Colors normals = normals_of(height, settings.tileable);
        Plane slope = log_light;
        for (std::size_t i = 0; i < slope.values.size(); ++i)
            slope.values[i] = std::exp(log_light.values[i]) / normals.values[i].z - 1.0f;
        height = filtered(slope, settings.tileable, fourier, integral);
        for (float& value : height.values) value *= gain;
    }
    for (float& value : height.values) value *= settings.relief_strength;
    return height;
}

/// How far a place at step k of the way to the farthest occluder lies, in pixels: 1 … radius, geometric.
int step_px(int k, float radius) {
    return std::max(k + 1, int(std::lround(std::pow(radius, float(k + 1) / float(kSteps)))));
}

}  // namespace

Plane filtered(const Plane& picture, bool tileable, const FourierTransform& fourier, const Filter& filter) {
    Image spectrum = fourier.forward(picture_of(picture, !tileable));
    for (int y = 0; y < spectrum.height; ++y)
        for (int x = 0; x < spectrum.width; ++x) {
            const std::complex<float> value(texel(spectrum, x, y, 0), texel(spectrum, x, y, 1));
            const std::complex<float> changed =
                value * filter(frequency(x, spectrum.width), frequency(y, spectrum.height));
            set_texel(spectrum, x, y, 0, changed.real());
            set_texel(spectrum, x, y, 1, changed.imag());
        }
    const Image back = fourier.inverse(spectrum);
    Plane result(picture.width, picture.height);
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x) result.at(x, y) = texel(back, x, y, 0);
    return result;
}

Filter low_pass(float length_px) {
    const float k = std::numbers::ln2_v<float> * length_px * length_px;
    return [k](float fx, float fy) { return std::complex<float>(std::exp(-k * (fx * fx + fy * fy))); };
}

Plane relief_of(const Plane& log_light, const MapSettings& settings, const FourierTransform& fourier) {
    const auto width = float(log_light.width);
    const Filter longer = low_pass(settings.relief_scale * width);
    const Filter noise = low_pass(2.0f);  // what only single pixels show
    const auto forms = [longer, noise](float fx, float fy) {
        return (1.0f - longer(fx, fy)) * noise(fx, fy);
    };
    Plane height = filtered(log_light, settings.tileable, fourier, forms);
    if (settings.relief_from == ReliefFrom::Brightness) {
        for (float& value : height.values) value /= width;
        const float slope = slope_of(height, settings.tileable);
        const float factor = slope > 1e-7f ? settings.relief_strength * kSlopeOfBrightness / slope : 0.0f;
        for (float& value : height.values) value *= factor;
        return height;
    }
    return lit_relief(height, settings, fourier);
}

Colors normals_of(const Plane& height, bool tileable) {
    const auto pixels = float(height.width);  // heights are in widths
    Colors normals(height.width, height.height);
    for (int y = 0; y < height.height; ++y)
        for (int x = 0; x < height.width; ++x) {
            const int left = neighbour(x - 1, height.width, tileable),
                      right = neighbour(x + 1, height.width, tileable);
            const int above = neighbour(y - 1, height.height, tileable),
                      below = neighbour(y + 1, height.height, tileable);
            const float along = 0.5f * pixels * (height.at(right, y) - height.at(left, y));
            const float up = 0.5f * pixels * (height.at(x, above) - height.at(x, below));
            normals.at(x, y) = glm::normalize(glm::vec3(-along, -up, 1.0f));
        }
    return normals;
}

Plane visibility_of(const Plane& height, const MapSettings& settings) {
    const float radius = std::max(1.0f, settings.ao_radius * float(height.width));
    std::array<std::pair<glm::ivec2, float>, std::size_t(kDirections) * kSteps> offsets;
    for (int d = 0; d < kDirections; ++d)
        for (int k = 0; k < kSteps; ++k) {
            const float angle = kTwoPi * float(d) / float(kDirections), far = float(step_px(k, radius));
            const glm::ivec2 offset(std::lround(far * std::cos(angle)), std::lround(far * std::sin(angle)));
            offsets[std::size_t(d) * kSteps + k] = {
                offset, settings.ao_strength * float(height.width) / glm::length(glm::vec2(offset))};
        }
    const auto place = [&](int i, int size) {
        if (!settings.tileable) return std::clamp(i, 0, size - 1);
        return ((i % size) + size) % size;
    };
    Plane result(height.width, height.height);
    for (int y = 0; y < height.height; ++y)
        for (int x = 0; x < height.width; ++x) {
            const float here = height.at(x, y);
            float sum = 0.0f;
            for (int d = 0; d < kDirections; ++d) {
                float horizon = 0.0f;  // the tangent of its elevation
                for (int k = 0; k < kSteps; ++k) {
                    const auto& [offset, per_height] = offsets[std::size_t(d) * kSteps + k];
                    const float there =
                        height.at(place(x + offset.x, height.width), place(y + offset.y, height.height));
                    horizon = std::max(horizon, (there - here) * per_height);
                }
                sum += 1.0f / (1.0f + horizon * horizon);
            }
            result.at(x, y) = sum / float(kDirections);
        }
    return result;
}

}  // namespace patina
