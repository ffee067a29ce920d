// Two pictures of the sheet in one view: the map of their difference, made on a worker, and the values under
// the mouse.
#pragma once

#include "app/editor_photo.h"
#include "app/jobs.h"
#include "renderer/core/metrics.h"
#include "renderer/renderer.h"
#include "ui/panel_context.h"

#include <optional>
#include <span>

namespace patina {

struct Editor;

/// What a map of differences was made from.
struct AbPair {
    int view = -1, against = ui::kAgainstNothing;
    DifferenceKind kind = DifferenceKind::Signed;
    std::uint64_t first = 0, second = 0;  ///< how often the pictures had been drawn
    std::optional<Photo> photo;
    glm::ivec2 size_px{0};
    bool operator==(const AbPair&) const = default;
};
struct EditorAb {
    MapHandle map;
    std::optional<AbPair> made;
    Jobs::Id job = 0;
};

/// Starts what is missing; drawn: the views as they are seen now.
void update_ab(Editor& editor, std::span<const DrawnPhotoView> drawn);

/// Of a picture at a fraction of it, (0,0) the upper left corner; nullopt outside.
std::optional<ui::PixelValue> value_at(Renderer& renderer, const RenderTarget& target, glm::vec2 at);
/// Likewise, of a photo in the view's frame; nullopt where it does not reach.
std::optional<ui::PixelValue> value_at(const Image& photo, glm::vec2 at);

}  // namespace patina
