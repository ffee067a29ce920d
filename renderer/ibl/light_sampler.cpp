#include "renderer/ibl/light_sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace patina {
namespace {

constexpr double kPi = std::numbers::pi;

double mean_channel(glm::vec3 radiance) {
    return (double(radiance.x) + double(radiance.y) + double(radiance.z)) / 3.0;
}

/// cosθ falls evenly through a row, so that the density is constant over the solid angle.
glm::dvec3 direction_in(const PanoramaTexels& texels, double x, double y) {
    const int row = std::min(int(y), texels.height - 1);
    const double top = std::cos(row * kPi / texels.height);
    const double bottom = std::cos((row + 1) * kPi / texels.height);
    const double cosine = std::clamp(top + (y - row) * (bottom - top), -1.0, 1.0);
    const double sine = std::sqrt((1.0 - cosine) * (1.0 + cosine));
    const double phi = 2.0 * kPi * x / texels.width;
    return {-sine * std::sin(phi), cosine, sine * std::cos(phi)};
}

}  // namespace

LightSampler::LightSampler(PanoramaTexels texels) : texels_(std::move(texels)) {
    const int width = texels_.width, height = texels_.height;
    rows_.resize(std::size_t(height));
    within_.resize(texels_.radiance.size());
    std::vector<double> sums(static_cast<std::size_t>(width));
    for (int y = 0; y < height; ++y) {
        const glm::vec3* row = &texels_.radiance[std::size_t(y) * width];
        double sum = 0.0;
        for (int x = 0; x < width; ++x) sums[x] = sum += mean_channel(row[x]);
        float* within = &within_[std::size_t(y) * width];
        for (int x = 0; x < width; ++x)
            within[x] = sum > 0.0 ? float(sums[x] / sum) : float(x + 1) / float(width);
        const double ring = std::cos(y * kPi / height) - std::cos((y + 1) * kPi / height);
        rows_[y] = total_ += sum * ring * 2.0 * kPi / width;
    }
}

LightSample LightSampler::sample(glm::dvec2 u) const {
    const int width = texels_.width, height = texels_.height;
    if (!(total_ > 0.0)) {
        const double cosine = 1.0 - 2.0 * u.y, phi = 2.0 * kPi * u.x;
        const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
        return {{-sine * std::sin(phi), cosine, sine * std::cos(phi)}, glm::vec3(0.0f), 1.0 / (4.0 * kPi)};
    }
    const double light = u.y * total_;
    const int y =
        std::min(int(std::upper_bound(rows_.begin(), rows_.end(), light) - rows_.begin()), height - 1);
    const double above = y > 0 ? rows_[y - 1] : 0.0;
    const double down = std::clamp((light - above) / std::max(rows_[y] - above, 1e-300), 0.0, 1.0 - 1e-12);
    const float* within = &within_[std::size_t(y) * width];
    const int x = std::min(int(std::upper_bound(within, within + width, float(u.x)) - within), width - 1);
    const double before = x > 0 ? double(within[x - 1]) : 0.0;
    const double along =
        std::clamp((u.x - before) / std::max(double(within[x]) - before, 1e-300), 0.0, 1.0 - 1e-12);
    const glm::vec3 radiance = texels_.radiance[std::size_t(y) * width + x];
    return {direction_in(texels_, x + along, y + down), radiance, mean_channel(radiance) / total_};
}

}  // namespace patina
