// Colours, fonts and measures of the interface. Neutral greys, so that colours beside them are judged fairly;
// one accent.
#pragma once

#include <imgui.h>

namespace patina::ui {

namespace color {
inline constexpr ImU32 kBar = IM_COL32(27, 27, 28, 255);  ///< menu, status line, toolbar
inline constexpr ImU32 kPanel = IM_COL32(37, 37, 38, 255);
inline constexpr ImU32 kCard = IM_COL32(46, 46, 47, 255);
inline constexpr ImU32 kCardHover = IM_COL32(54, 54, 55, 255);
inline constexpr ImU32 kField = IM_COL32(27, 27, 28, 255);  ///< where something is typed or dragged
inline constexpr ImU32 kFieldHover = IM_COL32(33, 33, 34, 255);
inline constexpr ImU32 kFill = IM_COL32(84, 86, 88, 255);  ///< the filled part of a slider
inline constexpr ImU32 kButton = IM_COL32(60, 60, 62, 255);
inline constexpr ImU32 kButtonHover = IM_COL32(74, 74, 76, 255);
inline constexpr ImU32 kButtonActive = IM_COL32(88, 88, 90, 255);
inline constexpr ImU32 kLine = IM_COL32(18, 18, 18, 255);  ///< between regions
inline constexpr ImU32 kOutline = IM_COL32(66, 66, 68, 255);
inline constexpr ImU32 kSurround = IM_COL32(119, 119, 119, 255);  ///< 18 % grey: around the picture
inline constexpr ImU32 kText = IM_COL32(226, 226, 226, 255);
inline constexpr ImU32 kMuted = IM_COL32(156, 156, 158, 255);
inline constexpr ImU32 kFaint = IM_COL32(128, 128, 130, 255);
inline constexpr ImU32 kAccent = IM_COL32(78, 186, 160, 255);  ///< verdigris
inline constexpr ImU32 kAccentDim = IM_COL32(47, 106, 92, 255);
inline constexpr ImU32 kAccentText = IM_COL32(12, 26, 22, 255);  ///< on kAccent
inline constexpr ImU32 kWarning = IM_COL32(222, 170, 84, 255);
inline constexpr ImU32 kError = IM_COL32(232, 112, 100, 255);
inline constexpr ImU32 kVeil = IM_COL32(46, 46, 47, 190);  ///< over what has no effect
inline constexpr ImU32 kShade = IM_COL32(0, 0, 0, 120);    ///< over pictures, under text
}  // namespace color

/// In the order they are added to the atlas.
enum class Face { Body, Strong, Small, Title };
inline constexpr int kFaces = 4;
ImFont* font_of(Face face);

/// A measure given at scale 1, in display units of the current theme.
float px(float at_scale_1);

}  // namespace patina::ui
