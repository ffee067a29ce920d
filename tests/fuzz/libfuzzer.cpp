// One target, chosen by PATINA_FUZZ_TARGET, for LLVM's coverage-guided fuzzer.
#include "tests/fuzz/targets.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace {
const patina::fuzz::Target* target = nullptr;
}

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    const char* name = std::getenv("PATINA_FUZZ_TARGET");
    target = patina::fuzz::find_target(name ? name : "");
    if (target) return 0;
    std::fputs("PATINA_FUZZ_TARGET must be one of:", stderr);
    for (const auto& each : patina::fuzz::targets())
        std::fprintf(stderr, " %s", std::string(each.name).c_str());
    std::fputs("\n", stderr);
    std::exit(2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    patina::fuzz::try_bytes(*target, {reinterpret_cast<const char*>(data), size});
    return 0;
}
