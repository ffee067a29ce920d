#include "materials/text_io.h"

#include <cerrno>
#include <fstream>
#include <random>
#include <stdexcept>
#include <system_error>

#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#include <process.h>
#include <sys/stat.h>
#else
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace patina {

namespace fs = std::filesystem;

namespace {

std::string quoted(const fs::path& path) { return "'" + path_to_utf8(path) + "'"; }

[[noreturn]] void refuse_load(const fs::path& file, const std::string& why) {
    throw std::runtime_error("Cannot read " + quoted(file) + ": " + why + ".");
}
[[noreturn]] void refuse_save(const fs::path& file, const std::string& why) {
    throw std::runtime_error("Cannot save " + quoted(file) + ": " + why +
                             ". What was there before is unchanged; choose another place or make room.");
}
std::string reason(int code) { return std::generic_category().message(code); }

/// The few system calls that differ, with the same results: a descriptor or −1, 0 or −1, errno.
#ifdef _WIN32
int process_id() { return _getpid(); }
int create_new(const fs::path& file) {
    int descriptor = -1;
    const errno_t failure = _wsopen_s(&descriptor, file.c_str(), _O_WRONLY | _O_CREAT | _O_EXCL | _O_BINARY,
                                      _SH_DENYRW, _S_IREAD | _S_IWRITE);
    if (failure != 0) errno = failure;
    return descriptor;
}
long write_some(int descriptor, const char* data, std::size_t size) {
    return _write(descriptor, data, static_cast<unsigned>(size));
}
int flush_to_disk(int descriptor) { return _commit(descriptor); }
int close_file(int descriptor) { return _close(descriptor); }
void flush_folder(const fs::path&) {}
#else
int process_id() { return getpid(); }
int create_new(const fs::path& file) {
    return open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC,
                S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP | S_IROTH | S_IWOTH);
}
long write_some(int descriptor, const char* data, std::size_t size) { return write(descriptor, data, size); }
int flush_to_disk(int descriptor) { return fsync(descriptor); }
int close_file(int descriptor) { return close(descriptor); }
/// Makes the rename itself survive a power cut; a file system that cannot is no reason to fail.
void flush_folder(const fs::path& folder) {
    const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    fsync(descriptor);
    close(descriptor);
}
#endif

/// A file that removes itself unless it was renamed to its place.
class TemporaryFile {
public:
    explicit TemporaryFile(const fs::path& target) : target_(target) {
        const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
        // Process numbers come again: a killed one may have left files under this one's names.
        std::random_device random;
        for (int names = 0; descriptor_ < 0 && names < 100; ++names) {
            path_ = folder /
                    (".patina-" + std::to_string(process_id()) + "-" + std::to_string(random()) + ".tmp");
            descriptor_ = create_new(path_);
            if (descriptor_ < 0 && errno != EEXIST) break;
        }
        if (descriptor_ < 0) refuse_save(target_, reason(errno));
    }
    ~TemporaryFile() {
        if (descriptor_ >= 0) close_file(descriptor_);
        std::error_code ignored;
        if (!placed_) fs::remove(path_, ignored);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    TemporaryFile(TemporaryFile&&) = delete;
    TemporaryFile& operator=(TemporaryFile&&) = delete;

    void write_all(std::string_view text) {
        while (!text.empty()) {
            const long written = write_some(descriptor_, text.data(), text.size());
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) refuse_save(target_, reason(errno));
            text.remove_prefix(static_cast<std::size_t>(written));
        }
        if (flush_to_disk(descriptor_) != 0) refuse_save(target_, reason(errno));
        const int closed = close_file(descriptor_);
        descriptor_ = -1;
        if (closed != 0) refuse_save(target_, reason(errno));
    }
    void place() {
        std::error_code failure;
        const fs::file_status old = fs::status(target_, failure);
        if (fs::exists(old)) fs::permissions(path_, old.permissions(), failure);
        fs::rename(path_, target_, failure);
        if (failure) refuse_save(target_, failure.message());
        placed_ = true;
        flush_folder(path_.parent_path());
    }

private:
    fs::path target_, path_;
    int descriptor_ = -1;
    bool placed_ = false;
};

/// Where a chain of symbolic links ends, whether or not something is there.
fs::path end_of_links(fs::path path) {
    static constexpr int most_links = 40;
    std::error_code failure;
    for (int links = 0; fs::is_symlink(fs::symlink_status(path, failure)); ++links) {
        if (links == most_links) refuse_save(path, "its symbolic links go in a circle");
        const fs::path next = fs::read_symlink(path, failure);
        if (failure) refuse_save(path, failure.message());
        path = path.parent_path() / next;
    }
    return path;
}

}  // namespace

std::string path_to_utf8(const fs::path& path) {
    const std::u8string text = path.generic_u8string();
    return {text.begin(), text.end()};
}
fs::path utf8_to_path(std::string_view text) { return {std::u8string(text.begin(), text.end())}; }

std::string load_text(const fs::path& file, std::size_t max_bytes) {
    std::error_code failure;
    const fs::file_status status = fs::status(file, failure);
    if (!fs::exists(status)) refuse_load(file, failure ? failure.message() : "there is no such file");
    if (fs::is_directory(status)) refuse_load(file, "it is a folder");
    if (!fs::is_regular_file(status)) refuse_load(file, "it is not a regular file");
    const std::uintmax_t size = fs::file_size(file, failure);
    if (failure) refuse_load(file, failure.message());
    if (size > max_bytes)
        refuse_load(file, "it is larger than the limit of " + std::to_string(max_bytes / 1024) + " KiB");
    std::ifstream stream(file, std::ios::binary);
    if (!stream) refuse_load(file, "it cannot be opened; check its permissions");
    std::string text(static_cast<std::size_t>(size), '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (stream.bad()) refuse_load(file, "the disk reports an error");
    text.resize(static_cast<std::size_t>(stream.gcount()));
    return text;
}

void save_text(const fs::path& file, std::string_view text) {
    const fs::path target = end_of_links(file);
    std::error_code failure;
    const fs::file_status status = fs::status(target, failure);
    if (fs::is_directory(status)) refuse_save(file, "it is a folder");
    if (fs::exists(status) && !fs::is_regular_file(status)) refuse_save(file, "it is not a regular file");
    TemporaryFile temporary(target);
    temporary.write_all(text);
    temporary.place();
}

}  // namespace patina
