// Walking over text in place: lines, words and numbers, independent of any locale.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace patina {

/// Blanks and line ends; text[pos] exists.
inline bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// A stretch of a text, so that it can be read and overwritten.
struct Span {
    std::size_t begin = 0, end = 0;
    bool empty() const { return begin == end; }
    std::string_view of(const std::string& text) const {
        return std::string_view(text).substr(begin, end - begin);
    }
};

/// The next word in within, which then starts behind it; empty at the end.
Span next_word(const std::string& text, Span& within);

/// The next line without its end in within, which then starts behind it. Precondition: within is not empty.
Span next_line(const std::string& text, Span& within);

/// Puts value at the start of the stretch and blanks behind it. Precondition: it fits.
void overwrite(std::string& text, Span span, std::string_view value);

/// A number that is the whole word. Infinite where it does not fit a float; nullopt where it is no number at
/// all.
std::optional<double> parse_number(std::string_view word);
std::optional<std::int64_t> parse_integer(std::string_view word);

/// Line ends of old Macs (a lone CR) become LF.
void unify_line_ends(std::string& text);

}  // namespace patina
