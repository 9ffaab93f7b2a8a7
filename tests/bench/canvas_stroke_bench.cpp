// SPDX-License-Identifier: BSD-3-Clause
// From a movement of the mouse to the painted screen: a stroke on a view of 1024×1024 pixels in the
// window that ships, at rest and while a job keeps every core busy, against drawing the whole view
// anew. A frame of the screen lasts 16 ms. Run with QT_QPA_PLATFORM=offscreen.
#include "app/gui/annotate_controller.h"
#include "app/gui/document_controller.h"
#include "app/gui/main_window.h"
#include "app/session/session.h"
#include "app/session/thread_priority.h"
#include "engine/scenes/builtin.h"
#include "widgets/view_canvas.h"

#include <benchmark/benchmark.h>

#include <QApplication>
#include <QMouseEvent>
#include <QSettings>
#include <QTemporaryDir>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>
#include <vector>

namespace {

using namespace episcope;
using Clock = std::chrono::steady_clock;

constexpr int kSize = 1024;
constexpr QSize kWindow(2560, 1440);

/// What a labeling does with the machine: sweeps over more memory than the caches hold, on every
/// core, at the priority of our jobs.
class BusyCores {
 public:
  BusyCores() {
    for (unsigned i = 0; i < std::max(2U, std::thread::hardware_concurrency()); ++i) {
      threads_.emplace_back([](const std::stop_token& stop) {
        lower_thread_priority();
        std::vector<float> costs(std::size_t{8} << 20, 0.5F);
        while (!stop.stop_requested()) {
          for (std::size_t k = 1; k < costs.size(); ++k) {
            costs[k] = std::max(0.0F, 0.7F * costs[k] + 0.3F * costs[k - 1] - 0.01F) + 0.01F;
          }
          benchmark::DoNotOptimize(costs.data());
        }
      });
    }
  }

 private:
  std::vector<std::jthread> threads_;
};

class PaintedWindow {
 public:
  PaintedWindow() {
    QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, folder_.path());
    window = std::make_unique<MainWindow>();
    window->document().setJournalFolder(folder_.filePath("journals").toStdString());
    window->resize(kWindow);
    window->show();
    scenes::RenderOptions options;
    options.grid = {3, 3};
    options.height = options.width = kSize;
    window->session().open(
        std::make_shared<const Scene>(scenes::render_builtin("objects", options, Progress())),
        "bench");
    while (!window->document().document()) QCoreApplication::processEvents();
    window->annotate().setAnnotating(true);
    window->annotate().addLabel();
    settle();
  }
  ~PaintedWindow() { window->document().discardChanges(); }

  static void settle() {
    for (int i = 0; i < 50; ++i) QCoreApplication::processEvents();
  }
  void send(QEvent::Type type, QPointF image) {
    ViewCanvas* canvas = window->panels().canvas;
    const QPointF at = canvas->canvasTransform().to_widget(image, canvas->size());
    const bool is_move = type == QEvent::MouseMove;
    QMouseEvent event(type, at, canvas->mapToGlobal(at), is_move ? Qt::NoButton : Qt::LeftButton,
                      type == QEvent::MouseButtonRelease ? Qt::NoButton : Qt::LeftButton, {});
    QCoreApplication::sendEvent(canvas, &event);
  }

 private:
  QTemporaryDir folder_;

 public:
  std::unique_ptr<MainWindow> window;
};

/// Points of a hand that moves fast: 40 px from one to the next.
QPointF point_at(int i) {
  return {kSize / 2 + 400 * std::cos(i * 0.1), kSize / 2 + 400 * std::sin(i * 0.1)};
}

double percentile(std::vector<double>& values, double share) {
  const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

void report(benchmark::State& state, std::vector<double>& ms) {
  state.counters["median_ms"] = percentile(ms, 0.5);
  state.counters["p95_ms"] = percentile(ms, 0.95);
  state.counters["longest_ms"] = percentile(ms, 1);
}

/// Arguments: diameter of the brush, whether every core is busy.
void segment_on_screen(benchmark::State& state) {
  PaintedWindow painted;
  const auto busy = state.range(1) != 0 ? std::make_unique<BusyCores>() : nullptr;
  ViewCanvas* canvas = painted.window->panels().canvas;
  canvas->tool()->setBrushSize(static_cast<double>(state.range(0)));
  painted.send(QEvent::MouseButtonPress, point_at(0));
  PaintedWindow::settle();
  std::vector<double> ms;
  int i = 1;
  for (auto _ : state) {
    const auto begin = Clock::now();
    painted.send(QEvent::MouseMove, point_at(i++));
    QCoreApplication::processEvents();  // paints
    const std::chrono::duration<double> took = Clock::now() - begin;
    state.SetIterationTime(took.count());
    ms.push_back(1000 * took.count());
    if (i % 100 == 0) {  // a new stroke, as hands do
      painted.send(QEvent::MouseButtonRelease, point_at(i));
      painted.send(QEvent::MouseButtonPress, point_at(i));
      PaintedWindow::settle();
    }
  }
  painted.send(QEvent::MouseButtonRelease, point_at(i));
  report(state, ms);
}
BENCHMARK(segment_on_screen)
    ->ArgsProduct({{1, 10, 100}, {0, 1}})
    ->UseManualTime()
    ->Iterations(400)
    ->Unit(benchmark::kMillisecond);

/// The plain way: the whole view with all that is painted.
void whole_view_on_screen(benchmark::State& state) {
  PaintedWindow painted;
  std::vector<double> ms;
  for (auto _ : state) {
    const auto begin = Clock::now();
    painted.window->panels().canvas->update();
    QCoreApplication::processEvents();
    const std::chrono::duration<double> took = Clock::now() - begin;
    state.SetIterationTime(took.count());
    ms.push_back(1000 * took.count());
  }
  report(state, ms);
}
BENCHMARK(whole_view_on_screen)->UseManualTime()->Iterations(100)->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
