// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/compare/compare_controller.h"

#include "app/gui/compare/statistics_controller.h"
#include "app/gui/shell/commands.h"
#include "tests/app/gui/compare/compared.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/epi_pane.h"
#include "widgets/canvas/tile_wall.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/theme.h"
#include "widgets/panels/color_bar.h"
#include "widgets/panels/metric_table.h"
#include "widgets/panels/statistics_panel.h"
#include "widgets/panels/value_bar.h"

#include <QClipboard>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHeaderView>
#include <QScrollBar>
#include <QTabWidget>
#include <QTableWidget>
#include <QTreeWidget>

#include <cmath>
#include <limits>

namespace episcope::in_compare_test {

namespace {

// Middle of the mark of a row in the list of results.
QPoint mark_of(const QTreeWidget& tree, int row) {
  const QRect item = tree.visualItemRect(tree.topLevelItem(row));
  return {tree.header()->sectionSize(0) / 2, item.center().y()};
}

bool has_color(const QImage& image, QColor color) {
  for (int i = 0; i < image.width() * image.height(); ++i) {
    if (image.pixelColor(i % image.width(), i / image.width()) == color) return true;
  }
  return false;
}

}  // namespace

class CompareTest : public QObject {
  Q_OBJECT

 private slots:
  void wipe_showsBRightOfADividerThatCanBeDragged();
  void sideBySide_showsAAndB();
  void flip_marksWhichOneIsSeen();
  void flip_isHeardInLists_data();
  void flip_isHeardInLists();
  void truthAsB_isSaidToHaveNoError();
  void difference_isOfAAndB();
  void clickOnAMark_choosesB();
  void errorOfOneResult_isAgainstTheTruth();
  void chosenB_staysWhenAnotherIsShown();
  void resultOfAJob_leavesAComparisonAlone_data();
  void resultOfAJob_leavesAComparisonAlone();
  void openedResult_isShownInTheSingleView();
  void rowOfTheMetricTable_showsItsResult();
  void longNames_leaveTheNumbersInSight();
  void metricTable_isCopiedByKey();
  void statistics_areOfWhatIsInSight();
  void automaticRange_isThatOfWhatIsInSight();
  void draggedHandle_changesTheColours();
  void valuesOfAAndB_comeFirst();
  void withoutResults_nothingCanBeCompared();
  void closedScene_leavesEveryMode();
  void badPixels_followTheirThreshold();
  void badPixels_ofTheWholeView_areThoseOfTheTable();
  void truth_isMarkedAsNeitherSide();
};

void CompareTest::wipe_showsBRightOfADividerThatCanBeDragged() {
  Compared f({0.0F, 0.5F});
  QTRY_VERIFY_WITH_TIMEOUT(!f.window.bench().overlay.picture().isNull(), kPatience);
  f.trigger("compare.wipe");
  QVERIFY(f.canvas()->wipePosition().has_value());
  const int width = f.canvas()->width();
  const QPoint place = f.canvas()->positionOf({20, 40}).toPoint();  // left of the middle
  const auto color = [&] { return f.canvas()->grab().toImage().pixelColor(place); };
  const QColor of_a = color();
  const QPoint divider(static_cast<int>(*f.canvas()->wipePosition() * width), 40);

  QTest::mousePress(f.canvas(), Qt::LeftButton, {}, divider);
  QTest::mouseMove(f.canvas(), {width / 4, 40});
  QTest::mouseRelease(f.canvas(), Qt::LeftButton, {}, {width / 4, 40});

  QVERIFY(std::abs(*f.canvas()->wipePosition() - 0.25) < 0.01);
  QTRY_VERIFY_WITH_TIMEOUT(color() != of_a, kPatience);
  QVERIFY(f.session().view() == (ViewIndex{4, 4}));  // it was no parallax
  f.trigger("compare.wipe");
  QVERIFY(!f.canvas()->wipePosition());
  QCOMPARE(color(), of_a);
}

void CompareTest::sideBySide_showsAAndB() {
  Compared f({0.0F, 0.5F});
  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().commands.find("compare.sides")->isEnabled(), kPatience);

  f.key(Qt::Key_H);

  QTRY_COMPARE_WITH_TIMEOUT(f.wall()->count(), 2, kPatience);
  QVERIFY(f.wall()->tile(0)->picture() != f.wall()->tile(1)->picture());
  const int shown = f.session().shown()->id;
  click_pixel(f.wall()->tile(1), {20, 33});
  QCOMPARE(f.session().shown()->id, shown);
}

void CompareTest::flip_marksWhichOneIsSeen() {
  Compared f({0.0F, 0.5F});
  QTRY_VERIFY_WITH_TIMEOUT(!f.window.bench().overlay.picture().isNull(), kPatience);
  EpiPane* epi = f.window.bench().viewer_area.horizontalEpi();
  const QImage of_a = f.canvas()->grab().toImage();
  const QImage epi_of_a = epi->grab().toImage();
  const QRect badge(0, 0, 26, 26);

  QTest::keyPress(f.canvas(), Qt::Key_Tab);
  const QImage of_b = f.canvas()->grab().toImage();
  const QImage epi_of_b = epi->grab().toImage();
  QVERIFY(f.window.bench().overlay.isFlipped());
  QTest::keyRelease(f.canvas(), Qt::Key_Tab);

  QVERIFY(of_a.copy(badge) != of_b.copy(badge));
  QVERIFY(epi_of_a != epi_of_b);  // the line and its label are of B, too
  QCOMPARE(epi->grab().toImage(), epi_of_a);
  QCOMPARE(f.canvas()->grab().toImage(), of_a);
}

void CompareTest::badPixels_ofTheWholeView_areThoseOfTheTable() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  f.trigger("overlay.bad_pixels");
  f.trigger("tab.compare");
  const auto* table = f.window.findChild<QTableWidget*>("metrics.table");
  const auto bad_of_table = [table] {
    for (int column = 0; column < table->columnCount(); ++column) {
      const bool is_bad = table->horizontalHeaderItem(column)->text() == "2016\nbad .07";
      if (is_bad && table->item(0, column)) return table->item(0, column)->text();
    }
    return QString();
  };
  QTRY_VERIFY_WITH_TIMEOUT(!bad_of_table().isEmpty(), kPatience);

  const auto* panel = f.window.findChild<StatisticsPanel*>();
  QTRY_VERIFY2_WITH_TIMEOUT(panel->text().contains("bad " + bad_of_table() + " %"),
                            qPrintable(panel->text() + " · " + bad_of_table()), kPatience);
  const auto* part = panel->findChild<QLabel*>("statistics.bad_part");
  QVERIFY2(part->isVisible() && part->text().contains("without the border of 15 px"),
           qPrintable(part->text()));
}

void CompareTest::truth_isMarkedAsNeitherSide() {
  Compared f({0.0F, 0.5F});
  const auto is_marked = [&] {
    const QImage corner = f.canvas()->grab({0, 0, 26, 26}).toImage();
    return has_color(corner, side_color(Side::A)) || has_color(corner, side_color(Side::B));
  };
  QTRY_VERIFY_WITH_TIMEOUT(is_marked(), kPatience);

  f.trigger("overlay.truth");
  QTRY_VERIFY_WITH_TIMEOUT(!is_marked(), kPatience);
  QTest::keyPress(f.canvas(), Qt::Key_Tab);
  QVERIFY(!is_marked());
  QTest::keyRelease(f.canvas(), Qt::Key_Tab);

  f.trigger("overlay.disparity");
  QTRY_VERIFY_WITH_TIMEOUT(is_marked(), kPatience);
}

void CompareTest::flip_isHeardInLists_data() {
  QTest::addColumn<QString>("list");
  QTest::newRow("results") << "results.tree";
  QTest::newRow("metrics") << "metrics.table";
}

// Where a result was chosen the keyboard stays: the key that flips must not leave it.
void CompareTest::flip_isHeardInLists() {
  QFETCH(QString, list);
  Compared f({0.0F, 0.5F});
  QTRY_VERIFY_WITH_TIMEOUT(!f.window.bench().overlay.picture().isNull(), kPatience);
  auto* widget = f.window.findChild<QWidget*>(list);

  QTest::keyPress(widget, Qt::Key_Tab);
  QVERIFY(f.window.bench().overlay.isFlipped());
  QTest::keyRelease(widget, Qt::Key_Tab);

  QVERIFY(!f.window.bench().overlay.isFlipped());
}

void CompareTest::truthAsB_isSaidToHaveNoError() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  f.trigger("overlay.error");
  const Overlay& overlay = f.window.bench().overlay;

  QCOMPARE(overlay.describeB(), QString("view · the ground truth has no error"));
  f.trigger("overlay.disparity");
  QCOMPARE(overlay.describeB(), QString("ground truth"));
}

void CompareTest::difference_isOfAAndB() {
  Compared f({0.0F, 0.5F, 0.75F});
  f.session().compare_with(f.ids[0]);
  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().commands.find("compare.difference")->isEnabled(),
                           kPatience);

  f.key(Qt::Key_D);

  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().overlay.valueAt({48, 48}).has_value(), kPatience);
  QVERIFY(std::abs(*f.window.bench().overlay.valueAt({48, 48}) - 0.75) < 1e-5);
  QVERIFY(f.window.bench().viewer_area.colorBar()->range() ==
          (Interval{-0.2, 0.2}));  // a range of its own
}

void CompareTest::clickOnAMark_choosesB() {
  Compared f({0.1F, 0.2F, 0.3F});
  auto* tree = f.window.findChild<QTreeWidget*>("results.tree");
  QTRY_COMPARE_WITH_TIMEOUT(tree->topLevelItemCount(), 3, kPatience);

  QTest::mouseClick(tree->viewport(), Qt::LeftButton, {}, mark_of(*tree, 0));

  QCOMPARE(f.session().shown()->id, f.ids[2]);
  QCOMPARE(f.session().compared()->id, f.ids[0]);
  const auto* b = f.window.findChild<QComboBox*>("compare.b");
  QTRY_COMPARE_WITH_TIMEOUT(b->currentData().toInt(), f.ids[0], kPatience);
}

void CompareTest::errorOfOneResult_isAgainstTheTruth() {
  Compared f({0.1F});
  const auto* b = f.window.findChild<QComboBox*>("compare.b");
  QTRY_COMPARE_WITH_TIMEOUT(b->placeholderText(), QString("ground truth"), kPatience);

  f.trigger("overlay.error");

  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().overlay.quantity(), render::Quantity::SignedError,
                            kPatience);
  QCOMPARE(b->placeholderText(), QString("ground truth"));
}

void CompareTest::chosenB_staysWhenAnotherIsShown() {
  Compared f({0.1F, 0.2F, 0.3F});
  f.session().compare_with(f.ids[0]);

  f.session().show_estimate(f.ids[1]);
  QCOMPARE(f.session().compared()->id, f.ids[0]);
  f.session().show_estimate(f.ids[0]);  // showing B swaps the two

  QCOMPARE(f.session().shown()->id, f.ids[0]);
  QCOMPARE(f.session().compared()->id, f.ids[1]);
}

void CompareTest::resultOfAJob_leavesAComparisonAlone_data() {
  QTest::addColumn<int>("results");
  QTest::addColumn<QString>("command");
  QTest::newRow("wipe of two") << 2 << "compare.wipe";
  QTest::newRow("wipe of one and the truth") << 1 << "compare.wipe";
  QTest::newRow("B was chosen") << 2 << QString();
  QTest::newRow("numbers of two") << 2 << "tab.compare";
  QTest::newRow("plots of two") << 2 << "tab.errors";
}

// Run by key.
void CompareTest::resultOfAJob_leavesAComparisonAlone() {
  QFETCH(int, results);
  QFETCH(QString, command);
  Compared f(results == 1 ? std::vector{0.1F} : std::vector{0.1F, 0.2F});
  const auto id_of = [](const EstimateEntry* entry) { return entry ? entry->id : 0; };
  if (command.isEmpty()) {
    f.session().compare_with(f.ids.front());
  } else {
    f.trigger(qPrintable(command));
  }
  const int a = id_of(f.session().side_a()), b = id_of(f.session().side_b());
  const auto* tree = f.window.findChild<QTreeWidget*>("results.tree");
  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().commands.find("estimate.run")->isEnabled(), kPatience);

  f.key(Qt::Key_F5);

  QTRY_COMPARE_WITH_TIMEOUT(tree->topLevelItemCount(), results + 1, kScenePatience);
  QCOMPARE(id_of(f.session().side_a()), a);
  QCOMPARE(id_of(f.session().side_b()), b);
  QCOMPARE(tree->topLevelItem(results)->text(0), QString("new"));
  f.session().show_estimate(f.session().estimates().back().id);
  QTRY_VERIFY_WITH_TIMEOUT(tree->topLevelItem(results)->text(0).isEmpty(), kPatience);
}

void CompareTest::openedResult_isShownInTheSingleView() {
  Compared f({0.1F, 0.2F});
  f.session().compare_with(f.ids[0]);

  const int opened = f.add(0.3F);
  f.session().show_opened_estimate(opened);

  QCOMPARE(f.session().side_a()->id, opened);
  QCOMPARE(f.session().side_b()->id, f.ids[0]);
  f.trigger("compare.wipe");
  f.session().show_opened_estimate(f.add(0.4F));
  QCOMPARE(f.session().side_a()->id, opened);
}

void CompareTest::rowOfTheMetricTable_showsItsResult() {
  Compared f({0.1F, 0.2F});
  f.trigger("tab.compare");
  auto* table = f.window.findChild<QTableWidget*>("metrics.table");
  QTRY_COMPARE_WITH_TIMEOUT(table->rowCount(), 2, kPatience);
  QTRY_VERIFY_WITH_TIMEOUT(table->columnCount() > 7, kPatience);

  QTest::mouseClick(table->viewport(), Qt::LeftButton, {},
                    table->visualItemRect(table->item(0, 0)).center());

  QCOMPARE(f.session().shown()->id, f.ids[0]);
  // Off by less: the best MSE.
  QTRY_VERIFY_WITH_TIMEOUT(table->item(0, 1)->font().bold(), kPatience);
  QVERIFY(!table->item(1, 1)->font().bold());
}

void CompareTest::longNames_leaveTheNumbersInSight() {
  Compared f({0.1F, 0.2F});
  f.window.resize(1280, 800);
  const QString name = "structure tensor with a long name and its parameters";
  f.session().rename_estimate(f.ids[0], name.toStdString());
  f.trigger("tab.compare");
  const auto* table = f.window.findChild<QTableWidget*>("metrics.table");

  QTRY_VERIFY_WITH_TIMEOUT(
      table->rowCount() == 2 && table->columnCount() > 7 && table->item(0, 1)->text() != "–",
      kPatience);

  QCOMPARE(table->horizontalScrollBar()->maximum(), 0);
  QCOMPARE(table->item(0, 0)->toolTip(), name);
  QVERIFY(table->columnWidth(0) < table->fontMetrics().horizontalAdvance(name));
}

void CompareTest::metricTable_isCopiedByKey() {
  Compared f({0.1F, 0.2F});
  f.trigger("tab.compare");
  auto* table = f.window.findChild<QTableWidget*>("metrics.table");
  QTRY_VERIFY_WITH_TIMEOUT(
      find<MetricTable>(f.window).toCsv().startsWith("method,vmv2013.mse_100,"), kPatience);
  f.window.activateWindow();
  table->setFocus();

  QTest::keyClick(table, Qt::Key_C, Qt::ControlModifier);

  const QString text = QGuiApplication::clipboard()->text();
  QVERIFY2(text.startsWith("method,vmv2013.mse_100,"), qPrintable(text));
  QCOMPARE(text.count('\n'), 3);
}

void CompareTest::statistics_areOfWhatIsInSight() {
  Compared f({0.25F});
  f.window.bench().overlay.setQuantity(render::Quantity::SignedError);
  const auto& known = find<StatisticsController>(f.window).statistics();
  QTRY_VERIFY_WITH_TIMEOUT(known && known->count + known->invalid == 96U * 96U, kPatience);
  QVERIFY(std::abs(known->median - -0.25) < 1e-5);
  QTRY_VERIFY2_WITH_TIMEOUT(f.window.findChild<StatisticsPanel*>()->text().contains("bad 100.00 %"),
                            qPrintable(f.window.findChild<StatisticsPanel*>()->text()), kPatience);

  f.canvas()->setCanvasTransform({f.canvas()->fitScale() * 6, {48, 48}});

  const QRect seen = f.canvas()->visiblePixels();
  QVERIFY(seen.width() < 40);
  QTRY_VERIFY_WITH_TIMEOUT(
      known && known->count == static_cast<std::size_t>(seen.width() * seen.height()), kPatience);
}

void CompareTest::automaticRange_isThatOfWhatIsInSight() {
  Compared f({0.25F});
  f.window.bench().overlay.setQuantity(render::Quantity::SignedError);
  const Interval own = f.window.bench().viewer_area.colorBar()->range();

  f.key(Qt::Key_A);

  const ColorBar* bar = f.window.bench().viewer_area.colorBar();
  // Zero stays in the middle.
  QTRY_VERIFY_WITH_TIMEOUT(std::abs(bar->range().max - 0.25) < 0.01, kPatience);
  QVERIFY(std::abs(bar->range().min - -0.25) < 0.01);
  f.key(Qt::Key_R);
  QTRY_VERIFY_WITH_TIMEOUT(bar->range() == own, kPatience);
}

void CompareTest::draggedHandle_changesTheColours() {
  Compared f({0.25F});
  f.trigger("tab.compare");
  auto* view = f.window.findChild<HistogramView*>();
  QTRY_VERIFY_WITH_TIMEOUT(!view->histogram().counts.empty() && view->isVisible(), kPatience);
  const QImage before = f.window.bench().overlay.picture();
  const Interval range = view->range();
  const QPoint from(static_cast<int>(view->xOf(range.max)), view->height() / 2);

  QTest::mousePress(view, Qt::LeftButton, {}, from);
  QTest::mouseMove(view, from - QPoint(60, 0));
  QTest::mouseRelease(view, Qt::LeftButton, {}, from - QPoint(60, 0));

  QVERIFY(view->range().max < range.max);
  QCOMPARE(view->range().min, range.min);
  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().overlay.picture() != before, kPatience);
}

void CompareTest::valuesOfAAndB_comeFirst() {
  Compared f({0.1F, 0.2F, 0.3F});
  const auto place = [&f](const char* name) {
    return f.window.findChild<ValueBar*>()->text().indexOf(name);
  };

  QTRY_VERIFY_WITH_TIMEOUT(place("off 3 ") > 0, kPatience);
  QVERIFY(place("off 3 ") < place("off 2 "));
}

void CompareTest::withoutResults_nothingCanBeCompared() {
  WindowFixture f;
  for (const char* id : {"compare.wipe", "compare.sides", "compare.tiles", "compare.difference"}) {
    QVERIFY2(!f.window.bench().commands.find(id)->isEnabled(), id);
  }
  find<CompareController>(f.window).setMode(CompareMode::Wall);
  QCOMPARE(find<CompareController>(f.window).mode(), CompareMode::Single);
}

void CompareTest::closedScene_leavesEveryMode() {
  for (const char* id : {"compare.tiles", "compare.sides", "compare.wipe"}) {
    Compared f({0.1F, 0.2F});
    QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().commands.find(id)->isEnabled(), kPatience);
    f.trigger(id);

    f.trigger("file.close");

    QTRY_COMPARE_WITH_TIMEOUT(f.canvas()->state(), ViewCanvas::State::Empty, kPatience);
    QVERIFY2(f.canvas()->isVisible(), id);
    QCOMPARE(find<CompareController>(f.window).mode(), CompareMode::Single);
  }
}

// A result that is 0.2 px off everywhere.
void CompareTest::badPixels_followTheirThreshold() {
  Compared f({0.2F});
  f.trigger("overlay.bad_pixels");
  f.trigger("tab.compare");
  auto* panel = f.window.findChild<StatisticsPanel*>();
  QTRY_VERIFY2_WITH_TIMEOUT(panel->text().contains("bad 100.00 %"), qPrintable(panel->text()),
                            kPatience);
  // Numbers are errors, not the places of the two colors.
  QVERIFY2(panel->text().contains("median 0.200"), qPrintable(panel->text()));
  QVERIFY(std::abs(*f.window.bench().overlay.valueAt({40, 40}) - 0.2) < 1e-4);
  const QImage before = f.window.bench().overlay.picture();

  auto* threshold = panel->findChild<QDoubleSpinBox*>("statistics.threshold");
  QVERIFY(threshold->isVisible());
  threshold->setFocus();
  threshold->selectAll();
  QTest::keyClicks(threshold, "0.3");
  QTest::keyClick(threshold, Qt::Key_Return);

  QTRY_VERIFY2_WITH_TIMEOUT(panel->text().contains("bad 0.00 %"), qPrintable(panel->text()),
                            kPatience);
  QTRY_VERIFY(f.window.bench().overlay.picture() != before);
  QVERIFY(f.window.bench().overlay.describe(f.window.bench().overlay.choice()).contains("0.30 px"));
}

}  // namespace episcope::in_compare_test

EPISCOPE_WINDOW_TEST(compare_test, CompareTest)
#include "compare_test.moc"
