// Maps from a photo in the editor: the photo, small maps to look at as the values change, and the files.
#pragma once

#include "app/jobs.h"
#include "app/shoot.h"
#include "renderer/core/map_settings.h"
#include "renderer/renderer.h"
#include "ui/panel_context.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace patina {

struct Editor;

struct EditorMaps {
    std::string file;  ///< that was read or is being read
    std::shared_ptr<const LoadedPhoto> photo;
    std::shared_ptr<const Image> small;  ///< the same with few pixels
    MapHandle raw;                       ///< to point into
    std::string error;                   ///< one sentence
    std::vector<std::string> notes;
    std::optional<MapSettings> previewed;  ///< what the previews show
    struct Previews {
        MapHandle rectified, even, albedo, height, normal, roughness, ao;
    };
    Previews previews;
    Jobs::Id read_job = 0, preview_job = 0, make_job = 0;
};

/// Once a frame while the page is shown: starts what is missing.
void update_maps(Editor& editor);
ui::MapsStatus maps_status(const Editor& editor);
bool maps_page_shown(const Editor& editor);

void set_map_photo(Editor& editor, const std::string& file);
/// The selected view's photo with its points, its balance relative to the light on a card there.
void take_map_photo_of_view(Editor& editor);
void pick_map_card(Editor& editor, const ui::request::PickMapCard& picked);
/// On a worker; then the document wears them.
void make_maps(Editor& editor);

}  // namespace patina
