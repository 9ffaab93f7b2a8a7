// SPDX-License-Identifier: BSD-3-Clause
#include "tests/widgets/pictures.h"
#include "tests/window_test_main.h"
#include "widgets/controls/line_plot.h"
#include "widgets/controls/theme.h"

#include <QSignalSpy>

#include <cmath>
#include <limits>

namespace episcope::in_line_plot_test {
namespace {

Plot two_lines() {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  return {{"smoothing λ", true},
          {"MSE×100 [px²]"},
          {{"scale 0.6", {{0.1, 2}, {1, 1}, {10, 3}}},
           {"scale 0.8", {{0.1, 2.5}, {1, nothing}, {10, 0.5}}}}};
}

}  // namespace

class LinePlotTest : public QObject {
  Q_OBJECT

 private slots:
  void init();
  void positions_followTheAxes();
  void points_areDrawnInTheColourOfTheirLine_data();
  void points_areDrawnInTheColourOfTheirLine();
  void click_choosesThePointUnderIt();
  void click_elsewhereChoosesNothing();
  void keys_walkAndChoose();
  void noPoints_saysWhy();
  void otherTheme_changesTheColours();
  void logarithm_needsPositiveValues();
  void longNames_leaveTheLinesTheirRoom();
  void lastNumber_isNotCut();
  void longTitle_isNotCut();
  void onePoint_isDrawn();

 private:
  std::unique_ptr<LinePlot> plot_;
};

void LinePlotTest::init() {
  plot_ = std::make_unique<LinePlot>();
  plot_->setPalette(theme::light_palette());
  plot_->resize(360, 220);
  plot_->setPlot(two_lines());
  plot_->show();
  QVERIFY(QTest::qWaitForWindowExposed(plot_.get()));
  plot_->grab();
}

void LinePlotTest::positions_followTheAxes() {
  const QPointF a = plot_->positionOf({0, 0}), b = plot_->positionOf({0, 1}),
                c = plot_->positionOf({0, 2});
  QVERIFY(QRectF(plot_->rect()).contains(a) && QRectF(plot_->rect()).contains(c));
  QVERIFY(std::abs((b.x() - a.x()) - (c.x() - b.x())) < 0.5);  // powers of ten
  QVERIFY(b.y() > a.y() && a.y() > c.y());                     // larger values are higher
}

void LinePlotTest::points_areDrawnInTheColourOfTheirLine_data() {
  QTest::addColumn<QPalette>("palette");
  QTest::newRow("light") << theme::light_palette();
  QTest::newRow("dark") << theme::dark_palette();
}

void LinePlotTest::points_areDrawnInTheColourOfTheirLine() {
  QFETCH(QPalette, palette);
  plot_->setPalette(palette);
  const QImage picture = plot_->grab().toImage();
  for (const PlotPlace place : {PlotPlace{0, 0}, PlotPlace{0, 2}, PlotPlace{1, 0}}) {
    const QColor color = series_look(place.series, palette).color;
    QCOMPARE(picture.pixelColor(plot_->positionOf(place).toPoint()), color);
    QVERIFY(theme::contrast_ratio(color, palette.color(QPalette::Base)) >= 3);
  }
}

void LinePlotTest::click_choosesThePointUnderIt() {
  const QSignalSpy chosen(plot_.get(), &LinePlot::pointChosen);
  QTest::mouseClick(plot_.get(), Qt::LeftButton, {},
                    plot_->positionOf({1, 2}).toPoint() + QPoint(3, -3));
  QCOMPARE(chosen.count(), 1);
  QCOMPARE(chosen.first().first().value<PlotPlace>(), (PlotPlace{1, 2}));
}

void LinePlotTest::click_elsewhereChoosesNothing() {
  const QSignalSpy chosen(plot_.get(), &LinePlot::pointChosen);
  QTest::mouseClick(plot_.get(), Qt::LeftButton, {},
                    plot_->positionOf({0, 1}).toPoint() - QPoint(25, 0));
  QCOMPARE(chosen.count(), 0);
}

void LinePlotTest::keys_walkAndChoose() {
  const QSignalSpy chosen(plot_.get(), &LinePlot::pointChosen);
  plot_->setFocus(Qt::TabFocusReason);
  QTest::keyClick(plot_.get(), Qt::Key_Right);
  QTest::keyClick(plot_.get(), Qt::Key_Right);
  QTest::keyClick(plot_.get(), Qt::Key_Down);
  QTest::keyClick(plot_.get(), Qt::Key_Right);  // there is no further point
  QTest::keyClick(plot_.get(), Qt::Key_Return);
  QCOMPARE(chosen.count(), 1);
  QCOMPARE(chosen.first().first().value<PlotPlace>(), (PlotPlace{1, 2}));
}

void LinePlotTest::noPoints_saysWhy() {
  plot_->setPlot({});
  const QImage silent = plot_->grab().toImage();
  plot_->setEmptyText("There is no ground truth.");
  QVERIFY(test::color_count(plot_->grab().toImage()) > test::color_count(silent));
  QVERIFY(!plot_->placeAt(plot_->rect().center()));
}

void LinePlotTest::otherTheme_changesTheColours() {
  const QColor light = plot_->grab().toImage().pixelColor(3, 3);
  plot_->setPalette(theme::dark_palette());
  QVERIFY(plot_->grab().toImage().pixelColor(3, 3).lightness() < light.lightness());
}

void LinePlotTest::logarithm_needsPositiveValues() {
  Plot plot = two_lines();
  plot.series = {{"one", {{0, 1}, {5, 2}, {10, 3}}}};
  plot_->setPlot(plot);
  plot_->grab();
  const double a = plot_->positionOf({0, 0}).x(), b = plot_->positionOf({0, 1}).x(),
               c = plot_->positionOf({0, 2}).x();
  QVERIFY(std::abs((b - a) - (c - b)) < 0.5);
}

void LinePlotTest::longNames_leaveTheLinesTheirRoom() {
  Plot plot = two_lines();
  for (PlotSeries& series : plot.series) series.name += QString(" of a long evening").repeated(5);

  plot_->setPlot(plot);
  plot_->grab();

  const QPointF first = plot_->positionOf({0, 0}), last = plot_->positionOf({0, 2});
  QVERIFY(first.x() > 0 && last.x() < plot_->width());
  QVERIFY2(last.x() - first.x() > plot_->width() / 3, qPrintable(QString::number(last.x())));
}

void LinePlotTest::lastNumber_isNotCut() {
  plot_->setPlot({{"x"}, {"y"}, {{"line", {{0, 1}, {1, 2}, {2, 1}}}}});

  const QImage picture = plot_->grab().toImage();

  for (int y = 1; y < picture.height() - 1; ++y) {
    QCOMPARE(picture.pixelColor(picture.width() - 2, y), plot_->palette().color(QPalette::Base));
  }
}

void LinePlotTest::longTitle_isNotCut() {
  plot_->setPlot({{"x"}, {QString("MSE").repeated(20) + " [px²]"}, {{"", {{0, 1}, {1, 2}}}}});
  plot_->resize(360, 120);

  const QImage picture = plot_->grab().toImage();

  for (int x = 1; x < 40; ++x) {
    QCOMPARE(picture.pixelColor(x, 2), plot_->palette().color(QPalette::Base));
    QCOMPARE(picture.pixelColor(x, picture.height() - 3), plot_->palette().color(QPalette::Base));
  }
}

void LinePlotTest::onePoint_isDrawn() {
  plot_->setPlot({{"x"}, {"y"}, {{"line", {{1, 2}}}}});

  const QImage picture = plot_->grab().toImage();

  QCOMPARE(picture.pixelColor(plot_->positionOf({0, 0}).toPoint()),
           series_look(0, plot_->palette()).color);
}

}  // namespace episcope::in_line_plot_test

EPISCOPE_WINDOW_TEST(line_plot_test, LinePlotTest)
#include "line_plot_test.moc"
