#include "renderer/core/ledger.h"

#include <gtest/gtest.h>

#include <set>

namespace patina {
namespace {

TEST(Ledger, every_counter_has_its_own_row_and_key) {
    std::set<std::string_view> keys;
    WorkLedger work;
    for (const LedgerRow& row : kLedgerRows) {
        EXPECT_TRUE(keys.insert(row.key).second) << row.key;
        EXPECT_EQ(work.*row.member, 0u) << row.key << " is counted by two rows";
        work.*row.member = 1;
    }
    // Whatever is a counter and no row would be lost in files and in the panel.
    EXPECT_EQ(sizeof(WorkLedger), kLedgerRows.size() * sizeof(std::uint64_t) + sizeof work.skipped);
}

TEST(Ledger, adds_and_subtracts_row_by_row_and_reason_by_reason) {
    WorkLedger work{.levels_baked = 3};
    skip(work, "irradiance", "a full metal reflects no diffuse light");
    const WorkLedger before = work;
    WorkLedger more{.levels_baked = 2, .draw_calls = 7};
    skip(more, "irradiance", "a full metal reflects no diffuse light");
    skip(more, "tangent frames", "no map bends the normals");
    add(work, more);
    EXPECT_EQ(work.levels_baked, 5u);
    ASSERT_EQ(work.skipped.size(), 2u);
    EXPECT_EQ(work.skipped[0].times, 2u);
    EXPECT_EQ(since(work, before), more);
    EXPECT_EQ(since(work, work), WorkLedger{});
}

TEST(Ledger, numbers_are_written_for_people) {
    const LedgerRow& count = kLedgerRows.front();
    WorkLedger work;
    work.*count.member = 1234567;
    EXPECT_EQ(ledger_text(count, work), "1\u00a0234\u00a0567");
    for (const LedgerRow& row : kLedgerRows)
        if (row.unit == LedgerUnit::Bytes) {
            work.*row.member = 512;
            EXPECT_EQ(ledger_text(row, work), "512 B");
            work.*row.member = 3 << 20;
            EXPECT_EQ(ledger_text(row, work), "3.0 MiB");
        }
}

}  // namespace
}  // namespace patina
