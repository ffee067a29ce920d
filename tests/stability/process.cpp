#include "tests/stability/process.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace patina::test {

namespace fs = std::filesystem;

namespace {

void limit(int resource, std::uint64_t bytes) {
    if (bytes == 0) return;
    const rlimit both{bytes, bytes};
    setrlimit(resource, &both);
}

[[noreturn]] void become(const std::vector<std::string>& words, const Surroundings& surroundings,
                         const Child& child) {
    dup2(open("/dev/null", O_RDONLY), 0);
    dup2(open(child.output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 1);
    dup2(open(child.errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 2);
    for (const auto& [name, value] : surroundings.environment) setenv(name.c_str(), value.c_str(), 1);
    if (!surroundings.folder.empty() && chdir(surroundings.folder.c_str()) != 0) _exit(127);
    limit(RLIMIT_AS, surroundings.address_space_bytes);
    limit(RLIMIT_FSIZE, surroundings.file_bytes);
    std::vector<std::string> copies = words;
    std::vector<char*> arguments;
    for (std::string& word : copies) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    execv(arguments[0], arguments.data());
    _exit(127);
}

fs::path new_name(const char* what) {
    std::string name = (fs::temp_directory_path() / (std::string("patina-") + what + "-XXXXXX")).string();
    const int descriptor = mkstemp(name.data());
    if (descriptor < 0) throw std::runtime_error("no temporary file could be made");
    close(descriptor);
    return name;
}

}  // namespace

Folder::Folder() {
    std::string name = (fs::temp_directory_path() / "patina-stability-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder could be made");
    path = name;
}
Folder::~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
}

Child start_process(const std::vector<std::string>& words, const Surroundings& surroundings) {
    Child child{-1, new_name("out"), new_name("err")};
    child.process = fork();
    if (child.process < 0) throw std::runtime_error("no process could be started");
    if (child.process == 0) become(words, surroundings, child);
    return child;
}

Ended wait_for(Child& child) {
    int status = 0;
    while (waitpid(child.process, &status, 0) < 0 && errno == EINTR) {
    }
    Ended ended{WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read_text(child.output),
                read_text(child.errors)};
    fs::remove(child.output);
    fs::remove(child.errors);
    return ended;
}

Ended run_process(const std::vector<std::string>& words, const Surroundings& surroundings) {
    Child child = start_process(words, surroundings);
    return wait_for(child);
}

Ended run_patina(const Folder& folder, std::vector<std::string> words, Surroundings surroundings) {
    words.insert(words.begin(), PATINA_PROGRAM);
    if (surroundings.folder.empty()) surroundings.folder = folder.path;
    surroundings.environment.emplace_back("PATINA_CACHE_DIR", (folder.path / ".cache").string());
    surroundings.environment.emplace_back("PATINA_STATE_DIR", (folder.path / ".state").string());
    surroundings.environment.emplace_back("DISPLAY", "");
    surroundings.environment.emplace_back("WAYLAND_DISPLAY", "");
    return run_process(words, surroundings);
}

std::vector<std::string> files_below(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) names.push_back(fs::relative(entry.path(), folder).generic_string());
    std::ranges::sort(names);
    return names;
}

std::string read_text(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}
void write_text(const fs::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

}  // namespace patina::test
