#include "renderer/maps/photo_maps.h"

#include "renderer/core/color_difference.h"
#include "renderer/core/homography.h"
#include "renderer/maps/even_light.h"
#include "renderer/maps/grid.h"
#include "renderer/maps/relief.h"
#include "renderer/maps/tile.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace patina {

namespace {

constexpr double kLeastSamplePx = 16.0;  ///< a side, of the sample in the photo
constexpr float kDarkest = 1e-4f;        ///< reflectance; darker counts as this where logarithms are taken

/// Around in one direction, each corner convex.
bool goes_around(const FourPoints& corners) {
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec2 a = corners[(i + 1) % 4] - corners[i],
                         b = corners[(i + 2) % 4] - corners[(i + 1) % 4];
        if (!(a.x * b.y - a.y * b.x > 0.0)) return false;
    }
    return true;
}

/// The shortest of the sample's sides in the photo, in pixels.
double least_side(const FourPoints& corners) {
    double least = glm::distance(corners[3], corners[0]);
    for (std::size_t i = 0; i < 3; ++i) least = std::min(least, glm::distance(corners[i], corners[i + 1]));
    return least;
}

/// Negative and not finite values count as black.
Image cleaned(Image photo) {
    for (int y = 0; y < photo.height; ++y)
        for (int x = 0; x < photo.width; ++x)
            for (int c = 0; c < 3; ++c)
                if (const float value = texel(photo, x, y, c); !(value >= 0.0f) || !std::isfinite(value))
                    set_texel(photo, x, y, c, 0.0f);
    return photo;
}

glm::ivec2 rectified_size(const MapSettings& settings) {
    if (!settings.tileable) return settings.size_px;
    return settings.size_px + glm::ivec2(tile_overlap(settings.size_px.x), tile_overlap(settings.size_px.y));
}

/// The sample seen straight on; what lies outside the photo takes the nearest pixel's colour.
Colors rectified(const Image& linear, const MapSettings& settings, std::vector<std::string>& notes) {
    const glm::ivec2 size = rectified_size(settings);
    FourPoints in_photo;
    for (std::size_t i = 0; i < 4; ++i)
        in_photo[i] = glm::dvec2(settings.corners[i]) * glm::dvec2(linear.width, linear.height);
    const FourPoints in_map{glm::dvec2{0, 0}, {size.x, 0}, {size.x, size.y}, {0, size.y}};
    const auto to_photo = homography(in_map, in_photo);
    if (!to_photo || !goes_around(in_photo))
        throw std::runtime_error(
            "the sample's corners do not span a four-sided shape; give them in the order upper left, upper "
            "right, lower right, lower left");
    const double side = least_side(in_photo);
    if (side < kLeastSamplePx)
        throw std::runtime_error("the sample is only " + std::to_string(int(side)) +
                                 " pixels wide in the photo; take it from nearer, 16 are the least");
    if (2.0 * side < std::min(size.x, size.y))
        notes.push_back("The sample is " + std::to_string(int(side)) +
                        " pixels wide in the photo; larger maps than that show nothing more.");
    const Image flat = warped(cleaned(linear), *to_photo, size);
    Colors colors(size.x, size.y);
    int outside = 0;
    glm::vec3 last(0.0f);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            if (texel(flat, x, y, 3) > 0.5f)
                last = {texel(flat, x, y, 0), texel(flat, x, y, 1), texel(flat, x, y, 2)};
            else
                ++outside;
            colors.at(x, y) = settings.gain * last;
        }
    if (outside > 0)
        notes.emplace_back("A part of the sample lies outside the photo and is filled; move the corners in.");
    return colors;
}

void require_light(const Colors& colors) {
    const bool light = std::ranges::any_of(colors.values, [](glm::vec3 c) { return luminance(c) > 0.0f; });
    if (!light)
        throw std::runtime_error("the sample is black, or its values are not numbers; choose another photo");
}

Plane log_light_of(const Colors& colors) {
    Plane light(colors.width, colors.height);
    for (std::size_t i = 0; i < light.values.size(); ++i)
        light.values[i] = std::log(std::max(luminance(colors.values[i]), kDarkest));
    return light;
}

/// The colours with the light and shade of forms up to the relief's scale taken out, by that share.
Colors without_shading(Colors colors, const Plane& log_light, const MapSettings& settings,
                       const FourierTransform& fourier) {
    if (settings.shading_removed <= 0.0f) return colors;
    const Plane large = filtered(log_light, settings.tileable, fourier,
                                 low_pass(settings.relief_scale * float(colors.width)));
    for (std::size_t i = 0; i < colors.values.size(); ++i)
        colors.values[i] *= std::exp(settings.shading_removed * (large.values[i] - log_light.values[i]));
    return colors;
}

/// What is left of it without waves longer than that.
Plane detail_of(const Plane& log_light, float length_px, bool tileable, const FourierTransform& fourier) {
    Plane detail = filtered(log_light, tileable, fourier, low_pass(length_px));
    for (std::size_t i = 0; i < detail.values.size(); ++i)
        detail.values[i] = log_light.values[i] - detail.values[i];
    return detail;
}

float mean_square(const Plane& plane) {
    double sum = 0.0;
    for (const float value : plane.values) sum += double(value * value);
    return std::max(float(sum / double(plane.values.size())), 1e-8f);
}

/// An estimate: finely grained places scatter, and places much brighter than all around them shine.
Plane roughness_of(const Plane& log_light, const MapSettings& settings, const FourierTransform& fourier) {
    const float fine_px = 0.02f * float(log_light.width), around_px = 0.15f * float(log_light.width);
    const Plane fine = detail_of(log_light, fine_px, settings.tileable, fourier);
    const Plane above = detail_of(log_light, around_px, settings.tileable, fourier);
    const float mean = mean_square(fine), spread = std::sqrt(mean_square(above));
    Plane squares = fine;
    for (float& value : squares.values) value = std::min(value * value, 4.0f * mean);
    const Plane grain = filtered(squares, settings.tileable, fourier, low_pass(around_px));
    Plane result(log_light.width, log_light.height);
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        const float energy = std::max(grain.values[i], 0.0f);
        const float shine = glm::smoothstep(2.5f, 5.0f, above.values[i] / spread);
        result.values[i] =
            settings.roughness + settings.roughness_contrast * (energy / (energy + mean) - 0.5f - shine);
    }
    return result;
}

// ---- to pictures ----

Image linear_picture(const Colors& colors) {
    Image image = make_image(colors.width, colors.height, 3, PixelType::F32);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) set_texel(image, x, y, c, colors.at(x, y)[c]);
    return image;
}

template <class ToStored>
Image color_picture(const Colors& colors, PixelType type, const ToStored& to_stored) {
    Image image = make_image(colors.width, colors.height, 3, type);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) set_texel(image, x, y, c, to_stored(colors.at(x, y)[c]));
    return image;
}

template <class ToStored>
Image gray_picture(const Plane& plane, PixelType type, const ToStored& to_stored) {
    Image image = make_image(plane.width, plane.height, 1, type);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) set_texel(image, x, y, 0, to_stored(plane.at(x, y)));
    return image;
}

void store_height(const Plane& height, PhotoMaps& maps) {
    const auto [low, high] = std::ranges::minmax(height.values);
    maps.depth = high - low;
    maps.height = gray_picture(height, PixelType::U16, [low = low, depth = maps.depth](float h) {
        return depth > 0.0f ? (h - low) / depth : 0.5f;
    });
}

}  // namespace

std::optional<PhotoMaps> make_photo_maps(const Image& linear, const MapSettings& settings,
                                         const FourierTransform& fourier, const MapControl& control) {
    PhotoMaps maps;
    const auto stopped = [&](float progress) {
        control.progress(progress);
        return control.stop.stop_requested();
    };
    const Colors flat = rectified(linear, settings, maps.notes);
    require_light(flat);
    maps.rectified = linear_picture(flat);
    if (stopped(0.3f)) return std::nullopt;
    Colors surface = evened(flat, settings.even_degree);
    maps.even = linear_picture(surface);
    if (settings.tileable) surface = tiled(surface);
    if (stopped(0.5f)) return std::nullopt;
    const Plane log_light = log_light_of(surface);
    const Plane height = relief_of(log_light, settings, fourier);
    store_height(height, maps);
    maps.normal = color_picture(normals_of(height, settings.tileable), PixelType::U16,
                                [](float n) { return 0.5f + 0.5f * n; });
    if (stopped(0.7f)) return std::nullopt;
    const auto as_is = [](float value) { return value; };
    maps.roughness = gray_picture(roughness_of(log_light, settings, fourier), PixelType::U8, as_is);
    if (stopped(0.8f)) return std::nullopt;
    maps.ao = gray_picture(visibility_of(height, settings), PixelType::U8, as_is);
    maps.albedo =
        color_picture(without_shading(surface, log_light, settings, fourier), PixelType::U8, linear_to_srgb);
    return maps;
}

}  // namespace patina
