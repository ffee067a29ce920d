#include "renderer/core/image_codec.h"

#include <algorithm>
#include <cctype>

namespace patina {

std::string size_problem(std::int64_t width, std::int64_t height) {
    if (width < 1 || height < 1) return "has no pixels; export it again";
    if (width > kMaxImageSide || height > kMaxImageSide || width * height > kMaxImagePixels)
        return "promises " + std::to_string(width) + "×" + std::to_string(height) +
               " pixels, more than 16384×16384; scale it down";
    return {};
}

std::string one_line(std::string text) {
    const std::size_t end = text.find_last_not_of(" \n\r\t.");
    text.resize(end == std::string::npos ? 0 : end + 1);
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
    constexpr std::size_t longest = 160;
    if (text.size() > longest) text.resize(longest);
    return text.empty() ? "no reason given" : text;
}

std::string damaged(const std::string& reason) {
    return "is damaged (" + one_line(reason) + "); copy or export it again";
}

}  // namespace patina
