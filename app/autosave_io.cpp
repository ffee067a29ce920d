#include "app/autosave.h"
#include "materials/text_io.h"

#include <algorithm>
#include <exception>
#include <utility>

#ifdef _WIN32
#include <windows.h>
#else
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#endif

namespace patina {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxRecoveryBytes = 16 << 20;
constexpr int kNamesTried = 100;

/// An empty file that only one holder can have; the system lets go of it however the holder ends.
class LockFile {
public:
    LockFile() = default;
    LockFile(LockFile&& other) noexcept
        : handle_(std::exchange(other.handle_, kNone)), path_(std::move(other.path_)) {}
    LockFile& operator=(LockFile&& other) noexcept {
        std::swap(handle_, other.handle_);
        std::swap(path_, other.path_);
        return *this;
    }
    LockFile(const LockFile&) = delete;
    LockFile& operator=(const LockFile&) = delete;
    ~LockFile() { release(); }

    /// False if somebody else has it, or the folder does not allow it.
    bool take(const fs::path& path) {
        release();
#ifdef _WIN32
        handle_ = CreateFileW(path.c_str(), GENERIC_READ | GENERIC_WRITE, 0, nullptr, OPEN_ALWAYS,
                              FILE_ATTRIBUTE_NORMAL | FILE_FLAG_DELETE_ON_CLOSE, nullptr);
        if (handle_ == kNone) return false;
#else
        const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
        if (descriptor < 0) return false;
        if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
            ::close(descriptor);
            return false;
        }
        handle_ = descriptor;
#endif
        path_ = path;
        return true;
    }
    void release() {
        if (handle_ == kNone) return;
#ifdef _WIN32
        CloseHandle(handle_);
#else
        ::unlink(path_.c_str());
        ::close(handle_);
#endif
        handle_ = kNone;
    }
    bool held() const { return handle_ != kNone; }

private:
#ifdef _WIN32
    using Handle = HANDLE;
    inline static const Handle kNone = INVALID_HANDLE_VALUE;
#else
    using Handle = int;
    static constexpr Handle kNone = -1;
#endif
    Handle handle_ = kNone;
    fs::path path_;
};

long process_id() {
#ifdef _WIN32
    return static_cast<long>(GetCurrentProcessId());
#else
    return static_cast<long>(::getpid());
#endif
}

fs::path lock_of(fs::path recovery_file) { return recovery_file.replace_extension(".lock"); }

}  // namespace

struct RecoveryFiles::State {
    fs::path folder;
    fs::path file;
    LockFile lock;
    std::vector<LockFile> claimed;
    std::string problem;
};

RecoveryFiles::RecoveryFiles(fs::path folder) : state_(std::make_unique<State>()) {
    state_->folder = std::move(folder);
    std::error_code failure, ignored;
    fs::create_directories(state_->folder, failure);
    for (int i = 0; i < kNamesTried && !state_->lock.held(); ++i) {
        const fs::path file =
            state_->folder / ("recovery-" + std::to_string(process_id()) + "-" + std::to_string(i) + ".json");
        if (fs::exists(file, ignored)) continue;  // left by an earlier program with this process id
        if (state_->lock.take(lock_of(file))) state_->file = file;
    }
    if (!state_->lock.held())
        state_->problem =
            path_to_utf8(state_->folder) +
            ": cannot be written, so unsaved work is not kept for a crash; set PATINA_STATE_DIR to a "
            "folder of your own.";
}

RecoveryFiles::~RecoveryFiles() = default;

const std::string& RecoveryFiles::problem() const { return state_->problem; }

void RecoveryFiles::write(std::string_view text) {
    if (state_->lock.held()) save_text(state_->file, text);
}

void RecoveryFiles::remove() {
    std::error_code ignored;
    if (state_->lock.held()) fs::remove(state_->file, ignored);
}

std::optional<RecoveryFiles::Orphan> RecoveryFiles::claim_orphan() {
    std::optional<Orphan> newest;
    LockFile newest_lock;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(state_->folder, ignored)) {
        const fs::path& file = entry.path();
        const std::string name = path_to_utf8(file.filename());
        if (name.rfind("recovery-", 0) != 0 || file.extension() != ".json" || file == state_->file) continue;
        LockFile lock;
        if (!lock.take(lock_of(file))) continue;  // its editor lives, or another one has claimed it
        std::optional<Recovery> recovery;
        try {
            recovery = parse_recovery(load_text(file, kMaxRecoveryBytes));
        } catch (const std::exception&) {
            continue;  // gone meanwhile, or unreadable: left where it is
        }
        if (!recovery || (newest && newest->recovery.unix_time_s >= recovery->unix_time_s)) continue;
        newest = Orphan{file, std::move(*recovery)};
        newest_lock = std::move(lock);
    }
    if (newest) state_->claimed.push_back(std::move(newest_lock));
    return newest;
}

void RecoveryFiles::discard(const Orphan& orphan) {
    std::error_code ignored;
    fs::remove(orphan.file, ignored);
}

}  // namespace patina
