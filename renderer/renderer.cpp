#include "renderer/renderer.h"

#include "renderer/gl/mesh.h"
#include "renderer/gl/reference.h"
#include "renderer/gl/texture.h"
#include "renderer/renderer_state.h"
#include "renderer/tonemap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

namespace patina {

namespace {

constexpr std::size_t kUploadAtOnce = std::size_t{1} << 26;

/// For its lifetime.
struct CountedFragments {
    explicit CountedFragments(gl::FragmentCounts& all) : counts(all) { counts.begin(); }
    ~CountedFragments() { counts.end(); }
    CountedFragments(const CountedFragments&) = delete;
    CountedFragments& operator=(const CountedFragments&) = delete;
    gl::FragmentCounts& counts;
};

/// For the length of a call.
template <class T>
std::shared_ptr<const T> borrowed(const T& value) {
    return {std::shared_ptr<const T>{}, &value};
}

}  // namespace

void Renderer::State::bind_light(const GpuEnvironment& environment) const {
    gl::bind_texture(gl::kPanoramaUnit, GL_TEXTURE_2D, *environment.panorama);
    gl::bind_texture(gl::kLevelsUnit, GL_TEXTURE_CUBE_MAP_ARRAY, environment.levels);
    gl::bind_texture(gl::kIrradianceUnit, GL_TEXTURE_CUBE_MAP, environment.irradiance);
    gl::bind_texture(gl::kBrdfUnit, GL_TEXTURE_2D, brdf);
    gl::bind_texture(gl::kLobesUnit, GL_TEXTURE_3D, lobes);
}

blocks::FrameBlock Renderer::State::frame_of(const Scene& scene, glm::ivec2 size_px, const LightLayout& light,
                                             float largest_radiance) {
    auto frame =
        make_frame_block(scene.camera, scene.view, whole_px(scene.crop, size_px), light, largest_radiance);
    crop_picture(frame, scene.crop, size_px);
    return frame;
}

void Renderer::State::bind_maps(const Scene& scene) const {
    for (std::size_t i = 0; i < scene.maps.size(); ++i)
        if (scene.maps[i])
            gl::bind_texture(gl::kFirstMapUnit + GLuint(i), GL_TEXTURE_2D, scene.maps[i]->texture);
}

/// After the mesh, at the far plane: only what the mesh leaves free is computed.
void Renderer::State::draw_background(Background shown) {
    glDepthMask(GL_FALSE);
    glUseProgram(background(shown).name());
    glBindVertexArray(nothing.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

Features Renderer::State::prepare(const Scene& scene, const GpuEnvironment& environment,
                                  const RenderTarget& target) {
    const Features features = features_for(scene, environment);
    const auto frame = frame_of(scene, target.size, layout_of(environment), gl::largest_radiance(target));
    upload_block(frame_rows, gl::kFrameSlot, frame);
    upload_block(material_rows, gl::kMaterialSlot,
                 make_material_block(scene.material, features, frame.camera_position.w));
    bind_light(environment);
    return features;
}

void Renderer::State::draw_counted_mesh(const Scene& scene) {
    const int calls = gl::draw_mesh(*scene.mesh, camera_position(scene.camera));
    count_draw(std::uint64_t(calls) * std::uint64_t(scene.mesh->index_count) / 3, std::uint64_t(calls));
}

void Renderer::State::draw_radiance(const Scene& scene, const GpuEnvironment& environment,
                                    RenderTarget& target, std::optional<int> rival_samples) {
    target.stored.surfaces.reset();
    gl::bind_radiance(target);
    glViewport(0, 0, target.size.x, target.size.y);
    set_switches();
    const GLfloat empty[] = {0.0f, 0.0f, 0.0f, 0.0f};
    const GLfloat far = 1.0f;
    glClearBufferfv(GL_COLOR, 0, empty);
    glClearBufferfv(GL_DEPTH, 0, &far);

    const Features features = prepare(scene, environment, target);
    if (scene.mesh) {
        bind_maps(scene);
        const gl::Program& program =
            rival_samples ? rival(reference_features(features), *rival_samples) : surface(features);
        glUseProgram(program.name());
        draw_counted_mesh(scene);
    }
    if (scene.view.background == Background::Plain || is_data_view(scene.view.debug)) return;
    draw_background(scene.view.background);
    count_draw(1);
}

void Renderer::State::draw_display(const View& view, const RenderTarget& target) {
    glBindFramebuffer(GL_FRAMEBUFFER, target.display_framebuffer.name());
    glDisable(GL_DEPTH_TEST);
    glViewport(0, 0, target.size.x, target.size.y);
    const bool is_stored = target.stored.surfaces != nullptr;
    const gl::Program& program =
        display(target.samples, is_data_view(view.debug) ? Tonemap::None : view.tonemap, is_stored);
    if (is_stored) {
        gl::bind_texture(gl::kPictureUnit, GL_TEXTURE_2D, target.stored.colors);
        gl::bind_surface_pixels(*target.stored.surfaces);
    } else {
        gl::bind_texture(gl::kPictureUnit, target.radiance_kind(), target.radiance);
    }
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
    explicit MapWriter(const MapLevels& map) : writer(map.levels, map.srgb), ranges(map.ranges) {}
    bool step(const MapLevels& map, std::size_t byte_budget) { return writer.step(map.levels, byte_budget); }
    GpuMap take() {
        GpuMap map = writer.take();
        map.ranges = ranges;
        return map;
    }
    gl::TextureWriter writer;
    ChannelRanges ranges;
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

WorkLedger& Renderer::work() {
    state_->work.fragments_shaded += state_->fragments.take();
    return state_->work;
}

std::uintptr_t Renderer::texture_of(const GpuMap& map) { return map.texture.name(); }

const std::string& Renderer::note_of(const GpuMap& map) { return map.note; }

const ChannelRanges& Renderer::ranges_of(const GpuMap& map) { return map.ranges; }

MapRanges Renderer::ranges_of(const Scene& scene) {
    MapRanges ranges;
    for (std::size_t i = 0; i < scene.maps.size(); ++i)
        if (scene.maps[i]) ranges[i] = scene.maps[i]->ranges;
    return ranges;
}

TargetHandle Renderer::make_target(glm::ivec2 size_px, int samples, TargetPrecision precision) {
    return std::make_shared<RenderTarget>(
        gl::make_render_target(size_px, samples, precision == TargetPrecision::Full));
}

void Renderer::draw(const Scene& scene, RenderTarget& target, Reuse reuse) {
    const gl::KeepDrawState keep;
    const CountedFragments counted(state_->fragments);
    const GpuEnvironment& environment = scene.environment ? *scene.environment : *state_->darkness;
    Scene shown = scene;
    if (!scene.environment) shown.view.background = Background::Plain;
    target.plain = scene.view.plain_color;
    if (reuse == Reuse::Within) target.stored.surfaces.reset();  // nobody comes back to them: no room for two
    auto surfaces = state_->surfaces_for(shown, target, features_for(shown, environment), reuse);
    if (surfaces)
        state_->shade_stored(shown, environment, target, surfaces);
    else
        state_->draw_radiance(shown, environment, target);
    state_->draw_display(shown.view, target);
    if (is_counted(scene.crop)) ++state_->work.views_drawn;
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
    const CountedFragments counted(state_->fragments);
    state_->draw_reference(scene, scene.environment ? *scene.environment : *state_->darkness, target, slice);
}

void Renderer::prepare_reference(const Scene& scene, ReferenceTarget& target) {
    const gl::KeepDrawState keep;
    const CountedFragments counted(state_->fragments);
    Scene shown = scene;
    if (!scene.environment) shown.view.background = Background::Plain;
    state_->prepare_reference(shown, scene.environment ? *scene.environment : *state_->darkness, target);
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
Image Renderer::read_radiance(const RenderTarget& target) {
    return gl::read_radiance_pixels(target, [&] { state_->draw_resolved(target); });
}

void Renderer::set_program_store(ProgramStore store) { state_->programs = std::move(store); }

void Renderer::set_reuse(bool allowed) {
    state_->reuse = allowed;
    if (!allowed) state_->kept_surfaces.clear();
}

Renderer::PixelValue Renderer::read_pixel(const RenderTarget& target, glm::ivec2 pixel) {
    const gl::PixelValue value = gl::read_pixel_value(target, pixel, [&] { state_->draw_resolved(target); });
    return {value.radiance, value.display};
}

}  // namespace patina
