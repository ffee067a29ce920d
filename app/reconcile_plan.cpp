#include "app/reconcile_plan.h"

namespace patina {

Decision decide(const SlotKeys& keys, bool wanted_is_in_memory) {
    const bool other_load = !keys.loading.empty() && keys.loading != keys.wanted;
    if (keys.wanted.empty()) return {keys.shown.empty() ? NextStep::Keep : NextStep::Clear, other_load};
    if (keys.wanted == keys.shown) return {NextStep::Keep, !keys.loading.empty()};
    if (wanted_is_in_memory) return {NextStep::TakeFromMemory, !keys.loading.empty()};
    if (keys.wanted == keys.failed) return {NextStep::Keep, other_load};
    if (keys.wanted == keys.loading) return {};
    return {NextStep::Load, other_load};
}

}  // namespace patina
