#include "renderer/core/metrics.h"

#include "renderer/core/color_difference.h"
#include "renderer/core/flip.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

namespace patina {

namespace {

bool counts(const Image& mask, int x, int y) { return mask.empty() || texel(mask, x, y, 0) >= 0.5f; }

double floor_of(const Image& reference, const Image& mask) {
    double sum = 0.0;
    std::size_t values = 0;
    for (int y = 0; y < reference.height; ++y)
        for (int x = 0; x < reference.width; ++x)
            for (int c = 0; counts(mask, x, y) && c < 3; ++c, ++values)
                sum += double(texel(reference, x, y, c));
    return std::max(1e-3 * sum / double(std::max<std::size_t>(values, 1)), 1e-30);
}

}  // namespace

PictureError picture_error(const Image& picture, const Image& reference, const Image& mask) {
    assert(picture.width == reference.width && picture.height == reference.height);
    const double floor = floor_of(reference, mask);
    std::vector<double> errors;
    for (int y = 0; y < reference.height; ++y)
        for (int x = 0; x < reference.width; ++x)
            for (int c = 0; counts(mask, x, y) && c < 3; ++c) {
                const double r = double(texel(reference, x, y, c));
                errors.push_back(std::abs(double(texel(picture, x, y, c)) - r) / std::max(r, floor));
            }
    if (errors.empty()) return {};
    double squares = 0.0;
    for (const double each : errors) squares += each * each;
    const auto p95 = errors.begin() + std::ptrdiff_t(errors.size() * 95 / 100);
    std::nth_element(errors.begin(), p95, errors.end());
    return {std::sqrt(squares / double(errors.size())), *p95, *std::max_element(p95, errors.end()),
            errors.size() / 3};
}

Image relative_error(const Image& picture, const Image& reference) {
    assert(picture.width == reference.width && picture.height == reference.height);
    const double floor = floor_of(reference, {});
    Image result = make_image(reference.width, reference.height, 1, PixelType::F32);
    for (int y = 0; y < reference.height; ++y)
        for (int x = 0; x < reference.width; ++x) {
            double sum = 0.0;
            for (int c = 0; c < 3; ++c) {
                const double r = double(texel(reference, x, y, c));
                sum += std::abs(double(texel(picture, x, y, c)) - r) / std::max(r, floor);
            }
            set_texel(result, x, y, 0, float(sum / 3.0));
        }
    return result;
}

Image signed_difference(const Image& picture, const Image& reference) {
    assert(picture.width == reference.width && picture.height == reference.height);
    const auto light = [](const Image& image, int x, int y) {
        return luminance({texel(image, x, y, 0), texel(image, x, y, 1), texel(image, x, y, 2)});
    };
    Image result = make_image(reference.width, reference.height, 1, PixelType::F32);
    for (int y = 0; y < reference.height; ++y)
        for (int x = 0; x < reference.width; ++x)
            set_texel(result, x, y, 0, light(picture, x, y) - light(reference, x, y));
    return result;
}

double mean_value(const Image& values, const Image& mask) {
    double sum = 0.0;
    std::size_t pixels = 0;
    for (int y = 0; y < values.height; ++y)
        for (int x = 0; x < values.width; ++x) {
            if (!counts(mask, x, y)) continue;
            sum += double(texel(values, x, y, 0));
            ++pixels;
        }
    return sum / double(std::max<std::size_t>(pixels, 1));
}

void viridis(double t, float rgb[3]) {
    // A polynomial of degree 6 through the published table; errs by less than 0.01.
    static constexpr double k[7][3] = {
        {0.2777273272, 0.0054073445, 0.3340998053},   {0.1050930431, 1.4046135299, 1.3845901626},
        {-0.3308618287, 0.2148475595, 0.0950951630},  {-4.6342304988, -5.7991009734, -19.3324409563},
        {6.2282699332, 14.1799333668, 56.6905526007}, {4.7763849984, -13.7451453777, -65.3530326334},
        {-5.4354558559, 4.6458526122, 26.3124352496}};
    const double x = std::clamp(t, 0.0, 1.0);
    for (int c = 0; c < 3; ++c) {
        double value = 0.0;
        for (int i = 6; i >= 0; --i) value = value * x + k[i][c];
        rgb[c] = float(std::clamp(value, 0.0, 1.0));
    }
}

void diverging(double t, float rgb[3]) {
    static constexpr float ends[3][3] = {{0.05f, 0.30f, 0.85f}, {0.88f, 0.88f, 0.88f}, {0.85f, 0.15f, 0.10f}};
    const float x = float(std::clamp(t, -1.0, 1.0));
    for (int c = 0; c < 3; ++c) rgb[c] = ends[1][c] + std::abs(x) * (ends[x < 0.0f ? 0 : 2][c] - ends[1][c]);
}

namespace {
/// values / white as colours.
template <class Ramp>
Image colored(const Image& values, double white, const Ramp& ramp) {
    Image result = make_image(values.width, values.height, 3, PixelType::U8);
    for (int y = 0; y < values.height; ++y)
        for (int x = 0; x < values.width; ++x) {
            float rgb[3];
            ramp(double(texel(values, x, y, 0)) / white, rgb);
            for (int c = 0; c < 3; ++c) set_texel(result, x, y, c, rgb[c]);
        }
    return result;
}
}  // namespace

Image viridis_picture(const Image& values, double white) { return colored(values, white, viridis); }

Image difference_picture(const Image& picture, const Image& reference, DifferenceKind kind) {
    switch (kind) {
        case DifferenceKind::Signed:
            return colored(signed_difference(picture, reference), kSignedWhite, diverging);
        case DifferenceKind::Relative:
            return colored(relative_error(picture, reference), kErrorWhite, viridis);
        case DifferenceKind::Flip:
            break;
    }
    return colored(hdr_flip(reference, picture), kFlipWhite, viridis);
}

}  // namespace patina
