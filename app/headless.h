// An OpenGL 4.1 core context without a window: EGL surfaceless on Linux, a hidden GLFW window elsewhere.
#pragma once

#include <memory>
#include <string>

namespace patina {

class HeadlessContext {
public:
    /// Makes it current on this thread. Throws std::runtime_error with one sentence if there is none to be
    /// had.
    HeadlessContext();
    ~HeadlessContext();
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;
    std::string description() const;  ///< renderer and version, for reports

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace patina
