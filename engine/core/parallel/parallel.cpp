// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/parallel/parallel.h"

#include "engine/core/error.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace episcope {
namespace {

struct Loop {
  Loop(int items, const Progress& job, const std::function<std::function<void(int)>()>& maker)
      : count(items), progress(job), make_worker(maker) {}

  const int count;
  const Progress& progress;
  const std::function<std::function<void(int)>()>& make_worker;
  std::atomic<int> next{0};
  std::atomic<int> finished{0};
  std::atomic<bool> failed{false};
  std::exception_ptr failure{};
  std::mutex failure_mutex{};

  void run_items() {
    try {
      const auto body = make_worker();
      for (int i = next++; i < count && !failed && !progress.stop_requested(); i = next++) {
        body(i);
        progress.report(static_cast<double>(++finished) / count);
      }
    } catch (...) {
      const std::scoped_lock lock(failure_mutex);
      if (!failure) failure = std::current_exception();
      failed = true;
    }
  }
};

}  // namespace

void parallel_for_workers(int count, const Progress& progress,
                          const std::function<std::function<void(int)>()>& make_worker) {
  progress.check();
  Loop loop(count, progress, make_worker);
  {
    std::vector<std::jthread> threads;
    for (int i = 1; i < std::min(progress.threads(), count); ++i) {
      threads.emplace_back([&loop] { loop.run_items(); });
    }
    loop.run_items();
  }
  if (loop.failure) std::rethrow_exception(loop.failure);
  progress.check();
}

void parallel_for(int count, const Progress& progress, const std::function<void(int)>& body) {
  parallel_for_workers(count, progress, [&body] { return body; });
}

}  // namespace episcope
