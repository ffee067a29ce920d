#include "renderer/gl/environment.h"

#include "renderer/gl/texture.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace patina::gl {

namespace {

constexpr std::size_t kHalfTexel = 4 * sizeof(std::uint16_t);

/// Before the levels are defined: drivers make room for as many as a texture says that it will have.
void set_cube_filter(GLenum target, GLenum minify, int mips) {
    glTexParameteri(target, GL_TEXTURE_MIN_FILTER, GLint(minify));
    glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(target, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(target, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(target, GL_TEXTURE_WRAP_R, GL_CLAMP_TO_EDGE);
    glTexParameteri(target, GL_TEXTURE_MAX_LEVEL, mips - 1);
}

void make_panorama(const PanoramaLevels& panorama, GpuEnvironment& result) {
    result.panorama = std::make_shared<Texture>(Texture::make());
    glBindTexture(GL_TEXTURE_2D, result.panorama->name());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, GLint(panorama.levels.size()) - 1);
    for (std::size_t i = 0; i < panorama.levels.size(); ++i)
        glTexImage2D(GL_TEXTURE_2D, GLint(i), GL_RGBA16F, panorama.levels[i].width, panorama.levels[i].height,
                     0, GL_RGBA, GL_HALF_FLOAT, nullptr);
    result.panorama_scale = std::ldexp(1.0f, panorama.exponent);
    result.panorama_lights = panorama.lights;
    result.texels_per_radian = float(panorama.levels[0].height / M_PI);
}

void share_panorama(const GpuEnvironment& other, GpuEnvironment& result) {
    result.panorama = other.panorama;
    result.panorama_scale = other.panorama_scale;
    result.panorama_lights = other.panorama_lights;
    result.texels_per_radian = other.texels_per_radian;
}

void make_levels(const LightLevels& light, GpuEnvironment& result) {
    const int base = light.levels.front().size;
    // Two at least, even if nothing lies in the second: for a texture without mips a software renderer would
    // compile the shaders that read it anew.
    const int mips = std::max((int(light.levels.size()) + light.layers - 1) / light.layers, base > 1 ? 2 : 1);
    result.levels = Texture::make();
    glBindTexture(GL_TEXTURE_CUBE_MAP_ARRAY, result.levels.name());
    set_cube_filter(GL_TEXTURE_CUBE_MAP_ARRAY, GL_LINEAR_MIPMAP_NEAREST, mips);
    for (int mip = 0; mip < mips; ++mip) {
        const int size = std::max(base >> mip, 1);
        glTexImage3D(GL_TEXTURE_CUBE_MAP_ARRAY, mip, GL_RGBA16F, size, size, 6 * light.layers, 0, GL_RGBA,
                     GL_HALF_FLOAT, nullptr);
    }
    result.levels_scale = std::ldexp(1.0f, light.levels_exponent);
    result.layers = light.layers;
    result.roughness = light.roughness;
    result.sharpest = light.sharpest;
}

void make_irradiance(const LightLevels& light, GpuEnvironment& result) {
    const LightLevels::Cube& cube = light.irradiance;
    const std::size_t face = 4 * std::size_t(cube.size) * cube.size;
    result.irradiance_scale = std::ldexp(1.0f, light.irradiance_exponent);
    result.irradiance = Texture::make();
    glBindTexture(GL_TEXTURE_CUBE_MAP, result.irradiance.name());
    set_cube_filter(GL_TEXTURE_CUBE_MAP, GL_LINEAR, 1);
    for (int i = 0; i < 6; ++i)
        glTexImage2D(GLenum(GL_TEXTURE_CUBE_MAP_POSITIVE_X + i), 0, GL_RGBA16F, cube.size, cube.size, 0,
                     GL_RGBA, GL_HALF_FLOAT, cube.rgba.data() + i * face);
}

}  // namespace

EnvironmentWriter::EnvironmentWriter(const PreparedLight& light) {
    if ((light.panorama.levels.empty() && !light.panorama_of) || light.levels.levels.empty())
        throw std::runtime_error("The light has no levels to draw with: bake it again.");
    const KeepTextureBindings keep;
    if (light.panorama_of)
        share_panorama(*light.panorama_of, environment_);
    else
        make_panorama(light.panorama, environment_);
    make_levels(light.levels, environment_);
    make_irradiance(light.levels, environment_);
    environment_.lights = light.levels.lights;
    check_memory("the light");
}

/// A level of the bake, whole: at most some megabytes.
std::size_t EnvironmentWriter::write_cube(const LightLevels& light) {
    const int k = int(next_cube_++);
    const LightLevels::Cube& cube = light.levels[k];
    glBindTexture(GL_TEXTURE_CUBE_MAP_ARRAY, environment_.levels.name());
    glTexSubImage3D(GL_TEXTURE_CUBE_MAP_ARRAY, k / light.layers, 0, 0, 6 * (k % light.layers), cube.size,
                    cube.size, 6, GL_RGBA, GL_HALF_FLOAT, cube.rgba.data());
    return cube.rgba.size() * sizeof cube.rgba[0];
}

/// Rows of the panorama, as many as fit.
std::size_t EnvironmentWriter::write_rows(const PanoramaLevels& panorama, std::size_t byte_budget) {
    const PanoramaLevels::Level& level = panorama.levels[level_];
    const std::size_t row_bytes = std::size_t(level.width) * kHalfTexel;
    const int rows =
        int(std::clamp<std::size_t>(byte_budget / row_bytes, 1, std::size_t(level.height - row_)));
    glBindTexture(GL_TEXTURE_2D, environment_.panorama->name());
    glTexSubImage2D(GL_TEXTURE_2D, GLint(level_), 0, row_, level.width, rows, GL_RGBA, GL_HALF_FLOAT,
                    level.rgba.data() + std::size_t(row_) * level.width * 4);
    row_ += rows;
    if (row_ == level.height) {
        row_ = 0;
        ++level_;
    }
    return std::size_t(rows) * row_bytes;
}

bool EnvironmentWriter::step(const PreparedLight& light, std::size_t byte_budget) {
    const KeepTextureBindings keep;
    std::size_t spent = 0;
    while (spent == 0 || spent < byte_budget) {
        if (next_cube_ < light.levels.levels.size()) {
            spent += write_cube(light.levels);
        } else if (!light.panorama_of && level_ < light.panorama.levels.size()) {
            spent += write_rows(light.panorama, byte_budget > spent ? byte_budget - spent : 0);
        } else {
            check_memory("the light");  // a driver may find a place only for what is written
            return true;
        }
    }
    return false;
}

}  // namespace patina::gl
