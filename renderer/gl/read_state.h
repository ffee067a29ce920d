// What reading pixels back depends on. Includes OpenGL: for renderer/gl's own files only.
#pragma once

#include <epoxy/gl.h>

namespace patina::gl {

/// glReadPixels and glGetTexImage write to memory, without gaps; puts back what was set before.
class KeepReadState {
public:
    KeepReadState() {
        glGetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &buffer_);
        glGetIntegerv(GL_PACK_ALIGNMENT, &alignment_);
        glGetIntegerv(GL_PACK_ROW_LENGTH, &row_length_);
        glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glPixelStorei(GL_PACK_ROW_LENGTH, 0);
    }
    ~KeepReadState() {
        glBindBuffer(GL_PIXEL_PACK_BUFFER, GLuint(buffer_));
        glPixelStorei(GL_PACK_ALIGNMENT, alignment_);
        glPixelStorei(GL_PACK_ROW_LENGTH, row_length_);
    }
    KeepReadState(const KeepReadState&) = delete;
    KeepReadState& operator=(const KeepReadState&) = delete;

private:
    GLint buffer_ = 0, alignment_ = 4, row_length_ = 0;
};

}  // namespace patina::gl
