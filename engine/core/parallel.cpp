// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/parallel.h"

#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>

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

// Of the calling thread, where threads have priorities of their own (Linux), else of the program.
int priority() {
  return getpriority(PRIO_PROCESS, 0);
}

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

class KeptThreads::Thread {
 public:
  Thread() : thread_([this](const std::stop_token& end) { serve(end); }) {}

  // That of the thread that made it, for good: it could be lowered, but never raised again.
  [[nodiscard]] int made_with_priority() const { return priority_; }

  void begin(const std::function<void()>& work) {
    const std::scoped_lock lock(mutex_);
    work_ = &work;
    is_asked_ = true;
    asked_.notify_one();
  }

  // What has not begun does not begin.
  void finish() {
    std::unique_lock lock(mutex_);
    if (is_asked_) {
      is_asked_ = false;
      work_ = nullptr;
    }
    done_.wait(lock, [this] { return work_ == nullptr; });
  }

 private:
  void serve(const std::stop_token& end) {
    std::unique_lock lock(mutex_);
    while (asked_.wait(lock, end, [this] { return is_asked_; })) {
      is_asked_ = false;
      lock.unlock();
      (*work_)();
      lock.lock();
      work_ = nullptr;
      done_.notify_one();
    }
  }

  std::mutex mutex_{};
  std::condition_variable_any asked_{};
  std::condition_variable done_{};
  const std::function<void()>* work_ = nullptr;  // that is asked for or runs
  bool is_asked_ = false;
  int priority_ = priority();
  std::jthread thread_;  // the last member: it uses the others
};

namespace {

// Those that nobody uses. Never destroyed: a loop may end later than static objects. A child of
// fork() has none of its parent's threads.
class Idle {
 public:
  static Idle& threads() {
    static auto* const idle = new Idle;
    return *idle;
  }

  // One of the caller's priority: work of a lowered thread must not take others' turns.
  [[nodiscard]] std::unique_ptr<KeptThreads::Thread> take() {
    {
      const std::scoped_lock lock(mutex_);
      // The one used last.
      const auto found = std::ranges::find(threads_.rbegin(), threads_.rend(), priority(),
                                           &KeptThreads::Thread::made_with_priority);
      if (found != threads_.rend()) {
        auto thread = std::move(*found);
        threads_.erase(std::prev(found.base()));
        return thread;
      }
    }
    return std::make_unique<KeptThreads::Thread>();
  }

  // One too many of a priority ends.
  void keep(std::unique_ptr<KeptThreads::Thread> thread) {
    const std::scoped_lock lock(mutex_);
    const auto alike = std::ranges::count(threads_, thread->made_with_priority(),
                                          &KeptThreads::Thread::made_with_priority);
    if (static_cast<std::size_t>(alike) < most_) threads_.push_back(std::move(thread));
  }

 private:
  Idle() {
    pthread_atfork([] { threads().mutex_.lock(); }, [] { threads().mutex_.unlock(); },
                   [] { threads().forget(); });
  }
  void forget() {
    for (auto& thread : threads_) static_cast<void>(thread.release());
    threads_.clear();
    mutex_.unlock();
  }

  std::mutex mutex_{};
  std::vector<std::unique_ptr<KeptThreads::Thread>> threads_{};
  std::size_t most_ = std::thread::hardware_concurrency();
};

constexpr int kNice = 10;
// The shortest that can be asked for.
constexpr std::uint64_t kShortTurn_ns = 100'000;

// As in linux/sched/types.h, which in Debian 12 cannot be included beside the C library's sched.h.
struct SchedulingAttributes {
  std::uint32_t size = sizeof(SchedulingAttributes);
  std::uint32_t policy = SCHED_OTHER;
  std::uint64_t flags = 0;
  std::int32_t nice = 0;
  std::uint32_t priority = 0;
  std::uint64_t runtime = 0;
  std::uint64_t deadline = 0;
  std::uint64_t period = 0;
};

/// Gives the calling thread, and those that it starts, a nice value and turns of this length; 0 =
/// the length of the system. On Linux both belong to a thread.
void set_turns(int nice, std::uint64_t turn_ns) {
  SchedulingAttributes attributes;
  attributes.nice = nice;
  attributes.runtime = turn_ns;
  if (syscall(SYS_sched_setattr, 0, &attributes, 0U) != 0) setpriority(PRIO_PROCESS, 0, nice);
}

}  // namespace

KeptThreads::KeptThreads(int count, const std::function<void()>& work) {
  threads_.reserve(count);
  for (int i = 0; i < count; ++i) threads_.push_back(Idle::threads().take());
  for (const auto& thread : threads_) thread->begin(work);
}

KeptThreads::~KeptThreads() {
  for (auto& thread : threads_) thread->finish();
  for (auto& thread : threads_) Idle::threads().keep(std::move(thread));
}

void lower_thread_priority() {
  set_turns(kNice, 0);
}

void request_low_latency() {
  set_turns(getpriority(PRIO_PROCESS, 0), kShortTurn_ns);
}

}  // namespace episcope
