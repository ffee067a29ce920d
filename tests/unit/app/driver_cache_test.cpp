#include "app/driver_cache.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace {

using namespace patina;

#ifdef __linux__
TEST(DriverCache, is_switched_off_where_the_disk_has_no_room) {
    std::error_code failure;
    const std::filesystem::space_info nothing = std::filesystem::space("/proc/self", failure);
    if (failure || nothing.available != 0) GTEST_SKIP() << "there is no disk of no bytes here";
    ::setenv("MESA_SHADER_CACHE_DIR", "/proc/self", 1);
    ::unsetenv("MESA_SHADER_CACHE_DISABLE");
    keep_driver_off_a_full_disk();
    const char* disabled = std::getenv("MESA_SHADER_CACHE_DISABLE");
    EXPECT_STREQ(disabled ? disabled : "", "true");
    for (const char* name : {"MESA_SHADER_CACHE_DIR", "MESA_SHADER_CACHE_DISABLE", "MESA_GLSL_CACHE_DISABLE"})
        ::unsetenv(name);
}
#endif

}  // namespace
