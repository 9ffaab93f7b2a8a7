// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "tests/cpu_time.h"
#include "tests/test_main.h"

#include <atomic>
#include <chrono>
#include <memory>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace episcope::in_parallel_test {

namespace {

using Clock = std::chrono::steady_clock;

void spin(Clock::duration duration) {
  const auto end = Clock::now() + duration;
  while (Clock::now() < end) {
  }
}

}  // namespace

class ParallelTest : public QObject {
  Q_OBJECT

 private slots:
  void everyItem_runsOnce_data() {
    QTest::addColumn<int>("count");
    QTest::addColumn<int>("threads");
    QTest::newRow("none") << 0 << 4;
    QTest::newRow("one") << 1 << 4;
    QTest::newRow("fewer than threads") << 3 << 8;
    QTest::newRow("one thread") << 1000 << 1;
    QTest::newRow("many") << 10007 << 4;
  }
  void everyItem_runsOnce() {
    QFETCH(int, count);
    QFETCH(int, threads);
    std::vector<std::atomic<int>> runs(count);

    parallel_for(count, Progress(threads), [&](int i) { ++runs[i]; });

    for (const auto& times : runs) QCOMPARE(times.load(), 1);
  }

  void oneThread_isTheCallersOwn() {
    std::set<std::thread::id> ids;

    parallel_for(50, Progress(1), [&](int) { ids.insert(std::this_thread::get_id()); });

    QCOMPARE(ids, std::set<std::thread::id>{std::this_thread::get_id()});
  }

  void workers_areMadeOncePerThread() {
    std::atomic<int> made{0};
    std::atomic<int> sum{0};

    parallel_for_workers(500, Progress(3), [&] {
      ++made;
      return [&sum, scratch = std::vector<int>(10)](int i) mutable {
        scratch[i % 10] = i;
        sum += scratch[i % 10];
      };
    });

    QVERIFY(made >= 1 && made <= 3);
    QCOMPARE(sum.load(), 499 * 500 / 2);
  }

  void worker_mayBeOfAnyMovableType() {
    std::atomic<int> sum{0};

    parallel_for_workers(100, Progress(2), [&] {
      return [&sum, scratch = std::make_unique<int>()](int i) mutable {
        *scratch = i;
        sum += *scratch;
      };
    });

    QCOMPARE(sum.load(), 99 * 100 / 2);
  }

  void exception_ofAMakerReachesTheCaller() {
    const auto make_worker = []() -> void (*)(int) { throw std::runtime_error("no memory"); };

    QVERIFY_THROWS_EXCEPTION(std::runtime_error,
                             parallel_for_workers(10, Progress(2), make_worker));
  }

  void exception_ofABodyReachesTheCaller() {
    std::atomic<int> after{0};
    std::atomic<bool> is_thrown{false};
    const auto body = [&](int i) {
      if (i == 10) {
        is_thrown = true;
        throw std::runtime_error("item 10");
      }
      if (!is_thrown) return;
      ++after;
      spin(std::chrono::microseconds(10));
    };

    QVERIFY_THROWS_EXCEPTION(std::runtime_error, parallel_for(1000000, Progress(2), body));

    // Ten seconds of items are skipped; the other thread continues until the exception is noticed.
    QVERIFY(after < 500000);
  }

  void stop_endsTheLoopBetweenItems() {
    std::stop_source stop;
    std::atomic<int> begun_late{0};

    QVERIFY_THROWS_EXCEPTION(
        Cancelled, parallel_for(1000000, Progress(stop.get_token(), nullptr, 2), [&](int i) {
          begun_late += stop.stop_requested();
          if (i == 5) stop.request_stop();
        }));

    // The other thread may have checked just before.
    QVERIFY(begun_late <= 1);
  }

  void stop_isHonouredWithin200ms() {
    std::stop_source stop;
    double asked = 0;

    QVERIFY_THROWS_EXCEPTION(
        Cancelled, parallel_for(100000, Progress(stop.get_token(), nullptr, 2), [&](int i) {
          const auto end = Clock::now() + std::chrono::milliseconds(1);
          while (Clock::now() < end) {
          }
          if (i == 20) {
            asked = cpu_time_ms();
            stop.request_stop();
          }
        }));

    // An item takes 1 ms.
    QVERIFY(cpu_time_ms() - asked < cpu_limit_of_a_stop_ms());
  }

  void stopBefore_runsNothing() {
    std::stop_source stop;
    stop.request_stop();
    int runs = 0;

    QVERIFY_THROWS_EXCEPTION(
        Cancelled, parallel_for(10, Progress(stop.get_token(), nullptr), [&](int) { ++runs; }));

    QCOMPARE(runs, 0);
  }

  void progress_reachesTheEnd() {
    std::vector<double> fractions;
    const Progress progress(
        std::stop_token{}, [&](const ProgressState& state) { fractions.push_back(state.fraction); },
        2);

    parallel_for(64, progress.part(0, 0.5), [](int) {});

    QCOMPARE(fractions.back(), 0.5);
    QVERIFY(std::is_sorted(fractions.begin(), fractions.end()));
  }

  void loops_nest() {
    std::atomic<int> sum{0};

    parallel_for(4, Progress(2),
                 [&](int) { parallel_for(25, Progress(2), [&](int i) { sum += i; }); });

    QCOMPARE(sum.load(), 4 * 300);
  }
};

}  // namespace episcope::in_parallel_test

EPISCOPE_TEST(parallel_test, ParallelTest)
#include "parallel_test.moc"
