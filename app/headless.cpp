#include "app/headless.h"

#include <epoxy/gl.h>

#include <stdexcept>
#include <vector>
#ifdef __linux__
#include <epoxy/egl.h>
#else
#include <GLFW/glfw3.h>
#endif

namespace patina {

namespace {

constexpr const char* kNoContext =
    "There is no OpenGL 4.1 to draw with: install a graphics driver, or Mesa's software renderer "
    "(on Debian the packages libegl1 and libgl1-mesa-dri).";

}  // namespace

#ifdef __linux__

struct HeadlessContext::State {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    EGLSurface surface = EGL_NO_SURFACE;
    // What was current on this thread before, and is again afterwards.
    EGLDisplay previous_display = eglGetCurrentDisplay();
    EGLContext previous_context = eglGetCurrentContext();
    EGLSurface previous_draw = eglGetCurrentSurface(EGL_DRAW);
    EGLSurface previous_read = eglGetCurrentSurface(EGL_READ);
};

namespace {

/// Displays that need no window system, the most portable first, then one per graphics device, then the
/// default.
std::vector<EGLDisplay> candidate_displays() {
    std::vector<EGLDisplay> displays;
    const bool has_platforms = epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base");
    if (has_platforms && epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
        displays.push_back(
            eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
    if (has_platforms && epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
        EGLDeviceEXT devices[16];
        EGLint count = 0;
        if (eglQueryDevicesEXT(16, devices, &count))
            for (EGLint i = 0; i < count; ++i)
                displays.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
    }
    displays.push_back(eglGetDisplay(EGL_DEFAULT_DISPLAY));
    return displays;
}

EGLContext create_core_context(EGLDisplay display, EGLConfig config) {
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 4,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 1,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_NONE};
    return eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
}

void release(EGLDisplay display, EGLContext context, EGLSurface surface) {
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (surface != EGL_NO_SURFACE) eglDestroySurface(display, surface);
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
}

/// Fills in context (and a 1×1 surface where the driver wants one) and makes it current; false if this
/// display cannot.
bool try_display(EGLDisplay display, EGLContext& context, EGLSurface& surface) {
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) return false;
    if (!eglBindAPI(EGL_OPENGL_API)) return false;
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                             EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    const bool has_config = eglChooseConfig(display, wanted, &config, 1, &count) && count > 0;
    if (!has_config) config = nullptr;
    context = create_core_context(display, config);
    if (context == EGL_NO_CONTEXT) return false;
    surface = EGL_NO_SURFACE;
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) return true;
    if (has_config) {
        const EGLint tiny[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
        surface = eglCreatePbufferSurface(display, config, tiny);
        if (surface != EGL_NO_SURFACE && eglMakeCurrent(display, surface, surface, context)) return true;
    }
    release(display, context, surface);
    context = EGL_NO_CONTEXT;
    surface = EGL_NO_SURFACE;
    return false;
}

}  // namespace

HeadlessContext::HeadlessContext() : state_(std::make_unique<State>()) {
    for (EGLDisplay display : candidate_displays()) {
        if (!try_display(display, state_->context, state_->surface)) continue;
        state_->display = display;
        return;
    }
    throw std::runtime_error(kNoContext);
}

// The display stays initialised: EGL shares it within the process and other contexts may live on it.
HeadlessContext::~HeadlessContext() {
    release(state_->display, state_->context, state_->surface);
    if (state_->previous_context != EGL_NO_CONTEXT)
        eglMakeCurrent(state_->previous_display, state_->previous_draw, state_->previous_read,
                       state_->previous_context);
}

#else

struct HeadlessContext::State {
    GLFWwindow* window = nullptr;
    GLFWwindow* previous = nullptr;
};

HeadlessContext::HeadlessContext() : state_(std::make_unique<State>()) {
    if (!glfwInit()) throw std::runtime_error(kNoContext);
    state_->previous = glfwGetCurrentContext();
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 1);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    state_->window = glfwCreateWindow(16, 16, "patina", nullptr, nullptr);
    if (!state_->window) throw std::runtime_error(kNoContext);
    glfwMakeContextCurrent(state_->window);
}

HeadlessContext::~HeadlessContext() {
    glfwDestroyWindow(state_->window);
    if (state_->previous) glfwMakeContextCurrent(state_->previous);
}

#endif

std::string HeadlessContext::description() const {
    const auto text = [](GLenum name) {
        const auto* value = reinterpret_cast<const char*>(glGetString(name));
        return std::string(value ? value : "unknown");
    };
    return text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
}

}  // namespace patina
