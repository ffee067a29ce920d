// Compiled shader programs in the cache folder: a file each, the oldest give way.
#pragma once

#include "renderer/core/program_store.h"

#include <filesystem>

namespace patina {

ProgramStore program_store_in(const std::filesystem::path& folder);

}  // namespace patina
