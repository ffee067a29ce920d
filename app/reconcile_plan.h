// What is wanted against what is there, as text keys: the decisions of reconcile without a GPU, a file or a
// thread, and the memory that makes switching back cost nothing.
#pragma once

#include <cstdint>
#include <list>
#include <optional>
#include <string>
#include <utility>

namespace patina {

/// A key is the file or id, the version after a mark that no path ends in, and after another mark what else
/// tells the one from the other.
inline constexpr char kVersionMark = '\n';
inline std::string id_of(const std::string& key) { return key.substr(0, key.find(kVersionMark)); }
/// File or id and version.
inline std::string base_of(const std::string& key) {
    const std::size_t mark = key.find(kVersionMark);
    return mark == std::string::npos ? key : key.substr(0, key.find(kVersionMark, mark + 1));
}

/// Of a map, without its detail, which follows a mark of its own.
inline constexpr const char* kDetailMark = " @";
inline std::string map_of_key(const std::string& key) { return key.substr(0, key.rfind(kDetailMark)); }

/// One thing the picture needs. A key names it together with its version; empty: nothing.
struct SlotKeys {
    std::string wanted;
    std::string shown;    ///< the last good one; stays until the wanted one is ready
    std::string loading;  ///< what a job is making
    std::string failed;   ///< could not be made; is tried again under another key only
    bool ready() const { return wanted == shown || wanted == failed; }
    bool operator==(const SlotKeys&) const = default;
};

enum class NextStep { Keep, Clear, TakeFromMemory, Load };
struct Decision {
    NextStep step = NextStep::Keep;
    bool stop_loading = false;  ///< the job under way makes something nobody wants any more
    bool operator==(const Decision&) const = default;
};
Decision decide(const SlotKeys& keys, bool wanted_is_in_memory);

/// Values by key, bounded by the bytes they were said to take; the least recently used go first.
template <class T>
class Memory {
public:
    explicit Memory(std::uint64_t max_bytes) : max_bytes_(max_bytes) {}

    bool contains(const std::string& key) const {
        for (const Entry& entry : entries_)
            if (entry.key == key) return true;
        return false;
    }
    /// Marks it as just used.
    std::optional<T> get(const std::string& key) {
        for (auto entry = entries_.begin(); entry != entries_.end(); ++entry)
            if (entry->key == key) {
                entries_.splice(entries_.begin(), entries_, entry);
                return entry->value;
            }
        return std::nullopt;
    }
    /// The newest value stays even where it alone is over the bound.
    void put(const std::string& key, T value, std::uint64_t bytes) {
        forget(key);
        entries_.push_front({key, std::move(value), bytes});
        bytes_ += bytes;
        while (bytes_ > max_bytes_ && entries_.size() > 1) {
            bytes_ -= entries_.back().bytes;
            entries_.pop_back();
        }
    }
    void forget(const std::string& key) {
        for (auto entry = entries_.begin(); entry != entries_.end(); ++entry)
            if (entry->key == key) {
                bytes_ -= entry->bytes;
                entries_.erase(entry);
                return;
            }
    }
    template <class Visit>
    void visit(Visit visit) const {
        for (const Entry& entry : entries_) visit(entry.key, entry.value);
    }
    std::uint64_t bytes() const { return bytes_; }
    std::size_t size() const { return entries_.size(); }

private:
    struct Entry {
        std::string key;
        T value;
        std::uint64_t bytes = 0;
    };
    std::list<Entry> entries_;  ///< most recently used first
    std::uint64_t bytes_ = 0;
    std::uint64_t max_bytes_;
};

}  // namespace patina
