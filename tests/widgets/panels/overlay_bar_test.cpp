// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/panels/overlay_bar.h"
#include "tests/window_test_main.h"
#include "widgets/panels/color_bar.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QSignalSpy>
#include <QSlider>
#include <QToolButton>

#include <cmath>

namespace episcope::in_overlay_bar_test {

using render::Quantity;

class OverlayBarTest : public QObject {
  Q_OBJECT

 private slots:
  void unavailableQuantities_cannotBeChosen() {
    OverlayBar bar;
    bar.setAvailable({Quantity::Disparity, Quantity::BadPixels});
    QSignalSpy selected(&bar, &OverlayBar::quantitySelected);
    auto* combo = bar.findChild<QComboBox*>("overlay.quantity");

    QTest::keyClick(combo, Qt::Key_Down);
    QTest::keyClick(combo, Qt::Key_Down);

    QCOMPARE(selected.size(), 2);
    QCOMPARE(selected[0][0].value<Quantity>(), Quantity::Disparity);
    QCOMPARE(selected[1][0].value<Quantity>(), Quantity::BadPixels);
  }

  void nextQuantity_goesAroundTheAvailableOnes() {
    OverlayBar bar;
    bar.setAvailable({Quantity::Truth, Quantity::SignedError});
    std::vector<Quantity> seen;

    for (int i = 0; i < 3; ++i) {
      bar.selectNextQuantity();
      seen.push_back(bar.quantity());
    }

    QVERIFY(seen == (std::vector{Quantity::Truth, Quantity::SignedError, Quantity::View}));
  }

  void setters_doNotEmit() {
    OverlayBar bar;
    QSignalSpy quantity(&bar, &OverlayBar::quantitySelected);
    QSignalSpy opacity(&bar, &OverlayBar::opacityChanged);
    QSignalSpy focus(&bar, &OverlayBar::focusChanged);

    bar.setAvailable({Quantity::Truth});
    bar.setQuantity(Quantity::Truth);
    bar.setOpacity(0.25);
    bar.setFocusRange({-1, 3});
    bar.setFocus(1.5);

    QCOMPARE(quantity.size() + opacity.size() + focus.size(), 0);
    QCOMPARE(bar.quantity(), Quantity::Truth);
    QCOMPARE(bar.opacity(), 0.25);
    QCOMPARE(bar.focus(), 1.5);
  }

  void focus_isMovedBySliderSpinAndReset() {
    OverlayBar bar;
    bar.setFocusRange({-2, 2});
    QSignalSpy focus(&bar, &OverlayBar::focusChanged);
    auto* slider = bar.findChild<QSlider*>("overlay.focusSlider");
    auto* spin = bar.findChild<QDoubleSpinBox*>("overlay.focusSpin");

    slider->setValue(42);
    QCOMPARE(focus.last()[0].toDouble(), 0.42);
    QCOMPARE(spin->value(), 0.42);
    spin->setValue(-1.5);
    QCOMPARE(focus.last()[0].toDouble(), -1.5);
    QCOMPARE(slider->value(), -150);
    bar.findChild<QToolButton*>("overlay.focusReset")->click();
    QCOMPARE(focus.last()[0].toDouble(), 0.0);
    QCOMPARE(focus.size(), 3);
    bar.stepFocus(100);
    QCOMPARE(bar.focus(), 5.0);  // the range is where the slider begins to reach
    QCOMPARE(slider->value(), 500);
  }

  void colorBar_tellsEditedRanges() {
    ColorBar bar;
    bar.setShading("disparity", "px", {render::color_map("viridis"), {-1, 2}});
    QSignalSpy edited(&bar, &ColorBar::rangeEdited);
    auto* min = bar.findChild<QDoubleSpinBox*>("colorBar.min");
    auto* max = bar.findChild<QDoubleSpinBox*>("colorBar.max");

    max->setValue(4);
    QCOMPARE(edited.size(), 1);
    QVERIFY(edited[0][0].value<Interval>() == (Interval{-1, 4}));
    min->setValue(7);
    const auto pushed = edited.last()[0].value<Interval>();
    QCOMPARE(pushed.min, 7.0);
    QVERIFY(pushed.max > 7);
    QCOMPARE(bar.range(), pushed);
  }

  void colorBar_locksAndAsksForRanges() {
    ColorBar bar;
    QSignalSpy automatic(&bar, &ColorBar::automaticRangeRequested);
    QSignalSpy own(&bar, &ColorBar::ownRangeRequested);

    bar.findChild<QToolButton*>("colorBar.lock")->click();
    bar.findChild<QToolButton*>("colorBar.automatic")->click();
    bar.findChild<QToolButton*>("colorBar.own")->click();

    QVERIFY(bar.isRangeLocked());
    QCOMPARE(automatic.size(), 1);
    QCOMPARE(own.size(), 1);
  }

  void ramp_showsTheColourMapFromLowToHigh() {
    ColorRamp ramp;
    const auto map = render::color_map("viridis");
    ramp.setShading({map, {-1, 1}});
    ramp.resize(258, 20);

    const QImage shown = ramp.grab().toImage();

    const auto is_color = [&](int x, int index) {
      const auto [red, green, blue] = map.colors[index];
      const QColor color = shown.pixelColor(x, 10);
      // One step of the map either way.
      return std::abs(color.red() - red) + std::abs(color.green() - green) +
                 std::abs(color.blue() - blue) <=
             12;
    };
    QVERIFY(is_color(2, 1));
    QVERIFY(is_color(129, 128));
    QVERIFY(is_color(255, 254));
  }
};

}  // namespace episcope::in_overlay_bar_test

EPISCOPE_WINDOW_TEST(overlay_bar_test, OverlayBarTest)
#include "overlay_bar_test.moc"
