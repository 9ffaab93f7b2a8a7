// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/jobs.h"
#include "tests/test_main.h"

#include <condition_variable>
#include <deque>
#include <latch>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace episcope::in_job_runner_test {

namespace {

// The owner's thread: closures wait here until they are run.
class Inbox {
 public:
  JobRunner::Post post() {
    return [this](std::function<void()> closure) {
      const std::scoped_lock lock(mutex_);
      closures_.push_back(std::move(closure));
      arrived_.notify_all();
    };
  }

  // Waits for the next closure and runs it.
  void run_next() {
    std::function<void()> closure;
    {
      std::unique_lock lock(mutex_);
      arrived_.wait(lock, [this] { return !closures_.empty(); });
      closure = std::move(closures_.front());
      closures_.pop_front();
    }
    closure();
  }

  template <class Condition>
  void run_until(const Condition& condition) {
    while (!condition()) run_next();
  }

  [[nodiscard]] std::size_t waiting() {
    const std::scoped_lock lock(mutex_);
    return closures_.size();
  }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<std::function<void()>> closures_;
};

// Works until it is stopped.
int run_forever(const Progress& progress, std::latch& begun) {
  begun.count_down();
  while (true) {
    progress.check();
    std::this_thread::yield();
  }
}

}  // namespace

class JobRunnerTest : public QObject {
  Q_OBJECT

 private slots:
  void job_deliversItsValue() {
    Inbox inbox;
    JobRunner runner(inbox.post());
    Outcome<std::string> got;
    bool is_done = false;

    runner.start<std::string>([](const Progress&) { return std::string("a value"); },
                              [&](Outcome<std::string> outcome) {
                                got = std::move(outcome);
                                is_done = true;
                              });
    inbox.run_until([&] { return is_done; });

    QCOMPARE(got.value.value(), std::string("a value"));
    QVERIFY(!got.failure && !got.was_cancelled());
    QCOMPARE(runner.pending(), 0);
  }

  void job_runsOnAThreadOfItsOwn() {
    Inbox inbox;
    JobRunner runner(inbox.post());
    std::thread::id worker;
    std::thread::id receiver;

    runner.start<std::thread::id>([](const Progress&) { return std::this_thread::get_id(); },
                                  [&](Outcome<std::thread::id> outcome) {
                                    worker = *outcome.value;
                                    receiver = std::this_thread::get_id();
                                  });
    inbox.run_until([&] { return receiver != std::thread::id{}; });

    QVERIFY(receiver == std::this_thread::get_id());
    QVERIFY(worker != receiver);
  }

  void jobs_runInOrder() {
    Inbox inbox;
    JobRunner runner(inbox.post());
    std::vector<int> order;

    for (int i = 0; i < 5; ++i) {
      runner.start<int>([i](const Progress&) { return i; },
                        [&](Outcome<int> outcome) { order.push_back(*outcome.value); });
    }
    inbox.run_until([&] { return order.size() == 5; });

    QCOMPARE(order, (std::vector<int>{0, 1, 2, 3, 4}));
  }

  void exception_isDelivered() {
    Inbox inbox;
    JobRunner runner(inbox.post());
    Outcome<int> got;
    bool is_done = false;

    runner.start<int>([](const Progress&) -> int { throw InvalidInput("no such view"); },
                      [&](Outcome<int> outcome) {
                        got = std::move(outcome);
                        is_done = true;
                      });
    inbox.run_until([&] { return is_done; });

    QVERIFY(!got.value && !got.was_cancelled());
    QVERIFY_THROWS_EXCEPTION(InvalidInput, std::rethrow_exception(got.failure));
  }

  void runner_survivesAFailedJob() {
    Inbox inbox;
    JobRunner runner(inbox.post());
    int value = 0;

    runner.start<int>([](const Progress&) -> int { throw std::runtime_error("bad"); },
                      [](Outcome<int>) {});
    runner.start<int>([](const Progress&) { return 42; },
                      [&](Outcome<int> outcome) { value = *outcome.value; });
    inbox.run_until([&] { return value != 0; });

    QCOMPARE(value, 42);
  }

  void cancel_stopsARunningJob() {
    Inbox inbox;
    JobRunner runner(inbox.post());
    std::latch begun(1);
    bool was_cancelled = false;

    const JobId id = runner.start<int>(
        [&begun](const Progress& progress) { return run_forever(progress, begun); },
        [&](Outcome<int> outcome) { was_cancelled = outcome.was_cancelled(); });
    begun.wait();
    QCOMPARE(runner.pending(), 1);
    runner.cancel(id);
    inbox.run_until([&] { return was_cancelled; });

    QCOMPARE(runner.pending(), 0);
  }

  void finish_letsARunningJobGiveWhatItHas() {
    Inbox inbox;
    JobRunner runner(inbox.post());
    std::latch begun(1);
    int value = 0;

    const JobId id = runner.start<int>(
        [&begun](const Progress& progress) {
          begun.count_down();
          while (!progress.finish_requested()) std::this_thread::yield();
          return 7;
        },
        [&](Outcome<int> outcome) { value = outcome.value.value_or(-1); });
    begun.wait();
    runner.finish(id);
    inbox.run_until([&] { return value != 0; });

    QCOMPARE(value, 7);
  }

  void cancel_keepsAQueuedJobFromRunning() {
    Inbox inbox;
    JobRunner runner(inbox.post());
    std::latch begun(1);
    bool has_run = false;
    int done = 0;
    bool was_cancelled = false;

    const JobId first = runner.start<int>(
        [&begun](const Progress& progress) { return run_forever(progress, begun); },
        [&](Outcome<int>) { ++done; });
    const JobId second = runner.start<int>(
        [&has_run](const Progress&) {
          has_run = true;
          return 1;
        },
        [&](Outcome<int> outcome) {
          ++done;
          was_cancelled = outcome.was_cancelled();
        });
    begun.wait();
    runner.cancel(second);
    runner.cancel(first);
    inbox.run_until([&] { return done == 2; });

    QVERIFY(was_cancelled);
    QVERIFY(!has_run);
  }

  void cancelAll_stopsEveryJob() {
    Inbox inbox;
    JobRunner runner(inbox.post());
    std::latch begun(1);
    int cancelled = 0;
    const auto count = [&](Outcome<int> outcome) { cancelled += outcome.was_cancelled(); };

    runner.start<int>([&](const Progress& progress) { return run_forever(progress, begun); },
                      count);
    runner.start<int>([](const Progress&) { return 1; }, count);
    runner.start<int>([](const Progress&) { return 2; }, count);
    begun.wait();
    QCOMPARE(runner.pending(), 3);
    runner.cancel_all();
    inbox.run_until([&] { return cancelled == 3; });

    QCOMPARE(runner.pending(), 0);
  }

  void cancelOfTheUnknown_isIgnored() {
    Inbox inbox;
    JobRunner runner(inbox.post());
    int value = 0;

    const JobId id = runner.start<int>([](const Progress&) { return 5; },
                                       [&](Outcome<int> outcome) { value = *outcome.value; });
    inbox.run_until([&] { return value != 0; });
    runner.cancel(id);
    runner.cancel(id + 100);

    QCOMPARE(value, 5);
  }

  void progress_isCoalescedToTheNewest() {
    Inbox inbox;
    JobRunner runner(inbox.post());
    std::vector<double> fractions;
    bool is_done = false;

    runner.start<int>(
        [](const Progress& progress) {
          for (int i = 1; i <= 500; ++i) progress.report(i / 500.0);
          return 0;
        },
        [&](Outcome<int>) { is_done = true; },
        [&](const ProgressState& state) { fractions.push_back(state.fraction); });
    // The owner is busy until the job has ended: one state and the outcome wait for it.
    while (runner.pending() > 0) std::this_thread::yield();
    inbox.run_until([&] { return is_done; });

    QCOMPARE(fractions, std::vector<double>{1.0});
  }

  // The owner may handle it while the job is still within the call that told it.
  void progress_mayBeHandledBeforePostReturns() {
    std::vector<double> told;
    std::atomic<bool> has_ended{false};
    {
      JobRunner runner([](const std::function<void()>& closure) { closure(); });
      (void)runner.start<int>(
          [](const Progress& progress) {
            for (const double fraction : {0.25, 0.5, 0.75}) progress.report(fraction);
            return 1;
          },
          [&](Outcome<int>) { has_ended = true; },
          [&](const ProgressState& state) { told.push_back(state.fraction); });
      QTRY_VERIFY(has_ended);
    }

    QCOMPARE(told, std::vector<double>({0.25, 0.5, 0.75}));
  }

  void progress_comesBeforeTheOutcome() {
    Inbox inbox;
    JobRunner runner(inbox.post());
    std::vector<std::string> events;

    runner.start<int>(
        [](const Progress& progress) {
          progress.step("stage");
          return 0;
        },
        [&](Outcome<int>) { events.emplace_back("done"); },
        [&](const ProgressState& state) { events.push_back(state.step); });
    inbox.run_until([&] { return !events.empty() && events.back() == "done"; });

    QCOMPARE(events, (std::vector<std::string>{"stage", "done"}));
  }

  void destructor_stopsTheRunningJobAndDeliversNothing() {
    Inbox inbox;
    std::latch begun(1);
    bool has_run = false;
    int done = 0;
    {
      JobRunner runner(inbox.post());
      runner.start<int>([&begun](const Progress& progress) { return run_forever(progress, begun); },
                        [&](Outcome<int>) { ++done; });
      runner.start<int>(
          [&has_run](const Progress&) {
            has_run = true;
            return 1;
          },
          [&](Outcome<int>) { ++done; });
      begun.wait();
    }

    QCOMPARE(inbox.waiting(), std::size_t{0});
    QCOMPARE(done, 0);
    QVERIFY(!has_run);
  }
};

}  // namespace episcope::in_job_runner_test

EPISCOPE_TEST(job_runner_test, JobRunnerTest)
#include "job_runner_test.moc"
