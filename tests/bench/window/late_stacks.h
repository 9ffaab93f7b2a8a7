// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <string>
#include <thread>
#include <vector>

namespace episcope::bench {

/// The calls that a thread is in, innermost first, as addresses.
using Stack = std::vector<void*>;

/// Looks every few ms at what the thread that made it is doing, while one piece of its work takes
/// long, so that what takes long has a name. One at a time in a program: it uses SIGPROF.
class LateStacks {
 public:
  /// Begins to look, from a thread of its own.
  LateStacks();
  ~LateStacks();
  LateStacks(const LateStacks&) = delete;
  LateStacks& operator=(const LateStacks&) = delete;

  void begin_work();
  /// The stacks found within the work that ends; none if it did not take long.
  [[nodiscard]] std::vector<Stack> end_work();

 private:
  void watch(const std::stop_token& stop);

  pthread_t watched_;
  std::atomic<long> begin_ns_{0};  // of the work; 0 = none
  std::jthread watcher_;
};

/// The functions of the program that the stacks have in common or mostly are in: of each stack the
/// innermost few, outermost first, with how many stacks end there; the most frequent first.
[[nodiscard]] std::vector<std::string> calls_of(const std::vector<Stack>& stacks);

}  // namespace episcope::bench
