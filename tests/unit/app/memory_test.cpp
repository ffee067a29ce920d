#include "app/memory.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <thread>
#include <vector>
#ifdef __GLIBC__
#include <cstdio>
#include <malloc.h>
#endif

namespace patina {
namespace {

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

/// Heaps of this process once a thread beside the first has allocated something.
int heaps_with_a_thread() {
    std::thread([] { const std::vector<std::byte> some(1000); }).join();
    char* text = nullptr;
    std::size_t size = 0;
    FILE* const stream = open_memstream(&text, &size);
    malloc_info(0, stream);
    std::fclose(stream);
    int count = 0;
    for (std::string_view left(text, size); !left.empty(); ++count) {
        const std::size_t at = left.find("<heap nr=");
        if (at == std::string_view::npos) break;
        left.remove_prefix(at + 1);
    }
    std::free(text);
    return count;
}

/// Each in a process of its own, which has no threads yet.
TEST(Memory, threads_share_freed_memory_where_that_is_asked_for) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(std::exit(heaps_with_a_thread()), testing::ExitedWithCode(2), "");
    EXPECT_EXIT((share_freed_memory(), std::exit(heaps_with_a_thread())), testing::ExitedWithCode(1), "");
}

/// Pieces that the system gave for themselves, once 4 MiB are allocated.
int pieces_with_a_large_one() {
    const std::vector<std::byte> large(std::size_t{4} << 20);
    return int(mallinfo2().hblks);
}

TEST(Memory, large_pieces_come_from_what_was_freed_where_that_is_asked_for) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(std::exit(pieces_with_a_large_one() - int(mallinfo2().hblks)), testing::ExitedWithCode(1),
                "");
    EXPECT_EXIT((share_freed_memory(), std::exit(pieces_with_a_large_one() - int(mallinfo2().hblks))),
                testing::ExitedWithCode(0), "");
}

#endif

}  // namespace
}  // namespace patina
