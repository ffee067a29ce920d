// Float targets in which the reference picture gathers, and the passes over them.
#pragma once

#include "renderer/gl/environment.h"
#include "renderer/gl/surfaces.h"
#include "renderer/gl/target.h"
#include "renderer/ibl/light_sampler.h"
#include "renderer/shaders/blocks.h"

#include <glm/vec4.hpp>

#include <array>
#include <vector>

namespace patina {

/// Replicates are independent estimates of the picture; their scatter tells how well it is known.
struct ReferenceTarget {
    static constexpr int kReplicates = 8;
    glm::ivec2 size{1};
    gl::Texture sum;           ///< of all replicates, slices by their weights; alpha: coverage likewise
    gl::Texture replicates;    ///< one layer each: likewise, the mean of the three channels, the mesh only
    gl::Texture counts;        ///< two a pixel: points before the counts were set; 1: it gathers, 0: it rests
    gl::Buffer points;         ///< blocks.h's PointBlock
    gl::Texture light_points;  ///< a column a cell, two rows a point: direction and density; radiance
    gl::Texture light_cells;   ///< of every texel of the panorama, which cell it lies in
    gl::SurfaceScratch surface;                             ///< what the slice's picture shows
    std::array<gl::Framebuffer, kReplicates> framebuffers;  ///< sum and one replicate
    gl::Program mean, resting;
    gl::VertexArray nothing;
};

namespace gl {

/// Throws std::runtime_error where the driver has no room.
ReferenceTarget make_reference_target(glm::ivec2 size);
/// Everything back to black.
void clear_reference(ReferenceTarget& target);
/// Two a pixel, as ReferenceTarget::counts, bottom row first: those that rest are left as they are from now
/// on.
void set_reference_counts(ReferenceTarget& target, const std::vector<float>& counts);
/// The light of the slices that follow.
void set_reference_light(ReferenceTarget& target, const LightSampler& light);
/// The points of a slice that draw from the light: in each cell one a point, row by row as
/// ReferenceTarget::light_points.
struct LightPoints {
    int cells = 0;
    std::vector<glm::vec4> rows;
};
/// The points of the slices that follow.
void set_reference_points(ReferenceTarget& target, const blocks::PointBlock& points,
                          const LightPoints& light);

/// Between begin and end the mesh's material is drawn into target.surface. rows: to which all is kept until
/// the slice ends; from, to.
void begin_reference_surface(ReferenceTarget& target, SurfaceMaps maps, glm::ivec2 rows);
/// Between begin and end what is drawn is added to the sum, weight (0…1) times: the surface, in a replicate
/// too; then what is behind it, at its depth.
void begin_reference_slice(const ReferenceTarget& target, int replicate, float weight);
void begin_reference_background();
void end_reference_slice();

/// Of a pixel since the counts were set: all have so many, the first rows more.
struct GatheredPoints {
    int all = 0;
    int rows = 0;
    int more = 0;
};
/// The mean so far into an ordinary target's radiance (one sample a pixel, the same size); black where there
/// are no points yet. weight: of one of them.
void write_reference_mean(const ReferenceTarget& target, const GatheredPoints& points, float weight,
                          const RenderTarget& to);

/// One layer after the other, each bottom row first.
std::vector<float> read_replicates(const ReferenceTarget& target);

/// Returns when all that was asked of the driver is done.
void wait_for_gpu();

/// The time the GPU spends on what is asked of it between the constructor and milliseconds().
class GpuTimer {
public:
    GpuTimer();
    ~GpuTimer();
    GpuTimer(const GpuTimer&) = delete;
    GpuTimer& operator=(const GpuTimer&) = delete;
    double milliseconds() const;  ///< ends the measurement and waits for it; call once

private:
    GLuint query_ = 0;
};

/// The panorama as the shader sees it, without exposure.
PanoramaTexels read_panorama(const GpuEnvironment& environment);

}  // namespace gl
}  // namespace patina
