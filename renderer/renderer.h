// Draws a material on a mesh under baked light. Needs a current OpenGL 4.1 core context; knows no window, no
// file, no thread.
//
// Nothing is kept between draws but what upload_* returned: N views share meshes, maps and light by passing
// the same handles.
#pragma once

#include "materials/material.h"
#include "renderer/core/camera.h"
#include "renderer/core/crop.h"
#include "renderer/core/environment.h"
#include "renderer/core/image.h"
#include "renderer/core/ledger.h"
#include "renderer/core/mesh.h"
#include "renderer/core/program_store.h"
#include "renderer/core/view.h"
#include "renderer/gl/light_levels.h"
#include "renderer/gl/mesh_prepare.h"
#include "renderer/ibl/bake.h"
#include "renderer/map_levels.h"
#include "renderer/map_range.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace patina {

struct GpuEnvironment;
struct GpuMesh;
struct GpuMap;
using EnvironmentHandle = std::shared_ptr<const GpuEnvironment>;
using MeshHandle = std::shared_ptr<const GpuMesh>;
using MapHandle = std::shared_ptr<const GpuMap>;

/// Everything one picture needs. A slot without a handle is shaded by its value alone, even if the material
/// names a map.
struct Scene {
    EnvironmentHandle environment;
    MeshHandle mesh;
    std::array<MapHandle, kMapSlots> maps;
    Material material;
    Camera camera;
    View view;
    Crop crop;
    bool operator==(const Scene&) const = default;  ///< the same picture
};

/// Where a picture is drawn: linear radiance and the display picture (8-bit sRGB-encoded).
struct RenderTarget;
struct ReferenceTarget;
using TargetHandle = std::shared_ptr<RenderTarget>;
/// How radiance is kept: half floats end at 65504 and are what a screen needs, full floats are for measuring
/// and saving.
enum class TargetPrecision { Half, Full };

/// Whether a picture's surface is worth being rasterised apart from its light, to be shaded again when only
/// values, light or view change, or by other views that show the same mesh, camera and maps. The picture is
/// the same either way.
enum class Reuse {
    None,
    Within,      ///< for this picture alone, where software gains by it
    IfRepeated,  ///< when the same surface was drawn a moment ago
    Expected,    ///< more pictures of it follow
    Standing     ///< likewise, and then none from a moved camera: where it was rasterised is given back
};

/// Something large on its way to the GPU, a portion a frame, so that the window does not stall.
template <class T>
struct Upload {
    std::function<bool(std::size_t byte_budget)>
        step;                                          ///< copies about so many bytes; true when all is there
    std::function<std::shared_ptr<const T>()> finish;  ///< copies what is left and hands it over; call once
};

/// What upload_environment is given for pictures: the standard levels, compact lights apart.
inline BakeSettings drawing_bake_settings() {
    BakeSettings settings;
    settings.extract_lights = true;
    return settings;
}

class Renderer {
public:
    /// Throws std::runtime_error when the context is older than 4.1 or a shader does not compile.
    Renderer();
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    // All at once …
    EnvironmentHandle upload_environment(const Environment& environment, const BakedEnvironment& baked);
    MeshHandle upload_mesh(const Mesh& mesh);
    MapHandle upload_map(const MapLevels& levels);
    // … or spread over frames, with what is to be computed beforehand done on a worker. Call with the context
    // current, as step and finish.
    static Upload<GpuEnvironment> begin_upload(std::shared_ptr<const PreparedLight> light);
    static Upload<GpuMesh> begin_upload(std::shared_ptr<const PreparedMesh> mesh);
    static Upload<GpuMap> begin_upload(std::shared_ptr<const MapLevels> levels);

    /// samples: MSAA, clamped to what the driver offers; size ≥ 1×1.
    TargetHandle make_target(glm::ivec2 size_px, int samples = 4,
                             TargetPrecision precision = TargetPrecision::Half);
    /// Shading::Reference is drawn as split sum here: the reference gathers over many draws (reference.h).
    /// Without an environment only emission and a plain background are seen, without a mesh only the
    /// background. The plain background is shown as it is: neither exposure nor tone mapping touch it.
    void draw(const Scene& scene, RenderTarget& target, Reuse reuse = Reuse::None);
    /// From now on programs are taken from there where the driver agrees, and given there when compiled.
    void set_program_store(ProgramStore store);
    /// Whether the processor draws, not a graphics card.
    static bool is_software();
    /// How many rows of a picture of that size are best drawn at once, each other part by its crop:
    /// what lies under a picture's samples takes software more room than the picture.
    static int rows_at_once(const Scene& scene, glm::ivec2 size_px);
    /// False: every picture is rasterised anew, for comparison.
    void set_reuse(bool allowed);
    /// Whether both show one surface at one size: what draw() can shade without rasterising it again.
    static bool same_surface(const Scene& a, const Scene& b);
    /// draw() twice; the milliseconds that the GPU took for the shorter one.
    double timed_draw(const Scene& scene, RenderTarget& target);

    /// Another way to shade, kept to be measured against: run-time filtered importance sampling with so many
    /// samples; 0: the dominant direction instead of R (shaders/rivals.frag.glsl).
    void draw_rival(const Scene& scene, RenderTarget& target, int samples);

    /// One slice of the reference picture: the points uploaded last, through a picture moved by jitter_px.
    /// Reference (reference.h) puts the slices together.
    struct ReferenceSlice {
        int replicate = 0;
        int points = 1;
        float weight = 1.0f;        ///< 0…1, what this slice counts in the sum
        glm::ivec2 rows{0, 1};      ///< of the picture, from the bottom: from, to
        glm::vec2 jitter_px{0.0f};  ///< −½…½
    };
    void draw_reference(const Scene& scene, ReferenceTarget& target, const ReferenceSlice& slice);
    /// Before the first of them: what the pixels reflect of the light's cells, and what is behind the mesh.
    void prepare_reference(const Scene& scene, ReferenceTarget& target);
    /// The display picture of what the target's radiance holds.
    void show(const View& view, const RenderTarget& target);

    /// Compiles what is not compiled yet: the first picture of a new kind of material then does not stutter.
    void prepare(const Scene& scene);

    /// GL texture name of the 8-bit display picture (for the interface), valid while the target lives. Origin
    /// bottom-left.
    static std::uintptr_t display_texture(const RenderTarget& target);
    static glm::ivec2 size_px(const RenderTarget& target);
    /// 3-channel U8 display picture, and 3-channel F32 scene-linear radiance (exposure applied), row 0 at the
    /// top.
    Image read_display(const RenderTarget& target);
    Image read_radiance(const RenderTarget& target);
    /// Of one pixel, (0,0) the upper left one; display in 0…255.
    struct PixelValue {
        glm::vec3 radiance{0.0f};
        glm::ivec3 display{0};
    };
    PixelValue read_pixel(const RenderTarget& target, glm::ivec2 pixel);

    /// An 8-bit picture as a texture for the interface (thumbnails); released with the handle.
    MapHandle upload_thumbnail(const Image& image);
    static std::uintptr_t texture_of(const GpuMap& map);
    /// One sentence where the driver had no memory for all of it; else empty.
    static const std::string& note_of(const GpuMap& map);
    /// What its MapLevels said.
    static const ChannelRanges& ranges_of(const GpuMap& map);
    static MapRanges ranges_of(const Scene& scene);

    /// What was done for pictures drawn with this renderer; whoever loads or bakes for it adds to it.
    WorkLedger& work();

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace patina
