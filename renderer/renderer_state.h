// What a renderer keeps between draws, and the parts of its passes. Includes OpenGL: for renderer*.cpp only.
#pragma once

#include "renderer/features.h"
#include "renderer/gl/environment.h"
#include "renderer/gl/fragment_counts.h"
#include "renderer/gl/program.h"
#include "renderer/gl/surfaces.h"
#include "renderer/gl/target.h"
#include "renderer/renderer.h"
#include "renderer/surface_cache.h"
#include "renderer/uniforms.h"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace patina {

gl::Texture make_brdf_texture();
gl::Texture make_lobe_texture();
EnvironmentHandle make_darkness();
LightLayout layout_of(const GpuEnvironment& environment);
Features features_for(const Scene& scene, const GpuEnvironment& environment);
/// As every pass over a mesh needs them.
void set_switches();

template <class Block>
void upload_block(const gl::Buffer& buffer, GLuint slot, const Block& block) {
    glBindBuffer(GL_UNIFORM_BUFFER, buffer.name());
    glBufferData(GL_UNIFORM_BUFFER, sizeof block, &block, GL_STREAM_DRAW);
    glBindBufferBase(GL_UNIFORM_BUFFER, slot, buffer.name());
}

inline constexpr Features kMaps = Features(Feature::AlbedoMap) | Features(Feature::RoughnessMap) |
                                  Features(Feature::MetallicMap) | Features(Feature::AoMap) |
                                  Features(Feature::NormalMap) | Features(Feature::EmissionMap);
/// What a stored surface depends on.
inline constexpr Features kSurface = kMaps | Features(Feature::Sharp);
/// surface: of kSurface.
SurfaceLayers layers_for(Features surface);
/// Of shaders that read a surface from its layers.
std::vector<std::string> stored_defines(Features features);

inline std::string stored_width() { return "STORED_WIDTH=" + std::to_string(GpuSurfaces::kWidth) + "u"; }
inline constexpr int kIdleScratch = 32;  ///< pictures after which where they were rasterised is given back

/// By what decides their text.
struct StoredPrograms {
    std::map<std::pair<Features, std::vector<std::string>>, gl::Program>
        rasterise;                                         ///< by kSurface, and packed
    std::map<int, gl::Program> fragments;                  ///< by samples
    std::map<std::pair<int, Features>, gl::Program> sort;  ///< by samples and kSurface
    std::map<Features, gl::Program> shade;
    std::map<int, gl::Program> resolve;  ///< by samples
};

struct Renderer::State {
    WorkLedger work;
    ProgramStore programs;
    std::map<Features, gl::Program> surfaces;
    std::map<Features, gl::Program> references, reference_cells;
    std::map<std::pair<Features, int>, gl::Program> rivals;      ///< by samples
    std::array<gl::Program, 4> backgrounds;                      ///< sharp, blurred; the same of stored rays
    std::map<std::tuple<int, int, bool>, gl::Program> displays;  ///< by samples, tone mapper, stored
    StoredPrograms stored;
    SurfaceCache<GpuSurfaces> kept_surfaces;
    gl::SurfaceScratch scratch;
    int scratch_idle = 0;  ///< pictures since it was used
    bool reuse = true;
    gl::FragmentCounts fragments;
    gl::VertexArray nothing = gl::VertexArray::make();  ///< for triangles made in the shader
    gl::Buffer frame_rows = gl::Buffer::make();
    gl::Buffer material_rows = gl::Buffer::make();
    gl::Texture brdf = make_brdf_texture();
    gl::Texture lobes = make_lobe_texture();
    EnvironmentHandle darkness = make_darkness();

    gl::Program compiled(const char* vertex, const char* fragment, const std::vector<std::string>& defines);
    void count_draw(std::uint64_t triangles, std::uint64_t calls = 1);
    const gl::Program& surface(Features features);
    const gl::Program& reference(Features features);
    const gl::Program& cells_of(Features features);
    const gl::Program& rival(Features features, int samples);
    const gl::Program& background(Background background, bool stored = false);
    const gl::Program& display(int samples, Tonemap tonemap, bool stored);
    /// The camera's rows, and with light its own.
    static blocks::FrameBlock frame_of(const Scene& scene, glm::ivec2 size_px, const LightLayout& light,
                                       float largest_radiance);
    void bind_light(const GpuEnvironment& environment) const;
    /// The blocks and the light of a picture; what its shaders are chosen by.
    Features prepare(const Scene& scene, const GpuEnvironment& environment, const RenderTarget& target);
    void draw_counted_mesh(const Scene& scene);
    void draw_radiance(const Scene& scene, const GpuEnvironment& environment, RenderTarget& target,
                       std::optional<int> rival_samples = {});
    void bind_maps(const Scene& scene) const;
    void draw_background(Background background);
    void draw_display(const View& view, const RenderTarget& target);

    // renderer_reference.cpp
    /// The slice's surface, and what its shading reads but for the target's own.
    Features begin_reference(const Scene& scene, const GpuEnvironment& environment, ReferenceTarget& target,
                             const ReferenceSlice& slice);
    void prepare_reference(const Scene& scene, const GpuEnvironment& environment, ReferenceTarget& target);
    void draw_reference(const Scene& scene, const GpuEnvironment& environment, ReferenceTarget& target,
                        const ReferenceSlice& slice);

    // renderer_stored.cpp
    /// The mesh as frame sees it into the surface layers that are bound.
    void rasterise(const Scene& scene, const blocks::FrameBlock& frame, Features surface);
    const gl::Program& stored_surface(Features features);
    gl::SurfacePrograms surface_programs(int samples, Features surface);
    std::shared_ptr<const GpuSurfaces> surfaces_for(const Scene& scene, const RenderTarget& target,
                                                    Features features, Reuse reuse);
    /// old: one that nobody needs any more, or none.
    std::shared_ptr<GpuSurfaces> rasterised(const Scene& scene, const RenderTarget& target, Features surface,
                                            const std::shared_ptr<GpuSurfaces>& old);
    void shade_stored(const Scene& scene, const GpuEnvironment& environment, RenderTarget& target,
                      const std::shared_ptr<const GpuSurfaces>& surfaces);
    void draw_resolved(const RenderTarget& target);
};

}  // namespace patina
