// Drives the window from a script, through the same mouse, keys and drops a person uses: for tests,
// screenshots and demos.
//
// One command a line; '#' starts a comment; words with spaces stand in double quotes. LABEL is an item's name
// as the panels record it ("menu.file.save", "material.roughness.slider"); what is scrolled out of sight is
// scrolled into it.
//
// clang-format off
//   click LABEL [at FX FY]       FX, FY: where inside it, 0…1; the middle otherwise; also double-click,
//                                right-click, hover
//   drag LABEL DX DY             presses in its middle and lets go DX, DY further
//   move X Y                     display coordinates
//   wheel LINES
//   type TEXT                    into whatever has the keyboard; so does
//   key ctrl+z
//   drop PATH… [at LABEL]        files from outside
//   resize W H                   the window
//   hide | show                  the window; a hidden one shows no frames, so wait for something else
//   close                        the window's own button
//   wait idle                    until no job runs and nothing moves
//   wait N frames | N seconds    or N turns of the event loop, which take 0.02 s while nothing happens
//   wait until EXPECTATION       at most a few minutes
//   mark                         frames, views, turns, cpu_ms and longest_turn_ms count from here
//   expect EXPECTATION           dirty | clean | item LABEL | no item LABEL | KEY=VALUE (also != < <= > >= and
//                                ~ for contains, !~ for does not contain)
//   print KEY                    its value, on standard output
//   items [PREFIX]               the names of all items shown, on standard output
//   screenshot FILE.png
//   quit                         at once, asking nothing; so does the script's end
// clang-format on
//
// KEY: a parameter of the material ("roughness", "uv.scale"), "albedo.map", "albedo.state" (none, loading,
// ok, missing, broken), or one of the names in drive_value(). A failed command ends the program with status 1
// and names its line.
#pragma once

#include "app/editor_state.h"
#include "app/window.h"
#include "ui/recorder.h"

#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace patina {

struct DriveCommand {
    int line = 0;
    std::vector<std::string> words;  ///< the verb first
};
/// Throws std::runtime_error "NAME:LINE: what is wrong" for unknown verbs and wrong numbers of words.
std::vector<DriveCommand> parse_drive(std::string_view text, const std::string& name);
std::vector<DriveCommand> load_drive(const std::filesystem::path& file);

/// What a script sees.
struct DriveView {
    const Editor& editor;
    const ui::ItemRecorder& items;
    bool idle = false;
    std::uint64_t frames = 0;  ///< of the window
    std::uint64_t views = 0;   ///< of the 3D view
    std::uint64_t turns = 0;   ///< of the event loop
    double cpu_ms = 0.0;       ///< of all threads of the process
    double turn_ms = 0.0;      ///< main-thread work: of the last turn for step(), of the longest for values
};
/// A value by name as text; nullopt if there is none of that name.
std::optional<std::string> drive_value(const DriveView& view, const std::string& key);
/// What is wrong with the expectation, in words; empty if it holds.
std::string drive_mismatch(const DriveView& view, const std::vector<std::string>& words);

class Drive {
public:
    Drive(std::vector<DriveCommand> commands, std::string name);

    /// Once a loop. Throws std::runtime_error "NAME:LINE: …" when a command fails.
    void step(Window& window, const DriveView& view);
    bool finished() const { return finished_; }
    /// Wants step() again at once, without waiting for an event.
    bool busy() const { return !finished_ && !waiting_; }
    /// While not busy: how long it may be before step() is called again, unless something happens.
    double patient_for_s(double now_s) const;
    /// Where to write the next frame, if a screenshot was asked for.
    std::optional<std::filesystem::path> take_screenshot();

private:
    /// One thing to do; false: not yet, ask again.
    using Action = std::function<bool(Window&, const DriveView&)>;

    void begin(const DriveCommand& command, Window& window, const DriveView& view);
    void begin_pointer(const DriveCommand& command);
    void begin_keys(const DriveCommand& command);
    void begin_wait(const DriveCommand& command, const DriveView& view, double now_s);
    void act(std::function<void(Window&)> action);  ///< then waits for the next frame
    Action reach(const std::string& label, glm::vec2 fraction);
    /// The same, counted from the mark.
    DriveView since_mark(const DriveView& view) const;
    [[noreturn]] void fail(const std::string& what) const;

    std::vector<DriveCommand> commands_;
    std::string name_;
    std::size_t next_ = 0;
    std::deque<Action> actions_;
    std::uint64_t frame_to_see_ = 0;
    double began_s_ = 0.0;
    double now_s_ = 0.0;
    glm::vec2 mouse_{0.0f};
    std::uint64_t marked_frames_ = 0, marked_views_ = 0, marked_turns_ = 0;
    double marked_cpu_ms_ = 0.0;
    double longest_turn_ms_ = 0.0;  ///< since the mark
    std::optional<std::filesystem::path> screenshot_;
    bool waiting_ = false;
    std::optional<double> sleeps_until_s_;  ///< waits for the time alone
    bool finished_ = false;
};

}  // namespace patina
