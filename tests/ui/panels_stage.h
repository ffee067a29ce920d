// A window without a screen: the workspace in an ImGui context of its own, with made-up data, a mouse and a
// keyboard.
#pragma once

#include "ui/panel_context.h"
#include "ui/shortcuts.h"
#include "ui/theme.h"
#include "ui/workspace.h"

#include <imgui.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace patina::ui {

struct Stage {
    Material material, saved_material;
    View view, saved_view;
    Camera camera, home_camera;
    std::string mesh = "sphere", environment = "studio";
    UiState ui;
    FileBrowser browser;
    std::optional<ImportSheet> import_sheet;
    std::optional<Comparison> sheet;
    std::vector<SheetCell> sheet_cells;  ///< one a view of it
    Catalog catalog;
    Status status;
    std::array<MapStatus, kMapSlots> maps;
    MeshInfo mesh_info{.title = "Sphere", .triangles = 16128, .vertices = 8385};
    EnvironmentInfo environment_info{.title = "Studio", .width = 1024, .height = 512, .max_radiance = 42.0f};
    std::vector<Panel> panels = builtin_panels();
    Viewport viewport;
    WorkLedger work;
    std::optional<UnsavedQuestion> unsaved;
    std::optional<RecoveryQuestion> recovery;
    std::optional<Drop> drop;
    std::optional<glm::vec2> drag_over;
    float scale;

    ItemRecorder recorder;
    Requests requests;       ///< since take_requests
    WorkspaceResult result;  ///< of the last frame

    explicit Stage(float width = 1280.0f, float height = 720.0f, float scale_ = 1.0f) : scale(scale_) {
        imgui_ = ImGui::CreateContext();
        ImGui::SetCurrentContext(imgui_);
        ImGuiIO& io = ImGui::GetIO();
        io.DisplaySize = {width, height};
        io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
        map_keys(io);
        apply_theme(scale);
        unsigned char* pixels = nullptr;
        io.Fonts->GetTexDataAsAlpha8(&pixels, &atlas_width, &atlas_height);
        io.Fonts->SetTexID(reinterpret_cast<ImTextureID>(font_texture));
        fill();
        frames(3);
    }
    ~Stage() { ImGui::DestroyContext(imgui_); }
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    static constexpr TextureId font_texture = 1;
    int atlas_width = 0, atlas_height = 0;

    void frame() {
        ImGui::SetCurrentContext(imgui_);
        ImGuiIO& io = ImGui::GetIO();
        io.DeltaTime = 1.0f / 60.0f;
        ImGui::NewFrame();
        PanelContext context{.material = material,
                             .view = view,
                             .camera = camera,
                             .mesh = mesh,
                             .environment = environment,
                             .ui = ui,
                             .browser = browser,
                             .import_sheet = import_sheet,
                             .saved_material = saved_material,
                             .saved_view = saved_view,
                             .home_camera = home_camera,
                             .catalog = catalog,
                             .status = status,
                             .maps = maps,
                             .mesh_info = mesh_info,
                             .environment_info = environment_info,
                             .panels = panels,
                             .viewport = viewport,
                             .unsaved = unsaved ? &*unsaved : nullptr,
                             .recovery = recovery ? &*recovery : nullptr,
                             .drop = drop ? &*drop : nullptr,
                             .drag_over = drag_over,
                             .scale = scale,
                             .recorder = &recorder};
        context.sheet = sheet ? &*sheet : nullptr;
        context.work = &work;
        context.sheet_cells = sheet_cells;
        draw_workspace(context);
        ImGui::Render();
        drop.reset();
        result = context.result;
        requests.insert(requests.end(), context.requests.begin(), context.requests.end());
        io.MouseWheel = 0.0f;
    }
    void frames(int count) {
        for (int i = 0; i < count; ++i) frame();
    }

    // ---- mouse ----
    const RecordedItem& item(std::string_view name) const {
        const RecordedItem* found = recorder.find(name);
        static const RecordedItem none;
        return found ? *found : none;
    }
    bool has(std::string_view name) const { return recorder.find(name) != nullptr; }
    glm::vec2 centre(std::string_view name) const {
        const Rect& r = item(name).visible;
        return {(r.x0 + r.x1) / 2, (r.y0 + r.y1) / 2};
    }
    void move_to(glm::vec2 at) {
        ImGui::SetCurrentContext(imgui_);
        ImGui::GetIO().MousePos = {at.x, at.y};
        frame();
    }
    void button(int which, bool down) {
        ImGui::SetCurrentContext(imgui_);
        ImGui::GetIO().MouseDown[which] = down;
        frame();
    }
    void click(std::string_view name, int which = 0) {
        move_to(centre(name));
        frame();
        button(which, true);
        button(which, false);
        frame();
    }
    void double_click(std::string_view name) {
        move_to(centre(name));
        frame();
        for (int i = 0; i < 2; ++i) {
            button(0, true);
            button(0, false);
        }
        frame();
    }
    void drag(std::string_view name, glm::vec2 by, int which = 0, int steps = 8) {
        const glm::vec2 from = centre(name);
        move_to(from);
        frame();
        button(which, true);
        for (int i = 1; i <= steps; ++i)
            move_to(from + by * (static_cast<float>(i) / static_cast<float>(steps)));
        button(which, false);
        frame();
    }
    void wheel(std::string_view name, float notches) {
        move_to(centre(name));
        ImGui::GetIO().MouseWheel = notches;
        frame();
        frame();
    }

    // ---- keyboard ----
    void modifiers(bool ctrl, bool shift) {
        ImGui::SetCurrentContext(imgui_);
        ImGui::GetIO().KeyCtrl = ctrl;
        ImGui::GetIO().KeyShift = shift;
    }
    void key(int which, bool ctrl = false, bool shift = false) {
        modifiers(ctrl, shift);
        ImGui::GetIO().KeysDown[which] = true;
        frame();
        ImGui::GetIO().KeysDown[which] = false;
        modifiers(false, false);
        frame();
    }
    void type(std::string_view text) {
        ImGui::SetCurrentContext(imgui_);
        for (const char c : text) ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(c));
        frame();
        frame();
    }

    template <class T>
    const T* asked() const {
        return find_request<T>(requests);
    }

private:
    ImGuiContext* imgui_ = nullptr;

    static void map_keys(ImGuiIO& io) {
        io.KeyMap[ImGuiKey_Tab] = KeyTab;
        io.KeyMap[ImGuiKey_LeftArrow] = KeyLeft;
        io.KeyMap[ImGuiKey_RightArrow] = KeyRight;
        io.KeyMap[ImGuiKey_UpArrow] = KeyUp;
        io.KeyMap[ImGuiKey_DownArrow] = KeyDown;
        io.KeyMap[ImGuiKey_PageUp] = KeyPageUp;
        io.KeyMap[ImGuiKey_PageDown] = KeyPageDown;
        io.KeyMap[ImGuiKey_Home] = KeyHome;
        io.KeyMap[ImGuiKey_End] = KeyEnd;
        io.KeyMap[ImGuiKey_Delete] = KeyDelete;
        io.KeyMap[ImGuiKey_Backspace] = KeyBackspace;
        io.KeyMap[ImGuiKey_Enter] = KeyEnter;
        io.KeyMap[ImGuiKey_Escape] = KeyEscape;
        io.KeyMap[ImGuiKey_KeyPadEnter] = KeyPadEnter;
        for (const int letter : {'A', 'C', 'V', 'X', 'Y', 'Z'})
            io.KeyMap[letter == 'A'   ? ImGuiKey_A
                      : letter == 'C' ? ImGuiKey_C
                      : letter == 'V' ? ImGuiKey_V
                      : letter == 'X' ? ImGuiKey_X
                      : letter == 'Y' ? ImGuiKey_Y
                                      : ImGuiKey_Z] = letter;
    }

    void fill() {
        catalog.presets = {{"/p/gold.json", "Gold", "Polished gold.", "Metals"},
                           {"/p/copper.json", "Copper", "Polished copper.", "Metals"},
                           {"/p/iron.json", "Iron", "Brushed iron.", "Metals"},
                           {"/p/rubber.json", "Rubber", "Black rubber.", "Dielectrics"},
                           {"/p/paper.json", "Paper", "White paper.", "Dielectrics"},
                           {"/p/tiles.json", "Glazed tiles with grout", "Every slot in use.", "With maps"}};
        catalog.environments = {
            {"studio", "Studio", "Softboxes in a dark room.", "Built-in"},
            {"sky", "Sky", "A clear day.", "Built-in"},
            {"night", "Night", "Small bright lamps.", "Built-in"},
            {"/e/peppermint_powerplant_4k.hdr", "peppermint_powerplant_4k", "A hall.", "Opened"}};
        catalog.meshes = {{"sphere", "Sphere", "Radius 1.", ""},
                          {"quad", "Quad", "Flat.", ""},
                          {"shaderball", "Shader ball", "Concave and convex.", ""}};
        catalog.recent = {"/home/ada/materials/gold.json"};
        status.title = "Untitled";
        status.version = "0.1.0";
        status.renderer = "no GPU";
        saved_material = material;
    }
};

}  // namespace patina::ui
