#include "app/driver_cache.h"

#include "materials/text_io.h"

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace patina {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t kEnoughBytes = std::uintmax_t{64} << 20;

/// Where Mesa keeps it: $MESA_SHADER_CACHE_DIR, else $XDG_CACHE_HOME, else ~/.cache.
fs::path driver_cache_folder() {
    for (const char* name : {"MESA_SHADER_CACHE_DIR", "MESA_GLSL_CACHE_DIR", "XDG_CACHE_HOME"})
        if (const char* folder = std::getenv(name); folder && *folder) return utf8_to_path(folder);
    const char* home = std::getenv("HOME");
    return home && *home ? utf8_to_path(home) / ".cache" : fs::path{};
}

/// The disk that a folder would be made on.
fs::space_info space_at(fs::path folder) {
    std::error_code failure;
    while (!folder.empty() && !fs::exists(folder, failure) && folder != folder.parent_path())
        folder = folder.parent_path();
    return fs::space(folder, failure);  // all ones where it cannot be told
}

}  // namespace

void keep_driver_off_a_full_disk() {
#ifdef __linux__
    if (space_at(driver_cache_folder()).available >= kEnoughBytes) return;
    for (const char* name : {"MESA_SHADER_CACHE_DISABLE", "MESA_GLSL_CACHE_DISABLE"})
        ::setenv(name, "true", 0);
#endif
}

}  // namespace patina
