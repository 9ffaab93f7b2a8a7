// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>

namespace episcope {

/// What the cancel key can end, in the order in which it is tried.
enum class CancelRank {
  Stroke,
  LiveSegmentation,
  Browsing,  ///< Playing, a line drawn in an EPI.
  Comparing,
  Mark,  ///< What is outlined on the view.
  Job,
  Message
};

/// What can be cancelled, by rank: the cancel key ends the first that is active.
class Cancels {
 public:
  /// `cancel` returns whether there was something to end.
  void add(CancelRank rank, std::function<bool()> cancel) {
    cancels_.emplace(rank, std::move(cancel));
  }

  /// Returns whether anything was ended.
  bool cancel() const {
    for (const auto& [rank, cancel] : cancels_) {
      if (cancel()) return true;
    }
    return false;
  }

 private:
  std::multimap<CancelRank, std::function<bool()>> cancels_;
};

}  // namespace episcope
