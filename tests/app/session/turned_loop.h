// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/jobs.h"

#include <deque>
#include <functional>
#include <mutex>

namespace episcope::test {

/// Stands for an event loop: closures wait until the test runs them.
class TurnedLoop {
 public:
  JobRunner::Post post() {
    return [this](std::function<void()> closure) {
      const std::scoped_lock lock(mutex_);
      waiting_.push_back(std::move(closure));
    };
  }
  void turn() {
    std::deque<std::function<void()>> now;
    {
      const std::scoped_lock lock(mutex_);
      now.swap(waiting_);
    }
    for (auto& closure : now) closure();
  }

 private:
  std::mutex mutex_;
  std::deque<std::function<void()>> waiting_;
};

}  // namespace episcope::test
