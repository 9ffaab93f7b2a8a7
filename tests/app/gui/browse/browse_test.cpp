// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/browse/info_controller.h"
#include "engine/io/formats/write_scene.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/epi_pane.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/theme.h"
#include "widgets/panels/value_bar.h"
#include "widgets/panels/view_grid.h"

#include <QContextMenuEvent>
#include <QDir>
#include <QLabel>
#include <QMenu>
#include <QSlider>
#include <QWheelEvent>

#include <atomic>
#include <cmath>
#include <future>
#include <thread>

namespace episcope::in_browse_test {

namespace {

constexpr int kSliderStepsPerPx = 100;

void click_pixel(ViewCanvas* canvas, PixelIndex pixel, Qt::KeyboardModifiers keys = {}) {
  QTest::mouseClick(canvas, Qt::LeftButton, keys, canvas->positionOf(pixel).toPoint());
}

}  // namespace

class BrowseTest : public QObject {
  Q_OBJECT

 private slots:
  void arrows_changeTheView();
  void click_movesTheCrossHairAndTheEpis();
  void shiftClick_focusesAtThePixel();
  void withoutEstimate_sliderAndShiftClickKnowTheRange();
  void rightClick_opensAMenuForThePixel();
  void valuesAtTheCursor_areRead();
  void samples_areSaidInShort_andInFullBehindTheArrow();
  void gpu_isAskedForOnAWorker();
  void measuredLine_belongsToItsRow();
  void viewsWithStrokesOfTheFile_areMarked();
  void wheelWithAltOrCtrl_movesTheFocusPlane_data();
  void wheelWithAltOrCtrl_movesTheFocusPlane();
};

void BrowseTest::rightClick_opensAMenuForThePixel() {
  WindowFixture f;
  f.openSmall();
  const auto menu_of = [&f](QWidget* widget, QPoint at) {
    QContextMenuEvent event(QContextMenuEvent::Mouse, at, widget->mapToGlobal(at));
    QCoreApplication::sendEvent(widget, &event);
    return f.window.findChild<QMenu*>("view.menu");
  };
  const auto menu_at = [&](PixelIndex pixel) {
    return menu_of(f.canvas(), f.canvas()->positionOf(pixel).toPoint());
  };
  const auto close = [&f](QMenu* menu) {
    QVERIFY(menu);
    menu->close();
    QTRY_VERIFY(!f.window.findChild<QMenu*>("view.menu"));
  };

  QMenu* menu = menu_at({20, 30});
  QVERIFY(menu && menu->isVisible());
  QStringList ids;
  for (const QAction* action : menu->actions()) ids << action->objectName();
  for (const char* id :
       {"view.menu.focus", "view.menu.measure", "view.center", "view.tone", "file.save_picture"}) {
    QVERIFY2(ids.contains(id), id);
  }
  menu->findChild<QAction*>("view.menu.measure")->trigger();
  QCOMPARE(f.window.bench().session.cross_hair(), (PixelIndex{20, 30}));
  QCOMPARE(f.window.bench().frame.shownTab(), QString("measure"));
  close(menu);
  EpiPane* epi = f.window.bench().viewer_area.horizontalEpi();
  menu = menu_of(epi, epi->positionOf(40.5, 1).toPoint());
  QVERIFY(menu);
  menu->findChild<QAction*>("view.menu.measure")->trigger();
  QCOMPARE(f.window.bench().session.cross_hair(), (PixelIndex{20, 40}));
  close(menu);
  f.trigger("compare.tiles");
  QTRY_VERIFY(!f.window.bench().viewer_area.activeCanvas()->picture().isNull());
  close(menu_of(f.window.bench().viewer_area.activeCanvas(), {60, 60}));
  f.trigger("compare.tiles");

  f.trigger("annotate.mode");  // the right button erases there
  QVERIFY(!menu_at({20, 30}));
}

void BrowseTest::viewsWithStrokesOfTheFile_areMarked() {
  WindowFixture f;
  f.openSmall("objects");
  const ViewIndex painted = f.document().scribbles().painted_views().at(0);
  auto& cells = find<ViewGridCells>(f.window);
  const auto corner_of = [&cells](ViewIndex view) {
    const QPoint corner = cells.cellRect(view).topRight().toPoint() + QPoint(-4, 2);
    return cells.grab().toImage().pixelColor(corner);
  };

  QCOMPARE(corner_of(painted), theme::kPainted);
  QVERIFY(corner_of({painted.v, painted.u - 1}) != theme::kPainted);
}

void BrowseTest::samples_areSaidInShort_andInFullBehindTheArrow() {
  WindowFixture f;
  f.openSmall();

  const auto* samples = f.window.findChild<QLabel*>("info.samples");

  QCOMPARE(samples->text().remove(QChar(0x200b)), QString("RGB, 8 bit"));
  const auto* full = f.window.findChild<QLabel*>("info.tip");
  QVERIFY(!full->isVisible());
  f.click("info.more.samples");
  QVERIFY(full->isVisible());
  QVERIFY2(full->text().contains("value/255"), qPrintable(full->text()));
}

// The question may take a second: the window is there meanwhile, and fills the row in later.
void BrowseTest::gpu_isAskedForOnAWorker() {
  WindowFixture f;
  std::promise<void> answered;
  std::atomic<std::thread::id> asked_on;
  find<InfoController>(f.window).setGpuQuestion([&asked_on, wait = answered.get_future().share()] {
    asked_on = std::this_thread::get_id();
    wait.wait();
    CudaDevice device;
    device.is_available = true;
    device.name = "a GPU";
    return device;
  });
  const auto row = [&f] { return f.window.findChild<QLabel*>("info.gpu")->text(); };

  f.openSmall();

  QVERIFY2(row().contains("searching"), qPrintable(row()));
  answered.set_value();
  QTRY_VERIFY2_WITH_TIMEOUT(row().contains("a GPU"), qPrintable(row()), kPatience);
  QVERIFY(asked_on.load() != std::this_thread::get_id());
}

void BrowseTest::measuredLine_belongsToItsRow() {
  WindowFixture f;
  f.openSmall();
  auto* epi = f.window.bench().viewer_area.horizontalEpi();
  const QPoint middle = epi->rect().center();
  QTest::mousePress(epi, Qt::LeftButton, {}, middle - QPoint(10, 20));
  QTest::mouseMove(epi, middle + QPoint(10, 20));
  QTest::mouseRelease(epi, Qt::LeftButton, {}, middle + QPoint(10, 20));
  QVERIFY(epi->measuredDisparity());

  click_pixel(f.canvas(), {f.window.bench().session.cross_hair().y, 20});
  QCoreApplication::processEvents();
  QVERIFY(epi->measuredDisparity());
  click_pixel(f.canvas(), {20, 20});

  QTRY_VERIFY(!epi->measuredDisparity());
}

void BrowseTest::wheelWithAltOrCtrl_movesTheFocusPlane_data() {
  QTest::addColumn<Qt::KeyboardModifier>("held");
  QTest::newRow("Alt") << Qt::AltModifier;
  QTest::newRow("Ctrl") << Qt::ControlModifier;
}

void BrowseTest::wheelWithAltOrCtrl_movesTheFocusPlane() {
  QFETCH(Qt::KeyboardModifier, held);
  WindowFixture f;
  f.openSmall();
  const QPointF at = f.canvas()->rect().center();
  QWheelEvent wheel(at, f.canvas()->mapToGlobal(at), {}, {0, 120}, Qt::NoButton, held,
                    Qt::NoScrollPhase, false);

  QCoreApplication::sendEvent(f.canvas(), &wheel);

  QVERIFY(f.window.bench().session.focus_px() > 0);
}

void BrowseTest::arrows_changeTheView() {
  WindowFixture f;
  f.openSmall();
  auto* canvas = f.window.bench().viewer_area.canvas();
  const Session& session = f.window.bench().session;
  canvas->setFocus();
  f.window.activateWindow();
  QTRY_VERIFY_WITH_TIMEOUT(canvas->hasFocus(), kPatience);
  const QImage before = canvas->picture();

  QTest::keyClick(canvas, Qt::Key_Right);
  QVERIFY(session.view() == (ViewIndex{4, 5}));
  QTest::keyClick(canvas, Qt::Key_Up);
  QVERIFY(session.view() == (ViewIndex{3, 5}));
  QTRY_VERIFY_WITH_TIMEOUT(canvas->picture() != before, kPatience);
  QTest::keyClick(canvas, Qt::Key_Left, Qt::ShiftModifier);
  QVERIFY(session.view() == (ViewIndex{3, 0}));
  QTest::keyClick(canvas, Qt::Key_Home);

  QVERIFY(session.view() == (ViewIndex{4, 4}));
}

void BrowseTest::click_movesTheCrossHairAndTheEpis() {
  WindowFixture f;
  f.openSmall();
  auto* epi = f.window.bench().viewer_area.horizontalEpi();
  const QImage before = epi->grab().toImage();

  click_pixel(f.window.bench().viewer_area.canvas(), {20, 33});

  QVERIFY(f.window.bench().session.cross_hair() == (PixelIndex{20, 33}));
  QTRY_VERIFY_WITH_TIMEOUT(epi->grab().toImage() != before, kPatience);
}

void BrowseTest::shiftClick_focusesAtThePixel() {
  WindowFixture f;
  f.openSmall();
  const double truth =
      f.window.bench().session.scene()->truth->field.view({4, 4}).disparity.at(20, 33);

  click_pixel(f.window.bench().viewer_area.canvas(), {20, 33}, Qt::ShiftModifier);

  QCOMPARE(f.window.bench().session.focus_px(), truth);
}

void BrowseTest::withoutEstimate_sliderAndShiftClickKnowTheRange() {
  scenes::RenderOptions options;
  options.height = options.width = 160;
  Scene scene = scenes::render_builtin("objects", options, Progress());
  const GroundTruthPtr truth = scene.truth;
  scene.truth = std::make_shared<GroundTruth>();
  LightFieldInfo info;
  info.name = "plain";
  scene.light_field = std::make_shared<const LightField>(
      std::get<ViewStack<std::uint8_t>>(scene.light_field->samples()).clone(), info);
  WindowFixture f;
  QDir().mkpath(f.path("plain"));
  io::write_archive(f.path("plain/lf.h5").toStdString(), scene, Progress());
  f.window.bench().opener.open(f.path("plain/lf.h5"));
  const auto* slider = f.window.findChild<QSlider*>("overlay.focusSlider");

  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().session.scene(), kScenePatience);
  QCoreApplication::processEvents();  // the session tells the window of its scene one turn later
  QTRY_VERIFY_WITH_TIMEOUT(slider->maximum() < 10 * kSliderStepsPerPx, kScenePatience);
  click_pixel(f.canvas(), {80, 80}, Qt::ShiftModifier);

  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().session.focus_px() != 0, kScenePatience);
  const double found = f.window.bench().session.focus_px();
  QVERIFY2(std::abs(found - truth->field.view({4, 4}).disparity.at(80, 80)) < 0.2,
           qPrintable(QString::number(found)));
}

void BrowseTest::valuesAtTheCursor_areRead() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  auto* canvas = f.window.bench().viewer_area.canvas();

  QTest::mouseMove(canvas, canvas->positionOf({20, 33}).toPoint());

  const auto text = [&f] { return f.window.findChild<ValueBar*>()->text(); };
  QTRY_VERIFY2_WITH_TIMEOUT(text().contains("x 33 y 20"), qPrintable(text()), kPatience);
  QVERIFY2(text().contains("truth") && text().contains("EPI_L"), qPrintable(text()));

  // While another light field is read, these values are of none that is seen.
  ViewerArea& area = f.window.bench().viewer_area;
  area.showPreview(QImage(8, 8, QImage::Format_RGB32), "another");
  QTest::mouseMove(canvas, canvas->positionOf({3, 3}).toPoint());
  QVERIFY2(!text().contains("truth") && !text().contains("EPI_L"), qPrintable(text()));
  area.endPreview();
  QTRY_VERIFY2_WITH_TIMEOUT(text().contains("EPI_L"), qPrintable(text()), kPatience);
}

}  // namespace episcope::in_browse_test

EPISCOPE_WINDOW_TEST(browse_test, BrowseTest)
#include "browse_test.moc"
