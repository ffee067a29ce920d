#include "renderer/gl/light_levels.h"

#include "renderer/brdf.h"
#include "renderer/gl/panorama.h"
#include "renderer/ibl/cube.h"
#include "renderer/ibl/half_simd.h"
#include "renderer/shaders/blocks.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace patina {

namespace {

float largest_of(const CubeMap& cube) {
    return cube.texels.empty() ? 0.0f
                               : simd::largest_of(&cube.texels.front().x, 3 * int(cube.texels.size()), 0.0f);
}

LightLevels::Cube to_halves(const CubeMap& cube, int exponent) {
    LightLevels::Cube halves{cube.size, UnsetVector<std::uint16_t>(4 * cube.texels.size())};
    simd::to_rgba_halves(&cube.texels.front().x, int(cube.texels.size()), std::ldexp(1.0f, -exponent),
                         halves.rgba.data());
    return halves;
}

/// The texel at x, y of a face; one step over an edge it is the neighbouring face's border texel.
glm::vec3 texel_across(const CubeMap& cube, int face, int x, int y) {
    const auto center = [&](int i) {
        const float c = (2.0f * float(i) + 1.0f) / float(cube.size) - 1.0f;
        return std::clamp(c, -1.0f - 1e-4f, 1.0f + 1e-4f);  // just over the edge: the other coordinate stays
    };
    const FacePoint p = face_point(face_direction({face, center(x), center(y)}));
    const auto index = [&](float c) {
        return std::clamp(int(std::floor((c + 1.0f) * 0.5f * float(cube.size))), 0, cube.size - 1);
    };
    return cube.texels[(std::size_t(p.face) * cube.size + index(p.t)) * cube.size + index(p.s)];
}

glm::vec3 bilinear(const CubeMap& cube, int face, float x, float y) {
    const int x0 = int(std::floor(x));
    const int y0 = int(std::floor(y));
    const float fx = x - float(x0);
    const float fy = y - float(y0);
    const glm::vec3 upper =
        (1.0f - fx) * texel_across(cube, face, x0, y0) + fx * texel_across(cube, face, x0 + 1, y0);
    const glm::vec3 lower =
        (1.0f - fx) * texel_across(cube, face, x0, y0 + 1) + fx * texel_across(cube, face, x0 + 1, y0 + 1);
    return (1.0f - fy) * upper + fy * lower;
}

/// A share 0…1 of the second level's light, linear in the logarithm of roughness.
PrefilteredLevel mixed(const PrefilteredLevel& a, const PrefilteredLevel& b, float share) {
    const int size = std::max(a.cube.size, b.cube.size);
    PrefilteredLevel level{a.roughness * std::pow(b.roughness / a.roughness, share), enlarged(a.cube, size)};
    const CubeMap other = enlarged(b.cube, size);
    for (std::size_t i = 0; i < level.cube.texels.size(); ++i)
        level.cube.texels[i] = glm::mix(level.cube.texels[i], other.texels[i], share);
    return level;
}

}  // namespace

int layers_for(const std::vector<int>& sizes) {
    const int count = int(sizes.size());
    const int base = *std::max_element(sizes.begin(), sizes.end());
    for (int layers = 1; layers < count; ++layers) {
        bool fits = true;
        for (int k = 0; k < count; ++k) fits = fits && (base >> (k / layers)) >= sizes[k];
        if (fits) return layers;
    }
    return count;
}

CubeMap enlarged(const CubeMap& cube, int size) {
    CubeMap result{size, std::vector<glm::vec3>(std::size_t(6) * size * size)};
    const float ratio = float(cube.size) / float(size);
    for (int row = 0; row < 6 * size; ++row)
        for (int x = 0; x < size; ++x)
            result.texels[std::size_t(row) * size + x] =
                bilinear(cube, row / size, (float(x) + 0.5f) * ratio - 0.5f,
                         (float(row % size) + 0.5f) * ratio - 0.5f);
    return result;
}

std::vector<PrefilteredLevel> close_gaps(std::vector<PrefilteredLevel> levels) {
    std::vector<PrefilteredLevel> closed;
    closed.reserve(blocks::kMaxLevels);
    int room = blocks::kMaxLevels - int(levels.size());
    for (PrefilteredLevel& level : levels) {
        if (!closed.empty()) {
            const std::size_t last = closed.size() - 1;
            const float steps = brdf::kLevelsPerOctave * std::log2(level.roughness / closed[last].roughness);
            const int added = std::clamp(int(std::ceil(steps - 0.01f)) - 1, 0, std::max(room, 0));
            for (int i = 1; i <= added; ++i)
                closed.push_back(mixed(closed[last], level, float(i) / float(added + 1)));
            room -= added;
        }
        closed.push_back(std::move(level));
    }
    return closed;
}

LightView view_of(const BakedEnvironment& baked) {
    LightView view{.levels = {}, .irradiance = &baked.irradiance, .lights = baked.lights};
    for (const PrefilteredLevel& level : baked.levels) view.levels.push_back(&level);
    return view;
}

LightLevels make_light_levels(const LightView& baked, const ParallelFor& parallel_for) {
    if (baked.levels.empty() || !baked.irradiance || baked.irradiance->size < 1)
        throw std::runtime_error("The light has no levels to draw with: bake it again.");
    std::vector<int> sizes;
    float largest = 0.0f;
    LightLevels result;
    for (const PrefilteredLevel* level : baked.levels) {
        sizes.push_back(level->cube.size);
        largest = std::max(largest, largest_of(level->cube));
        result.roughness.push_back(level->roughness);
    }
    result.levels_exponent = half_exponent(largest);
    result.layers = layers_for(sizes);
    const int base = *std::max_element(sizes.begin(), sizes.end());
    result.levels.resize(baked.levels.size());
    parallel_for(int(baked.levels.size()), [&](int k) {
        const int size = std::max(base >> (k / result.layers), 1);
        const CubeMap& cube = baked.levels[k]->cube;
        result.levels[k] = to_halves(cube.size == size ? cube : enlarged(cube, size), result.levels_exponent);
    });
    result.irradiance_exponent = half_exponent(largest_of(*baked.irradiance));
    result.irradiance = to_halves(*baked.irradiance, result.irradiance_exponent);
    result.sharpest = result.roughness.front();
    result.lights.assign(baked.lights.begin(), baked.lights.end());
    return result;
}

LightLevels make_light_levels(const BakedEnvironment& baked) { return make_light_levels(view_of(baked)); }

}  // namespace patina
