// Which files changed on disk since they were read. Polled: portable, and a poll that finds nothing costs no
// frame.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace patina {

struct FileStamp {
    bool exists = false;
    std::int64_t modified = 0;  ///< in the file system's own clock and unit
    std::uint64_t bytes = 0;
    bool operator==(const FileStamp&) const = default;
};
/// Never throws; what cannot be looked at does not exist.
FileStamp stamp_of(const std::filesystem::path& file);

/// Remembers how each file looked when it was read. Pure bookkeeping; who calls stamp_of, and when, is the
/// app's matter.
class Watch {
public:
    /// The file was read as it stood at that stamp (taken before reading, so that a later write is noticed).
    void saw(const std::string& file, const FileStamp& stamp);
    /// Files to look at from now on; others are forgotten.
    void keep_only(const std::vector<std::string>& files);
    std::vector<std::string> files() const;

    /// Takes what a poll found and gives the files that changed. One that looks different is reported when
    /// two polls in a row agree, so that a half-written file is left to its writer; a report makes the new
    /// look the known one.
    std::vector<std::string> changed(const std::vector<std::pair<std::string, FileStamp>>& polled);

private:
    struct Known {
        FileStamp read;
        FileStamp candidate;
        bool has_candidate = false;
    };
    std::map<std::string, Known> known_;
};

}  // namespace patina
