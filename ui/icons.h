// The icons in use, by their place in Font Awesome 4.7; merged into every font.
#pragma once

namespace patina::ui::icon {

// clang-format off
#define PATINA_ICONS(ICON) \
    ICON(kAdd, "\uf067") \
    ICON(kBack, "\uf060") \
    ICON(kBrowse, "\uf115") \
    ICON(kCamera, "\uf030") \
    ICON(kCheck, "\uf00c") \
    ICON(kClose, "\uf00d") \
    ICON(kCube, "\uf1b2") \
    ICON(kCopy, "\uf0c5") \
    ICON(kDown, "\uf107") \
    ICON(kError, "\uf06a") \
    ICON(kExposure, "\uf042") \
    ICON(kEye, "\uf06e") \
    ICON(kFile, "\uf016") \
    ICON(kFolder, "\uf07b") \
    ICON(kGrid, "\uf009") \
    ICON(kImage, "\uf03e") \
    ICON(kInfo, "\uf05a") \
    ICON(kLight, "\uf185") \
    ICON(kLocate, "\uf041") \
    ICON(kMaterial, "\uf1fc") \
    ICON(kPlus, "\uf067") \
    ICON(kReload, "\uf021") \
    ICON(kReset, "\uf0e2") \
    ICON(kSearch, "\uf002") \
    ICON(kTrash, "\uf1f8") \
    ICON(kUp, "\uf106") \
    ICON(kParent, "\uf062") \
    ICON(kWarning, "\uf071") \
    ICON(kWorking, "\uf254")
// clang-format on

#define PATINA_ICON_NAME(name, text) inline constexpr const char* name = text;
PATINA_ICONS(PATINA_ICON_NAME)
#undef PATINA_ICON_NAME

#define PATINA_ICON_TEXT(name, text) text
/// All of them in a row: of the font's others none is drawn.
inline constexpr const char* kAll = PATINA_ICONS(PATINA_ICON_TEXT);
#undef PATINA_ICON_TEXT
#undef PATINA_ICONS

}  // namespace patina::ui::icon
