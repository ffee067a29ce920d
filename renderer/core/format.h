// printf into a string, for short texts.
#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace patina {

/// At most 239 bytes; what is longer is cut off.
template <class... Values>
std::string formatted(const char* format, Values... values) {
    std::array<char, 240> text{};
    std::snprintf(text.data(), text.size(), format, values...);
    return text.data();
}

}  // namespace patina
