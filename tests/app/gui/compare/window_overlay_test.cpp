// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/compare/picture_export.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/message_bar.h"
#include "widgets/panels/color_bar.h"

#include <QAction>
#include <QClipboard>
#include <QDoubleSpinBox>
#include <QFile>
#include <QGuiApplication>
#include <QLabel>
#include <QSlider>
#include <QTabBar>
#include <QTabWidget>
#include <QTableWidget>
#include <QToolBar>

namespace episcope::in_window_overlay_test {

namespace {

void click_action(MainWindow& window, const QString& id) {
  QWidget* button =
      window.findChild<QToolBar*>()->widgetForAction(window.bench().commands.find(id));
  QVERIFY2(button && button->isEnabled(), qPrintable(id));
  QTest::mouseClick(button, Qt::LeftButton);
}

}  // namespace

class OverlayTest : public QObject {
  Q_OBJECT

 private slots:
  void errorOverlay_isOneClickAway();
  void rangeOfASignedMap_hasZeroInTheMiddle();
  void colorsOfErrors_areThoseOfTheLegend();
  void view_isGreyUnderNumbersUntilColorIsAskedFor();
  void heldTab_flips();
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

  click_action(f.window, "overlay.error");

  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().overlay.picture() != before, kPatience);
  QVERIFY(f.window.bench().viewer_area.canvas()->grab().toImage() != canvas_before);
  QVERIFY(f.window.bench().commands.find("overlay.error")->isChecked());
}

void OverlayTest::rangeOfASignedMap_hasZeroInTheMiddle() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  click_action(f.window, "overlay.error");
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
  click_action(f.window, "overlay.error");
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

void OverlayTest::view_isGreyUnderNumbersUntilColorIsAskedFor() {
  WindowFixture f;
  f.openSmall();
  auto* canvas = f.window.bench().viewer_area.canvas();
  canvas->setCrossHair(std::nullopt);
  const PixelIndex pixel{20, 70};
  const QColor view = canvas->picture().pixelColor(pixel.x, pixel.y);
  const auto shown = [&] { return canvas->grab().toImage().pixelColor(f.at(pixel)); };
  f.window.findChild<QSlider*>("overlay.opacity")->setValue(0);

  click_action(f.window, "overlay.labels");
  QTRY_VERIFY_WITH_TIMEOUT(!f.window.bench().overlay.picture().isNull(), kPatience);
  QCOMPARE(shown(), view);
  click_action(f.window, "overlay.truth");
  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().overlay.isUpToDate(), kPatience);
  const int grey = qGray(view.rgb());
  QVERIFY(view != QColor(grey, grey, grey));
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
  const int end = table->columnViewportPosition(6) + table->columnWidth(6);
  QVERIFY2(end <= table->viewport()->width(),
           qPrintable(QString("%1 > %2").arg(end).arg(table->viewport()->width())));
}

}  // namespace episcope::in_window_overlay_test

EPISCOPE_WINDOW_TEST(window_overlay_test, OverlayTest)
#include "window_overlay_test.moc"
