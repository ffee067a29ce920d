#include "app/undo.h"

#include <algorithm>
#include <utility>

namespace patina {

History::History(Document first, std::size_t limit) : limit_(std::max<std::size_t>(limit, 2)) {
    reset(std::move(first));
}

void History::reset(Document first) {
    steps_.clear();
    steps_.push_back(std::move(first));
    current_ = 0;
}

bool History::record(const Document& now, bool item_held) {
    if (item_held || now == steps_[current_]) return false;
    steps_.resize(current_ + 1);
    steps_.push_back(now);
    if (steps_.size() > limit_) steps_.erase(steps_.begin());
    current_ = steps_.size() - 1;
    return true;
}

void History::amend(const Document& now) {
    steps_[current_] = now;
    if (current_ == 0 || steps_[current_ - 1] != now) return;
    steps_.erase(steps_.begin() + std::ptrdiff_t(current_));
    --current_;
}

std::optional<Document> History::undo(const Document& now) {
    record(now, false);
    if (current_ == 0) return std::nullopt;
    return steps_[--current_];
}

std::optional<Document> History::redo(const Document& now) {
    record(now, false);
    if (current_ + 1 == steps_.size()) return std::nullopt;
    return steps_[++current_];
}

bool History::can_undo(const Document& now) const { return current_ > 0 || now != steps_[current_]; }

bool History::can_redo(const Document& now) const {
    return current_ + 1 < steps_.size() && now == steps_[current_];
}

std::string History::undo_what(const Document& now) const {
    if (now != steps_[current_]) return describe_change(steps_[current_], now);
    return current_ > 0 ? describe_change(steps_[current_ - 1], steps_[current_]) : std::string{};
}

std::string History::redo_what(const Document& now) const {
    return can_redo(now) ? describe_change(steps_[current_], steps_[current_ + 1]) : std::string{};
}

}  // namespace patina
