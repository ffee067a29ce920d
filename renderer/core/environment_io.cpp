#include "renderer/core/environment_io.h"

#include "renderer/core/file_io.h"
#include "renderer/core/hash.h"
#include "renderer/core/image_io.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <system_error>

namespace patina {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kHashedAtOnce = std::size_t{1} << 17;  ///< bytes that stay in a core's own cache

/// What a folder holds, in the order of the names; nothing where it cannot be read.
std::vector<fs::path> entries(const fs::path& folder) {
    std::vector<fs::path> result;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
        result.push_back(it->path());
    std::sort(result.begin(), result.end());
    return result;
}

void add_panoramas(const fs::path& root, std::vector<EnvironmentFile>& found) {
    for (const fs::path& file : entries(root / "datafiles" / "studiolights" / "world")) {
        const std::string extension = path_text(file.extension());
        if (extension != ".exr" && extension != ".hdr") continue;
        std::string name = path_text(file.stem());
        const std::string id = "blender-" + name;
        if (std::any_of(found.begin(), found.end(),
                        [&](const EnvironmentFile& other) { return other.id == id; }))
            continue;
        if (!name.empty()) name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
        found.push_back({.id = id, .title = name + " (Blender)", .file = file});
    }
}

/// The folder itself and what lies below it, where versions have folders of their own; the latest version
/// first.
void search(const fs::path& folder, int depth, std::vector<EnvironmentFile>& found) {
    add_panoramas(folder, found);
    if (depth == 0) return;
    std::vector<fs::path> below = entries(folder);
    std::reverse(below.begin(), below.end());
    std::error_code error;
    for (const fs::path& entry : below)
        if (fs::is_directory(entry, error)) search(entry, depth - 1, found);
}

}  // namespace

Environment load_environment_file(const fs::path& file) {
    LoadedImage loaded = load_image(file);
    Environment environment = make_environment(loaded.image, path_text(file), path_text(file.stem()));
    environment.notes.insert(environment.notes.begin(), loaded.notes.begin(), loaded.notes.end());
    return environment;
}

std::optional<std::uint64_t> environment_file_hash(const fs::path& file) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return std::nullopt;
    std::ifstream in(file, std::ios::binary);
    std::array<char, kHashedAtOnce> bytes;
    std::uint64_t hash = 0;
    while (in.read(bytes.data(), bytes.size()) || in.gcount() > 0)
        hash = hash_bytes(std::as_bytes(std::span(bytes)).first(std::size_t(in.gcount())), hash);
    if (in.bad() || !in.eof()) return std::nullopt;  // whoever decodes it says what is wrong
    return hash;
}

std::vector<EnvironmentFile> list_blender_studio_lights(std::span<const fs::path> folders) {
    std::vector<EnvironmentFile> found;
    for (const fs::path& folder : folders) search(folder, 2, found);
    std::sort(found.begin(), found.end(),
              [](const EnvironmentFile& a, const EnvironmentFile& b) { return a.id < b.id; });
    return found;
}

std::vector<EnvironmentFile> list_blender_studio_lights() {
    const std::array<fs::path, 6> folders{"/usr/share/blender",
                                          "/usr/local/share/blender",
                                          "/opt/blender",
                                          "/snap/blender/current",
                                          "/Applications/Blender.app/Contents/Resources",
                                          "C:/Program Files/Blender Foundation"};
    return list_blender_studio_lights(folders);
}

}  // namespace patina
