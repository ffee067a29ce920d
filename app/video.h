// Numbered pictures joined to a video by the ffmpeg program, where it is installed.
#pragma once

#include <filesystem>

namespace patina {

/// By the file's ending: .mp4, .webm, .mov, .gif.
bool is_video(const std::filesystem::path& file);
bool has_ffmpeg();

/// pattern: the path of so many pictures with a printf number, from 1 on. 24 pictures a second. Atomic;
/// throws std::runtime_error with one sentence that names the video.
void join_frames(const std::filesystem::path& pattern, int frames, const std::filesystem::path& video);

}  // namespace patina
