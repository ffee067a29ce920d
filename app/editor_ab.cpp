#include "app/editor_ab.h"

#include "app/editor_state.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

std::optional<DifferenceKind> kind_of(ui::AbHow how) {
    if (how == ui::AbHow::Signed) return DifferenceKind::Signed;
    if (how == ui::AbHow::Relative) return DifferenceKind::Relative;
    if (how == ui::AbHow::Flip) return DifferenceKind::Flip;
    return std::nullopt;
}

const DrawnPhotoView* find(std::span<const DrawnPhotoView> drawn, int view) {
    const auto found =
        std::ranges::find_if(drawn, [&](const DrawnPhotoView& each) { return int(each.view) == view; });
    return found != drawn.end() && found->target ? &*found : nullptr;
}

/// Three channels of a photo; where it does not reach, those of the render: no difference.
Image over(const Image& photo, const Image& render) {
    Image result = make_image(render.width, render.height, 3, PixelType::F32);
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x)
            for (int c = 0; c < 3; ++c)
                set_texel(result, x, y, c, texel(texel(photo, x, y, 3) > 0.5f ? photo : render, x, y, c));
    return result;
}

glm::ivec2 pixel_at(glm::vec2 at, glm::ivec2 size) { return glm::ivec2(glm::floor(at * glm::vec2(size))); }

bool inside(glm::vec2 at) { return at.x >= 0.0f && at.y >= 0.0f && at.x < 1.0f && at.y < 1.0f; }

void compare_pair(Editor& editor, const AbPair& pair, const Image& first, Image second) {
    editor.ab.made = pair;
    editor.ab.job = editor.jobs.start(
        "Comparing the two",
        [&editor, pair, first = std::make_shared<const Image>(first),
         second = std::make_shared<const Image>(std::move(second))](JobContext&) -> Jobs::Done {
            const auto map = std::make_shared<const Image>(difference_picture(*first, *second, pair.kind));
            return [&editor, map] {
                editor.ab.map = editor.renderer.upload_thumbnail(*map);
                ++editor.changes;
            };
        },
        [&editor](const std::string& error) { log_line(editor, ui::Severity::Error, error); });
}

}  // namespace

void update_ab(Editor& editor, std::span<const DrawnPhotoView> drawn) {
    const ui::AbSettings& ab = editor.ui.ab;
    const auto kind = kind_of(ab.how);
    const DrawnPhotoView* first = find(drawn, editor.ui.sheet_enlarged);
    if (!editor.document.sheet || !kind || !first || ab.against == ui::kAgainstNothing) {
        editor.ab = {};
        return;
    }
    if (editor.jobs.is_running(editor.ab.job) || editor.ui.viewport_drag || editor.ui.photo_held) return;
    const glm::ivec2 size = Renderer::size_px(*first->target);
    AbPair pair{editor.ui.sheet_enlarged, ab.against, *kind, first->drawn, 0, {}, size};
    if (ab.against == ui::kAgainstPhoto) {
        const PhotoShown& shown = editor.photos.views[first->view];
        if (!shown.linear || glm::ivec2(shown.linear->width, shown.linear->height) != size) return;
        pair.photo = shown.photo;
        if (editor.ab.made == pair) return;
        const Image render = editor.renderer.read_radiance(*first->target);
        return compare_pair(editor, pair, over(*shown.linear, render), render);
    }
    const DrawnPhotoView* second = find(drawn, ab.against);
    if (!second || Renderer::size_px(*second->target) != size) return;
    pair.second = second->drawn;
    if (editor.ab.made == pair) return;
    compare_pair(editor, pair, editor.renderer.read_radiance(*second->target),
                 editor.renderer.read_radiance(*first->target));
}

std::optional<ui::PixelValue> value_at(Renderer& renderer, const RenderTarget& target, glm::vec2 at) {
    if (!inside(at)) return std::nullopt;
    const Renderer::PixelValue pixel = renderer.read_pixel(target, pixel_at(at, Renderer::size_px(target)));
    return ui::PixelValue{pixel.radiance, pixel.display};
}

std::optional<ui::PixelValue> value_at(const Image& photo, glm::vec2 at) {
    if (!inside(at)) return std::nullopt;
    const glm::ivec2 pixel = pixel_at(at, {photo.width, photo.height});
    if (photo.channels == 4 && texel(photo, pixel.x, pixel.y, 3) < 0.5f) return std::nullopt;
    ui::PixelValue value;
    for (int c = 0; c < 3; ++c) {
        value.radiance[c] = texel(photo, pixel.x, pixel.y, c);
        value.display[c] =
            int(std::lround(255.0f * std::clamp(linear_to_srgb(value.radiance[c]), 0.0f, 1.0f)));
    }
    return value;
}

}  // namespace patina
