// SPDX-License-Identifier: BSD-3-Clause
// From a movement of the mouse to the painted screen: a stroke on a view of 1024×1024 pixels in the
// window that ships, at rest and while the view is segmented live on every core, against drawing
// the whole view anew. A frame of the screen lasts 16 ms. Run with QT_QPA_PLATFORM=offscreen.
#include "app/gui/annotate/annotate_controller.h"
#include "app/gui/annotate/segment_controller.h"
#include "app/gui/main_window.h"
#include "app/gui/scene/document_controller.h"
#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/session/session.h"
#include "engine/scenes/builtin.h"
#include "widgets/canvas/canvas_tool.h"
#include "widgets/canvas/view_canvas.h"

#include <benchmark/benchmark.h>

#include <QAction>
#include <QApplication>
#include <QMouseEvent>
#include <QSettings>
#include <QTemporaryDir>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <vector>

namespace {

using namespace episcope;
using Clock = std::chrono::steady_clock;

constexpr int kSize = 1024;
constexpr QSize kWindow(2560, 1440);

class PaintedWindow {
 public:
  PaintedWindow() {
    QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, folder_.path());
    window = std::make_unique<MainWindow>();
    window->bench().document.setJournalFolder(folder_.filePath("journals").toStdString());
    window->resize(kWindow);
    window->show();
    scenes::RenderOptions options;
    options.grid = {3, 3};
    options.height = options.width = kSize;
    window->bench().session.open(
        std::make_shared<const Scene>(scenes::render_builtin("objects", options, Progress())),
        "bench");
    while (!window->bench().document.document()) QCoreApplication::processEvents();
    window->findChild<AnnotateController*>()->setAnnotating(true);
    settle();
  }
  ~PaintedWindow() { window->bench().document.discardChanges(); }

  static void settle() {
    for (int i = 0; i < 50; ++i) QCoreApplication::processEvents();
  }
  void send(QEvent::Type type, QPointF image) {
    ViewCanvas* canvas = window->bench().viewer_area.canvas();
    const QPointF at = canvas->canvasTransform().to_widget(image, canvas->size());
    const bool is_move = type == QEvent::MouseMove;
    QMouseEvent event(type, at, canvas->mapToGlobal(at), is_move ? Qt::NoButton : Qt::LeftButton,
                      type == QEvent::MouseButtonRelease ? Qt::NoButton : Qt::LeftButton, {});
    QCoreApplication::sendEvent(canvas, &event);
  }
  void beginStroke(QPointF image) {
    send(QEvent::MouseButtonRelease, image);
    send(QEvent::MouseButtonPress, image);
    settle();
  }
  /// The end of a stroke begins a labeling.
  void keepLabeling(QPointF image) {
    if (!window->findChild<SegmentController*>()->labeler().is_running()) beginStroke(image);
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

/// Arguments: diameter of the brush, whether labels are made meanwhile.
void segment_on_screen(benchmark::State& state) {
  PaintedWindow painted;
  const bool is_live = state.range(1) != 0;
  if (is_live) painted.window->bench().commands.trigger("segment.live");
  ViewCanvas* canvas = painted.window->bench().viewer_area.canvas();
  qobject_cast<StrokeTool*>(canvas->tool())->setBrushSize(static_cast<double>(state.range(0)));
  painted.send(QEvent::MouseButtonPress, point_at(0));
  PaintedWindow::settle();
  std::vector<double> ms;
  int i = 1;
  for (auto _ : state) {
    if (is_live) painted.keepLabeling(point_at(i));
    const auto begin = Clock::now();
    painted.send(QEvent::MouseMove, point_at(i++));
    QCoreApplication::processEvents();  // paints
    const std::chrono::duration<double> took = Clock::now() - begin;
    state.SetIterationTime(took.count());
    ms.push_back(1000 * took.count());
    if (i % 100 == 0) {  // a new stroke, as hands do
      painted.beginStroke(point_at(i));
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
    painted.window->bench().viewer_area.canvas()->update();
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
