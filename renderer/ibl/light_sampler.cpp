#include "renderer/ibl/light_sampler.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace patina {
namespace {

/// Where sums of shares, ascending, pass u of the last: which share, and how far through it.
struct Place {
    int index = 0;
    double through = 0.0;  ///< [0, 1)
};
template <typename Number>
Place place_of(std::span<const Number> sums, double u) {
    const double wanted = u * double(sums.back());
    const auto passed = std::upper_bound(sums.begin(), sums.end(), Number(wanted));
    const int index = std::min(int(passed - sums.begin()), int(sums.size()) - 1);
    const double before = index > 0 ? double(sums[index - 1]) : 0.0;
    const double share = std::max(double(sums[index]) - before, 1e-300);
    return {index, std::clamp((wanted - before) / share, 0.0, 1.0 - 1e-12)};
}

}  // namespace

LightSampler::LightSampler(PanoramaTexels texels)
    : texels_(std::move(texels)), cells_(divide_light(texels_, kMostCells)) {
    radiance_and_cell_.resize(texels_.radiance.size());
    within_.resize(texels_.radiance.size());
    rows_.resize(cells_.size());
    for (std::size_t k = 0; k < cells_.size(); ++k) {
        LightCell& cell = cells_[k];
        double light = 0.0, area = 0.0;
        std::vector<double> areas;
        for (int y = cell.top; y < cell.bottom; ++y) {
            const double texel = texel_solid_angle(texels_, y);
            double sum = 0.0;
            for (int x = cell.left; x < cell.right; ++x) {
                const std::size_t i = std::size_t(y) * texels_.width + x;
                within_[i] = float(sum += mean_channel(texels_.radiance[i]));
                radiance_and_cell_[i] = {texels_.radiance[i], float(k)};
            }
            rows_[k].push_back(light += sum * texel);
            areas.push_back(area += texel * (cell.right - cell.left));
        }
        cell.light = light;
        if (!(light > 0.0)) rows_[k] = std::move(areas);
        total_ += light;
    }
}

LightSample LightSampler::sample(int cell, glm::dvec2 u) const {
    const LightCell& of = cells_[cell];
    const Place down = place_of(std::span<const double>(rows_[cell]), u.y);
    const int y = of.top + down.index;
    if (!(of.light > 0.0)) {
        const double x = of.left + u.x * (of.right - of.left);
        return {texel_direction(texels_, x, y + down.through), glm::vec3(0.0f), 1.0 / rows_[cell].back()};
    }
    const std::size_t first = std::size_t(y) * texels_.width + of.left;
    const Place along =
        place_of(std::span<const float>(within_).subspan(first, std::size_t(of.right - of.left)), u.x);
    const glm::vec3 radiance = texels_.radiance[first + along.index];
    return {texel_direction(texels_, of.left + along.index + along.through, y + down.through), radiance,
            mean_channel(radiance) / of.light};
}

}  // namespace patina
