#include "renderer/core/image_channels.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>
#include <numeric>
#include <string_view>

namespace patina {
namespace {

std::string lower(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

/// Index of the channel with one of those names (any case), -1 where there is none.
int channel_named(std::span<const std::string> names, std::initializer_list<std::string_view> wanted) {
    for (const std::string_view name : wanted)
        for (std::size_t i = 0; i < names.size(); ++i)
            if (lower(names[i]) == name) return static_cast<int>(i);
    return -1;
}

}  // namespace

ChannelChoice choose_channels(std::span<const std::string> names) {
    ChannelChoice choice{.rank = 1};
    const std::array<int, 3> rgb{channel_named(names, {"r", "red"}), channel_named(names, {"g", "green"}),
                                 channel_named(names, {"b", "blue"})};
    const int luminance = channel_named(names, {"y", "l"});
    const int alpha = channel_named(names, {"a", "alpha"});
    if (std::all_of(rgb.begin(), rgb.end(), [](int i) { return i >= 0; })) {
        choice = {.channels = {rgb.begin(), rgb.end()}, .rank = 3};
    } else if (luminance >= 0) {
        choice = {.channels = {luminance}, .rank = 2};
    } else {
        choice.channels.resize(std::min<std::size_t>(names.size(), 4));
        std::iota(choice.channels.begin(), choice.channels.end(), 0);
        return choice;
    }
    if (alpha >= 0) choice.channels.push_back(alpha);
    return choice;
}

std::string left_out_note(std::span<const std::string> names, const ChannelChoice& choice) {
    if (names.size() == choice.channels.size()) return {};
    std::string kept;
    for (const int channel : choice.channels)
        kept += (kept.empty() ? "" : ", ") + names[static_cast<std::size_t>(channel)];
    return "of " + std::to_string(names.size()) + " channels these were read: " + kept;
}

}  // namespace patina
