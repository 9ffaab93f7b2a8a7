// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <utility>
#include <vector>

namespace episcope {

/// What is about to be left.
enum class Leaving {
  Scene,    ///< The light field that is shown is closed, or read in another way.
  Reading,  ///< It is read in another way, and its results are brought back.
  Session   ///< All that is open.
};

/// Keeps what is open from being closed while something would be lost.
class LeaveGuards {
 public:
  using Continue = std::function<void()>;

  struct Guard {
    std::function<bool(Leaving)> may_leave;  ///< Whether nothing would be lost now.
    /// Asks the user and calls back once nothing is lost any more, or never.
    std::function<void(Leaving, Continue)> ask;
  };

  void add(Guard guard) { guards_.push_back(std::move(guard)); }

  [[nodiscard]] bool may_leave(Leaving what) const {
    for (const Guard& each : guards_) {
      if (!each.may_leave(what)) return false;
    }
    return true;
  }

  /// Calls `go_on` once every guard agrees: at once if nothing would be lost, or never.
  void leave(Leaving what, const Continue& go_on) const { ask(0, what, go_on); }

 private:
  void ask(std::size_t first, Leaving what, const Continue& go_on) const {
    if (first == guards_.size()) {
      go_on();
    } else {
      guards_[first].ask(what, [this, first, what, go_on] { ask(first + 1, what, go_on); });
    }
  }

  std::vector<Guard> guards_;
};

}  // namespace episcope
