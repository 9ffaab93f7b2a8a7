// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <utility>
#include <vector>

namespace episcope {

/// Keeps the open light field from being closed while something would be lost.
class LeaveGuards {
 public:
  using Continue = std::function<void()>;

  struct Guard {
    std::function<bool()> may_leave;  ///< Whether nothing would be lost now.
    /// Asks the user and calls back once nothing is lost any more, or never.
    std::function<void(Continue)> ask;
  };

  void add(Guard guard) { guards_.push_back(std::move(guard)); }

  [[nodiscard]] bool may_leave() const {
    for (const Guard& each : guards_) {
      if (!each.may_leave()) return false;
    }
    return true;
  }

  /// Calls `go_on` once every guard agrees: at once if nothing would be lost, or never.
  void leave(const Continue& go_on) const { ask(0, go_on); }

 private:
  void ask(std::size_t first, const Continue& go_on) const {
    if (first == guards_.size()) {
      go_on();
    } else {
      guards_[first].ask([this, first, go_on] { ask(first + 1, go_on); });
    }
  }

  std::vector<Guard> guards_;
};

}  // namespace episcope
