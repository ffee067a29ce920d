#include "renderer/gl/panorama.h"

#include "renderer/gl/half.h"
#include "renderer/ibl/lights.h"

#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

struct Plane {
    int width = 0;
    int height = 0;
    std::vector<glm::vec4> texels;
};

/// How the source texels of one axis share out among half as many: three taps of a box filter, two where it
/// divides.
struct Taps {
    int first = 0;
    float weight[3] = {1.0f, 0.0f, 0.0f};
};

std::vector<Taps> box_taps(int size, int smaller) {
    std::vector<Taps> taps(std::size_t(smaller), Taps{});
    const double step = double(size) / smaller;
    for (int i = 0; i < smaller; ++i) {
        const double begin = i * step;
        const double end = (i + 1) * step;
        taps[i].first = std::min(int(begin), size - 1);
        for (int k = 0; k < 3; ++k) {
            const double lo = std::max(begin, double(taps[i].first + k));
            const double hi = std::min(end, double(taps[i].first + k + 1));
            taps[i].weight[k] = float(std::max(hi - lo, 0.0) / step);
        }
    }
    return taps;
}

Plane halved(const Plane& source) {
    Plane result{std::max(source.width / 2, 1), std::max(source.height / 2, 1), {}};
    result.texels.resize(std::size_t(result.width) * result.height);
    const auto columns = box_taps(source.width, result.width);
    const auto rows = box_taps(source.height, result.height);
    for (int y = 0; y < result.height; ++y) {
        for (int j = 0; j < 3; ++j) {
            if (rows[y].weight[j] == 0.0f) continue;
            const glm::vec4* from = &source.texels[std::size_t(rows[y].first + j) * source.width];
            glm::vec4* to = &result.texels[std::size_t(y) * result.width];
            for (int x = 0; x < result.width; ++x) {
                const Taps& tap = columns[x];
                glm::vec4 sum = tap.weight[0] * from[tap.first];
                if (tap.weight[1] != 0.0f) sum += tap.weight[1] * from[tap.first + 1];
                if (tap.weight[2] != 0.0f) sum += tap.weight[2] * from[tap.first + 2];
                to[x] += rows[y].weight[j] * sum;
            }
        }
    }
    return result;
}

/// Averages a row around the circle over width texels (a real number > 1), each texel over the arc centred on
/// it.
void blur_around(glm::vec4* row, int count, double width) {
    width = std::min(width, double(count));
    std::vector<glm::dvec4> before(std::size_t(count) + 1,
                                   glm::dvec4(0.0));  // sum of all texels left of an edge
    for (int x = 0; x < count; ++x) before[x + 1] = before[x] + glm::dvec4(row[x]);
    const auto sum_to = [&](double edge) {  // of the periodic, piecewise constant row
        const double turns = std::floor(edge / count);
        const double inside = edge - turns * count;
        const int whole = std::min(int(inside), count - 1);
        return turns * before[count] + before[whole] + (inside - whole) * (before[whole + 1] - before[whole]);
    };
    for (int x = 0; x < count; ++x) {
        const double center = x + 0.5;
        const glm::dvec4 sum = sum_to(center + 0.5 * width) - sum_to(center - 0.5 * width);
        row[x] = glm::max(glm::vec4(sum / width), glm::vec4(0.0f));
    }
}

/// Towards a pole a texel narrows with sin θ: averaging along its row until it is as wide as it is high makes
/// it cover an isotropic patch, and at the pole itself all azimuths agree. The full-size level is left as it
/// is.
Plane isotropic(Plane plane) {
    const double height_rad = M_PI / plane.height;
    const double width_rad = 2.0 * M_PI / plane.width;
    for (int y = 0; y < plane.height; ++y) {
        const double texels = height_rad / (width_rad * std::sin((y + 0.5) * height_rad));
        if (texels > 1.01) blur_around(&plane.texels[std::size_t(y) * plane.width], plane.width, texels);
    }
    return plane;
}

PanoramaLevels::Level to_level(const Plane& plane, int exponent) {
    PanoramaLevels::Level level{plane.width, plane.height, {}};
    level.rgba.resize(4 * plane.texels.size());
    const float scale = std::ldexp(1.0f, -exponent);
    for (std::size_t i = 0; i < plane.texels.size(); ++i)
        for (int c = 0; c < 4; ++c) level.rgba[4 * i + c] = gl::to_half(plane.texels[i][c] * scale);
    return level;
}

/// Radiance with the extracted lights apart.
Plane without_lights(const Environment& environment, std::vector<ExtractedLight>& lights) {
    Plane plane{environment.width, environment.height, {}};
    plane.texels.reserve(environment.radiance.size());
    for (const glm::vec3& texel : environment.radiance) plane.texels.emplace_back(texel, 0.0f);
    const RadianceStatistics statistics = radiance_statistics(view_of(environment), serial_for);
    const LightExtraction extraction = extract_lights(environment, statistics, {});
    for (const auto& texels : extraction.texels)
        for (const LightTexel& texel : texels)
            plane.texels[std::size_t(texel.y) * plane.width + texel.x] +=
                glm::vec4(-texel.excess, (texel.excess.x + texel.excess.y + texel.excess.z) / 3.0f);
    for (glm::vec4& texel : plane.texels) texel = glm::max(texel, glm::vec4(0.0f));
    lights = extraction.lights;
    return plane;
}

}  // namespace

int half_exponent(float largest) {
    if (!(largest > 0.0f)) return 0;
    return std::clamp(int(std::ceil(std::log2(largest))) - 15, -110, 113);
}

PanoramaLevels make_panorama_levels(const Environment& environment, int max_width) {
    PanoramaLevels result;
    float largest = 0.0f;
    for (const glm::vec3& texel : environment.radiance)
        largest = std::max({largest, texel.x, texel.y, texel.z});
    result.exponent = half_exponent(largest);
    Plane plane = without_lights(environment, result.lights);
    while (plane.width > max_width || plane.height > max_width) plane = halved(plane);
    result.levels.push_back(to_level(plane, result.exponent));
    while (plane.width > 1 || plane.height > 1) {
        plane = halved(plane);
        result.levels.push_back(to_level(isotropic(plane), result.exponent));
    }
    return result;
}

}  // namespace patina
