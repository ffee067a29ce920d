#include "app/video.h"

#include "materials/text_io.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#ifdef _WIN32
#include <process.h>
#else
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace patina {

namespace fs = std::filesystem;

namespace {

/// Its exit status, without a word on the terminal; −1 where it cannot be started.
int run_quietly(std::vector<std::string> words) {
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
#ifdef _WIN32
    return static_cast<int>(_spawnvp(_P_WAIT, pointers[0], pointers.data()));
#else
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
    pid_t child = 0;
    const int failure = ::posix_spawnp(&child, pointers[0], &actions, nullptr, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    int status = 0;
    if (failure != 0 || ::waitpid(child, &status, 0) != child) return -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
#endif
}

}  // namespace

bool is_video(const fs::path& file) {
    constexpr std::array<std::string_view, 4> endings{".mp4", ".webm", ".mov", ".gif"};
    return std::ranges::find(endings, file.extension().string()) != endings.end();
}

bool has_ffmpeg() { return run_quietly({"ffmpeg", "-version"}) == 0; }

void join_frames(const fs::path& pattern, int frames, const fs::path& video) {
    fs::path unfinished = video;
    unfinished.replace_filename("." + video.filename().string());
    std::vector<std::string> words{"ffmpeg",         "-y",        "-framerate",          "24", "-i",
                                   pattern.string(), "-frames:v", std::to_string(frames)};
    if (video.extension() != ".gif")
        // Players want an even size and 4:2:0 colours.
        for (const char* word : {"-vf", "crop=trunc(iw/2)*2:trunc(ih/2)*2", "-pix_fmt", "yuv420p"})
            words.emplace_back(word);
    words.push_back(unfinished.string());
    const int status = run_quietly(std::move(words));
    std::error_code failure;
    if (status == 0) fs::rename(unfinished, video, failure);
    if (status == 0 && !failure) return;
    fs::remove(unfinished, failure);
    throw std::runtime_error(
        path_to_utf8(video) +
        ": ffmpeg could not write the video; write numbered pictures instead (-o turn.png)");
}

}  // namespace patina
