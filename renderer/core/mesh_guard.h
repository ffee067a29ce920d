// A look at a mesh file's bytes before OpenMesh reads them.
//
// OpenMesh's readers trust their input. On a number they cannot read they skip the vertex, so that all later
// indices point elsewhere; a cut-off or lying file makes them read uninitialised counts, past arrays or
// without end. Each guard below makes sure that its reader may trust: what has an obvious meaning is repaired
// in the text itself and noted, what has not is refused with one sentence (std::runtime_error, without the
// file's name). Nothing is allocated on a header's word.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace patina {

/// More than this is refused: indices stay below 2³¹, and no laptop shows more.
inline constexpr std::uint64_t kMaxMeshFaces = 100'000'000;
inline constexpr std::uint64_t kMaxMeshVertices = 100'000'000;
inline constexpr std::uint64_t kMaxMeshFileBytes = std::uint64_t{4} << 30;

struct GuardedFile {
    std::string text;  ///< what the reader gets
    bool binary = false;
    bool has_lists = false;                     ///< PLY: lists besides the vertex indices
    std::vector<std::uint32_t> lost_positions;  ///< vertices that are no finite point; 0 in the text
    std::size_t faces = 0;                      ///< as the file says; the reader may drop some
    std::vector<std::string> notes;
};

GuardedFile guard_obj(std::string text);
GuardedFile guard_off(std::string text);
GuardedFile guard_ply(std::string text);
GuardedFile guard_stl(std::string text);

}  // namespace patina
