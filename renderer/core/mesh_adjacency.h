// Which triangle lies across which edge, in near-linear time, for any soup of triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace patina {

inline constexpr std::uint32_t kNoCorner = 0xffffffffu;

/// corner_vertex holds three vertex numbers a triangle. The result holds for each half edge h (from corner h
/// to the next corner of its triangle) the half edge of another triangle that runs the same edge the other
/// way, or kNoCorner. Where more than two triangles meet at an edge they are paired in order of appearance
/// and the rest stay alone.
std::vector<std::uint32_t> opposite_half_edges(std::span<const std::uint32_t> corner_vertex);

/// The following and the preceding corner of the same triangle.
inline constexpr std::uint32_t next_corner(std::uint32_t c) { return c % 3 == 2 ? c - 2 : c + 1; }
inline constexpr std::uint32_t previous_corner(std::uint32_t c) { return c % 3 == 0 ? c + 2 : c - 1; }

}  // namespace patina
