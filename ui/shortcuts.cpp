#include "ui/shortcuts.h"

#include "ui/navigation.h"
#include "ui/widgets.h"
#include "ui/workspace.h"

#include <imgui.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace patina::ui {
namespace {

constexpr float kOrbitStep = 12.0f;  // mouse units a key press: about 5°
constexpr float kLightStep = 10.0f;  // 5°
constexpr float kExposureStep = 0.25f;

/// The value after this one in its table, round and round.
template <class T, std::size_t n>
T next_of(const std::array<Named<T>, n>& table, T value) {
    const auto index = static_cast<std::size_t>(index_of(table, value));
    return table[(index + 1) % n].value;
}

void step_item(const std::vector<CatalogItem>& items, std::string& id, int step) {
    if (items.empty()) return;
    const auto found =
        std::find_if(items.begin(), items.end(), [&](const CatalogItem& item) { return item.id == id; });
    const int count = static_cast<int>(items.size());
    const int index = found == items.end() ? (step > 0 ? -1 : 0) : static_cast<int>(found - items.begin());
    id = items[static_cast<std::size_t>((index + step + count) % count)].id;
}

void set_exposure(View& view, float change) {
    view.exposure_ev = std::clamp(view.exposure_ev + change, -20.0f, 20.0f);
}

std::optional<Request> request_of(const PanelContext& context, Action action) {
    switch (action) {
        case Action::New:
            return request::New{};
        case Action::Save:
            return request::Save{};
        case Action::Revert:
            return request::Revert{};
        case Action::Compare:
            return request::ShowSheet{context.sheet == nullptr};
        case Action::SaveComparison:
            return request::SaveSheet{};
        case Action::Quit:
            return request::Quit{};
        case Action::Undo:
            return request::Undo{};
        case Action::Redo:
            return request::Redo{};
        default:
            return std::nullopt;
    }
}

std::optional<BrowserPurpose> browser_of(Action action) {
    switch (action) {
        case Action::Open:
            return BrowserPurpose::OpenPreset;
        case Action::SaveAs:
            return BrowserPurpose::SavePreset;
        case Action::ImportMaps:
            return BrowserPurpose::ImportFolder;
        case Action::OpenEnvironment:
            return BrowserPurpose::OpenEnvironment;
        case Action::OpenMesh:
            return BrowserPurpose::OpenMesh;
        case Action::ExportRender:
            return BrowserPurpose::ExportRender;
        case Action::OpenComparison:
            return BrowserPurpose::OpenComparison;
        case Action::SaveComparisonAs:
            return BrowserPurpose::SaveComparison;
        case Action::ExportReport:
            return BrowserPurpose::ExportReport;
        default:
            return std::nullopt;
    }
}

bool act_on_camera(PanelContext& context, Action action) {
    Camera& camera = context.camera;
    switch (action) {
        case Action::Frame:
            camera.target = context.home_camera.target;
            camera.distance = context.home_camera.distance;
            return true;
        case Action::Home:
            camera = context.home_camera;
            return true;
        case Action::OrbitLeft:
            orbit(camera, {-kOrbitStep, 0.0f});
            return true;
        case Action::OrbitRight:
            orbit(camera, {kOrbitStep, 0.0f});
            return true;
        case Action::OrbitUp:
            orbit(camera, {0.0f, kOrbitStep});
            return true;
        case Action::OrbitDown:
            orbit(camera, {0.0f, -kOrbitStep});
            return true;
        case Action::ZoomIn:
            zoom(camera, 1.0f);
            return true;
        case Action::ZoomOut:
            zoom(camera, -1.0f);
            return true;
        default:
            return false;
    }
}

bool act_on_view(PanelContext& context, Action action) {
    View& view = context.view;
    switch (action) {
        case Action::LightLeft:
            turn_light(view, {-kLightStep, 0.0f});
            return true;
        case Action::LightRight:
            turn_light(view, {kLightStep, 0.0f});
            return true;
        case Action::ExposureUp:
            set_exposure(view, kExposureStep);
            return true;
        case Action::ExposureDown:
            set_exposure(view, -kExposureStep);
            return true;
        case Action::NextTonemap:
            view.tonemap = next_of(kTonemaps, view.tonemap);
            return true;
        case Action::NextBackground:
            view.background = next_of(kBackgrounds, view.background);
            return true;
        case Action::NextShading:
            view.shading = next_of(kShadings, view.shading);
            return true;
        case Action::NextEnvironment:
            step_item(context.catalog.environments, context.environment, 1);
            return true;
        case Action::PreviousEnvironment:
            step_item(context.catalog.environments, context.environment, -1);
            return true;
        case Action::NextMesh:
            step_item(context.catalog.meshes, context.mesh, 1);
            return true;
        default:
            break;
    }
    if (action < Action::Debug1 || action > Action::Debug10) return false;
    view.debug =
        kDebugViews[static_cast<std::size_t>(action) - static_cast<std::size_t>(Action::Debug1)].value;
    return true;
}

void close_topmost(PanelContext& context) {
    UiState& ui = context.ui;
    if (context.browser.open)
        context.browser.open = false;
    else if (ui.photo_tool != PhotoTool::None)
        ui.photo_tool = PhotoTool::None;
    else if (context.sheet && ui.sheet_enlarged >= 0)
        ui.sheet_enlarged = -1;
    else
        ui.drawer.clear();
}

void act_on_interface(PanelContext& context, Action action) {
    UiState& ui = context.ui;
    switch (action) {
        case Action::ToggleLibrary:
            ui.show_library = !ui.show_library;
            break;
        case Action::ToggleInspector:
            ui.show_inspector = !ui.show_inspector;
            break;
        case Action::ToggleLog:
            ui.drawer = ui.drawer.empty() ? "log" : "";
            break;
        case Action::Search:
            ui.show_library = true;
            ui.focus_search = true;
            break;
        case Action::Shortcuts:
            ui.show_shortcuts = true;
            break;
        case Action::About:
            ui.show_about = true;
            break;
        case Action::CloseSheet:
            close_topmost(context);
            break;
        default:
            break;
    }
}

bool is_pressed(const Shortcut& shortcut, bool command, bool shift) {
    if (shortcut.key == KeyNone) return false;
    if (((shortcut.modifiers & ModCommand) != 0) != command ||
        ((shortcut.modifiers & ModShift) != 0) != shift)
        return false;
    return ImGui::IsKeyPressed(shortcut.key, shortcut.repeats);
}

/// While text is typed, or a file is chosen, plain keys have another meaning.
bool is_free(const PanelContext& context, const Shortcut& shortcut) {
    const bool command = (shortcut.modifiers & ModCommand) != 0;
    if (ImGui::GetIO().WantTextInput)
        return command && shortcut.action != Action::Undo && shortcut.action != Action::Redo;
    if (context.browser.open) return command || shortcut.action == Action::CloseSheet;
    return true;
}

constexpr const char* kShortcutSheet = "##shortcuts";
constexpr const char* kAboutSheet = "##about";

/// A sheet in the middle of the window that Escape or a click beside it closes. opens: open it now.
bool begin_sheet(const char* id, const char* title, float width, bool& opens) {
    if (opens) ImGui::OpenPopup(id);
    opens = false;
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {window.x - px(32), window.y - px(48)});
    ImGui::SetNextWindowSize({std::min(width, window.x - px(32)), 0.0f});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(px(20), px(16)));
    const bool shown = ImGui::BeginPopup(id, ImGuiWindowFlags_NoMove);
    ImGui::PopStyleVar();
    if (!shown) return false;
    ImGui::PushFont(font_of(Face::Title));
    ImGui::TextUnformatted(title);
    ImGui::PopFont();
    ImGui::Dummy({0.0f, px(4)});
    return true;
}

struct SheetRow {
    std::string keys, what, about;
};

/// One row an action, with all its keys; the debug views share one.
std::vector<SheetRow> sheet_rows(bool (*belongs)(const Shortcut&)) {
    const bool mac = ImGui::GetIO().ConfigMacOSXBehaviors;
    std::vector<SheetRow> rows;
    std::optional<Action> last;
    for (const Shortcut& shortcut : kShortcuts) {
        if (shortcut.key == KeyNone || !belongs(shortcut)) continue;
        if (shortcut.action > Action::Debug1 && shortcut.action <= Action::Debug10) continue;
        if (shortcut.action == Action::Debug1)
            rows.push_back({"1 … 9, 0", "Final picture, or one ingredient", "As listed in View, Show."});
        else if (shortcut.action == last)
            rows.back().keys += " or " + key_text(shortcut, mac);
        else
            rows.push_back(
                {key_text(shortcut, mac), std::string(shortcut.title), std::string(shortcut.description)});
        if (shortcut.action == Action::Shortcuts) rows.back().keys += " or ?";
        last = shortcut.action;
    }
    return rows;
}

void draw_rows(PanelContext& context, const char* heading_text, const std::vector<SheetRow>& rows) {
    heading(heading_text);
    ImGui::PushID(heading_text);
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, ImVec2(px(6), px(2)));
    if (ImGui::BeginTable("##rows", 2)) {
        ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, px(140));
        ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch);
        for (const SheetRow& row : rows) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            text_line(context, row.keys, color::kAccent);
            ImGui::TableNextColumn();
            text_line(context, row.what);
            explain(context, row.about);
        }
        ImGui::EndTable();
    }
    ImGui::PopStyleVar();
    ImGui::PopID();
}

std::vector<SheetRow> mouse_rows() {
    return {{"Drag", "Orbit around the object", ""},
            {"Shift+drag, middle", "Pan", ""},
            {"Wheel", "Zoom", ""},
            {"Right-drag, L+drag", "Turn the light", ""},
            {"Double-click", "Reset the view", ""}};
}

std::vector<SheetRow> value_rows() {
    return {{"Drag", "Change a value", ""},
            {"Shift+drag", "Ten times finer", ""},
            {"Click on the number", "Type it", ""},
            {"Double-click", "Back to its default", ""},
            {"Right-click", "Reset, or back to the saved value", "On the value's name."}};
}

bool is_view_key(const Shortcut& s) { return s.action >= Action::Frame && s.action <= Action::Debug10; }
bool is_file_key(const Shortcut& s) { return s.action < Action::Frame; }
bool is_window_key(const Shortcut& s) { return s.action > Action::Debug10; }

}  // namespace

std::string key_text(const Shortcut& shortcut, bool mac) {
    if (shortcut.key == KeyNone) return "";
    std::string text;
    if (shortcut.modifiers & ModCommand) text += mac ? "⌘" : "Ctrl+";
    if (shortcut.modifiers & ModShift) text += mac ? "⇧" : "Shift+";
    switch (shortcut.key) {
        case KeyEscape:
            return text + "Esc";
        case KeyRight:
            return text + "→";
        case KeyLeft:
            return text + "←";
        case KeyUp:
            return text + "↑";
        case KeyDown:
            return text + "↓";
        case KeyPageUp:
            return text + "PgUp";
        case KeyPageDown:
            return text + "PgDn";
        case KeyHome:
            return text + "Home";
        case KeyF1:
            return text + "F1";
        case KeyPeriod:
            return text + ".";
        case KeyComma:
            return text + ",";
        case KeyEqual:
            return text + "+";
        case KeyMinus:
            return text + "−";
        case KeyPadAdd:
            return text + "Num +";
        case KeyPadSubtract:
            return text + "Num −";
        default:
            return text + static_cast<char>(shortcut.key);
    }
}

bool can_act(const PanelContext& context, Action action) {
    switch (action) {
        case Action::Undo:
            return context.status.can_undo;
        case Action::Redo:
            return context.status.can_redo;
        case Action::Revert:
            return context.status.dirty && !context.status.file.empty();
        case Action::SaveComparison:
        case Action::SaveComparisonAs:
        case Action::ExportReport:
            return context.sheet != nullptr;
        default:
            return true;
    }
}

void act(PanelContext& context, Action action) {
    if (!can_act(context, action)) return;
    if (const std::optional<Request> request = request_of(context, action))
        context.requests.push_back(*request);
    else if (const std::optional<BrowserPurpose> purpose = browser_of(action))
        open_browser(context, *purpose);
    else if (!act_on_camera(context, action) && !act_on_view(context, action))
        act_on_interface(context, action);
}

void handle_shortcuts(PanelContext& context) {
    if (context.unsaved || context.recovery || context.import_sheet) return;
    const ImGuiIO& io = ImGui::GetIO();
    const bool command = io.ConfigMacOSXBehaviors ? io.KeySuper : io.KeyCtrl;
    if (io.KeyAlt || context.escape_taken) return;
    for (const Shortcut& shortcut : kShortcuts)
        if (is_pressed(shortcut, command, io.KeyShift) && is_free(context, shortcut))
            act(context, shortcut.action);
    if (io.WantTextInput || context.browser.open) return;
    for (const ImWchar typed : io.InputQueueCharacters)
        if (typed == '?') act(context, Action::Shortcuts);
}

void draw_shortcut_sheet(PanelContext& context) {
    if (!begin_sheet(kShortcutSheet, "Keyboard and mouse", px(800), context.ui.show_shortcuts)) return;
    record_rect(
        context, "sheet.shortcuts",
        {ImGui::GetWindowPos().x, ImGui::GetWindowPos().y, ImGui::GetWindowPos().x + ImGui::GetWindowSize().x,
         ImGui::GetWindowPos().y + ImGui::GetWindowSize().y});
    if (ImGui::BeginTable("##columns", 2, ImGuiTableFlags_SizingStretchSame)) {
        ImGui::TableNextColumn();
        draw_rows(context, "File and edit", sheet_rows(is_file_key));
        draw_rows(context, "On the picture", mouse_rows());
        draw_rows(context, "On a value", value_rows());
        ImGui::TableNextColumn();
        draw_rows(context, "View", sheet_rows(is_view_key));
        draw_rows(context, "Window", sheet_rows(is_window_key));
        ImGui::EndTable();
    }
    ImGui::EndPopup();
}

void draw_about(PanelContext& context) {
    if (!begin_sheet(kAboutSheet, "Patina", px(420), context.ui.show_about)) return;
    text_wrapped("A desktop editor for physically based materials under image-based light.");
    ImGui::Dummy({0.0f, px(4)});
    text_wrapped("Version " + context.status.version, color::kMuted);
    text_wrapped(context.status.renderer, color::kMuted);
    text_wrapped(
        "MIT licence. Interface: Dear ImGui, with the fonts Inter and Font Awesome (SIL Open Font License).",
        color::kMuted);
    ImGui::EndPopup();
}

}  // namespace patina::ui
