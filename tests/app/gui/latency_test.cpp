// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/frame/commands.h"
#include "app/gui/annotate/annotate_controller.h"
#include "app/gui/compare/compare_controller.h"
#include "app/gui/frame/jobs.h"
#include "app/gui/stage/overlay.h"
#include "app/gui/segment/segment_controller.h"
#include "app/session/session.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/widgets/pictures.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/tile_wall.h"
#include "widgets/canvas/view_canvas.h"

#include <QAction>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <thread>
#include <vector>

namespace episcope::in_latency_test {

namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

constexpr auto kInterval = std::chrono::milliseconds(5);
constexpr int kInputsPerEvent = 4;         // every fourth event is an input that redraws the window
constexpr double kFrame = 16 * kSlowdown;  // ms
constexpr int kAttempts = 4;
constexpr scenes::RenderOptions kLargeViews{{3, 3}, 1024, 1024};

// What a user does: moves the mouse over the view, and steps through the views.
void give_input(MainWindow& window, int number) {
  ViewCanvas* canvas = window.panels().canvas;
  const PixelIndex pixel{number % 500, (number * 7) % 500};
  QTest::mouseMove(canvas, canvas->positionOf(pixel).toPoint());
  if (number % 3 == 0) window.session().set_view({4, number % 9});
  if (number % 5 == 0) window.session().set_cross_hair(pixel);
}

double percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

// Ages of events when the window came to handle them, in ms, until `has_ended`; every fourth of
// them gives an input.
std::vector<double> latencies(MainWindow& window, const std::function<void(int)>& input,
                              const std::function<bool()>& has_ended) {
  std::vector<double> ages;
  std::atomic<bool> ends{false};
  std::jthread clock([&] {
    for (int number = 0; !ends; ++number) {
      QMetaObject::invokeMethod(
          &window,
          [&, number, posted = Clock::now()] {
            ages.push_back(Milliseconds(Clock::now() - posted).count());
            if (number % kInputsPerEvent == 0) input(number / kInputsPerEvent);
          },
          Qt::QueuedConnection);
      std::this_thread::sleep_for(kInterval);
    }
  });
  [&] { QTRY_VERIFY_WITH_TIMEOUT(has_ended(), kScenePatience); }();
  ends = true;
  clock.join();
  QCoreApplication::processEvents();  // the last of them still refer to `ages`
  return ages;
}

std::vector<double> latencies_during_run(MainWindow& window) {
  window.actions().find("estimate.run")->trigger();
  return latencies(
      window, [&](int number) { give_input(window, number); },
      [&] { return window.jobs().count() == 0; });
}

// What a user does with an overlay: other maps, other ranges, to and fro between A and B, the
// divider of a wipe, other views.
void change_overlay(MainWindow& window, int number) {
  using render::Quantity;
  constexpr std::array maps = {Quantity::Disparity, Quantity::SignedError, Quantity::Truth,
                               Quantity::AbsoluteError, Quantity::BadPixels};
  OverlayController& overlay = window.overlay();
  ViewCanvas* canvas = window.panels().canvas;
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
      window.compare().toggleMode(CompareMode::Wipe);
      break;
    case 6:
      emit canvas->wipeMoved(0.01 * (number % 100));
      break;
    default:
      window.session().set_view({1, number / 8 % 3 == 2 ? 0 : 1});
  }
}

QString told(const std::vector<double>& ms) {
  return QString("median %1 ms, 95 % %2 ms, 99 % %3 ms, longest %4 ms, %5 events")
      .arg(percentile(ms, 0.5), 0, 'f', 2)
      .arg(percentile(ms, 0.95), 0, 'f', 2)
      .arg(percentile(ms, 0.99), 0, 'f', 2)
      .arg(percentile(ms, 1), 0, 'f', 2)
      .arg(ms.size());
}

// The best of a few measurements: other programs on the machine may take the processor from the
// window for a while, but a window that blocks is late in all of them.
std::vector<double> measured_calmly(const char* what,
                                    const std::function<std::vector<double>()>& measure) {
  std::vector<double> best;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    std::vector<double> ms = measure();
    qInfo("%s: %s", what, qPrintable(told(ms)));
    if (best.empty() || percentile(ms, 0.95) < percentile(best, 0.95)) best = std::move(ms);
    if (percentile(best, 0.95) < kFrame) break;
  }
  return best;
}

// Results of the centre view that are off the truth by more and more.
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
    ViewCanvas* canvas = window_.panels().canvas;
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
    if (window_.segment().labeler().is_running()) ++moves_while_labeling_;
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

}  // namespace

class LatencyTest : public QObject {
  Q_OBJECT

 private slots:
  void window_answersWhileAMethodRuns();
  void overlays_areMadeWithoutHoldingTheWindowUp();
  void tiles_followInputWithinAFrame();
  void strokes_arePaintedWhileLabelsAreMade();
};

void LatencyTest::window_answersWhileAMethodRuns() {
  WindowFixture f;
  f.openScene("edge", {});  // 9×9 views of 512×512

  const auto ages =
      measured_calmly("event latency during EPI_L", [&] { return latencies_during_run(f.window); });

  QVERIFY2(ages.size() > 50, "the run was too short to measure");
  QVERIFY(!f.window.session().estimates().empty());
  QVERIFY2(percentile(ages, 0.95) < kFrame, qPrintable(told(ages)));
}

void LatencyTest::overlays_areMadeWithoutHoldingTheWindowUp() {
  constexpr int inputs = 160;
  WindowFixture f;
  f.window.resize(2560, 1440);
  f.openScene("edge", kLargeViews);
  add_results(f.window.session(), 2);
  QTRY_VERIFY_WITH_TIMEOUT(!f.window.overlay().picture().isNull(), kScenePatience);

  const auto ages = measured_calmly("event latency while overlays of 1024x1024 change", [&] {
    int given = 0;
    return latencies(
        f.window, [&](int number) { change_overlay(f.window, given = number); },
        [&] { return given >= inputs; });
  });

  QVERIFY2(percentile(ages, 0.95) < kFrame, qPrintable(told(ages)));
}

void LatencyTest::tiles_followInputWithinAFrame() {
  WindowFixture f;
  f.openScene("edge", {});
  add_results(f.window.session(), 10);
  TileWall* wall = f.window.panels().wall;
  f.window.compare().setMode(CompareMode::Wall);
  QTRY_COMPARE_WITH_TIMEOUT(wall->count(), 12, kScenePatience);

  const auto ms = measured_calmly("12 tiles of 512x512 pixels", [&] {
    std::vector<double> frames;
    for (int number = 0; number < 200; ++number) {
      const auto begin = Clock::now();
      give_tile_input(wall->tile(number % 12), f.window.session(), number);
      QCoreApplication::processEvents();  // paints all tiles
      frames.push_back(Milliseconds(Clock::now() - begin).count());
    }
    return frames;
  });

  QVERIFY2(percentile(ms, 0.95) < kFrame, qPrintable(told(ms)));
}

void LatencyTest::strokes_arePaintedWhileLabelsAreMade() {
  constexpr int moves = 300;
  WindowFixture f;
  f.openScene("objects", kLargeViews);
  QTRY_VERIFY_WITH_TIMEOUT(f.window.segment().labeler().has_input(), kScenePatience);
  f.window.actions().find("annotate.mode")->trigger();
  f.window.actions().find("segment.live")->trigger();
  const LiveLabeler& labeler = f.window.segment().labeler();
  QTRY_VERIFY_WITH_TIMEOUT(labeler.labeling(f.window.session().view()), kScenePatience);
  const std::uint64_t state = f.window.document().document()->state();

  double share = 0;
  const auto ages = measured_calmly("event latency while a live labeling runs", [&] {
    Painter painter(f.window);
    auto measured = latencies(
        f.window, [&](int number) { painter.move(number); },
        [&] { return painter.moves() >= moves; });
    share = painter.shareWhileLabeling();
    return measured;
  });

  QVERIFY(f.window.document().document()->state() != state);
  QVERIFY2(share > 0.9, qPrintable(QString("labels were made for %1 of the time").arg(share)));
  QVERIFY2(percentile(ages, 0.95) < kFrame, qPrintable(told(ages)));
}

}  // namespace episcope::in_latency_test

EPISCOPE_WINDOW_TEST(latency_test, LatencyTest)
#include "latency_test.moc"
