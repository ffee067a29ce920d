// Where a picture is drawn: multisampled linear radiance with coverage in alpha, and the 8-bit display
// picture.
#pragma once

#include "renderer/core/image.h"
#include "renderer/gl/handles.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <functional>
#include <memory>

namespace patina {

struct GpuSurfaces;

/// Radiance as fragments side by side (surfaces.h).
struct StoredPicture {
    std::shared_ptr<const GpuSurfaces> surfaces;  ///< none: the picture was rasterised
    gl::Texture colors;
    gl::Framebuffer framebuffer;
    glm::ivec2 extent{0};
};

struct RenderTarget {
    glm::ivec2 size{1};
    int samples = 1;
    bool full_float = false;  ///< 32-bit instead of 16-bit radiance
    /// GL_TEXTURE_2D_MULTISAMPLE where samples > 1, else GL_TEXTURE_2D; this and what belongs to it are made
    /// when first drawn into.
    gl::Texture radiance;
    gl::Renderbuffer depth;
    gl::Framebuffer radiance_framebuffer;
    gl::Texture display;
    gl::Framebuffer display_framebuffer;
    StoredPicture stored;   ///< instead of radiance, where there is one
    glm::vec3 plain{0.0f};  ///< linear colour of what was last not covered

    GLenum radiance_kind() const { return samples > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D; }
};

namespace gl {

/// samples and size are clamped to what the driver offers.
RenderTarget make_render_target(glm::ivec2 size, int samples, bool full_float);
/// Binds the radiance to be drawn into. Made first where it is missing, with one sample where there is no
/// room for more. Throws std::runtime_error where there is none for that either.
void bind_radiance(RenderTarget& target);
/// The largest number a target's radiance can hold.
float largest_radiance(const RenderTarget& target);

Image read_display_pixels(const RenderTarget& target);
/// resolve: draws the mean of the samples of a stored picture over the picture that is bound.
Image read_radiance_pixels(const RenderTarget& target, const std::function<void()>& resolve);
/// Of one pixel, (0,0) the upper left one.
struct PixelValue {
    glm::vec3 radiance{0.0f};
    glm::ivec3 display{0};  ///< 0…255
};
PixelValue read_pixel_value(const RenderTarget& target, glm::ivec2 pixel,
                            const std::function<void()>& resolve);

/// Everything a draw changes and other code may rely on, put back at the end.
class KeepDrawState {
public:
    KeepDrawState();
    ~KeepDrawState();
    KeepDrawState(const KeepDrawState&) = delete;
    KeepDrawState& operator=(const KeepDrawState&) = delete;

private:
    static constexpr GLenum kSwitches[] = {GL_BLEND,
                                           GL_CULL_FACE,
                                           GL_DEPTH_TEST,
                                           GL_SCISSOR_TEST,
                                           GL_STENCIL_TEST,
                                           GL_FRAMEBUFFER_SRGB,
                                           GL_MULTISAMPLE,
                                           GL_RASTERIZER_DISCARD,
                                           GL_COLOR_LOGIC_OP,
                                           GL_SAMPLE_ALPHA_TO_COVERAGE,
                                           GL_TEXTURE_CUBE_MAP_SEAMLESS};
    static constexpr int kSwitchCount = sizeof(kSwitches) / sizeof(kSwitches[0]);
    GLboolean switches_[kSwitchCount] = {};
    GLint draw_framebuffer_ = 0, read_framebuffer_ = 0, program_ = 0, vertex_array_ = 0, active_texture_ = 0;
    GLint uniform_buffer_ = 0, depth_function_ = GL_LESS, front_face_ = GL_CCW, culled_ = GL_BACK,
          polygon_mode_[2] = {GL_FILL, GL_FILL};
    GLint viewport_[4] = {};
    GLboolean depth_mask_ = GL_TRUE;
    GLboolean color_mask_[4] = {GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE};
};

}  // namespace gl
}  // namespace patina
