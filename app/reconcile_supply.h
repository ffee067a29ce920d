// One kind of thing the picture needs (maps, meshes, light): slots that want keys, loads under way shared
// between slots, and the memory behind them. Knows neither what the things are nor how they are made.
#pragma once

#include "app/reconcile_plan.h"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace patina {

template <class T>
class Supply {
public:
    using LoadId = std::uint64_t;
    struct Slot {
        SlotKeys keys;
        std::optional<T> value;  ///< of keys.shown
        std::string error;       ///< why keys.failed could not be made
    };

    Supply(std::size_t slots, std::uint64_t max_bytes) : slots_(slots), memory_(max_bytes) {}

    const Slot& slot(std::size_t i) const { return slots_[i]; }
    void want(std::size_t i, const std::string& key) { slots_[i].keys.wanted = key; }
    std::optional<T> in_memory(const std::string& key) { return memory_.get(key); }
    /// Whatever a slot shows or the memory holds; visit(key, value).
    template <class Visit>
    void visit(Visit visit) const {
        for (const Slot& slot : slots_)
            if (slot.value) visit(slot.keys.shown, *slot.value);
        memory_.visit(visit);
    }
    /// Not to be taken from memory again: something better replaced it.
    void forget(const std::string& key) { memory_.forget(key); }

    /// start(key) begins a load and gives its id; stop(id) ends one. Returns how many wants were met from
    /// memory, or by a load that another slot waits for already.
    template <class Start, class Stop>
    int update(Start start, Stop stop) {
        int shared = 0;
        for (Slot& slot : slots_) shared += advance(slot, start);
        for (auto load = loads_.begin(); load != loads_.end();) {
            const bool needed = std::any_of(slots_.begin(), slots_.end(), [&](const Slot& slot) {
                return slot.keys.loading == load->first;
            });
            if (!needed) stop(load->second);
            load = needed ? std::next(load) : loads_.erase(load);
        }
        return shared;
    }

    bool is_loading(const std::string& key) const { return loads_.count(key) > 0; }
    std::optional<std::string> key_of(LoadId id) const {
        for (const auto& [key, load] : loads_)
            if (load == id) return key;
        return std::nullopt;
    }

    /// What a load came to. Ignored if nobody waits for it any more.
    void finished(const std::string& key, T value, std::uint64_t bytes) {
        if (loads_.erase(key) == 0) return;
        for (Slot& slot : slots_) {
            if (slot.keys.loading != key) continue;
            slot.keys.loading.clear();
            slot.keys.shown = key;
            slot.keys.failed.clear();
            slot.error.clear();
            slot.value = value;
        }
        memory_.put(key, std::move(value), bytes);
    }
    void failed(const std::string& key, const std::string& error) {
        if (loads_.erase(key) == 0) return;
        for (Slot& slot : slots_) {
            if (slot.keys.loading != key) continue;
            slot.keys.loading.clear();
            slot.keys.failed = key;
            slot.error = error;
        }
    }

    bool pending() const {
        return std::any_of(slots_.begin(), slots_.end(), [](const Slot& slot) { return !slot.keys.ready(); });
    }

private:
    template <class Start>
    int advance(Slot& slot, Start& start) {
        const Decision decision = decide(slot.keys, memory_.contains(slot.keys.wanted));
        if (decision.stop_loading) slot.keys.loading.clear();
        if (slot.keys.failed != slot.keys.wanted) {
            slot.keys.failed.clear();
            slot.error.clear();
        }
        switch (decision.step) {
            case NextStep::Keep:
                return 0;
            case NextStep::Clear:
                slot.value.reset();
                slot.keys.shown.clear();
                return 0;
            case NextStep::TakeFromMemory:
                slot.value = memory_.get(slot.keys.wanted);
                slot.keys.shown = slot.keys.wanted;
                slot.keys.failed.clear();
                slot.error.clear();
                return 1;
            case NextStep::Load:
                slot.keys.loading = slot.keys.wanted;
                if (is_loading(slot.keys.wanted)) return 1;
                loads_.emplace(slot.keys.wanted, start(slot.keys.wanted));
                return 0;
        }
        return 0;
    }

    std::vector<Slot> slots_;
    std::map<std::string, LoadId> loads_;
    Memory<T> memory_;
};

}  // namespace patina
