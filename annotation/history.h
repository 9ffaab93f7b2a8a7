// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>

namespace episcope {

/// An undoable step on a document of any kind.
template <class E>
concept EditOfDocument = requires(const E& edit, std::size_t bytes) {
  bytes = edit.byte_size();  // memory that it takes
};

/// Edits of a document that can be undone and redone, oldest first, bounded in bytes: the oldest
/// are forgotten, so that an edit larger than the bound cannot be undone.
template <EditOfDocument E>
class History {
 public:
  explicit History(std::size_t max_bytes) : max_bytes_(max_bytes) {}

  /// A number for the state of the document: every edit leads to a new one, undoing and redoing
  /// lead back to the same.
  [[nodiscard]] std::uint64_t state() const { return state_after(applied_); }
  /// Notes an edit just made; edits that were undone can no longer be redone.
  void push(E edit);

  /// Edits that are kept, of which the first `applied_count` are in effect.
  [[nodiscard]] std::size_t count() const { return steps_.size(); }
  [[nodiscard]] std::size_t applied_count() const { return applied_; }
  [[nodiscard]] const E& edit(std::size_t index) const { return steps_[index].edit; }
  /// The state after the first `index` edits.
  [[nodiscard]] std::uint64_t state_after(std::size_t index) const {
    return index == 0 ? first_state_ : steps_[index - 1].state;
  }

  /// The edit that `undo` would take back; null if there is none. Likewise `redo`.
  [[nodiscard]] const E* next_undo() const {
    return applied_ > 0 ? &steps_[applied_ - 1].edit : nullptr;
  }
  [[nodiscard]] const E* next_redo() const {
    return applied_ < steps_.size() ? &steps_[applied_].edit : nullptr;
  }
  /// Counts the last edit as not in effect. Precondition: `next_undo()`.
  void undo() { --applied_; }
  /// Counts the next edit as in effect again. Precondition: `next_redo()`.
  void redo() { ++applied_; }

  [[nodiscard]] std::size_t byte_size() const { return bytes_; }
  [[nodiscard]] std::size_t max_bytes() const { return max_bytes_; }

 private:
  struct Step {
    E edit;
    std::size_t bytes = 0;
    std::uint64_t state = 0;
  };
  void forget_redo();

  std::size_t max_bytes_;
  std::deque<Step> steps_;
  std::size_t applied_ = 0;
  std::size_t bytes_ = 0;
  std::uint64_t first_state_ = 0;
  std::uint64_t last_state_ = 0;  ///< The highest ever given.
};

template <EditOfDocument E>
void History<E>::forget_redo() {
  while (steps_.size() > applied_) {
    bytes_ -= steps_.back().bytes;
    steps_.pop_back();
  }
}

template <EditOfDocument E>
void History<E>::push(E edit) {
  forget_redo();
  const std::size_t bytes = edit.byte_size();
  steps_.push_back({std::move(edit), bytes, ++last_state_});
  bytes_ += bytes;
  ++applied_;
  while (bytes_ > max_bytes_) {
    first_state_ = steps_.front().state;
    bytes_ -= steps_.front().bytes;
    steps_.pop_front();
    --applied_;
  }
}

}  // namespace episcope
