#include "renderer/core/ledger.h"

#include <algorithm>
#include <cstdio>

namespace patina {
namespace {

SkippedWork& entry(WorkLedger& ledger, std::string_view what, std::string_view why) {
    const auto found =
        std::find_if(ledger.skipped.begin(), ledger.skipped.end(),
                     [&](const SkippedWork& row) { return row.what == what && row.why == why; });
    if (found != ledger.skipped.end()) return *found;
    return ledger.skipped.emplace_back(SkippedWork{std::string(what), std::string(why)});
}

/// Groups of three digits, apart by a space that does not break (Latin-1, which the interface's font has).
std::string grouped(std::uint64_t number) {
    std::string digits = std::to_string(number);
    for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, "\u00a0");
    return digits;
}

std::string bytes_text(std::uint64_t bytes) {
    constexpr std::array units{"B", "KiB", "MiB", "GiB", "TiB"};
    auto value = static_cast<double>(bytes);
    std::size_t unit = 0;
    for (; value >= 1000.0 && unit + 1 < units.size(); ++unit) value /= 1024.0;
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), unit == 0 || value >= 100.0 ? "%.0f %s" : "%.1f %s", value,
                  units[unit]);
    return text.data();
}

}  // namespace

void skip(WorkLedger& ledger, std::string_view what, std::string_view why) {
    ++entry(ledger, what, why).times;
}

void add(WorkLedger& ledger, const WorkLedger& more) {
    for (const LedgerRow& row : kLedgerRows) ledger.*row.member += more.*row.member;
    for (const SkippedWork& each : more.skipped) entry(ledger, each.what, each.why).times += each.times;
}

WorkLedger since(const WorkLedger& ledger, const WorkLedger& earlier) {
    WorkLedger result = ledger;
    for (const LedgerRow& row : kLedgerRows) result.*row.member -= earlier.*row.member;
    for (const SkippedWork& each : earlier.skipped) entry(result, each.what, each.why).times -= each.times;
    std::erase_if(result.skipped, [](const SkippedWork& each) { return each.times == 0; });
    return result;
}

std::string ledger_text(const LedgerRow& row, const WorkLedger& ledger) {
    const std::uint64_t value = ledger.*row.member;
    return row.unit == LedgerUnit::Bytes ? bytes_text(value) : grouped(value);
}

}  // namespace patina
