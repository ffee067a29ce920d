#include "renderer/gl/texture.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

namespace patina::gl {

namespace {

constexpr int kCoarsestMap = 64;  ///< texels a side: what has no place for these has none for anything

struct Format {
    GLenum internal;
    GLenum external;
    GLenum type;
};

Format format_of(const Image& image, bool srgb) {
    static constexpr GLenum external[] = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
    static constexpr GLenum bytes[] = {GL_R8, GL_RG8, GL_RGB8, GL_RGBA8};
    static constexpr GLenum shorts[] = {GL_R16, GL_RG16, GL_RGB16, GL_RGBA16};
    static constexpr GLenum floats[] = {GL_R16F, GL_RG16F, GL_RGB16F, GL_RGBA16F};
    const int i = image.channels - 1;
    switch (image.type) {
        case PixelType::U8:
            if (srgb)
                return {i == 3 ? GLenum(GL_SRGB8_ALPHA8) : GLenum(GL_SRGB8), external[i], GL_UNSIGNED_BYTE};
            return {bytes[i], external[i], GL_UNSIGNED_BYTE};
        case PixelType::U16:
            return {shorts[i], external[i], GL_UNSIGNED_SHORT};
        default:
            return {floats[i], external[i], GL_FLOAT};
    }
}

/// Grey is the same in red, green and blue, so that any channel of it may be asked for; its second channel is
/// alpha.
void set_grey_swizzle(int channels) {
    if (channels > 2) return;
    const GLint swizzle[] = {GL_RED, GL_RED, GL_RED, channels == 2 ? GL_GREEN : GL_ONE};
    glTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_RGBA, swizzle);
}

void set_map_filter(int levels) {
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, levels - 1);
    // Mesa's software renderer blurs what it should magnify when asked for this, and takes long to.
    if (is_software() || !epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic")) return;
    GLfloat most = 1.0f;
    glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &most);
    glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_MAX_ANISOTROPY_EXT, std::min(most, 8.0f));
}

std::size_t row_bytes(const Image& image) {
    return std::size_t(image.width) * image.channels * bytes_per_channel(image.type);
}

}  // namespace

bool is_software() {
    const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return name && (std::strstr(name, "llvmpipe") || std::strstr(name, "softpipe"));
}

KeepTextureBindings::KeepTextureBindings() {
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &flat_);
    glGetIntegerv(GL_TEXTURE_BINDING_CUBE_MAP, &cube_);
    glGetIntegerv(GL_TEXTURE_BINDING_CUBE_MAP_ARRAY, &cube_array_);
    glGetIntegerv(GL_UNPACK_ALIGNMENT, &alignment_);
    glGetIntegerv(GL_UNPACK_ROW_LENGTH, &row_length_);
    glGetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &buffer_);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

KeepTextureBindings::~KeepTextureBindings() {
    glBindTexture(GL_TEXTURE_2D, GLuint(flat_));
    glBindTexture(GL_TEXTURE_CUBE_MAP, GLuint(cube_));
    glBindTexture(GL_TEXTURE_CUBE_MAP_ARRAY, GLuint(cube_array_));
    glPixelStorei(GL_UNPACK_ALIGNMENT, alignment_);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, row_length_);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, GLuint(buffer_));
}

bool ran_out_of_memory() {
    bool out_of_memory = false;
    for (int i = 0; i < 16; ++i) {
        const GLenum error = glGetError();
        if (error == GL_NO_ERROR) break;
        out_of_memory = out_of_memory || error == GL_OUT_OF_MEMORY;
    }
    return out_of_memory;
}

void check_memory(const char* what) {
    if (ran_out_of_memory())
        throw std::runtime_error(std::string("The graphics card has no memory left for ") + what +
                                 ": close other programs or use smaller pictures.");
}

TextureWriter::TextureWriter(const std::vector<Image>& levels, bool srgb) : srgb_(srgb) {
    const KeepTextureBindings keep;
    GLint limit = 1024;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    const int last = int(levels.size()) - 1;
    while (first_level_ < last && std::max(levels[first_level_].width, levels[first_level_].height) > limit)
        ++first_level_;
    allocate(levels);
}

void TextureWriter::allocate(const std::vector<Image>& levels) {
    while (!try_allocate(levels)) leave_out_finest(levels);
    level_ = int(levels.size()) - 1;
    row_ = 0;
}

bool TextureWriter::try_allocate(const std::vector<Image>& levels) {
    const int last = int(levels.size()) - 1;
    map_.texture = {};  // what it held may be what is missing now
    map_.texture = Texture::make();
    map_.width = levels[first_level_].width;
    map_.height = levels[first_level_].height;
    glBindTexture(GL_TEXTURE_2D, map_.texture.name());
    set_map_filter(last - first_level_ + 1);
    set_grey_swizzle(levels[0].channels);
    for (int i = first_level_; i <= last; ++i) {
        const Format format = format_of(levels[i], srgb_);
        glTexImage2D(GL_TEXTURE_2D, i - first_level_, GLint(format.internal), levels[i].width,
                     levels[i].height, 0, format.external, format.type, nullptr);
    }
    return !ran_out_of_memory();
}

void TextureWriter::leave_out_finest(const std::vector<Image>& levels) {
    const auto size = [&](int level) {
        return std::to_string(levels[level].width) + "×" + std::to_string(levels[level].height);
    };
    const Image& finest = levels[first_level_];
    if (first_level_ + 1 == int(levels.size()) || std::max(finest.width, finest.height) <= kCoarsestMap)
        throw std::runtime_error(
            "The graphics card has no memory left for a map: close other programs or use smaller pictures.");
    ++first_level_;
    map_.note = "The graphics card has no memory left for the whole map: it is drawn with " +
                size(first_level_) + " of " + size(0) +
                " texels; close other programs or use smaller pictures, and read it again.";
}

bool TextureWriter::step(const std::vector<Image>& levels, std::size_t byte_budget) {
    const KeepTextureBindings keep;
    glBindTexture(GL_TEXTURE_2D, map_.texture.name());
    std::size_t spent = 0;
    while (level_ >= first_level_ && (spent == 0 || spent < byte_budget)) {
        const Image& image = levels[level_];
        const Format format = format_of(image, false);  // only its external half, which sRGB does not change
        const std::size_t left = byte_budget > spent ? byte_budget - spent : 0;
        const int rows = int(std::clamp<std::size_t>(left / row_bytes(image), 1, image.height - row_));
        glTexSubImage2D(GL_TEXTURE_2D, level_ - first_level_, 0, row_, image.width, rows, format.external,
                        format.type, image.bytes.data() + row_ * row_bytes(image));
        spent += rows * row_bytes(image);
        row_ += rows;
        if (row_ < image.height) continue;
        row_ = 0;
        --level_;
    }
    if (level_ >= first_level_) return false;
    if (!ran_out_of_memory()) return true;
    leave_out_finest(levels);  // a driver may find a place only for what is written
    allocate(levels);
    return false;
}

GpuMap make_interface_texture(const Image& image) {
    const KeepTextureBindings keep;
    GpuMap map{Texture::make(), image.width, image.height};
    glBindTexture(GL_TEXTURE_2D, map.texture.name());
    const Format format = format_of(image, false);
    glTexImage2D(GL_TEXTURE_2D, 0, GLint(format.internal), image.width, image.height, 0, format.external,
                 format.type, image.bytes.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    set_grey_swizzle(image.channels);
    check_memory("a thumbnail");
    return map;
}

}  // namespace patina::gl
