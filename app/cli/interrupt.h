// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <stop_token>

namespace episcope::cli {

/// Turns Ctrl+C (SIGINT) and SIGTERM into a stop request while it lives. Further signals change
/// nothing: the stop under way first removes what is half-written. To be made before any other
/// thread: it blocks the signals in the calling thread and all threads begun later, and waits for
/// them in a thread of its own.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  [[nodiscard]] std::stop_token token() const { return stop_.get_token(); }

 private:
  struct Waiter;
  std::stop_source stop_;
  std::unique_ptr<Waiter> waiter_;
};

}  // namespace episcope::cli
