// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/window/timed_application.h"

#include <QAbstractEventDispatcher>
#include <QEvent>
#include <QMetaEnum>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iterator>
#include <utility>
#include <vector>

#include <sys/resource.h>

namespace episcope::bench {
namespace {

constexpr std::size_t kPrinted = 20;
constexpr const char* kBetween = "between events";

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

double waited_for_processor_ms() {
  std::ifstream file("/proc/self/schedstat");
  double run_ns = 0;
  double waited_ns = 0;
  file >> run_ns >> waited_ns;
  return 1e-6 * waited_ns;
}

long page_faults() {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_minflt + usage.ru_majflt;
}

bool TimedApplication::notify(QObject* receiver, QEvent* event) {
  if (!is_timing_ || depth_ > 0) return QApplication::notify(receiver, event);
  endWork();
  beginWork(name_of(*receiver, event->type()));  // The receiver may be gone afterwards.
  ++depth_;
  const bool is_done = QApplication::notify(receiver, event);
  --depth_;
  endWork();
  beginWork(kBetween);
  return is_done;
}

void TimedApplication::beginWork(const std::string& name) {
  now_ = {name, Clock::now()};
  cpu_begin_ms_ = thread_cpu_ms();
  now_.waited_ms = waited_for_processor_ms();
  now_.faults = page_faults();
  waits_.emplace_back(now_.begin, now_.waited_ms);
  stacks_->begin_work();
}

void TimedApplication::endWork() {
  if (now_.name.empty()) return;
  now_.stacks = stacks_->end_work();
  now_.wall_ms = Milliseconds(Clock::now() - now_.begin).count();
  now_.cpu_ms = thread_cpu_ms() - cpu_begin_ms_;
  now_.waited_ms = waited_for_processor_ms() - now_.waited_ms;
  now_.faults = page_faults() - now_.faults;
  note(std::exchange(now_, {}));
}

void TimedApplication::note(Handled handled) {
  Cost& cost = costs_[handled.name];
  ++cost.count;
  cost.wall_ms += handled.wall_ms;
  cost.cpu_ms += handled.cpu_ms;
  cost.most_wall_ms = std::max(cost.most_wall_ms, handled.wall_ms);
  cost.most_cpu_ms = std::max(cost.most_cpu_ms, handled.cpu_ms);
  const auto oldest = handled.begin - std::chrono::seconds(2);
  latest_.push_back(std::move(handled));
  while (latest_.front().begin < oldest) latest_.pop_front();
  while (waits_.front().first < oldest) waits_.pop_front();
}

void TimedApplication::noteLate(double age_ms) {
  const auto end = Clock::now();
  const auto begin = end - std::chrono::duration_cast<Clock::duration>(Milliseconds(age_ms));
  // Those that were posted while the first of them waited.
  if (!delays_.empty() && begin < delays_.back().end) {
    ++delays_.back().events;
    return;
  }
  Delay delay{age_ms, 1, end, 0, {}};
  const auto after =
      std::ranges::find_if(waits_, [&](const auto& each) { return each.first >= begin; });
  if (after != waits_.begin()) {
    delay.waited_ms = waited_for_processor_ms() - std::prev(after)->second;
  }
  const auto first = std::ranges::find_if(latest_, [&](const Handled& each) {
    return each.begin + Milliseconds(each.wall_ms) > begin;
  });
  std::copy_if(first, latest_.end(), std::back_inserter(delay.handled),
               [](const Handled& each) { return each.wall_ms > 0.5; });
  delays_.push_back(std::move(delay));
}

void TimedApplication::begin() {
  costs_.clear();
  delays_.clear();
  stacks_.emplace();
  const QAbstractEventDispatcher* dispatcher = QAbstractEventDispatcher::instance();
  connect(dispatcher, &QAbstractEventDispatcher::aboutToBlock, this, &TimedApplication::endWork);
  connect(dispatcher, &QAbstractEventDispatcher::awake, this, [this] {
    if (now_.name.empty()) beginWork(kBetween);
  });
  is_timing_ = true;
}

void TimedApplication::reportDelays() const {
  for (const Delay& delay : delays_) {
    double cpu_ms = 0;
    for (const Handled& each : delay.handled) cpu_ms += each.cpu_ms;
    std::printf("%d waited up to %.0f ms: own %.0f, waiting for a processor %.0f\n", delay.events,
                delay.age_ms, cpu_ms, delay.waited_ms);
    for (const Handled& each : delay.handled) {
      std::printf("  %.0f ms, own %.0f, waiting %.0f, %ld page faults: %s\n", each.wall_ms,
                  each.cpu_ms, each.waited_ms, each.faults, each.name.c_str());
      for (const std::string& calls : calls_of(each.stacks)) std::printf("    %s\n", calls.c_str());
    }
  }
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
  reportDelays();
}

}  // namespace episcope::bench
