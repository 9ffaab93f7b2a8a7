// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/cloud/point_cloud_panel.h"
#include "tests/window_test_main.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QSignalSpy>
#include <QSlider>

namespace episcope::in_point_cloud_panel_test {

class PointCloudPanelTest : public QObject {
  Q_OBJECT

 private slots:
  void offscreen_aLabelSaysWhyThereIsNoView() {
    PointCloudPanel panel;
    panel.resize(300, 500);
    panel.show();

    QVERIFY(!panel.isAvailable());
    const auto* label = panel.findChild<QLabel*>("pointCloudUnavailable");
    QVERIFY(label && label->isVisible());
    QVERIFY(!label->text().isEmpty());
  }

  void display_canBeElsewhere() {
    PointCloudPanel panel;
    QWidget elsewhere;
    panel.resize(300, 500);
    panel.show();

    panel.lendDisplay("It is elsewhere.");
    panel.display().setParent(&elsewhere);
    QVERIFY(panel.findChild<QLabel*>("cloud.elsewhere")->isVisible());
    panel.takeDisplayBack();

    QVERIFY(panel.isAncestorOf(&panel.display()));
    QVERIFY(panel.display().isVisible());
    QVERIFY(!panel.findChild<QLabel*>("cloud.elsewhere")->isVisible());
  }

  void choice_isAnIntent_ofWhatCanBeHad() {
    CloudControls controls;
    QSignalSpy changed(&controls, &CloudControls::choiceChanged);
    auto* combo = controls.findChild<QComboBox*>("cloud.coloring");
    controls.setOffers({});

    QTest::keyClick(combo, Qt::Key_Down);
    QTest::keyClick(combo, Qt::Key_Down);  // No truth: neither errors nor distances.
    QCOMPARE(changed.size(), 2);
    QCOMPARE(controls.choice().coloring, CloudColoring::Source);
    controls.setOffers({.has_truth = true, .has_error = true, .other = "EPI_L"});
    QTest::keyClick(combo, Qt::Key_Up);
    QCOMPARE(controls.choice().coloring, CloudColoring::Error);
    QCOMPARE(controls.findChild<QComboBox*>("cloud.companion")->itemText(2), QString("EPI_L"));
  }

  void choiceAndLook_comeBackAsTheyWereSet() {
    CloudControls controls;
    const CloudChoice choice{.coloring = CloudColoring::Disparity,
                             .companion = CloudCompanion::Truth,
                             .is_beside = true,
                             .is_surface = true,
                             .jump_px = 0.25};
    const CloudLook look{
        .z_stretch = 10, .point_size = 3.5, .is_shaded = true, .clip_near = 0.25, .clip_far = 0.5};
    QSignalSpy changed(&controls, &CloudControls::choiceChanged);

    controls.setChoice(choice);
    controls.setLook(look);

    QCOMPARE(controls.choice(), choice);
    QCOMPARE(controls.look(), look);
    QCOMPARE(changed.size(), 0);
  }

  void nearAndFar_leaveSomethingBetween() {
    CloudControls controls;
    auto* near = controls.findChild<QSlider*>("cloud.near");
    auto* far = controls.findChild<QSlider*>("cloud.far");

    far->setValue(100);
    near->setValue(150);
    QVERIFY(controls.look().clip_near < controls.look().clip_far);
    QCOMPARE(near->value(), 150);
    far->setValue(0);
    QVERIFY(controls.look().clip_near < controls.look().clip_far);
    QCOMPARE(near->value(), 0);
  }

  void surfaceControls_areThereForSurfaces() {
    CloudControls controls;
    auto* surface = controls.findChild<QCheckBox*>("cloud.surface");
    auto* jump = controls.findChild<QWidget*>("cloud.jump");

    QVERIFY(!jump->isEnabled());
    surface->click();

    QVERIFY(jump->isEnabled());
    QVERIFY(controls.choice().is_surface);
  }
};

}  // namespace episcope::in_point_cloud_panel_test

EPISCOPE_WINDOW_TEST(point_cloud_panel_test, PointCloudPanelTest)
#include "point_cloud_panel_test.moc"
