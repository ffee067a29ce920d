#include "app/memory.h"

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

namespace patina {

void share_one_heap() {
#ifdef M_ARENA_MAX
    mallopt(M_ARENA_MAX, 1);
#endif
}

}  // namespace patina
