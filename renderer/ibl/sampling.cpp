#include "renderer/ibl/sampling.h"

#include "renderer/ibl/cube.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patina {
namespace {

/// A right-handed frame around N (Duff et al. 2017).
void make_frame(glm::vec3 N, glm::vec3& T, glm::vec3& B) {
    const float sign = std::copysign(1.0f, N.z);
    const float a = -1.0f / (sign + N.z);
    const float b = N.x * N.y * a;
    T = {1.0f + sign * N.x * N.x * a, sign * b, -sign * N.x};
    B = {b, sign + N.y * N.y * a, -N.y};
}

struct LobeSample {
    glm::vec3 direction;  ///< around +Z
    float weight;         ///< sums to 1
    float lod;
};

/// h distributed as D(h)·NoH on a Hammersley-like Fibonacci spiral; l = reflection of N about h, whose
/// density is D/4 because NoH = VoH when V = N. What is left of the kernel D·NoL is NoL.
std::vector<LobeSample> lobe_samples(double alpha, int count, int source_size) {
    const double golden = std::numbers::phi - 1.0;
    const double texel = 4.0 * std::numbers::pi / (6.0 * source_size * source_size);
    std::vector<LobeSample> samples;
    double total = 0.0;
    for (int i = 0; i < count; ++i) {
        const double u = (i + 0.5) / count;
        const double phi = 2.0 * std::numbers::pi * i * golden;
        const double cos2 = (1.0 - u) / (1.0 + (alpha * alpha - 1.0) * u);
        const double NoL = 2.0 * cos2 - 1.0;
        if (NoL <= 0.0) continue;
        const double sine = std::sqrt(std::max(0.0, 1.0 - NoL * NoL));
        const double d = 1.0 - cos2 + alpha * alpha * cos2;
        const double density = alpha * alpha / (std::numbers::pi * d * d) / 4.0;
        const double lod = std::max(0.0, 0.5 * std::log2(1.0 / (count * density * texel)) + 1.0);
        samples.push_back(
            {glm::vec3(sine * std::cos(phi), sine * std::sin(phi), NoL), float(NoL), float(lod)});
        total += NoL;
    }
    for (LobeSample& sample : samples) sample.weight = float(sample.weight / total);
    return samples;
}

}  // namespace

CubePyramid::CubePyramid(const Environment& environment, int face_size, const ParallelFor& parallel_for) {
    const CubeMap cube = resample_environment(environment, face_size, parallel_for);
    Level base{face_size, std::vector<glm::vec3>(std::size_t(6) * (face_size + 2) * (face_size + 2))};
    for (int i = 0; i < 6 * face_size * face_size; ++i)
        base.texels[base.at(i / (face_size * face_size), i % face_size, i / face_size % face_size)] =
            cube.texels[i];
    fill_border(base);
    levels_.push_back(std::move(base));
    while (levels_.back().size > 1) {
        const Level& fine = levels_.back();
        const int size = fine.size / 2;
        Level coarse{size, std::vector<glm::vec3>(std::size_t(6) * (size + 2) * (size + 2))};
        for (int k = 0; k < 6 * size * size; ++k) {
            const int face = k / (size * size), y = k / size % size, x = k % size;
            glm::vec3 sum(0.0f);
            float weight = 0.0f;
            for (int j = 0; j < 4; ++j) {
                const int fx = 2 * x + j % 2, fy = 2 * y + j / 2;
                const float area = float(cube_texel_solid_angle(fine.size, fx, fy));
                sum += fine.texels[fine.at(face, fx, fy)] * area;
                weight += area;
            }
            coarse.texels[coarse.at(face, x, y)] = sum / weight;
        }
        fill_border(coarse);
        levels_.push_back(std::move(coarse));
    }
}

void CubePyramid::fill_border(Level& level) {
    const int n = level.size;
    const auto neighbour = [&](int face, int x, int y) {
        const FacePoint p = face_point(face_direction(face, (2.0f * float(x) + 1.0f) / float(n) - 1.0f,
                                                      (2.0f * float(y) + 1.0f) / float(n) - 1.0f));
        const int nx = std::clamp(int((p.s * 0.5f + 0.5f) * float(n)), 0, n - 1);
        const int ny = std::clamp(int((p.t * 0.5f + 0.5f) * float(n)), 0, n - 1);
        return level.texels[level.at(p.face, nx, ny)];
    };
    for (int face = 0; face < 6; ++face) {
        for (int k = 0; k < n; ++k) {
            level.texels[level.at(face, -1, k)] = neighbour(face, -1, k);
            level.texels[level.at(face, n, k)] = neighbour(face, n, k);
            level.texels[level.at(face, k, -1)] = neighbour(face, k, -1);
            level.texels[level.at(face, k, n)] = neighbour(face, k, n);
        }
        for (int corner = 0; corner < 4; ++corner) {
            const int x = corner % 2 ? n : -1, y = corner / 2 ? n : -1;
            const int ix = std::clamp(x, 0, n - 1), iy = std::clamp(y, 0, n - 1);
            level.texels[level.at(face, x, y)] =
                (level.texels[level.at(face, ix, iy)] + level.texels[level.at(face, ix, y)] +
                 level.texels[level.at(face, x, iy)]) /
                3.0f;
        }
    }
}

glm::vec3 CubePyramid::bilinear(const Level& level, glm::vec3 direction) {
    const FacePoint p = face_point(direction);
    const float x = (p.s * 0.5f + 0.5f) * float(level.size) - 0.5f;
    const float y = (p.t * 0.5f + 0.5f) * float(level.size) - 0.5f;
    const int x0 = std::clamp(int(std::floor(x)), -1, level.size - 1);
    const int y0 = std::clamp(int(std::floor(y)), -1, level.size - 1);
    const float fx = x - float(x0), fy = y - float(y0);
    const glm::vec3* texel = &level.texels[level.at(p.face, x0, y0)];
    const int stride = level.size + 2;
    return glm::mix(glm::mix(texel[0], texel[1], fx), glm::mix(texel[stride], texel[stride + 1], fx), fy);
}

glm::vec3 CubePyramid::sample(glm::vec3 direction, float lod) const {
    lod = std::clamp(lod, 0.0f, float(levels_.size() - 1));
    const int level = int(lod);
    const float fraction = lod - float(level);
    const glm::vec3 fine = bilinear(levels_[level], direction);
    return fraction > 0.0f ? glm::mix(fine, bilinear(levels_[level + 1], direction), fraction) : fine;
}

std::vector<glm::vec3> sample_prefiltered(const CubePyramid& source, float roughness, int samples,
                                          const std::vector<glm::vec3>& directions,
                                          const BakeControl& control) {
    std::vector<glm::vec3> result(directions.size(), glm::vec3(0.0f));
    const std::vector<LobeSample> lobe =
        lobe_samples(double(roughness) * roughness, samples, source.face_size());
    constexpr int together = 16;
    const int count = int(directions.size());
    control.parallel_for((count + together - 1) / together, [&](int task) {
        if (control.stop.stop_requested()) return;
        for (int i = task * together; i < std::min(count, (task + 1) * together); ++i) {
            glm::vec3 T, B;
            make_frame(directions[i], T, B);
            glm::vec3 sum(0.0f);
            for (const LobeSample& s : lobe)
                sum += s.weight *
                       source.sample(T * s.direction.x + B * s.direction.y + directions[i] * s.direction.z,
                                     s.lod);
            result[i] = sum;
        }
    });
    return result;
}

CubeMap prefilter_by_sampling(const CubePyramid& source, float roughness, int samples, int face_size,
                              const BakeControl& control) {
    std::vector<glm::vec3> directions;
    directions.reserve(std::size_t(6) * face_size * face_size);
    for (int i = 0; i < 6 * face_size * face_size; ++i)
        directions.push_back(cube_texel_direction(face_size, i / (face_size * face_size), i % face_size,
                                                  i / face_size % face_size));
    return {face_size, sample_prefiltered(source, roughness, samples, directions, control)};
}

}  // namespace patina
