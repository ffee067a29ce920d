// The window, its OpenGL context and Dear ImGui's place in it: events in, one frame out. Knows no document.
//
// Display coordinates are ImGui's (y down); times are seconds since the window opened.
#pragma once

#include "renderer/core/image.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace patina {

struct WindowOptions {
    std::string title = "Patina";
    glm::ivec2 size{1440, 900};  ///< screen units
    bool maximized = false;
    bool hidden = false;
    bool driven = false;  ///< the mouse and keyboard of a script, not the person's
};

/// What happened since it was last asked for.
struct WindowEvents {
    bool any = false;  ///< something a picture may depend on: input, size, exposure, focus
    bool close = false;
    bool focus_gained = false;
    struct Drop {
        std::vector<std::string> files;  ///< UTF-8
        glm::vec2 position{0.0f};
    };
    std::vector<Drop> drops;
};

class Window {
public:
    /// Throws std::runtime_error with one sentence where there is no display or no OpenGL 4.1.
    explicit Window(const WindowOptions& options);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Sleeps until an event, wake() or the time is over; 0 only collects what is there.
    void wait(double timeout_s);
    /// From any thread: ends wait().
    static void wake();
    WindowEvents take_events();
    /// Throws std::runtime_error where the driver was reset: nothing more can be drawn in this window.
    void require_context() const;

    /// Between them the interface is drawn; end_frame shows it.
    void begin_frame();
    void end_frame(Image* shown = nullptr);  ///< shown: gets the picture, 3 channels of 8 bits
    void drop_frame();                       ///< instead of showing it
    /// Of the text field that has the keyboard: when its caret next appears or vanishes; infinity where none
    /// does.
    double caret_changes_in_s() const;
    void let_caret_blink(bool blinks);  ///< or stand still, and be seen
    bool out_of_sight() const;          ///< minimised, hidden or without a pixel
    std::uint64_t frames() const;       ///< shown so far

    double time_s() const;
    float interface_scale() const;    ///< 1 = 96 dpi
    float framebuffer_scale() const;  ///< pixels a display unit
    glm::ivec2 framebuffer_px() const;
    glm::ivec2 size() const;  ///< screen units
    bool maximized() const;
    std::string description() const;  ///< GL renderer and version
    /// Rebuilds style and fonts if the window moved to a display of another scale. True if it did.
    bool follow_scale();

    void set_title(const std::string& title);
    void set_clipboard(const std::string& text);

    // A script's hands, only where WindowOptions::driven: what the system's own callbacks would report.
    void move_mouse(glm::vec2 position);
    void press_mouse(int button, bool down);
    void turn_wheel(float lines);
    void press_key(int key, bool down);
    void type_character(unsigned codepoint);
    void drop_files(const std::vector<std::string>& files);
    void set_shown(bool shown);  ///< hides it, or brings it back
    void resize(glm::ivec2 size);
    void ask_to_close();
    void call_for_frame();  ///< only calls for a frame

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// GLFW's code for a key's name as written in scripts ("z", "f2", "escape", "ctrl"); 0 if there is none.
int key_code(const std::string& name);

}  // namespace patina
