// What lies under a picture's samples, rasterised once and shaded as often as wanted. Every fragment, a
// triangle in a pixel, is kept once, however many samples it covers: first those of the mesh, then those
// behind it, in rows of one texture. What is shaded of them is exactly what is shaded while rasterising.
#pragma once

#include "renderer/gl/handles.h"
#include "renderer/gl/target.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace patina {

/// What of a surface is kept beside its normal.
struct SurfaceLayers {
    bool turns = false;  ///< how the normal changes over the pixel, in full: sharp lobes follow it
    bool maps = false;
    bool emission = false;  ///< has a map
    bool operator==(const SurfaceLayers&) const = default;
};

struct GpuSurfaces {
    static constexpr int kWidth = 1024;  ///< fragments in a row
    glm::ivec2 size_px{1};
    int samples = 1;
    SurfaceLayers kept;
    int mesh_rows = 0;  ///< of fragments of the mesh; the rest lies behind it
    int rows = 0;
    int mesh_room = 0, room = 0;        ///< rows that the layers have, and that all has
    std::array<gl::Texture, 5> layers;  ///< of the mesh, in the order of shaders/stored.glsl; some may lack
    gl::Texture places;                 ///< of all, in the picture
    gl::Texture fragment_of_pixel;
    gl::Texture fragments_of_samples;
    std::uint64_t mesh_fragments = 0;
    std::uint64_t bytes = 0;
};

namespace gl {

struct SurfacePrograms {
    GLuint fragments = 0;  ///< surfaces_sorted.frag.glsl with FRAGMENTS
    GLuint sorted = 0;     ///< and without
    GLuint nothing = 0;    ///< vertex array without attributes
};

/// Where surfaces are rasterised; kept while the camera moves.
class SurfaceScratch {
public:
    bool fits(glm::ivec2 size_px, int samples, SurfaceLayers kept) const;
    /// Bytes it will take.
    static std::uint64_t bytes_for(glm::ivec2 size_px, int samples, SurfaceLayers kept);
    /// Throws std::runtime_error where the driver has no room.
    void make(glm::ivec2 size_px, int samples, SurfaceLayers kept);
    /// Empty, bound and ready for the mesh to be drawn into.
    void begin() const;
    /// What was drawn, as it lies there, for shaders to read. Precondition: one sample.
    void bind_layers() const;
    /// Sorts what was drawn. old: one that nobody needs any more, whose room is used again where it fits.
    GpuSurfaces finish(const SurfacePrograms& programs, GpuSurfaces old);

private:
    std::vector<float> read_fragments(const SurfacePrograms& programs);
    void draw_sorted(const GpuSurfaces& surfaces, const SurfacePrograms& programs) const;
    GLenum kind() const { return samples_ > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D; }

    glm::ivec2 size_px_{0};
    int samples_ = 0;
    SurfaceLayers kept_;
    Texture fragments_;  ///< of which triangle
    Texture ids_;        ///< the same, four samples a texel
    Framebuffer ids_framebuffer_;
    std::array<Texture, 5> layers_;
    Renderbuffer depth_;
    Framebuffer framebuffer_;
};

void bind_surface_layers(const GpuSurfaces& surfaces);
void bind_surface_pixels(const GpuSurfaces& surfaces);
/// A picture for the colours of the fragments, made where the one there does not fit; bound and empty.
void begin_shading(StoredPicture& picture, std::shared_ptr<const GpuSurfaces> surfaces, bool full_float);
/// A triangle over a box (x, y, width, height) of the picture that is bound. nothing: as above.
void draw_all(GLuint program, GLuint nothing, glm::ivec4 box);
enum class StoredRows { Mesh, Behind };
/// Draws over those rows of the picture that is bound.
void shade_rows(const GpuSurfaces& surfaces, StoredRows rows, GLuint program, GLuint nothing);

}  // namespace gl
}  // namespace patina
