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
#include "renderer/ibl/bake.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <string>

namespace patina {

/// A map with its mip chain, ready to upload: made on a worker by make_map_levels, values as the shader
/// samples them.
struct MapLevels {
    std::vector<Image> levels;  ///< [0] full size; U8 (1, 2, 3→4 channels), U16 or F32
    bool srgb = false;          ///< sample through an sRGB texture format
};
enum class MapKind { Color, Data, Normal };
/// Mipmaps filtered in linear light (Color with srgb), as numbers (Data), or renormalised (Normal). Pure; any
/// size.
MapLevels make_map_levels(const Image& image, MapKind kind, ColorSpace color_space);
/// A checkerboard that cannot be mistaken for a picture: stands in for a missing or broken map.
Image make_placeholder_map();

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

/// Where a picture is drawn: linear radiance (half float) and the display picture (8-bit sRGB-encoded).
struct RenderTarget;
using TargetHandle = std::shared_ptr<RenderTarget>;

class Renderer {
public:
    /// Throws std::runtime_error when the context is older than 4.1 or a shader does not compile.
    Renderer();
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    EnvironmentHandle upload_environment(const Environment& environment, const BakedEnvironment& baked);
    MeshHandle upload_mesh(const Mesh& mesh);
    MapHandle upload_map(const MapLevels& levels);

    /// samples: MSAA, clamped to what the driver offers; size ≥ 1×1.
    TargetHandle make_target(glm::ivec2 size_px, int samples = 4);
    void draw(const Scene& scene, RenderTarget& target);

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
