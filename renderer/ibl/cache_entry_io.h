// One entry of the cache folder: a header with checksums, then sections of plain data. Never trusted, never
// half written, and all kinds of entries bounded together. Knows nothing of what an entry means.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <istream>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace patina {

struct BakeCache {
    std::filesystem::path folder;                        ///< created when first written
    std::uint64_t max_bytes = std::uint64_t{512} << 20;  ///< oldest entries are removed beyond this
};

struct EntryKind {
    std::array<char, 8> magic;
    std::uint32_t format = 1;  ///< raised whenever the sections change
    const char* extension;     ///< ".patina-…"
};

/// What the kind makes of them: how many of something, how many bytes.
using EntryCounts = std::array<std::uint32_t, 4>;

/// An entry while it is read, section by section.
class EntryReader {
public:
    /// nullopt when absent, truncated, foreign, of another kind, format or key.
    static std::optional<EntryReader> open(const BakeCache& cache, const EntryKind& kind,
                                           const std::string& key);
    const EntryCounts& counts() const { return counts_; }
    /// Bytes not read yet: nothing large is to be allocated before it is known to be there.
    std::uint64_t left() const { return left_; }
    /// False if there is not as much.
    bool read(std::span<std::byte> section);
    /// True if all was read and the checksum holds; marks the entry as just used.
    bool finish();

private:
    EntryReader() = default;

    std::filesystem::path path_;
    std::unique_ptr<std::istream> in_;
    EntryCounts counts_{};
    std::uint64_t left_ = 0;
    std::uint64_t hash_ = 0;      ///< of what was read
    std::uint64_t promised_ = 0;  ///< of the whole, as the header says
};

template <class T, class Allocator>
std::span<std::byte> section_of(std::vector<T, Allocator>& values) {
    return std::as_writable_bytes(std::span(values));
}
template <class T, class Allocator>
std::span<const std::byte> section_of(const std::vector<T, Allocator>& values) {
    return std::as_bytes(std::span(values));
}

/// Temporary file, then rename; the least recently used entries of any kind make room. Empty, or where it
/// cannot be kept a sentence that says why.
std::string save_entry(const BakeCache& cache, const EntryKind& kind, const std::string& key,
                       const EntryCounts& counts, std::span<const std::span<const std::byte>> sections);

/// 32 hexadecimal digits.
std::string entry_key(std::span<const std::uint64_t> words);

/// Texts as one section, each ended by a zero byte, and back.
std::vector<char> joined_texts(std::span<const std::string> texts);
std::vector<std::string> split_texts(std::span<const char> bytes);

}  // namespace patina
