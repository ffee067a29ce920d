#include "renderer/ibl/cache_entry_io.h"

#include "renderer/core/hash.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <fstream>
#include <random>
#include <system_error>
#include <type_traits>

namespace patina {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kByteOrder = 0x01020304;
constexpr std::size_t kKeyLength = 32;
constexpr const char* kExtensions = ".patina-";
constexpr const char* kTemporary = ".patina-tmp";

/// In the machine's byte order (marked, so that another machine's file counts as foreign).
struct Header {
    std::array<char, 8> magic{};
    std::uint32_t format = 0;
    std::uint32_t byte_order = kByteOrder;
    std::array<char, kKeyLength> key{};
    std::uint64_t file_bytes = 0;
    std::uint64_t payload_hash = 0;  ///< of everything after the header
    EntryCounts counts{};
    std::uint64_t header_hash = 0;  ///< of the fields above
};
static_assert(std::is_trivially_copyable_v<Header> && sizeof(Header) == 88);

std::uint64_t header_hash(const Header& header) {
    return hash_bytes(std::as_bytes(std::span(&header, 1)).first(offsetof(Header, header_hash)));
}

fs::path entry_path(const BakeCache& cache, const EntryKind& kind, const std::string& key) {
    return cache.folder / (key + kind.extension);
}

bool is_plausible(const Header& header, const EntryKind& kind, const std::string& key) {
    return header.magic == kind.magic && header.format == kind.format && header.byte_order == kByteOrder &&
           header.header_hash == header_hash(header) && key == std::string(header.key.data(), kKeyLength);
}

std::string hex(std::uint64_t value) {
    std::string digits(16, '0');
    for (int i = 0; i < 16; ++i) digits[i] = "0123456789abcdef"[(value >> (60 - 4 * i)) & 15];
    return digits;
}

bool write_file(const fs::path& file, const Header& header,
                std::span<const std::span<const std::byte>> sections) {
    std::ofstream out(file, std::ios::binary);
    out.write(reinterpret_cast<const char*>(&header), sizeof(header));
    for (const std::span<const std::byte> section : sections)
        out.write(reinterpret_cast<const char*>(section.data()), std::streamsize(section.size()));
    out.close();
    return !out.fail();
}

/// Oldest entries out until the rest fits, and what writers that died left behind. Other processes may do the
/// same at the same time: what is already gone is no error.
void trim(const BakeCache& cache, const fs::path& keep) {
    struct Entry {
        fs::path path;
        fs::file_time_type time;
        std::uint64_t bytes;
    };
    std::error_code error;
    std::vector<Entry> entries;
    std::uint64_t total = 0;
    const auto now = fs::file_time_type::clock::now();
    for (fs::directory_iterator it(cache.folder, error), end; !error && it != end; it.increment(error)) {
        std::error_code gone;
        const Entry entry{it->path(), it->last_write_time(gone), it->file_size(gone)};
        if (gone) continue;
        const bool is_temporary = entry.path.extension() == kTemporary;
        if (is_temporary && now - entry.time > std::chrono::hours(1)) fs::remove(entry.path, gone);
        if (is_temporary || !entry.path.extension().string().starts_with(kExtensions)) continue;
        total += entry.bytes;
        if (entry.path != keep) entries.push_back(entry);
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.time < b.time; });
    for (const Entry& entry : entries) {
        if (total <= cache.max_bytes) break;
        std::error_code gone;
        fs::remove(entry.path, gone);
        total -= entry.bytes;
    }
}

std::string cannot_keep(const BakeCache& cache, const std::string& why) {
    return "The baked light could not be kept in " + cache.folder.string() + " (" + why +
           "); it will be computed again next time.";
}

}  // namespace

std::optional<EntryReader> EntryReader::open(const BakeCache& cache, const EntryKind& kind,
                                             const std::string& key) {
    EntryReader reader;
    reader.path_ = entry_path(cache, kind, key);
    reader.in_ = std::make_unique<std::ifstream>(reader.path_, std::ios::binary | std::ios::ate);
    if (!*reader.in_) return std::nullopt;
    const std::streamoff end = reader.in_->tellg();
    if (end < std::streamoff(sizeof(Header))) return std::nullopt;
    reader.in_->seekg(0);
    Header header;
    if (!reader.in_->read(reinterpret_cast<char*>(&header), sizeof(header)) ||
        !is_plausible(header, kind, key) || header.file_bytes != std::uint64_t(end))
        return std::nullopt;
    reader.counts_ = header.counts;
    reader.left_ = header.file_bytes - sizeof(Header);
    reader.promised_ = header.payload_hash;
    return reader;
}

bool EntryReader::read(std::span<std::byte> section) {
    if (section.size() > left_) return false;
    if (!in_->read(reinterpret_cast<char*>(section.data()), std::streamsize(section.size()))) return false;
    left_ -= section.size();
    hash_ = hash_bytes(section, hash_);
    return true;
}

bool EntryReader::finish() {
    if (left_ > 0 || hash_ != promised_) return false;
    std::error_code ignored;  // the order of removal is by last use, where the folder lets us say so
    fs::last_write_time(path_, fs::file_time_type::clock::now(), ignored);
    return true;
}

std::string save_entry(const BakeCache& cache, const EntryKind& kind, const std::string& key,
                       const EntryCounts& counts, std::span<const std::span<const std::byte>> sections) {
    assert(key.size() == kKeyLength);
    Header header{.magic = kind.magic, .format = kind.format, .counts = counts};
    std::copy(key.begin(), key.end(), header.key.begin());
    header.file_bytes = sizeof(Header);
    for (const std::span<const std::byte> section : sections) {
        header.file_bytes += section.size();
        header.payload_hash = hash_bytes(section, header.payload_hash);
    }
    header.header_hash = header_hash(header);
    if (header.file_bytes > cache.max_bytes)
        return cannot_keep(cache, "it is larger than the cache may grow");

    std::error_code error;
    fs::create_directories(cache.folder, error);
    if (error) return cannot_keep(cache, error.message());
    const fs::path target = entry_path(cache, kind, key);
    std::random_device random;
    const fs::path temporary =
        cache.folder / (key + "." + hex((std::uint64_t(random()) << 32) | random()) + kTemporary);
    if (!write_file(temporary, header, sections)) {
        fs::remove(temporary, error);
        return cannot_keep(cache, "it cannot be written");
    }
    fs::rename(temporary, target, error);
    if (error) {
        const std::string why = error.message();
        fs::remove(temporary, error);
        return cannot_keep(cache, why);
    }
    trim(cache, target);
    return {};
}

std::string entry_key(std::span<const std::uint64_t> words) {
    return hex(hash_bytes(std::as_bytes(words), 1)) + hex(hash_bytes(std::as_bytes(words), 2));
}

std::vector<char> joined_texts(std::span<const std::string> texts) {
    std::vector<char> bytes;
    for (const std::string& text : texts) {
        bytes.insert(bytes.end(), text.begin(), text.end());
        bytes.push_back('\0');
    }
    return bytes;
}

std::vector<std::string> split_texts(std::span<const char> bytes) {
    std::vector<std::string> texts;
    for (auto begin = bytes.begin(); begin != bytes.end();) {
        const auto end = std::find(begin, bytes.end(), '\0');
        texts.emplace_back(begin, end);
        begin = end == bytes.end() ? end : end + 1;
    }
    return texts;
}

}  // namespace patina
