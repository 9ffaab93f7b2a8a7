// SPDX-License-Identifier: BSD-3-Clause
// The judged part of the view and errors by disparity, driven in the window that ships.
#include "app/gui/compare/region_controller.h"

#include "app/gui/estimate/estimate_controller.h"
#include "app/gui/scene/scene_switcher.h"
#include "app/session/project_file.h"
#include "app/session/project_store.h"
#include "tests/app/gui/compare/compared.h"
#include "widgets/controls/line_plot.h"
#include "widgets/controls/message_bar.h"
#include "widgets/panels/metric_table.h"
#include "widgets/panels/overlay_bar.h"

#include <QComboBox>
#include <QImage>
#include <QLabel>
#include <QScrollBar>
#include <QTableWidget>

#include <algorithm>
#include <cmath>

namespace episcope::in_region_test {

namespace {

class Judging : public Compared {
 public:
  explicit Judging(std::vector<float> offsets) : Compared(std::move(offsets)) {
    trigger("tab.compare");
    window.activateWindow();
  }

  [[nodiscard]] RegionController& region() { return find<RegionController>(window); }
  [[nodiscard]] QString summary() const { return find<RegionBar>(window).summary(); }

  /// A cell of the table as it is copied; nothing while there is no such column.
  [[nodiscard]] QString cell(int row, const QString& column) const {
    const QStringList lines = find<MetricTable>(window).toCsv().split('\n', Qt::SkipEmptyParts);
    if (row + 1 >= lines.size()) return {};
    const auto place = lines[0].trimmed().split(',').indexOf(column);
    return place < 0 ? QString() : lines[row + 1].trimmed().split(',').value(place);
  }

  void choose(int part) {
    auto* combo = window.findChild<QComboBox*>("region.part");
    combo->setCurrentIndex(part);
    emit combo->activated(part);
    QCoreApplication::processEvents();
  }

  void drawRectangle(PixelIndex from, PixelIndex to) {
    click("button.compare.rectangle");
    drag(from, to);
    QCoreApplication::processEvents();
  }
};

}  // namespace

class RegionTest : public QObject {
  Q_OBJECT

 private slots:
  void rectangle_isDrawnAndJudged();
  void escape_leavesTheRectangle();
  void wholeView_isJudgedAgain();
  void label_isJudged();
  void commonPixels_leaveOutWhatAResultLacks();
  void mask_isReadFromAFile();
  void regionsOfTheTruth_canBeChosen();
  void maskOfAnotherSize_isRefused();
  void everyScene_hasItsOwnPart();
  void part_comesBackWithTheProject();
  void missingMask_isTold_andTheWholeViewIsJudged();
  void tableOfAPart_doesNotScroll();
  void errors_arePlottedByDisparity();
  void errorsOfTwoResults_areTwoLines();
  void errorsOfTwoRuns_areNamedByWhatDiffers();
};

void RegionTest::rectangle_isDrawnAndJudged() {
  Judging f({0.0F});
  // The result is off in one corner only.
  auto estimate = std::make_shared<Estimate>();
  estimate->field.disparity = f.session().scene()->truth->field.disparity.clone();
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 30; ++x) estimate->field.disparity.view({4, 4}).at(y, x) += 1;
  }
  f.session().add_estimate(estimate, {-1, 1}, f.session().generation());
  QTRY_VERIFY_WITH_TIMEOUT(!f.cell(1, "vmv2013.mse_100").isEmpty(), kPatience);
  const double whole = f.cell(1, "vmv2013.mse_100").toDouble();
  QVERIFY(std::abs(whole - 100.0 * 600 / (96 * 96)) < 0.01);

  f.drawRectangle({2, 3}, {17, 22});

  QVERIFY(f.summary().startsWith("320"));                                // 16 × 20
  QVERIFY(!f.window.findChild<MessageBar*>("messageBar")->isVisible());  // what to do is done
  QTRY_COMPARE_WITH_TIMEOUT(f.cell(1, "vmv2013.mse_100").toDouble(), 100.0, kPatience);
  QCOMPARE(f.cell(1, "vmv2013.pixels"), QString("320"));
  QCOMPARE(f.cell(1, "benchmark2016.pixels"), QString("24"));  // rows 15 … 17 and columns 15 … 22
  QVERIFY(f.cell(1, "region").startsWith("\"rectangle x 3–22"));
  QVERIFY(!f.canvas()->region().empty());
  QVERIFY(!f.canvas()->tool());  // the mouse browses again
  f.key(Qt::Key_Right);          // another view: the outline is not of it
  QTRY_VERIFY(f.canvas()->region().empty());
  f.click("button.compare.rectangle");
  QCOMPARE(f.session().view(), (ViewIndex{4, 4}));  // the one that is judged
}

void RegionTest::escape_leavesTheRectangle() {
  Judging f({0.5F});
  f.click("button.compare.rectangle");
  QVERIFY(f.canvas()->tool());
  f.press({10, 10});
  f.move({30, 30});
  QVERIFY(!f.canvas()->region().empty());
  f.key(Qt::Key_Escape);
  f.release({30, 30});
  QCoreApplication::processEvents();
  QVERIFY(!f.canvas()->tool());
  QVERIFY(f.canvas()->region().empty());
  QCOMPARE(f.region().name(), QString("whole view"));
}

void RegionTest::wholeView_isJudgedAgain() {
  Judging f({0.5F});
  f.drawRectangle({2, 3}, {17, 22});
  QVERIFY(f.region().region());
  f.choose(0);
  QVERIFY(!f.region().region());
  QTRY_COMPARE_WITH_TIMEOUT(f.cell(0, "region"), QString("whole view"), kPatience);
  f.choose(1);  // the rectangle is still known
  QVERIFY(f.summary().startsWith("320"));
}

void RegionTest::label_isJudged() {
  Judging f({0.5F});
  f.trigger("tab.annotate");
  f.drag({40, 20}, {40, 60});
  f.trigger("tab.compare");
  f.choose(2);
  QVERIFY(f.region().name().startsWith("label"));
  const auto& painted = f.document().scribbles().view({4, 4});
  const auto count = std::count_if(painted.row(0), painted.row(0) + 96 * 96,
                                   [](std::uint8_t label) { return label == 1; });
  QVERIFY(count > 0);
  QTRY_COMPARE_WITH_TIMEOUT(f.cell(0, "vmv2013.pixels").toLongLong(), static_cast<qlonglong>(count),
                            kPatience);
}

void RegionTest::commonPixels_leaveOutWhatAResultLacks() {
  Judging f({0.5F, 0.1F});
  auto estimate = std::make_shared<Estimate>();
  estimate->field.disparity = f.session().scene()->truth->field.disparity.clone();
  estimate->field.valid = ViewStack<std::uint8_t>(estimate->field.disparity.grid(), 96, 96);
  std::fill_n(estimate->field.valid.data(), estimate->field.valid.size(), std::uint8_t{0});
  for (int x = 0; x < 96; ++x) estimate->field.valid.view({4, 4}).at(50, x) = 1;
  f.session().add_estimate(estimate, {-1, 1}, f.session().generation());
  QCoreApplication::processEvents();
  f.choose(3);
  QCOMPARE(f.summary(), QString("96 px"));
}

void RegionTest::mask_isReadFromAFile() {
  Judging f({0.5F});
  QImage mask(96, 96, QImage::Format_Grayscale8);
  mask.fill(0);
  for (int x = 0; x < 10; ++x) mask.setPixel(x, 5, qRgb(255, 255, 255));
  QVERIFY(mask.save(f.path("mask.png")));
  f.region().useMask(f.path("mask.png"));
  QTRY_COMPARE_WITH_TIMEOUT(f.summary(), QString("10 px"), kPatience);
  QCOMPARE(f.region().name(), QString("mask mask.png"));
}

void RegionTest::maskOfAnotherSize_isRefused() {
  Judging f({0.5F});
  QImage mask(20, 10, QImage::Format_Grayscale8);
  mask.fill(255);
  QVERIFY(mask.save(f.path("mask.png")));
  f.region().useMask(f.path("mask.png"));
  auto* bar = f.window.findChild<QWidget*>("messageBar");
  QTRY_VERIFY_WITH_TIMEOUT(bar->isVisible(), kPatience);
  QVERIFY(!f.region().region());
}

void RegionTest::everyScene_hasItsOwnPart() {
  Judging f({0.5F});
  f.drawRectangle({2, 3}, {17, 22});
  const auto first = f.session().generation();
  f.session().add(f.session().scene(), "another");
  QCoreApplication::processEvents();
  QVERIFY(!f.region().region());
  f.session().choose(first);
  QCoreApplication::processEvents();
  QVERIFY(f.region().region());
}

// A rectangle on one light field, a mask on another.
void RegionTest::part_comesBackWithTheProject() {
  Judging f({0.5F});
  QImage mask(96, 96, QImage::Format_Grayscale8);
  mask.fill(0);
  for (int x = 0; x < 10; ++x) mask.setPixel(x, 5, qRgb(255, 255, 255));
  QVERIFY(mask.save(f.path("mask.png")));
  f.drawRectangle({2, 3}, {17, 22});
  f.openSmall("slant");
  f.region().useMask(f.path("mask.png"));
  QTRY_COMPARE_WITH_TIMEOUT(f.summary(), QString("10 px"), kPatience);
  const std::string path = f.path("work.episcope").toStdString();
  Project project = project_of(f.session());
  for (ProjectScene& scene : project.scenes) scene.estimates.clear();  // no file keeps them
  write_project(path, project);

  WindowFixture g;
  g.window.start({QString::fromStdString(path)});
  Session& session = g.window.bench().session;
  QTRY_VERIFY_WITH_TIMEOUT(session.scene(), kScenePatience);
  const auto summary = [&g] { return find<RegionBar>(g.window).summary(); };
  QTRY_COMPARE_WITH_TIMEOUT(summary(), QString("10 px"), kPatience);
  g.window.bench().scenes.show(session.scenes()[0]->id);
  QTRY_VERIFY_WITH_TIMEOUT(summary().startsWith("320"), kScenePatience);
  QVERIFY(find<RegionController>(g.window).name().startsWith("rectangle x 3–22"));
}

void RegionTest::regionsOfTheTruth_canBeChosen() {
  Judging f({0.5F});
  const std::uint64_t first = f.session().generation();
  f.window.bench().opener.open("demo?size=96");  // files of the archive hold no regions
  QTRY_VERIFY_WITH_TIMEOUT(f.session().generation() != first && !f.session().estimates().empty(),
                           kScenePatience);
  const auto& regions = f.session().scene()->truth->regions;
  const auto edges = regions.find("discontinuities");
  QVERIFY(edges != regions.end());
  const auto inside =
      std::count_if(edges->second.data(), edges->second.data() + edges->second.size(),
                    [](std::uint8_t each) { return each != 0; });
  const auto* parts = f.window.findChild<QComboBox*>("region.part");
  const int row = parts->findText("Region: discontinuities");
  QVERIFY(row > 0);

  f.choose(row);

  QCOMPARE(f.region().name(), QString("region discontinuities"));
  QCOMPARE(f.summary().remove(',').section(' ', 0, 0).toLongLong(), inside);
  QCOMPARE(parts->currentIndex(), row);
  QTRY_COMPARE_WITH_TIMEOUT(f.cell(0, "region"), QString("region discontinuities"), kPatience);
  f.window.bench().scenes.show(first);
  QTRY_COMPARE(f.region().name(), QString("whole view"));
  QTRY_COMPARE(parts->findText("Region: discontinuities"), -1);
}

void RegionTest::missingMask_isTold_andTheWholeViewIsJudged() {
  Judging f({0.5F});
  f.session().set_judged(f.session().generation(),
                         {JudgedPixels::Mask, {}, f.path("gone.png").toStdString()});
  f.region().useMask(f.path("gone.png"));
  auto* bar = f.window.findChild<QWidget*>("messageBar");
  QTRY_VERIFY_WITH_TIMEOUT(bar->isVisible(), kPatience);
  QTRY_COMPARE(f.region().name(), QString("whole view"));
}

void RegionTest::tableOfAPart_doesNotScroll() {
  Judging f({0.2F, 0.3F});
  const auto* table = f.window.findChild<QTableWidget*>("metrics.table");
  QTRY_VERIFY_WITH_TIMEOUT(!f.cell(0, "vmv2013.mse_100").isEmpty(), kPatience);
  QTRY_COMPARE(table->horizontalScrollBar()->maximum(), 0);

  f.drawRectangle({10, 10}, {80, 80});

  QTRY_VERIFY_WITH_TIMEOUT(f.cell(0, "vmv2013.pixels").toInt() > 0, kPatience);
  QCOMPARE(table->horizontalScrollBar()->maximum(), 0);
}

void RegionTest::errors_arePlottedByDisparity() {
  Judging f({0.2F});
  f.trigger("tab.errors");
  auto* squares = f.window.findChild<LinePlot*>("errors.squares");
  QTRY_VERIFY_WITH_TIMEOUT(squares->plot().series.size() == 1, kPatience);
  QVERIFY(squares->plot().series[0].points.size() >= 2);
  for (const QPointF& point : squares->plot().series[0].points) {
    QVERIFY(std::abs(point.y() - 4) < 0.5);  // one pixel has no value
  }
  auto* bad = f.window.findChild<LinePlot*>("errors.bad");
  QCOMPARE(bad->plot().series[0].points[0].y(), 100.0);

  f.trigger("compare.rectangle");
  f.drag({30, 40}, {33, 43});
  QTRY_VERIFY_WITH_TIMEOUT(
      f.window.findChild<QLabel*>("errors.title")->toolTip().contains(", 16 px") ||
          f.window.findChild<QLabel*>("errors.title")->text().contains(", 16 px"),
      kPatience);
}

void RegionTest::errorsOfTwoResults_areTwoLines() {
  Judging f({0.2F, 0.5F});
  f.trigger("tab.errors");
  auto* squares = f.window.findChild<LinePlot*>("errors.squares");
  QTRY_VERIFY_WITH_TIMEOUT(squares->plot().series.size() == 2, kPatience);
  QVERIFY(std::abs(squares->plot().series[0].points.back().y() - 25) < 1);  // A, shown last
  QVERIFY(std::abs(squares->plot().series[1].points.back().y() - 4) < 1);
  f.session().show_estimate(f.ids[0]);
  QTRY_VERIFY_WITH_TIMEOUT(std::abs(squares->plot().series[0].points.back().y() - 4) < 1,
                           kPatience);
}

void RegionTest::errorsOfTwoRuns_areNamedByWhatDiffers() {
  WindowFixture f;
  f.openSmall();
  Session& session = f.window.bench().session;
  auto& estimates = find<EstimateController>(f.window);
  for (const double scale : {0.6, 1.2}) {
    estimates.run({"epi_l", {{"inner_scale", scale}}, {.views = ViewSelection::Center}});
  }
  QTRY_COMPARE_WITH_TIMEOUT(session.estimates().size(), std::size_t{2}, kScenePatience);
  session.compare_with(session.estimates()[0].id);
  f.trigger("tab.errors");
  const auto* squares = f.window.findChild<LinePlot*>("errors.squares");
  const auto legend = [squares] {
    QStringList names;
    for (const PlotSeries& series : squares->plot().series) names << series.name;
    return names;
  };

  QTRY_COMPARE_WITH_TIMEOUT(legend(), QStringList({"Inner scale 1.2 px", "Inner scale 0.6 px"}),
                            kPatience);

  session.rename_estimate(session.estimates()[1].id, "smooth");
  QTRY_COMPARE_WITH_TIMEOUT(legend(), QStringList({"smooth", "Inner scale 0.6 px"}), kPatience);
}

}  // namespace episcope::in_region_test

EPISCOPE_WINDOW_TEST(region_test, RegionTest)
#include "region_test.moc"
