// Undo as a list of documents. A change becomes a step when nothing is held any more, so a slider's drag is
// one step.
#pragma once

#include "app/document.h"

#include <optional>
#include <string>
#include <vector>

namespace patina {

inline constexpr std::size_t kUndoSteps = 300;

class History {
public:
    explicit History(Document first, std::size_t limit = kUndoSteps);

    /// Forgets everything: another document was opened.
    void reset(Document first);
    /// To be called once a frame. A changed document becomes a step unless something is held (then once it is
    /// let go). A step drops what could have been redone. True if a step was added.
    bool record(const Document& now, bool item_held);
    /// A change that is not a step of its own: the current step becomes it, and goes if it then changes
    /// nothing.
    void amend(const Document& now);

    /// The document to go back (or forward) to. An unfinished change is made a step first.
    std::optional<Document> undo(const Document& now);
    std::optional<Document> redo(const Document& now);
    bool can_undo(const Document& now) const;
    bool can_redo(const Document& now) const;
    /// What the step back (or forward) changes, in a few words; empty where there is none.
    std::string undo_what(const Document& now) const;
    std::string redo_what(const Document& now) const;
    std::size_t size() const { return steps_.size(); }

private:
    std::vector<Document> steps_;  ///< never empty
    std::size_t current_ = 0;
    std::size_t limit_ = kUndoSteps;
};

}  // namespace patina
