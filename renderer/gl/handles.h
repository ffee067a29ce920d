// OpenGL objects that are deleted when their owner goes: one move-only type, eight kinds. Needs a current
// context.
#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace patina::gl {

/// Kind has static create() and destroy(GLuint).
template <class Kind>
class Handle {
public:
    Handle() = default;
    static Handle make() {
        Handle handle;
        handle.name_ = Kind::create();
        return handle;
    }
    Handle(Handle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() {
        if (name_ != 0) Kind::destroy(name_);
    }
    GLuint name() const { return name_; }
    explicit operator bool() const { return name_ != 0; }

private:
    GLuint name_ = 0;
};

/// Of objects whose names come from glGen*, many at a time.
template <auto& generate, auto& remove>
struct GeneratedKind {
    static GLuint create() {
        GLuint name = 0;
        generate(1, &name);
        return name;
    }
    static void destroy(GLuint name) { remove(1, &name); }
};
struct ProgramKind {
    static GLuint create() { return glCreateProgram(); }
    static void destroy(GLuint name) { glDeleteProgram(name); }
};

using Texture = Handle<GeneratedKind<glGenTextures, glDeleteTextures>>;
using Sampler = Handle<GeneratedKind<glGenSamplers, glDeleteSamplers>>;
using Buffer = Handle<GeneratedKind<glGenBuffers, glDeleteBuffers>>;
using VertexArray = Handle<GeneratedKind<glGenVertexArrays, glDeleteVertexArrays>>;
using Framebuffer = Handle<GeneratedKind<glGenFramebuffers, glDeleteFramebuffers>>;
using Renderbuffer = Handle<GeneratedKind<glGenRenderbuffers, glDeleteRenderbuffers>>;
using Program = Handle<ProgramKind>;
using Query = Handle<GeneratedKind<glGenQueries, glDeleteQueries>>;

}  // namespace patina::gl
