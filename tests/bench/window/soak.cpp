// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/compare/compare_controller.h"
#include "app/gui/estimate/estimate_controller.h"
#include "app/gui/files/autosave.h"
#include "tests/app/gui/paint_stroke.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/bench/window/process.h"
#include "tests/bench/window/use.h"
#include "widgets/canvas/view_canvas.h"

#include <QEventLoop>
#include <QTest>
#include <QTimer>

#include <algorithm>
#include <cstdio>

namespace episcope::bench {
namespace {

constexpr int kReportEvery = 25;

void estimate(WindowFixture& f, const char* method) {
  const std::size_t before = f.window.bench().session.estimates().size();
  find<EstimateController>(f.window).run({method, {}, {.views = ViewSelection::Center}});
  (void)QTest::qWaitFor([&] { return f.window.bench().session.estimates().size() > before; },
                        kScenePatience);
}

void round(WindowFixture& f, int number) {
  const MainWindow& window = f.window;
  const QString file = f.path(number % 2 == 0 ? "edge/lf.h5" : "slant/lf.h5");
  window.bench().opener.open(file);
  (void)QTest::qWaitFor(
      [&] { return window.bench().session.scene() && window.bench().document.document(); },
      kScenePatience);
  estimate(f, "st_ch_l");
  estimate(f, "epi_l");
  f.trigger("annotate.mode");
  paint_stroke(f.window, number);
  f.trigger("overlay.error");
  for (const CompareMode mode : {CompareMode::Wipe, CompareMode::Wall, CompareMode::Single}) {
    find<CompareController>(f.window).setMode(mode);
    QCoreApplication::processEvents();
  }
  window.bench().frame.showTab("compare");
  (void)QTest::qWaitFor([&] { return !window.bench().session.is_evaluating(); }, kPatience);
  const auto& autosave = find<Autosave>(f.window);
  (void)QTest::qWaitFor([&] { return autosave.isIdle() && window.bench().jobs.count() == 0; },
                        kPatience);
  Session& session = f.window.bench().session;
  for (const EstimateEntry& each : session.estimates()) session.mark_saved(each.id);
  f.window.bench().document.discardAll();
  f.trigger("file.close");
  (void)QTest::qWaitFor([&] { return !window.bench().session.scene(); }, kPatience);
}

int objects_in(const QObject& window) {
  return static_cast<int>(window.findChildren<QObject*>().size());
}

}  // namespace

void measure_soak(int rounds) {
  WindowFixture f;
  for (const char* id : {"edge", "slant"}) (void)f.writeScene(id, WindowFixture::smallOptions());
  std::printf("%6s %12s %6s %8s %8s\n", "round", "memory, MiB", "files", "threads", "objects");
  for (int number = 0; number <= rounds; ++number) {
    if (number % kReportEvery == 0) {
      const Process now = this_process();
      std::printf("%6d %12.1f %6d %8d %8d\n", number, now.memory_mib, now.files, now.threads,
                  objects_in(f.window));
      std::fflush(stdout);
    }
    if (number < rounds) round(f, number);
  }
}

void measure_idle(double seconds) {
  WindowFixture f;
  f.openSmall();
  estimate(f, "st_ch_l");
  f.trigger("overlay.error");
  (void)QTest::qWaitFor(
      [&] { return f.window.bench().jobs.count() == 0 && find<Autosave>(f.window).isIdle(); },
      kPatience);
  QTest::qWait(3000);  // the last timers
  const double before = this_process().cpu_s;
  QEventLoop loop;  // qWait looks a hundred times a second whether it is time
  QTimer::singleShot(static_cast<int>(1000 * seconds), &loop, &QEventLoop::quit);
  loop.exec();
  const double used = this_process().cpu_s - before;
  std::printf("idle: %.3f s of processor time in %.0f s, %.2f %%\n", used, seconds,
              100 * used / seconds);
}

}  // namespace episcope::bench
