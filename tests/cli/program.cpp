#include "tests/cli/program.h"

#include <algorithm>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

namespace patina::test {

namespace fs = std::filesystem;

namespace {

std::string read_all(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

[[noreturn]] void become(const std::vector<std::string>& words, const fs::path& folder) {
    const std::string out = (folder / ".stdout").string();
    const std::string err = (folder / ".stderr").string();
    dup2(open("/dev/null", O_RDONLY), 0);
    dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 1);
    dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 2);
    setenv("PATINA_CACHE_DIR", (folder / ".cache").c_str(), 1);
    setenv("PATINA_STATE_DIR", (folder / ".state").c_str(), 1);
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    if (chdir(folder.c_str()) != 0) _exit(127);
    std::string program = PATINA_PROGRAM;
    std::vector<char*> arguments{program.data()};
    std::vector<std::string> copies = words;
    for (std::string& word : copies) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    execv(program.c_str(), arguments.data());
    _exit(127);
}

}  // namespace

int Outcome::error_lines() const { return int(std::ranges::count(errors, '\n')); }

Workspace::Workspace() {
    std::string name = (fs::temp_directory_path() / "patina-cli-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder could be made");
    folder_ = name;
}

Workspace::~Workspace() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

Outcome Workspace::run(const std::vector<std::string>& words) const {
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("no process could be started");
    if (child == 0) become(words, folder_);
    int status = 0;
    waitpid(child, &status, 0);
    Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_all(folder_ / ".stdout"),
                    read_all(folder_ / ".stderr")};
    fs::remove(folder_ / ".stdout");
    fs::remove(folder_ / ".stderr");
    return outcome;
}

std::vector<std::string> Workspace::files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
        const std::string name = fs::relative(entry.path(), folder_).generic_string();
        if (!name.starts_with(".cache") && !name.starts_with(".state") && entry.is_regular_file())
            names.push_back(name);
    }
    std::ranges::sort(names);
    return names;
}

void Workspace::write(const std::string& name, const std::string& content) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << content;
}

std::string Workspace::read(const std::string& name) const { return read_all(folder_ / name); }

}  // namespace patina::test
