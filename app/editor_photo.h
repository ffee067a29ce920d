// Photos in the sheet's views: read, fitted and compared on workers, shown as textures. The fit itself is
// part of the comparison; this only keeps what is made from it.
#pragma once

#include "app/jobs.h"
#include "app/photo_hints.h"
#include "app/shoot.h"
#include "renderer/renderer.h"
#include "ui/panel_context.h"
#include "ui/requests.h"

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace patina {

struct Editor;

struct PhotoFile {
    std::shared_ptr<const LoadedPhoto> loaded;
    MapHandle raw;      ///< the whole photo, for pointing into it
    std::string error;  ///< one sentence
    Jobs::Id job = 0;
};

/// What one view shows of its photo, and what that was made from.
struct PhotoShown {
    std::optional<Photo> photo;
    glm::ivec2 size_px{0};
    std::uint64_t drawn = 0;  ///< how often the view had been drawn
    MapHandle fitted, heat, luminance;
    std::shared_ptr<const Image> linear;  ///< 4 channels, in the view's frame
    Residual residual;
    std::optional<HintSearch> search;               ///< under way
    std::optional<std::vector<std::string>> hints;  ///< once it has ended
    Jobs::Id job = 0;
};

struct EditorPhotos {
    std::map<std::string, PhotoFile> files;
    std::array<PhotoShown, 16> views;
    MeshHandle card;
    EnvironmentHandle white;  ///< radiance 1 from everywhere
    TargetHandle trial;       ///< where hints are tried
};

/// A view of the sheet as it is drawn now.
struct DrawnPhotoView {
    std::size_t view = 0;
    const RenderTarget* target = nullptr;  ///< null: not drawn yet
    std::uint64_t drawn = 0;
};
/// Starts what is missing for that view.
void update_photo(Editor& editor, const DrawnPhotoView& drawn);
/// Reads it where nobody has yet; null while it is read. Throws std::runtime_error where it cannot be had.
std::shared_ptr<const LoadedPhoto> loaded_photo(Editor& editor, const std::string& file);
/// One trial of what would bring the selected view closer to its photo, for when nothing else is going on.
void step_hints(Editor& editor);
/// step_hints() has something to do.
bool hints_wanted(const Editor& editor);
/// What the panels see of it.
void fill_photo(const Editor& editor, std::size_t view, ui::SheetCell& cell);

/// It is that view's from now on: of all views that share its lighting.
void set_photo(Editor& editor, int view, const std::string& file);

/// The colour that a card of that reflectance has in the view when it faces the camera upright.
glm::vec3 card_color(Editor& editor, std::size_t view, float reflectance);
/// Balances the view's photo by the card that was pointed at.
void pick_card(Editor& editor, const ui::request::PickCard& picked);

}  // namespace patina
