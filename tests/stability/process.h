// Programs started by tests: with words, environment and limits; what came of them; folders and files to look
// at.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <sys/types.h>
#include <utility>
#include <vector>

namespace patina::test {

/// A new empty folder, removed with everything in it.
struct Folder {
    Folder();
    ~Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    std::filesystem::path path;
};

struct Surroundings {
    std::vector<std::pair<std::string, std::string>> environment;  ///< set besides what there is
    std::filesystem::path folder;                                  ///< to work in; empty: this process's
    std::uint64_t address_space_bytes = 0;                         ///< 0: no limit
    std::uint64_t file_bytes = 0;                                  ///< largest file; 0: no limit
};
struct Child {
    pid_t process = -1;
    std::filesystem::path output, errors;
};
struct Ended {
    int exit_status = -1;  ///< 128 + the signal that ended it, as shells say it
    std::string output, errors;
};
Child start_process(const std::vector<std::string>& words, const Surroundings& surroundings);
Ended wait_for(Child& child);
Ended run_process(const std::vector<std::string>& words, const Surroundings& surroundings);
/// The program itself, without a display, its cache and state in the folder.
Ended run_patina(const Folder& folder, std::vector<std::string> words, Surroundings surroundings = {});

/// Relative, sorted; without standard output and error of processes.
std::vector<std::string> files_below(const std::filesystem::path& folder);
std::string read_text(const std::filesystem::path& file);
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace patina::test
