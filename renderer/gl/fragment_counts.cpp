#include "renderer/gl/fragment_counts.h"

#include <utility>

namespace patina::gl {

namespace {

constexpr std::size_t kMostAsked = 64;  ///< beyond, a picture goes uncounted

}  // namespace

FragmentCounts::FragmentCounts()
    : counts_(epoxy_gl_version() >= 46 || epoxy_has_gl_extension("GL_ARB_pipeline_statistics_query")) {}

void FragmentCounts::begin() {
    if (!counts_) return;
    if (free_.empty()) free_.push_back(Query::make());
    glBeginQuery(GL_FRAGMENT_SHADER_INVOCATIONS_ARB, free_.back().name());
}

void FragmentCounts::end() {
    if (!counts_) return;
    glEndQuery(GL_FRAGMENT_SHADER_INVOCATIONS_ARB);
    if (asked_.size() >= kMostAsked) return;
    asked_.push_back(std::move(free_.back()));
    free_.pop_back();
}

std::uint64_t FragmentCounts::take() {
    std::uint64_t sum = 0;
    while (!asked_.empty()) {
        GLuint is_there = GL_FALSE;
        glGetQueryObjectuiv(asked_.front().name(), GL_QUERY_RESULT_AVAILABLE, &is_there);
        if (is_there == GL_FALSE) break;
        GLuint64 count = 0;
        glGetQueryObjectui64v(asked_.front().name(), GL_QUERY_RESULT, &count);
        sum += count;
        free_.push_back(std::move(asked_.front()));
        asked_.pop_front();
    }
    return sum;
}

}  // namespace patina::gl
