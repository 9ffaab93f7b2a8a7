// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/cloud/point_cloud_view.h"
#include "tests/window_test_main.h"
#include "widgets/cloud/point_cloud_panel.h"
#include "widgets/style/theme.h"

#include <QMainWindow>
#include <QSignalSpy>
#include <QSlider>
#include <QToolButton>

#include <cmath>
#include <memory>

namespace episcope::in_point_cloud_view_test {

namespace {

/// A square of red points with a green bump in the middle.
PointCloud bump() {
  PointCloud cloud;
  for (int y = -40; y <= 40; ++y) {
    for (int x = -40; x <= 40; ++x) {
      const bool is_bump = x * x + y * y < 200;
      cloud.positions.push_back({float(x), float(y), is_bump ? 25.0f : 0.0f});
      cloud.colors.push_back(is_bump ? std::array<std::uint8_t, 3>{0, 255, 0}
                                     : std::array<std::uint8_t, 3>{255, 0, 0});
    }
  }
  return cloud;
}

int count(const QImage& image, QColor color) {
  int pixels = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) pixels += image.pixelColor(x, y) == color;
  }
  return pixels;
}

}  // namespace

class PointCloudViewTest : public QObject {
  Q_OBJECT

  std::unique_ptr<PointCloudView> view_;

 private slots:
  void init() {
    view_ = std::make_unique<PointCloudView>();
    view_->resize(320, 240);
    view_->show();
    QVERIFY(QTest::qWaitForWindowExposed(view_.get()));
  }
  void cleanup() { view_.reset(); }

  void emptyView_showsTheBackdrop() {
    const QImage shown = view_->grabFramebuffer();

    QCOMPARE(count(shown, theme::kCanvas), shown.width() * shown.height());
  }

  void cloud_isDrawnInItsColours() {
    view_->setCloud(bump());

    const QImage shown = view_->grabFramebuffer();

    QCOMPARE(view_->pointCount(), std::size_t(81 * 81));
    QVERIFY(count(shown, Qt::red) > 5000);
    QVERIFY(count(shown, Qt::green) > 500);
    QVERIFY(count(shown, Qt::black) == 0);
  }

  void click_picksThePointUnderIt() {
    const PointCloud cloud = bump();
    view_->setCloud(cloud);
    view_->showPreset(CloudPreset::Front);
    (void)view_->grabFramebuffer();
    QSignalSpy picked(view_.get(), &PointCloudView::pointPicked);

    QTest::mouseClick(view_.get(), Qt::LeftButton, {}, {160, 120});
    QCOMPARE(picked.size(), 1);
    const auto middle = cloud.positions[picked[0][0].value<std::size_t>()];
    QVERIFY(std::hypot(middle[0], middle[1]) < 4 && middle[2] == 25);

    QTest::mouseClick(view_.get(), Qt::LeftButton, {}, {160, 40});
    QCOMPARE(picked.size(), 2);
    const auto upper = cloud.positions[picked[1][0].value<std::size_t>()];
    QVERIFY(std::abs(upper[0]) < 4 && upper[1] > 20 && upper[2] == 0);
  }

  void dragsAndClicksBesideTheCloud_pickNothing() {
    view_->setCloud(bump());
    view_->showPreset(CloudPreset::Front);
    (void)view_->grabFramebuffer();
    QSignalSpy picked(view_.get(), &PointCloudView::pointPicked);

    QTest::mouseClick(view_.get(), Qt::LeftButton, {}, {4, 120});
    QTest::mousePress(view_.get(), Qt::LeftButton, {}, {160, 120});
    QTest::mouseMove(view_.get(), {180, 130});
    QTest::mouseRelease(view_.get(), Qt::LeftButton, {}, {180, 130});

    QCOMPARE(picked.size(), 0);
  }

  void presets_differAndFillTheWindow() {
    view_->setCloud(bump());
    view_->showPreset(CloudPreset::Front);
    const QImage front = view_->grabFramebuffer();
    view_->showPreset(CloudPreset::Side);
    const QImage side = view_->grabFramebuffer();

    QVERIFY(front != side);
    // Seen from the front, the square fills the height of the window but for a small border.
    const int x = front.width() / 2;
    QCOMPARE(front.pixelColor(x, 1), QColor(theme::kCanvas));
    QVERIFY(count(front.copy(x, front.height() / 8, 10, 10), Qt::red) > 20);
  }

  void drag_turnsAndWheelZooms() {
    view_->setCloud(bump());
    const QImage before = view_->grabFramebuffer();

    QTest::mousePress(view_.get(), Qt::LeftButton, {}, {160, 120});
    QTest::mouseMove(view_.get(), {220, 130});
    QTest::mouseRelease(view_.get(), Qt::LeftButton, {}, {220, 130});
    const QImage turned = view_->grabFramebuffer();
    QWheelEvent wheel({160, 120}, {160, 120}, {}, {0, 120}, Qt::NoButton, Qt::NoModifier,
                      Qt::NoScrollPhase, false);
    QApplication::sendEvent(view_.get(), &wheel);
    const QImage zoomed = view_->grabFramebuffer();

    QVERIFY(turned != before);
    QVERIFY(zoomed != turned);
    QVERIFY(count(zoomed, Qt::green) > count(turned, Qt::green));
  }

  void newCloud_keepsTheCamera() {
    view_->setCloud(bump());
    view_->showPreset(CloudPreset::Side);
    const QImage before = view_->grabFramebuffer();

    view_->setCloud(bump());

    QCOMPARE(view_->grabFramebuffer(), before);
  }

  void stretch_deepensTheCloud() {
    view_->setCloud(bump());
    const QImage before = view_->grabFramebuffer();

    view_->setZStretch(2);

    QVERIFY(view_->grabFramebuffer() != before);
  }

  void resizing_keepsDrawing() {
    view_->setCloud(bump());

    view_->resize(500, 400);

    QTRY_COMPARE(view_->grabFramebuffer().size(), QSize(500, 400) * view_->devicePixelRatioF());
    QVERIFY(count(view_->grabFramebuffer(), Qt::red) > 5000);
  }

  void reparenting_keepsTheCloud() {
    view_->setCloud(bump());
    view_->grabFramebuffer();
    QMainWindow window;
    window.resize(400, 300);
    auto* view = view_.release();

    window.setCentralWidget(view);
    window.show();

    QVERIFY(QTest::qWaitForWindowExposed(&window));
    QVERIFY(count(view->grabFramebuffer(), Qt::red) > 5000);
    QVERIFY(count(window.grab().toImage(), Qt::red) > 5000);
  }

  void twoViews_drawTheirOwnClouds() {
    view_->setCloud(bump());
    PointCloudView other;
    other.resize(320, 240);
    other.show();
    QVERIFY(QTest::qWaitForWindowExposed(&other));
    PointCloud blue = bump();
    for (auto& color : blue.colors) color = {0, 0, 255};
    other.setCloud(blue);

    QVERIFY(count(other.grabFramebuffer(), Qt::blue) > 5000);
    QVERIFY(count(view_->grabFramebuffer(), Qt::red) > 5000);
    QCOMPARE(count(view_->grabFramebuffer(), Qt::blue), 0);
  }

  void panel_joinsControlsAndView() {
    PointCloudPanel panel;
    panel.resize(320, 300);
    panel.show();
    QVERIFY(QTest::qWaitForWindowExposed(&panel));
    QVERIFY(panel.isAvailable());
    panel.setCloud(bump());
    auto* view = panel.findChild<PointCloudView*>();
    QTRY_VERIFY(view->isVisible());
    const QImage tilted = view->grabFramebuffer();

    panel.findChild<QToolButton*>("cloud.front")->click();
    const QImage front = view->grabFramebuffer();
    panel.findChild<QSlider*>("cloud.stretch")->setValue(30);
    const QImage stretched = view->grabFramebuffer();

    QVERIFY(count(tilted, Qt::red) > 2000);
    QVERIFY(front != tilted);
    QVERIFY(stretched != front);
  }
};

}  // namespace episcope::in_point_cloud_view_test

EPISCOPE_WINDOW_TEST(point_cloud_view_test, PointCloudViewTest)
#include "point_cloud_view_test.moc"
