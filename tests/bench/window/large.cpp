// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/estimate/estimate_controller.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/bench/window/event_ages.h"
#include "tests/bench/window/process.h"
#include "tests/bench/window/use.h"
#include "widgets/canvas/epi_pane.h"
#include "widgets/canvas/view_canvas.h"

#include <QElapsedTimer>
#include <QTest>

#include <cstdio>

namespace episcope::bench {
namespace {

constexpr double kMiB = 1 << 20;
constexpr int kHour_ms = 3'600'000;

void print(const char* what, const QElapsedTimer& clock) {
  const Process now = this_process();
  std::printf("%-28s %8.2f s %9.0f MiB, at most %9.0f MiB\n", what,
              static_cast<double>(clock.elapsed()) / 1000, now.memory_mib, now.most_memory_mib);
  std::fflush(stdout);
}

void estimate_all(WindowFixture& f) {
  const Session& session = f.window.bench().session;
  QElapsedTimer clock;
  clock.start();
  find<EstimateController>(f.window).run({"epi_l", {}, {.views = ViewSelection::All}});
  const auto is_done = [&] {
    return !session.estimates().empty() || f.window.bench().jobs.count(Lane::Estimate) == 0;
  };
  const auto input = [&](int number) {
    if (number % 5 == 0) f.window.bench().session.set_view({number / 5 % 27, number / 11 % 27});
    QTest::mouseMove(f.canvas(), {20 + number % 300, 30 + number % 200});
  };
  const auto ages = event_ages(f.window, {input, is_done, kHour_ms, {}});
  print("EPI_L, all views", clock);
  std::printf("events meanwhile: 95 %% %.1f, longest %.1f ms\n", percentile(ages, 0.95),
              percentile(ages, 1));
  if (session.estimates().empty()) return std::puts("no result"), void();
  std::printf("results: %.0f MiB\n",
              static_cast<double>(byte_size(*session.estimates()[0].estimate)) / kMiB);
}

}  // namespace

void measure_large(const char* file) {
  WindowFixture f;
  const ViewerArea& viewer_area = f.window.bench().viewer_area;
  // Rows have a height of their own only once there is an EPI.
  const double none = viewer_area.horizontalEpi()->rowExtent();
  QElapsedTimer clock;
  clock.start();
  f.window.bench().opener.open(file);
  (void)QTest::qWaitFor([&] { return !f.canvas()->picture().isNull(); }, kHour_ms);
  print("first picture", clock);
  (void)QTest::qWaitFor([&] { return f.window.bench().session.scene() != nullptr; }, kHour_ms);
  print("opened", clock);
  (void)QTest::qWaitFor(
      [&] {
        return viewer_area.horizontalEpi()->rowExtent() != none &&
               viewer_area.verticalEpi()->rowExtent() != none;
      },
      kHour_ms);
  print("EPIs live", clock);
  const LightField& light_field = *f.window.bench().session.light_field();
  std::printf("samples: %.0f MiB, %s\n", static_cast<double>(light_field.byte_size()) / kMiB,
              light_field.is_on_disk() ? "on disk" : "in memory");
  estimate_all(f);
}

}  // namespace episcope::bench
