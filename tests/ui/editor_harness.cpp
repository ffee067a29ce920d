#include "tests/ui/editor_harness.h"

#include "renderer/core/image_io.h"

#include <array>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace patina::test {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

namespace {

/// An X server without a screen, ended with this process.
class Xvfb {
public:
    Xvfb() {
        std::array<int, 2> pipe{};
        if (::pipe(pipe.data()) != 0) throw std::runtime_error("no pipe can be opened");
        process_ = ::fork();
        if (process_ == 0) {
            ::close(pipe[0]);
            const int nothing = ::open("/dev/null", O_RDWR);
            ::dup2(nothing, 1);
            ::dup2(nothing, 2);
            const std::string descriptor = std::to_string(pipe[1]);
            ::execlp("Xvfb", "Xvfb", "-displayfd", descriptor.c_str(), "-screen", "0", "1280x720x24",
                     "-nolisten", "tcp", nullptr);
            ::_exit(127);
        }
        ::close(pipe[1]);
        std::array<char, 16> number{};
        std::size_t length = 0;
        while (length < number.size() && ::read(pipe[0], &number[length], 1) == 1 && number[length] != '\n')
            ++length;
        ::close(pipe[0]);
        if (length == 0)
            throw std::runtime_error(
                "there is no display and Xvfb could not be started: install it (apt install "
                "xvfb), or set DISPLAY");
        display_ = ":" + std::string(number.data(), length);
    }
    ~Xvfb() {
        ::kill(process_, SIGTERM);
        ::waitpid(process_, nullptr, 0);
    }
    Xvfb(const Xvfb&) = delete;
    Xvfb& operator=(const Xvfb&) = delete;
    const std::string& display() const { return display_; }

private:
    pid_t process_ = 0;
    std::string display_;
};

}  // namespace

std::string display() {
    if (const char* there = std::getenv("DISPLAY"); there && *there) return there;
    static const Xvfb server;
    return server.display();
}

Folder::Folder() {
    static int count = 0;
    path_ = fs::temp_directory_path() /
            ("patina_editor_" + std::to_string(::getpid()) + "_" + std::to_string(count++));
    fs::create_directories(path_);
}
Folder::~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

Program::Program(const Folder& home, const std::vector<std::string>& arguments, const Variables& variables) {
    static int count = 0;
    errors_ = home / ("errors_" + std::to_string(count++));
    Variables all{{"DISPLAY", variables.count("DISPLAY") ? "" : display()},
                  {"HOME", home.path().string()},
                  {"PATINA_STATE_DIR", (home / "state").string()},
                  {"PATINA_CACHE_DIR", (fs::temp_directory_path() / "patina_editor_test_cache").string()},
                  {"LIBGL_ALWAYS_SOFTWARE", "1"}};
    for (const auto& [name, value] : variables) all[name] = value;
    process_ = ::fork();
    if (process_ != 0) return;
    for (const auto& [name, value] : all) ::setenv(name.c_str(), value.c_str(), 1);
    ::unsetenv("WAYLAND_DISPLAY");
    ::dup2(::open(errors_.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600), 2);
    std::vector<std::string> words{PATINA_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    ::execv(PATINA_PROGRAM, pointers.data());
    ::_exit(127);
}

Program::~Program() {
    if (running()) kill();
}

bool Program::running() {
    if (over_) return false;
    int status = 0;
    if (::waitpid(process_, &status, WNOHANG) == 0) return true;
    over_ = true;
    outcome_ = {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read_text(errors_)};
    return false;
}

Outcome Program::wait() {
    while (running()) std::this_thread::sleep_for(5ms);
    return outcome_;
}

void Program::kill() {
    ::kill(process_, SIGKILL);
    wait();
}

std::vector<std::string> drive_arguments(const Folder& home, const std::string& script,
                                         std::vector<std::string> arguments) {
    static int count = 0;
    const fs::path file = home / ("script_" + std::to_string(count++) + ".drive");
    std::ofstream(file) << script;
    arguments.insert(arguments.end(), {"--drive", file.string()});
    return arguments;
}

void start_small(const Folder& home, int width, int height) {
    write_text(home / "state/settings.json", "{\"window_width\": " + std::to_string(width) +
                                                 ", \"window_height\": " + std::to_string(height) +
                                                 ", \"show_library\": false}");
}

fs::path shipped_preset(const std::string& id) {
    return fs::path(PATINA_PROGRAM).parent_path().parent_path() / "share/patina/presets" / (id + ".json");
}

Outcome drive(const Folder& home, const std::string& script, std::vector<std::string> arguments) {
    Program program(home, drive_arguments(home, script, std::move(arguments)));
    return program.wait();
}

void write_picture(const fs::path& file, int red, int green, int blue, int side) {
    fs::create_directories(file.parent_path());
    Image image = make_image(side, side, 3, PixelType::U8);
    const std::array<int, 3> color{red, green, blue};
    for (std::size_t i = 0; i < image.bytes.size(); ++i) image.bytes[i] = std::byte(color[i % 3]);
    save_image(file, image);
}

void write_text(const std::filesystem::path& file, const std::string& text) {
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
}

std::string read_text(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

bool wait_for_file(const fs::path& file, std::chrono::seconds limit) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!fs::exists(file)) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(10ms);
    }
    return true;
}

}  // namespace patina::test
