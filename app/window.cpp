#include "app/window.h"

#include "app/jobs.h"
#include "ui/theme.h"
#include "ui/workspace.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <epoxy/gl.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <cmath>
#include <cstring>
#include <deque>
#include <limits>
#include <stdexcept>
#include <utility>

namespace patina {
namespace {

constexpr float kDrivenFrameSeconds = 1.0f / 60.0f;
constexpr int kMouseButtons = 3;

struct KeyEvent {
    bool is_character = false;
    unsigned character = 0;
    int key = 0, scancode = 0, action = 0, mods = 0;
};

std::string last_glfw_error() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "the reason is unknown";
}

}  // namespace

struct Window::State {
    GLFWwindow* window = nullptr;
    ImFontAtlas fonts;
    bool driven = false;
    WindowEvents events;
    std::deque<KeyEvent> keys;  ///< delivered so that a key changes at most once a frame
    std::uint64_t frames = 0;
    bool tells_loss = false;                       ///< the driver can be asked whether the context is lost
    float scale = 1.0f, framebuffer_scale = 1.0f;  ///< what style and fonts were made for
    glm::vec2 mouse{-1.0f};
    std::array<bool, kMouseButtons> mouse_down{};
    float slept_s = 0.0f;  ///< since the last frame

    void install_callbacks();
    void deliver_keys();
    void override_input();
    void measure_scale(float& interface, float& framebuffer) const;
    static State& of(GLFWwindow* window) { return *static_cast<State*>(glfwGetWindowUserPointer(window)); }
};

namespace {

void begin_glfw() {
    if (!glfwInit())
        throw std::runtime_error("No window can be opened: " + last_glfw_error() +
                                 ". `patina render` works without a display.");
}

float whole_scale(float scale) { return std::clamp(std::round(scale * 4.0f) / 4.0f, 1.0f, 4.0f); }

/// Of a window on the main monitor: where most are opened.
float likely_font_scale() {
    glm::vec2 scale(1.0f);
    if (GLFWmonitor* monitor = glfwGetPrimaryMonitor())
        glfwGetMonitorContentScale(monitor, &scale.x, &scale.y);
    return whole_scale(scale.x);
}

GLFWwindow* open_window(const WindowOptions& options) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 1);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    glfwWindowHint(GLFW_VISIBLE, options.hidden ? GLFW_FALSE : GLFW_TRUE);
    glfwWindowHint(GLFW_MAXIMIZED, options.maximized ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "patina");
    glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "patina");
    const auto create = [&](int robustness) {
        glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, robustness);
        return glfwCreateWindow(options.size.x, options.size.y, options.title.c_str(), nullptr, nullptr);
    };
    // A context that says when it is lost; without, a reset of the driver would end the program at once.
    GLFWwindow* window = create(GLFW_LOSE_CONTEXT_ON_RESET);
    if (!window) window = create(GLFW_NO_ROBUSTNESS);
    if (!window) {
        const std::string reason = last_glfw_error();
        glfwTerminate();
        throw std::runtime_error(
            "No OpenGL 4.1 window can be opened: " + reason +
            ". Update the graphics driver, or set LIBGL_ALWAYS_SOFTWARE=1 to draw in software.");
    }
    return window;
}

/// Until the first frame is there, an empty window in the interface's colour, not what lay under it.
void show_empty(GLFWwindow* window) {
    const ImVec4 color = ImGui::ColorConvertU32ToFloat4(ui::color::kPanel);
    glClearColor(color.x, color.y, color.z, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    glfwSwapInterval(0);  // nobody waits for the display here
    glfwSwapBuffers(window);
}

/// Of the texture's edges nothing is drawn, but a software renderer compiles the interface's shader for each
/// way to look one up.
void look_up_fonts_as_pictures() {
    GLint bound = 0;
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
    glBindTexture(GL_TEXTURE_2D, GLuint(reinterpret_cast<std::uintptr_t>(ImGui::GetIO().Fonts->TexID)));
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    glBindTexture(GL_TEXTURE_2D, GLuint(bound));
}

/// A small display may be smaller than the window that was asked for.
void fit_to_monitor(GLFWwindow* window) {
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    if (!monitor) return;
    glm::ivec2 origin, area, size;
    glfwGetMonitorWorkarea(monitor, &origin.x, &origin.y, &area.x, &area.y);
    glfwGetWindowSize(window, &size.x, &size.y);
    if (area.x > 0 && area.y > 0 && (size.x > area.x || size.y > area.y))
        glfwSetWindowSize(window, std::min(size.x, area.x), std::min(size.y, area.y));
}

}  // namespace

void Window::State::install_callbacks() {
    glfwSetWindowUserPointer(window, this);
    glfwSetWindowCloseCallback(window, [](GLFWwindow* w) {
        glfwSetWindowShouldClose(w, GLFW_FALSE);
        of(w).events.close = of(w).events.any = true;
    });
    glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { of(w).events.any = true; });
    glfwSetWindowSizeCallback(window, [](GLFWwindow* w, int, int) { of(w).events.any = true; });
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { of(w).events.any = true; });
    glfwSetWindowContentScaleCallback(window, [](GLFWwindow* w, float, float) { of(w).events.any = true; });
    glfwSetWindowIconifyCallback(window, [](GLFWwindow* w, int) { of(w).events.any = true; });
    glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
        glm::dvec2 position;
        glfwGetCursorPos(w, &position.x, &position.y);
        of(w).events.drops.push_back({{paths, paths + count}, position});
        of(w).events.any = true;
    });
    if (driven) return;
    glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int focused) {
        ImGui_ImplGlfw_WindowFocusCallback(w, focused);
        of(w).events.any = true;
        of(w).events.focus_gained |= focused == GLFW_TRUE;
    });
    glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int entered) {
        ImGui_ImplGlfw_CursorEnterCallback(w, entered);
        of(w).events.any = true;
    });
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double, double) { of(w).events.any = true; });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int mods) {
        ImGui_ImplGlfw_MouseButtonCallback(w, button, action, mods);
        of(w).events.any = true;
    });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double x, double y) {
        ImGui_ImplGlfw_ScrollCallback(w, x, y);
        of(w).events.any = true;
    });
    glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int scancode, int action, int mods) {
        of(w).keys.push_back({.key = key, .scancode = scancode, .action = action, .mods = mods});
        of(w).events.any = true;
    });
    glfwSetCharCallback(window, [](GLFWwindow* w, unsigned character) {
        of(w).keys.push_back({.is_character = true, .character = character});
        of(w).events.any = true;
    });
}

void Window::State::deliver_keys() {
    std::vector<int> changed;
    while (!keys.empty()) {
        const KeyEvent event = keys.front();
        if (!event.is_character) {
            if (std::find(changed.begin(), changed.end(), event.key) != changed.end()) break;
            changed.push_back(event.key);
            ImGui_ImplGlfw_KeyCallback(window, event.key, event.scancode, event.action, event.mods);
        } else {
            ImGui_ImplGlfw_CharCallback(window, event.character);
        }
        keys.pop_front();
    }
    if (!keys.empty()) events.any = true;  // the rest belongs to the next frame
}

/// The script's mouse, and its time: a frame takes as long everywhere, and what nothing happens in is added.
void Window::State::override_input() {
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = ImVec2(mouse.x, mouse.y);
    for (int i = 0; i < kMouseButtons; ++i) io.MouseDown[i] = mouse_down[i];
    io.DeltaTime = kDrivenFrameSeconds + std::exchange(slept_s, 0.0f);
}

void Window::State::measure_scale(float& interface, float& framebuffer) const {
    glm::ivec2 size, pixels;
    glm::vec2 content(1.0f);
    glfwGetWindowSize(window, &size.x, &size.y);
    glfwGetFramebufferSize(window, &pixels.x, &pixels.y);
    glfwGetWindowContentScale(window, &content.x, &content.y);
    framebuffer = size.x > 0 ? float(pixels.x) / float(size.x) : 1.0f;
    interface = whole_scale(content.x / framebuffer);
}

Window::Window(const WindowOptions& options) : state_(std::make_unique<State>()) {
    begin_glfw();
    // The driver takes as long to open a window as the fonts take.
    const auto wait_for_fonts = begin_beside(
        [&fonts = state_->fonts, scale = likely_font_scale()] { ui::build_fonts(fonts, scale); });
    state_->window = open_window(options);
    state_->driven = options.driven;
    fit_to_monitor(state_->window);
    glfwMakeContextCurrent(state_->window);
    show_empty(state_->window);
    glfwSwapInterval(1);
    state_->tells_loss = epoxy_has_gl_extension("GL_ARB_robustness");
    IMGUI_CHECKVERSION();
    wait_for_fonts();
    ImGui::CreateContext(&state_->fonts);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    state_->install_callbacks();
    ImGui_ImplGlfw_InitForOpenGL(state_->window, false);
    ImGui_ImplOpenGL3_Init("#version 410 core");
    state_->measure_scale(state_->scale, state_->framebuffer_scale);
    ui::apply_theme(state_->scale, state_->framebuffer_scale);
    ImGui_ImplOpenGL3_CreateDeviceObjects();
    look_up_fonts_as_pictures();
    if (state_->driven) ImGui_ImplGlfw_WindowFocusCallback(state_->window, GLFW_TRUE);
    state_->events.any = true;
}

Window::~Window() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    state_->fonts.Locked = false;  // by a frame that an exception ended
    glfwDestroyWindow(state_->window);
    glfwTerminate();
}

void Window::wait(double timeout_s) {
    if (timeout_s <= 0.0) return glfwPollEvents();
    const double before_s = glfwGetTime();
    glfwWaitEventsTimeout(timeout_s);
    state_->slept_s += float(glfwGetTime() - before_s);
}

void Window::wake() { glfwPostEmptyEvent(); }

WindowEvents Window::take_events() { return std::exchange(state_->events, {}); }

void Window::require_context() const {
    if (!state_->tells_loss || glGetGraphicsResetStatusARB() == GL_NO_ERROR) return;
    throw std::runtime_error(
        "The graphics driver was reset and took the window's pictures with it: start again; changes that "
        "were "
        "not saved are offered then.");
}

void Window::begin_frame() {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    state_->deliver_keys();
    if (state_->driven) state_->override_input();
    ImGui::NewFrame();
}

void Window::end_frame(Image* shown) {
    ImGui::Render();
    glm::ivec2 pixels;
    glfwGetFramebufferSize(state_->window, &pixels.x, &pixels.y);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, pixels.x, pixels.y);
    glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    if (shown && pixels.x > 0 && pixels.y > 0) {
        *shown = make_image(pixels.x, pixels.y, 3, PixelType::U8);
        const std::size_t row = std::size_t(pixels.x) * 3;
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        for (int y = 0; y < pixels.y; ++y)
            glReadPixels(0, pixels.y - 1 - y, pixels.x, 1, GL_RGB, GL_UNSIGNED_BYTE,
                         shown->bytes.data() + y * row);
        glPixelStorei(GL_PACK_ALIGNMENT, 4);
    }
    glfwSwapBuffers(state_->window);
    ++state_->frames;
}

void Window::drop_frame() { ImGui::EndFrame(); }

/// As ImGui 1.86 draws it: seen for 0.8 s, gone until 1.2 s, and again; below 0 somebody has just typed.
double Window::caret_changes_in_s() const {
    constexpr float seen = 0.8f, turn = 1.2f, after = 0.01f;
    const ImGuiContext& imgui = *ImGui::GetCurrentContext();
    const bool is_typing = imgui.ActiveId != 0 && imgui.InputTextState.ID == imgui.ActiveId;
    if (!is_typing || !imgui.IO.ConfigInputTextCursorBlink) return std::numeric_limits<double>::infinity();
    const float at = imgui.InputTextState.CursorAnim;
    const float phase = at > 0.0f ? std::fmod(at, turn) : at;
    return double((phase < seen ? seen : turn) - phase + after);
}

void Window::let_caret_blink(bool blinks) { ImGui::GetIO().ConfigInputTextCursorBlink = blinks; }

bool Window::out_of_sight() const {
    glm::ivec2 pixels;
    glfwGetFramebufferSize(state_->window, &pixels.x, &pixels.y);
    return pixels.x <= 0 || pixels.y <= 0 ||
           glfwGetWindowAttrib(state_->window, GLFW_ICONIFIED) == GLFW_TRUE ||
           glfwGetWindowAttrib(state_->window, GLFW_VISIBLE) != GLFW_TRUE;
}

std::uint64_t Window::frames() const { return state_->frames; }
double Window::time_s() const { return glfwGetTime(); }
float Window::interface_scale() const { return state_->scale; }
float Window::framebuffer_scale() const { return state_->framebuffer_scale; }
glm::ivec2 Window::framebuffer_px() const {
    glm::ivec2 size(0);
    glfwGetFramebufferSize(state_->window, &size.x, &size.y);
    return size;
}

glm::ivec2 Window::size() const {
    glm::ivec2 size;
    glfwGetWindowSize(state_->window, &size.x, &size.y);
    return size;
}

bool Window::maximized() const { return glfwGetWindowAttrib(state_->window, GLFW_MAXIMIZED) == GLFW_TRUE; }

std::string Window::description() const {
    const auto text = [](GLenum name) {
        const auto* bytes = reinterpret_cast<const char*>(glGetString(name));
        return std::string(bytes ? bytes : "?");
    };
    return text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
}

bool Window::follow_scale() {
    float scale = 1.0f, framebuffer = 1.0f;
    state_->measure_scale(scale, framebuffer);
    if (scale == state_->scale && framebuffer == state_->framebuffer_scale) return false;
    state_->scale = scale;
    state_->framebuffer_scale = framebuffer;
    ui::apply_theme(scale, framebuffer);
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
    look_up_fonts_as_pictures();
    return true;
}

void Window::set_title(const std::string& title) { glfwSetWindowTitle(state_->window, title.c_str()); }
void Window::set_clipboard(const std::string& text) { glfwSetClipboardString(state_->window, text.c_str()); }

void Window::move_mouse(glm::vec2 position) {
    state_->mouse = position;
    state_->events.any = true;
}

void Window::press_mouse(int button, bool down) {
    state_->mouse_down[button] = down;
    state_->events.any = true;
}

void Window::turn_wheel(float lines) {
    ImGui_ImplGlfw_ScrollCallback(state_->window, 0.0, lines);
    state_->events.any = true;
}

void Window::press_key(int key, bool down) {
    state_->keys.push_back({.key = key, .action = down ? GLFW_PRESS : GLFW_RELEASE});
    state_->events.any = true;
}

void Window::type_character(unsigned codepoint) {
    state_->keys.push_back({.is_character = true, .character = codepoint});
    state_->events.any = true;
}

void Window::drop_files(const std::vector<std::string>& files) {
    state_->events.drops.push_back({files, state_->mouse});
    state_->events.any = true;
}

void Window::set_shown(bool shown) {
    if (shown)
        glfwShowWindow(state_->window);
    else
        glfwHideWindow(state_->window);
    state_->events.any = true;
}

void Window::resize(glm::ivec2 size) { glfwSetWindowSize(state_->window, size.x, size.y); }

void Window::ask_to_close() { state_->events.close = state_->events.any = true; }
void Window::call_for_frame() { state_->events.any = true; }

namespace {
constexpr std::array<std::pair<const char*, int>, 21> kKeyNames{{{"ctrl", GLFW_KEY_LEFT_CONTROL},
                                                                 {"shift", GLFW_KEY_LEFT_SHIFT},
                                                                 {"alt", GLFW_KEY_LEFT_ALT},
                                                                 {"super", GLFW_KEY_LEFT_SUPER},
                                                                 {"escape", GLFW_KEY_ESCAPE},
                                                                 {"enter", GLFW_KEY_ENTER},
                                                                 {"tab", GLFW_KEY_TAB},
                                                                 {"space", GLFW_KEY_SPACE},
                                                                 {"backspace", GLFW_KEY_BACKSPACE},
                                                                 {"delete", GLFW_KEY_DELETE},
                                                                 {"insert", GLFW_KEY_INSERT},
                                                                 {"left", GLFW_KEY_LEFT},
                                                                 {"right", GLFW_KEY_RIGHT},
                                                                 {"up", GLFW_KEY_UP},
                                                                 {"down", GLFW_KEY_DOWN},
                                                                 {"home", GLFW_KEY_HOME},
                                                                 {"end", GLFW_KEY_END},
                                                                 {"pageup", GLFW_KEY_PAGE_UP},
                                                                 {"pagedown", GLFW_KEY_PAGE_DOWN},
                                                                 {"plus", GLFW_KEY_KP_ADD},
                                                                 {"minus", GLFW_KEY_MINUS}}};
}  // namespace

int key_code(const std::string& name) {
    if (name.size() == 1 && name[0] >= 'a' && name[0] <= 'z') return GLFW_KEY_A + (name[0] - 'a');
    if (name.size() == 1 && std::strchr("0123456789-=[]\\;',./` ", name[0]))
        return name[0];  // GLFW's codes for these are their ASCII codes
    if (name.size() >= 2 && name[0] == 'f' && name.find_first_not_of("0123456789", 1) == std::string::npos)
        return GLFW_KEY_F1 + std::clamp(std::atoi(name.c_str() + 1), 1, 25) - 1;
    for (const auto& [known, code] : kKeyNames)
        if (name == known) return code;
    return 0;
}

}  // namespace patina
