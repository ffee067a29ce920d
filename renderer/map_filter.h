// A mip chain filtered in one pass from the rows of its finest level, with two rows of memory a level. Pure.
#pragma once

#include "renderer/core/image.h"

#include <array>
#include <cstddef>
#include <vector>

namespace patina {

/// What the numbers of a level mean, which is what an average of them must respect.
enum class Meaning {
    Number,
    SrgbLight,  ///< the first three channels are averaged as light
    Direction   ///< averaged as unit vectors; alpha of smaller levels: 1 − √spread (make_map_levels)
};

/// Box filter from size to half of it (rounded down, at least 1): an odd size n = 2m + 1 has windows of n/m
/// texels, so each output takes three, the outer two in part.
struct Box {
    int size = 1;
    int smaller = 1;
    float weight(int output, int input) const;
    int last_input(int output) const { return size == 1 ? 0 : 2 * output + (size % 2 == 0 ? 1 : 2); }
};

/// Channels of a row one after the other: channel c of texel x at [c · width + x].
using Planes = std::vector<float>;

/// Makes one level from the rows of the one above as they come, and gives its own rows before rounding them.
class LevelFilter {
public:
    /// above: shape alone matters.
    LevelFilter(const Image& above, const Image& own);
    /// The row that this one finishes, valid until the next call, or null.
    const float* push(const float* row, int planes);
    int rows_done() const { return output_; }
    /// From one plane to three equal ones.
    void widen();
    std::size_t floats() const;  ///< in memory

private:
    void reduce(const float* row, int planes);

    Box across_, down_;
    std::array<Planes, 2> sums_;
    Planes reduced_, finished_;
    int input_ = 0, output_ = 0;
};

/// levels: finest first, of one type and channel count, down to 1×1; those without bytes are filtered through
/// but not kept. The first is the caller's to fill.
class MipChain {
public:
    /// planes: how many of the channels the rows hold; what is missing of red, green and blue is as the
    /// first, alpha is 1.
    MipChain(std::vector<Image>& levels, Meaning meaning, int planes);
    /// row: texels of the finest level's type, channels of them interleaved, of which the first are taken.
    void push(const std::byte* row, int channels);
    /// Rows held so far one plane; from now on they hold three.
    void widen();
    /// Of the rows in memory.
    std::size_t bytes() const;

private:
    std::vector<Image>& levels_;
    Meaning meaning_;
    int planes_;
    Planes top_, coded_;
    std::vector<LevelFilter> filters_;
};

}  // namespace patina
