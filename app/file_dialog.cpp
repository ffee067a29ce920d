#include "app/file_dialog.h"

#include "materials/text_io.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <ctime>

#ifdef _WIN32
#include <shellapi.h>
#include <windows.h>
#else
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __APPLE__
extern char** environ;
#endif
#endif

namespace patina {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxEntries = 10000;

std::string when(const fs::directory_entry& entry) {
    std::error_code failure;
    const auto modified = entry.last_write_time(failure);
    if (failure) return {};
    // The file clock's epoch is its own; the difference to its now carries over to the system clock.
    const auto age = fs::file_time_type::clock::now() - modified;
    const auto system = std::chrono::system_clock::now() -
                        std::chrono::duration_cast<std::chrono::system_clock::duration>(age);
    const std::time_t time = std::chrono::system_clock::to_time_t(system);
    std::tm local{};
#ifdef _WIN32
    localtime_s(&local, &time);
#else
    localtime_r(&time, &local);
#endif
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M", &local);
    return text.data();
}

ui::BrowserEntry describe(const fs::directory_entry& entry) {
    std::error_code ignored;
    ui::BrowserEntry described{.name = path_to_utf8(entry.path().filename()),
                               .path = path_to_utf8(entry.path()),
                               .is_folder = entry.is_directory(ignored),
                               .modified = when(entry)};
    if (!described.is_folder) {
        const auto bytes = entry.file_size(ignored);
        described.bytes = ignored ? 0 : bytes;
    }
    return described;
}

void add_place(std::vector<ui::BrowserPlace>& places, const std::string& title, const fs::path& folder) {
    std::error_code ignored;
    if (folder.empty() || !fs::is_directory(folder, ignored)) return;
    const std::string path = path_to_utf8(folder);
    const bool known = std::any_of(places.begin(), places.end(),
                                   [&](const ui::BrowserPlace& place) { return place.path == path; });
    if (!known) places.push_back({title, path});
}

void add_media(std::vector<ui::BrowserPlace>& places, const fs::path& folder) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored))
        add_place(places, path_to_utf8(entry.path().filename()), entry.path());
}

}  // namespace

FolderListing list_files(const fs::path& folder) {
    FolderListing listing;
    std::error_code failure;
    const fs::path full = fs::absolute(folder, failure).lexically_normal();
    listing.folder = path_to_utf8(full);
    if (listing.folder.size() > 1 && listing.folder.back() == '/') listing.folder.pop_back();
    fs::directory_iterator entry(full, failure);
    for (const fs::directory_iterator end; !failure && entry != end; entry.increment(failure)) {
        const std::string name = path_to_utf8(entry->path().filename());
        if (name.empty() || name[0] == '.') continue;
        listing.entries.push_back(describe(*entry));
        if (listing.entries.size() < kMaxEntries) continue;
        listing.error = "Only the first " + std::to_string(kMaxEntries) + " files are listed.";
        break;
    }
    if (failure) listing.error = listing.folder + " cannot be read: " + failure.message() + ".";
    return listing;
}

fs::path home_folder() {
    for (const char* name : {"HOME", "USERPROFILE"})
        if (const char* home = std::getenv(name); home && *home) return utf8_to_path(home);
    std::error_code ignored;
    return fs::current_path(ignored);
}

std::vector<ui::BrowserPlace> browser_places(const std::vector<ui::BrowserPlace>& extra) {
    std::vector<ui::BrowserPlace> places;
    const fs::path home = home_folder();
    add_place(places, "Home", home);
    for (const char* name : {"Desktop", "Documents", "Downloads", "Pictures"})
        add_place(places, name, home / name);
    for (const ui::BrowserPlace& place : extra) add_place(places, place.title, utf8_to_path(place.path));
#ifdef _WIN32
    for (char drive = 'A'; drive <= 'Z'; ++drive)
        add_place(places, std::string{drive, ':'}, fs::path(std::string{drive, ':', '\\'}));
#else
    add_place(places, "Computer", "/");
#ifdef __APPLE__
    add_media(places, "/Volumes");
#else
    if (const char* user = std::getenv("USER"); user && *user) {
        add_media(places, fs::path("/media") / user);
        add_media(places, fs::path("/run/media") / user);
    }
#endif
#endif
    return places;
}

bool reveal_in_file_manager(const fs::path& path) {
    std::error_code ignored;
    const fs::path folder = fs::is_directory(path, ignored) ? path : path.parent_path();
#ifdef _WIN32
    return reinterpret_cast<std::intptr_t>(
               ShellExecuteW(nullptr, L"open", folder.c_str(), nullptr, nullptr, SW_SHOWNORMAL)) > 32;
#else
#ifdef __APPLE__
    std::string program = "open";
#else
    std::string program = "xdg-open";
#endif
    std::string argument = folder.string();
    std::array<char*, 3> words{program.data(), argument.data(), nullptr};
    pid_t child = 0;
    if (::posix_spawnp(&child, program.c_str(), nullptr, nullptr, words.data(), environ) != 0) return false;
    ::waitpid(child, nullptr, WNOHANG);
    return true;
#endif
}

}  // namespace patina
