// Pictures on the GPU: formats, mip chains uploaded a bit at a time, and what must be put back afterwards.
#pragma once

#include "renderer/core/image.h"
#include "renderer/core/value_range.h"
#include "renderer/gl/handles.h"

#include <cstddef>
#include <string>
#include <vector>

namespace patina {

struct GpuMap {
    gl::Texture texture;
    int width = 0;
    int height = 0;
    std::string note;      ///< one sentence where it is coarser than it was to be; else empty
    ChannelRanges ranges;  ///< of all its levels
};

namespace gl {

/// Textures are made on the unit that is active; this puts its bindings and the pixel-store state back.
class KeepTextureBindings {
public:
    KeepTextureBindings();
    ~KeepTextureBindings();
    KeepTextureBindings(const KeepTextureBindings&) = delete;
    KeepTextureBindings& operator=(const KeepTextureBindings&) = delete;

private:
    GLint flat_ = 0, cube_ = 0, cube_array_ = 0, alignment_ = 4, row_length_ = 0, buffer_ = 0;
};

/// Whether OpenGL is Mesa's software renderer.
bool is_software();

/// Since it was last asked.
bool ran_out_of_memory();
/// Throws std::runtime_error in one sentence if the driver ran out of memory since it was last asked.
void check_memory(const char* what);

/// Writes a mip chain into a texture in portions, coarse levels first.
class TextureWriter {
public:
    /// Allocates; levels wider than the driver takes are skipped, and fine ones for which it has no memory,
    /// as the map's note then says. Throws std::runtime_error where not even a small picture has a place.
    /// Precondition: a complete chain of 1…4 channels.
    TextureWriter(const std::vector<Image>& levels, bool srgb);
    /// Copies about byte_budget bytes (at least one row); true when all is there.
    bool step(const std::vector<Image>& levels, std::size_t byte_budget);
    GpuMap take() { return std::move(map_); }

private:
    void allocate(const std::vector<Image>& levels);
    bool try_allocate(const std::vector<Image>& levels);
    void leave_out_finest(const std::vector<Image>& levels);

    GpuMap map_;
    bool srgb_ = false;
    int first_level_ = 0;  ///< levels[first_level_] is the texture's level 0
    int level_ = 0;        ///< next to be written, counting down to first_level_
    int row_ = 0;
};

/// One 8-bit level for the interface: as stored, no mip maps, clamped.
GpuMap make_interface_texture(const Image& image);

}  // namespace gl
}  // namespace patina
