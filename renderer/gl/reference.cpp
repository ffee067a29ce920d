#include "renderer/gl/reference.h"

#include "renderer/gl/program.h"
#include "renderer/gl/read_state.h"
#include "renderer/gl/texture.h"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace patina::gl {

namespace {

/// As light.glsl's light_color: of the nearest light, with a mean channel of 1.
glm::vec3 light_color(const std::vector<ExtractedLight>& lights, glm::vec3 direction) {
    const auto nearest = std::max_element(lights.begin(), lights.end(), [&](const auto& a, const auto& b) {
        return glm::dot(a.direction, direction) < glm::dot(b.direction, direction);
    });
    const glm::vec3 E = nearest->irradiance;
    return E * (3.0f / std::max(E.x + E.y + E.z, 1e-30f));
}

void no_filter(GLenum kind) {
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTexParameteri(kind, filter, GL_NEAREST);
    if (kind != GL_TEXTURE_RECTANGLE) glTexParameteri(kind, GL_TEXTURE_MAX_LEVEL, 0);
}

void require_complete(glm::ivec2 size) {
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
    throw std::runtime_error("The graphics driver cannot gather a reference picture of " +
                             std::to_string(size.x) + "×" + std::to_string(size.y) +
                             " in 32-bit floats: choose a smaller size.");
}

}  // namespace

namespace {

void make_textures(ReferenceTarget& target) {
    const glm::ivec2 size = target.size;
    target.sum = Texture::make();
    glBindTexture(GL_TEXTURE_2D, target.sum.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, size.x, size.y, 0, GL_RGBA, GL_FLOAT, nullptr);
    no_filter(GL_TEXTURE_2D);
    target.behind = Texture::make();
    glBindTexture(GL_TEXTURE_2D, target.behind.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, size.x, size.y, 0, GL_RGBA, GL_FLOAT, nullptr);
    no_filter(GL_TEXTURE_2D);
    target.replicates = Texture::make();
    glBindTexture(GL_TEXTURE_2D_ARRAY, target.replicates.name());
    glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_R32F, size.x, size.y, ReferenceTarget::kReplicates, 0, GL_RED,
                 GL_FLOAT, nullptr);
    no_filter(GL_TEXTURE_2D_ARRAY);
    glBindTexture(GL_TEXTURE_2D_ARRAY, 0);
    target.counts = Texture::make();
    glBindTexture(GL_TEXTURE_2D, target.counts.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RG32F, size.x, size.y, 0, GL_RG, GL_FLOAT, nullptr);
    no_filter(GL_TEXTURE_2D);
    for (Texture& words : target.reflected_cells) {
        words = Texture::make();
        glBindTexture(GL_TEXTURE_RECTANGLE, words.name());
        glTexImage2D(GL_TEXTURE_RECTANGLE, 0, GL_RGBA32UI, size.x, size.y, 0, GL_RGBA_INTEGER,
                     GL_UNSIGNED_INT, nullptr);
        no_filter(GL_TEXTURE_RECTANGLE);
    }
}

void make_framebuffers(ReferenceTarget& target) {
    for (int i = 0; i < ReferenceTarget::kReplicates; ++i) {
        target.framebuffers[i] = Framebuffer::make();
        glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffers[i].name());
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.sum.name(), 0);
        glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, target.replicates.name(), 0, i);
        const GLenum both[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
        glDrawBuffers(2, both);
        require_complete(target.size);
    }
    target.behind_framebuffer = Framebuffer::make();
    glBindFramebuffer(GL_FRAMEBUFFER, target.behind_framebuffer.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.behind.name(), 0);
    require_complete(target.size);
    target.cells_framebuffer = Framebuffer::make();
    glBindFramebuffer(GL_FRAMEBUFFER, target.cells_framebuffer.name());
    for (GLuint i = 0; i < 2; ++i)
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + i, GL_TEXTURE_RECTANGLE,
                               target.reflected_cells[i].name(), 0);
    const GLenum both[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glDrawBuffers(2, both);
    require_complete(target.size);
}

}  // namespace

ReferenceTarget make_reference_target(glm::ivec2 size) {
    const KeepDrawState keep;
    const KeepTextureBindings keep_textures;
    ReferenceTarget target;
    target.size = size;
    make_textures(target);
    make_framebuffers(target);
    target.mean =
        make_program(embedded_shader("display.vert.glsl"), embedded_shader("reference_mean.frag.glsl"));
    target.resting =
        make_program(embedded_shader("display.vert.glsl"), embedded_shader("reference_resting.frag.glsl"));
    target.nothing = VertexArray::make();
    check_memory("the reference picture");
    clear_reference(target);
    return target;
}

void clear_reference(ReferenceTarget& target) {
    const KeepDrawState keep;
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDisable(GL_SCISSOR_TEST);
    const GLfloat black[] = {0.0f, 0.0f, 0.0f, 0.0f};
    for (const Framebuffer& framebuffer : target.framebuffers) {
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
        glClearBufferfv(GL_COLOR, 0, black);
        glClearBufferfv(GL_COLOR, 1, black);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, target.behind_framebuffer.name());
    glClearBufferfv(GL_COLOR, 0, black);
}

void set_reference_counts(ReferenceTarget& target, const std::vector<float>& counts) {
    const KeepTextureBindings keep;
    target.rests = false;
    for (std::size_t i = 1; i < counts.size(); i += 2) target.rests = target.rests || counts[i] == 0.0f;
    glBindTexture(GL_TEXTURE_2D, target.counts.name());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, target.size.x, target.size.y, GL_RG, GL_FLOAT, counts.data());
}

namespace {

blocks::CellBlock cell_block(const LightSampler& light) {
    const PanoramaTexels& texels = light.texels();
    const std::vector<LightCell>& cells = light.cells();
    const double all = light.total() > 0.0 ? light.total() : 1.0;
    blocks::CellBlock block{.light_layout = {cells.size(), 1.0 / all, texels.width, texels.height},
                            .cell_rows = {}};
    for (std::size_t k = 0; k < cells.size(); ++k) {
        block.cell_rows[2 * k] = glm::vec4(glm::dvec4(cells[k].direction, cells[k].spread));
        block.cell_rows[2 * k + 1].x = float(std::sqrt(cells[k].spread));
    }
    return block;
}

void fill(BufferTexture& row, const std::vector<glm::vec4>& texels) {
    const bool is_new = !row.buffer;
    if (is_new) row = {Buffer::make(), Texture::make()};
    glBindBuffer(GL_TEXTURE_BUFFER, row.buffer.name());
    glBufferData(GL_TEXTURE_BUFFER, GLsizeiptr(texels.size() * sizeof(glm::vec4)), texels.data(),
                 GL_STREAM_DRAW);
    if (!is_new) return;
    glBindTexture(GL_TEXTURE_BUFFER, row.texture.name());
    glTexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, row.buffer.name());
}

}  // namespace

void set_reference_light(ReferenceTarget& target, const LightSampler& light) {
    const KeepTextureBindings keep;
    const PanoramaTexels& texels = light.texels();
    target.light_texels = Texture::make();
    glBindTexture(GL_TEXTURE_RECTANGLE, target.light_texels.name());
    no_filter(GL_TEXTURE_RECTANGLE);
    glTexImage2D(GL_TEXTURE_RECTANGLE, 0, GL_RGBA32F, texels.width, texels.height, 0, GL_RGBA, GL_FLOAT,
                 light.radiance_and_cell().data());
    if (!target.cells) target.cells = Buffer::make();
    const blocks::CellBlock block = cell_block(light);
    glBindBuffer(GL_UNIFORM_BUFFER, target.cells.name());
    glBufferData(GL_UNIFORM_BUFFER, sizeof block, &block, GL_STATIC_DRAW);
}

void set_reference_points(ReferenceTarget& target, const SlicePoints& points) {
    fill(target.slice_points, points.reflection);
    fill(target.light_points, points.light);
}

void begin_reference_surface(ReferenceTarget& target, SurfaceLayers kept) {
    if (!target.surface.fits(target.size, 1, kept)) target.surface.make(target.size, 1, kept);
    target.surface.begin();
    if (!target.rests) return;
    bind_texture(kFragmentPlacesUnit, GL_TEXTURE_2D, target.counts);
    glDepthFunc(GL_ALWAYS);
    glUseProgram(target.resting.name());
    glBindVertexArray(target.nothing.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDepthFunc(GL_LEQUAL);
}

void begin_reference_cells(const ReferenceTarget& target) {
    glBindFramebuffer(GL_FRAMEBUFFER, target.cells_framebuffer.name());
    target.surface.bind_layers();
    glBindBufferBase(GL_UNIFORM_BUFFER, kCellSlot, target.cells.name());
    glDisable(GL_DEPTH_TEST);
}

void begin_reference_slice(const ReferenceTarget& target, int replicate, float weight, glm::ivec2 rows) {
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffers[replicate].name());
    target.surface.bind_layers();
    bind_texture(kLightTexelsUnit, GL_TEXTURE_RECTANGLE, target.light_texels);
    bind_texture(kSlicePointsUnit, GL_TEXTURE_BUFFER, target.slice_points.texture);
    bind_texture(kLightPointsUnit, GL_TEXTURE_BUFFER, target.light_points.texture);
    bind_texture(kFirstReflectedCellsUnit, GL_TEXTURE_RECTANGLE, target.reflected_cells[0]);
    bind_texture(kLastReflectedCellsUnit, GL_TEXTURE_RECTANGLE, target.reflected_cells[1]);
    glBindBufferBase(GL_UNIFORM_BUFFER, kCellSlot, target.cells.name());
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, rows.x, target.size.x, rows.y - rows.x);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_CONSTANT_ALPHA, GL_ONE);
    glBlendColor(0.0f, 0.0f, 0.0f, weight);
}

void begin_reference_background(const ReferenceTarget& target) {
    glBindFramebuffer(GL_FRAMEBUFFER, target.behind_framebuffer.name());
    glDisable(GL_DEPTH_TEST);
}

void end_reference_slice() {
    glBlendFunc(GL_ONE, GL_ZERO);
    glBlendColor(0.0f, 0.0f, 0.0f, 0.0f);
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
}

void write_reference_mean(const ReferenceTarget& target, const GatheredPoints& points, float weight,
                          RenderTarget& to) {
    const KeepDrawState keep;
    const KeepTextureBindings keep_textures;
    bind_radiance(to);
    for (const GLenum off : {GL_BLEND, GL_DEPTH_TEST, GL_CULL_FACE, GL_SCISSOR_TEST}) glDisable(off);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glViewport(0, 0, target.size.x, target.size.y);
    glUseProgram(target.mean.name());
    bind_texture(kPictureUnit, GL_TEXTURE_2D, target.sum);
    bind_texture(kFragmentPlacesUnit, GL_TEXTURE_2D, target.counts);
    bind_texture(kPictureBehindUnit, GL_TEXTURE_2D, target.behind);
    glUniform3f(glGetUniformLocation(target.mean.name(), "reference_weight"), float(points.all), weight,
                largest_radiance(to));
    glUniform2f(glGetUniformLocation(target.mean.name(), "reference_rows"), float(points.rows),
                float(points.more));
    glBindVertexArray(target.nothing.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

std::vector<float> read_replicates(const ReferenceTarget& target) {
    const KeepReadState pack;
    std::vector<float> values(std::size_t(target.size.x) * target.size.y * ReferenceTarget::kReplicates);
    glBindTexture(GL_TEXTURE_2D_ARRAY, target.replicates.name());
    glGetTexImage(GL_TEXTURE_2D_ARRAY, 0, GL_RED, GL_FLOAT, values.data());
    glBindTexture(GL_TEXTURE_2D_ARRAY, 0);
    return values;
}

void wait_for_gpu() { glFinish(); }

GpuTimer::GpuTimer() { glBeginQuery(GL_TIME_ELAPSED, query_.name()); }
double GpuTimer::milliseconds() const {
    glEndQuery(GL_TIME_ELAPSED);
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(query_.name(), GL_QUERY_RESULT, &nanoseconds);
    return double(nanoseconds) * 1e-6;
}

PanoramaTexels read_panorama(const GpuEnvironment& environment) {
    const KeepTextureBindings keep;
    const KeepReadState pack;
    PanoramaTexels texels;
    glBindTexture(GL_TEXTURE_2D, environment.panorama->name());
    glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &texels.width);
    glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_HEIGHT, &texels.height);
    std::vector<glm::vec4> stored(std::size_t(texels.width) * texels.height);
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_FLOAT, stored.data());
    for (std::size_t i = 0; i < stored.size(); ++i) {
        glm::vec3 radiance(stored[i]);
        if (stored[i].a > 0.0f && !environment.panorama_lights.empty()) {
            const std::size_t row = i / texels.width;
            const glm::vec2 uv((float(i % texels.width) + 0.5f) / float(texels.width),
                               (float(row) + 0.5f) / float(texels.height));
            radiance += stored[i].a * light_color(environment.panorama_lights, equirect_to_direction(uv));
        }
        texels.radiance.push_back(radiance * environment.panorama_scale);
    }
    return texels;
}

}  // namespace patina::gl
