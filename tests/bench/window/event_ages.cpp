// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/window/event_ages.h"

#include <QCoreApplication>
#include <QEventLoop>
#include <QTimer>

#include <algorithm>
#include <atomic>
#include <thread>

namespace episcope::bench {
namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

constexpr auto kInterval = std::chrono::milliseconds(5);

}  // namespace

std::vector<double> event_ages(QObject& window, const Probe& probe) {
  std::vector<double> ages;
  std::atomic<bool> ends{false};
  std::jthread clock([&] {
    for (int number = 0; !ends; ++number) {
      QMetaObject::invokeMethod(
          &window,
          [&, number, posted = Clock::now()] {
            ages.push_back(Milliseconds(Clock::now() - posted).count());
            if (probe.on_age) probe.on_age(ages.back());
            if (number % kEventsPerInput == 0) probe.input(number / kEventsPerInput);
          },
          Qt::QueuedConnection);
      std::this_thread::sleep_for(kInterval);
    }
  });
  // Not QTest::qWaitFor, which sleeps for 10 ms in every round, whatever waits to be handled.
  QEventLoop loop;
  QTimer look;
  QObject::connect(&look, &QTimer::timeout, &loop, [&] {
    if (probe.has_ended()) loop.quit();
  });
  look.start(kInterval);
  QTimer::singleShot(probe.patience_ms, &loop, &QEventLoop::quit);
  loop.exec();
  ends = true;
  clock.join();
  QCoreApplication::processEvents();  // the last of them still refer to `ages`
  return ages;
}

double percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

}  // namespace episcope::bench
