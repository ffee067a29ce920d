#include "app/console.h"
#include "app/editor_state.h"

#include <array>
#include <ctime>

namespace patina {

namespace {

constexpr std::size_t kLogLines = 500;

std::string time_of_day() {
    const std::time_t now = std::time(nullptr);
    std::tm local{};
#ifdef _WIN32
    localtime_s(&local, &now);
#else
    localtime_r(&now, &local);
#endif
    std::array<char, 16> text{};
    std::strftime(text.data(), text.size(), "%H:%M:%S", &local);
    return text.data();
}

}  // namespace

void log_line(Editor& editor, ui::Severity severity, const std::string& words) {
    const std::string sentence = harmless(words);
    std::vector<ui::LogLine>& log = editor.status.log;
    if (!log.empty() && log.back().text == sentence && log.back().severity == severity) {
        ++log.back().count;
        log.back().time = time_of_day();
    } else {
        log.push_back({severity, sentence, time_of_day(), 1});
        if (log.size() > kLogLines) log.erase(log.begin());
    }
    editor.status.text = sentence;
    editor.status.severity = severity;
    ++editor.changes;
}

void say_status(Editor& editor, const std::string& sentence) {
    editor.status.text = sentence;
    editor.status.severity = ui::Severity::Info;
    ++editor.changes;
}

}  // namespace patina
