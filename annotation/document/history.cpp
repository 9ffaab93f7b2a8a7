// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/document/history.h"

namespace episcope {

std::uint64_t History::state() const {
  return state_after(applied_);
}

std::uint64_t History::state_after(std::size_t index) const {
  return index == 0 ? first_state_ : steps_[index - 1].state;
}

void History::forget_redo() {
  while (steps_.size() > applied_) {
    bytes_ -= steps_.back().bytes;
    steps_.pop_back();
  }
}

void History::push(Edit edit) {
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

const Edit* History::next_undo() const {
  return applied_ > 0 ? &steps_[applied_ - 1].edit : nullptr;
}

const Edit* History::next_redo() const {
  return applied_ < steps_.size() ? &steps_[applied_].edit : nullptr;
}

}  // namespace episcope
