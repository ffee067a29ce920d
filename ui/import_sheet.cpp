// The import question: which file goes to which slot, why, and a way to change it before it applies.
#include "materials/params.h"
#include "ui/dialogs.h"
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/widgets.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace patina::ui {
namespace {

constexpr int kLeftOut = kMapSlots;  // the slot list's last line

void choose_slot(PanelContext& context, const std::string& name, ImportRow& row) {
    std::vector<Option> options;
    for (const MaterialSlot& slot : material_slots()) options.push_back({slot.label, slot.tooltip});
    options.push_back({"Leave out", "Do not use this file."});
    int index = row.slot ? static_cast<int>(*row.slot) : kLeftOut;
    if (!combo(context, name + ".slot", options, index, {.tooltip = "The slot that this file is put into."}))
        return;
    if (index == kLeftOut) {
        row.slot.reset();
        return;
    }
    row.slot = static_cast<MapSlot>(index);
    row.color_space = *row.slot == MapSlot::Albedo || *row.slot == MapSlot::Emission ? ColorSpace::Srgb
                                                                                     : ColorSpace::Linear;
}

template <class T, std::size_t n>
void choose(PanelContext& context, const std::string& name, const std::array<Choice<T>, n>& table, T& value) {
    std::array<Option, n> options;
    int index = 0;
    for (std::size_t i = 0; i < n; ++i) {
        options[i] = {table[i].title, table[i].tooltip};
        if (table[i].value == value) index = static_cast<int>(i);
    }
    if (combo(context, name, options, index)) value = table[static_cast<std::size_t>(index)].value;
}

/// What the slot needs to know about how to read the file.
void choose_reading(PanelContext& context, const std::string& name, ImportRow& row) {
    if (!row.slot) return;
    Material scratch;
    const MapRef ref = map_of(scratch, *row.slot);
    if (ref.color_space) choose(context, name + ".color_space", kColorSpaces, row.color_space);
    if (ref.convention) choose(context, name + ".convention", kNormalConventions, row.convention);
    if (!ref.channel) return;
    std::array<Option, kChannels.size()> options;
    for (std::size_t i = 0; i < options.size(); ++i) options[i] = {kChannels[i].title, kChannels[i].tooltip};
    int index = static_cast<int>(row.channel);
    if (combo(context, name + ".channel", options, index, {.width = px(74)}))
        row.channel = kChannels[static_cast<std::size_t>(index)].value;
    ImGui::SameLine(0.0f, px(8));
    checkbox(context, name + ".invert", "Invert", "Take 1 − the map: for glossiness in the roughness slot.",
             row.invert);
}

bool is_doubled(const ImportSheet& sheet, const ImportRow& row) {
    if (!row.slot) return false;
    return std::count_if(sheet.rows.begin(), sheet.rows.end(),
                         [&](const ImportRow& other) { return other.slot == row.slot; }) > 1;
}

void draw_row(PanelContext& context, const ImportSheet& sheet, ImportRow& row, std::size_t index) {
    const std::string name = "import." + std::to_string(index);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float side = px(40);
    ImGui::Dummy({side, side});
    draw_thumbnail({at.x, at.y, at.x + side, at.y + side}, row.thumbnail, icon::kImage);
    ImGui::TableNextColumn();
    text_line(context, row.name, row.slot ? color::kText : color::kFaint);
    text_wrapped(is_doubled(sheet, row) ? "Two files for one slot: the lower one wins." : row.reason,
                 is_doubled(sheet, row) ? color::kWarning : color::kMuted, Face::Small);
    ImGui::TableNextColumn();
    choose_slot(context, name, row);
    ImGui::TableNextColumn();
    choose_reading(context, name, row);
}

void draw_table(PanelContext& context, ImportSheet& sheet) {
    constexpr ImGuiTableFlags flags =
        ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerH | ImGuiTableFlags_ScrollY;
    const float row = px(54);
    const int offers = 1 + (sheet.mesh.empty() ? 0 : 1) + (sheet.environment.empty() ? 0 : 1);
    const float below = px(28) * static_cast<float>(offers) + px(20) * static_cast<float>(sheet.notes.size());
    const float most = ImGui::GetIO().DisplaySize.y - px(232) - below;
    const float height = std::min(most, row * static_cast<float>(sheet.rows.size()) + px(34));
    if (!ImGui::BeginTable("##rows", 4, flags, {0.0f, std::max(px(90), height)})) return;
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, px(40));
    ImGui::TableSetupColumn("File, and why", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("Goes to", ImGuiTableColumnFlags_WidthFixed, px(158));
    ImGui::TableSetupColumn("Read as", ImGuiTableColumnFlags_WidthFixed, px(160));
    ImGui::TableHeadersRow();
    for (std::size_t i = 0; i < sheet.rows.size(); ++i) draw_row(context, sheet, sheet.rows[i], i);
    ImGui::EndTable();
}

/// Is a list of the sheet open? Then Enter is meant for it.
bool is_list_open() {
    const ImGuiContext& imgui = *ImGui::GetCurrentContext();
    return imgui.OpenPopupStack.Size > imgui.BeginPopupStack.Size;
}

void draw_answers(PanelContext& context, const ImportSheet& sheet, bool list_open) {
    const float width = px(120);
    const auto used = std::count_if(sheet.rows.begin(), sheet.rows.end(),
                                    [](const ImportRow& row) { return row.slot.has_value(); });
    align_right(2.0f * width + ImGui::GetStyle().ItemSpacing.x);
    const bool cancel = button(context, "import.cancel", "Cancel", "Change nothing (Esc).", {.width = width});
    ImGui::SameLine();
    const bool apply =
        button(context, "import.apply", "Use these maps", "Put the files into their slots (Enter).",
               {.emphasis = Emphasis::Primary, .width = width, .enabled = used > 0});
    if (apply || (used > 0 && !list_open && enter_pressed())) {
        context.requests.push_back(request::ApplyImport{});
        ImGui::CloseCurrentPopup();
    } else if (cancel || escape_pressed(context)) {
        context.requests.push_back(request::CancelImport{});
        ImGui::CloseCurrentPopup();
    }
}

}  // namespace

void draw_import_sheet(PanelContext& context) {
    if (!context.import_sheet || context.unsaved || context.recovery) return;
    ImportSheet& sheet = *context.import_sheet;
    const std::string title = sheet.title.empty() ? "Import maps" : "Import maps: " + sheet.title;
    if (!begin_question(context, "##import", title, px(820))) return;
    text_wrapped("Each file was matched to a slot by its name. Change what is wrong; it applies as one step.",
                 color::kMuted);
    ImGui::Dummy({0.0f, px(2)});
    const bool list_open = is_list_open();
    draw_table(context, sheet);
    for (const std::string& note : sheet.notes) text_wrapped(note, color::kMuted, Face::Small);
    checkbox(context, "import.rename", "Name the material after the set", "Otherwise it keeps its name.",
             sheet.rename_material);
    const std::string on_mesh = "Show it on " + std::string(file_name_of(sheet.mesh));
    if (!sheet.mesh.empty())
        checkbox(context, "import.mesh", on_mesh.c_str(),
                 "The mesh that lies with the maps; otherwise the material stays on the present one.",
                 sheet.use_mesh);
    const std::string lit_by = "Light it by " + std::string(file_name_of(sheet.environment));
    if (!sheet.environment.empty())
        checkbox(context, "import.environment", lit_by.c_str(),
                 "The environment that came with the maps; otherwise the light stays as it is.",
                 sheet.use_environment);
    draw_answers(context, sheet, list_open);
    end_question();
}

}  // namespace patina::ui
