#include "ui/photo_overlay.h"

#include "renderer/core/format.h"
#include "renderer/core/photo.h"
#include "ui/ab_parts.h"
#include "ui/icons.h"
#include "ui/values.h"
#include "ui/widgets.h"
#include "ui/workspace.h"

#include <glm/common.hpp>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <string>

namespace patina::ui {
namespace {

constexpr float kHandle = 9.0f;

Photo* photo_of(const PanelContext& context, int view) {
    const std::vector<ViewPlace> places = places_of(*context.sheet);
    if (view < 0 || std::size_t(view) >= places.size()) return nullptr;
    std::optional<Photo>& photo = lighting_at(*context.sheet, places[std::size_t(view)]).photo;
    return photo ? &*photo : nullptr;
}
const SheetCell& cell_of(const PanelContext& context, int view) {
    return context.sheet_cells[std::size_t(view)];
}

/// The square in the view's middle that fractions of a view mean.
Rect square_of(const Rect& rect) {
    const float side = std::min(rect.width(), rect.height());
    const float x = (rect.x0 + rect.x1 - side) / 2, y = (rect.y0 + rect.y1 - side) / 2;
    return {x, y, x + side, y + side};
}
/// Where the whole photo lies, undistorted, in that square.
Rect photo_rect(const PanelContext& context, int view, const Rect& rect) {
    const Rect square = square_of(rect);
    const glm::vec2 size = glm::max(glm::vec2(cell_of(context, view).photo_px), glm::vec2(1.0f));
    const float scale = square.width() / std::max(size.x, size.y);
    const float x = (square.x0 + square.x1 - scale * size.x) / 2,
                y = (square.y0 + square.y1 - scale * size.y) / 2;
    return {x, y, x + scale * size.x, y + scale * size.y};
}
glm::vec2 fraction_in(const Rect& rect, const ImVec2& at) {
    return {(at.x - rect.x0) / rect.width(), (at.y - rect.y0) / rect.height()};
}
ImVec2 point_in(const Rect& rect, glm::vec2 fraction) {
    return {rect.x0 + fraction.x * rect.width(), rect.y0 + fraction.y * rect.height()};
}

bool points_into_photo(PhotoTool tool) {
    return tool == PhotoTool::Fit || tool == PhotoTool::GreyCard || tool == PhotoTool::WhitePaper;
}

void add_image(TextureId texture, const Rect& rect, float opacity) {
    ImGui::GetWindowDrawList()->AddImage(std::bit_cast<ImTextureID>(texture), {rect.x0, rect.y0},
                                         {rect.x1, rect.y1}, {0, 0}, {1, 1},
                                         IM_COL32(255, 255, 255, int(std::lround(opacity * 255.0f))));
}

void draw_points(const PhotoFit& fit, const Rect& in) {
    ImDrawList* draw = ImGui::GetWindowDrawList();
    std::array<ImVec2, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) corners[i] = point_in(in, fit.photo[i]);
    draw->AddPolyline(corners.data(), 4, color::kAccent, ImDrawFlags_Closed, px(1.5f));
    for (std::size_t i = 0; i < 4; ++i) {
        draw->AddCircle(corners[i], px(kHandle), IM_COL32(0, 0, 0, 200), 24, px(3));
        draw->AddCircle(corners[i], px(kHandle), color::kAccent, 24, px(1.5f));
        draw->AddCircleFilled(corners[i], px(1.5f), color::kAccent);
    }
}

struct ToolRow {
    PhotoTool tool;
    const char *name, *text, *tooltip, *hint;
};
constexpr std::array kTools{
    ToolRow{PhotoTool::Fit, "compare.photo.fit", "Fit four points",
            "Drag four points onto the corners of the sample in the photo; they are brought to the render's "
            "corners.",
            "Drag the points onto the sample's corners, upper left first, clockwise"},
    ToolRow{PhotoTool::GreyCard, "compare.photo.grey", "Grey card",
            "Click an 18 % grey card in the photo: exposure and white balance follow.",
            "Click the grey card"},
    ToolRow{PhotoTool::WhitePaper, "compare.photo.white", "White paper",
            "Click white paper in the photo: exposure and white balance follow.", "Click the white paper"},
    ToolRow{PhotoTool::Region, "compare.photo.region", "Region",
            "Draw a rectangle on the view: only what lies in it is compared.",
            "Draw the rectangle to compare"},
};

void take_tool(PanelContext& context, Photo& photo, PhotoTool tool) {
    UiState& ui = context.ui;
    ui.photo_tool = ui.photo_tool == tool ? PhotoTool::None : tool;
    if (ui.photo_tool == PhotoTool::Fit && !photo.fit)
        photo.fit =
            first_fit(context.mesh == "quad", context.camera, cell_of(context, ui.sheet_selected).photo_px);
}

/// Takes back what the tool in use has set.
void draw_undoing(PanelContext& context, Photo& photo, float width) {
    UiState& ui = context.ui;
    if (ui.photo_tool == PhotoTool::Fit && photo.fit &&
        button(context, "compare.photo.unfit", "Remove the points",
               "The whole photo stands in the middle of the view again.", {.width = width})) {
        photo.fit.reset();
        ui.photo_tool = PhotoTool::None;
    }
    if (ui.photo_tool == PhotoTool::Region && photo.region &&
        button(context, "compare.photo.whole", "Remove the rectangle",
               "All that the photo covers is compared.", {.width = width})) {
        photo.region.reset();
        ui.photo_tool = PhotoTool::None;
    }
}

}  // namespace

bool photo_tool_active(const PanelContext& context, int view) {
    return context.ui.photo_tool != PhotoTool::None && context.ui.sheet_selected == view &&
           photo_of(context, view);
}

void use_photo_tool(PanelContext& context, int view, const Rect& rect) {
    Photo* photo = photo_of(context, view);
    if (!photo_tool_active(context, view) || context.ui.photo_tool != PhotoTool::Fit || !photo->fit) return;
    const Rect in = photo_rect(context, view, rect);
    for (std::size_t i = 0; i < 4; ++i) {
        const ImVec2 at = point_in(in, photo->fit->photo[i]);
        const float radius = px(kHandle);
        ImGui::PushID(int(i));
        ImGui::SetCursorScreenPos({at.x - radius, at.y - radius});
        ImGui::InvisibleButton("##point", {2 * radius, 2 * radius});
        record(context, "sheet.point." + std::to_string(i + 1));
        if (ImGui::IsItemActive()) {
            const ImVec2 moved = ImGui::GetIO().MouseDelta;
            photo->fit->photo[i] = glm::clamp(fraction_in(in, {at.x + moved.x, at.y + moved.y}),
                                              glm::vec2(-1.0f), glm::vec2(2.0f));
            context.ui.photo_held = true;
        }
        ImGui::PopID();
    }
}

void handle_photo_mouse(PanelContext& context, int view, const Rect& rect) {
    Photo& photo = *photo_of(context, view);
    UiState& ui = context.ui;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (ui.photo_tool == PhotoTool::Region) {
        const glm::vec2 at = glm::clamp(fraction_in(square_of(rect), mouse), -1.0f, 2.0f);
        if (ImGui::IsItemActivated()) ui.region_from = at;
        if (ImGui::IsItemActive()) {
            const glm::vec2 low = glm::min(at, ui.region_from), high = glm::max(at, ui.region_from);
            ui.photo_held = true;
            if (high.x - low.x > 0.01f && high.y - low.y > 0.01f)
                photo.region = Region{low.x, low.y, high.x, high.y};
        }
        if (ImGui::IsItemDeactivated()) ui.photo_tool = PhotoTool::None;
    } else if (ImGui::IsItemClicked() && points_into_photo(ui.photo_tool) &&
               ui.photo_tool != PhotoTool::Fit) {
        context.requests.push_back(request::PickCard{view,
                                                     fraction_in(photo_rect(context, view, rect), mouse),
                                                     ui.photo_tool == PhotoTool::WhitePaper});
        ui.photo_tool = PhotoTool::None;
    }
}

namespace {

TextureId difference_of(const SheetCell& cell, PhotoLayer layer) {
    return layer == PhotoLayer::DeltaE ? cell.heat : layer == PhotoLayer::Luminance ? cell.luminance : 0;
}

/// Where the view has room for it.
void draw_layer_legend(PanelContext& context, const Rect& rect) {
    if (rect.width() < px(320)) return;
    const bool heat = context.ui.photo_layer == PhotoLayer::DeltaE;
    const RampLegend legend =
        heat ? RampLegend{"sheet.legend.delta_e", "ΔE 0", formatted("≥ %.0f", double(kHeatWhite)), heat_color}
             : RampLegend{"sheet.legend.luminance", "render darker", "brighter than the photo",
                          diverging_color};
    ImGui::PushFont(font_of(Face::Small));
    draw_ramp_legend(context, legend, rect.x0 + px(10), rect.y1 - px(10));
    ImGui::PopFont();
}

}  // namespace

void draw_photo(PanelContext& context, int view, const Rect& rect) {
    const Photo* photo = photo_of(context, view);
    if (!photo) return;
    const SheetCell& cell = cell_of(context, view);
    const UiState& ui = context.ui;
    ImDrawList* draw = ImGui::GetWindowDrawList();
    if (photo_tool_active(context, view) && points_into_photo(ui.photo_tool)) {
        const Rect in = photo_rect(context, view, rect);
        draw->AddRectFilled({rect.x0, rect.y0}, {rect.x1, rect.y1}, color::kSurround);
        if (cell.photo_raw) add_image(cell.photo_raw, in, 1.0f);
        if (ui.photo_tool == PhotoTool::Fit && photo->fit) draw_points(*photo->fit, in);
        return;
    }
    const float split = rect.x0 + ui.photo_wipe * rect.width();
    draw->PushClipRect({split, rect.y0}, {rect.x1, rect.y1}, true);
    const TextureId difference = difference_of(cell, ui.photo_layer);
    if (difference)
        add_image(difference, rect, 1.0f);
    else if (cell.photo)
        add_image(cell.photo, rect, photo->opacity);
    draw->PopClipRect();
    if (ui.photo_wipe > 0.0f && ui.photo_wipe < 1.0f)
        draw->AddLine({split, rect.y0}, {split, rect.y1}, color::kAccent, px(1.5f));
    if (difference) draw_layer_legend(context, rect);
    if (photo->region) {
        const Rect square = square_of(rect);
        draw->AddRect(point_in(square, {photo->region->x0, photo->region->y0}),
                      point_in(square, {photo->region->x1, photo->region->y1}), color::kAccent);
    }
}

namespace {

void draw_photo_choice(PanelContext& context, float full) {
    text_wrapped(
        "Put a photo of the real thing, taken under this light, beside the render: choose it here, "
        "or drop it on the view.",
        color::kMuted, Face::Small);
    if (button(context, "compare.photo.choose", "Choose a photo…",
               "PNG, JPEG, TIFF or EXR; the camera's data is read.", {.width = full}))
        open_browser(context, BrowserPurpose::ChoosePhoto);
}

void draw_photo_numbers(PanelContext& context, Photo& photo) {
    number_row(context,
               {.name = "compare.photo.opacity",
                .label = "Opacity",
                .tooltip = "Of the photo over the render.",
                .reset = 1.0f,
                .saved = 1.0f,
                .format = "%.2f",
                .step = 0.01f},
               photo.opacity);
    number_row(context,
               {.name = "compare.photo.wipe",
                .label = "Wipe",
                .tooltip = "Left of the line the render is seen, right of it the photo.",
                .reset = 0.0f,
                .saved = 0.0f,
                .format = "%.2f",
                .step = 0.01f},
               context.ui.photo_wipe);
    number_row(context,
               {.name = "compare.photo.exposure",
                .label = "Exposure",
                .tooltip = "Of the photo, in stops; a grey card sets it.",
                .min = -6.0f,
                .max = 6.0f,
                .hard_min = -30.0f,
                .hard_max = 30.0f,
                .saved = photo.exposure_ev,
                .format = "%+.2f",
                .step = 0.05f},
               photo.exposure_ev);
}

void draw_photo_tools(PanelContext& context, Photo& photo, float full) {
    const float half = (full - ImGui::GetStyle().ItemSpacing.x) / 2;
    for (std::size_t i = 0; i < kTools.size(); ++i) {
        if (i % 2 == 1) ImGui::SameLine();
        const ToolRow& row = kTools[i];
        const bool on = context.ui.photo_tool == row.tool;
        if (button(context, row.name, on ? "Done" : row.text, row.tooltip,
                   {.emphasis = on ? Emphasis::Primary : Emphasis::Normal, .width = half}))
            take_tool(context, photo, row.tool);
    }
    for (const ToolRow& row : kTools)
        if (row.tool == context.ui.photo_tool) text_wrapped(row.hint, color::kAccent, Face::Small);
}

}  // namespace

void draw_photo_rows(PanelContext& context, int view) {
    heading("Photo");
    const float full = ImGui::GetContentRegionAvail().x;
    Photo* photo = photo_of(context, view);
    if (!photo) {
        draw_photo_choice(context, full);
        return;
    }
    const SheetCell& cell = cell_of(context, view);
    text_line(context, std::string(file_name_of(photo->file)));
    if (!cell.photo_about.empty()) text_line(context, cell.photo_about, color::kMuted);
    if (!cell.residual.empty()) text_line(context, cell.residual, color::kAccent);
    if (cell.hints)
        for (const std::string& hint : *cell.hints) text_wrapped(hint, color::kText, Face::Small);
    draw_photo_numbers(context, *photo);
    draw_photo_tools(context, *photo, full);
    draw_undoing(context, *photo, full);
    static constexpr std::array layers{
        Option{"Photo", "The photo, as opaque as set above."},
        Option{"ΔE", "CIEDE2000 in colours: black is equal, white is 20 and more, grey is not compared."},
        Option{"Luminance",
               "Where the render is darker (blue) or brighter (red) than the photo, up to the "
               "photo's mean luminance."}};
    int layer = int(context.ui.photo_layer);
    if (segmented(context, "compare.photo.layer", layers, layer)) context.ui.photo_layer = PhotoLayer(layer);
    if (button(context, "compare.photo.remove", "Remove the photo", "The file stays.", {.width = full})) {
        context.ui.photo_tool = PhotoTool::None;
        context.requests.push_back(request::ChangeSheet{request::SheetChange::RemovePhoto, view});
    }
}

}  // namespace patina::ui
