// What the headers of an OpenEXR file promise, told from the bytes alone: it stands before the library, which
// allocates on the word of a header. Decodes no pixels and knows no file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace patina {

struct ExrStructure {
    std::uint64_t header_bytes = 0;  ///< all headers, from the file's first byte; 0: they go on behind start
    std::string problem;             ///< what follows the file's name in a sentence; empty where nothing
};

/// start: the first bytes of a file of that size. Every attribute must end inside the file, and so must the
/// table of offsets, 8 bytes for each block of pixels. Source: "OpenEXR File Layout", openexr.com.
ExrStructure exr_structure(std::span<const std::byte> start, std::uint64_t file_bytes);

}  // namespace patina
