#include "renderer/core/flip.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>
#include <vector>

namespace patina {

namespace {

using glm::vec3;

constexpr double kPi = std::numbers::pi;

template <class T>
struct Plane {
    int width = 0, height = 0;
    std::vector<T> values;
    T& at(int x, int y) { return values[std::size_t(y) * width + x]; }
    const T& at(int x, int y) const { return values[std::size_t(y) * width + x]; }
};
template <class T>
Plane<T> make_plane(int width, int height) {
    return {width, height, std::vector<T>(std::size_t(width) * height)};
}

Plane<vec3> read_plane(const Image& image) {
    auto plane = make_plane<vec3>(image.width, image.height);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            plane.at(x, y) = {texel(image, x, y, 0), texel(image, x, y, 1), texel(image, x, y, 2)};
    return plane;
}

// ---- colour ----

const vec3 kWhite(0.950428545f, 1.0f, 1.088900371f);  ///< XYZ of D65 as Rec. 709's white

vec3 xyz_of(vec3 c) {
    return {0.4124f * c.x + 0.3576f * c.y + 0.1805f * c.z, 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z,
            0.0193f * c.x + 0.1192f * c.y + 0.9505f * c.z};
}
vec3 rgb_of_xyz(vec3 c) {
    return {3.2406f * c.x - 1.5372f * c.y - 0.4986f * c.z, -0.9689f * c.x + 1.8758f * c.y + 0.0415f * c.z,
            0.0557f * c.x - 0.2040f * c.y + 1.0570f * c.z};
}

/// The linearised opponent space in which contrast sensitivity is known.
vec3 opponent_of(vec3 rgb) {
    const vec3 t = xyz_of(rgb) / kWhite;
    return {116.0f * t.y - 16.0f, 500.0f * (t.x - t.y), 200.0f * (t.y - t.z)};
}
vec3 rgb_of_opponent(vec3 c) {
    const float y = (c.x + 16.0f) / 116.0f;
    return rgb_of_xyz(vec3(y + c.y / 500.0f, y, y - c.z / 200.0f) * kWhite);
}

float lab_curve(float t) {
    constexpr float delta = 6.0f / 29.0f;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3.0f * delta * delta) + 4.0f / 29.0f;
}
/// L*a*b* with chroma scaled by lightness (Hunt's effect: dark colours look less colourful).
vec3 hunt_lab_of(vec3 rgb) {
    const vec3 t = xyz_of(rgb) / kWhite;
    const float x = lab_curve(t.x), y = lab_curve(t.y), z = lab_curve(t.z);
    const float L = 116.0f * y - 16.0f;
    return {L, 0.01f * L * 500.0f * (x - y), 0.01f * L * 200.0f * (y - z)};
}
float hyab(vec3 a, vec3 b) {
    const vec3 d = a - b;
    return std::abs(d.x) + std::sqrt(d.y * d.y + d.z * d.z);
}

// ---- filters: each a product of a row's and a column's ----

using Kernel = std::vector<float>;  ///< odd length

template <class T>
Plane<T> filtered(const Plane<T>& source, const Kernel& row, const Kernel& column) {
    const int width = source.width, height = source.height;
    auto between = make_plane<T>(width, height), result = make_plane<T>(width, height);
    const int across = int(row.size() / 2), down = int(column.size() / 2);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            T sum(0.0f);
            for (int i = -across; i <= across; ++i)
                sum += row[i + across] * source.at(std::clamp(x + i, 0, width - 1), y);
            between.at(x, y) = sum;
        }
    for (int y = 0; y < height; ++y)
        for (int i = -down; i <= down; ++i) {
            const T* from = &between.at(0, std::clamp(y + i, 0, height - 1));
            T* to = &result.at(0, y);
            for (int x = 0; x < width; ++x) to[x] += column[i + down] * from[x];
        }
    return result;
}

/// exp(−π² d²/b), d in degrees, of sum 1.
Kernel contrast_kernel(double b, int radius, double pixels_per_degree) {
    Kernel kernel;
    double sum = 0.0;
    for (int i = -radius; i <= radius; ++i) {
        const double d = i / pixels_per_degree;
        kernel.push_back(float(std::exp(-kPi * kPi * d * d / b)));
        sum += double(kernel.back());
    }
    for (float& each : kernel) each = float(double(each) / sum);
    return kernel;
}

double sum_over_square(double b, int radius, double pixels_per_degree) {
    double line = 0.0;
    for (int i = -radius; i <= radius; ++i)
        line += std::exp(-kPi * kPi * std::pow(i / pixels_per_degree, 2) / b);
    return line * line;
}

/// What the eye resolves of each opponent channel (table 1 of the paper; the blue-yellow one is a sum of
/// two).
Plane<vec3> as_the_eye_sees(const Plane<vec3>& opponent, double pixels_per_degree) {
    constexpr double achromatic = 0.0047, red_green = 0.0053, wide = 0.04, narrow = 0.025;
    constexpr double wide_scale = 34.1, narrow_scale = 13.5;
    const int radius = int(std::ceil(3.0 * std::sqrt(wide / (2.0 * kPi * kPi)) * pixels_per_degree));
    const auto kernel = [&](double b) { return contrast_kernel(b, radius, pixels_per_degree); };
    const auto weight = [&](double scale, double b) {
        return scale * std::sqrt(kPi / b) * sum_over_square(b, radius, pixels_per_degree);
    };
    const double first = weight(wide_scale, wide), second = weight(narrow_scale, narrow);
    const float share = float(first / (first + second));
    const Plane<vec3> one = filtered(opponent, kernel(achromatic), kernel(achromatic));
    const Plane<vec3> two = filtered(opponent, kernel(red_green), kernel(red_green));
    const Plane<vec3> three = filtered(opponent, kernel(wide), kernel(wide));
    Plane<vec3> result = filtered(opponent, kernel(narrow), kernel(narrow));
    for (std::size_t i = 0; i < result.values.size(); ++i)
        result.values[i] = {one.values[i].x, two.values[i].y,
                            share * three.values[i].z + (1.0f - share) * result.values[i].z};
    return result;
}

// ---- features: edges and points ----

struct FeatureKernels {
    Kernel smooth, edge, point;
};
/// First and second derivatives of a Gaussian; what is positive adds up to 1 and what is negative to −1.
FeatureKernels feature_kernels(double pixels_per_degree) {
    const double sigma = 0.5 * 0.082 * pixels_per_degree;
    const int radius = int(std::ceil(3.0 * sigma));
    FeatureKernels kernels;
    const auto balance = [](Kernel& kernel) {
        double above = 0.0, below = 0.0;
        for (const float each : kernel) (each > 0.0f ? above : below) += std::abs(double(each));
        for (float& each : kernel)
            each = float(double(each) / (each > 0.0f ? above : std::max(below, 1e-12)));
    };
    for (int i = -radius; i <= radius; ++i) {
        const double g = std::exp(-i * i / (2.0 * sigma * sigma));
        kernels.smooth.push_back(float(g));
        kernels.edge.push_back(float(-i * g));
        kernels.point.push_back(float((i * i / (sigma * sigma) - 1.0) * g));
    }
    balance(kernels.smooth);
    balance(kernels.edge);
    balance(kernels.point);
    return kernels;
}

struct Features {
    Plane<float> edge, point;  ///< strengths
};
Features features_of(const Plane<vec3>& opponent, const FeatureKernels& kernels) {
    auto grey = make_plane<float>(opponent.width, opponent.height);
    for (std::size_t i = 0; i < grey.values.size(); ++i)
        grey.values[i] = (opponent.values[i].x + 16.0f) / 116.0f;
    const auto strength = [&](const Kernel& kernel) {
        Plane<float> x = filtered(grey, kernel, kernels.smooth);
        const Plane<float> y = filtered(grey, kernels.smooth, kernel);
        for (std::size_t i = 0; i < x.values.size(); ++i) x.values[i] = std::hypot(x.values[i], y.values[i]);
        return x;
    };
    return {strength(kernels.edge), strength(kernels.point)};
}

// ---- the difference ----

/// Large differences of colour are all alike: 0.4 of the largest is mapped to 0.95.
float color_difference(vec3 reference, vec3 test) {
    static const float largest =
        std::pow(hyab(hunt_lab_of(vec3(0.0f, 1.0f, 0.0f)), hunt_lab_of(vec3(0.0f, 0.0f, 1.0f))), 0.7f);
    const float error = std::pow(hyab(hunt_lab_of(reference), hunt_lab_of(test)), 0.7f);
    const float knee = 0.4f * largest;
    if (error < knee) return 0.95f / knee * error;
    return std::min(0.95f + (error - knee) / (largest - knee) * 0.05f, 1.0f);
}

Plane<float> flip_planes(const Plane<vec3>& reference, const Plane<vec3>& test, double pixels_per_degree) {
    Plane<vec3> opponent[2] = {reference, test};
    for (Plane<vec3>& plane : opponent)
        for (vec3& value : plane.values) value = opponent_of(glm::clamp(value, 0.0f, 1.0f));
    const Plane<vec3> seen[2] = {as_the_eye_sees(opponent[0], pixels_per_degree),
                                 as_the_eye_sees(opponent[1], pixels_per_degree)};
    const FeatureKernels kernels = feature_kernels(pixels_per_degree);
    const Features features[2] = {features_of(opponent[0], kernels), features_of(opponent[1], kernels)};
    auto result = make_plane<float>(reference.width, reference.height);
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        const auto rgb = [&](int which) {
            return glm::clamp(rgb_of_opponent(seen[which].values[i]), 0.0f, 1.0f);
        };
        const float color = color_difference(rgb(0), rgb(1));
        const float feature = std::max(std::abs(features[0].edge.values[i] - features[1].edge.values[i]),
                                       std::abs(features[0].point.values[i] - features[1].point.values[i]));
        const float exponent = 1.0f - std::sqrt(std::clamp(feature / std::sqrt(2.0f), 0.0f, 1.0f));
        result.values[i] = color > 0.0f ? std::pow(color, exponent) : 0.0f;
    }
    return result;
}

Image to_image(const Plane<float>& plane) {
    Image image = make_image(plane.width, plane.height, 1, PixelType::F32);
    std::memcpy(image.bytes.data(), plane.values.data(), image.bytes.size());
    return image;
}

// ---- high dynamic range ----

/// Narkowicz's fit of ACES with its exposure of 0.6 folded in: (a x² + b x)/(c x² + d x + e).
constexpr double kAces[] = {0.6 * 0.6 * 2.51, 0.6 * 0.03, 0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14};

float aces(float x) {
    const double v = std::clamp(double(x), 0.0, 1e12);
    return float((kAces[0] * v + kAces[1]) * v / ((kAces[2] * v + kAces[3]) * v + kAces[4]));
}

/// The value that ACES maps to 0.85.
double nearly_white() {
    constexpr double t = 0.85;
    const double a = kAces[0] - t * kAces[2], b = kAces[1] - t * kAces[3], c = -t * kAces[4];
    return (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
}

}  // namespace

Image flip(const Image& reference, const Image& test, double pixels_per_degree) {
    assert(reference.width == test.width && reference.height == test.height);
    return to_image(flip_planes(read_plane(reference), read_plane(test), pixels_per_degree));
}

FlipExposures flip_exposures(const Image& reference) {
    std::vector<double> luminance;
    for (const vec3& c : read_plane(reference).values)
        luminance.push_back(std::max(0.0, double(0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z)));
    if (luminance.empty()) return {};
    const auto middle = luminance.begin() + std::ptrdiff_t(luminance.size() / 2);
    std::nth_element(luminance.begin(), middle, luminance.end());
    const double median = std::max(*middle, 1e-10);
    const double most = std::max(*std::max_element(luminance.begin(), luminance.end()), 1e-10);
    FlipExposures result{std::log2(nearly_white() / most), std::log2(nearly_white() / median)};
    result.last_ev = std::min(result.last_ev, result.first_ev + 24.0);
    result.count = std::max(2, int(std::ceil(result.last_ev - result.first_ev)));
    return result;
}

Image hdr_flip(const Image& reference, const Image& test, double pixels_per_degree) {
    assert(reference.width == test.width && reference.height == test.height);
    const FlipExposures exposures = flip_exposures(reference);
    const Plane<vec3> pictures[2] = {read_plane(reference), read_plane(test)};
    auto largest = make_plane<float>(reference.width, reference.height);
    for (int k = 0; k < exposures.count; ++k) {
        const double share = double(k) / (exposures.count - 1);
        const auto factor =
            float(std::exp2(exposures.first_ev + share * (exposures.last_ev - exposures.first_ev)));
        Plane<vec3> mapped[2] = {pictures[0], pictures[1]};
        for (Plane<vec3>& plane : mapped)
            for (vec3& c : plane.values) c = {aces(factor * c.x), aces(factor * c.y), aces(factor * c.z)};
        const Plane<float> now = flip_planes(mapped[0], mapped[1], pixels_per_degree);
        for (std::size_t i = 0; i < now.values.size(); ++i)
            largest.values[i] = std::max(largest.values[i], now.values[i]);
    }
    return to_image(largest);
}

}  // namespace patina
