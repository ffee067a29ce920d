// The inspector's page of the comparison: its texts, the selected view, and what can be made of it.
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/photo_overlay.h"
#include "ui/shortcuts.h"
#include "ui/values.h"
#include "ui/widgets.h"
#include "ui/workspace.h"

#include <imgui.h>

#include <string>

namespace patina::ui {
namespace {

constexpr float kLabel = 70.0f;  ///< of the texts, at scale 1

void draw_start(PanelContext& context) {
    text_wrapped(
        "Several views at once, with one camera: presets below each other, lightings beside each other, "
        "photos of the "
        "real thing, and a report to hand in.",
        color::kMuted);
    ImGui::Dummy({0.0f, px(4)});
    if (button(context, "compare.start", std::string(icon::kGrid) + "  Compare side by side",
               "Show the edited material under two lights to begin with (C).",
               {.emphasis = Emphasis::Primary, .width = ImGui::GetContentRegionAvail().x}))
        act(context, Action::Compare);
    if (button(context, "compare.open", "Open comparison…", "Open a sheet of views from its file.",
               {.width = ImGui::GetContentRegionAvail().x}))
        act(context, Action::OpenComparison);
}

void draw_texts(PanelContext& context) {
    Comparison& sheet = *context.sheet;
    heading("Sheet");
    const auto field = [&](std::string_view name, std::string_view label, std::string_view tooltip,
                           const char* hint, std::string& text) {
        text_row(context,
                 {.name = name, .label = label, .tooltip = tooltip, .hint = hint, .width = px(kLabel)}, text);
    };
    field("compare.title", "Title", "What stands above the sheet and the report.", "Materials side by side",
          sheet.title);
    field("compare.author", "Author", "Who made it; stands in the report.", "", sheet.author);
    field("compare.remarks", "Remarks", "A few words for the report.", "", sheet.remarks);
}

void draw_selected(PanelContext& context) {
    const std::vector<ViewPlace> places = places_of(*context.sheet);
    const auto selected = std::size_t(context.ui.sheet_selected);
    if (selected >= places.size() || selected >= context.sheet_cells.size()) return;
    const SheetCell& cell = context.sheet_cells[selected];
    heading("Selected view");
    text_line(context, cell.preset);
    text_line(context, cell.light, color::kMuted);
    const bool edited = preset_at(*context.sheet, places[selected]).preset == kEditedPreset;
    text_wrapped(
        edited ? "Shows the material that is being edited. Choose another light in the library, turn and "
                 "expose it on the Light page."
               : "Shows a preset from its file. Choose another one in the library.",
        color::kMuted, Face::Small);
    if (button(context, "compare.show_edited", "Show the edited material here",
               "The view's row follows what is being edited, instead of a preset's file.",
               {.width = ImGui::GetContentRegionAvail().x, .enabled = !edited}))
        context.requests.push_back(request::ChangeSheet{request::SheetChange::ShowEdited, int(selected)});
    Lighting& light = lighting_at(*context.sheet, places[selected]);
    bool own = light.camera.has_value();
    if (checkbox(context, "compare.own_camera", "A camera of its own",
                 "The view does not follow when the others are turned.", own))
        light.camera = own ? std::optional(context.camera) : std::nullopt;
    bool own_mode = light.shading.has_value();
    if (checkbox(context, "compare.own_shading", "A shading mode of its own",
                 "The toolbar's choice is this light's alone: for holding two modes against each other.",
                 own_mode))
        light.shading = own_mode ? std::optional(context.view.shading) : std::nullopt;
    text_row(context,
             {.name = "compare.light_title",
              .label = "Light",
              .tooltip = "What the light is called in the sheet and the report; empty: as its environment.",
              .hint = light.title.empty() ? cell.light.c_str() : "",
              .width = px(kLabel)},
             light.title);
}

void draw_files(PanelContext& context) {
    heading("File");
    const std::string file =
        context.sheet_file.empty() ? "Not saved yet" : std::string(file_name_of(context.sheet_file));
    text_line(context, context.sheet_unsaved && !context.sheet_file.empty() ? file + "  •" : file,
              color::kMuted);
    const float half = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
    if (button(context, "compare.save", "Save", "Write the sheet of views to its file.",
               {.width = half, .enabled = context.sheet_unsaved || context.sheet_file.empty()}))
        act(context, Action::SaveComparison);
    ImGui::SameLine();
    if (button(context, "compare.open", "Open…", "Open a sheet of views from its file.", {.width = half}))
        act(context, Action::OpenComparison);
    checkbox(context, "compare.report_reference", "Errors against the reference",
             "The report also says how far each view is from the sampled integral; takes seconds a view.",
             context.ui.report_reference);
    if (button(context, "compare.report", "Export report…",
               "The sheet with its values, maps and photos as a web page or a PDF document.",
               {.emphasis = Emphasis::Primary, .width = ImGui::GetContentRegionAvail().x}))
        act(context, Action::ExportReport);
}

}  // namespace

void draw_sheet_panel(PanelContext& context) {
    if (!context.sheet) return draw_start(context);
    draw_texts(context);
    draw_selected(context);
    if (std::size_t(context.ui.sheet_selected) < context.sheet_cells.size())
        draw_photo_rows(context, context.ui.sheet_selected);
    draw_files(context);
}

}  // namespace patina::ui
