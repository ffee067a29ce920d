// The unsaved document, kept on disk while it is unsaved, and found again after a crash. Two editors open at
// once do not touch each other's: each holds the lock of its own file for as long as it lives.
#pragma once

#include "app/document.h"

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace patina {

/// What is kept: the document, the files it belongs to, and when.
struct Recovery {
    Document document;                 ///< its sheet only where that is not saved
    std::filesystem::path file;        ///< of the preset; empty: never saved
    std::filesystem::path sheet_file;  ///< likewise
    std::int64_t unix_time_s = 0;
};
std::string to_json(const Recovery& recovery);
/// nullopt if the text is not one.
std::optional<Recovery> parse_recovery(std::string_view text);

/// When to write: a moment after the last change, and under continued change not seldom either. Pure; the
/// clock is passed in as seconds.
class AutosaveClock {
public:
    static constexpr double kQuietSeconds = 1.0;
    static constexpr double kAtLeastEverySeconds = 5.0;
    void changed(double now_s);
    void written();
    bool due(double now_s) const;
    std::optional<double> due_in_s(double now_s) const;  ///< empty: nothing to write

private:
    std::optional<double> first_change_s_;
    double last_change_s_ = 0.0;
};

/// This editor's recovery file in a folder, and those that crashed editors left there.
class RecoveryFiles {
public:
    /// Makes the folder and takes a lock in it. Never throws: without a usable folder nothing is kept, and
    /// problem() says so in one sentence.
    explicit RecoveryFiles(std::filesystem::path folder);
    /// Gives up the locks. A file that was not removed is then found by the next editor, so work survives
    /// every end that was not a clean one.
    ~RecoveryFiles();
    RecoveryFiles(const RecoveryFiles&) = delete;
    RecoveryFiles& operator=(const RecoveryFiles&) = delete;

    const std::string& problem() const;
    /// Atomic. Throws std::runtime_error with one sentence.
    void write(std::string_view text);
    void remove();

    /// The newest one whose editor is gone; its lock is held from now on, so that no other editor offers it
    /// as well.
    struct Orphan {
        std::filesystem::path file;
        Recovery recovery;
    };
    std::optional<Orphan> claim_orphan();
    void discard(const Orphan& orphan);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace patina
