// SPDX-License-Identifier: BSD-3-Clause
#include "tests/window_test_main.h"
#include "widgets/cloud/point_cloud_panel.h"
#include "widgets/cloud/point_cloud_view.h"
#include "widgets/controls/theme.h"

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

    view_->setLook({.z_stretch = 2});

    QVERIFY(view_->grabFramebuffer() != before);
  }

  void resizing_keepsDrawing() {
    view_->setCloud(bump());

    view_->resize(500, 400);

    QTRY_COMPARE(view_->grabFramebuffer().size(), QSize(500, 400) * view_->devicePixelRatioF());
    QVERIFY(count(view_->grabFramebuffer(), Qt::red) > 5000);
  }

  void pointSize_coversMore() {
    PointCloud sparse;
    for (int i = 0; i < 100; ++i) {
      sparse.positions.push_back({float(i % 10), float(i / 10), 0});
      sparse.colors.push_back({255, 0, 0});
    }
    view_->setCloud(sparse);
    const int small = count(view_->grabFramebuffer(), Qt::red);

    view_->setLook({.point_size = 8});

    QVERIFY(count(view_->grabFramebuffer(), Qt::red) > 8 * small);
  }

  void clip_leavesOutWhatIsNearOrFar_forPickingToo() {
    const PointCloud cloud = bump();
    view_->setCloud(cloud);
    view_->showPreset(CloudPreset::Front);
    (void)view_->grabFramebuffer();
    QSignalSpy picked(view_.get(), &PointCloudView::pointPicked);

    view_->setLook({.clip_near = 0.5});
    const QImage without_bump = view_->grabFramebuffer();
    QTest::mouseClick(view_.get(), Qt::LeftButton, {}, {160, 120});
    view_->setLook({.clip_far = 0.5});
    const QImage bump_alone = view_->grabFramebuffer();
    QTest::mouseClick(view_.get(), Qt::LeftButton, {}, {160, 20});

    QCOMPARE(count(without_bump, Qt::green), 0);
    QVERIFY(count(without_bump, Qt::red) > 5000);
    QCOMPARE(count(bump_alone, Qt::red), 0);
    QVERIFY(count(bump_alone, Qt::green) > 500);
    QCOMPARE(picked.size(), 0);  // the bump is gone, then what is beside it
  }

  void surface_hidesWhatIsBehindIt() {
    PointCloud cloud = bump();  // of points, with a gap of several pixels between them
    const auto at = [](int y, int x) { return std::uint32_t(81 * y + x); };
    for (int y = 0; y < 80; ++y) {
      for (int x = 0; x < 80; ++x) {
        cloud.triangles.push_back({at(y, x), at(y, x + 1), at(y + 1, x + 1)});
        cloud.triangles.push_back({at(y, x), at(y + 1, x + 1), at(y + 1, x)});
      }
    }
    view_->resize(800, 600);
    view_->setCloud(cloud);
    view_->showPreset(CloudPreset::Front);

    const QImage shown = view_->grabFramebuffer();

    const QRect within(shown.width() / 2 - 150, shown.height() / 2 - 150, 300, 300);
    QCOMPARE(count(shown.copy(within), theme::kCanvas), 0);
    view_->setLook({.is_shaded = true});
    QVERIFY(view_->grabFramebuffer() != shown);
  }

  void mark_isSeenWhateverIsInFront() {
    PointCloud cloud = bump();
    for (int i = 0; i < 81 * 81; ++i) cloud.pixels.push_back({i / 81, i % 81});
    view_->setCloud(cloud);
    view_->showPreset(CloudPreset::Side);  // the bump hides what is behind it
    QCOMPARE(count(view_->grabFramebuffer(), theme::kCrossHair), 0);

    view_->setMarkedPixel(PixelIndex{40, 4});
    QVERIFY(count(view_->grabFramebuffer(), theme::kCrossHair) > 20);
    view_->setMarkedPixel(PixelIndex{400, 4});
    QCOMPARE(count(view_->grabFramebuffer(), theme::kCrossHair), 0);
  }

  void legend_showsItsColoursAndComesAndGoes() {
    view_->resize(400, 300);
    view_->setCloud(bump());
    const QImage before = view_->grabFramebuffer();

    view_->setLegend("disparity [px]", {render::color_map("viridis"), {-1, 2}});
    const QImage with = view_->grabFramebuffer();
    view_->setLegend({});

    const auto [red, green, blue] = render::color_map("viridis").colors[255];
    QVERIFY(count(with, QColor(red, green, blue)) > 10);
    QCOMPARE(view_->grabFramebuffer(), before);
  }

  void parts_arePickedApart() {
    auto parts = std::make_shared<CloudParts>();
    parts->push_back({bump(), {}});
    PointCloud right = bump();
    for (auto& position : right.positions) position[0] += 90;
    parts->push_back({right, {}});
    view_->setParts(parts);
    view_->showPreset(CloudPreset::Front);
    (void)view_->grabFramebuffer();
    QSignalSpy picked(view_.get(), &PointCloudView::pointPicked);

    QTest::mouseClick(view_.get(), Qt::LeftButton, {}, {90, 120});
    QTest::mouseClick(view_.get(), Qt::LeftButton, {}, {230, 120});

    QCOMPARE(picked.size(), 2);
    QCOMPARE(picked[0][1].value<std::size_t>(), std::size_t(0));
    QCOMPARE(picked[1][1].value<std::size_t>(), std::size_t(1));
  }

  void manyPoints_areFewWhileMoving_andAllWhenStill() {
    const auto grid = [](int side, float pitch) {
      PointCloud cloud;
      for (int i = 0; i < side * side; ++i) {
        cloud.positions.push_back({pitch * float(i % side), pitch * float(i / side), 0});
        cloud.colors.push_back({255, 0, 0});
      }
      return cloud;
    };
    auto parts = std::make_shared<CloudParts>();
    parts->push_back({grid(1600, 1), grid(40, 40)});
    view_->resize(900, 700);
    view_->setParts(parts);
    view_->showPreset(CloudPreset::Front);
    const QImage all = view_->grabFramebuffer();  // takes long enough to be reduced
    QCOMPARE(view_->pointCount(), std::size_t(1600 * 1600));

    QTest::mousePress(view_.get(), Qt::LeftButton, {}, {160, 120});
    QTest::mouseMove(view_.get(), {170, 121});
    if (!view_->isMoving()) QSKIP("this machine draws 2.5 million points fluently");
    const QImage moving = view_->grabFramebuffer();
    QTest::mouseRelease(view_.get(), Qt::LeftButton, {}, {170, 121});

    QVERIFY(2 * count(moving, Qt::red) < count(all, Qt::red));
    QTRY_VERIFY(!view_->isMoving());
    QVERIFY(count(view_->grabFramebuffer(), Qt::red) > 2 * count(moving, Qt::red));
  }

  void nothingIsDrawn_whileNothingChanges() {
    view_->setCloud(bump());
    QTRY_VERIFY(!view_->isMoving());
    QTest::qWait(400);
    QSignalSpy frames(view_.get(), &OffscreenGl::frameDrawn);

    QTest::qWait(500);

    QCOMPARE(frames.size(), 0);
  }

  void reparenting_keepsTheCloud() {
    view_->setCloud(bump());
    (void)view_->grabFramebuffer();
    QMainWindow window;
    window.resize(400, 300);
    auto* view = view_.release();

    window.setCentralWidget(view);
    window.show();

    QVERIFY(QTest::qWaitForWindowExposed(&window));
    QVERIFY(count(view->grabFramebuffer(), Qt::red) > 5000);
    QVERIFY(count(window.grab().toImage(), Qt::red) > 5000);
  }

  void preset_fillsAnotherSize_untilItIsTurned() {
    view_->resize(200, 400);
    view_->setLook({.point_size = 8});  // without gaps
    view_->setCloud(bump());
    view_->showPreset(CloudPreset::Front);
    (void)view_->grabFramebuffer();
    const auto fills = [&] {
      const QImage shown = view_->grabFramebuffer();
      return count(shown, theme::kCanvas) < shown.width() * shown.height() / 3;
    };

    view_->resize(400, 400);
    QTRY_VERIFY(fills());
    QTest::mousePress(view_.get(), Qt::MiddleButton, {}, {160, 120});
    QTest::mouseMove(view_.get(), {165, 120});
    QTest::mouseRelease(view_.get(), Qt::MiddleButton, {}, {165, 120});
    view_->resize(1000, 400);
    QTRY_COMPARE(view_->grabFramebuffer().width(), 1000 * view_->devicePixelRatioF());
    QVERIFY(!fills());
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
    auto parts = std::make_shared<CloudParts>();
    parts->push_back({bump(), {}});
    panel.display().setParts(parts, {});
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
