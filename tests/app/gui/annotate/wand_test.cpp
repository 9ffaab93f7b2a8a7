// SPDX-License-Identifier: BSD-3-Clause
// The wand on the window that ships: one click paints a region in all views.
#include "app/gui/annotate/wand.h"
#include "app/gui/annotate/annotate_controller.h"
#include "app/gui/scene/scene_opener.h"
#include "engine/io/formats/write_scene.h"
#include "tests/app/gui/annotating.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/canvas_tool.h"
#include "widgets/controls/message_bar.h"

#include <QDir>
#include <QDoubleSpinBox>

#include <cmath>

namespace episcope::in_wand_test {

namespace {

constexpr PixelIndex kOnAnObject{60, 25};

class Waving : public Annotating {
 public:
  Waving() : Annotating("objects") {
    // The scene brings strokes along, which fills go around.
    window.bench().document.edit([](AnnotationDocument& document) {
      while (!document.labels().labels().empty()) {
        document.remove_label(document.labels().labels().front().id);
      }
      document.add_label();
    });
  }

  [[nodiscard]] Wand& wand() { return *window.findChild<Wand*>(); }
  [[nodiscard]] FillTool& tool() { return *window.findChild<FillTool*>(); }
  /// Chooses the wand by its key and waits until it is ready.
  void wave() {
    key(Qt::Key_F, Qt::ShiftModifier);
    QTRY_VERIFY_WITH_TIMEOUT(wand().prepare() == Wand::State::Ready, kPatience);
  }
  void click(PixelIndex pixel, Qt::MouseButton button = Qt::LeftButton) {
    press(pixel, button);
    release(pixel, button);
  }
  [[nodiscard]] std::size_t paintedViews() { return document().scribbles().painted_views().size(); }
  /// Share of painted pixels of a view that truly have the label of kOnAnObject.
  [[nodiscard]] double precision(ViewIndex view) {
    const auto painted = document().scribbles().view(view);
    const auto& labels = window.bench().session.scene()->truth->labels;
    const std::int32_t label = labels.view(kCenter).at(kOnAnObject.y, kOnAnObject.x);
    int right = 0, all = 0;
    for (std::size_t i = 0; i < painted.size(); ++i) {
      if (painted.data[i] == 0) continue;
      right += labels.view(view).data[i] == label;
      ++all;
    }
    return static_cast<double>(right) / std::max(all, 1);
  }
};

}  // namespace

class WandTest : public QObject {
  Q_OBJECT

 private slots:
  void click_paintsTheRegionInAllViews_asOneStep();
  void region_isShownUnderTheCursor_andPaintedByReturn();
  void drag_changesTheTolerance_andEscapeTakesItBack();
  void rightButton_takesTheRegionAway();
  void strokesOfOtherLabels_arePaintedAround();
  void withoutDisparity_itIsEstimatedFirst();
};

void WandTest::click_paintsTheRegionInAllViews_asOneStep() {
  Waving f;
  f.wave();

  f.click(kOnAnObject);

  QCOMPARE(f.labelAt(kOnAnObject), f.window.bench().labels.current());
  QCOMPARE(f.paintedViews(), std::size_t{81});
  for (const ViewIndex view : {Waving::kCenter, ViewIndex{0, 0}, ViewIndex{8, 3}}) {
    const double share = f.precision(view);
    QVERIFY2(share > 0.95, qPrintable(QString::number(share)));
  }
  f.key(Qt::Key_Z, Qt::ControlModifier);
  QCOMPARE(f.paintedViews(), std::size_t{0});
}

void WandTest::region_isShownUnderTheCursor_andPaintedByReturn() {
  Waving f;
  f.wave();
  QVERIFY(!f.window.bench().commands.find("annotate.close_polygon")->isEnabled());

  f.move({59, 25});
  f.move(kOnAnObject);
  QTRY_VERIFY(!f.tool().preview().isNull());
  QCOMPARE(f.paintedViews(), std::size_t{0});
  f.key(Qt::Key_Return);

  QCOMPARE(f.labelAt(kOnAnObject), f.window.bench().labels.current());
  QCOMPARE(f.paintedViews(), std::size_t{81});
}

void WandTest::drag_changesTheTolerance_andEscapeTakesItBack() {
  Waving f;
  f.wave();
  const auto* tolerance = f.window.findChild<QDoubleSpinBox*>("fill.tolerance");
  const double before = tolerance->value();

  f.press({48, 20});
  f.move({48, 60});
  QVERIFY2(std::fabs(tolerance->value() / before - 2) < 0.1,
           qPrintable(QString::number(tolerance->value())));
  f.window.bench().cancels.cancel();
  f.release({48, 60});

  QCOMPARE(tolerance->value(), before);
  QCOMPARE(f.paintedViews(), std::size_t{0});
}

void WandTest::rightButton_takesTheRegionAway() {
  Waving f;
  f.wave();
  f.click(kOnAnObject);

  f.click(kOnAnObject, Qt::RightButton);

  QCOMPARE(f.paintedViews(), std::size_t{0});
}

void WandTest::strokesOfOtherLabels_arePaintedAround() {
  Waving f;
  const int first = f.window.bench().labels.current();
  f.drag({60, 23}, {60, 27});
  f.trigger("annotate.add_label");
  f.wave();

  f.click({52, 25});

  QCOMPARE(f.labelAt(kOnAnObject), first);
  QCOMPARE(f.labelAt({52, 25}), f.window.bench().labels.current());
}

void WandTest::withoutDisparity_itIsEstimatedFirst() {
  Waving f;
  Scene scene = *f.window.bench().session.scene();
  scene.truth = std::make_shared<const GroundTruth>();
  QDir().mkpath(f.path("plain"));
  io::write_archive(f.path("plain/lf.h5").toStdString(), scene, Progress(1));
  const auto generation = f.window.bench().session.generation();
  f.window.bench().opener.open(f.path("plain/lf.h5"));
  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().session.generation() > generation &&
                               f.window.bench().session.scene() &&
                               f.window.bench().document.document(),
                           kScenePatience);

  f.key(Qt::Key_F, Qt::ShiftModifier);

  QVERIFY2(f.window.findChild<MessageBar*>("messageBar")->text().contains("being estimated"),
           qPrintable(f.window.findChild<MessageBar*>("messageBar")->text()));
  QTRY_VERIFY_WITH_TIMEOUT(f.wand().prepare() == Wand::State::Ready, kScenePatience);
  f.click(kOnAnObject);
  QCOMPARE(f.paintedViews(), std::size_t{81});
}

}  // namespace episcope::in_wand_test

EPISCOPE_WINDOW_TEST(wand_test, WandTest)
#include "wand_test.moc"
