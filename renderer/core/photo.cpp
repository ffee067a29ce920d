#include "renderer/core/photo.h"

#include "renderer/core/color_difference.h"
#include "renderer/core/finite.h"
#include "renderer/core/format.h"
#include "renderer/core/homography.h"
#include "renderer/core/metrics.h"

#include <glm/common.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

namespace patina {

namespace {

constexpr float kClipped = 0.995f;

glm::vec3 color_at(const Image& image, int x, int y) {
    return {texel(image, x, y, 0), texel(image, x, y, 1), texel(image, x, y, 2)};
}

/// The pixels that a region holds, within the picture.
struct Span {
    int x0, y0, x1, y1;
};
Span pixels_of(const std::optional<Region>& region, const Image& picture) {
    const Region r = region.value_or(Region{});
    const glm::ivec2 size(picture.width, picture.height);
    const glm::ivec2 low(glm::round(pixel_of({r.x0, r.y0}, size)));
    const glm::ivec2 high(glm::round(pixel_of({r.x1, r.y1}, size)));
    if (!region) return {0, 0, size.x, size.y};
    return {std::clamp(low.x, 0, size.x), std::clamp(low.y, 0, size.y), std::clamp(high.x, 0, size.x),
            std::clamp(high.y, 0, size.y)};
}

template <class Act>
void for_compared(const Image& photo, const Image& render, const std::optional<Region>& region, Act act) {
    const Span span = pixels_of(region, photo);
    for (int y = span.y0; y < std::min(span.y1, render.height); ++y)
        for (int x = span.x0; x < std::min(span.x1, render.width); ++x)
            if (texel(photo, x, y, 3) > 0.5f) act(x, y, color_at(photo, x, y), color_at(render, x, y));
}

Image filled(int width, int height, float value) {
    Image image = make_image(width, height, 1, PixelType::F32);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) set_texel(image, x, y, 0, value);
    return image;
}

float difference(glm::vec3 photo, glm::vec3 render) {
    const auto shown = [](glm::vec3 color) { return lab_of(glm::clamp(color, 0.0f, 1.0f)); };
    return delta_e_2000(shown(photo), shown(render));
}

/// The vertex of the parabola through three points.
glm::vec2 parabola_vertex(const Trial& a, const Trial& b, const Trial& c) {
    const double x1 = double(a.offset - b.offset), x2 = double(c.offset - b.offset);
    const double y1 = double(a.delta_e - b.delta_e), y2 = double(c.delta_e - b.delta_e);
    const double curve = (y1 / x1 - y2 / x2) / (x1 - x2);
    const double slope = y1 / x1 - curve * x1;
    if (!(curve > 0.0)) return {b.offset, b.delta_e};
    const double x = std::clamp(-slope / (2.0 * curve), std::min(x1, x2), std::max(x1, x2));
    return {float(double(b.offset) + x), float(double(b.delta_e) + slope * x + curve * x * x)};
}

}  // namespace

Image linear_photo(const Image& image) {
    Image linear = make_image(image.width, image.height, 3, PixelType::F32);
    const bool encoded = image.type != PixelType::F32;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const float value = texel(image, x, y, image.channels < 3 ? 0 : c);
                set_texel(linear, x, y, c, encoded ? srgb_to_linear(value) : value);
            }
    return linear;
}

std::optional<glm::vec3> patch_color(const Image& photo, glm::vec2 center, float radius_px) {
    if (!(center.x >= 0.0f && center.y >= 0.0f && center.x < float(photo.width) &&
          center.y < float(photo.height)))
        return std::nullopt;
    std::vector<glm::vec3> colors;
    const int reach = std::max(0, int(radius_px));
    const int cx = int(center.x), cy = int(center.y);
    for (int y = std::max(0, cy - reach); y <= std::min(photo.height - 1, cy + reach); ++y)
        for (int x = std::max(0, cx - reach); x <= std::min(photo.width - 1, cx + reach); ++x)
            if (const glm::vec3 color = color_at(photo, x, y); is_finite(color)) colors.push_back(color);
    if (colors.empty()) return std::nullopt;
    std::sort(colors.begin(), colors.end(),
              [](const glm::vec3& a, const glm::vec3& b) { return luminance(a) < luminance(b); });
    const std::size_t cut = colors.size() / 10;
    glm::dvec3 sum(0.0);
    for (std::size_t i = cut; i < colors.size() - cut; ++i) sum += glm::dvec3(colors[i]);
    return glm::vec3(sum / double(colors.size() - 2 * cut));
}

std::optional<glm::vec3> card_patch(const Image& photo, glm::vec2 fraction) {
    const float radius = std::max(2.0f, 0.006f * float(std::max(photo.width, photo.height)));
    return patch_color(photo, fraction * glm::vec2(photo.width, photo.height), radius);
}

std::optional<PhotoBalance> balance_to(glm::vec3 patch, glm::vec3 target) {
    for (int c = 0; c < 3; ++c)
        if (!(patch[c] > 1e-4f) || patch[c] >= kClipped || !(target[c] > 0.0f)) return std::nullopt;
    const float gain = luminance(target) / luminance(patch);
    return PhotoBalance{std::log2(gain), target / patch / gain};
}

glm::dvec2 pixel_of(glm::dvec2 fraction, glm::ivec2 view_px) {
    const double side = std::min(view_px.x, view_px.y);
    return 0.5 * (glm::dvec2(view_px) - side) + side * fraction;
}

PhotoFit first_fit(bool flat, const Camera& camera, glm::ivec2 photo_px) {
    PhotoFit fit;
    if (flat) {
        const glm::mat4 all = projection_matrix(camera, 1.0f) * view_matrix(camera);
        const std::array<glm::vec4, 4> corners{
            glm::vec4{-1, 1, 0, 1}, {1, 1, 0, 1}, {1, -1, 0, 1}, {-1, -1, 0, 1}};
        for (std::size_t i = 0; i < 4; ++i) {
            const glm::vec4 clip = all * corners[i];
            if (clip.w > 0.0f) fit.view[i] = {0.5f + 0.5f * clip.x / clip.w, 0.5f - 0.5f * clip.y / clip.w};
        }
    } else {
        // The tangent cone of the unit sphere: its half angle has the sine 1/distance.
        const float distance = std::max(camera.distance, 1.01f);
        const float half =
            0.5f * std::tan(std::asin(1.0f / distance)) / std::tan(glm::radians(camera.fov_deg) / 2.0f);
        fit.view = {glm::vec2{0.5f - half, 0.5f - half},
                    {0.5f + half, 0.5f - half},
                    {0.5f + half, 0.5f + half},
                    {0.5f - half, 0.5f + half}};
    }
    const glm::vec2 size = glm::max(glm::vec2(photo_px), glm::vec2(1.0f));
    const glm::vec2 stretch = std::max(size.x, size.y) / size;
    for (std::size_t i = 0; i < 4; ++i) fit.photo[i] = 0.5f + (fit.view[i] - 0.5f) * stretch;
    return fit;
}

std::optional<glm::dmat3> view_to_photo(const Photo& photo, glm::ivec2 photo_px, glm::ivec2 view_px) {
    const glm::dvec2 photo_size(photo_px);
    if (photo.fit) {
        FourPoints from, to;
        for (std::size_t i = 0; i < 4; ++i) {
            from[i] = pixel_of(photo.fit->view[i], view_px);
            to[i] = glm::dvec2(photo.fit->photo[i]) * photo_size;
        }
        return homography(from, to);
    }
    const double scale = std::max(photo_size.x, photo_size.y) / std::min(view_px.x, view_px.y);
    const glm::dvec2 shift = 0.5 * (photo_size - scale * glm::dvec2(view_px));
    return glm::dmat3(scale, 0.0, 0.0, 0.0, scale, 0.0, shift.x, shift.y, 1.0);
}

Image photo_in_view(const Photo& photo, const Image& linear, glm::ivec2 view_px) {
    const auto to_photo = view_to_photo(photo, {linear.width, linear.height}, view_px);
    if (!to_photo)
        throw std::runtime_error(photo.file +
                                 ": three of the photo's four fit points lie on a line; move one of them");
    Image result = warped(linear, *to_photo, view_px);
    const glm::vec3 gain = photo.white_balance * std::exp2(photo.exposure_ev);
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x) {
            const glm::vec3 color = color_at(result, x, y) * gain;
            const bool there = is_finite(color);
            for (int c = 0; c < 3; ++c) set_texel(result, x, y, c, there ? color[c] : 0.0f);
            if (!there) set_texel(result, x, y, 3, 0.0f);
        }
    return result;
}

Residual residual_of(const Image& photo, const Image& render, const std::optional<Region>& region,
                     Image* delta_e) {
    if (delta_e) *delta_e = filled(photo.width, photo.height, -1.0f);
    std::vector<float> differences;
    double sum = 0.0, photo_light = 0.0, render_light = 0.0, squares = 0.0;
    for_compared(photo, render, region, [&](int x, int y, glm::vec3 seen, glm::vec3 made) {
        differences.push_back(difference(seen, made));
        if (delta_e) set_texel(*delta_e, x, y, 0, differences.back());
        sum += double(differences.back());
        const double a = double(luminance(seen)), b = double(luminance(made));
        photo_light += a;
        render_light += b;
        squares += (b - a) * (b - a);
    });
    Residual residual{.pixels = int(differences.size())};
    if (differences.empty()) return residual;
    const double n = double(differences.size());
    const auto rank = differences.begin() + std::ptrdiff_t(0.95 * (n - 1.0));
    std::nth_element(differences.begin(), rank, differences.end());
    residual.delta_e = float(sum / n);
    residual.delta_e_95 = *rank;
    const double light = std::max(photo_light, 1e-9 * n);
    residual.luminance_bias = float((render_light - photo_light) / light);
    residual.luminance_rms = float(std::sqrt(squares / n) / (light / n));
    return residual;
}

Image luminance_picture(const Image& photo, const Image& render, const std::optional<Region>& region,
                        float white) {
    Image picture = make_image(photo.width, photo.height, 3, PixelType::U8);
    std::ranges::fill(picture.bytes, std::byte(128));
    double light = 0.0, pixels = 0.0;
    for_compared(photo, render, region, [&](int, int, glm::vec3 seen, glm::vec3) {
        light += double(luminance(seen));
        ++pixels;
    });
    const double scale = pixels / std::max(light, 1e-9 * pixels) / double(white);
    for_compared(photo, render, region, [&](int x, int y, glm::vec3 seen, glm::vec3 made) {
        glm::vec3 color;
        diverging(double(luminance(made) - luminance(seen)) * scale, &color.x);
        for (int c = 0; c < 3; ++c) set_texel(picture, x, y, c, color[c]);
    });
    return picture;
}

glm::vec3 heat_color(float t) {
    static constexpr std::array<glm::vec3, 5> stops{
        glm::vec3{0, 0, 0}, {0.10f, 0.10f, 0.55f}, {0.80f, 0.15f, 0.25f}, {1.0f, 0.75f, 0.15f}, {1, 1, 1}};
    const float at = std::clamp(t, 0.0f, 1.0f) * float(stops.size() - 1);
    const auto i = std::min(std::size_t(at), stops.size() - 2);
    return glm::mix(stops[i], stops[i + 1], at - float(i));
}

Image heat_picture(const Image& values, float white) {
    Image picture = make_image(values.width, values.height, 3, PixelType::U8);
    for (int y = 0; y < values.height; ++y)
        for (int x = 0; x < values.width; ++x) {
            const float value = texel(values, x, y, 0);
            const glm::vec3 color = value < 0.0f ? glm::vec3(0.5f) : heat_color(value / white);
            for (int c = 0; c < 3; ++c) set_texel(picture, x, y, c, color[c]);
        }
    return picture;
}

std::optional<Estimate> estimate_offset(std::span<const Trial> trials) {
    const auto now =
        std::find_if(trials.begin(), trials.end(), [](const Trial& t) { return t.offset == 0.0f; });
    if (trials.size() < 3 || now == trials.end()) return std::nullopt;
    const auto best = std::min_element(trials.begin(), trials.end(),
                                       [](const Trial& a, const Trial& b) { return a.delta_e < b.delta_e; });
    Estimate estimate{best->offset, best->delta_e, now->delta_e};
    if (best != trials.begin() && best + 1 != trials.end()) {
        const glm::vec2 vertex = parabola_vertex(*(best - 1), *best, *(best + 1));
        estimate.offset = vertex.x;
        estimate.delta_e = std::max(0.0f, vertex.y);
    }
    const float gain = estimate.now - estimate.delta_e;
    const bool visible = gain > 0.5f && estimate.delta_e < 0.9f * estimate.now;
    const bool explains_all = gain > 0.25f && estimate.delta_e < 0.25f * estimate.now;
    estimate.clear = visible || explains_all;
    return estimate;
}

namespace {
/// A number, or a fraction such as 1/125.
std::optional<float> number_in(const std::string& text) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (end == text.c_str() || !std::isfinite(value)) return std::nullopt;
    if (*end != '/') return float(value);
    const double below = std::strtod(end + 1, nullptr);
    return below > 0.0 ? std::optional(float(value / below)) : std::nullopt;
}

}  // namespace

CameraExif exif_of(std::span<const std::pair<std::string, std::string>> metadata) {
    CameraExif exif;
    std::string make, model;
    for (const auto& [key, value] : metadata) {
        if (key == "ExposureTime") exif.exposure_s = number_in(value);
        if (key == "FNumber") exif.f_number = number_in(value);
        if (key == "Exif:PhotographicSensitivity" || key == "Exif:ISOSpeedRatings")
            exif.iso = number_in(value);
        if (key == "Exif:FocalLength") exif.focal_mm = number_in(value);
        if (key == "Make") make = value;
        if (key == "Model") model = value;
        if (key == "DateTime" || key == "Exif:DateTimeOriginal") exif.taken = value;
    }
    exif.camera = model.starts_with(make) ? model : make + " " + model;
    return exif;
}

std::optional<float> exposure_value(const CameraExif& exif) {
    if (!exif.exposure_s || !exif.f_number || !exif.iso || !(*exif.exposure_s > 0.0f) ||
        !(*exif.iso > 0.0f) || !(*exif.f_number > 0.0f))
        return std::nullopt;
    return std::log2(*exif.f_number * *exif.f_number / *exif.exposure_s) - std::log2(*exif.iso / 100.0f);
}

std::string describe(const CameraExif& exif) {
    std::vector<std::string> parts;
    if (exif.camera.find_first_not_of(' ') != std::string::npos) parts.push_back(exif.camera);
    if (exif.exposure_s)
        parts.push_back(*exif.exposure_s < 0.4f && *exif.exposure_s > 0.0f
                            ? formatted("1/%.0f s", 1.0 / double(*exif.exposure_s))
                            : formatted("%.3g s", double(*exif.exposure_s)));
    if (exif.f_number) parts.push_back(formatted("f/%.3g", double(*exif.f_number)));
    if (exif.iso) parts.push_back(formatted("ISO %.0f", double(*exif.iso)));
    if (exif.focal_mm) parts.push_back(formatted("%.4g mm", double(*exif.focal_mm)));
    std::string text;
    for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
    return text;
}

}  // namespace patina
