#include "ui/layout.h"

#include <algorithm>
#include <cmath>

namespace patina::ui {
namespace {

// At scale 1.
constexpr float kSplitter = 4.0f;
constexpr float kLeastLibrary = 180.0f;
constexpr float kLeastInspector = 312.0f;
constexpr float kLeastViewport = 300.0f;
constexpr float kMostOfWidth = 0.45f;

struct Columns {
    float library = 0.0f, inspector = 0.0f;
};

Columns compute_columns(const UiState& ui, float width, float scale) {
    const float least_viewport = kLeastViewport * scale, splitter = kSplitter * scale;
    const auto wanted = [&](bool shown, float wish, float least) {
        if (!shown) return 0.0f;
        return std::round(std::max(least * scale, std::min(wish * scale, kMostOfWidth * width)));
    };
    Columns c{wanted(ui.show_library, ui.library_width, kLeastLibrary),
              wanted(ui.show_inspector, ui.inspector_width, kLeastInspector)};
    float missing = c.library + c.inspector + 2.0f * splitter + least_viewport - width;
    const auto shrink = [&](float& column, float least) {
        const float given = std::clamp(missing, 0.0f, std::max(0.0f, column - std::round(least * scale)));
        column -= given;
        missing -= given;
    };
    if (c.library > 0.0f) shrink(c.library, kLeastLibrary);
    if (c.inspector > 0.0f) shrink(c.inspector, kLeastInspector);
    if (missing > 0.0f && c.library > 0.0f && c.inspector > 0.0f) c.library = 0.0f;
    c.library = std::floor(c.library);
    c.inspector = std::floor(std::min(c.inspector, std::max(0.0f, width - splitter - 1.0f)));
    return c;
}

}  // namespace

Layout compute_layout(const UiState& ui, const LayoutInput& input) {
    Layout l;
    const float width = input.width, height = input.height, splitter = std::round(kSplitter * input.scale);
    l.menu = {0.0f, 0.0f, width, input.menu_height};
    l.status = {0.0f, height - input.status_height, width, height};
    const float top = l.menu.y1;
    float bottom = l.status.y0;
    if (!ui.drawer.empty()) {
        const float most = std::max(0.0f, (bottom - top) * 0.6f);
        const float drawer = std::floor(std::min(ui.drawer_height * input.scale, most));
        l.drawer = {0.0f, bottom - drawer, width, bottom};
        bottom -= drawer + splitter;
        l.drawer_splitter = {0.0f, bottom, width, bottom + splitter};
    }
    const Columns columns = compute_columns(ui, width, input.scale);
    float left = 0.0f, right = width;
    if (columns.library > 0.0f) {
        l.library = {0.0f, top, columns.library, bottom};
        left = columns.library + splitter;
        l.library_splitter = {columns.library, top, left, bottom};
    }
    if (columns.inspector > 0.0f) {
        l.inspector = {width - columns.inspector, top, width, bottom};
        right = width - columns.inspector - splitter;
        l.inspector_splitter = {right, top, right + splitter, bottom};
    }
    const float bar = std::min(input.toolbar_height(right - left), bottom - top);
    l.toolbar = {left, top, right, top + bar};
    l.viewport = {left, top + bar, right, bottom};
    return l;
}

}  // namespace patina::ui
