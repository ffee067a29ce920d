// Where compiled shader programs are kept between runs; who keeps them is told from outside.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace patina {

/// key: a file name that names driver, shaders and this format. Neither throws; what cannot be kept is
/// compiled again.
struct ProgramStore {
    std::function<std::vector<std::byte>(const std::string& key)> load;  ///< empty where there is none
    std::function<void(const std::string& key, std::span<const std::byte> bytes)> save;
};

}  // namespace patina
