// A new empty folder that goes with everything in it.
#pragma once

#include <filesystem>
#include <string>

namespace patina {

class TemporaryFolder {
public:
    /// In the system's folder for such things; its name begins with stem.
    explicit TemporaryFolder(const std::string& stem);
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace patina
