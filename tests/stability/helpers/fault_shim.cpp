// Loaded in front of the C library (LD_PRELOAD): counts what a program does to files below a folder and lets
// one of these operations go wrong.
//   PATINA_FAULT_FOLDER  only files below it count
//   PATINA_FAULT_AT      which operation, from 1
//   PATINA_FAULT_KIND    kill: the process ends in the middle of it, a write half done;
//                        full, broken: it and all later ones fail with ENOSPC or EIO
//   PATINA_FAULT_COUNT   file that gets the number of operations when the program ends by itself
#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <string>
#include <sys/uio.h>
#include <unistd.h>

namespace {

template <class F>
F* real(const char* name) {
    return reinterpret_cast<F*>(dlsym(RTLD_NEXT, name));
}

bool is_watched_descriptor[4096];
std::FILE* watched_streams[64];
int operations = 0;

bool is_below(const char* path) {
    const char* folder = std::getenv("PATINA_FAULT_FOLDER");
    if (!folder || !path) return false;
    char whole[8192];
    if (path[0] != '/') {
        if (!getcwd(whole, sizeof whole / 2)) return false;
        std::strcat(whole, "/");
        std::strncat(whole, path, sizeof whole / 2 - 2);
        path = whole;
    }
    return std::strncmp(path, folder, std::strlen(folder)) == 0;
}

bool is_watched(int descriptor) {
    return descriptor >= 0 && descriptor < 4096 && is_watched_descriptor[descriptor];
}
std::FILE** place_of(const std::FILE* stream) {
    for (std::FILE*& each : watched_streams)
        if (each == stream) return &each;
    return nullptr;
}

/// 0: go on. Else the error to fail with; −1: end now.
int verdict() {
    static const int at = std::getenv("PATINA_FAULT_AT") ? std::atoi(std::getenv("PATINA_FAULT_AT")) : 0;
    static const std::string kind = std::getenv("PATINA_FAULT_KIND") ? std::getenv("PATINA_FAULT_KIND") : "";
    ++operations;
    if (at == 0 || operations < at) return 0;
    if (kind == "kill") return operations == at ? -1 : 0;
    return kind == "full" ? ENOSPC : EIO;
}
[[noreturn]] void end() { _exit(137); }

/// For operations that have no half.
bool fails() {
    const int error = verdict();
    if (error < 0) end();
    errno = error;
    return error != 0;
}

struct Report {
    ~Report() {
        const char* file = std::getenv("PATINA_FAULT_COUNT");
        if (!file) return;
        const int out = real<int(const char*, int, ...)>("open")(file, O_WRONLY | O_CREAT | O_TRUNC, 0600);
        const std::string text = std::to_string(operations);
        if (out >= 0 && real<ssize_t(int, const void*, size_t)>("write")(out, text.data(), text.size()) >= 0)
            real<int(int)>("close")(out);
    }
} report;

int opened(const char* name, const char* path, int flags, mode_t mode) {
    const bool counts = (flags & (O_WRONLY | O_RDWR)) != 0 && is_below(path);
    if (counts && fails()) return -1;
    const int descriptor = real<int(const char*, int, ...)>(name)(path, flags, mode);
    if (counts && descriptor >= 0 && descriptor < 4096) is_watched_descriptor[descriptor] = true;
    return descriptor;
}
std::FILE* opened_stream(const char* name, const char* path, const char* mode) {
    const bool counts = (mode[0] != 'r' || std::strchr(mode, '+')) && is_below(path);
    if (counts && fails()) return nullptr;
    std::FILE* stream = real<std::FILE*(const char*, const char*)>(name)(path, mode);
    if (counts && stream)
        if (std::FILE** place = place_of(nullptr)) *place = stream;
    return stream;
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
    va_list rest;
    va_start(rest, flags);
    const auto mode = mode_t(va_arg(rest, unsigned));
    va_end(rest);
    return opened("open", path, flags, mode);
}
int open64(const char* path, int flags, ...) {
    va_list rest;
    va_start(rest, flags);
    const auto mode = mode_t(va_arg(rest, unsigned));
    va_end(rest);
    return opened("open64", path, flags, mode);
}
FILE* fopen(const char* path, const char* mode) { return opened_stream("fopen", path, mode); }
FILE* fopen64(const char* path, const char* mode) { return opened_stream("fopen64", path, mode); }

ssize_t write(int descriptor, const void* data, size_t size) {
    auto* go = real<ssize_t(int, const void*, size_t)>("write");
    if (!is_watched(descriptor)) return go(descriptor, data, size);
    const int error = verdict();
    if (error < 0) {
        if (size > 1 && go(descriptor, data, size / 2) < 0) end();
        end();
    }
    errno = error;
    return error != 0 ? -1 : go(descriptor, data, size);
}
ssize_t writev(int descriptor, const iovec* parts, int count) {
    auto* go = real<ssize_t(int, const iovec*, int)>("writev");
    if (!is_watched(descriptor)) return go(descriptor, parts, count);
    const int error = verdict();
    if (error < 0) {
        if (go(descriptor, parts, 1) < 0) end();
        end();
    }
    errno = error;
    return error != 0 ? -1 : go(descriptor, parts, count);
}
size_t fwrite(const void* data, size_t size, size_t count, FILE* stream) {
    auto* go = real<size_t(const void*, size_t, size_t, FILE*)>("fwrite");
    if (!place_of(stream)) return go(data, size, count, stream);
    const int error = verdict();
    if (error < 0) {
        const size_t half = size * count / 2;
        if (go(data, 1, half, stream) == half) real<int(FILE*)>("fflush")(stream);
        end();
    }
    errno = error;
    return error != 0 ? 0 : go(data, size, count, stream);
}
int fflush(FILE* stream) {
    if (stream && place_of(stream) && fails()) return EOF;
    return real<int(FILE*)>("fflush")(stream);
}
int fclose(FILE* stream) {
    std::FILE** place = stream ? place_of(stream) : nullptr;
    const bool failed = place && fails();
    const int error = errno;
    if (place) *place = nullptr;
    const int result = real<int(FILE*)>("fclose")(stream);
    if (failed) errno = error;
    return failed ? EOF : result;
}
int fsync(int descriptor) {
    if (is_watched(descriptor) && fails()) return -1;
    return real<int(int)>("fsync")(descriptor);
}
int close(int descriptor) {
    const bool failed = is_watched(descriptor) && fails();
    const int error = errno;
    if (descriptor >= 0 && descriptor < 4096) is_watched_descriptor[descriptor] = false;
    const int result = real<int(int)>("close")(descriptor);
    if (failed) errno = error;
    return failed ? -1 : result;
}
int rename(const char* from, const char* to) {
    if (is_below(to) && fails()) return -1;
    return real<int(const char*, const char*)>("rename")(from, to);
}
int mkdir(const char* path, mode_t mode) {
    if (is_below(path) && fails()) return -1;
    return real<int(const char*, mode_t)>("mkdir")(path, mode);
}
}
