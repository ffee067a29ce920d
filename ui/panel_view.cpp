// The inspector's view page: shading, tone mapping, camera, and what is known of the mesh.
#include "renderer/core/view.h"
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/shortcuts.h"
#include "ui/values.h"
#include "ui/widgets.h"

#include <imgui.h>

#include <array>
#include <string>

namespace patina::ui {
namespace {

template <class T, std::size_t n>
void choice_row(PanelContext& context, RowLabel label, const std::array<Named<T>, n>& table, T& value,
                T saved) {
    label.changed = value != saved;
    label.at_default = !label.changed;
    apply_label(row_label(context, label), saved, saved, value);
    const auto options = options_of(table);
    int index = index_of(table, value);
    if (combo(context, label.name, options, index, {.tooltip = label.tooltip}))
        value = table[static_cast<std::size_t>(index)].value;
}

struct CameraRow {
    float Camera::*member;
    NumberRow row;
};
constexpr std::array kCameraRows{
    CameraRow{&Camera::yaw_deg,
              {.name = "view.yaw",
               .label = "Around",
               .tooltip = "Where the camera stands around the object, in degrees from the front.",
               .min = -180.0f,
               .max = 180.0f,
               .hard_min = -180.0f,
               .hard_max = 180.0f,
               .format = "%.1f°",
               .step = 0.1f,
               .wraps = true}},
    CameraRow{&Camera::pitch_deg,
              {.name = "view.pitch",
               .label = "Above",
               .tooltip = "How far the camera looks down on the object, in degrees.",
               .min = -89.9f,
               .max = 89.9f,
               .hard_min = -89.9f,
               .hard_max = 89.9f,
               .format = "%.1f°",
               .step = 0.1f}},
    CameraRow{&Camera::distance,
              {.name = "view.distance",
               .label = "Distance",
               .tooltip = "From the object's centre, in radii of the object.",
               .min = 1.2f,
               .max = 20.0f,
               .hard_min = 0.1f,
               .hard_max = 100.0f,
               .format = "%.2f",
               .logarithmic = true}},
    CameraRow{&Camera::fov_deg,
              {.name = "view.fov",
               .label = "Field of view",
               .tooltip = "Vertical opening angle: small flattens like a long lens, large exaggerates depth.",
               .min = 10.0f,
               .max = 90.0f,
               .hard_min = 1.0f,
               .hard_max = 150.0f,
               .format = "%.1f°",
               .step = 0.5f}},
};

void draw_camera(PanelContext& context) {
    heading("Camera");
    for (const CameraRow& camera_row : kCameraRows) {
        NumberRow row = camera_row.row;
        float& value = context.camera.*camera_row.member;
        row.reset = context.home_camera.*camera_row.member;
        row.saved = value;  // moving the camera is no change of the document worth a mark
        number_row(context, row, value);
    }
    if (button(context, "view.reset", "Reset the view",
               "Back to the first view; so does a double-click on the picture.",
               {.width = ImGui::GetContentRegionAvail().x, .enabled = context.camera != context.home_camera}))
        act(context, Action::Home);
}

void draw_mesh(PanelContext& context) {
    const MeshInfo& info = context.mesh_info;
    if (info.triangles == 0) return;
    heading("Mesh");
    text_line(context, info.title.empty() ? std::string(file_name_of(context.mesh)) : info.title);
    text_line(
        context,
        std::to_string(info.triangles) + " triangles   ·   " + std::to_string(info.vertices) + " vertices",
        color::kMuted);
    if (!info.has_uvs)
        text_wrapped("The file has no texture coordinates; they were projected.", color::kWarning,
                     Face::Small);
    for (const std::string& note : info.notes) text_wrapped(note, color::kMuted, Face::Small);
}

}  // namespace

void draw_view_panel(PanelContext& context) {
    View& view = context.view;
    const View& saved = context.saved_view;
    heading("Picture");
    choice_row(context,
               {.name = "view.shading", .text = "Shading", .tooltip = "Which formulas shade the picture."},
               kShadings, view.shading, saved.shading);
    if (view.shading == Shading::Fitted)
        choice_row(context,
                   {.name = "view.quality",
                    .text = "Quality",
                    .tooltip = "How closely fitted lobes follow the full integral."},
                   kQualities, view.quality, saved.quality);
    choice_row(context,
               {.name = "view.tonemap",
                .text = "Tone mapping",
                .tooltip = "How the light's unbounded range is brought onto the screen."},
               kTonemaps, view.tonemap, saved.tonemap);
    choice_row(
        context,
        {.name = "view.debug", .text = "Show", .tooltip = "The final picture, or one ingredient of it."},
        kDebugViews, view.debug, saved.debug);
    draw_camera(context);
    draw_mesh(context);
}

}  // namespace patina::ui
