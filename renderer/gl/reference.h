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

/// A row of texels of which shaders read one.
struct BufferTexture {
    gl::Buffer buffer;
    gl::Texture texture;
};

/// Replicates are independent estimates of the picture; their scatter tells how well it is known.
struct ReferenceTarget {
    static constexpr int kReplicates = 8;
    glm::ivec2 size{1};
    gl::Texture sum;           ///< of all replicates, slices by their weights; alpha: coverage likewise
    gl::Texture behind;        ///< what the mesh leaves free shows; alpha 0: nothing
    gl::Texture replicates;    ///< one layer each: likewise, the mean of the three channels, the mesh only
    gl::Texture counts;        ///< two a pixel: points before the counts were set; 1: it gathers, 0: it rests
    gl::Buffer cells;          ///< blocks.h's CellBlock
    gl::Texture light_texels;  ///< of the panorama: radiance, cell; a rectangle
    BufferTexture slice_points;  ///< as SlicePoints
    BufferTexture light_points;
    std::array<gl::Texture, 2> reflected_cells;  ///< as reference_cells.frag.glsl leaves them; rectangles
    gl::Framebuffer cells_framebuffer;           ///< of these
    gl::Framebuffer behind_framebuffer;
    bool rests = false;                                     ///< some pixel does
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
/// What all pixels draw directions from, of the slices that follow.
struct SlicePoints {
    std::vector<glm::vec4> reflection;  ///< shares of the cells in all light, four a texel; then one a point:
                                        ///< cos φ, sin φ, u; choice of lobe and of cell
    std::vector<glm::vec4> light;       ///< of a point, two a cell: direction; radiance
};
void set_reference_points(ReferenceTarget& target, const SlicePoints& points);

/// The mesh's material is then drawn into target.surface, where it stays until the next one.
void begin_reference_surface(ReferenceTarget& target, SurfaceLayers kept);
/// After the surface, what is drawn finds out what each pixel reflects of the light's cells.
void begin_reference_cells(const ReferenceTarget& target);
/// Then, what is behind the mesh.
void begin_reference_background(const ReferenceTarget& target);
/// Between begin and end what is drawn in those rows (from, to) is added to the sum and a replicate, weight
/// (0…1) times.
void begin_reference_slice(const ReferenceTarget& target, int replicate, float weight, glm::ivec2 rows);
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
                          RenderTarget& to);

/// One layer after the other, each bottom row first.
std::vector<float> read_replicates(const ReferenceTarget& target);

/// Returns when all that was asked of the driver is done.
void wait_for_gpu();

/// The time the GPU spends on what is asked of it between the constructor and milliseconds().
class GpuTimer {
public:
    GpuTimer();
    double milliseconds() const;  ///< ends the measurement and waits for it; call once

private:
    Query query_ = Query::make();
};

/// The panorama as the shader sees it, without exposure.
PanoramaTexels read_panorama(const GpuEnvironment& environment);

}  // namespace gl
}  // namespace patina
