// A slice of the reference picture: the mesh is rasterised once, moved within the pixel, and what lies there
// is shaded densely, a few rows after the other: software renderers shade the edges of small triangles
// several times over.
#include "renderer/gl/reference.h"
#include "renderer/renderer_state.h"

#include <limits>

namespace patina {

Features Renderer::State::begin_reference(const Scene& scene, const GpuEnvironment& environment,
                                          ReferenceTarget& target, const ReferenceSlice& slice) {
    View view = scene.view;
    view.debug = DebugView::Final;
    const Features features = reference_features(features_for(scene, environment));
    auto frame = make_frame_block(scene.camera, view, target.size, layout_of(environment),
                                  std::numeric_limits<float>::max());
    move_picture(frame, slice.jitter_px, target.size);
    const float exposure = frame.camera_position.w;
    set_switches();
    if (slice.rows.x == 0) gl::begin_reference_surface(target, layers_for(features & kSurface));
    if (scene.mesh && slice.rows.x == 0)
        rasterise(scene, frame, features & kSurface);
    else
        upload_block(frame_rows, gl::kFrameSlot, frame);
    upload_block(material_rows, gl::kMaterialSlot, make_material_block(scene.material, features, exposure));
    bind_light(environment);
    return features;
}

void Renderer::State::prepare_reference(const Scene& scene, const GpuEnvironment& environment,
                                        ReferenceTarget& target) {
    const Features features = begin_reference(scene, environment, target, {.rows = {0, target.size.y}});
    gl::begin_reference_cells(target);
    if (scene.mesh) {
        gl::draw_all(cells_of(features).name(), nothing.name(), {0, 0, target.size});
        count_draw(1);
    }
    if (scene.view.background != Background::Plain) {
        gl::begin_reference_background(target);
        draw_background(scene.view.background);
        count_draw(1);
    }
    gl::end_reference_slice();
}

void Renderer::State::draw_reference(const Scene& scene, const GpuEnvironment& environment,
                                     ReferenceTarget& target, const ReferenceSlice& slice) {
    const Features features = begin_reference(scene, environment, target, slice);
    gl::begin_reference_slice(target, slice.replicate, slice.weight, slice.rows);
    if (scene.mesh) {
        const gl::Program& program = reference(features);
        glUseProgram(program.name());
        glUniform1i(glGetUniformLocation(program.name(), "reference_points"), slice.points);
        gl::draw_all(program.name(), nothing.name(), {0, 0, target.size});
        count_draw(1);
    }
    work.reference_points += std::uint64_t(slice.points);
    gl::end_reference_slice();
}

}  // namespace patina
