// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/progress.h"

#include <concepts>

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
/// was handed out is run. An item should take between 10 µs and 100 ms: a stop request is honoured
/// between items. Results must not depend on which thread runs an item. Throws Cancelled on a stop
/// request, or the first exception of `body`, after all threads ended.
template <class Body>
requires std::invocable<const Body&, int>
void parallel_for(int count, const Progress& progress, const Body& body) {
  parallel_for_workers(count, progress, [&body] { return [&body](int i) { body(i); }; });
}

}  // namespace episcope
