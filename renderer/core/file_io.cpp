#include "renderer/core/file_io.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <random>
#include <stdexcept>
#include <system_error>

#ifdef _WIN32
#include <io.h>
#else
#include <unistd.h>
#endif

namespace patina {
namespace {

namespace fs = std::filesystem;

/// A C stream, the one kind that can be flushed to the disk on every system, and its end.
struct CloseStream {
    // NOLINTNEXTLINE(cppcoreguidelines-owning-memory)
    void operator()(std::FILE* stream) const { std::fclose(stream); }
};
using Stream = std::unique_ptr<std::FILE, CloseStream>;

Stream open_stream(const fs::path& file, const char* mode) {
#ifdef _WIN32
    const std::wstring wide_mode(mode, mode + std::char_traits<char>::length(mode));
    return Stream(_wfopen(file.c_str(), wide_mode.c_str()));
#else
    return Stream(std::fopen(file.c_str(), mode));
#endif
}

bool flush_to_disk(std::FILE* stream) {
    if (std::fflush(stream) != 0) return false;
#ifdef _WIN32
    return _commit(_fileno(stream)) == 0;
#else
    return fsync(fileno(stream)) == 0;
#endif
}

std::string reason(int error) { return std::generic_category().message(error); }

[[noreturn]] void fail(const fs::path& file, const std::string& what) {
    throw std::runtime_error(path_text(file) + ": " + what);
}

/// Removes the temporary file unless it was renamed away.
class Leftover {
public:
    explicit Leftover(fs::path file) : file_(std::move(file)) {}
    ~Leftover() {
        std::error_code ignored;
        if (!file_.empty()) fs::remove(file_, ignored);
    }
    Leftover(const Leftover&) = delete;
    Leftover& operator=(const Leftover&) = delete;
    Leftover(Leftover&&) = delete;
    Leftover& operator=(Leftover&&) = delete;
    void keep() { file_.clear(); }

private:
    fs::path file_;
};

/// A name of its own in the same folder: ".patina-xxxxxxxx.tmp". Short, for the file's own may be as long as
/// names can be.
fs::path temporary_name(const fs::path& file) {
    std::array<char, 16> random{};
    std::snprintf(random.data(), random.size(), "%08x", static_cast<unsigned>(std::random_device()()));
    return file.parent_path() / (std::string(".patina-") + random.data() + ".tmp");
}

/// Where a chain of symbolic links ends, whether or not something is there: what is written through a link
/// replaces the file, not the link.
fs::path end_of_links(const fs::path& file) {
    std::error_code error;
    fs::path path = file;
    for (int links = 0; fs::is_symlink(fs::symlink_status(path, error)); ++links) {
        if (links == 40) fail(file, "its symbolic links go in a circle; choose another name");
        const fs::path next = fs::read_symlink(path, error);
        if (error) fail(file, "cannot be followed (" + error.message() + "); choose another name");
        path = path.parent_path() / next;
    }
    return path;
}

void write_all(const fs::path& file, const fs::path& temporary, std::span<const std::byte> bytes) {
    const Stream stream = open_stream(temporary, "wbx");
    if (!stream) fail(file, "cannot be written (" + reason(errno) + "); choose another folder");
    const bool written =
        (bytes.empty() || std::fwrite(bytes.data(), 1, bytes.size(), stream.get()) == bytes.size()) &&
        flush_to_disk(stream.get());
    if (!written)
        fail(file, "could not be written completely (" + reason(errno) +
                       "); free some space or choose another folder");
}

}  // namespace

std::string path_text(const fs::path& file) {
    const std::u8string text = file.u8string();
    return {text.begin(), text.end()};
}

std::vector<std::byte> read_file(const fs::path& file, std::uint64_t max_bytes) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (status.type() == fs::file_type::not_found) fail(file, "there is no such file; check the path");
    if (fs::is_directory(status)) fail(file, "is a folder; name a file in it");
    if (error) fail(file, "cannot be reached (" + error.message() + "); check its permissions");
    if (!fs::is_regular_file(status)) fail(file, "is not a regular file; copy its contents to one");
    const std::uint64_t size = fs::file_size(file, error);
    if (error) fail(file, "cannot be read (" + error.message() + ")");
    const Stream stream = open_stream(file, "rb");
    if (!stream) fail(file, "cannot be opened (" + reason(errno) + "); check its permissions");
    std::vector<std::byte> bytes(static_cast<std::size_t>(std::min(size, max_bytes)));
    if (!bytes.empty()) bytes.resize(std::fread(bytes.data(), 1, bytes.size(), stream.get()));
    if (std::ferror(stream.get()))
        fail(file, "could not be read to its end (" + reason(errno) + "); check the disk");
    return bytes;
}

void write_file(const fs::path& file, std::span<const std::byte> bytes) {
    std::error_code error;
    if (file.filename().empty()) fail(file, "is not a file name; add one");
    const fs::path target = end_of_links(file);
    const fs::file_status status = fs::status(target, error);
    if (fs::is_directory(status)) fail(file, "is a folder; name a file in it");
    if (fs::exists(status) && !fs::is_regular_file(status))
        fail(file, "is not a regular file; choose another name");
    const fs::path temporary = temporary_name(target);
    Leftover leftover(temporary);
    write_all(file, temporary, bytes);
    fs::rename(temporary, target, error);
    if (error) fail(file, "cannot be replaced (" + error.message() + "); choose another name");
    leftover.keep();
}

}  // namespace patina
