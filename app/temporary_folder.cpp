#include "app/temporary_folder.h"

#include <chrono>
#include <system_error>

namespace patina {

TemporaryFolder::TemporaryFolder(const std::string& stem) {
    const auto stamp = std::chrono::steady_clock::now().time_since_epoch().count();
    path_ = std::filesystem::temp_directory_path() / (stem + "-" + std::to_string(stamp));
    std::filesystem::create_directories(path_);
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace patina
