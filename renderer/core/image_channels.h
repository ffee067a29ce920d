// Which of a file's channels make the picture, told from their names. Knows no file and no decoder.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace patina {

struct ChannelChoice {
    std::vector<int> channels;  ///< 1…4 indices into the names, in the order of the picture
    int rank = 0;               ///< 3: R, G, B; 2: luminance; 1: whatever comes first
};
/// Names in any case; names not empty.
ChannelChoice choose_channels(std::span<const std::string> names);

/// One sentence about what was left out; empty where nothing was.
std::string left_out_note(std::span<const std::string> names, const ChannelChoice& choice);

}  // namespace patina
