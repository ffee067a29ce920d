// The icons in use, by their place in Font Awesome 4.7; merged into every font.
#pragma once

namespace patina::ui::icon {

inline constexpr const char* kAdd = "\uf067";
inline constexpr const char* kBack = "\uf060";
inline constexpr const char* kBrowse = "\uf115";
inline constexpr const char* kCamera = "\uf030";
inline constexpr const char* kCheck = "\uf00c";
inline constexpr const char* kClose = "\uf00d";
inline constexpr const char* kCube = "\uf1b2";
inline constexpr const char* kCopy = "\uf0c5";
inline constexpr const char* kDown = "\uf107";
inline constexpr const char* kError = "\uf06a";
inline constexpr const char* kExposure = "\uf042";
inline constexpr const char* kEye = "\uf06e";
inline constexpr const char* kFile = "\uf016";
inline constexpr const char* kFolder = "\uf07b";
inline constexpr const char* kGrid = "\uf009";
inline constexpr const char* kImage = "\uf03e";
inline constexpr const char* kInfo = "\uf05a";
inline constexpr const char* kLight = "\uf185";
inline constexpr const char* kLocate = "\uf041";
inline constexpr const char* kMaterial = "\uf1fc";
inline constexpr const char* kPlus = "\uf067";
inline constexpr const char* kReload = "\uf021";
inline constexpr const char* kReset = "\uf0e2";
inline constexpr const char* kSearch = "\uf002";
inline constexpr const char* kTrash = "\uf1f8";
inline constexpr const char* kUp = "\uf106";
inline constexpr const char* kParent = "\uf062";
inline constexpr const char* kWarning = "\uf071";
inline constexpr const char* kWorking = "\uf254";

}  // namespace patina::ui::icon
