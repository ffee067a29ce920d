// The inspector's page that makes maps from a photo: one node under the other, each with what it makes of the
// one above and with its own values.
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/values.h"
#include "ui/widgets.h"
#include "ui/workspace.h"

#include <glm/common.hpp>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>

namespace patina::ui {
namespace {

constexpr float kPreview = 104.0f, kHandle = 8.0f;

/// The rail that ties a node to the one above it, its preview, its title and what it does. use: whether the
/// map is wanted; nullptr: no map by itself.
struct Node {
    const char* name;
    const char* title;
    const char* text;
    TextureId preview = 0;
    bool* use = nullptr;
};
void draw_node(PanelContext& context, const Node& node) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float side = px(kPreview), rail = px(8);
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const float x = at.x + rail + side / 2;
    draw->AddLine({x, at.y}, {x, at.y + rail}, color::kAccentDim, px(2));
    const Rect picture{at.x + rail, at.y + rail, at.x + rail + side, at.y + rail + side};
    draw_thumbnail(picture, node.preview, icon::kImage);
    record_rect(context, std::string("maps.preview.") + node.name, picture);
    const float left = picture.x1 + px(12);
    ImGui::SetCursorScreenPos({left, picture.y0});
    ImGui::BeginGroup();
    if (node.use) {
        checkbox(context, std::string("maps.use.") + node.name, node.title, "Make this map and use it.",
                 *node.use);
    } else {
        ImGui::PushFont(font_of(Face::Strong));
        text_line(context, node.title);
        ImGui::PopFont();
    }
    text_wrapped(node.text, color::kMuted, Face::Small);
    ImGui::EndGroup();
    ImGui::SetCursorScreenPos({at.x, std::max(ImGui::GetCursorScreenPos().y, picture.y1 + px(6))});
}

struct Slider {
    NumberRow row;
    float MapSettings::*member;
};
void draw_slider(PanelContext& context, const Slider& slider) {
    static const MapSettings defaults;
    NumberRow row = slider.row;
    float& value = context.ui.maps.settings.*slider.member;
    row.reset = defaults.*slider.member;
    row.saved = value;
    row.hard_min = row.min;
    row.hard_max = row.max;
    number_row(context, row, value);
}

// ---- the photo ----

/// Where the photo lies, as wide as the page.
Rect photo_place(const PanelContext& context) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const glm::vec2 size = glm::max(glm::vec2(context.maps_status.photo_px), glm::vec2(1.0f));
    const float scale = std::min(width / size.x, px(320) / size.y);
    const float left = at.x + (width - scale * size.x) / 2;
    return {left, at.y, left + scale * size.x, at.y + scale * size.y};
}

void drag_corners(PanelContext& context, const Rect& rect) {
    PhotoToMaps& maps = context.ui.maps;
    ImDrawList* draw = ImGui::GetWindowDrawList();
    std::array<ImVec2, 4> points;
    for (std::size_t i = 0; i < 4; ++i) {
        glm::vec2& corner = maps.settings.corners[i];
        points[i] = {rect.x0 + corner.x * rect.width(), rect.y0 + corner.y * rect.height()};
        ImGui::SetCursorScreenPos({points[i].x - px(kHandle), points[i].y - px(kHandle)});
        ImGui::PushID(int(i));
        ImGui::InvisibleButton("##corner", {px(2 * kHandle), px(2 * kHandle)});
        ImGui::PopID();
        record(context, "maps.corner." + std::to_string(i + 1));
        if (!ImGui::IsItemActive()) continue;
        maps.held = true;
        const ImVec2 moved = ImGui::GetIO().MouseDelta;
        corner = glm::clamp(corner + glm::vec2(moved.x / rect.width(), moved.y / rect.height()), 0.0f, 1.0f);
    }
    draw->AddPolyline(points.data(), 4, color::kAccent, ImDrawFlags_Closed, px(1.5f));
    for (const ImVec2& point : points) {
        draw->AddCircle(point, px(kHandle), IM_COL32(0, 0, 0, 200), 24, px(3));
        draw->AddCircle(point, px(kHandle), color::kAccent, 24, px(1.5f));
    }
}

void draw_photo_with_corners(PanelContext& context) {
    PhotoToMaps& maps = context.ui.maps;
    if (!context.maps_status.photo) return text_line(context, "Loading…", color::kMuted);
    const Rect rect = photo_place(context);
    ImGui::GetWindowDrawList()->AddImage(std::bit_cast<ImTextureID>(context.maps_status.photo),
                                         {rect.x0, rect.y0}, {rect.x1, rect.y1});
    if (maps.picking_card) {
        ImGui::SetCursorScreenPos({rect.x0, rect.y0});
        ImGui::InvisibleButton("##card", {std::max(rect.width(), 1.0f), std::max(rect.height(), 1.0f)});
        record(context, "maps.photo");
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        if (ImGui::IsItemClicked()) {
            context.requests.push_back(request::PickMapCard{
                {(mouse.x - rect.x0) / rect.width(), (mouse.y - rect.y0) / rect.height()}});
            maps.picking_card = false;
        }
    } else {
        drag_corners(context, rect);
    }
    ImGui::SetCursorScreenPos({ImGui::GetWindowPos().x + ImGui::GetStyle().WindowPadding.x, rect.y1 + px(8)});
}

void draw_photo_choice(PanelContext& context) {
    PhotoToMaps& maps = context.ui.maps;
    const float full = ImGui::GetContentRegionAvail().x;
    const float half = (full - ImGui::GetStyle().ItemSpacing.x) / 2;
    heading("Photo of a flat sample");
    if (!maps.photo.empty()) {
        text_line(context, std::string(file_name_of(maps.photo)));
        draw_photo_with_corners(context);
        text_wrapped(maps.picking_card ? "Click the 18 % grey card."
                                       : "Drag the corners onto the sample: upper left, upper right, lower "
                                         "right, lower left.",
                     maps.picking_card ? color::kAccent : color::kMuted, Face::Small);
    } else {
        text_wrapped("Even light and a straight view help; the rest is done here.", color::kMuted,
                     Face::Small);
    }
    if (button(context, "maps.choose", "Choose a photo…", "PNG, JPEG, TIFF or EXR.", {.width = half}))
        open_browser(context, BrowserPurpose::ChooseMapPhoto);
    ImGui::SameLine();
    if (maps.photo.empty() || context.maps_status.view_photo) {
        if (button(context, "maps.from_view", "From the view",
                   "The photo of the comparison's selected view, with its four points and its balance.",
                   {.width = half, .enabled = context.maps_status.view_photo}))
            context.requests.push_back(request::MapPhotoOfView{});
    } else if (button(context, "maps.card", maps.picking_card ? "Done" : "Grey card",
                      "Click an 18 % grey card in the photo: how much light there was, and of which colour.",
                      {.width = half})) {
        maps.picking_card = !maps.picking_card;
    }
}

// ---- the nodes ----

void draw_straight(PanelContext& context) {
    MapSettings& settings = context.ui.maps.settings;
    static constexpr std::array sizes{512, 1024, 2048, 4096};
    std::array<std::string, sizes.size()> titles;
    std::array<Option, sizes.size()> options;
    int index = 1;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        titles[i] = std::to_string(sizes[i]);
        options[i] = {titles[i], "Pixels a side of the maps."};
        if (settings.size_px.x == sizes[i]) index = int(i);
    }
    draw_node(context, {"rectified", "Straight", "The sample as seen from straight above.",
                        context.maps_status.rectified});
    if (segmented(context, "maps.size", options, index))
        settings.size_px = glm::ivec2(sizes[std::size_t(index)]);
}

void draw_even(PanelContext& context) {
    MapSettings& settings = context.ui.maps.settings;
    draw_node(context, {"even", "Even light",
                        "The lamp's gradient is taken out, as freely as set: 0 leaves it, 4 follows most.",
                        context.maps_status.even});
    float degree = float(settings.even_degree);
    if (number_row(
            context,
            {.name = "maps.even",
             .label = "Follow light",
             .tooltip = "Degree of the polynomial that stands for the light. What of the surface changes "
                        "as smoothly goes with it.",
             .max = 4.0f,
             .hard_max = 4.0f,
             .reset = 3.0f,
             .saved = degree,
             .format = "%.0f",
             .step = 1.0f},
            degree))
        settings.even_degree = std::clamp(int(std::lround(degree)), 0, 4);
    checkbox(context, "maps.tile", "Grow the borders together",
             "The maps then repeat without a seam; a fifth of the sample goes into that.", settings.tileable);
}

void draw_height(PanelContext& context) {
    MapSettings& settings = context.ui.maps.settings;
    draw_node(context,
              {"height", "Height", "Told from light and dark; saved with 16 bits beside the normal map.",
               context.maps_status.height});
    int from = index_of(kReliefs, settings.relief_from);
    if (segmented(context, "maps.relief", options_of(kReliefs), from))
        settings.relief_from = kReliefs[std::size_t(from)].value;
    if (settings.relief_from == ReliefFrom::Light) {
        draw_slider(context, {{.name = "maps.azimuth",
                               .label = "Lamp at",
                               .tooltip = "Where the lamp stood: 0° right of the sample, 90° above it.",
                               .min = -180.0f,
                               .max = 180.0f,
                               .format = "%.0f°",
                               .step = 1.0f,
                               .wraps = true},
                              &MapSettings::light_azimuth_deg});
        draw_slider(context, {{.name = "maps.elevation",
                               .label = "Lamp over",
                               .tooltip = "How steeply its light fell: 90° is straight from above.",
                               .min = 5.0f,
                               .max = 85.0f,
                               .format = "%.0f°",
                               .step = 1.0f},
                              &MapSettings::light_elevation_deg});
    }
    draw_slider(context, {{.name = "maps.scale",
                           .label = "Largest form",
                           .tooltip = "In widths of the map; larger light and dark is taken for colour.",
                           .min = 0.002f,
                           .max = 1.0f,
                           .logarithmic = true},
                          &MapSettings::relief_scale});
    draw_slider(context, {{.name = "maps.strength",
                           .label = "Strength",
                           .tooltip = "Of height and normals.",
                           .max = 10.0f,
                           .format = "%.2f",
                           .step = 0.01f},
                          &MapSettings::relief_strength});
}

void draw_surface(PanelContext& context) {
    PhotoToMaps& maps = context.ui.maps;
    const MapsStatus& status = context.maps_status;
    draw_node(context, {"albedo", "Albedo", "What is left when the light is taken out.", status.albedo,
                        &maps.choice.albedo});
    draw_slider(context, {{.name = "maps.shading",
                           .label = "Remove shading",
                           .tooltip = "Of small forms: their light and dark is then in the height alone."},
                          &MapSettings::shading_removed});
    draw_height(context);
    draw_node(context,
              {"normal", "Normals", "From the height; +Y up, 16 bits.", status.normal, &maps.choice.normal});
    draw_node(context, {"roughness", "Roughness",
                        "An estimate: fine grain scatters, spots much brighter than all around shine.",
                        status.roughness, &maps.choice.roughness});
    draw_slider(context, {{.name = "maps.roughness", .label = "Middle", .tooltip = "Roughness on average."},
                          &MapSettings::roughness});
    draw_slider(context, {{.name = "maps.contrast", .label = "Contrast", .tooltip = "How far it varies."},
                          &MapSettings::roughness_contrast});
    draw_node(context,
              {"ao", "Occlusion", "How much sky each place of the height sees.", status.ao, &maps.choice.ao});
    draw_slider(context, {{.name = "maps.ao_strength",
                           .label = "Strength",
                           .tooltip = "How much deeper the height counts.",
                           .max = 4.0f,
                           .format = "%.2f",
                           .step = 0.01f},
                          &MapSettings::ao_strength});
    draw_slider(context, {{.name = "maps.ao_radius",
                           .label = "Reach",
                           .tooltip = "How far something darkens, in widths of the map.",
                           .min = 0.002f,
                           .max = 0.5f,
                           .logarithmic = true},
                          &MapSettings::ao_radius});
}

void draw_make(PanelContext& context) {
    PhotoToMaps& maps = context.ui.maps;
    heading("Make");
    for (const std::string& note : context.maps_status.notes)
        text_wrapped(note, color::kWarning, Face::Small);
    text_row(context,
             {.name = "maps.name",
              .label = "Name of the files",
              .tooltip = "What they are called; a number is added where they exist already."},
             maps.name);
    if (button(
            context, "maps.make", "Make the maps and use them",
            "Writes the maps beside the preset and puts them into their slots. Ctrl+Z takes them out again; "
            "the files stay.",
            {.emphasis = Emphasis::Primary,
             .width = ImGui::GetContentRegionAvail().x,
             .enabled = !context.maps_status.making && context.maps_status.albedo != 0}))
        context.requests.push_back(request::MakeMaps{});
}

}  // namespace

void draw_maps_panel(PanelContext& context) {
    context.ui.maps.held = false;
    draw_photo_choice(context);
    if (!context.maps_status.error.empty())
        text_wrapped(context.maps_status.error, color::kError, Face::Small);
    if (context.ui.maps.photo.empty()) return;
    draw_straight(context);
    draw_even(context);
    draw_surface(context);
    draw_make(context);
}

}  // namespace patina::ui
