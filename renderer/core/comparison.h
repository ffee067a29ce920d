// A comparison as plain values compared with ==: presets as rows, lightings as columns, views of their own
// beside them, and the photos they are held against. Knows no file, no window and no GPU.
//
// A photo is addressed in fractions of itself, a view in fractions of the square in its middle, so that a
// comparison means the same in views of any shape: (0,0) the upper left corner, (1,1) the lower right one.
// Files are named by full path here, whatever a comparison file writes.
#pragma once

#include "renderer/core/camera.h"
#include "renderer/core/view.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace patina {

/// Where four points of the photo lie in the view: what makes a framed object line up with the rendered one.
struct PhotoFit {
    std::array<glm::vec2, 4> photo{glm::vec2{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    std::array<glm::vec2, 4> view{glm::vec2{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    bool operator==(const PhotoFit&) const = default;
};

/// A rectangle of the view, in fractions; x0 < x1, y0 < y1.
struct Region {
    float x0 = 0.0f, y0 = 0.0f, x1 = 1.0f, y1 = 1.0f;
    bool operator==(const Region&) const = default;
};

struct Photo {
    std::string file;
    std::string title;            ///< empty: the file's name
    std::optional<PhotoFit> fit;  ///< without: the whole photo in the middle of the view, not stretched
    float exposure_ev = 0.0f;     ///< the photo's linear values are multiplied by 2^exposure_ev, −30…30,
    glm::vec3 white_balance{1.0f};  ///< and by these, 0…100
    std::optional<Region> region;   ///< what is compared; without: all that the photo covers
    float opacity = 1.0f;           ///< over the render, 0…1
    std::string unknown_json;       ///< keys of a newer version, kept
    bool operator==(const Photo&) const = default;
};

/// What lights a view and how that is shown.
struct Lighting {
    std::string title;                   ///< empty: the environment's
    std::string environment = "studio";  ///< id or path
    float rotation_deg = 0.0f;           ///< −360…360, as View::env_rotation_deg
    float exposure_ev = 0.0f;            ///< −30…30
    Tonemap tonemap = Tonemap::Neutral;
    Background background = Background::Environment;
    glm::vec3 plain_color{0.18f};    ///< linear, 0…1
    std::optional<Camera> camera;    ///< of its own; without: the comparison's
    std::optional<Shading> shading;  ///< likewise; never the reference
    std::optional<Photo> photo;      ///< taken under this light
    std::string unknown_json;
    bool operator==(const Lighting&) const = default;
};

/// The preset that is being edited, where there is an editor.
inline constexpr std::string_view kEditedPreset = "edited";

struct ComparedPreset {
    std::string preset = std::string(kEditedPreset);  ///< path, "edited", or "-" for the default material
    std::string title;                                ///< empty: the material's name
    std::string unknown_json;
    bool operator==(const ComparedPreset&) const = default;
};

/// A view beside the grid.
struct FreeView {
    ComparedPreset preset;
    Lighting lighting;
    bool operator==(const FreeView&) const = default;
};

inline constexpr std::size_t kMaxComparisonRows = 1000;
inline constexpr std::size_t kMaxComparisonColumns = 64;
inline constexpr std::size_t kMaxFreeViews = 1000;

struct Comparison {
    std::string title, author, remarks;
    std::string mesh = "sphere";  ///< id or path
    Camera camera;                ///< of every view that has none of its own
    Shading shading = View{}.shading;
    Quality quality = View{}.quality;
    std::vector<ComparedPreset> rows;
    std::vector<Lighting> columns;  ///< the grid is rows × columns
    std::vector<FreeView> views;    ///< after it
    std::string unknown_json;
    bool operator==(const Comparison&) const = default;
};

/// One view of a comparison: where it stands, and what it shows.
struct ViewPlace {
    int row = -1, column = -1;  ///< of the grid, or
    int free = -1;              ///< which of the further views
    bool operator==(const ViewPlace&) const = default;
};
/// Row by row, then the further ones.
std::vector<ViewPlace> places_of(const Comparison& comparison);
const ComparedPreset& preset_at(const Comparison& comparison, ViewPlace place);
const Lighting& lighting_at(const Comparison& comparison, ViewPlace place);
ComparedPreset& preset_at(Comparison& comparison, ViewPlace place);
/// A column's light is that of every row.
Lighting& lighting_at(Comparison& comparison, ViewPlace place);

View view_of(const Comparison& comparison, const Lighting& lighting);
const Camera& camera_of(const Comparison& comparison, const Lighting& lighting);
/// The light of a view as a lighting; what a view does not know is default.
Lighting lighting_of(const View& view, const std::string& environment);

// Editing, each a value in, a value out. Precondition: the place exists.

/// Two views side by side: the edited material under this light and under another.
Comparison first_comparison(const Lighting& light, const std::string& mesh, const Camera& camera);
Comparison with_column_after(Comparison comparison, int column, Lighting light);
Comparison with_row_after(Comparison comparison, int row, ComparedPreset preset);
/// A view of its own that shows what that one shows.
Comparison with_duplicate(Comparison comparison, ViewPlace place);
/// A view of its own goes; of the grid, its column goes, or its row where it is the only column. The last
/// view stays.
Comparison without(Comparison comparison, ViewPlace place);
/// Turns the light of one view's lighting, or of all.
Comparison with_turned_light(Comparison comparison, std::optional<ViewPlace> place, float degrees);

/// Columns of a grid of so many cells of that aspect (width / height) that fill a region best.
int grid_columns(std::size_t cells, float region_aspect, float cell_aspect);

/// A few words for the undo menu; empty if nothing differs.
std::string describe_comparison_change(const Comparison& before, const Comparison& after);

}  // namespace patina
