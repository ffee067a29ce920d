#include "app/paths.h"

#include "materials/text_io.h"
#include "renderer/core/module_io.h"

#include <cstdlib>

namespace patina {

namespace fs = std::filesystem;

namespace {

fs::path from_environment(const char* name) {
    const char* value = std::getenv(name);
    return value && *value ? utf8_to_path(value) : fs::path{};
}

/// The user's own folder for one kind of data: an override, the XDG variable, else the system's habit.
fs::path user_folder(const char* override_name, const char* xdg_name, const char* unix_habit,
                     const char* mac_habit, const char* windows_habit) {
    if (fs::path chosen = from_environment(override_name); !chosen.empty()) return chosen;
#ifdef _WIN32
    (void)xdg_name, (void)unix_habit, (void)mac_habit;
    fs::path base = from_environment("LOCALAPPDATA");
    return (base.empty() ? fs::temp_directory_path() : base) / "patina" / windows_habit;
#else
    (void)windows_habit;
    // The XDG specification has relative values ignored.
    if (fs::path base = from_environment(xdg_name); base.is_absolute()) return base / "patina";
    fs::path home = from_environment("HOME");
    if (home.empty()) return fs::temp_directory_path() / "patina";
#ifdef __APPLE__
    (void)unix_habit;
    return home / mac_habit / "patina";
#else
    (void)mac_habit;
    return home / unix_habit / "patina";
#endif
#endif
}

}  // namespace

fs::path share_folder() {
    if (fs::path chosen = from_environment("PATINA_SHARE_DIR"); !chosen.empty()) return chosen;
    return program_folder().parent_path() / "share" / "patina";
}

fs::path cache_folder() {
    return user_folder("PATINA_CACHE_DIR", "XDG_CACHE_HOME", ".cache", "Library/Caches", "cache");
}

fs::path state_folder() {
    return user_folder("PATINA_STATE_DIR", "XDG_STATE_HOME", ".local/state", "Library/Application Support",
                       "state");
}

std::string plain_stem(const std::filesystem::path& file, const std::string& otherwise) {
    std::string stem = path_to_utf8(file.stem());
    for (char& c : stem) {
        const bool plain =
            (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
        if (!plain && static_cast<unsigned char>(c) < 0x80) c = '_';
    }
    return stem.empty() ? otherwise : stem;
}

}  // namespace patina
