#include "app/watch.h"

#include <algorithm>

namespace patina {

namespace fs = std::filesystem;

FileStamp stamp_of(const fs::path& file) {
    std::error_code failure;
    const fs::file_status status = fs::status(file, failure);
    if (failure || !fs::is_regular_file(status)) return {};
    FileStamp stamp{.exists = true};
    const auto bytes = fs::file_size(file, failure);
    if (!failure) stamp.bytes = bytes;
    const auto modified = fs::last_write_time(file, failure);
    if (!failure) stamp.modified = modified.time_since_epoch().count();
    return stamp;
}

void Watch::saw(const std::string& file, const FileStamp& stamp) { known_[file] = {.read = stamp}; }

void Watch::keep_only(const std::vector<std::string>& files) {
    std::erase_if(known_, [&](const auto& entry) {
        return std::find(files.begin(), files.end(), entry.first) == files.end();
    });
}

std::vector<std::string> Watch::files() const {
    std::vector<std::string> files;
    for (const auto& [file, known] : known_) files.push_back(file);
    return files;
}

std::vector<std::string> Watch::changed(const std::vector<std::pair<std::string, FileStamp>>& polled) {
    std::vector<std::string> changed;
    for (const auto& [file, stamp] : polled) {
        const auto found = known_.find(file);
        if (found == known_.end()) continue;
        Known& known = found->second;
        if (stamp == known.read) {
            known.has_candidate = false;
        } else if (known.has_candidate && known.candidate == stamp) {
            known = {.read = stamp};
            changed.push_back(file);
        } else {
            known.candidate = stamp;
            known.has_candidate = true;
        }
    }
    return changed;
}

}  // namespace patina
