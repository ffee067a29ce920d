// The inspector's light page: which environment, how it is turned, what is behind the object.
#include "renderer/core/view.h"
#include "ui/icons.h"
#include "ui/navigation.h"
#include "ui/panels.h"
#include "ui/values.h"
#include "ui/widgets.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

namespace patina::ui {
namespace {

const CatalogItem* find_item(const std::vector<CatalogItem>& items, std::string_view id) {
    const auto found =
        std::find_if(items.begin(), items.end(), [&](const CatalogItem& item) { return item.id == id; });
    return found == items.end() ? nullptr : &*found;
}

void draw_environment_picture(PanelContext& context) {
    const CatalogItem* item = find_item(context.catalog.environments, context.environment);
    const float width = ImGui::GetContentRegionAvail().x;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float height = std::round(width / 2.0f);
    ImGui::InvisibleButton("##panorama", {width, height});
    draw_thumbnail({at.x, at.y, at.x + width, at.y + height}, item ? item->thumbnail : 0, icon::kLight);
    finish_item(context, "light.picture", "The panorama that lights the object. Click for others.");
    if (ImGui::IsItemClicked()) {
        context.ui.show_library = true;
        context.ui.left_tab = "environments";
    }
    const EnvironmentInfo& info = context.environment_info;
    const std::string title = item                  ? item->title
                              : !info.title.empty() ? info.title
                                                    : std::string(file_name_of(context.environment));
    ImGui::PushFont(font_of(Face::Strong));
    text_line(context, title);
    ImGui::PopFont();
    if (info.width > 0) {
        std::array<char, 96> text{};
        std::snprintf(text.data(), text.size(), "%d × %d   ·   brightest %.4g", info.width, info.height,
                      static_cast<double>(info.max_radiance));
        ImGui::PushFont(font_of(Face::Small));
        text_line(context, text.data(), color::kMuted);
        ImGui::PopFont();
    }
    if (item && !item->description.empty()) text_wrapped(item->description, color::kMuted, Face::Small);
    for (const std::string& note : info.notes)
        text_wrapped(std::string(icon::kWarning) + " " + note, color::kWarning, Face::Small);
}

void draw_background(PanelContext& context) {
    const LabelAction action =
        row_label(context, {.name = "light.background",
                            .text = "Background",
                            .tooltip = "What is seen behind the object; the light stays the same.",
                            .changed = context.view.background != context.saved_view.background,
                            .at_default = context.view.background == View{}.background});
    apply_label(action, View{}.background, context.saved_view.background, context.view.background);
    const auto options = options_of(kBackgrounds);
    int index = index_of(kBackgrounds, context.view.background);
    if (combo(context, "light.background", options, index,
              {.tooltip = "What is seen behind the object; the light stays the same."}))
        context.view.background = kBackgrounds[static_cast<std::size_t>(index)].value;
    if (context.view.background != Background::Plain) return;
    color_row(context,
              {.name = "light.plain_color",
               .label = "Colour",
               .tooltip = "The plain background; a mid-grey lets colours be judged fairly.",
               .reset = View{}.plain_color,
               .saved = context.saved_view.plain_color},
              context.view.plain_color);
}

}  // namespace

void draw_light_panel(PanelContext& context) {
    draw_environment_picture(context);
    ImGui::Dummy({0.0f, px(6)});
    heading("Light");
    number_row(
        context,
        {.name = "light.rotation",
         .label = "Rotation",
         .tooltip = "Turns the light around the object, in degrees; right-drag on the picture does the same.",
         .min = -180.0f,
         .max = 180.0f,
         .hard_min = -360.0f,
         .hard_max = 360.0f,
         .reset = 0.0f,
         .saved = context.saved_view.env_rotation_deg,
         .format = "%.1f°",
         .step = 0.5f,
         .wraps = true},
        context.view.env_rotation_deg);
    number_row(context,
               {.name = "light.exposure",
                .label = "Exposure",
                .tooltip = "In stops: +1 doubles the light that reaches the screen.",
                .min = -6.0f,
                .max = 6.0f,
                .hard_min = -20.0f,
                .hard_max = 20.0f,
                .reset = 0.0f,
                .saved = context.saved_view.exposure_ev,
                .format = "%+.2f",
                .step = 0.05f},
               context.view.exposure_ev);
    heading("Behind the object");
    draw_background(context);
}

}  // namespace patina::ui
