#include "ui/theme.h"

#include "ui/icons.h"
#include "ui/workspace.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>

namespace patina::embedded {
std::span<const unsigned char> fonts(std::string_view file_name);
}

namespace patina::ui {
namespace {

constexpr float kBodySize = 14.0f;

struct FaceRow {
    const char* file;
    float size;
    bool every_script;  ///< also Greek, Cyrillic and rare Latin: names of files and materials
};
constexpr FaceRow kFaceRows[kFaces] = {
    {"Inter-Regular.otf", kBodySize, true},
    {"Inter-SemiBold.otf", kBodySize, true},
    {"Inter-Regular.otf", 12.0f, true},
    {"Inter-SemiBold.otf", 22.0f, false},
};

constexpr ImWchar kCommonRanges[] = {
    0x0020, 0x017f,                                  // Latin, Latin-1, Latin Extended-A
    0x2010, 0x2027, 0x2030, 0x203a, 0x2070, 0x2094,  // dashes, quotes, dots, super- and subscripts
    0x20ac, 0x20ac, 0x2190, 0x2199, 0x21e7, 0x21e7,  // €, arrows, shift
    0x2212, 0x2212, 0x2248, 0x2248, 0x2260, 0x2265,  // −, ≈, ≠ ≤ ≥
    0x2318, 0x2318, 0,                               // ⌘
};
constexpr ImWchar kAllRanges[] = {
    0x0020, 0x024f,                                  // Latin to Extended-B
    0x0300, 0x036f, 0x0370, 0x03ff, 0x0400, 0x04ff,  // combining marks, Greek, Cyrillic
    0x1e00, 0x1eff,                                  // Vietnamese and others
    0x2010, 0x2027, 0x2030, 0x203a, 0x2070, 0x2094,  //
    0x20ac, 0x20ac, 0x2190, 0x2199, 0x21e7, 0x21e7,  //
    0x2212, 0x2212, 0x2248, 0x2248, 0x2260, 0x2265,  //
    0x2318, 0x2318, 0,
};

void add_font(ImFontAtlas& atlas, std::string_view file, float size_px, const ImWchar* ranges, bool icons) {
    const std::span<const unsigned char> bytes = embedded::fonts(file);
    IM_ASSERT(!bytes.empty());
    ImFontConfig config;
    config.FontDataOwnedByAtlas = false;
    config.OversampleH = icons ? 1 : 2;
    config.OversampleV = 1;
    config.PixelSnapH = true;
    config.MergeMode = icons;
    if (icons) {
        config.GlyphMinAdvanceX = std::round(size_px * 1.15f);
        config.GlyphOffset.y = std::round(size_px * 0.04f);
    }
    // The atlas only reads the bytes; its interface predates const.
    atlas.AddFontFromMemoryTTF(const_cast<unsigned char*>(bytes.data()), static_cast<int>(bytes.size()),
                               size_px, &config, ranges);
}

}  // namespace

/// No side is a power of two, like those of most pictures: a software renderer compiles the interface's
/// shader anew for those that are.
void build_fonts(ImFontAtlas& atlas, float scale) {
    if (atlas.IsBuilt() && atlas.ConfigData.front().SizePixels == std::round(kFaceRows[0].size * scale))
        return;
    atlas.Clear();
    atlas.Flags |= ImFontAtlasFlags_NoPowerOfTwoHeight;
    atlas.TexDesiredWidth = scale > 1.6f ? 4000 : 2000;
    ImFontGlyphRangesBuilder icons;
    icons.AddText(icon::kAll);
    ImVector<ImWchar> icon_ranges;
    icons.BuildRanges(&icon_ranges);
    for (const FaceRow& face : kFaceRows) {
        const float size = std::round(face.size * scale);
        add_font(atlas, face.file, size, face.every_script ? kAllRanges : kCommonRanges, false);
        add_font(atlas, "fontawesome-webfont.ttf", std::round(size * 0.93f), icon_ranges.Data, true);
    }
    atlas.Build();
}

namespace {

void set_color(ImGuiCol slot, ImU32 value) {
    ImGui::GetStyle().Colors[slot] = ImGui::ColorConvertU32ToFloat4(value);
}

void set_colors() {
    ImGui::StyleColorsDark();
    set_color(ImGuiCol_Text, color::kText);
    set_color(ImGuiCol_TextDisabled, color::kFaint);
    set_color(ImGuiCol_TextSelectedBg, color::kAccentDim);
    set_color(ImGuiCol_WindowBg, color::kPanel);
    set_color(ImGuiCol_ChildBg, IM_COL32(0, 0, 0, 0));
    set_color(ImGuiCol_PopupBg, IM_COL32(43, 43, 44, 255));
    set_color(ImGuiCol_MenuBarBg, color::kBar);
    set_color(ImGuiCol_Border, color::kOutline);
    set_color(ImGuiCol_FrameBg, color::kField);
    set_color(ImGuiCol_FrameBgHovered, color::kFieldHover);
    set_color(ImGuiCol_FrameBgActive, color::kFieldHover);
    set_color(ImGuiCol_Button, color::kButton);
    set_color(ImGuiCol_ButtonHovered, color::kButtonHover);
    set_color(ImGuiCol_ButtonActive, color::kButtonActive);
    set_color(ImGuiCol_Header, IM_COL32(58, 60, 61, 255));
    set_color(ImGuiCol_HeaderHovered, IM_COL32(66, 69, 69, 255));
    set_color(ImGuiCol_HeaderActive, color::kAccentDim);
    set_color(ImGuiCol_CheckMark, color::kAccent);
    set_color(ImGuiCol_SliderGrab, color::kMuted);
    set_color(ImGuiCol_SliderGrabActive, color::kAccent);
    set_color(ImGuiCol_Separator, IM_COL32(56, 56, 57, 255));
    set_color(ImGuiCol_ScrollbarBg, IM_COL32(0, 0, 0, 0));
    set_color(ImGuiCol_ScrollbarGrab, IM_COL32(72, 72, 74, 255));
    set_color(ImGuiCol_ScrollbarGrabHovered, IM_COL32(92, 92, 94, 255));
    set_color(ImGuiCol_ScrollbarGrabActive, IM_COL32(110, 110, 112, 255));
    set_color(ImGuiCol_PlotHistogram, color::kAccent);
    set_color(ImGuiCol_TableHeaderBg, color::kBar);
    set_color(ImGuiCol_TableBorderLight, IM_COL32(52, 52, 53, 255));
    set_color(ImGuiCol_TableBorderStrong, IM_COL32(52, 52, 53, 255));
    set_color(ImGuiCol_TableRowBgAlt, IM_COL32(255, 255, 255, 6));
    set_color(ImGuiCol_NavHighlight, color::kAccent);
    set_color(ImGuiCol_ModalWindowDimBg, IM_COL32(0, 0, 0, 130));
}

}  // namespace

ImFont* font_of(Face face) {
    const ImVector<ImFont*>& fonts = ImGui::GetIO().Fonts->Fonts;
    const int index = static_cast<int>(face);
    return index < fonts.Size ? fonts[index] : ImGui::GetFont();
}

float px(float at_scale_1) {
    const ImGuiIO& io = ImGui::GetIO();
    const float body = font_of(Face::Body)->FontSize * io.FontGlobalScale;
    return std::round(at_scale_1 * body / kBodySize);
}

void apply_theme(float scale, float framebuffer_scale) {
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle{};
    style.WindowPadding = {12.0f, 10.0f};
    style.WindowRounding = 0.0f;
    style.WindowBorderSize = 0.0f;
    style.WindowMinSize = {1.0f, 1.0f};
    style.ChildRounding = 5.0f;
    style.ChildBorderSize = 0.0f;
    style.PopupRounding = 6.0f;
    style.PopupBorderSize = 1.0f;
    style.FramePadding = {8.0f, 4.0f};
    style.FrameRounding = 4.0f;
    style.FrameBorderSize = 0.0f;
    style.ItemSpacing = {8.0f, 6.0f};
    style.ItemInnerSpacing = {6.0f, 4.0f};
    style.CellPadding = {6.0f, 4.0f};
    style.ScrollbarSize = 10.0f;
    style.ScrollbarRounding = 5.0f;
    style.GrabMinSize = 8.0f;
    style.GrabRounding = 3.0f;
    style.ScaleAllSizes(scale);
    style.WindowMinSize = {1.0f, 1.0f};
    style.PopupBorderSize = 1.0f;
    style.AntiAliasedLinesUseTex = true;
    set_colors();

    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.ConfigInputTextCursorBlink = false;  // a blinking cursor would redraw the window for ever
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    io.FontGlobalScale = 1.0f / framebuffer_scale;
    build_fonts(*io.Fonts, scale * framebuffer_scale);
}

}  // namespace patina::ui
