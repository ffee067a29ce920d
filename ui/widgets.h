// The interface's building blocks: every widget is named, so that tests and scripts find it, and explains
// itself in a tooltip. A name is a path such as "toolbar.mesh"; it is also the widget's identity.
#pragma once

#include "ui/names.h"
#include "ui/panel_context.h"
#include "ui/theme.h"

#include <imgui.h>

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace patina::ui {

/// Notes the last ImGui item under a name, if somebody records.
void record(PanelContext& context, std::string_view name, std::string_view tooltip = {},
            float missing_width = 0.0f);
/// Likewise, a rectangle that is no item.
void record_rect(PanelContext& context, std::string_view name, const Rect& rect);

/// Explains the last item after the mouse rested on it for a moment, with a picture where there is one.
void explain(PanelContext& context, std::string_view text, TextureId picture = 0);
/// Something changes by itself then: a frame is drawn that shows it, and none before for that.
void redraw_in(PanelContext& context, double seconds);
/// record and explain.
void finish_item(PanelContext& context, std::string_view name, std::string_view tooltip,
                 float missing_width = 0.0f);

/// Begins a fixed part of the window; end with end_region. Its rectangle is recorded as "panel.<name>".
struct RegionStyle {
    ImU32 background = color::kPanel;
    ImVec2 padding{12.0f, 10.0f};  ///< at scale 1
    ImGuiWindowFlags flags = 0;
};
void begin_region(PanelContext& context, std::string_view name, const Rect& rect,
                  const RegionStyle& style = {});
void end_region();

/// Text that never leaves width (0: what is left of the line): cut with an ellipsis, whole in the tooltip.
void text_line(PanelContext& context, std::string_view text, ImU32 text_color = color::kText,
               float width = 0.0f);
/// Text over several lines, width display units wide (0: what is left of the line).
void text_wrapped(std::string_view text, ImU32 text_color = color::kText, Face face = Face::Body,
                  float width = 0.0f);
/// A quiet heading above a group of rows.
void heading(std::string_view text);

enum class Emphasis { Normal, Primary, Quiet };
struct ButtonStyle {
    Emphasis emphasis = Emphasis::Normal;
    float width = 0.0f;  ///< display units; 0: as wide as its text
    bool enabled = true;
};
bool button(PanelContext& context, std::string_view name, std::string_view text, std::string_view tooltip,
            const ButtonStyle& style = {});
/// A square button of frame height with one icon.
bool icon_button(PanelContext& context, std::string_view name, const char* icon, std::string_view tooltip,
                 bool enabled = true);

bool checkbox(PanelContext& context, std::string_view name, const char* text, std::string_view tooltip,
              bool& value);

/// InputText on a std::string, as wide as width (0: what is left of the line).
struct TextFieldStyle {
    const char* hint = "";
    const char* icon = nullptr;  ///< drawn inside, on the left
    float width = 0.0f;
    bool take_focus = false;
    ImGuiInputTextFlags flags = 0;
};
bool text_field(PanelContext& context, std::string_view name, std::string& text, std::string_view tooltip,
                const TextFieldStyle& style = {});
/// With a magnifier, and a cross that empties it.
bool search_field(PanelContext& context, std::string_view name, std::string& text, const char* hint,
                  bool take_focus);

struct Option {
    std::string_view title;
    std::string_view tooltip;
};
/// One of few, side by side. Each option is recorded as "<name>.<title in lower case>".
bool segmented(PanelContext& context, std::string_view name, std::span<const Option> options, int& index,
               float width = 0.0f);

/// One of many, in a list that opens. Options are recorded like segmented's while it is open.
struct ComboStyle {
    const char* icon = nullptr;
    float width = 0.0f;
    std::string_view tooltip;
    std::string_view preview;  ///< shown instead of the chosen option's title
};
bool combo(PanelContext& context, std::string_view name, std::span<const Option> options, int& index,
           const ComboStyle& style = {});

template <class T, std::size_t n>
std::array<Option, n> options_of(const std::array<Named<T>, n>& table) {
    std::array<Option, n> options;
    for (std::size_t i = 0; i < n; ++i) options[i] = {table[i].title, table[i].tooltip};
    return options;
}
template <class T, std::size_t n>
int index_of(const std::array<Named<T>, n>& table, T value) {
    for (std::size_t i = 0; i < n; ++i)
        if (table[i].value == value) return static_cast<int>(i);
    return 0;
}

struct Tab {
    std::string_view id;
    std::string_view title;
    std::string_view tooltip;
};
/// Tabs with an underline; current becomes the id of the chosen one. Recorded as "<name>.<id>".
void tab_strip(PanelContext& context, std::string_view name, std::span<const Tab> tabs, std::string& current);

/// A picture with its title beneath. aspect = width / height of the picture.
struct CardStyle {
    float width = 0.0f;
    float aspect = 1.0f;
    const char* placeholder = nullptr;  ///< icon while there is no picture
    bool selected = false;
};
bool card(PanelContext& context, std::string_view name, const CatalogItem& item, const CardStyle& style);

/// A picture in a rounded square; placeholder icon when texture is 0. No item.
void draw_thumbnail(const Rect& rect, TextureId texture, const char* placeholder, ImU32 outline = 0);

/// A thin bar that fills from the left; an unknown amount (< 0) is drawn as a dim full bar.
void progress_bar(float fraction, const ImVec2& size);

}  // namespace patina::ui
