// Names and sizes as text: how they are shown, sorted, searched and recorded. Pure.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace patina::ui {

/// "12.3 MB"
std::string bytes_text(std::uint64_t bytes);
/// The part after the last slash.
std::string_view file_name_of(std::string_view path);
/// Does text contain pattern, letter case aside? Every word of pattern has to be found.
bool matches_search(std::string_view text, std::string_view pattern);
/// Alphabetical, letter case aside, numbers by their value: "2_rough" before "10_rough".
bool natural_less(std::string_view a, std::string_view b);
/// "Split sum" → "split_sum": a name for a recorded option.
std::string recorded_name(std::string_view base, std::string_view title);

}  // namespace patina::ui
