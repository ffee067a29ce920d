// Choosing a file or folder, in the place of the viewport. Lists what the app has read; opens no file itself.
#include "ui/dialogs.h"
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/shortcuts.h"
#include "ui/widgets.h"
#include "ui/workspace.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace patina::ui {
namespace {

struct PurposeRow {
    BrowserPurpose purpose;
    const char* title;
    const char* verb;
    const char* extensions;         ///< of the files shown, when the app names none
    const char* default_extension;  ///< added to a typed name that has none of extensions
};
constexpr const char* kImages = "png jpg jpeg tif tiff tga exr hdr bmp webp";
constexpr std::array kPurposes{
    PurposeRow{BrowserPurpose::OpenPreset, "Open preset", "Open", "json", ""},
    PurposeRow{BrowserPurpose::SavePreset, "Save preset as", "Save", "json", ".json"},
    PurposeRow{BrowserPurpose::AssignMap, "Choose a map", "Use", kImages, ""},
    PurposeRow{BrowserPurpose::LocateMap, "Locate the missing map", "Use", kImages, ""},
    PurposeRow{BrowserPurpose::ImportFolder, "Import the maps of a folder", "Import", kImages, ""},
    PurposeRow{BrowserPurpose::OpenEnvironment, "Open environment", "Open", "hdr exr", ""},
    PurposeRow{BrowserPurpose::OpenMesh, "Open mesh", "Open", "obj ply off stl", ""},
    PurposeRow{BrowserPurpose::ExportRender, "Export picture", "Export", "png exr", ".png"},
    PurposeRow{BrowserPurpose::OpenComparison, "Open comparison", "Open", "json", ""},
    PurposeRow{BrowserPurpose::SaveComparison, "Save comparison as", "Save", "json", ".json"},
    PurposeRow{BrowserPurpose::ChoosePhoto, "Choose a photo", "Use", kImages, ""},
    PurposeRow{BrowserPurpose::ExportReport, "Export report", "Export", "pdf html", ".pdf"},
    PurposeRow{BrowserPurpose::ChooseMapPhoto, "Choose a photo for maps", "Use", kImages, ""},
};
const PurposeRow& purpose_row(BrowserPurpose purpose) { return kPurposes[static_cast<std::size_t>(purpose)]; }

bool saves(BrowserPurpose purpose) {
    return purpose == BrowserPurpose::SavePreset || purpose == BrowserPurpose::ExportRender ||
           purpose == BrowserPurpose::SaveComparison || purpose == BrowserPurpose::ExportReport;
}

std::string extension_of(std::string_view name) {
    const std::size_t dot = name.find_last_of('.');
    if (dot == std::string_view::npos) return "";
    std::string extension(name.substr(dot + 1));
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return extension;
}

bool fits_purpose(const FileBrowser& browser, std::string_view name) {
    const std::string extension = extension_of(name);
    if (extension.empty()) return false;
    if (!browser.extensions.empty())
        return std::find(browser.extensions.begin(), browser.extensions.end(), extension) !=
               browser.extensions.end();
    const std::string all = " " + std::string(purpose_row(browser.purpose).extensions) + " ";
    return all.find(" " + extension + " ") != std::string::npos;
}

std::vector<const BrowserEntry*> shown_entries(const FileBrowser& browser) {
    std::vector<const BrowserEntry*> shown;
    for (const BrowserEntry& entry : browser.entries) {
        if (!matches_search(entry.name, browser.search)) continue;
        if (!entry.is_folder && !browser.show_all && !fits_purpose(browser, entry.name)) continue;
        shown.push_back(&entry);
    }
    std::sort(shown.begin(), shown.end(), [](const BrowserEntry* a, const BrowserEntry* b) {
        if (a->is_folder != b->is_folder) return a->is_folder;
        return natural_less(a->name, b->name);
    });
    return shown;
}

void enter_folder(PanelContext& context, const std::string& folder) {
    context.browser.selected.clear();
    context.browser.search.clear();
    context.requests.push_back(request::ListFolder{folder});
}

std::string parent_of(const std::string& folder) {
    const std::size_t slash = folder.find_last_of('/');
    if (slash == std::string::npos || folder.size() <= 1) return folder;
    return slash == 0 ? "/" : folder.substr(0, slash);
}

std::string join(const std::string& folder, const std::string& name) {
    return folder.empty() || folder.back() == '/' ? folder + name : folder + "/" + name;
}

/// The file that a save would write; empty while no name is typed.
std::string target_of(const FileBrowser& browser) {
    if (browser.file_name.empty()) return "";
    std::string name = browser.file_name;
    if (!fits_purpose(browser, name)) name += purpose_row(browser.purpose).default_extension;
    return join(browser.folder, name);
}

bool exists(const FileBrowser& browser, const std::string& path) {
    return std::any_of(browser.entries.begin(), browser.entries.end(),
                       [&](const BrowserEntry& entry) { return entry.path == path; });
}

const BrowserEntry* selected_entry(const FileBrowser& browser) {
    for (const BrowserEntry& entry : browser.entries)
        if (entry.path == browser.selected) return &entry;
    return nullptr;
}

bool can_confirm(const FileBrowser& browser) {
    if (saves(browser.purpose)) return !browser.file_name.empty();
    if (browser.purpose == BrowserPurpose::ImportFolder) return true;
    return !browser.selected.empty();
}

void confirm(PanelContext& context) {
    FileBrowser& browser = context.browser;
    if (!can_confirm(browser)) return;
    const BrowserEntry* entry = selected_entry(browser);
    if (entry && entry->is_folder && browser.purpose != BrowserPurpose::ImportFolder &&
        !saves(browser.purpose)) {
        enter_folder(context, entry->path);
        return;
    }
    const std::string file = saves(browser.purpose) ? target_of(browser) : browser.selected;
    Requests& requests = context.requests;
    switch (browser.purpose) {
        case BrowserPurpose::OpenPreset:
            requests.push_back(request::Open{file});
            break;
        case BrowserPurpose::SavePreset:
            requests.push_back(request::SaveAs{file});
            break;
        case BrowserPurpose::AssignMap:
            requests.push_back(request::AssignMap{browser.slot, file});
            break;
        case BrowserPurpose::LocateMap:
            requests.push_back(request::LocateMap{browser.slot, file});
            break;
        case BrowserPurpose::ImportFolder:
            requests.push_back(request::ImportMaps{{file.empty() ? browser.folder : file}});
            break;
        case BrowserPurpose::OpenEnvironment:
            requests.push_back(request::LoadEnvironment{file});
            break;
        case BrowserPurpose::OpenMesh:
            requests.push_back(request::LoadMesh{file});
            break;
        case BrowserPurpose::ExportRender:
            requests.push_back(request::ExportRender{file, context.ui.export_width, context.ui.export_height,
                                                     context.ui.export_what});
            break;
        case BrowserPurpose::OpenComparison:
            requests.push_back(request::OpenSheet{file});
            break;
        case BrowserPurpose::SaveComparison:
            requests.push_back(request::SaveSheetAs{file});
            break;
        case BrowserPurpose::ChoosePhoto:
            requests.push_back(request::SetPhoto{file});
            break;
        case BrowserPurpose::ExportReport:
            requests.push_back(request::ExportReport{file});
            break;
        case BrowserPurpose::ChooseMapPhoto:
            requests.push_back(request::SetMapPhoto{file});
            break;
    }
    browser.open = false;
}

void draw_places(PanelContext& context) {
    for (const BrowserPlace& place : context.browser.places) {
        const bool here = place.path == context.browser.folder;
        ImGui::PushID(place.path.c_str());
        if (ImGui::Selectable(place.title.c_str(), here)) enter_folder(context, place.path);
        ImGui::PopID();
        finish_item(context, "browser.place." + place.title, place.path);
    }
}

/// A name is asked for under the button; Enter makes the folder and goes into it.
void draw_new_folder(PanelContext& context) {
    FileBrowser& browser = context.browser;
    if (icon_button(context, "browser.new_folder", icon::kPlus, "Make a new folder here.")) {
        browser.new_folder.clear();
        ImGui::OpenPopup("##new_folder");
    }
    browser.naming_folder = ImGui::BeginPopup("##new_folder");
    if (!browser.naming_folder) return;
    const bool entered =
        text_field(context, "browser.new_folder_name", browser.new_folder, "The name of the new folder.",
                   {.hint = "Name of the new folder",
                    .width = px(180),
                    .take_focus = ImGui::IsWindowAppearing(),
                    .flags = ImGuiInputTextFlags_EnterReturnsTrue});
    const bool typed = !browser.new_folder.empty();
    ImGui::SameLine();
    const bool pressed = button(context, "browser.make_folder", "Make", "Enter does the same.",
                                {.emphasis = Emphasis::Primary, .enabled = typed});
    if (typed && (pressed || entered)) {
        context.requests.push_back(request::MakeFolder{join(browser.folder, browser.new_folder)});
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

void draw_folder_line(PanelContext& context) {
    FileBrowser& browser = context.browser;
    if (icon_button(context, "browser.parent", icon::kParent, "The folder above (Backspace)."))
        enter_folder(context, parent_of(browser.folder));
    ImGui::SameLine(0.0f, px(4));
    if (saves(browser.purpose)) {
        draw_new_folder(context);
        ImGui::SameLine(0.0f, px(4));
    }
    if (browser.typed_folder.empty()) browser.typed_folder = browser.folder;
    const float search = px(170);
    const float width =
        std::max(px(80), ImGui::GetContentRegionAvail().x - search - ImGui::GetStyle().ItemSpacing.x);
    text_field(context, "browser.folder", browser.typed_folder,
               "The folder; type or paste another one and press Enter.",
               {.width = width, .flags = ImGuiInputTextFlags_AutoSelectAll});
    if (ImGui::IsItemDeactivatedAfterEdit() && browser.typed_folder != browser.folder)
        enter_folder(context, browser.typed_folder);
    if (!ImGui::IsItemActive()) browser.typed_folder = browser.folder;
    ImGui::SameLine();
    search_field(context, "browser.search", browser.search, "Search here", false);
}

void draw_entry(PanelContext& context, const BrowserEntry& entry, bool& act_on_it) {
    FileBrowser& browser = context.browser;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushID(entry.path.c_str());
    const std::string label = std::string(entry.is_folder ? icon::kFolder : icon::kFile) + "   " + entry.name;
    if (ImGui::Selectable(label.c_str(), browser.selected == entry.path,
                          ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick)) {
        browser.selected = entry.path;
        if (!entry.is_folder && saves(browser.purpose)) browser.file_name = entry.name;
        act_on_it = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
    }
    record(context, "browser.entry." + entry.name);
    ImGui::PopID();
    ImGui::TableNextColumn();
    if (!entry.is_folder) ImGui::TextDisabled("%s", bytes_text(entry.bytes).c_str());
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", entry.modified.c_str());
}

void draw_entries(PanelContext& context, const std::vector<const BrowserEntry*>& entries, float height) {
    constexpr ImGuiTableFlags flags = ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg;
    FileBrowser& browser = context.browser;
    if (!browser.error.empty()) text_wrapped(browser.error, color::kError);
    if (!ImGui::BeginTable("##entries", 3, flags, {0.0f, height})) return;
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("Name", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("Size", ImGuiTableColumnFlags_WidthFixed, px(70));
    ImGui::TableSetupColumn("Changed", ImGuiTableColumnFlags_WidthFixed, px(126));
    ImGui::TableHeadersRow();
    const BrowserEntry* opened = nullptr;
    for (const BrowserEntry* entry : entries) {
        bool act_on_it = false;
        draw_entry(context, *entry, act_on_it);
        if (act_on_it) opened = entry;
    }
    if (entries.empty() && browser.error.empty()) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        const bool filtered = !browser.search.empty() || !browser.entries.empty();
        text_line(context, filtered ? "Nothing here that fits." : "This folder is empty.", color::kFaint);
    }
    ImGui::EndTable();
    if (!opened) return;
    if (opened->is_folder)
        enter_folder(context, opened->path);
    else
        confirm(context);
}

void draw_export_size(PanelContext& context) {
    UiState& ui = context.ui;
    static constexpr std::array<Option, 4> what{
        Option{"Picture", "The view as it is set, in any size."},
        Option{"Reference", "The reflectance integral as far as it has gathered, in the viewport's size."},
        Option{"Relative error", "How far the shading is from the reference, with its legend."},
        Option{"FLIP", "How different the two look, with its legend."}};
    int index = int(ui.export_what);
    if (combo(context, "browser.what", what, index, {.width = px(120), .tooltip = "What to export."}))
        ui.export_what = request::ExportWhat(index);
    ImGui::SameLine(0.0f, px(16));
    if (ui.export_what != request::ExportWhat::Picture) {
        ImGui::AlignTextToFramePadding();
        text_line(context,
                  ui.export_what == request::ExportWhat::Reference
                      ? ".png: the display picture   .exr: scene-linear light"
                      : ".png: colours with a legend   .exr: the values",
                  color::kFaint);
        return;
    }
    const auto size_field = [&](const char* name, const char* tooltip, int& value) {
        ImGui::PushID(name);
        ImGui::SetNextItemWidth(px(70));
        ImGui::InputInt("##size", &value, 0);
        ImGui::PopID();
        value = std::clamp(value, 1, 16384);
        finish_item(context, name, tooltip);
    };
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Size");
    ImGui::SameLine();
    size_field("browser.width", "Width of the picture in pixels.", ui.export_width);
    ImGui::SameLine(0.0f, px(6));
    ImGui::TextUnformatted("×");
    ImGui::SameLine(0.0f, px(6));
    size_field("browser.height", "Height of the picture in pixels.", ui.export_height);
    ImGui::SameLine(0.0f, px(16));
    ImGui::AlignTextToFramePadding();
    text_line(context, ".png: the display picture   .exr: scene-linear light", color::kFaint);
}

/// A path typed as the name: its folder is shown, so that what is there is seen before it is replaced. False:
/// it is a name alone.
bool go_where_typed(PanelContext& context) {
    FileBrowser& browser = context.browser;
    const std::size_t slash = browser.file_name.find_last_of('/');
    if (slash == std::string::npos) return false;
    const std::string typed = slash == 0 ? "/" : browser.file_name.substr(0, slash);
    const bool from_root = typed[0] == '/' || typed[0] == '~' || (typed.size() > 1 && typed[1] == ':');
    browser.file_name.erase(0, slash + 1);
    browser.typed_folder = from_root ? typed : join(browser.folder, typed);
    enter_folder(context, browser.typed_folder);
    return true;
}

void draw_answers(PanelContext& context) {
    FileBrowser& browser = context.browser;
    const PurposeRow& purpose = purpose_row(browser.purpose);
    if (browser.purpose == BrowserPurpose::ExportRender) draw_export_size(context);
    const float gap = ImGui::GetStyle().ItemSpacing.x, full = ImGui::GetContentRegionAvail().x;
    const float width = std::clamp((full - px(130) - 2.0f * gap) / 2.0f, px(72), px(96));
    const float buttons = 2.0f * (width + gap);
    bool replaces = false, goes_elsewhere = false;
    if (saves(browser.purpose)) {
        text_field(context, "browser.file_name", browser.file_name,
                   "The name of the file, or its whole path.",
                   {.hint = "File name", .width = full - buttons});
        goes_elsewhere = ImGui::IsItemDeactivatedAfterEdit() && go_where_typed(context);
        replaces = exists(browser, target_of(browser));
        ImGui::SameLine();
    } else {
        checkbox(context, "browser.show_all", "Show all files", "Also files of other types.",
                 browser.show_all);
        ImGui::SameLine();
        align_right(2.0f * width + gap);
    }
    if (button(context, "browser.cancel", "Cancel", "Go back to the picture (Esc).", {.width = width}))
        browser.open = false;
    ImGui::SameLine();
    const char* tip =
        replaces ? "A file of this name is there; it will be replaced." : "Enter does the same.";
    if (button(context, "browser.confirm", replaces ? "Replace" : purpose.verb, tip,
               {.emphasis = Emphasis::Primary, .width = width, .enabled = can_confirm(browser)}) &&
        !goes_elsewhere)
        confirm(context);
}

void move_selection(FileBrowser& browser, const std::vector<const BrowserEntry*>& entries, int step) {
    if (entries.empty()) return;
    const auto found = std::find_if(entries.begin(), entries.end(), [&](const BrowserEntry* entry) {
        return entry->path == browser.selected;
    });
    const int last = static_cast<int>(entries.size()) - 1;
    const int index =
        found == entries.end() ? (step > 0 ? 0 : last) : static_cast<int>(found - entries.begin()) + step;
    browser.selected = entries[static_cast<std::size_t>(std::clamp(index, 0, last))]->path;
}

void handle_keys(PanelContext& context, const std::vector<const BrowserEntry*>& entries) {
    const bool typing = ImGui::GetIO().WantTextInput;
    if (ImGui::IsKeyPressed(KeyDown)) move_selection(context.browser, entries, 1);
    if (ImGui::IsKeyPressed(KeyUp)) move_selection(context.browser, entries, -1);
    if (!typing && ImGui::IsKeyPressed(KeyBackspace, false))
        enter_folder(context, parent_of(context.browser.folder));
    const bool enter = ImGui::IsKeyPressed(KeyEnter, false) || ImGui::IsKeyPressed(KeyPadEnter, false);
    const bool folder_typed = context.browser.typed_folder != context.browser.folder;
    if (enter && !folder_typed) confirm(context);
}

}  // namespace

void open_browser(PanelContext& context, BrowserPurpose purpose, MapSlot slot) {
    FileBrowser& browser = context.browser;
    browser.open = true;
    browser.purpose = purpose;
    browser.slot = slot;
    browser.search.clear();
    browser.selected.clear();
    browser.naming_folder = false;
    browser.extensions.clear();
    browser.file_name.clear();  // a comparison's and a report's are the app's to choose
    if (purpose == BrowserPurpose::SavePreset || purpose == BrowserPurpose::ExportRender) {
        browser.file_name = context.material.name;
        std::replace(browser.file_name.begin(), browser.file_name.end(), '/', '-');
    }
    context.requests.push_back(request::ListFolder{});
}

void draw_file_browser(PanelContext& context, const Rect& rect) {
    begin_region(context, "browser", rect, {.padding = {16.0f, 12.0f}});
    ImGui::PushFont(font_of(Face::Title));
    ImGui::TextUnformatted(purpose_row(context.browser.purpose).title);
    ImGui::PopFont();
    const float places = std::min(px(140), rect.width() * 0.25f);
    const bool exports = context.browser.purpose == BrowserPurpose::ExportRender;
    const float foot = ImGui::GetFrameHeightWithSpacing() * (exports ? 2.0f : 1.0f) + px(6);
    ImGui::BeginChild("##places", {places, -foot});
    draw_places(context);
    ImGui::EndChild();
    ImGui::SameLine(0.0f, px(14));
    ImGui::BeginChild("##files", {0.0f, -foot});
    draw_folder_line(context);
    const std::vector<const BrowserEntry*> entries = shown_entries(context.browser);
    draw_entries(context, entries, 0.0f);
    ImGui::EndChild();
    if (context.browser.open) draw_answers(context);
    if (context.browser.open && !context.browser.naming_folder) handle_keys(context, entries);
    end_region();
}

}  // namespace patina::ui
