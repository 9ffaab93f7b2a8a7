// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/browse/measure_controller.h"
#include "app/gui/estimate/estimate_controller.h"
#include "app/session/project_file.h"
#include "app/session/project_store.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/epi_pane.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/panels/method_panel.h"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QLineEdit>
#include <QTreeWidget>

#include <algorithm>

// Lines measured in EPIs and kept, by mouse and keys on the window that ships.

namespace episcope::in_measure_test {

namespace {

class Measuring : public WindowFixture {
 public:
  Measuring() {
    window.resize(1280, 760);
    openSmall();
  }
  /// Draws a line through the middle of an EPI; steeper for a smaller `reach`.
  void draw(EpiPane* epi, int reach) {
    const QPoint middle = epi->rect().center();
    const bool is_horizontal = epi->orientation() == Qt::Horizontal;
    const QPoint end = is_horizontal ? QPoint(reach, 30) : QPoint(30, reach);
    QTest::mousePress(epi, Qt::LeftButton, {}, middle - end);
    QTest::mouseMove(epi, middle + end);
    QTest::mouseRelease(epi, Qt::LeftButton, {}, middle + end);
    QVERIFY(epi->measuredDisparity());
  }
  EpiPane* horizontal() { return window.bench().viewer_area.horizontalEpi(); }
  EpiPane* vertical() { return window.bench().viewer_area.verticalEpi(); }
  void keep() { key(Qt::Key_K, Qt::ControlModifier); }
  Session& session() { return window.bench().session; }
  const Measurements& measured() { return session().place().measured; }
  QTreeWidget& list() { return *window.findChild<QTreeWidget*>("measure.list"); }
  void clickRow(int row) {
    QTest::mouseClick(list().viewport(), Qt::LeftButton, {},
                      list().visualItemRect(list().topLevelItem(row)).center());
  }
  Interval range() {
    const ParameterSet values = find<MethodPanel>(window).request().values;
    const auto found = std::ranges::find(values, "range", &ParameterSet::value_type::first);
    const auto& range = std::get<IntervalOrAuto>(found->second);
    return range ? *range : Interval{};
  }
};

}  // namespace

class MeasureTest : public QObject {
  Q_OBJECT

 private slots:
  void keptLines_areListed_andGoneBackTo();
  void withoutALine_theKeySaysWhatToDo();
  void chosenLine_becomesTheFocusPlane_andEndsOfTheRange();
  void lines_areRenamedAndRemoved();
  void lines_areCopiedAsCsv();
  void lines_comeBackWithTheProject();
  void depth_isToldWhereTheCameraIsKnown();
  void end_movesTheOtherOnlyIfItMust();
};

void MeasureTest::keptLines_areListed_andGoneBackTo() {
  Measuring f;
  f.session().set_cross_hair({30, 50});
  QTRY_COMPARE(f.canvas()->crossHair()->y, 30);
  f.draw(f.horizontal(), 20);
  const double first = *f.horizontal()->measuredDisparity();
  f.keep();
  QCOMPARE(f.window.bench().frame.shownTab(), QString("measure"));
  f.session().set_cross_hair({60, 20});
  f.session().set_view({2, 3});
  QTRY_VERIFY(!f.horizontal()->measuredDisparity());
  f.draw(f.vertical(), -15);
  f.keep();

  QTRY_COMPARE(f.list().topLevelItemCount(), 2);
  QCOMPARE(f.measured().list[0].disparity_px, first);
  QVERIFY(f.measured().list[0].direction == EpiDirection::Horizontal);
  QVERIFY((f.measured().list[0].view == ViewIndex{4, 4}));
  QCOMPARE(f.measured().list[0].pixel.y, 30);
  QVERIFY(f.measured().list[1].direction == EpiDirection::Vertical);
  QVERIFY(f.list().topLevelItem(0)->text(3).contains("30"));
  f.clickRow(0);

  QTRY_VERIFY((f.view() == ViewIndex{4, 4}));
  QVERIFY(f.session().cross_hair() == f.measured().list[0].pixel);
  QTRY_VERIFY(f.horizontal()->measuredDisparity());
  QCOMPARE(*f.horizontal()->measuredDisparity(), first);
  QCOMPARE(f.horizontal()->measuredPixel().value(), f.measured().list[0].pixel.x);
  QVERIFY(!f.vertical()->measuredDisparity());
}

void MeasureTest::withoutALine_theKeySaysWhatToDo() {
  Measuring f;
  f.keep();
  QVERIFY(f.measured().list.empty());
  QVERIFY(!f.window.bench().commands.find("measure.focus")->isEnabled());
}

void MeasureTest::chosenLine_becomesTheFocusPlane_andEndsOfTheRange() {
  Measuring f;
  f.draw(f.horizontal(), 20);
  f.keep();
  const double lower = f.measured().list[0].disparity_px;
  f.trigger("measure.focus");
  QCOMPARE(f.session().focus_px(), lower);
  f.session().set_focus(0);
  f.draw(f.horizontal(), -20);
  f.keep();
  const double upper = f.measured().list[1].disparity_px;
  QVERIFY(lower < upper);

  QTRY_VERIFY(f.window.bench().commands.find("estimate.range_to")->isEnabled());
  f.click("button.estimate.range_to");
  QTRY_COMPARE(f.list().topLevelItemCount(), 2);
  f.clickRow(0);
  f.click("button.estimate.range_from");

  QVERIFY(f.range().min <= lower && f.range().min > lower - 0.011);
  QVERIFY(f.range().max >= upper && f.range().max < upper + 0.011);
}

void MeasureTest::lines_areRenamedAndRemoved() {
  Measuring f;
  f.window.activateWindow();
  QVERIFY(QTest::qWaitForWindowActive(&f.window));
  f.draw(f.horizontal(), 20);
  f.keep();
  f.keep();
  QTRY_COMPARE(f.list().topLevelItemCount(), 2);
  QVERIFY(f.measured().list[0].name != f.measured().list[1].name);

  f.clickRow(0);
  QTRY_COMPARE(f.measured().current, 0);
  f.click("button.measure.rename");
  QTRY_VERIFY(f.list().findChild<QLineEdit*>());
  auto* editor = f.list().findChild<QLineEdit*>();
  editor->setText("front edge");
  QTest::keyClick(editor, Qt::Key_Return);
  QTRY_COMPARE(f.measured().list[0].name, std::string("front edge"));

  f.clickRow(1);
  f.list().setFocus();
  QTest::keyClick(&f.list(), Qt::Key_Delete);
  QTRY_COMPARE(f.list().topLevelItemCount(), 1);
  QCOMPARE(f.list().topLevelItem(0)->text(0), QString("front edge"));
}

void MeasureTest::lines_areCopiedAsCsv() {
  Measuring f;
  f.draw(f.horizontal(), 20);
  f.keep();
  f.draw(f.vertical(), 12);
  f.keep();

  f.trigger("measure.copy");

  const QStringList lines = QGuiApplication::clipboard()->text().split('\n');
  QCOMPARE(lines[0], QString("name,direction,v,u,y,x,slope_px_per_view,disparity_px,depth"));
  const QStringList first = lines[1].split(',');
  QCOMPARE(first.size(), 9);
  QCOMPARE(first[1], QString("row"));
  QVERIFY(std::abs(first[7].toDouble() - f.measured().list[0].disparity_px) < 1e-3);
  QCOMPARE(first[6].toDouble(), -first[7].toDouble());
  QVERIFY(lines[2].contains("column"));
}

void MeasureTest::lines_comeBackWithTheProject() {
  Measuring f;
  f.draw(f.horizontal(), 20);
  f.keep();
  f.draw(f.vertical(), 12);
  f.keep();
  const std::string file = f.path("kept.episcope").toStdString();

  write_project(file, project_of(f.session()));

  QVERIFY(read_project(file).scenes.front().place.measured == f.measured());
}

void MeasureTest::depth_isToldWhereTheCameraIsKnown() {
  const CameraGrid known{.baseline = 2, .focal_length = 100, .shift = 1};
  const EpiMeasurement front{.name = "a \"b\", c", .disparity_px = 1};
  QCOMPARE(depth_of(front, known).value(), 100.0);  // B·f / (d + Δx)
  QVERIFY(!depth_of(front, CameraGrid()));
  QVERIFY(!depth_of(EpiMeasurement{.disparity_px = -1}, known));
  const std::string csv = measurements_csv({front}, known);
  QVERIFY2(csv.find("\"a \"\"b\"\", c\",row,0,0,0,0,-1.0000,1.0000,100\n") != std::string::npos,
           csv.c_str());
}

void MeasureTest::end_movesTheOtherOnlyIfItMust() {
  QCOMPARE(with_end({-1, 2}, RangeEnd::Lower, 0.123), (Interval{0.12, 2}));
  QCOMPARE(with_end({-1, 2}, RangeEnd::Upper, 0.123), (Interval{-1, 0.13}));
  QCOMPARE(with_end({-1, 2}, RangeEnd::Lower, 3), (Interval{3, 3.5}));
  QCOMPARE(with_end({-1, 2}, RangeEnd::Upper, -3), (Interval{-3.5, -3}));
  QVERIFY(with_end({}, RangeEnd::Lower, 0.3).length() > 0);
}

}  // namespace episcope::in_measure_test

EPISCOPE_WINDOW_TEST(measure_test, MeasureTest)
#include "measure_test.moc"
