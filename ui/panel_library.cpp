// The library: presets, environments and meshes as pictures to click on, under a search field.
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "ui/workspace.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace patina::ui {
namespace {

struct Shelf {
    std::string_view name;  ///< "library.presets"
    const std::vector<CatalogItem>& items;
    std::string& search;
    std::string_view selected;  ///< id
    const char* hint;
    const char* placeholder;
    float aspect = 1.0f;
    float card_width = 84.0f;  ///< at least, at scale 1
    std::string_view nothing;  ///< said when the shelf is empty
};

/// Draws the cards that match the search; returns the clicked one.
const CatalogItem* draw_cards(PanelContext& context, const Shelf& shelf) {
    ImGui::Dummy({0.0f, 0.0f});  // room for the first row's frame
    const float full = ImGui::GetContentRegionAvail().x - px(10), gap = px(12);
    const int columns = std::max(1, static_cast<int>((full + gap) / (px(shelf.card_width) + gap)));
    const float width =
        std::floor((full - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns));
    const CatalogItem* clicked = nullptr;
    std::string_view group;
    int column = 0, shown = 0;
    ImGui::Indent(px(4));
    for (const CatalogItem& item : shelf.items) {
        if (!matches_search(item.title + " " + item.group + " " + item.description, shelf.search)) continue;
        if (item.group != group) {
            group = item.group;
            column = 0;
            ImGui::PushFont(font_of(Face::Small));
            text_line(context, group, color::kFaint);
            ImGui::PopFont();
        }
        if (column > 0) ImGui::SameLine(0.0f, gap);
        const CardStyle style{.width = width,
                              .aspect = shelf.aspect,
                              .placeholder = shelf.placeholder,
                              .selected = item.id == shelf.selected};
        if (card(context, std::string(shelf.name) + "." + item.title, item, style)) clicked = &item;
        column = (column + 1) % columns;
        ++shown;
    }
    if (shown == 0) {
        if (shelf.items.empty())
            text_wrapped(shelf.nothing, color::kMuted);
        else
            text_wrapped("Nothing is called “" + shelf.search + "”.", color::kMuted);
    }
    ImGui::Unindent(px(4));
    return clicked;
}

struct Footer {
    std::string_view name, text, tooltip;
    BrowserPurpose purpose = BrowserPurpose::OpenPreset;
};

const CatalogItem* draw_shelf(PanelContext& context, const Shelf& shelf, const Footer& footer) {
    context.result.shelf = shelf.name;
    search_field(context, std::string(shelf.name) + ".search", shelf.search, shelf.hint,
                 context.ui.focus_search);
    context.ui.focus_search = false;
    const float foot = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemSpacing.y;
    ImGui::BeginChild("##shelf", {0.0f, -foot});
    const CatalogItem* clicked = draw_cards(context, shelf);
    ImGui::EndChild();
    if (button(context, footer.name, footer.text, footer.tooltip,
               {.width = ImGui::GetContentRegionAvail().x}))
        open_browser(context, footer.purpose);
    return clicked;
}

}  // namespace

void draw_presets_panel(PanelContext& context) {
    const Shelf shelf{.name = "library.presets",
                      .items = context.catalog.presets,
                      .search = context.ui.search_presets,
                      .selected = context.status.file,
                      .hint = "Search presets",
                      .placeholder = icon::kMaterial,
                      .nothing = context.catalog.presets_are_read
                                     ? "No presets were found. Saved presets appear here."
                                     : ""};
    const Footer footer{"library.presets.open", "Open preset…", "Open a preset file from disk.",
                        BrowserPurpose::OpenPreset};
    if (const CatalogItem* item = draw_shelf(context, shelf, footer))
        context.requests.push_back(request::Open{item->id});
}

void draw_environments_panel(PanelContext& context) {
    const Shelf shelf{.name = "library.environments",
                      .items = context.catalog.environments,
                      .search = context.ui.search_environments,
                      .selected = context.environment,
                      .hint = "Search environments",
                      .placeholder = icon::kLight,
                      .aspect = 2.0f,
                      .nothing = "No environments were found."};
    const Footer footer{"library.environments.open", "Open .hdr or .exr…",
                        "Light the object with your own panorama.", BrowserPurpose::OpenEnvironment};
    if (const CatalogItem* item = draw_shelf(context, shelf, footer)) context.environment = item->id;
}

void draw_meshes_panel(PanelContext& context) {
    const Shelf shelf{.name = "library.meshes",
                      .items = context.catalog.meshes,
                      .search = context.ui.search_meshes,
                      .selected = context.mesh,
                      .hint = "Search meshes",
                      .placeholder = icon::kCube,
                      .nothing = "No meshes were found."};
    const Footer footer{"library.meshes.open", "Open mesh…",
                        "Show the material on an OBJ, PLY, OFF or STL file.", BrowserPurpose::OpenMesh};
    if (const CatalogItem* item = draw_shelf(context, shelf, footer)) context.mesh = item->id;
}

}  // namespace patina::ui
