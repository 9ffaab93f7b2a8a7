// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/document/edit.h"

#include <cstdint>
#include <deque>

namespace episcope {

/// Edits that can be undone and redone, oldest first, limited in bytes: the oldest are dropped, so
/// an edit larger than the limit cannot be undone.
class History {
 public:
  explicit History(std::size_t max_bytes) : max_bytes_(max_bytes) {}

  /// A number that identifies the state of the document: every edit leads to a new one, undo and
  /// redo return to previous ones.
  [[nodiscard]] std::uint64_t state() const;
  /// Adds an edit that was just made; undone edits can no longer be redone.
  void push(Edit edit);

  /// Edits that are kept, of which the first `applied_count` are in effect.
  [[nodiscard]] std::size_t count() const { return steps_.size(); }
  [[nodiscard]] std::size_t applied_count() const { return applied_; }
  [[nodiscard]] const Edit& edit(std::size_t index) const { return steps_[index].edit; }
  /// The state after the first `index` edits.
  [[nodiscard]] std::uint64_t state_after(std::size_t index) const;

  /// The edit that `undo` would revert; null if there is none. Likewise for `redo`.
  [[nodiscard]] const Edit* next_undo() const;
  [[nodiscard]] const Edit* next_redo() const;
  /// Counts the last edit as not in effect. Precondition: `next_undo()`.
  void undo() { --applied_; }
  /// Counts the next edit as in effect again. Precondition: `next_redo()`.
  void redo() { ++applied_; }

  [[nodiscard]] std::size_t byte_size() const { return bytes_; }
  [[nodiscard]] std::size_t max_bytes() const { return max_bytes_; }

 private:
  struct Step {
    Edit edit;
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

}  // namespace episcope
