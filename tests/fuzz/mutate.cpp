#include "tests/fuzz/mutate.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string_view>

namespace patina::fuzz {

namespace {

std::size_t place(const std::string& text, Random& random) {
    // Headers are where sizes stand: half of the damage goes to the first bytes.
    const std::size_t reach = random.chance(0.5) ? std::min<std::size_t>(text.size(), 128) : text.size();
    return std::size_t(random.uniform() * double(reach));
}

/// A binary number of 1, 2 or 4 bytes in either order.
void set_number(std::string& text, Random& random) {
    constexpr std::uint32_t extremes[] = {0,     1,          0x7f,       0x80,       0xff,
                                          32768, 0xffff,     0x7fffffff, 0x80000000, 0xffffffff,
                                          65535, 1000000000, 0x7fc00000, 0x7f800000, 16};
    const std::uint32_t number = extremes[random.below(int(std::size(extremes)))];
    const int bytes = 1 << random.below(3);
    const bool big_end_first = random.chance(0.5);
    const std::size_t at = place(text, random);
    for (int i = 0; i < bytes && at + std::size_t(i) < text.size(); ++i)
        text[at + std::size_t(i)] = char(number >> (8 * (big_end_first ? bytes - 1 - i : i)));
}

/// A number in text becomes another.
void set_word(std::string& text, Random& random) {
    constexpr std::string_view words[] = {"0",          "-1",         "1e999", "nan",  "-inf", "1e-45",
                                          "9999999999", "2147483648", "\"x\"", "[[[[", "null", "0x10"};
    std::size_t at = text.find_first_of("0123456789", place(text, random));
    if (at == std::string::npos) return;
    const std::size_t end = std::min(text.find_first_not_of("0123456789.eE+-", at), text.size());
    text.replace(at, end - at, words[random.below(int(std::size(words)))]);
}

void damage(std::string& text, const std::vector<std::string>& originals, Random& random) {
    if (text.empty()) return;
    const std::size_t at = place(text, random);
    const auto length = std::size_t(random.log_between(1.0, 64.0));
    switch (random.below(8)) {
        case 0:
            text[at] = char(text[at] ^ (1 << random.below(8)));
            break;
        case 1:
            text[at] = char(random.below(256));
            break;
        case 2:
            set_number(text, random);
            break;
        case 3:
            set_word(text, random);
            break;
        case 4:
            text.erase(at, length);
            break;
        case 5:
            text.insert(at, text.substr(place(text, random), length));
            break;
        case 6:
            text.resize(at);
            break;
        default: {
            const std::string& other = originals[std::size_t(random.below(int(originals.size())))];
            text = text.substr(0, at) + other.substr(std::min(place(other, random), other.size()));
        }
    }
}

}  // namespace

std::string damaged(const std::vector<std::string>& originals, Random& random) {
    std::string text = originals[std::size_t(random.below(int(originals.size())))];
    for (int times = 1 + random.below(6); times > 0; --times) damage(text, originals, random);
    return text;
}

}  // namespace patina::fuzz
