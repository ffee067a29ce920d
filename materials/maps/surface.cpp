#include "materials/maps/surface.h"

#include "materials/maps/noise.h"

#include <array>
#include <utility>

namespace patina::maps {

namespace {

constexpr float kMax8 = 255.0f;
constexpr float kMax16 = 65535.0f;

std::uint16_t quantized(float value, float maximum) {
    return static_cast<std::uint16_t>(std::lround(saturate(value) * maximum));
}

/// IEC 61966-2-1 by its 255 steps: the code is how many of the steps' linear values lie below.
class SrgbEncoder {
public:
    SrgbEncoder() {
        for (std::size_t i = 0; i < steps_.size(); ++i) {
            const double encoded = (static_cast<double>(i) + 0.5) / 255.0;
            steps_[i] = static_cast<float>(encoded <= 0.04045 ? encoded / 12.92
                                                              : std::pow((encoded + 0.055) / 1.055, 2.4));
        }
    }
    std::uint16_t operator()(float linear) const {
        return static_cast<std::uint16_t>(std::upper_bound(steps_.begin(), steps_.end(), linear) -
                                          steps_.begin());
    }

private:
    std::array<float, 255> steps_{};
};

template <class Color>
MapPicture color_map(std::string file, const Surface& surface, Color&& color) {
    MapPicture picture{std::move(file), surface.size, 3, 8, {}};
    picture.values.reserve(surface.points.size() * 3);
    const SrgbEncoder encode;
    for (const SurfacePoint& point : surface.points) {
        const glm::vec3 linear = color(point);
        for (int c = 0; c < 3; ++c) picture.values.push_back(encode(linear[c]));
    }
    return picture;
}

template <class Value>
MapPicture scalar_map(std::string file, const Surface& surface, Value&& value) {
    MapPicture picture{std::move(file), surface.size, 1, 8, {}};
    picture.values.reserve(surface.points.size());
    for (const SurfacePoint& point : surface.points) picture.values.push_back(quantized(value(point), kMax8));
    return picture;
}

}  // namespace

const SurfacePoint& Surface::at(int x, int y) const {
    const int mask = size - 1;
    return points[static_cast<std::size_t>(y & mask) * static_cast<std::size_t>(size) +
                  static_cast<std::size_t>(x & mask)];
}

MapPicture albedo_map(std::string file, const Surface& surface) {
    return color_map(std::move(file), surface, [](const SurfacePoint& point) { return point.albedo; });
}
MapPicture emission_map(std::string file, const Surface& surface) {
    return color_map(std::move(file), surface, [](const SurfacePoint& point) { return point.emission; });
}
MapPicture roughness_map(std::string file, const Surface& surface) {
    return scalar_map(std::move(file), surface, [](const SurfacePoint& point) { return point.roughness; });
}
MapPicture glossiness_map(std::string file, const Surface& surface) {
    return scalar_map(std::move(file), surface,
                      [](const SurfacePoint& point) { return 1.0f - point.roughness; });
}

MapPicture ao_map(std::string file, const Surface& surface) {
    MapPicture picture{std::move(file), surface.size, 1, 8, {}};
    for (const float open : ambient_occlusion(surface)) picture.values.push_back(quantized(open, kMax8));
    return picture;
}

MapPicture orm_map(std::string file, const Surface& surface) {
    MapPicture picture{std::move(file), surface.size, 3, 8, {}};
    picture.values.reserve(surface.points.size() * 3);
    const std::vector<float> open = ambient_occlusion(surface);
    for (std::size_t i = 0; i < surface.points.size(); ++i)
        for (const float value : {open[i], surface.points[i].roughness, surface.points[i].metallic})
            picture.values.push_back(quantized(value, kMax8));
    return picture;
}

// The height field z = h(x, y) with y up has the normal (−∂h/∂x, −∂h/∂y, 1); rows run down, so ∂h/∂y =
// −∂h/∂row.
MapPicture normal_map(std::string file, const Surface& surface, GreenPoints green, int bits) {
    MapPicture picture{std::move(file), surface.size, 3, bits, {}};
    picture.values.reserve(surface.points.size() * 3);
    const float maximum = bits == 16 ? kMax16 : kMax8;
    const float per_tile = 0.5f * static_cast<float>(surface.size);
    const float up = green == GreenPoints::Up ? 1.0f : -1.0f;
    for (int y = 0; y < surface.size; ++y)
        for (int x = 0; x < surface.size; ++x) {
            const float right = per_tile * (surface.at(x + 1, y).height - surface.at(x - 1, y).height);
            const float down = per_tile * (surface.at(x, y + 1).height - surface.at(x, y - 1).height);
            const float length = std::sqrt(right * right + down * down + 1.0f);
            for (const float n : {-right / length, up * down / length, 1.0f / length})
                picture.values.push_back(quantized(0.5f * n + 0.5f, maximum));
        }
    return picture;
}

// In a vertical slice through a height field everything below the horizon at elevation e is hidden; of the
// cosine-weighted sky cos²e = 1/(1 + tan²e) stays open. Averaged over 16 slices, horizons looked for up to an
// eighth of the tile.
std::vector<float> ambient_occlusion(const Surface& surface) {
    static constexpr std::array<glm::ivec2, 8> directions{
        {{1, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 1}, {-1, 2}, {-1, 1}, {-2, 1}}};
    static constexpr float reach = 0.125f;
    const auto size = static_cast<float>(surface.size);
    const int mask = surface.size - 1;
    std::vector<float> heights;
    heights.reserve(surface.points.size());
    for (const SurfacePoint& point : surface.points) heights.push_back(size * point.height);
    const auto height = [&](int x, int y) {
        return heights[static_cast<std::size_t>(y & mask) * static_cast<std::size_t>(surface.size) +
                       static_cast<std::size_t>(x & mask)];
    };
    const auto open_towards = [&](int x, int y, glm::ivec2 direction) {
        const auto [dx, dy] = std::pair(direction.x, direction.y);
        const float unit = std::sqrt(static_cast<float>(dx * dx + dy * dy));
        const float here = height(x, y);
        float steepest = 0.0f;
        for (int step = 1; static_cast<float>(step) * unit < reach * size; step += 1 + step / 3) {
            const float rise = height(x + dx * step, y + dy * step) - here;
            steepest = std::max(steepest, rise / (unit * static_cast<float>(step)));
        }
        return 1.0f / (1.0f + steepest * steepest);
    };
    std::vector<float> open;
    open.reserve(surface.points.size());
    for (int y = 0; y < surface.size; ++y)
        for (int x = 0; x < surface.size; ++x) {
            float sum = 0.0f;
            for (const glm::ivec2 direction : directions)
                sum += open_towards(x, y, direction) + open_towards(x, y, -direction);
            open.push_back(sum / static_cast<float>(2 * directions.size()));
        }
    return open;
}

}  // namespace patina::maps
