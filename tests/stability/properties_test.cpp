// Every property of app/stability.h on its everyday number of cases, and on ten times as many in the slow
// suite. PATINA_STABILITY_CASES sets the number over all properties, PATINA_STABILITY_SEED the first seed.
#include "app/stability.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <ostream>
#include <string>

namespace patina {

/// How googletest, which finds it by this name, lists a case.
void PrintTo(const Property& property, std::ostream* out) { *out << property.statement; }

namespace {

class Stability : public testing::TestWithParam<Property> {};
class SlowStability : public testing::TestWithParam<Property> {};

std::string name_of(const testing::TestParamInfo<Property>& info) {
    std::string name(info.param.id);
    for (char& c : name)
        if (c == '-') c = '_';
    return name;
}

std::uint64_t number(const char* variable, std::uint64_t otherwise) {
    const char* text = std::getenv(variable);
    return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

void expect_holds(const Property& property, double times, std::uint64_t seed) {
    double everyday = 0.0;
    for (const Property& each : stability_properties()) everyday += double(each.cases);
    const std::uint64_t wanted = number("PATINA_STABILITY_CASES", 0);
    if (wanted > 0) times = double(wanted) / everyday;
    Stage stage;
    const PropertyReport report =
        check_property(property, std::int64_t(double(property.cases) * times), seed, stage);
    EXPECT_EQ(report.failed_trials, 0)
        << property.statement << ": " << report.worst << " exceeds " << property.tolerance
        << "; again with: patina bench stability --cases 1 --property " << property.id << " --seed "
        << report.worst_seed;
    testing::Test::RecordProperty("cases", std::to_string(report.cases));
    testing::Test::RecordProperty("worst", std::to_string(report.worst));
}

TEST_P(Stability, holds) { expect_holds(GetParam(), 1.0, number("PATINA_STABILITY_SEED", 1)); }
INSTANTIATE_TEST_SUITE_P(Property, Stability, testing::ValuesIn(stability_properties()), name_of);

TEST_P(SlowStability, holds) { expect_holds(GetParam(), 10.0, number("PATINA_STABILITY_SEED", 1000000)); }
INSTANTIATE_TEST_SUITE_P(SlowProperty, SlowStability, testing::ValuesIn(stability_properties()), name_of);

/// The harness itself: a failure names a seed, and that seed alone fails again.
TEST(StabilityHarness, a_failing_seed_fails_alone_and_others_do_not) {
    const Property property{"x", "fails once in a hundred", 0.5, 1000, [](Random& random, Stage&) {
                                Trial trial;
                                trial.add(random.chance(0.01) ? 1.0 : 0.1);
                                return trial;
                            }};
    Stage stage;
    const PropertyReport all = check_property(property, 1000, 7, stage);
    EXPECT_EQ(all.cases, 1000);
    EXPECT_GT(all.failed_trials, 0);
    EXPECT_LT(all.failed_trials, 50);
    EXPECT_EQ(all.worst, 1.0);
    EXPECT_EQ(check_property(property, 1, all.worst_seed, stage).failed_trials, 1);
    EXPECT_EQ(check_property(property, 1, all.worst_seed + 1, stage).worst_seed, all.worst_seed + 1);
}

TEST(StabilityHarness, a_value_that_is_no_number_is_the_worst) {
    const Property property{"x", "", 1.0, 3, [](Random&, Stage&) {
                                Trial trial;
                                trial.add(0.0 / 0.0);
                                return trial;
                            }};
    Stage stage;
    EXPECT_EQ(check_property(property, 3, 1, stage).failed_trials, 3);
}

}  // namespace
}  // namespace patina
