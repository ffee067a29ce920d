#include "ui/names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>

namespace patina::ui {
namespace {

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

}  // namespace

std::string bytes_text(std::uint64_t bytes) {
    constexpr std::array<const char*, 5> units{"B", "kB", "MB", "GB", "TB"};
    double amount = static_cast<double>(bytes);
    std::size_t unit = 0;
    while (amount >= 999.5 && unit + 1 < units.size()) {
        amount /= 1000.0;
        ++unit;
    }
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), unit > 0 && amount < 99.95 ? "%.1f %s" : "%.0f %s", amount,
                  units[unit]);
    return text.data();
}

std::string_view file_name_of(std::string_view path) {
    const std::size_t slash = path.find_last_of('/');
    return slash == std::string_view::npos ? path : path.substr(slash + 1);
}

bool matches_search(std::string_view text, std::string_view pattern) {
    const auto same = [](char a, char b) { return lower(a) == lower(b); };
    std::size_t begin = 0;
    while (begin < pattern.size()) {
        const std::size_t end = std::min(pattern.find(' ', begin), pattern.size());
        const std::string_view word = pattern.substr(begin, end - begin);
        if (std::search(text.begin(), text.end(), word.begin(), word.end(), same) == text.end()) return false;
        begin = end + 1;
    }
    return true;
}

bool natural_less(std::string_view a, std::string_view b) {
    const auto digit = [](char c) { return c >= '0' && c <= '9'; };
    const auto number_end = [&](std::string_view text, std::size_t i) {
        while (i < text.size() && digit(text[i])) ++i;
        return i;
    };
    std::size_t i = 0, j = 0;
    while (i < a.size() && j < b.size()) {
        if (digit(a[i]) && digit(b[j])) {
            while (i < a.size() && a[i] == '0') ++i;
            while (j < b.size() && b[j] == '0') ++j;
            const std::size_t end_a = number_end(a, i), end_b = number_end(b, j);
            if (end_a - i != end_b - j) return end_a - i < end_b - j;
            const int order = a.substr(i, end_a - i).compare(b.substr(j, end_b - j));
            if (order != 0) return order < 0;
            i = end_a;
            j = end_b;
        } else {
            if (lower(a[i]) != lower(b[j])) return lower(a[i]) < lower(b[j]);
            ++i;
            ++j;
        }
    }
    return a.size() - i < b.size() - j;
}

std::string recorded_name(std::string_view base, std::string_view title) {
    std::string name = std::string(base) + ".";
    for (const char c : title) name += c == ' ' ? '_' : lower(c);
    return name;
}

}  // namespace patina::ui
