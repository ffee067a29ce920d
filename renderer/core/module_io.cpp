#include "renderer/core/module_io.h"

#include "renderer/core/file_io.h"

#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <system_error>
#include <vector>

#ifdef _WIN32
#include <windows.h>
#else
#include <dlfcn.h>
#ifdef __APPLE__
#include <mach-o/dyld.h>
#endif
#endif

namespace patina {
namespace {

namespace fs = std::filesystem;

/// The file's code and data in this process, or why not.
struct Opened {
    void* handle = nullptr;
    std::string problem;
};

#ifdef _WIN32
constexpr const char* kSuffix = ".dll";

Opened open_module(const fs::path& file) {
    // Its own folder is searched for what it needs, besides the usual ones.
    void* handle = LoadLibraryExW(file.c_str(), nullptr, LOAD_WITH_ALTERED_SEARCH_PATH);
    if (handle) return {handle, {}};
    return {nullptr, std::system_category().message(static_cast<int>(GetLastError()))};
}

void* find_symbol(void* handle, const char* symbol) {
    return reinterpret_cast<void*>(GetProcAddress(static_cast<HMODULE>(handle), symbol));
}
#else
constexpr const char* kSuffix = ".so";

Opened open_module(const fs::path& file) {
    void* handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    const char* problem = handle ? nullptr : dlerror();
    return {handle, problem ? problem : ""};
}

void* find_symbol(void* handle, const char* symbol) { return dlsym(handle, symbol); }
#endif

/// Where a module is looked for.
std::vector<fs::path> module_folders() {
    const char* chosen = std::getenv("PATINA_MODULE_DIR");
    if (chosen && *chosen) {
        const std::string text(chosen);
        return {fs::path(std::u8string(text.begin(), text.end()))};
    }
    const fs::path folder = program_folder();
    return {folder.parent_path() / "lib" / "patina", folder};
}

}  // namespace

fs::path program_folder() {
    std::error_code ignored;
#ifdef _WIN32
    std::wstring name(32768, L'\0');
    name.resize(GetModuleFileNameW(nullptr, name.data(), static_cast<DWORD>(name.size())));
    return fs::path(name).parent_path();
#elif defined(__APPLE__)
    std::string name(4096, '\0');
    auto size = static_cast<std::uint32_t>(name.size());
    if (_NSGetExecutablePath(name.data(), &size) != 0) return fs::current_path(ignored);
    return fs::weakly_canonical(fs::path(name.c_str()), ignored).parent_path();
#else
    const fs::path name = fs::read_symlink("/proc/self/exe", ignored);
    return name.empty() ? fs::current_path(ignored) : name.parent_path();
#endif
}

void* module_symbol(const std::string& module, const char* symbol) {
    const std::string file_name = module + kSuffix;
    const std::vector<fs::path> folders = module_folders();
    for (const fs::path& folder : folders) {
        const fs::path file = folder / file_name;
        std::error_code ignored;
        if (!fs::exists(file, ignored)) continue;
        const Opened opened = open_module(file);
        if (!opened.handle)
            throw std::runtime_error("the module " + path_text(file) + " cannot be loaded (" +
                                     opened.problem + ")");
        if (void* found = find_symbol(opened.handle, symbol)) return found;
        throw std::runtime_error("the module " + path_text(file) + " is of another version of the program");
    }
    throw std::runtime_error("the module " + file_name + " is not in " + path_text(folders.front()));
}

}  // namespace patina
