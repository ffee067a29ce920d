// The program's own modules: parts kept out of its link because what they bring along is heavy, and loaded
// from a file when they are first needed. Knows no part of the program.
#pragma once

#include <filesystem>
#include <string>

namespace patina {

/// The folder of the running executable.
std::filesystem::path program_folder();

/// The address of symbol in the module of that name, which is loaded at its first use and stays until the
/// process ends: from PATINA_MODULE_DIR where that is set, else from lib/patina beside the executable's
/// folder, else from that folder itself. Throws std::runtime_error whose text says what is missing and where,
/// without a full stop.
void* module_symbol(const std::string& module, const char* symbol);

}  // namespace patina
