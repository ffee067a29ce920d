// Draws a material on a mesh under baked light. Needs a current OpenGL 4.1 core context; knows no window, no
// file, no thread.
//
// Nothing is kept between draws but what upload_* returned: N views share meshes, maps and light by passing
// the same handles.
#pragma once

#include "materials/material.h"
#include "renderer/core/camera.h"
#include "renderer/core/environment.h"
#include "renderer/core/image.h"
#include "renderer/core/mesh.h"
#include "renderer/core/view.h"
#include "renderer/gl/panorama.h"
#include "renderer/ibl/bake.h"
#include "renderer/map_levels.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
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
};

/// Where a picture is drawn: linear radiance and the display picture (8-bit sRGB-encoded).
struct RenderTarget;
using TargetHandle = std::shared_ptr<RenderTarget>;
/// How radiance is kept: half floats end at 65504 and are what a screen needs, full floats are for measuring
/// and saving.
enum class TargetPrecision { Half, Full };

/// A large map on its way to the GPU, a portion a frame, so that the window does not stall.
class MapUpload {
public:
    explicit MapUpload(MapLevels levels);
    ~MapUpload();
    MapUpload(const MapUpload&) = delete;
    MapUpload& operator=(const MapUpload&) = delete;
    MapUpload(MapUpload&&) noexcept;
    MapUpload& operator=(MapUpload&&) noexcept;

    /// Copies about byte_budget bytes; true when all is there.
    bool step(std::size_t byte_budget);
    float fraction() const;  ///< 0…1
    /// Copies what is left and hands the map over; call once.
    MapHandle finish();

private:
    struct State;
    std::unique_ptr<State> state_;
};

class Renderer {
public:
    /// Throws std::runtime_error when the context is older than 4.1 or a shader does not compile.
    Renderer();
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    EnvironmentHandle upload_environment(const Environment& environment, const BakedEnvironment& baked);
    /// The same with the panorama's mip chain made beforehand, on a worker: what is left takes milliseconds.
    EnvironmentHandle upload_environment(const PanoramaLevels& panorama, const BakedEnvironment& baked);
    MeshHandle upload_mesh(const Mesh& mesh);
    MapHandle upload_map(const MapLevels& levels);  ///< all at once; MapUpload spreads it over frames

    /// samples: MSAA, clamped to what the driver offers; size ≥ 1×1.
    TargetHandle make_target(glm::ivec2 size_px, int samples = 4,
                             TargetPrecision precision = TargetPrecision::Half);
    /// Without an environment only emission and a plain background are seen, without a mesh only the
    /// background. The plain background is shown as it is: neither exposure nor tone mapping touch it.
    void draw(const Scene& scene, RenderTarget& target);

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

    /// An 8-bit picture as a texture for the interface (thumbnails); released with the handle.
    MapHandle upload_thumbnail(const Image& image);
    static std::uintptr_t texture_of(const GpuMap& map);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace patina
