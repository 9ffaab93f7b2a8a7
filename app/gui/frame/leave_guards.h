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
    bool is_of_results = false;  ///< Not asked where results are brought back.
  };

  void add(Guard guard) { guards_.push_back(std::move(guard)); }

  [[nodiscard]] bool may_leave() const {
    for (const Guard& each : guards_) {
      if (!each.may_leave()) return false;
    }
    return true;
  }

  /// Calls `go_on` once every guard agrees: at once if nothing would be lost, or never.
  void leave(const Continue& go_on) const { ask(0, go_on, false); }
  /// The same where results are brought back afterwards.
  void leave_with_results(const Continue& go_on) const { ask(0, go_on, true); }

 private:
  void ask(std::size_t first, const Continue& go_on, bool keeps_results) const {
    while (first < guards_.size() && keeps_results && guards_[first].is_of_results) ++first;
    if (first == guards_.size()) {
      go_on();
    } else {
      guards_[first].ask(
          [this, first, go_on, keeps_results] { ask(first + 1, go_on, keeps_results); });
    }
  }

  std::vector<Guard> guards_;
};

}  // namespace episcope
