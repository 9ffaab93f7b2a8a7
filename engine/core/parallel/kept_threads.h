// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <vector>

namespace episcope {

/// Other threads that run the same work as the caller's. Threads are kept for the next loop when
/// the work is done: to start and to end one takes as long as a short loop. Any number of these may
/// exist at once, also within the work of another.
class KeptThreads {
 public:
  /// Begins to run `work`, which must not throw, on `count` threads besides, of the priority of the
  /// calling thread. It must live until this is destroyed. Throws std::system_error where no thread
  /// can be made.
  KeptThreads(int count, const std::function<void()>& work);
  /// Waits for the threads that have begun; those that have not will not begin.
  ~KeptThreads();
  KeptThreads(const KeptThreads&) = delete;
  KeptThreads& operator=(const KeptThreads&) = delete;

  class Thread;

 private:
  std::vector<std::unique_ptr<Thread>> threads_;
};

}  // namespace episcope
