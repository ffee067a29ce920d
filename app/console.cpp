#include "app/console.h"

#include <cstdio>

#ifdef _WIN32
#include <io.h>
#define PATINA_ISATTY _isatty(2)
#else
#include <unistd.h>
#define PATINA_ISATTY isatty(2)
#endif

namespace patina {

/// C0, DEL and, as UTF-8 writes them, C1: 0xC2 0x80 … 0x9F.
std::string harmless(std::string_view text) {
    std::string result(text);
    for (std::size_t i = 0; i < result.size(); ++i) {
        const auto byte = [&](std::size_t at) {
            return at < result.size() ? static_cast<unsigned char>(result[at]) : 0u;
        };
        if (byte(i) < 0x20 || byte(i) == 0x7f) result[i] = '?';
        if (byte(i) == 0xc2 && byte(i + 1) >= 0x80 && byte(i + 1) < 0xa0) result.replace(i, 2, "?");
    }
    return result;
}

void say(std::string_view sentence) { std::fprintf(stderr, "patina: %s\n", harmless(sentence).c_str()); }

ProgressLine::ProgressLine() : terminal_(PATINA_ISATTY != 0) {}
ProgressLine::~ProgressLine() { clear(); }

void ProgressLine::show(const std::string& what, float fraction) {
    if (!terminal_) return;
    const std::string line = harmless(what) + "  " + std::to_string(int(fraction * 100.0f)) + " %";
    if (line == shown_) return;
    std::fprintf(stderr, "\r\x1b[K%s", line.c_str());
    shown_ = line;
}

void ProgressLine::clear() {
    if (!shown_.empty()) std::fputs("\r\x1b[K", stderr);
    shown_.clear();
}

}  // namespace patina
