// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/parallel.h"
#include "tests/test_main.h"

#include <atomic>
#include <latch>
#include <mutex>
#include <set>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace episcope::in_kept_threads_test {

namespace {

// The threads that ran, where all wait for each other.
std::set<std::thread::id> threads_of_a_round(int count) {
  std::mutex mutex;
  std::set<std::thread::id> ids;
  std::latch all(count + 1);
  const std::function<void()> work = [&] {
    {
      const std::scoped_lock lock(mutex);
      ids.insert(std::this_thread::get_id());
    }
    all.arrive_and_wait();
  };
  const KeptThreads others(count, work);
  work();
  return ids;
}

// The priorities of three threads of a round that a thread begins, itself included.
std::multiset<int> priorities_of_a_round() {
  std::mutex mutex;
  std::multiset<int> priorities;
  std::latch all(3);
  const std::function<void()> work = [&] {
    {
      const std::scoped_lock lock(mutex);
      priorities.insert(getpriority(PRIO_PROCESS, 0));
    }
    all.arrive_and_wait();
  };
  const KeptThreads others(2, work);
  work();
  return priorities;
}

}  // namespace

class KeptThreadsTest : public QObject {
  Q_OBJECT

 private slots:
  void everyThread_isAnother() { QCOMPARE(threads_of_a_round(5).size(), 6U); }

  void nextRound_hasTheSameThreads() {
    const auto before = threads_of_a_round(1);

    for (int i = 0; i < 20; ++i) QCOMPARE(threads_of_a_round(1), before);
  }

  void roundsWithinARound_haveTheirOwn() {
    std::atomic<std::size_t> sizes{0};
    std::latch both(2);
    const std::function<void()> work = [&] {
      both.arrive_and_wait();
      sizes += threads_of_a_round(2).size();
    };
    {
      const KeptThreads other(1, work);
      work();
    }

    QCOMPARE(sizes.load(), 6U);
  }

  void end_waitsForWhatHasBegun() {
    for (int i = 0; i < 200; ++i) {
      std::atomic<int> begun{0}, ended{0};
      const std::function<void()> work = [&] {
        ++begun;
        std::this_thread::yield();
        ++ended;
      };
      { const KeptThreads others(3, work); }

      QCOMPARE(ended.load(), begun.load());
      QVERIFY(begun <= 3);
    }
  }

  void thread_hasThePriorityOfWhoBegins() {
    const int own = getpriority(PRIO_PROCESS, 0);
    if (own >= 19) QSKIP("nothing is lower");
    const auto before = priorities_of_a_round();
    std::multiset<int> of_lowered;
    std::jthread([&] {
      setpriority(PRIO_PROCESS, 0, own + 1);
      of_lowered = priorities_of_a_round();
    }).join();

    QCOMPARE(before, std::multiset<int>({own, own, own}));
    QCOMPARE(of_lowered, std::multiset<int>({own + 1, own + 1, own + 1}));
    QCOMPARE(priorities_of_a_round(), before);
  }

  void childProcess_hasThreadsToo() {
#if defined(__SANITIZE_THREAD__)
    QSKIP("the thread sanitizer allows no threads in a forked process");
#endif
    (void)threads_of_a_round(2);

    const pid_t child = fork();
    if (child == 0) _exit(threads_of_a_round(2).size() == 3 ? 0 : 1);
    int status = -1;
    waitpid(child, &status, 0);

    QVERIFY(WIFEXITED(status));
    QCOMPARE(WEXITSTATUS(status), 0);
  }
};

}  // namespace episcope::in_kept_threads_test

EPISCOPE_TEST(kept_threads_test, KeptThreadsTest)
#include "kept_threads_test.moc"
