// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/compare/picture_export.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/labels.h"
#include "widgets/controls/message_bar.h"
#include "widgets/panels/color_bar.h"
#include "widgets/panels/overlay_bar.h"

#include <QAction>
#include <QClipboard>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFile>
#include <QGuiApplication>
#include <QLabel>
#include <QMenu>
#include <QScrollBar>
#include <QSlider>
#include <QTabBar>
#include <QTabWidget>
#include <QTableWidget>
#include <QToolBar>

namespace episcope::in_window_overlay_test {

namespace {

// Chooses a map in the list of the tool bar.
void choose_map(MainWindow& window, const QString& text) {
  auto* maps = window.findChild<QToolBar*>()->findChild<QComboBox*>("overlay.quantity");
  QVERIFY(maps && maps->isVisible());
  const int place = maps->findText(text, Qt::MatchStartsWith);
  QVERIFY2(place >= 0, qPrintable(text));
  maps->setCurrentIndex(place);
  emit maps->activated(place);
}

QStringList texts_of(const QComboBox& list) {
  QStringList texts;
  for (int i = 0; i < list.count(); ++i) texts << list.itemText(i);
  return texts;
}

}  // namespace

class OverlayTest : public QObject {
  Q_OBJECT

 private slots:
  void errorOverlay_isOneClickAway();
  void maps_areThoseThatExist_andAllListsAgree();
  void difference_isOneOfTheMaps();
  void badPixels_haveTwoSwatchesWithTheThreshold();
  void rangeOfASignedMap_hasZeroInTheMiddle();
  void colorsOfErrors_areThoseOfTheLegend();
  void view_isGreyUnderMapsUntilColorIsAskedFor();
  void heldTab_flips();
  void labels_haveNoStatistics();
  void listOfMaps_isAsWideForEveryLightField();
  void hugeTruth_leavesTheLayoutAlone();
  void savedPicture_isTheShownOne();
  void failedExport_isTold();
  void copiedMetrics_areTold();
  void compareTab_showsTheMainMetricsWithoutScrolling();
};

void OverlayTest::errorOverlay_isOneClickAway() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  QTRY_VERIFY_WITH_TIMEOUT(!f.window.bench().overlay.picture().isNull(), kPatience);
  const QImage before = f.window.bench().overlay.picture();
  const QImage canvas_before = f.window.bench().viewer_area.canvas()->grab().toImage();

  f.trigger("tab.compare");
  f.click("button.overlay.error");

  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().overlay.picture() != before, kPatience);
  QVERIFY(f.window.bench().viewer_area.canvas()->grab().toImage() != canvas_before);
  QVERIFY(f.window.bench().commands.find("overlay.error")->isChecked());
}

void OverlayTest::maps_areThoseThatExist_andAllListsAgree() {
  WindowFixture f;
  f.openSmall();
  f.trigger("overlay.none");
  const auto& maps = find<QComboBox>(*f.window.bench().viewer_area.overlayBar());
  const auto* menu = f.window.findChild<QMenu*>("menu.View › Map");
  const auto entries = [menu] {
    QStringList texts;
    for (const QAction* action : menu->actions()) {
      const bool is_map = action->actionGroup() && action->isVisible();
      if (is_map) texts << action->text();
    }
    return texts;
  };
  QCOMPARE(texts_of(maps), (QStringList{"None", "Ground truth", "Labels", "Edges"}));
  QCOMPARE(entries(), texts_of(maps));

  f.runAndWait();
  QVERIFY(texts_of(maps).contains("Error"));
  QVERIFY(!texts_of(maps).contains("Layers"));
  QCOMPARE(entries(), texts_of(maps));

  f.trigger("tab.compare");
  f.click("button.overlay.bad_pixels");
  QCOMPARE(maps.currentText(), QString("Bad pixels"));
  QVERIFY(f.window.bench().commands.find("overlay.bad_pixels")->isChecked());
  f.trigger("tab.annotate");
  f.click("button.segment.edges");
  QCOMPARE(maps.currentText(), QString("Edges"));
  choose_map(f.window, "Disp");
  QVERIFY(f.window.bench().commands.find("overlay.disparity")->isChecked());
  QVERIFY(!f.window.bench().commands.find("segment.edges")->isChecked());
}

void OverlayTest::difference_isOneOfTheMaps() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  const auto& maps = find<QComboBox>(*f.window.bench().viewer_area.overlayBar());
  QVERIFY(!texts_of(maps).contains("Difference"));
  f.runAndWait();
  f.window.bench().session.compare_with(f.window.bench().session.estimates().front().id);
  f.trigger("compare.wipe");

  choose_map(f.window, "Diff");  // of the view alone

  QVERIFY(f.window.bench().overlay.showsDifference());
  QVERIFY(!f.window.bench().commands.find("compare.wipe")->isChecked());
  QVERIFY(f.window.bench().commands.find("compare.difference")->isChecked());
  QVERIFY(!f.window.bench().commands.find("overlay.disparity")->isChecked());
  choose_map(f.window, "Disp");
  QVERIFY(!f.window.bench().overlay.showsDifference());
}

void OverlayTest::badPixels_haveTwoSwatchesWithTheThreshold() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  f.trigger("overlay.bad_pixels");
  const Overlay& overlay = f.window.bench().overlay;
  QTRY_VERIFY_WITH_TIMEOUT(overlay.isUpToDate() && !overlay.picture().isNull(), kPatience);

  const auto* swatches = f.window.findChild<QLabel*>("colorBar.swatches");
  QVERIFY(swatches->isVisible() && !f.window.findChild<ColorRamp*>()->isVisible());
  QVERIFY2(swatches->text().contains("≤ 0.07 px") && swatches->text().contains("&gt; 0.07 px"),
           qPrintable(swatches->text()));
  const QImage picture = overlay.picture();
  for (int y = 20; y < picture.height() - 20; ++y) {
    const QString color = picture.pixelColor(picture.width() / 2, y).name();
    QVERIFY2(swatches->text().contains(color), qPrintable(color));
  }
  f.window.bench().session.set_bad_threshold(0.2);
  QTRY_VERIFY(swatches->text().contains("0.20 px"));

  f.trigger("overlay.error");
  QVERIFY(!swatches->isVisible() && f.window.findChild<ColorRamp*>()->isVisible());
}

void OverlayTest::rangeOfASignedMap_hasZeroInTheMiddle() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  choose_map(f.window, "Error");
  auto* most = f.window.bench().viewer_area.colorBar()->findChild<QDoubleSpinBox*>("colorBar.max");
  QVERIFY(most);

  most->setValue(0.75);

  const Interval range = f.window.bench().overlay.shadingOf(render::Quantity::SignedError).range;
  QCOMPARE(range.max, 0.75);
  QCOMPARE(range.min, -0.75);
}

void OverlayTest::colorsOfErrors_areThoseOfTheLegend() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  choose_map(f.window, "Error");
  const Overlay& overlay = f.window.bench().overlay;
  QTRY_VERIFY_WITH_TIMEOUT(overlay.isUpToDate() && overlay.map(), kPatience);
  auto* canvas = f.window.bench().viewer_area.canvas();
  canvas->setCrossHair(std::nullopt);
  const QImage shown = canvas->grab().toImage();
  ColorRamp legend;  // as the one in the window, but with room for every color
  legend.setShading(f.window.findChild<ColorRamp*>()->shading());
  const Interval range = legend.shading().range;
  const int length = 2 * static_cast<int>(legend.shading().map.colors.size());
  legend.resize(length + 1, 16);
  const QImage ramp = legend.grab().toImage();

  int compared = 0;
  for (int i = 30; i < 66; ++i) {
    const auto error = overlay.valueAt({i, i});
    if (!error || std::abs(*error) >= range.max) continue;  // the ends lie under the frame
    const QRgb color = shown.pixel(f.at({i, i}));
    const int place = static_cast<int>((*error - range.min) / range.length() * length);
    bool is_there = false;
    for (int x = place - 2; x <= place + 2; ++x) is_there |= ramp.pixel(x, 8) == color;
    QVERIFY2(is_there, qPrintable(QString("%1 px is %2").arg(*error).arg(color, 0, 16)));
    ++compared;
  }
  QVERIFY(compared > 10);
}

void OverlayTest::view_isGreyUnderMapsUntilColorIsAskedFor() {
  WindowFixture f;
  f.openSmall();
  auto* canvas = f.window.bench().viewer_area.canvas();
  canvas->setCrossHair(std::nullopt);
  const PixelIndex pixel{20, 70};
  const QColor view = canvas->picture().pixelColor(pixel.x, pixel.y);
  const auto shown = [&] { return canvas->grab().toImage().pixelColor(f.at(pixel)); };
  f.window.findChild<QSlider*>("overlay.opacity")->setValue(0);

  choose_map(f.window, "Labels");
  QTRY_VERIFY_WITH_TIMEOUT(!f.window.bench().overlay.picture().isNull(), kPatience);
  const int grey = qGray(view.rgb());
  QVERIFY(view != QColor(grey, grey, grey));
  QCOMPARE(shown(), QColor(grey, grey, grey));
  f.trigger("annotate.drawing");  // contours cover nothing
  QTRY_COMPARE(shown(), view);
  choose_map(f.window, "Ground");
  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().overlay.isUpToDate(), kPatience);
  QCOMPARE(shown(), QColor(grey, grey, grey));
  save_picture(f.window.bench(), f.path("truth.png"));
  QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(f.path("truth.png")), kPatience);
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 0, kPatience);
  QCOMPARE(QImage(f.path("truth.png")).pixelColor(pixel.x, pixel.y), QColor(grey, grey, grey));

  f.click("button.overlay.color");

  QCOMPARE(shown(), view);
}

void OverlayTest::heldTab_flips() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  auto* canvas = f.window.bench().viewer_area.canvas();
  canvas->setFocus();
  QTRY_VERIFY_WITH_TIMEOUT(!f.window.bench().overlay.picture().isNull(), kPatience);
  const QImage before = f.window.bench().overlay.picture();

  QTest::keyPress(canvas, Qt::Key_Tab);
  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().overlay.picture() != before, kPatience);
  QTest::keyRelease(canvas, Qt::Key_Tab);

  QCOMPARE(f.window.bench().overlay.picture(), before);
}

void OverlayTest::hugeTruth_leavesTheLayoutAlone() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  const int width = f.window.bench().viewer_area.canvas()->width();
  auto scene = std::make_shared<Scene>(
      scenes::render_builtin("edge", WindowFixture::smallOptions(), Progress()));
  auto truth = std::make_shared<GroundTruth>();
  truth->field.disparity = scene->truth->field.disparity.clone();
  truth->field.disparity.view({4, 4}).at(0, 0) = 1e30F;
  scene->truth = truth;

  f.window.bench().session.open(scene, "edge");
  f.window.bench().overlay.setQuantity(render::Quantity::Truth);
  f.trigger("tab.compare");

  const auto* focus = f.window.findChild<QDoubleSpinBox*>("overlay.focusSpin");
  QVERIFY(focus->maximum() <= 100);
  const auto* max = f.window.findChild<QLabel*>("statistics.max");
  QTRY_VERIFY2_WITH_TIMEOUT(max->text().startsWith("1e"), qPrintable(max->text()), kPatience);
  QCOMPARE(f.window.bench().viewer_area.canvas()->width(), width);
}

void OverlayTest::savedPicture_isTheShownOne() {
  WindowFixture f;
  f.openSmall();

  save_picture(f.window.bench(), f.path("view.png"));
  QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(f.path("view.png")), kPatience);
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 0, kPatience);

  const QImage saved = QImage(f.path("view.png")).convertToFormat(QImage::Format_RGB888);
  QCOMPARE(saved,
           f.window.bench().viewer_area.canvas()->picture().convertToFormat(QImage::Format_RGB888));
}

void OverlayTest::failedExport_isTold() {
  WindowFixture f;
  f.openSmall();
  const QString path = f.path("no/such/folder/view.png");

  save_picture(f.window.bench(), path);

  const MessageBar* messages = f.window.findChild<MessageBar*>("messageBar");
  QTRY_VERIFY2_WITH_TIMEOUT(messages->text().contains(path), qPrintable(messages->text()),
                            kPatience);
  QCOMPARE(messages->severity(), Severity::Error);
}

void OverlayTest::copiedMetrics_areTold() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  f.trigger("tab.compare");

  f.click("metrics.copyLatex");

  const QString text = f.window.findChild<MessageBar*>("messageBar")->text();
  QVERIFY2(text.contains("Copied") && text.contains("LaTeX"), qPrintable(text));
  QVERIFY(QGuiApplication::clipboard()->text().startsWith("\\begin{tabular}"));
}

void OverlayTest::compareTab_showsTheMainMetricsWithoutScrolling() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  f.trigger("tab.compare");
  const auto* table = f.window.findChild<QTableWidget*>("metrics.table");
  QTRY_VERIFY_WITH_TIMEOUT(table->isVisible() &&
                               table->columnCount() > 7 &&  // scored in the background
                               table->horizontalHeaderItem(2)->text() == "2016\nMSE×100",
                           kPatience);

  const QStringList wanted = {"Result",        "2013\nMSE×100", "2016\nMSE×100", "2016\nbad .07",
                              "2016\nbad .03", "2016\nbad .01", "2016\nQ25"};
  for (int column = 0; column < wanted.size(); ++column) {
    QCOMPARE(table->horizontalHeaderItem(column)->text(), wanted[column]);
    QVERIFY(!table->horizontalHeaderItem(column)->toolTip().isEmpty());
  }
  QVERIFY(table->isColumnHidden(6));  // until it is chosen
  const int end = table->columnViewportPosition(5) + table->columnWidth(5);
  QVERIFY2(end <= table->viewport()->width(),
           qPrintable(QString("%1 > %2").arg(end).arg(table->viewport()->width())));
  QCOMPARE(table->horizontalScrollBar()->maximum(), 0);
}

void OverlayTest::labels_haveNoStatistics() {
  WindowFixture f;
  f.openSmall();
  f.trigger("tab.compare");
  const auto* title = f.window.findChild<ElidedLabel*>("statistics.title");

  choose_map(f.window, "Labels");

  QTRY_COMPARE_WITH_TIMEOUT(title->fullText(), QString("Labels have no statistics"), kPatience);
}

// The focus beside it once moved.
void OverlayTest::listOfMaps_isAsWideForEveryLightField() {
  WindowFixture f;
  const auto* maps = f.window.findChild<QComboBox*>("overlay.quantity");
  const auto* focus = f.window.findChild<QDoubleSpinBox*>("overlay.focusSpin");
  f.openSmall();
  const int width = maps->width();
  const int place = focus->mapTo(&f.window, QPoint()).x();

  f.runAndWait();

  QTRY_VERIFY(maps->count() > 4);
  QCOMPARE(maps->width(), width);
  QCOMPARE(focus->mapTo(&f.window, QPoint()).x(), place);
}

}  // namespace episcope::in_window_overlay_test

EPISCOPE_WINDOW_TEST(window_overlay_test, OverlayTest)
#include "window_overlay_test.moc"
