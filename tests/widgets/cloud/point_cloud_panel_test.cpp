// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/cloud/point_cloud_panel.h"
#include "tests/window_test_main.h"

#include <QComboBox>
#include <QLabel>
#include <QSignalSpy>

namespace episcope::in_point_cloud_panel_test {

class PointCloudPanelTest : public QObject {
  Q_OBJECT

 private slots:
  void offscreen_aLabelSaysWhyThereIsNoView() {
    PointCloudPanel panel;
    panel.resize(300, 300);
    panel.show();
    PointCloud cloud;
    cloud.positions.push_back({0, 0, 0});
    cloud.colors.push_back({1, 2, 3});

    panel.setCloud(cloud);

    QVERIFY(!panel.isAvailable());
    const auto* label = panel.findChild<QLabel*>("pointCloudUnavailable");
    QVERIFY(label && label->isVisible());
    QVERIFY(!label->text().isEmpty());
  }

  void legend_isShownForMapsOnly() {
    PointCloudPanel panel;
    auto* legend = panel.findChild<QWidget*>("cloud.legend");
    QVERIFY(legend->isHidden());

    panel.setLegend("disparity [px]", {render::color_map("viridis"), {-1, 2}});
    QVERIFY(!legend->isHidden());
    panel.setLegend({});

    QVERIFY(legend->isHidden());
  }

  void coloring_isAnIntent() {
    PointCloudPanel panel;
    QSignalSpy selected(&panel, &PointCloudPanel::coloringSelected);
    auto* combo = panel.findChild<QComboBox*>("cloud.coloring");

    QTest::keyClick(combo, Qt::Key_Down);
    QTest::keyClick(combo, Qt::Key_Down);  // No truth: errors cannot be chosen.
    QCOMPARE(selected.size(), 1);
    QCOMPARE(panel.coloring(), CloudColoring::Disparity);
    panel.setErrorAvailable(true);
    QTest::keyClick(combo, Qt::Key_Down);
    QCOMPARE(panel.coloring(), CloudColoring::Error);
  }
};

}  // namespace episcope::in_point_cloud_panel_test

EPISCOPE_WINDOW_TEST(point_cloud_panel_test, PointCloudPanelTest)
#include "point_cloud_panel_test.moc"
