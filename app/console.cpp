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

void say(std::string_view sentence) {
    std::fprintf(stderr, "patina: %.*s\n", int(sentence.size()), sentence.data());
}

ProgressLine::ProgressLine() : terminal_(PATINA_ISATTY != 0) {}
ProgressLine::~ProgressLine() { clear(); }

void ProgressLine::show(const std::string& what, float fraction) {
    if (!terminal_) return;
    const std::string line = what + "  " + std::to_string(int(fraction * 100.0f)) + " %";
    if (line == shown_) return;
    std::fprintf(stderr, "\r\x1b[K%s", line.c_str());
    shown_ = line;
}

void ProgressLine::clear() {
    if (!shown_.empty()) std::fputs("\r\x1b[K", stderr);
    shown_.clear();
}

}  // namespace patina
