// How often fragment shaders ran, where the driver counts that (OpenGL 4.6,
// GL_ARB_pipeline_statistics_query). Nobody waits for a count: what the driver has not finished yet is asked
// for again. Needs a current context.
#pragma once

#include "renderer/gl/handles.h"

#include <cstdint>
#include <deque>

namespace patina::gl {

class FragmentCounts {
public:
    FragmentCounts();
    /// What is drawn between them is counted; one at a time.
    void begin();
    void end();
    /// Of all that ended and is known now; each is told once.
    std::uint64_t take();

private:
    bool counts_;
    std::deque<Query> asked_, free_;
};

}  // namespace patina::gl
