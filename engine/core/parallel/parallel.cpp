// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/parallel/parallel.h"

#include "engine/core/error.h"
#include "engine/core/parallel/kept_threads.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <mutex>

namespace episcope {
namespace {

class Loop final : public LoopItems {
 public:
  Loop(int count, const Progress& progress) : count_(count), progress_(progress) {}

  [[nodiscard]] int take() override {
    // Before one is taken, so that whoever waits for an earlier item never waits in vain.
    if (failed_ || progress_.stop_requested()) return -1;
    const int item = next_++;
    return item < count_ ? item : -1;
  }
  void finish() override { progress_.report(static_cast<double>(++finished_) / count_); }

  template <class Work>
  void run(const Work& work) {
    try {
      work();
    } catch (...) {
      const std::scoped_lock lock(failure_mutex_);
      if (!failure_) failure_ = std::current_exception();
      failed_ = true;
    }
  }
  void rethrow_failure() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  const int count_;
  const Progress& progress_;
  std::atomic<int> next_{0};
  std::atomic<int> finished_{0};
  std::atomic<bool> failed_{false};
  std::exception_ptr failure_{};
  std::mutex failure_mutex_{};
};

}  // namespace

void run_loop(int count, const Progress& progress,
              void (*work)(const void* context, LoopItems& items), const void* context) {
  progress.check();
  Loop loop(count, progress);
  const std::function<void()> run_thread = [&] { loop.run([&] { work(context, loop); }); };
  {
    const KeptThreads others(std::max(std::min(progress.threads(), count) - 1, 0), run_thread);
    run_thread();
  }
  loop.rethrow_failure();
  progress.check();
}

}  // namespace episcope
