// Filtered importance sampling: how most tools prefilter an environment, kept to compare against. Knows no
// files, no GL.
#pragma once

#include "renderer/ibl/bake.h"

#include <vector>

namespace patina {

/// The environment as a cube map with all its mipmaps, each face surrounded by one texel of its neighbours.
class CubePyramid {
public:
    CubePyramid(const Environment& environment, int face_size, const ParallelFor& parallel_for);

    int face_size() const { return levels_.front().size; }
    int level_count() const { return int(levels_.size()); }
    /// Bilinear on a level, linear between levels; seamless. lod is clamped to what exists.
    glm::vec3 sample(glm::vec3 direction, float lod) const;

private:
    struct Level {
        int size = 0;
        std::vector<glm::vec3> texels;  ///< six faces of (size + 2)²
        std::size_t at(int face, int x, int y) const {
            return (std::size_t(face) * (size + 2) + (y + 1)) * (size + 2) + (x + 1);
        }
    };
    static void fill_border(Level& level);
    static glm::vec3 bilinear(const Level& level, glm::vec3 direction);
    std::vector<Level> levels_;
};

/// The environment itself on cube faces, each texel the mean over its solid angle; a single bright texel
/// keeps its energy within 1 %.
CubeMap resample_environment(const Environment& environment, int face_size, const ParallelFor& parallel_for);

/// A level in some directions by filtered importance sampling of D(h) with that many samples (Křivánek &
/// Colbert, GPU Gems 3): a sample reads the mip level whose texels are as large as the solid angle it stands
/// for. roughness 0 copies the environment.
std::vector<glm::vec3> sample_prefiltered(const CubePyramid& source, float roughness, int samples,
                                          const std::vector<glm::vec3>& directions,
                                          const BakeControl& control);
/// The same for every texel of a cube.
CubeMap prefilter_by_sampling(const CubePyramid& source, float roughness, int samples, int face_size,
                              const BakeControl& control);

}  // namespace patina
