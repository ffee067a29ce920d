// Runs the real program in a real window: a display of its own (Xvfb), a folder of its own, and scripts that
// drive it.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <sys/types.h>
#include <vector>

namespace patina::test {

/// A temporary folder that goes with the test.
class Folder {
public:
    Folder();
    ~Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// The DISPLAY to open windows on: the one there is, else that of an Xvfb started once for this process.
/// Throws std::runtime_error that says what to install where there is neither.
std::string display();

struct Outcome {
    int status = -1;  ///< exit status, or 128 + signal
    std::string errors;
};

/// One running editor. Its state lives in home/state; baked light is shared between tests.
class Program {
public:
    using Variables = std::map<std::string, std::string>;
    Program(const Folder& home, const std::vector<std::string>& arguments, const Variables& variables = {});
    ~Program();  ///< kills it if it still runs
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;
    Outcome wait();
    void kill();  ///< SIGKILL, as a crash would
    bool running();

private:
    pid_t process_ = 0;
    std::filesystem::path errors_;
    Outcome outcome_;
    bool over_ = false;
};

/// The next start in that folder opens a window of that size, without the library and its pictures: sooner
/// drawn.
void start_small(const Folder& home, int width, int height);
/// A preset that ships.
std::filesystem::path shipped_preset(const std::string& id);
/// Writes the script and runs it to its end. arguments come before --drive.
Outcome drive(const Folder& home, const std::string& script, std::vector<std::string> arguments = {});
/// Its script came to the end without a failed expectation; needs <gtest/gtest.h>.
#define EXPECT_DRIVEN(outcome)                        \
    do {                                              \
        const patina::test::Outcome seen = (outcome); \
        EXPECT_EQ(seen.status, 0) << seen.errors;     \
    } while (false)
/// Starts it and comes back at once.
std::vector<std::string> drive_arguments(const Folder& home, const std::string& script,
                                         std::vector<std::string> arguments = {});

/// A picture of one colour.
void write_picture(const std::filesystem::path& file, int red, int green, int blue, int side = 64);
/// A text file, its folder included.
void write_text(const std::filesystem::path& file, const std::string& text);
std::string read_text(const std::filesystem::path& file);
bool wait_for_file(const std::filesystem::path& file, std::chrono::seconds limit = std::chrono::seconds(60));

}  // namespace patina::test
