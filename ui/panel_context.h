// Everything the panels see and change in one frame: plain data in, edits and requests out. Knows no ImGui,
// no GL, no file.
//
// The app keeps the referenced values, fills the const ones before draw_workspace and reads requests and
// result after it. A texture is an opaque id (what the ImGui backend takes as ImTextureID); 0 is none.
#pragma once

#include "materials/material.h"
#include "renderer/core/camera.h"
#include "renderer/core/comparison.h"
#include "renderer/core/ledger.h"
#include "renderer/core/map_settings.h"
#include "renderer/core/metrics.h"
#include "renderer/core/view.h"
#include "ui/recorder.h"
#include "ui/requests.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace patina::ui {

struct PanelContext;
using TextureId = std::uintptr_t;

/// One page of the workspace. Left pages are tabs of the library, right ones tabs of the inspector, bottom
/// ones drawers.
enum class Side { Left, Right, Bottom };
struct Panel {
    std::string id;
    std::string title;
    std::string description;  ///< the tab's tooltip
    Side side = Side::Right;
    std::function<void(PanelContext&)> draw;
};

// ---- what there is to choose from ----

struct CatalogItem {
    std::string id;  ///< environment or mesh id ("studio", or a path); a preset's path
    std::string title;
    std::string description;  ///< one sentence; the tooltip
    std::string group;        ///< heading it stands under ("Metals", "Built-in", "Opened"); may be empty
    TextureId thumbnail = 0;  ///< 0: not there yet, a placeholder is drawn
};
struct Catalog {
    bool presets_are_read = false;  ///< else there may be more
    std::vector<CatalogItem> presets;
    std::vector<CatalogItem> environments;  ///< thumbnails 2:1
    std::vector<CatalogItem> meshes;
    std::vector<std::string> recent;  ///< preset paths, newest first
};

// ---- what the program is doing ----

enum class MapState { None, Loading, Ok, Missing, Broken };
struct MapStatus {
    MapState state = MapState::None;
    std::string message;                      ///< one sentence when missing or broken, else empty
    std::string full_path;                    ///< resolved; for Reveal and the tooltip
    int width = 0, height = 0, channels = 0;  ///< once loaded
    int bits = 0;                             ///< 8, 16 or 32 a channel
    std::uint64_t file_bytes = 0;
    TextureId thumbnail = 0;
};

enum class Severity { Info, Warning, Error };
struct LogLine {
    Severity severity = Severity::Info;
    std::string text;  ///< one sentence
    std::string time;  ///< "14:03:07"
    int count = 1;     ///< the same line so many times in a row
};
struct JobLine {
    std::uint64_t id = 0;
    std::string label;      ///< "Baking peppermint_powerplant"
    float progress = 0.0f;  ///< 0…1; < 0: not known
    bool can_cancel = true;
};
struct Status {
    std::string text;  ///< when nothing runs: "Saved gold.json"; empty: "Ready"
    Severity severity = Severity::Info;
    std::vector<JobLine> jobs;
    std::vector<LogLine> log;  ///< oldest first
    std::string title;         ///< the document's: "gold", "Untitled"
    std::string file;          ///< its path, empty when never saved
    bool dirty = false;
    bool can_undo = false, can_redo = false;
    std::string undo_what, redo_what;   ///< "Roughness"; may be empty
    std::uint64_t frames_rendered = 0;  ///< of the viewport: stands still while nothing changes
    std::string renderer;               ///< GL renderer and version, for Help
    std::string version;
};

/// What lies under the current mesh and environment ids, once loaded; empty while loading or after a failure.
struct MeshInfo {
    std::string title;
    std::uint64_t triangles = 0, vertices = 0;
    bool has_uvs = true;
    std::vector<std::string> notes;
};
struct EnvironmentInfo {
    std::string title;
    int width = 0, height = 0;
    float max_radiance = 0.0f;
    std::vector<std::string> notes;
};

// ---- questions ----

enum class Unsaved { Material, Comparison };
struct UnsavedQuestion {
    std::string title;   ///< of the material or the comparison
    std::string action;  ///< what waits: "open Gold", "close Patina"
    Unsaved what = Unsaved::Material;
};
struct RecoveryQuestion {
    std::string title;
    std::string when;  ///< "today at 14:03"
};

/// One decision of an import: this channel of this file goes to that slot. A packed file has one row a slot.
struct ImportRow {
    std::string file;  ///< full path
    std::string name;  ///< as shown
    TextureId thumbnail = 0;
    std::optional<MapSlot> slot;  ///< empty: the file is left out
    Channel channel = Channel::R;
    bool invert = false;
    ColorSpace color_space = ColorSpace::Linear;
    NormalConvention convention = NormalConvention::OpenGl;
    std::string reason;  ///< one sentence: "“_nor_dx” means a DirectX normal map"
};
struct ImportSheet {
    std::string title;  ///< the set's name
    std::vector<ImportRow> rows;
    std::vector<std::string> notes;  ///< "height.png has no slot and is left out"
    bool rename_material = true;     ///< give the material the set's name
    std::string mesh;                ///< a mesh that lay with the maps; empty: none, or several
    bool use_mesh = true;            ///< show the material on it
    std::string environment;         ///< an environment that lay with them; empty: none, or several
    bool use_environment = true;     ///< light the material by it
};

// ---- the file browser ----

enum class BrowserPurpose {
    // In the order of the browser's own table.
    OpenPreset,
    SavePreset,
    AssignMap,
    LocateMap,
    ImportFolder,
    OpenEnvironment,
    OpenMesh,
    ExportRender,
    OpenComparison,
    SaveComparison,
    ChoosePhoto,
    ExportReport,
    ChooseMapPhoto
};
struct BrowserEntry {
    std::string name;
    std::string path;
    bool is_folder = false;
    std::uint64_t bytes = 0;
    std::string modified;  ///< "2026-03-01 14:03"
};
struct BrowserPlace {
    std::string title;  ///< "Home", "Presets", "/media/usb"
    std::string path;
};
/// Panels open it with open_browser() (or the app with the same fields) and ask for ListFolder; the app fills
/// the listing unsorted and unfiltered by name, all files; the panel sorts and filters by extension and
/// search text.
struct FileBrowser {
    bool open = false;
    BrowserPurpose purpose = BrowserPurpose::OpenPreset;
    MapSlot slot = MapSlot::Albedo;  ///< AssignMap, LocateMap
    // By the app:
    std::string folder;
    std::vector<BrowserEntry> entries;
    std::vector<BrowserPlace> places;
    std::string error;  ///< one sentence: why the folder cannot be read
    std::vector<std::string>
        extensions;  ///< lower case, what can be read; empty: the usual ones for the purpose
    // By the panel:
    std::string search;
    std::string selected;   ///< path
    std::string file_name;  ///< SavePreset, ExportRender
    std::string typed_folder;
    std::string new_folder;      ///< the name being typed for one
    bool naming_folder = false;  ///< the keyboard belongs to it
    bool show_all = false;       ///< also files of other types
};

// ---- the interface's own state, nothing of the document ----

/// What is seen in a photo's place.
enum class PhotoLayer { Photo, DeltaE, Luminance };

/// What the mouse does on the selected view's photo.
enum class PhotoTool { None, Fit, GreyCard, WhitePaper, Region };

/// The slider bar that is held: where its drag began.
struct BarDrag {
    float from_x = 0.0f;
    float from_fraction = 0.0f;
    bool fine = false;
};

/// What one side of the viewport shows: the picture as the view is set, one shading mode, or how far the
/// view's shading is from the reference.
struct Layer {
    enum Kind { View, Mode, Error, Flip, Signed };
    Kind kind = View;
    Shading mode = Shading::Reference;
    bool operator==(const Layer&) const = default;
};
struct AccuracySettings {
    Layer left;  ///< the whole viewport without a split
    Layer right{Layer::Mode, Shading::Reference};
    bool split = false;
    float split_at = 0.5f;  ///< of the viewport's width
    bool blink = false;     ///< the two take turns instead of standing beside each other
    bool meter = false;     ///< the accuracy drawer is open: measure
};
/// Of the reference that gathers and of the last measurement.
struct AccuracyStatus {
    int samples = 0;
    double half_width = 0.0;  ///< relative 95 % half-width that 95 of 100 pixels keep; 0: not known yet
    bool converged = false, done = false;
    bool measured = false;
    double rms = 0.0, p95 = 0.0, max = 0.0, flip = 0.0;
    double frame_ms = 0.0;  ///< GPU time of the shading pass
};

/// How the enlarged view of the sheet is held against another one, or against its photo.
enum class AbHow { Split, Blink, Signed, Relative, Flip };
inline constexpr int kAgainstNothing = -1, kAgainstPhoto = -2;
struct AbSettings {
    int against = kAgainstNothing;  ///< a view of the sheet, or one of these
    AbHow how = AbHow::Split;
    float split_at = 0.5f;
    bool split_held = false;  ///< the line is dragged
};
/// A pixel's linear radiance and display values in 0…255.
struct PixelValue {
    glm::vec3 radiance{0.0f};
    glm::ivec3 display{0};
};
/// Of both pictures of a view, where they are there.
struct ProbeValues {
    std::optional<PixelValue> first, second;
};
/// The mouse over a view: of the sheet, or −1, the one view.
struct ProbedPoint {
    int view = -1;
    glm::vec2 at{0.0f};  ///< fraction of it, (0,0) the upper left corner
};

/// What maps are made from, and how.
struct PhotoToMaps {
    std::string photo;  ///< file; empty: none is chosen
    MapSettings settings;
    MapChoice choice;
    std::string name;           ///< of the files
    bool picking_card = false;  ///< the next click on the photo is a grey card
    bool held = false;          ///< a corner is being dragged in this frame
};
/// What of them is there to be seen.
struct MapsStatus {
    TextureId photo = 0;  ///< first row at the top, as all of these
    TextureId rectified = 0, even = 0, albedo = 0, height = 0, normal = 0, roughness = 0, ao = 0;
    glm::ivec2 photo_px{0};
    std::string error;  ///< one sentence
    std::vector<std::string> notes;
    bool making = false;      ///< files are being made
    bool view_photo = false;  ///< the comparison's selected view has a photo
};

struct UiState {
    AbSettings ab;
    PhotoToMaps maps;
    AccuracySettings accuracy;
    bool split_drag = false;          ///< the split's line is held
    std::string left_tab, right_tab;  ///< panel ids; empty: the first
    std::string drawer;               ///< open bottom panel's id; empty: closed
    bool show_library = true;
    bool show_inspector = true;
    float library_width = 244.0f;  ///< at scale 1
    float inspector_width = 348.0f;
    float drawer_height = 190.0f;
    std::string search_presets, search_environments, search_meshes;
    bool show_shortcuts = false;  ///< open the `?` sheet in the next frame
    bool show_about = false;
    bool log_only_problems = false;
    std::uint64_t log_seen = 0;               ///< lines of the log that were shown
    std::array<bool, kMapSlots> slot_open{};  ///< map options unfolded
    int export_width = 1920, export_height = 1080;
    request::ExportWhat export_what = request::ExportWhat::Picture;
    bool focus_search = false;        ///< the library's search field takes the keyboard next frame
    std::optional<MapSlot> hit_slot;  ///< slot under the last drop, flashed for a moment
    std::optional<int> hit_view;      ///< view of the sheet under the last drop
    double hit_time = 0.0;
    BarDrag bar_drag;
    glm::vec3 emission_color{1.0f};  ///< of a black emission, so that its strength can be raised again
    bool rotating_light = false;     ///< the viewport drag under way turns the light
    bool viewport_drag = false;
    int sheet_selected = 0;       ///< which view of the sheet the panels edit
    int sheet_enlarged = -1;      ///< the view that fills the sheet; < 0: all are seen
    bool sheet_turn_all = false;  ///< turning the light turns that of every view
    PhotoTool photo_tool = PhotoTool::None;
    PhotoLayer photo_layer = PhotoLayer::Photo;
    bool photo_held = false;        ///< a point or rectangle is being dragged in this frame
    bool report_reference = false;  ///< the report holds every view against the reference, too
    float photo_wipe = 0.0f;        ///< where the photo begins, from the view's left, 0…1
    glm::vec2 region_from{0.0f};    ///< where the rectangle under the mouse began
    bool viewport_used = false;     ///< the artist knows how to turn the object: no hint
};

struct Drop {
    std::vector<std::string> files;
    glm::vec2 position{0.0f};  ///< display coordinates
};

struct Viewport {
    TextureId texture = 0;  ///< the display picture; 0: nothing to show yet
    bool bottom_up = true;  ///< its first row is the bottom (OpenGL)
    struct Picture {
        TextureId texture = 0;  ///< 0: the display picture stands in
        bool bottom_up = true;
    };
    Picture left, right;  ///< what UiState::accuracy asks for
    AccuracyStatus accuracy;
};

/// One view of the sheet, in the order of places_of().
struct SheetCell {
    TextureId texture = 0;
    std::string preset, light;  ///< titles
    std::string error;          ///< one sentence: what of it could not be had
    TextureId photo =
        0;  ///< in the view's frame, its coverage as alpha; first row at the top, as the next two
    TextureId photo_raw = 0;            ///< the whole photo
    TextureId heat = 0, luminance = 0;  ///< the differences
    glm::ivec2 photo_px{0};             ///< size of the photo; 0: not read yet
    std::string photo_about;            ///< camera and exposure
    std::string residual;               ///< "ΔE 3.2 · light +4 %"
    /// What would bring the render closer to the photo, one sentence each; nullopt: not known yet.
    std::optional<std::vector<std::string>> hints;
};
/// A view of the sheet that is seen, and the framebuffer pixels its picture should have.
struct SheetSize {
    int view = 0;
    glm::ivec2 size_px{0};
};

/// What the app needs to know after a frame.
struct WorkspaceResult {
    glm::ivec2 viewport_size_px{0};  ///< framebuffer pixels the picture should have; 0×0: hidden
    bool viewport_active = false;    ///< orbiting, panning or turning the light
    bool item_active = false;        ///< a slider or text field is held: an undo step is not finished
    std::vector<SheetSize> sheet;    ///< while the sheet is shown
    std::optional<ProbedPoint> probed;
    bool turn_all_lights = false;  ///< a turn of the light in this frame is meant for all views
    bool wants_redraw = false;     ///< something moves by itself: draw another frame soon
    double redraw_in_s = std::numeric_limits<double>::infinity();  ///< something changes by itself then
    std::string_view shelf;               ///< of the library, that is open: "library.presets", …
    std::vector<std::string> cards_seen;  ///< ids of its items that are not scrolled out of sight
};

struct PanelContext {
    // Edited in place.
    Material& material;
    View& view;
    Camera& camera;
    std::string& mesh;         ///< catalog id or path
    std::string& environment;  ///< catalog id or path
    UiState& ui;
    FileBrowser& browser;
    std::optional<ImportSheet>& import_sheet;

    // What the document's file holds (Material{} and View{} for a new one): differing values are marked.
    const Material& saved_material;
    const View& saved_view;
    const Camera& home_camera;  ///< where Home and a double-click in the viewport go back to

    // Seen.
    const Catalog& catalog;
    const Status& status;
    const std::array<MapStatus, kMapSlots>& maps;
    const MeshInfo& mesh_info;
    const EnvironmentInfo& environment_info;
    const std::vector<Panel>& panels;  ///< builtin_panels() and whatever the registry adds
    Viewport viewport;
    /// Views side by side instead of the one viewport; view, environment and mesh above are then those of the
    /// selected view. Texts are edited in place, views come and go by requests. nullptr: none is shown.
    Comparison* sheet = nullptr;
    std::vector<SheetCell> sheet_cells;
    std::string sheet_file;  ///< empty: never saved
    bool sheet_unsaved = false;
    Viewport::Picture ab_map;  ///< what UiState::ab asks for, where it is a map
    ProbeValues probe;         ///< under the mouse
    MapsStatus maps_status;
    const WorkLedger* work = nullptr;  ///< counted since the start, or since request::ClearWork
    const UnsavedQuestion* unsaved = nullptr;
    const RecoveryQuestion* recovery = nullptr;
    const Drop* drop = nullptr;  ///< dropped since the last frame; panels turn it into request::Dropped
    std::optional<glm::vec2> drag_over;  ///< files are dragged over this point, where the system tells
    float scale = 1.0f;                  ///< of the interface: 1 = 96 dpi

    // Out.
    Requests requests;
    WorkspaceResult result;
    bool escape_taken = false;         ///< by an open list or menu: no panel acts on it in this frame
    ItemRecorder* recorder = nullptr;  ///< filled anew when there
};

}  // namespace patina::ui
