// Code points of UTF-8 text. Pure.
#pragma once

#include <cstddef>
#include <string_view>

namespace patina {

inline constexpr int kReplacementPoint = 0xFFFD;

/// The next code point, or U+FFFD for a byte that begins none; advances text. Precondition: text is not
/// empty.
inline int next_code_point(std::string_view& text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const int lead = byte(0);
    const std::size_t length = lead < 0x80 ? 1 : lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : lead >= 0xC0 ? 2 : 0;
    if (length == 0 || length > text.size()) {
        text.remove_prefix(1);
        return kReplacementPoint;
    }
    int code = length == 1 ? lead : lead & (0xFF >> (length + 1));
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xC0) != 0x80) {
            text.remove_prefix(i);
            return kReplacementPoint;
        }
        code = code << 6 | (byte(i) & 0x3F);
    }
    text.remove_prefix(length);
    return code;
}

}  // namespace patina
