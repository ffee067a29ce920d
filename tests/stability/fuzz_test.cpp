// The fuzz targets on their corpus and on damaged copies of it: a few hundred every day, thousands in the
// slow suite. PATINA_FUZZ_RUNS sets how many. Coverage-guided runs of the same targets:
// tests/fuzz/libfuzzer.cpp.
#include "tests/fuzz/mutate.h"
#include "tests/fuzz/targets.h"
#include "tests/stability/process.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <ostream>

namespace patina {

namespace fuzz {
/// How googletest, which finds it by this name, lists a case.
void PrintTo(const Target& target, std::ostream* out) {
    *out << "damaged copies of a " << target.name << " file";
}
}  // namespace fuzz

namespace {

using fuzz::Target;

class Fuzz : public testing::TestWithParam<Target> {};
class SlowFuzz : public testing::TestWithParam<Target> {};

std::string name_of(const testing::TestParamInfo<Target>& info) { return std::string(info.param.name); }

std::vector<std::string> corpus(const Target& target) {
    const std::filesystem::path folder =
        std::filesystem::path(PATINA_SOURCE_DIR) / "tests/fuzz/corpus" / target.name;
    std::vector<std::string> all;
    for (const std::string& name : test::files_below(folder)) all.push_back(test::read_text(folder / name));
    return all;
}

/// A damaged EXR may stand for 33 000 pixels a byte, which are allocated before they turn out to be missing.
int affordable(const Target& target, int runs) { return target.name == "exr" ? runs / 5 : runs; }

void try_damaged(const Target& target, int runs) {
    if (const char* text = std::getenv("PATINA_FUZZ_RUNS")) runs = std::atoi(text);
    const std::vector<std::string> originals = corpus(target);
    ASSERT_FALSE(originals.empty());
    for (const std::string& each : originals) fuzz::try_bytes(target, each);
    for (int i = 0; i < runs; ++i) {
        Random random(std::uint64_t(i) + 1);
        const std::string bytes = fuzz::damaged(originals, random);
        SCOPED_TRACE(i + 1);
        fuzz::try_bytes(target, bytes);  // a defect aborts: PATINA_FUZZ_RUNS finds which run it is
    }
}

TEST_P(Fuzz, ends_well_or_in_one_sentence) { try_damaged(GetParam(), affordable(GetParam(), 200)); }
INSTANTIATE_TEST_SUITE_P(Target, Fuzz, testing::ValuesIn(fuzz::targets().begin(), fuzz::targets().end()),
                         name_of);

TEST_P(SlowFuzz, ends_well_or_in_one_sentence) { try_damaged(GetParam(), affordable(GetParam(), 3000)); }
INSTANTIATE_TEST_SUITE_P(SlowTarget, SlowFuzz,
                         testing::ValuesIn(fuzz::targets().begin(), fuzz::targets().end()), name_of);

}  // namespace
}  // namespace patina
