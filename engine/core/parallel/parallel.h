// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/progress.h"

#include <functional>

namespace episcope {

/// Runs `body(i)` for every i in [0, count) on up to `progress.threads()` threads, and reports the
/// finished share to `progress`. The only way the engine goes parallel. Items are handed out one at
/// a time, so an item should take between 10 µs and 100 ms: a stop request is honoured between
/// items. Results must not depend on which thread runs an item.
/// Throws Cancelled on a stop request, or the first exception of `body`, after all threads ended.
void parallel_for(int count, const Progress& progress, const std::function<void(int)>& body);

/// As `parallel_for`, for bodies with scratch memory: `make_worker()` is called once on each thread
/// and returns the function that then runs the items of that thread.
void parallel_for_workers(int count, const Progress& progress,
                          const std::function<std::function<void(int)>()>& make_worker);

}  // namespace episcope
