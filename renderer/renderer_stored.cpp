// Surfaces rasterised once and shaded as often as wanted: for views that differ in light or values alone, and
// for sliders.
#include "renderer/gl/mesh.h"
#include "renderer/gl/texture.h"
#include "renderer/renderer_state.h"

#include <algorithm>
#include <iterator>

namespace patina {

namespace {

constexpr std::uint64_t kMostScratchBytes = std::uint64_t{384} << 20;
constexpr int kSmallPixels = 1 << 18;

constexpr std::int64_t kSmallTriangle = 64;  ///< pixels of the picture a triangle of the mesh
bool has_small_triangles(const Scene& scene, glm::ivec2 whole) {
    if (!scene.mesh) return false;
    return std::int64_t(scene.mesh->index_count / 3) * kSmallTriangle > std::int64_t(whole.x) * whole.y;
}

/// Whether a picture is rasterised apart for itself alone. Software shades the borders of small triangles
/// several times over; of sharp lobes, which are put together from the panorama, that takes longer than the
/// programs and the room for doing otherwise, of other ones it does not.
bool pays_within(const Scene& scene, Features features, glm::ivec2 whole) {
    return gl::is_software() && has(features, Feature::Sharp) && has_small_triangles(scene, whole);
}

/// Its maps as they are, but for the normals, which are kept as shaded.
Material with_plain_values(const Material& material) {
    Material plain = material;
    for (ScalarSlot* slot : {&plain.roughness, &plain.metallic, &plain.ao}) {
        slot->value = 1.0f;
        slot->invert = false;
    }
    return plain;
}

std::vector<std::string> with_samples(std::vector<std::string> defines, int samples) {
    if (samples > 1) defines.push_back("SAMPLES=" + std::to_string(samples));
    return defines;
}

/// Of the maps, those that are one picture with the roughness map: it is looked up once for all.
std::vector<std::string> packed_defines(const Scene& scene, Features maps) {
    std::vector<std::string> defines;
    const auto is_packed = [&](MapSlot slot) {
        const auto reads = [&](MapSlot each) { return (maps >> Features(each) & 1u) != 0; };
        return reads(slot) && reads(MapSlot::Roughness) &&
               scene.maps[std::size_t(slot)] == scene.maps[std::size_t(MapSlot::Roughness)];
    };
    if (is_packed(MapSlot::Metallic)) defines.emplace_back("METALLIC_WITH_ROUGHNESS");
    if (is_packed(MapSlot::Ao)) defines.emplace_back("AO_WITH_ROUGHNESS");
    return defines;
}

SurfaceKey key_of(const Scene& scene, Features surface, glm::ivec2 size_px, int samples) {
    SurfaceKey key{.mesh = scene.mesh,
                   .features = surface,
                   .camera = scene.camera,
                   .crop = scene.crop,
                   .size_px = size_px,
                   .samples = samples};
    const Material& material = scene.material;
    const auto reads = [&](MapSlot slot) { return (surface >> Features(slot) & 1u) != 0; };
    for (std::size_t i = 0; i < key.maps.size(); ++i)
        if (reads(MapSlot(i))) key.maps[i] = scene.maps[i];
    const std::array scalars{&material.roughness, &material.metallic, &material.ao};
    for (std::size_t i = 0; i < scalars.size(); ++i)
        if (reads(MapSlot(std::size_t(MapSlot::Roughness) + i))) key.channels[i] = scalars[i]->channel;
    if ((surface & kMaps) != 0) key.uv = material.uv;
    if (!reads(MapSlot::Normal)) return key;
    key.normal_strength = material.normal.value;
    key.normal_convention = material.normal.convention;
    return key;
}

}  // namespace

SurfaceLayers layers_for(Features surface) {
    return {.turns = has(surface, Feature::Sharp),
            .maps = (surface & kMaps) != 0,
            .emission = has(surface, Feature::EmissionMap)};
}

std::vector<std::string> stored_defines(Features features) {
    std::vector<std::string> defines = defines_of(features);
    if ((features & kMaps) != 0) defines.emplace_back("HAS_STORED_MAPS");
    return defines;
}

const gl::Program& Renderer::State::stored_surface(Features features) {
    gl::Program& program = stored.shade[features];
    if (program) return program;
    std::vector<std::string> defines = stored_defines(features);
    defines.emplace_back("HAS_STORED");
    program = compiled("display.vert.glsl", "mesh.frag.glsl", defines);
    return program;
}

gl::SurfacePrograms Renderer::State::surface_programs(int samples, Features surface) {
    const auto sorting = [&](gl::Program& program, std::vector<std::string> defines) {
        if (!program)
            program = compiled("display.vert.glsl", "surfaces_sorted.frag.glsl",
                               with_samples(std::move(defines), samples));
        return program.name();
    };
    return {.fragments = sorting(stored.fragments[samples], {"FRAGMENTS"}),
            .sorted = sorting(stored.sort[{samples, surface}], stored_defines(surface)),
            .nothing = nothing.name()};
}

std::shared_ptr<const GpuSurfaces> Renderer::State::surfaces_for(const Scene& scene,
                                                                 const RenderTarget& target,
                                                                 Features features, Reuse wanted) {
    // Of the mirrored direction, which the other modes' sharp lobes follow, no change over the pixel is kept.
    if (has(features, Feature::Sharp) && !has(features, Feature::Fitted)) return {};
    constexpr int most_triangles = 1 << 24;  // the largest numbers that floats tell apart
    if (!reuse || wanted == Reuse::None || !scene.mesh || scene.view.debug != DebugView::Final ||
        target.samples > 4 || scene.mesh->index_count / 3 >= most_triangles)
        return {};
    const Features surface = features & kSurface;
    if (gl::SurfaceScratch::bytes_for(target.size, target.samples, layers_for(surface)) > kMostScratchBytes)
        return {};
    if (wanted == Reuse::Within) {
        if (!pays_within(scene, features, whole_px(scene.crop, target.size))) return {};
        return rasterised(scene, target, surface, {});
    }
    const SurfaceKey key = key_of(scene, surface, target.size, target.samples);
    SurfaceKey sharp = key;  // holds all that others need
    sharp.features |= Features(Feature::Sharp);
    if (auto found = kept_surfaces.find(sharp, key)) {
        if (++scratch_idle > kIdleScratch) scratch = {};
        return found;
    }
    // Software spends more on small triangles than on keeping what lies under them.
    const bool at_once = wanted == Reuse::Expected || wanted == Reuse::Standing ||
                         (gl::is_software() && target.size.x * target.size.y <= kSmallPixels);
    if (!at_once && !kept_surfaces.was_drawn(key)) return {};
    auto made = rasterised(scene, target, surface, kept_surfaces.take_old(key));
    kept_surfaces.keep(key, made);
    // One view's camera stood still for this; a sheet's is likely to move on.
    scratch_idle = 0;
    if (!at_once || wanted == Reuse::Standing) scratch = {};
    return made;
}

void Renderer::State::rasterise(const Scene& scene, const blocks::FrameBlock& frame, Features surface) {
    upload_block(frame_rows, gl::kFrameSlot, frame);
    upload_block(material_rows, gl::kMaterialSlot,
                 make_material_block(with_plain_values(scene.material), surface, 1.0f));
    bind_maps(scene);
    std::vector<std::string> defines = packed_defines(scene, surface);
    gl::Program& program = stored.rasterise[{surface, defines}];
    if (!program) {
        std::ranges::copy(stored_defines(surface), std::back_inserter(defines));
        program = compiled("mesh.vert.glsl", "surfaces.frag.glsl", defines);
    }
    glUseProgram(program.name());
    draw_counted_mesh(scene);
}

std::shared_ptr<GpuSurfaces> Renderer::State::rasterised(const Scene& scene, const RenderTarget& target,
                                                         Features surface,
                                                         const std::shared_ptr<GpuSurfaces>& old) {
    if (!scratch.fits(target.size, target.samples, layers_for(surface)))
        scratch.make(target.size, target.samples, layers_for(surface));
    set_switches();
    scratch.begin();
    rasterise(scene, frame_of(scene, target.size, {}, 0.0f), surface);
    if (is_counted(scene.crop)) ++work.surfaces_rasterised;
    count_draw(2, 2);
    return std::make_shared<GpuSurfaces>(
        scratch.finish(surface_programs(target.samples, surface), old ? std::move(*old) : GpuSurfaces{}));
}

void Renderer::State::shade_stored(const Scene& scene, const GpuEnvironment& environment,
                                   RenderTarget& target, const std::shared_ptr<const GpuSurfaces>& from) {
    set_switches();
    gl::begin_shading(target.stored, from, target.full_float);
    Features features = prepare(scene, environment, target);
    if (from->kept.turns) features |= Features(Feature::Sharp);  // the same picture, without another program
    gl::bind_surface_layers(*from);
    gl::shade_rows(*from, gl::StoredRows::Mesh, stored_surface(features).name(), nothing.name());
    if (is_counted(scene.crop)) ++work.views_from_surfaces;
    count_draw(1);
    if (scene.view.background == Background::Plain) return;
    gl::shade_rows(*from, gl::StoredRows::Behind, background(scene.view.background, true).name(),
                   nothing.name());
    count_draw(1);
}

void Renderer::State::draw_resolved(const RenderTarget& target) {
    gl::Program& program = stored.resolve[target.samples];
    if (!program)
        program = compiled("display.vert.glsl", "resolved.frag.glsl",
                           with_samples({"HAS_STORED", stored_width()}, target.samples));
    gl::bind_texture(gl::kPictureUnit, GL_TEXTURE_2D, target.stored.colors);
    gl::bind_surface_pixels(*target.stored.surfaces);
    gl::draw_all(program.name(), nothing.name(), {0, 0, target.size});
}

/// A part has not so few pixels that transforming the vertices for each takes longer than shading. Whole
/// quads of pixels: gradients are then those of the whole picture.
int Renderer::rows_at_once(const Scene& scene, glm::ivec2 size_px) {
    constexpr int quad = 4;
    std::int64_t pixels = std::int64_t{1} << 24;
    if (gl::is_software() && has_small_triangles(scene, size_px))
        pixels = std::max<std::int64_t>(std::int64_t{1} << 16, scene.mesh->index_count / 3);
    const auto all = std::int64_t(size_px.x) * size_px.y;
    const int parts = int(std::max<std::int64_t>((all + pixels - 1) / pixels, 1));
    const int rows = (size_px.y + parts - 1) / parts;
    return (rows + quad - 1) / quad * quad;
}

bool Renderer::is_software() { return gl::is_software(); }

bool Renderer::same_surface(const Scene& a, const Scene& b) {
    const auto key = [](const Scene& scene) {
        const Features features = features_of(scene.material, Renderer::ranges_of(scene), scene.view, 1.0f);
        return key_of(scene, features & kMaps, {}, 1);
    };
    return a.mesh && key(a) == key(b);
}

}  // namespace patina
