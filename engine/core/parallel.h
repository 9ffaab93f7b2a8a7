// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"

#include <concepts>
#include <functional>
#include <memory>
#include <vector>

namespace episcope {

/// The items of one loop, shared by its threads. Only for the templates below.
class LoopItems {
 public:
  /// The next item; negative when none is left, on a stop request, or when a thread has failed.
  [[nodiscard]] virtual int take() = 0;
  /// Counts an item as done.
  virtual void finish() = 0;

 protected:
  ~LoopItems() = default;
};

/// Calls `work(context, items)` on every thread of a loop over [0, count). What the templates below
/// have in common, without the types of their callers.
void run_loop(int count, const Progress& progress,
              void (*work)(const void* context, LoopItems& items), const void* context);

/// Runs items of a loop with scratch memory: `make_worker()` is called once on each thread and
/// returns a callable of any type, which then runs the items of that thread as `worker(i)`. It need
/// not be copyable, and what it captures by value belongs to that thread alone. Otherwise as
/// `parallel_for`.
template <class MakeWorker>
requires std::invocable<const MakeWorker&>
void parallel_for_workers(int count, const Progress& progress, const MakeWorker& make_worker) {
  const auto work = [](const void* context, LoopItems& items) {
    auto worker = (*static_cast<const MakeWorker*>(context))();
    for (int i = items.take(); i >= 0; i = items.take()) {
      worker(i);
      items.finish();
    }
  };
  run_loop(count, progress, work, &make_worker);
}

/// Runs `body(i)` for every i in [0, count) on up to `progress.threads()` threads, and reports the
/// finished fraction to `progress`. Items are handed out one at a time in ascending order, and what
/// was handed out is run. An item should take between 10 µs and 100 ms: a stop request is honored
/// between items. Results must not depend on which thread runs an item. Throws Cancelled on a stop
/// request, or the first exception of `body`, after all threads ended.
template <class Body>
requires std::invocable<const Body&, int>
void parallel_for(int count, const Progress& progress, const Body& body) {
  parallel_for_workers(count, progress, [&body] { return [&body](int i) { body(i); }; });
}

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

/// Lowers the priority of the calling thread and of threads that it starts, so that the window
/// stays fluent while a job takes every core. Does nothing where that is not possible.
void lower_thread_priority();

/// Asks the scheduler for short time slices that begin soon, for the calling thread and threads
/// that it starts: for threads that the user waits for and that do little at once. Needs Linux
/// 6.12; earlier, such a thread may wait until the time slices of others end.
void request_low_latency();

}  // namespace episcope

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace episcope {

/// While it exists, this thread treats denormal floats as zero, where the processor supports it.
/// Iterations decay to denormals in flat areas, which would slow down every operation on them.
class FlushDenormals {
#if defined(__x86_64__)
 public:
  FlushDenormals() : before_(_mm_getcsr()) {
    constexpr unsigned denormals_are_zeros = 0x0040;
    _mm_setcsr(before_ | _MM_FLUSH_ZERO_ON | denormals_are_zeros);
  }
  ~FlushDenormals() {
    _mm_setcsr(before_);
  }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned before_;
#endif
};

}  // namespace episcope
