// Spreading a bake over whatever the caller's parallel_for offers.
#pragma once

#include "renderer/ibl/bake.h"

#include <atomic>
#include <cstddef>
#include <hwy/aligned_allocator.h>
#include <memory>
#if __has_include(<sys/mman.h>)
#include <sys/mman.h>
#endif

namespace patina {

/// body(i, scratch) for i = 0 … count − 1 in that order of start; every worker makes one scratch and keeps
/// it. Results must not depend on which worker runs what. Ends early when stopped.
template <class MakeScratch, class Body>
void run_tasks(const BakeControl& control, int count, const MakeScratch& make_scratch, const Body& body) {
    constexpr int most_workers = 64;
    std::atomic<int> next{0};
    control.parallel_for(most_workers, [&](int) {
        int i = next++;
        if (i >= count) return;
        auto scratch = make_scratch();
        for (; i < count && !control.stop.stop_requested(); i = next++) body(i, scratch);
    });
}

/// Touching fresh memory page by page takes a tenth of a bake; a system that has larger pages may give them.
inline void ask_for_large_pages([[maybe_unused]] void* data, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
    constexpr std::size_t page = std::size_t{2} << 20;
    std::size_t space = bytes;
    if (std::align(page, page, data, space)) madvise(data, space / page * page, MADV_HUGEPAGE);
#endif
}

/// Uninitialised, aligned for vectors, grows and never shrinks.
class FloatBuffer {
public:
    FloatBuffer() = default;
    explicit FloatBuffer(std::size_t size) { reserve(size); }
    float* reserve(std::size_t size) {
        if (size > size_) {
            data_.reset();
            data_ = hwy::AllocateAligned<float>(size);
            ask_for_large_pages(data_.get(), size * sizeof(float));
            size_ = size;
        }
        return data_.get();
    }
    void release() {
        data_.reset();
        size_ = 0;
    }
    float* data() const { return data_.get(); }

private:
    hwy::AlignedFreeUniquePtr<float[]> data_;
    std::size_t size_ = 0;
};

}  // namespace patina
