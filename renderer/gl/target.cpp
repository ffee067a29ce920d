#include "renderer/gl/target.h"

#include "renderer/gl/read_state.h"
#include "renderer/gl/texture.h"

#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace patina::gl {

namespace {

int offered_samples(int wanted) {
    GLint color = 1;
    GLint depth = 1;
    GLint all = 1;
    glGetIntegerv(GL_MAX_COLOR_TEXTURE_SAMPLES, &color);
    glGetIntegerv(GL_MAX_DEPTH_TEXTURE_SAMPLES, &depth);
    glGetIntegerv(GL_MAX_SAMPLES, &all);
    const int most = std::max(std::min({color, depth, all}), 1);
    int samples = 1;
    while (2 * samples <= std::min(wanted, most)) samples *= 2;
    return samples;
}

/// Of the framebuffer just bound.
bool is_complete() { return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE; }

[[noreturn]] void refuse(const RenderTarget& target) {
    throw std::runtime_error("The graphics driver offers no picture of " + std::to_string(target.size.x) +
                             "×" + std::to_string(target.size.y) + " with " + std::to_string(target.samples) +
                             " samples to draw into: choose a smaller size.");
}

void plain_filter() {
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
}

/// False where the driver cannot draw into it.
bool make_radiance(RenderTarget& target) {
    const GLenum format = target.full_float ? GL_RGBA32F : GL_RGBA16F;
    target.radiance = Texture::make();
    target.depth = Renderbuffer::make();
    target.radiance_framebuffer = Framebuffer::make();
    glBindTexture(target.radiance_kind(), target.radiance.name());
    glBindRenderbuffer(GL_RENDERBUFFER, target.depth.name());
    if (target.samples > 1) {
        glTexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, target.samples, format, target.size.x,
                                target.size.y, GL_TRUE);
        glRenderbufferStorageMultisample(GL_RENDERBUFFER, target.samples, GL_DEPTH_COMPONENT24, target.size.x,
                                         target.size.y);
    } else {
        glTexImage2D(GL_TEXTURE_2D, 0, GLint(format), target.size.x, target.size.y, 0, GL_RGBA, GL_FLOAT,
                     nullptr);
        plain_filter();
        glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, target.size.x, target.size.y);
    }
    glBindTexture(target.radiance_kind(), 0);
    glBindFramebuffer(GL_FRAMEBUFFER, target.radiance_framebuffer.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, target.radiance_kind(),
                           target.radiance.name(), 0);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, target.depth.name());
    return is_complete();
}

bool make_display(RenderTarget& target) {
    target.display = Texture::make();
    target.display_framebuffer = Framebuffer::make();
    glBindTexture(GL_TEXTURE_2D, target.display.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, target.size.x, target.size.y, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 nullptr);
    plain_filter();
    glBindFramebuffer(GL_FRAMEBUFFER, target.display_framebuffer.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.display.name(), 0);
    return is_complete();
}

/// Radiance and coverage of the whole picture, bottom row first; multisampled ones are averaged by the
/// driver.
/// The pixels of a rectangle, its corner the lower left one, samples put together.
std::vector<glm::vec4> read_resolved(const RenderTarget& target, glm::ivec2 corner, glm::ivec2 size,
                                     const std::function<void()>& resolve) {
    RenderTarget single;
    GLuint source = target.radiance_framebuffer.name();
    if (target.stored.surfaces) {
        single.size = target.size;
        single.full_float = true;
        if (!make_radiance(single)) refuse(single);
        resolve();
        source = single.radiance_framebuffer.name();
    } else if (target.samples > 1) {
        single.size = size;
        single.full_float = true;
        if (!make_radiance(single)) refuse(single);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, source);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, single.radiance_framebuffer.name());
        glBlitFramebuffer(corner.x, corner.y, corner.x + size.x, corner.y + size.y, 0, 0, size.x, size.y,
                          GL_COLOR_BUFFER_BIT, GL_NEAREST);
        source = single.radiance_framebuffer.name();
        corner = {0, 0};
    }
    std::vector<glm::vec4> pixels(std::size_t(size.x) * size.y);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, source);
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glReadPixels(corner.x, corner.y, size.x, size.y, GL_RGBA, GL_FLOAT, pixels.data());
    return pixels;
}

}  // namespace

RenderTarget make_render_target(glm::ivec2 size, int samples, bool full_float) {
    const KeepDrawState keep;
    const KeepTextureBindings keep_textures;
    GLint limit = 1024;
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &limit);
    RenderTarget target;
    target.size = glm::clamp(size, glm::ivec2(1), glm::ivec2(limit));
    target.samples = offered_samples(samples);
    target.full_float = full_float;
    const bool is_whole = make_display(target);
    check_memory("the picture");
    if (!is_whole) refuse(target);
    return target;
}

void bind_radiance(RenderTarget& target) {
    if (!target.radiance) {
        const KeepTextureBindings keep_textures;
        RenderTarget made;
        made.size = target.size;
        made.samples = target.samples;
        made.full_float = target.full_float;
        bool is_whole = make_radiance(made);
        if (made.samples > 1 &&
            (ran_out_of_memory() || !is_whole)) {  // better with jagged edges than not at all
            made.samples = 1;
            is_whole = make_radiance(made);
        }
        glBindRenderbuffer(GL_RENDERBUFFER, 0);
        check_memory("the picture");
        if (!is_whole) refuse(made);
        target.samples = made.samples;
        target.radiance = std::move(made.radiance);
        target.depth = std::move(made.depth);
        target.radiance_framebuffer = std::move(made.radiance_framebuffer);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, target.radiance_framebuffer.name());
}

float largest_radiance(const RenderTarget& target) {
    return target.full_float ? std::numeric_limits<float>::max() : 65504.0f;
}

Image read_display_pixels(const RenderTarget& target) {
    const KeepDrawState keep;
    const KeepReadState keep_read;
    Image image = make_image(target.size.x, target.size.y, 3, PixelType::U8);
    const std::size_t row = std::size_t(target.size.x) * 3;
    std::vector<std::byte> pixels(image.bytes.size());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target.display_framebuffer.name());
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glReadPixels(0, 0, target.size.x, target.size.y, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
    for (int y = 0; y < target.size.y; ++y)
        std::memcpy(image.bytes.data() + y * row, pixels.data() + (target.size.y - 1 - y) * row, row);
    return image;
}

Image read_radiance_pixels(const RenderTarget& target, const std::function<void()>& resolve) {
    const KeepDrawState keep;
    const KeepReadState keep_read;
    const KeepTextureBindings keep_textures;
    const std::vector<glm::vec4> pixels = read_resolved(target, {0, 0}, target.size, resolve);
    Image image = make_image(target.size.x, target.size.y, 3, PixelType::F32);
    auto* out = reinterpret_cast<float*>(image.bytes.data());
    for (int y = 0; y < target.size.y; ++y) {
        const glm::vec4* row = &pixels[std::size_t(target.size.y - 1 - y) * target.size.x];
        for (int x = 0; x < target.size.x; ++x, out += 3) {
            const glm::vec3 color = glm::vec3(row[x]) + (1.0f - row[x].w) * target.plain;
            std::memcpy(out, &color, sizeof color);
        }
    }
    return image;
}

PixelValue read_pixel_value(const RenderTarget& target, glm::ivec2 pixel,
                            const std::function<void()>& resolve) {
    const KeepDrawState keep;
    const KeepReadState keep_read;
    const KeepTextureBindings keep_textures;
    const glm::ivec2 corner(pixel.x, target.size.y - 1 - pixel.y);
    const glm::vec4 seen = read_resolved(target, corner, {1, 1}, resolve).front();
    PixelValue value{glm::vec3(seen) + (1.0f - seen.w) * target.plain, {}};
    std::array<std::uint8_t, 4> display{};
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target.display_framebuffer.name());
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glReadPixels(corner.x, corner.y, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, display.data());
    value.display = {display[0], display[1], display[2]};
    return value;
}

KeepDrawState::KeepDrawState() {
    for (int i = 0; i < kSwitchCount; ++i) switches_[i] = glIsEnabled(kSwitches[i]);
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw_framebuffer_);
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_framebuffer_);
    glGetIntegerv(GL_CURRENT_PROGRAM, &program_);
    glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &vertex_array_);
    glGetIntegerv(GL_ACTIVE_TEXTURE, &active_texture_);
    glGetIntegerv(GL_UNIFORM_BUFFER_BINDING, &uniform_buffer_);
    glGetIntegerv(GL_DEPTH_FUNC, &depth_function_);
    glGetIntegerv(GL_FRONT_FACE, &front_face_);
    glGetIntegerv(GL_CULL_FACE_MODE, &culled_);
    glGetIntegerv(GL_POLYGON_MODE, polygon_mode_);
    glGetIntegerv(GL_VIEWPORT, viewport_);
    glGetBooleanv(GL_DEPTH_WRITEMASK, &depth_mask_);
    glGetBooleanv(GL_COLOR_WRITEMASK, color_mask_);
}

KeepDrawState::~KeepDrawState() {
    for (int i = 0; i < kSwitchCount; ++i) {
        if (switches_[i])
            glEnable(kSwitches[i]);
        else
            glDisable(kSwitches[i]);
    }
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, GLuint(draw_framebuffer_));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, GLuint(read_framebuffer_));
    glUseProgram(GLuint(program_));
    glBindVertexArray(GLuint(vertex_array_));
    glActiveTexture(GLenum(active_texture_));
    glBindBuffer(GL_UNIFORM_BUFFER, GLuint(uniform_buffer_));
    glDepthFunc(GLenum(depth_function_));
    glFrontFace(GLenum(front_face_));
    glCullFace(GLenum(culled_));
    glPolygonMode(GL_FRONT_AND_BACK, GLenum(polygon_mode_[0]));
    glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
    glDepthMask(depth_mask_);
    glColorMask(color_mask_[0], color_mask_[1], color_mask_[2], color_mask_[3]);
}

}  // namespace patina::gl
