#include "renderer/core/mesh_text.h"

#include <algorithm>
#include <cassert>
#include <cfloat>
#include <charconv>
#include <cmath>
#include <limits>

namespace patina {

Span next_word(const std::string& text, Span& within) {
    while (!within.empty() && is_space(text[within.begin])) ++within.begin;
    Span word{within.begin, within.begin};
    while (word.end < within.end && !is_space(text[word.end])) ++word.end;
    within.begin = word.end;
    return word;
}

Span next_line(const std::string& text, Span& within) {
    const std::size_t found = text.find('\n', within.begin);
    const std::size_t end = found == std::string::npos || found >= within.end ? within.end : found;
    const Span line{within.begin, end};
    within.begin = std::min(within.end, end + 1);
    return line;
}

void overwrite(std::string& text, Span span, std::string_view value) {
    assert(value.size() <= span.end - span.begin);
    std::copy(value.begin(), value.end(), text.begin() + std::ptrdiff_t(span.begin));
    std::fill(text.begin() + std::ptrdiff_t(span.begin + value.size()),
              text.begin() + std::ptrdiff_t(span.end), ' ');
}

std::optional<double> parse_number(std::string_view word) {
    const bool negative = word.starts_with('-');
    if (negative || word.starts_with('+')) word.remove_prefix(1);
    if (word.empty() || word[0] == '-') return std::nullopt;
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size()) return std::nullopt;
    if (error == std::errc::result_out_of_range) {  // too large, unless the exponent is negative
        const std::size_t e = word.find_first_of("eE");
        const bool tiny = e != std::string_view::npos && e + 1 < word.size() && word[e + 1] == '-';
        value = tiny ? 0.0 : std::numeric_limits<double>::infinity();
    } else if (error != std::errc()) {
        return std::nullopt;
    }
    if (std::abs(value) > double(FLT_MAX)) value = std::numeric_limits<double>::infinity();
    return negative ? -value : value;
}

std::optional<std::int64_t> parse_integer(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return value;
}

void unify_line_ends(std::string& text) {
    if (text.find('\n') == std::string::npos) std::replace(text.begin(), text.end(), '\r', '\n');
}

}  // namespace patina
