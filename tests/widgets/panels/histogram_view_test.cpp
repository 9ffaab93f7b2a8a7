// SPDX-License-Identifier: BSD-3-Clause
#include "tests/window_test_main.h"
#include "widgets/controls/theme.h"
#include "widgets/panels/statistics_panel.h"

#include <QSignalSpy>

#include <algorithm>
#include <cmath>

namespace episcope::in_histogram_view_test {

namespace {

render::Shading shading(double min, double max) {
  return {render::color_map("viridis"), {min, max}};
}

void drag(QWidget& widget, QPointF from, QPointF to) {
  QTest::mousePress(&widget, Qt::LeftButton, {}, from.toPoint());
  QTest::mouseMove(&widget, ((from + to) / 2).toPoint());
  QTest::mouseMove(&widget, to.toPoint());
  QTest::mouseRelease(&widget, Qt::LeftButton, {}, to.toPoint());
}

Interval last_range(const QSignalSpy& edited) {
  return edited.isEmpty() ? Interval{} : edited.last()[0].value<Interval>();
}

}  // namespace

class HistogramViewTest : public QObject {
  Q_OBJECT

 private slots:
  void draggedHandle_movesItsEndOnly() {
    HistogramView view;
    view.resize(412, 100);  // a pixel is 0.005
    view.setHistogram({{-1, 1}, {1, 5, 9, 2}}, shading(-0.5, 0.5));
    view.show();
    QSignalSpy edited(&view, &HistogramView::rangeEdited);

    drag(view, {view.xOf(-0.5), 50}, {view.xOf(-0.2), 50});

    QVERIFY(std::abs(last_range(edited).min - -0.2) < 0.01);
    QCOMPARE(last_range(edited).max, 0.5);
  }

  void barAsDarkAsTheGround_isSeen() {
    HistogramView view;
    view.resize(412, 100);
    view.setHistogram({{-1, 1}, {9, 0, 0, 0}}, {render::color_map("grey"), {0, 1}});

    const QImage picture = view.grab().toImage();

    const QColor ground = picture.pixelColor(206, 50);
    double best = 1;
    for (int y = 0; y < 8; ++y) {  // where the bar ends
      best = std::max(best, theme::contrast_ratio(ground, picture.pixelColor(50, y)));
    }
    QVERIFY2(best > 3, qPrintable(QString::number(best)));
  }

  void dragBetweenTheHandles_movesBoth() {
    HistogramView view;
    view.resize(412, 100);
    view.setHistogram({{-1, 1}, {1, 5, 9, 2}}, shading(-0.5, 0.5));
    view.show();
    QSignalSpy edited(&view, &HistogramView::rangeEdited);

    drag(view, {view.xOf(0), 50}, {view.xOf(0.3), 50});

    QVERIFY(std::abs(last_range(edited).min - -0.2) < 0.01);
    QVERIFY(std::abs(last_range(edited).max - 0.8) < 0.01);
  }

  void handles_doNotPassEachOther() {
    HistogramView view;
    view.resize(412, 100);
    view.setHistogram({{-1, 1}, {1, 5, 9, 2}}, shading(-0.5, 0.5));
    view.show();
    QSignalSpy edited(&view, &HistogramView::rangeEdited);

    drag(view, {view.xOf(-0.5), 50}, {view.xOf(0.9), 50});

    QVERIFY(last_range(edited).length() > 0);
    QCOMPARE(last_range(edited).max, 0.5);
  }

  void setters_doNotEmit() {
    HistogramView view;
    QSignalSpy edited(&view, &HistogramView::rangeEdited);

    view.setHistogram({{-1, 1}, {1, 2}}, shading(0, 1));

    QCOMPARE(edited.size(), 0);
    QCOMPARE(view.range().max, 1.0);
  }

  void bars_areInTheColoursOfTheMap() {
    HistogramView view;
    view.resize(412, 100);
    const auto map = render::color_map("viridis");
    view.setHistogram({{-1, 1}, {4, 4, 4, 4}}, {map, {-0.5, 0.5}});

    const QImage shown = view.grab().toImage();

    const auto is_color = [&](double value, int index) {
      const auto [red, green, blue] = map.colors[static_cast<std::size_t>(index)];
      return shown.pixelColor(static_cast<int>(view.xOf(value)), 60) == QColor(red, green, blue);
    };
    QVERIFY(is_color(-0.8, 0));
    QVERIFY(is_color(0.8, 255));
  }

  void panel_tellsNumbersAndWhatIsMissing() {
    StatisticsPanel panel;
    render::RegionStatistics statistics;
    statistics.count = 10;
    statistics.invalid = 3;
    statistics.min = -0.25;
    statistics.median = 0.125;
    statistics.histogram = {{-1, 1}, {5, 5}};

    panel.setSummary({"error of EPI_L", "px", statistics, 12.5, shading(-1, 1)});
    QVERIFY2(panel.text().contains("min −0.250, median 0.125"), qPrintable(panel.text()));
    QVERIFY2(panel.text().contains("bad 12.50 %, invalid 3"), qPrintable(panel.text()));

    panel.clear("No map is shown");
    QVERIFY2(panel.text().contains("min –"), qPrintable(panel.text()));
  }
};

}  // namespace episcope::in_histogram_view_test

EPISCOPE_WINDOW_TEST(histogram_view_test, HistogramViewTest)
#include "histogram_view_test.moc"
