// What benchmarks need that start this program, or another one, and measure it from outside.
#pragma once

#include "materials/text_io.h"

#include <cstdlib>
#include <filesystem>
#include <string>

namespace patina {

/// Of this process and those it starts.
inline void set_variable(const char* name, const std::string& value) {
#ifdef _WIN32
    _putenv_s(name, value.c_str());
#else
    setenv(name, value.c_str(), 1);
#endif
}

inline void remove_variable(const char* name) {
#ifdef _WIN32
    _putenv_s(name, "");
#else
    unsetenv(name);
#endif
}

/// As one word of a command line.
inline std::string quoted(const std::filesystem::path& path) { return "\"" + path_to_utf8(path) + "\""; }

}  // namespace patina
