// The thin bar above the viewport: what is shown, and how. Its items flow into as many rows as the width asks
// for.
#include "renderer/core/view.h"
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/values.h"
#include "ui/widgets.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace patina::ui {
namespace {

// At scale 1: mesh, shading, view, tone map, exposure.
constexpr std::array kItemWidths{120.0f, 112.0f, 168.0f, 104.0f, 128.0f};
constexpr float kGap = 6.0f, kPadX = 8.0f, kPadY = 5.0f;

template <class T, std::size_t n>
void named_combo(PanelContext& context, std::string_view name, const std::array<Named<T>, n>& table, T& value,
                 const ComboStyle& style) {
    const std::array<Option, n> options = options_of(table);
    int index = index_of(table, value);
    if (combo(context, name, options, index, style)) value = table[static_cast<std::size_t>(index)].value;
}

void mesh_combo(PanelContext& context, float width) {
    std::vector<Option> options;
    int index = -1;
    for (const CatalogItem& item : context.catalog.meshes) {
        if (item.id == context.mesh) index = static_cast<int>(options.size());
        options.push_back({item.title, item.description});
    }
    const std::string own(index < 0 ? file_name_of(context.mesh) : std::string_view{});
    const bool changed = combo(context, "toolbar.mesh", options, index,
                               {.icon = icon::kCube,
                                .width = width,
                                .tooltip = "The shape that wears the material. M takes the next one.",
                                .preview = own});
    if (changed) context.mesh = context.catalog.meshes[static_cast<std::size_t>(index)].id;
}

void exposure_item(PanelContext& context, float width) {
    const float icon_width = px(22);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::Dummy({icon_width, ImGui::GetFrameHeight()});
    ImGui::GetWindowDrawList()->AddText({at.x + px(4), at.y + ImGui::GetStyle().FramePadding.y},
                                        color::kMuted, icon::kExposure);
    ImGui::SameLine(0.0f, 0.0f);
    const NumberRow row{
        .name = "toolbar.exposure",
        .tooltip = "Exposure in stops: +1 doubles the light. Keys . and , change it; a double-click sets 0.",
        .min = -6.0f,
        .max = 6.0f,
        .hard_min = -20.0f,
        .hard_max = 20.0f,
        .saved = context.saved_view.exposure_ev,
        .format = "%+.2f",
        .step = 0.05f,
        .number_width = 46.0f};
    number_value(context, row, context.view.exposure_ev, width - icon_width);
}

}  // namespace

float toolbar_height(float width) {
    float x = px(kPadX);
    int rows = 1;
    for (const float item : kItemWidths) {
        if (x > px(kPadX) && x + px(item) > width - px(kPadX)) {
            x = px(kPadX);
            ++rows;
        }
        x += px(item) + px(kGap);
    }
    const float row = ImGui::GetFrameHeight();
    return 2.0f * px(kPadY) + static_cast<float>(rows) * row + static_cast<float>(rows - 1) * px(kPadY);
}

void draw_toolbar(PanelContext& context, const Rect& rect) {
    begin_region(context, "toolbar", rect, {.padding = {kPadX, kPadY}});
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    float x = 0.0f, y = 0.0f;
    for (std::size_t i = 0; i < kItemWidths.size(); ++i) {
        const float width = px(kItemWidths[i]);
        if (x > 0.0f && x + width > rect.width() - 2.0f * px(kPadX)) {
            x = 0.0f;
            y += ImGui::GetFrameHeight() + px(kPadY);
        }
        ImGui::SetCursorScreenPos({origin.x + x, origin.y + y});
        switch (i) {
            case 0:
                mesh_combo(context, width);
                break;
            case 1:
                named_combo(context, "toolbar.shading", kShadings, context.view.shading,
                            {.icon = icon::kMaterial,
                             .width = width,
                             .tooltip = "Which formulas shade the picture."});
                break;
            case 2:
                named_combo(context, "toolbar.debug", kDebugViews, context.view.debug,
                            {.icon = icon::kEye,
                             .width = width,
                             .tooltip = "The final picture, or one ingredient of it. Keys 1 to 0."});
                break;
            case 3:
                named_combo(context, "toolbar.tonemap", kTonemaps, context.view.tonemap,
                            {.icon = icon::kCamera,
                             .width = width,
                             .tooltip = "How the light's unbounded range is brought onto the screen."});
                break;
            default:
                exposure_item(context, std::clamp(rect.width() - 2.0f * px(kPadX) - x, width, px(220)));
                break;
        }
        x += width + px(kGap);
    }
    end_region();
}

}  // namespace patina::ui
