// Runs the built program as a person would, and looks at what came of it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace patina::test {

struct Outcome {
    int exit_status = -1;  ///< −1: it was ended by a signal
    std::string output;    ///< standard output
    std::string errors;    ///< standard error
    int error_lines() const;
};

/// A new empty folder, removed with everything in it. Holds a cache folder of its own for the programs it
/// runs.
class Workspace {
public:
    Workspace();
    ~Workspace();
    Workspace(const Workspace&) = delete;
    Workspace& operator=(const Workspace&) = delete;
    const std::filesystem::path& folder() const { return folder_; }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    /// Starts the program with these words, its working folder and cache inside this workspace and no
    /// display, and waits.
    Outcome run(const std::vector<std::string>& words) const;
    /// Every file below the workspace but the cache's, relative, sorted.
    std::vector<std::string> files() const;
    void write(const std::string& name, const std::string& content) const;
    std::string read(const std::string& name) const;

private:
    std::filesystem::path folder_;
};

}  // namespace patina::test
