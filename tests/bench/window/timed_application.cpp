// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/window/timed_application.h"

#include <QEvent>
#include <QMetaEnum>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <utility>
#include <vector>

namespace episcope::bench {
namespace {

constexpr std::size_t kPrinted = 20;

using Milliseconds = std::chrono::duration<double, std::milli>;

std::string name_of(const QObject& receiver, QEvent::Type type) {
  const char* kind = QMetaEnum::fromType<QEvent::Type>().valueToKey(type);
  return std::string(receiver.metaObject()->className()) + ' ' +
         receiver.objectName().toStdString() + ' ' + (kind ? kind : "?");
}

}  // namespace

double thread_cpu_ms() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

bool TimedApplication::notify(QObject* receiver, QEvent* event) {
  if (!is_timing_ || depth_ > 0) return QApplication::notify(receiver, event);
  // The receiver may be gone afterwards.
  Cost& cost = costs_[name_of(*receiver, event->type())];
  const auto begin = std::chrono::steady_clock::now();
  const double cpu_begin = thread_cpu_ms();
  ++depth_;
  const bool is_done = QApplication::notify(receiver, event);
  --depth_;
  const double cpu_ms = thread_cpu_ms() - cpu_begin;
  const double wall_ms = Milliseconds(std::chrono::steady_clock::now() - begin).count();
  ++cost.count;
  cost.wall_ms += wall_ms;
  cost.cpu_ms += cpu_ms;
  cost.most_wall_ms = std::max(cost.most_wall_ms, wall_ms);
  cost.most_cpu_ms = std::max(cost.most_cpu_ms, cpu_ms);
  return is_done;
}

void TimedApplication::begin() {
  costs_.clear();
  is_timing_ = true;
}

void TimedApplication::report() const {
  std::vector<std::pair<std::string, Cost>> all(costs_.begin(), costs_.end());
  const auto print = [&](const char* title, double Cost::*key) {
    std::ranges::sort(
        all, [key](const auto& a, const auto& b) { return a.second.*key > b.second.*key; });
    std::printf("%s\n%8s %22s %22s\n", title, "events", "longest: wall, own ms",
                "sum: wall, own ms");
    for (std::size_t i = 0; i < std::min(kPrinted, all.size()); ++i) {
      const Cost& cost = all[i].second;
      std::printf("%8d %11.1f %10.1f %11.0f %10.0f  %s\n", cost.count, cost.most_wall_ms,
                  cost.most_cpu_ms, cost.wall_ms, cost.cpu_ms, all[i].first.c_str());
    }
  };
  print("what computed longest at once", &Cost::most_cpu_ms);
  print("what computed most", &Cost::cpu_ms);
}

}  // namespace episcope::bench
