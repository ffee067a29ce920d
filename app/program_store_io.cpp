#include "app/program_store_io.h"

#include "renderer/core/file_io.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace patina {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostPrograms = 256;
constexpr std::uint64_t kLargestProgram = std::uint64_t{16} << 20;

/// Another process may do the same at the same time: what is gone is gone.
void drop_oldest(const fs::path& folder) {
    std::error_code ignored;
    std::vector<std::pair<fs::file_time_type, fs::path>> files;
    for (fs::directory_iterator each(folder, ignored), end; !ignored && each != end; each.increment(ignored))
        files.emplace_back(fs::last_write_time(each->path(), ignored), each->path());
    if (files.size() < kMostPrograms) return;
    std::ranges::sort(files);
    for (std::size_t i = 0; i < files.size() / 2; ++i) fs::remove(files[i].second, ignored);
}

}  // namespace

ProgramStore program_store_in(const fs::path& folder) {
    const auto load = [folder](const std::string& key) -> std::vector<std::byte> {
        std::error_code ignored;
        if (!fs::exists(folder / key, ignored)) return {};
        try {
            return read_file(folder / key, kLargestProgram);
        } catch (const std::runtime_error&) {
            return {};
        }
    };
    const auto save = [folder](const std::string& key, std::span<const std::byte> bytes) {
        try {
            std::error_code ignored;
            fs::create_directories(folder, ignored);
            drop_oldest(folder);
            write_file(folder / key, bytes);
        } catch (const std::runtime_error&) {  // a full disk: it is compiled again next time
        }
    };
    return {load, save};
}

}  // namespace patina
