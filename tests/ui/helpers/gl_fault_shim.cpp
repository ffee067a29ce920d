// Loaded in front of everything (LD_PRELOAD): lets the graphics card run out of memory or be reset, as the
// program sees it. Puts itself in place of functions in libepoxy's table of them.
//   PATINA_GL_MEMORY  widest colour map in 8 bits that has a place, in texels
//   PATINA_GL_LOST    the context is lost from the moment this file is there
#include <epoxy/gl.h>

#include <cstdlib>
#include <dlfcn.h>
#include <unistd.h>

namespace {

void* library() {
    static void* const opened = [] {
        void* open = dlopen("libOpenGL.so.0", RTLD_LAZY | RTLD_LOCAL);
        return open ? open : dlopen("libGL.so.1", RTLD_LAZY | RTLD_LOCAL);
    }();
    return opened;
}
template <class F>
F real(const char* name) {
    return reinterpret_cast<F>(dlsym(library(), name));
}

bool out_of_memory = false;

GLenum get_error() {
    static const auto next = real<PFNGLGETERRORPROC>("glGetError");
    if (!out_of_memory) return next();
    out_of_memory = false;
    return GL_OUT_OF_MEMORY;
}

void tex_image(GLenum target, GLint level, GLint internal, GLsizei width, GLsizei height, GLint border,
               GLenum format, GLenum type, const void* pixels) {
    static const auto next = real<PFNGLTEXIMAGE2DPROC>("glTexImage2D");
    static const char* const most = std::getenv("PATINA_GL_MEMORY");
    const bool is_color = internal == GL_SRGB8 || internal == GL_SRGB8_ALPHA8;
    if (most && is_color && width > std::atoi(most))
        out_of_memory = true;
    else
        next(target, level, internal, width, height, border, format, type, pixels);
}

GLenum reset_status() {
    const char* file = std::getenv("PATINA_GL_LOST");
    return file && access(file, F_OK) == 0 ? GL_UNKNOWN_CONTEXT_RESET_ARB : GL_NO_ERROR;
}

__attribute__((constructor)) void take_their_places() {
    epoxy_glGetError = get_error;
    epoxy_glTexImage2D = tex_image;
    epoxy_glGetGraphicsResetStatusARB = reset_status;
}

}  // namespace
