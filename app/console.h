// What a command says while it works: notes, and progress where a person watches.
#pragma once

#include <string>
#include <string_view>

namespace patina {

/// On one line, and without what a terminal takes for commands: names and keys come from strangers' files.
std::string harmless(std::string_view text);

/// One line on standard error, harmless: "patina: …".
void say(std::string_view sentence);

/// A progress line on standard error, rewritten in place; silent unless standard error is a terminal.
class ProgressLine {
public:
    ProgressLine();
    ~ProgressLine();  ///< wipes the line
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    void show(const std::string& what, float fraction);  ///< fraction 0…1; from one thread at a time
    void clear();

private:
    bool terminal_;
    std::string shown_;
};

}  // namespace patina
