// SPDX-License-Identifier: BSD-3-Clause
// How late the window handles events while it works: a method that runs, overlays that change,
// tiles that are zoomed, strokes during live labeling; each against the same window at rest. A
// frame of the screen lasts 16 ms. Needs a display, or QT_QPA_PLATFORM=offscreen.
#include "app/gui/annotate/segment_controller.h"
#include "app/gui/compare/compare_controller.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/bench/window/event_ages.h"
#include "tests/widgets/pictures.h"
#include "widgets/canvas/tile_wall.h"
#include "widgets/canvas/view_canvas.h"

#include <QAction>
#include <QApplication>
#include <QTest>

#include <array>
#include <chrono>
#include <cstdio>
#include <functional>
#include <vector>

namespace {

using namespace episcope;

using bench::percentile;
using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

constexpr scenes::RenderOptions kLargeViews{{3, 3}, 1024, 1024};

// What a user does: moves the mouse over the view, and steps through the views.
void give_input(MainWindow& window, int number) {
  ViewCanvas* canvas = window.bench().viewer_area.canvas();
  const PixelIndex pixel{number % 500, (number * 7) % 500};
  QTest::mouseMove(canvas, canvas->positionOf(pixel).toPoint());
  if (number % 3 == 0) window.bench().session.set_view({4, number % 9});
  if (number % 5 == 0) window.bench().session.set_cross_hair(pixel);
}

std::vector<double> latencies(MainWindow& window, const std::function<void(int)>& input,
                              const std::function<bool()>& has_ended) {
  return bench::event_ages(window, {input, has_ended, kScenePatience, {}});
}

std::vector<double> latencies_during_run(MainWindow& window) {
  window.bench().commands.find("estimate.run")->trigger();
  return latencies(
      window, [&](int number) { give_input(window, number); },
      [&] { return window.bench().jobs.count() == 0; });
}

// What a user does with an overlay: other maps, other ranges, to and fro between A and B, the
// divider of a wipe, other views.
void change_overlay(MainWindow& window, int number) {
  using render::Quantity;
  constexpr std::array maps = {Quantity::Disparity, Quantity::SignedError, Quantity::Truth,
                               Quantity::AbsoluteError, Quantity::BadPixels};
  Overlay& overlay = window.bench().overlay;
  ViewCanvas* canvas = window.bench().viewer_area.canvas();
  switch (number % 8) {
    case 0:
      overlay.setQuantity(maps[static_cast<std::size_t>(number / 8) % maps.size()]);
      break;
    case 1:
    case 5:
      overlay.setRange(Interval{-1 - 0.01 * number, 1 + 0.01 * number});
      break;
    case 2:
    case 3:
      overlay.setFlipped(number % 8 == 2);
      break;
    case 4:
      find<CompareController>(window).toggleMode(CompareMode::Wipe);
      break;
    case 6:
      emit canvas->wipeMoved(0.01 * (number % 100));
      break;
    default:
      window.bench().session.set_view({1, number / 8 % 3 == 2 ? 0 : 1});
  }
}

void report(const char* what, const std::vector<double>& ms, const std::vector<double>& at_rest) {
  std::printf(
      "%-44s median %6.2f  95 %% %6.2f  longest %7.2f ms; 95 %% at rest %6.2f ms, %.1f times\n",
      what, percentile(ms, 0.5), percentile(ms, 0.95), percentile(ms, 1), percentile(at_rest, 0.95),
      percentile(ms, 0.95) / percentile(at_rest, 0.95));
}

// The window with nothing to do but to answer.
std::vector<double> latencies_at_rest(MainWindow& window) {
  const auto end = Clock::now() + std::chrono::seconds(1);
  return latencies(
      window, [&](int number) { give_input(window, number); }, [&] { return Clock::now() > end; });
}

// Results of the center view that are off the truth by more and more.
void add_results(Session& session, int count) {
  const LightField& light_field = *session.light_field();
  for (int i = 0; i < count; ++i) {
    auto estimate = std::make_shared<Estimate>();
    estimate->method = "off";
    estimate->field.disparity = ViewStack<float>({1, 1}, light_field.height(), light_field.width(),
                                                 1, light_field.center());
    const DisparityView truth = session.scene()->truth->field.view(light_field.center());
    auto values = estimate->field.disparity.view(light_field.center());
    for (int y = 0; y < values.height; ++y) {
      for (int x = 0; x < values.width; ++x) {
        values.at(y, x) = truth.disparity.at(y, x) + 0.01F * static_cast<float>(i);
      }
    }
    session.add_estimate(estimate, {-1, 1}, session.generation());
  }
}

// A hand that paints: strokes of 15 movements each, here and there on the view.
class Painter {
 public:
  explicit Painter(MainWindow& window) : window_(window) {}

  void move(int number) {
    constexpr int kMoves = 15;
    ViewCanvas* canvas = window_.bench().viewer_area.canvas();
    const int stroke = number / kMoves;
    const QPoint at = canvas
                          ->positionOf({80 + stroke * 131 % 800 + 3 * (number % kMoves),
                                        80 + stroke * 197 % 600 + 20 * (number % kMoves)})
                          .toPoint();
    if (number % kMoves == 0) {
      QTest::mousePress(canvas, Qt::LeftButton, {}, at);
    } else if (number % kMoves == kMoves - 1) {
      QTest::mouseRelease(canvas, Qt::LeftButton, {}, at);
    } else {
      QTest::mouseMove(canvas, at);
    }
    ++moves_;
    if (find<SegmentController>(window_).labeler().is_running()) ++moves_while_labeling_;
  }
  [[nodiscard]] int moves() const { return moves_; }
  [[nodiscard]] double shareWhileLabeling() const {
    return static_cast<double>(moves_while_labeling_) / moves_;
  }

 private:
  MainWindow& window_;
  int moves_ = 0;
  int moves_while_labeling_ = 0;
};

// Zooms in and out, pans, moves mouse and cross-hair over a tile.
void give_tile_input(ViewCanvas* tile, Session& session, int number) {
  const QPointF at(20 + number * 7 % 150, 20 + number * 11 % 120);
  if (number % 2 == 0) test::turn_wheel(*tile, at, number % 40 < 20 ? 1 : -1);
  if (number % 3 == 0) session.set_cross_hair({number % 500, number * 7 % 500});
  tile->setCanvasTransform(tile->canvasTransform().panned({number % 5 - 2.0, number % 7 - 3.0}));
  QTest::mouseMove(tile, at.toPoint());
}

void measure_a_run() {
  WindowFixture f;
  f.openScene("edge", {});  // 9×9 views of 512×512
  const auto at_rest = latencies_at_rest(f.window);
  report("EPI_L runs", latencies_during_run(f.window), at_rest);
}

void measure_overlays() {
  constexpr int inputs = 160;
  WindowFixture f;
  f.window.resize(2560, 1440);
  f.openScene("edge", kLargeViews);
  add_results(f.window.bench().session, 2);
  const Overlay& overlay = f.window.bench().overlay;
  (void)QTest::qWaitFor([&] { return !overlay.picture().isNull(); }, kScenePatience);
  const auto at_rest = latencies_at_rest(f.window);
  int given = 0;
  const auto ms = latencies(
      f.window, [&](int number) { change_overlay(f.window, given = number); },
      [&] { return given >= inputs; });
  report("overlays of 1024×1024 pixels change", ms, at_rest);
}

void measure_tiles() {
  WindowFixture f;
  f.openScene("edge", {});
  const auto at_rest = latencies_at_rest(f.window);
  add_results(f.window.bench().session, 10);
  TileWall* wall = f.window.bench().viewer_area.wall();
  find<CompareController>(f.window).setMode(CompareMode::Wall);
  (void)QTest::qWaitFor([&] { return wall->count() == 12; }, kScenePatience);
  std::vector<double> frames;
  for (int number = 0; number < 200; ++number) {
    const auto begin = Clock::now();
    give_tile_input(wall->tile(number % 12), f.window.bench().session, number);
    QCoreApplication::processEvents();  // paints all tiles
    frames.push_back(Milliseconds(Clock::now() - begin).count());
  }
  report("12 tiles of 512×512 pixels are zoomed", frames, at_rest);
}

void measure_strokes() {
  constexpr int moves = 300;
  WindowFixture f;
  f.openScene("objects", kLargeViews);
  const LiveLabeler& labeler = find<SegmentController>(f.window).labeler();
  (void)QTest::qWaitFor([&] { return labeler.has_input(); }, kScenePatience);
  const auto at_rest = latencies_at_rest(f.window);
  f.trigger("annotate.mode");
  f.trigger("segment.live");
  (void)QTest::qWaitFor([&] { return labeler.labeling(f.view()) != nullptr; }, kScenePatience);
  Painter painter(f.window);
  const auto ms = latencies(
      f.window, [&](int number) { painter.move(number); },
      [&] { return painter.moves() >= moves; });
  report("strokes while labels are made", ms, at_rest);
  std::printf("labels were made for %.0f %% of the strokes\n", 100 * painter.shareWhileLabeling());
  f.window.bench().document.discardChanges();
}

}  // namespace

int main(int argc, char** argv) {
  const QApplication application(argc, argv);
  measure_a_run();
  measure_overlays();
  measure_tiles();
  measure_strokes();
}
