// Where the widgets of the last frame were, by name: for tests and for driving the window from a script.
// Knows no ImGui.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace patina::ui {

/// In ImGui's display coordinates, y down.
struct Rect {
    float x0 = 0.0f, y0 = 0.0f, x1 = 0.0f, y1 = 0.0f;
    float width() const { return x1 - x0; }
    float height() const { return y1 - y0; }
    bool contains(float x, float y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
    bool overlaps(const Rect& other) const {
        return x0 < other.x1 && other.x0 < x1 && y0 < other.y1 && other.y0 < y1;
    }
};

struct RecordedItem {
    Rect rect;     ///< as laid out, perhaps scrolled out of sight
    Rect visible;  ///< the part inside its panel; empty when out of sight
    Rect panel;    ///< the panel that it scrolls in
    bool enabled = true;
    float missing_width = 0.0f;  ///< > 0: so much of its text does not fit
    std::string tooltip;
};

/// Names are paths: "menu.file.save", "material.roughness.slider", "library.presets.search",
/// "panel.viewport". Filled anew in every frame.
struct ItemRecorder {
    std::map<std::string, RecordedItem, std::less<>> items;

    const RecordedItem* find(std::string_view name) const {
        const auto found = items.find(name);
        return found == items.end() ? nullptr : &found->second;
    }
};

}  // namespace patina::ui
