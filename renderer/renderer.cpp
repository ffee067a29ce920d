#include "renderer/renderer.h"

#include "renderer/brdf.h"
#include "renderer/features.h"
#include "renderer/gl/brdf_table.h"
#include "renderer/gl/environment.h"
#include "renderer/gl/mesh.h"
#include "renderer/gl/program.h"
#include "renderer/gl/reference.h"
#include "renderer/gl/target.h"
#include "renderer/gl/texture.h"
#include "renderer/lobes/lobe_table.h"
#include "renderer/tonemap.h"
#include "renderer/uniforms.h"

#include <algorithm>
#include <bitset>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

namespace patina {

namespace {

constexpr std::size_t kUploadAtOnce = std::size_t{1} << 26;

/// For the length of a call.
template <class T>
std::shared_ptr<const T> borrowed(const T& value) {
    return {std::shared_ptr<const T>{}, &value};
}

gl::Texture make_brdf_texture() {
    assert(brdf::kAlbedoTableSize == float(kShadingTableSize));
    const gl::KeepTextureBindings keep;
    gl::Texture texture = gl::Texture::make();
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RG16, kShadingTableSize, kShadingTableSize, 0, GL_RG, GL_UNSIGNED_SHORT,
                 embedded::brdf_table().data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    return texture;
}

/// Slices: one tap F0 = 1, one tap F0 = 0.04, two taps likewise, the two taps' weights likewise.
gl::Texture make_lobe_texture() {
    constexpr int size = kLobeTableSize;
    std::vector<glm::vec4> texels(std::size_t(6) * size * size);
    for (int i = 0; i < size * size; ++i) {
        for (int metal = 0; metal < 2; ++metal) {
            const LobeNode& node = lobe_nodes()[i].by_reflectance[metal];
            const auto put = [&](int slice, glm::vec4 texel) {
                texels[std::size_t(slice + metal) * size * size + i] = texel;
            };
            put(0, {node.one.kappa, node.one.log2_ratio, node.one_irradiance, 0.0f});
            put(2, {node.two[0].kappa, node.two[0].log2_ratio, node.two[1].kappa, node.two[1].log2_ratio});
            put(4, {node.second_weight, node.two_irradiance, 0.0f, 0.0f});
        }
    }
    const gl::KeepTextureBindings keep;
    gl::Texture texture = gl::Texture::make();
    glBindTexture(GL_TEXTURE_3D, texture.name());
    glTexImage3D(GL_TEXTURE_3D, 0, GL_RGBA32F, size, size, 6, 0, GL_RGBA, GL_FLOAT, texels.data());
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glTexParameteri(GL_TEXTURE_3D, axis, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAX_LEVEL, 0);
    return texture;
}

/// No light at all, for scenes that have none yet.
EnvironmentHandle make_darkness() {
    const CubeMap black{1, std::vector<glm::vec3>(6, glm::vec3(0.0f))};
    BakedEnvironment baked;
    baked.levels = {{1.0f, black}};
    baked.irradiance = black;
    Environment environment;
    environment.width = environment.height = 1;
    environment.radiance = {glm::vec3(0.0f)};
    return Renderer::begin_upload(std::make_shared<PreparedLight>(PreparedLight{
                                      make_panorama_levels(environment), make_light_levels(baked)}))
        .finish();
}

LightLayout layout_of(const GpuEnvironment& environment) {
    return {environment.panorama_scale,    environment.levels_scale, environment.irradiance_scale,
            environment.texels_per_radian, environment.layers,       environment.roughness,
            environment.sharpest,          environment.lights,       environment.panorama_lights};
}

Features features_for(const Scene& scene, const GpuEnvironment& environment) {
    std::bitset<kMapSlots> bound;
    for (std::size_t i = 0; i < scene.maps.size(); ++i) bound[i] = scene.maps[i] != nullptr;
    return features_of(scene.material, bound, scene.view, environment.sharpest);
}

template <class Block>
void upload_block(const gl::Buffer& buffer, GLuint slot, const Block& block) {
    glBindBuffer(GL_UNIFORM_BUFFER, buffer.name());
    glBufferData(GL_UNIFORM_BUFFER, sizeof block, &block, GL_STREAM_DRAW);
    glBindBufferBase(GL_UNIFORM_BUFFER, slot, buffer.name());
}

void bind_texture(GLuint unit, GLenum kind, const gl::Texture& texture) {
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindSampler(unit, 0);
    glBindTexture(kind, texture.name());
}

void set_switches() {
    for (const GLenum off : {GL_BLEND, GL_CULL_FACE, GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_FRAMEBUFFER_SRGB,
                             GL_RASTERIZER_DISCARD, GL_COLOR_LOGIC_OP, GL_SAMPLE_ALPHA_TO_COVERAGE})
        glDisable(off);
    for (const GLenum on : {GL_DEPTH_TEST, GL_MULTISAMPLE, GL_TEXTURE_CUBE_MAP_SEAMLESS}) glEnable(on);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

}  // namespace

struct Renderer::State {
    WorkLedger work;
    std::map<Features, gl::Program> surfaces;
    std::map<Features, gl::Program> references;
    std::map<std::pair<Features, int>, gl::Program> rivals;  ///< by samples
    gl::Program depth;                                       ///< of a mesh, nothing else
    std::array<gl::Program, 2> backgrounds;                  ///< sharp, blurred
    std::map<std::pair<int, int>, gl::Program> displays;     ///< by samples and tone mapper
    gl::VertexArray nothing = gl::VertexArray::make();       ///< for triangles made in the shader
    gl::Buffer frame_rows = gl::Buffer::make();
    gl::Buffer material_rows = gl::Buffer::make();
    gl::Texture brdf = make_brdf_texture();
    gl::Texture lobes = make_lobe_texture();
    EnvironmentHandle darkness = make_darkness();

    gl::Program compiled(const char* vertex, const char* fragment, const std::vector<std::string>& defines);
    void count_draw(std::uint64_t triangles, std::uint64_t calls = 1);
    const gl::Program& surface(Features features);
    const gl::Program& reference(Features features);
    const gl::Program& rival(Features features, int samples);
    const gl::Program& depth_only();
    const gl::Program& background(Background background);
    const gl::Program& display(int samples, Tonemap tonemap);
    void bind_light(const GpuEnvironment& environment) const;
    void draw_radiance(const Scene& scene, const GpuEnvironment& environment, RenderTarget& target,
                       std::optional<int> rival_samples = {});
    void bind_maps(const Scene& scene) const;
    void draw_background(Background background);
    void draw_reference(const Scene& scene, const GpuEnvironment& environment, ReferenceTarget& target,
                        const ReferenceSlice& slice);
    void draw_display(const View& view, const RenderTarget& target);
};

gl::Program Renderer::State::compiled(const char* vertex, const char* fragment,
                                      const std::vector<std::string>& defines) {
    ++work.programs_compiled;
    return gl::make_program(gl::embedded_shader(vertex), gl::embedded_shader(fragment), defines);
}

void Renderer::State::count_draw(std::uint64_t triangles, std::uint64_t calls) {
    work.draw_calls += calls;
    work.triangles_drawn += triangles;
}

const gl::Program& Renderer::State::surface(Features features) {
    gl::Program& program = surfaces[features];
    if (!program) program = compiled("mesh.vert.glsl", "mesh.frag.glsl", defines_of(features));
    return program;
}

const gl::Program& Renderer::State::reference(Features features) {
    gl::Program& program = references[features];
    if (!program) program = compiled("mesh.vert.glsl", "reference.frag.glsl", defines_of(features));
    return program;
}

const gl::Program& Renderer::State::rival(Features features, int samples) {
    gl::Program& program = rivals[{features, samples}];
    if (program) return program;
    std::vector<std::string> defines = defines_of(features);
    defines.push_back("RIVAL_SAMPLES=" + std::to_string(samples));
    program = compiled("mesh.vert.glsl", "rivals.frag.glsl", defines);
    return program;
}

const gl::Program& Renderer::State::depth_only() {
    if (!depth) depth = compiled("mesh.vert.glsl", "depth.frag.glsl", {});
    return depth;
}

const gl::Program& Renderer::State::background(Background background) {
    const bool blurred = background == Background::Blurred;
    gl::Program& program = backgrounds[blurred ? 1 : 0];
    if (!program)
        program = compiled("background.vert.glsl", "background.frag.glsl",
                           blurred ? std::vector<std::string>{"HAS_BLUR"} : std::vector<std::string>{});
    return program;
}

const gl::Program& Renderer::State::display(int samples, Tonemap tonemap) {
    gl::Program& program = displays[{samples, int(tonemap)}];
    if (program) return program;
    std::vector<std::string> defines{"TONEMAP=" + std::to_string(int(tonemap))};
    if (samples > 1) defines.push_back("SAMPLES=" + std::to_string(samples));
    program = compiled("display.vert.glsl", "display.frag.glsl", defines);
    return program;
}

void Renderer::State::bind_light(const GpuEnvironment& environment) const {
    bind_texture(gl::kPanoramaUnit, GL_TEXTURE_2D, *environment.panorama);
    bind_texture(gl::kLevelsUnit, GL_TEXTURE_CUBE_MAP_ARRAY, environment.levels);
    bind_texture(gl::kIrradianceUnit, GL_TEXTURE_CUBE_MAP, environment.irradiance);
    bind_texture(gl::kBrdfUnit, GL_TEXTURE_2D, brdf);
    bind_texture(gl::kLobesUnit, GL_TEXTURE_3D, lobes);
}

void Renderer::State::bind_maps(const Scene& scene) const {
    for (std::size_t i = 0; i < scene.maps.size(); ++i)
        if (scene.maps[i]) bind_texture(gl::kFirstMapUnit + GLuint(i), GL_TEXTURE_2D, scene.maps[i]->texture);
}

/// After the mesh, at the far plane: only what the mesh leaves free is computed.
void Renderer::State::draw_background(Background shown) {
    glDepthMask(GL_FALSE);
    glUseProgram(background(shown).name());
    glBindVertexArray(nothing.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Renderer::State::draw_radiance(const Scene& scene, const GpuEnvironment& environment,
                                    RenderTarget& target, std::optional<int> rival_samples) {
    glBindFramebuffer(GL_FRAMEBUFFER, target.radiance_framebuffer.name());
    glViewport(0, 0, target.size.x, target.size.y);
    set_switches();
    const GLfloat empty[] = {0.0f, 0.0f, 0.0f, 0.0f};
    const GLfloat far = 1.0f;
    glClearBufferfv(GL_COLOR, 0, empty);
    glClearBufferfv(GL_DEPTH, 0, &far);

    const Features features = features_for(scene, environment);
    const auto frame = make_frame_block(scene.camera, scene.view, target.size, layout_of(environment),
                                        gl::largest_radiance(target));
    upload_block(frame_rows, gl::kFrameSlot, frame);
    upload_block(material_rows, gl::kMaterialSlot,
                 make_material_block(scene.material, features, frame.camera_position.w));
    bind_light(environment);
    if (scene.mesh) {
        bind_maps(scene);
        const gl::Program& program =
            rival_samples ? rival(reference_features(features), *rival_samples) : surface(features);
        glUseProgram(program.name());
        const int calls = gl::draw_mesh(*scene.mesh, camera_position(scene.camera));
        count_draw(std::uint64_t(calls) * std::uint64_t(scene.mesh->index_count) / 3, std::uint64_t(calls));
    }
    if (scene.view.background == Background::Plain || is_data_view(scene.view.debug)) return;
    draw_background(scene.view.background);
    count_draw(1);
}

void Renderer::State::draw_reference(const Scene& scene, const GpuEnvironment& environment,
                                     ReferenceTarget& target, const ReferenceSlice& slice) {
    View view = scene.view;
    view.debug = DebugView::Final;
    const Features features = reference_features(features_for(scene, environment));
    auto frame = make_frame_block(scene.camera, view, target.size, layout_of(environment),
                                  std::numeric_limits<float>::max());
    move_picture(frame, 2.0f * slice.jitter_px / glm::vec2(target.size));
    const float exposure = frame.camera_position.w;
    set_switches();
    gl::begin_reference_slice(target, slice.replicate, slice.weight);
    upload_block(frame_rows, gl::kFrameSlot, frame);
    upload_block(material_rows, gl::kMaterialSlot, make_material_block(scene.material, features, exposure));
    bind_light(environment);
    if (scene.mesh) {
        bind_maps(scene);
        glBindBufferBase(GL_UNIFORM_BUFFER, gl::kPointSlot, target.points.name());
        gl::begin_reference_pass(gl::ReferencePass::Depth);
        glUseProgram(depth_only().name());
        gl::draw_mesh(*scene.mesh, camera_position(scene.camera));
        gl::begin_reference_pass(gl::ReferencePass::Surface);
        const gl::Program& program = reference(features);
        glUseProgram(program.name());
        const double light = slice.total * double(exposure);
        glUniform2f(glGetUniformLocation(program.name(), "reference_slice"), float(slice.points),
                    light > 0.0 ? float(1.0 / light) : 0.0f);
        gl::draw_mesh(*scene.mesh, camera_position(scene.camera));
    }
    gl::begin_reference_pass(gl::ReferencePass::Background);
    if (view.background != Background::Plain) draw_background(view.background);
    gl::end_reference_slice();
}

void Renderer::State::draw_display(const View& view, const RenderTarget& target) {
    glBindFramebuffer(GL_FRAMEBUFFER, target.display_framebuffer.name());
    glDisable(GL_DEPTH_TEST);
    const gl::Program& program =
        display(target.samples, is_data_view(view.debug) ? Tonemap::None : view.tonemap);
    bind_texture(gl::kPictureUnit, target.radiance_kind(), target.radiance);
    glUseProgram(program.name());
    const glm::vec3 plain = glm::clamp(view.plain_color, 0.0f, 1.0f);
    glUniform3f(glGetUniformLocation(program.name(), "plain"), plain.x, plain.y, plain.z);
    glBindVertexArray(nothing.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    count_draw(1);
    glBindTexture(target.radiance_kind(), 0);
}

Renderer::Renderer() {
    if (epoxy_gl_version() < 41 || !epoxy_is_desktop_gl())
        throw std::runtime_error("This graphics driver offers no OpenGL 4.1: install a newer driver.");
    state_ = std::make_unique<State>();
}

Renderer::~Renderer() = default;

namespace {

struct MapWriter {
    explicit MapWriter(const MapLevels& map) : writer(map.levels, map.srgb) {}
    bool step(const MapLevels& map, std::size_t byte_budget) { return writer.step(map.levels, byte_budget); }
    GpuMap take() { return writer.take(); }
    gl::TextureWriter writer;
};

/// Writer(input) makes the empty thing, step(input, bytes) fills it, take() hands it over.
template <class Gpu, class Writer, class Input>
Upload<Gpu> make_upload(std::shared_ptr<const Input> input) {
    const auto writer = std::make_shared<Writer>(*input);
    const auto step = [writer, input](std::size_t byte_budget) { return writer->step(*input, byte_budget); };
    return {step, [writer, step]() -> std::shared_ptr<const Gpu> {
                while (!step(kUploadAtOnce)) {
                }
                return std::make_shared<Gpu>(writer->take());
            }};
}

}  // namespace

Upload<GpuEnvironment> Renderer::begin_upload(std::shared_ptr<const PreparedLight> light) {
    return make_upload<GpuEnvironment, gl::EnvironmentWriter>(std::move(light));
}

Upload<GpuMesh> Renderer::begin_upload(std::shared_ptr<const PreparedMesh> mesh) {
    return make_upload<GpuMesh, gl::MeshWriter>(std::move(mesh));
}

Upload<GpuMap> Renderer::begin_upload(std::shared_ptr<const MapLevels> levels) {
    return make_upload<GpuMap, MapWriter>(std::move(levels));
}

EnvironmentHandle Renderer::upload_environment(const Environment& environment,
                                               const BakedEnvironment& baked) {
    const PreparedLight light{make_panorama_levels(environment), make_light_levels(baked)};
    return begin_upload(borrowed(light)).finish();
}

MeshHandle Renderer::upload_mesh(const Mesh& mesh) {
    const PreparedMesh ready = prepare_mesh(mesh);
    return begin_upload(borrowed(ready)).finish();
}

MapHandle Renderer::upload_map(const MapLevels& levels) { return begin_upload(borrowed(levels)).finish(); }

MapHandle Renderer::upload_thumbnail(const Image& image) {
    return std::make_shared<GpuMap>(gl::make_interface_texture(image));
}

WorkLedger& Renderer::work() { return state_->work; }

std::uintptr_t Renderer::texture_of(const GpuMap& map) { return map.texture.name(); }

const std::string& Renderer::note_of(const GpuMap& map) { return map.note; }

TargetHandle Renderer::make_target(glm::ivec2 size_px, int samples, TargetPrecision precision) {
    return std::make_shared<RenderTarget>(
        gl::make_render_target(size_px, samples, precision == TargetPrecision::Full));
}

void Renderer::draw(const Scene& scene, RenderTarget& target) {
    const gl::KeepDrawState keep;
    const GpuEnvironment& environment = scene.environment ? *scene.environment : *state_->darkness;
    Scene shown = scene;
    if (!scene.environment) shown.view.background = Background::Plain;
    target.plain = scene.view.plain_color;
    state_->draw_radiance(shown, environment, target);
    state_->draw_display(shown.view, target);
    ++state_->work.views_drawn;
    state_->work.pixels_drawn += std::uint64_t(target.size.x) * std::uint64_t(target.size.y);
}

void Renderer::draw_rival(const Scene& scene, RenderTarget& target, int samples) {
    const gl::KeepDrawState keep;
    const GpuEnvironment& environment = scene.environment ? *scene.environment : *state_->darkness;
    target.plain = scene.view.plain_color;
    state_->draw_radiance(scene, environment, target, samples);
    state_->draw_display(scene.view, target);
}

double Renderer::timed_draw(const Scene& scene, RenderTarget& target) {
    double least = std::numeric_limits<double>::max();
    for (int i = 0; i < 2; ++i) {  // the first may compile
        gl::wait_for_gpu();
        const gl::GpuTimer timer;
        draw(scene, target);
        least = std::min(least, timer.milliseconds());
    }
    return least;
}

void Renderer::draw_reference(const Scene& scene, ReferenceTarget& target, const ReferenceSlice& slice) {
    const gl::KeepDrawState keep;
    Scene shown = scene;
    if (!scene.environment) shown.view.background = Background::Plain;
    state_->draw_reference(shown, scene.environment ? *scene.environment : *state_->darkness, target, slice);
}

void Renderer::show(const View& view, const RenderTarget& target) {
    const gl::KeepDrawState keep;
    set_switches();
    glViewport(0, 0, target.size.x, target.size.y);
    state_->draw_display(view, target);
}

void Renderer::prepare(const Scene& scene) {
    const gl::KeepDrawState keep;
    state_->surface(features_for(scene, scene.environment ? *scene.environment : *state_->darkness));
}

std::uintptr_t Renderer::display_texture(const RenderTarget& target) { return target.display.name(); }
glm::ivec2 Renderer::size_px(const RenderTarget& target) { return target.size; }
Image Renderer::read_display(const RenderTarget& target) { return gl::read_display_pixels(target); }
Image Renderer::read_radiance(const RenderTarget& target) { return gl::read_radiance_pixels(target); }

Renderer::PixelValue Renderer::read_pixel(const RenderTarget& target, glm::ivec2 pixel) {
    const gl::PixelValue value = gl::read_pixel_value(target, pixel);
    return {value.radiance, value.display};
}

}  // namespace patina
