// Where each region of the window goes. Pure numbers.
#pragma once

#include "ui/panel_context.h"

namespace patina::ui {

/// Regions that are hidden are empty. Together they cover the window without overlapping.
struct Layout {
    Rect menu, library, toolbar, viewport, inspector, drawer, status;
    Rect library_splitter, inspector_splitter, drawer_splitter;
};

struct LayoutInput {
    float width = 0.0f, height = 0.0f;  ///< of the window, display units
    float scale = 1.0f;
    float menu_height = 0.0f, status_height = 0.0f;
    float (*toolbar_height)(float width) = nullptr;
};
/// In a narrow window the side panels first shrink, then the library makes room.
Layout compute_layout(const UiState& ui, const LayoutInput& input);

}  // namespace patina::ui
