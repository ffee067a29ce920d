#include "app/memory.h"

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

namespace patina {

namespace {
constexpr int kFreshBytes = 32 << 20;  ///< less than that is taken again without the system clearing it anew
}

void share_freed_memory() {
#ifdef M_ARENA_MAX
    mallopt(M_ARENA_MAX, 1);
    mallopt(M_MMAP_THRESHOLD, kFreshBytes);
    mallopt(M_TRIM_THRESHOLD, kFreshBytes);
#endif
}

}  // namespace patina
