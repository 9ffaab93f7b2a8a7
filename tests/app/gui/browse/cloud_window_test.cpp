// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/panes.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/cloud/point_cloud_panel.h"
#include "widgets/controls/theme.h"

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QElapsedTimer>
#include <QFile>
#include <QFileDialog>
#include <QImage>
#include <QLabel>
#include <QSettings>
#include <QSignalSpy>
#include <QTabWidget>

#include <algorithm>

// The 3D view in the window that ships, on a display.

namespace episcope::in_cloud_window_test {

namespace {

/// A window with a result of a small light field, at its 3D tab.
struct CloudFixture : WindowFixture {
  explicit CloudFixture(const std::string& id = "edge") {
    openSmall(id);
    runAndWait();
    trigger("tab.cloud");
    awaitPoints(96 * 96);
  }
  [[nodiscard]] PointCloudPanel& panel() const { return find<PointCloudPanel>(window); }
  [[nodiscard]] PointCloudView& view() const { return *panel().display().view(); }
  void awaitPoints(std::size_t points) const {
    QTRY_COMPARE_WITH_TIMEOUT(view().pointCount(), points, kPatience);
    QTRY_VERIFY(view().isVisible());
  }
  [[nodiscard]] QString summary() const {
    return panel().findChild<QLabel*>("cloud.summary")->text();
  }
  void choose(const char* combo, const QString& text) const {
    auto* box = panel().findChild<QComboBox*>(combo);
    const int index = box->findText(text);
    QVERIFY2(index >= 0, qPrintable(text));
    box->setCurrentIndex(index);
  }
};

int count(const QImage& image, QColor color) {
  int pixels = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) pixels += image.pixelColor(x, y) == color;
  }
  return pixels;
}

QPoint middle_of(const QWidget& widget) {
  return widget.rect().center();
}

}  // namespace

class CloudWindowTest : public QObject {
  Q_OBJECT

 private slots:
  void firstOpening_keepsTheNativeWindow();
  void click_movesTheCrossHair_andTheCrossHairIsMarked();
  void large_takesThePlaceOfTheView_andReturns();
  void otherArrangement_dismissesTheLargeView();
  void ownWindow_holdsTheViewWithItsControls();
  void choices_areRemembered();
  void surfaceAndTruth_areDrawn();
  void withoutAResult_theTruthIsSeen();
  void distance_isToldAsNumberAndColours();
  void whatIsNotSeen_isNotHeld();
  void export_writesWhatIsSeen();
  void manyPoints_moveFluently();
};

// A window that Qt makes anew vanishes for a moment, and takes the second half of a double click on
// the tab with it.
void CloudWindowTest::firstOpening_keepsTheNativeWindow() {
  WindowFixture f;
  f.openSmall();
  const WId native = f.window.winId();

  f.trigger("tab.cloud");

  const auto& view = *find<PointCloudPanel>(f.window).display().view();
  QTRY_COMPARE_WITH_TIMEOUT(view.pointCount(), std::size_t(96 * 96), kPatience);
  QTRY_VERIFY(view.isVisible());
  QCOMPARE(f.window.winId(), native);
}

void CloudWindowTest::click_movesTheCrossHair_andTheCrossHairIsMarked() {
  CloudFixture f;
  auto& session = f.window.bench().session;
  f.click("cloud.front");
  session.set_cross_hair({5, 5});
  QTRY_VERIFY(count(f.view().grabFramebuffer(), theme::kCrossHair) > 10);

  QTest::mouseClick(&f.view(), Qt::LeftButton, {}, middle_of(f.view()));
  QVERIFY(std::abs(session.cross_hair().x - 48) < 6);
  QVERIFY(std::abs(session.cross_hair().y - 48) < 6);

  // Where the canvas is clicked, the mark follows.
  const QImage before = f.view().grabFramebuffer();
  f.press({20, 70});
  f.release({20, 70});
  QTRY_COMPARE(session.cross_hair(), (PixelIndex{20, 70}));
  QTRY_VERIFY(f.view().grabFramebuffer() != before);
}

void CloudWindowTest::large_takesThePlaceOfTheView_andReturns() {
  CloudFixture f;
  const int small = f.view().width();

  f.trigger("cloud.large");
  QVERIFY(!f.canvas()->isVisible());
  QTRY_VERIFY(f.view().isVisible() && f.view().width() > small + 200);
  QVERIFY(count(f.view().grabFramebuffer(), theme::kCanvas) < f.view().width() * f.view().height());
  f.trigger("tab.compare");  // it stays on screen, whatever tab is shown
  QVERIFY(f.view().isVisible());
  QVERIFY(QSettings().value("cloud/large").toBool());
  QVERIFY(f.window.bench().commands.find("cloud.large")->isChecked());

  f.trigger("cloud.large");
  QVERIFY(f.canvas()->isVisible());
  f.trigger("tab.cloud");
  QTRY_VERIFY(f.view().isVisible() && f.view().width() < small + 50);
  QCOMPARE(f.view().pointCount(), std::size_t(96 * 96));
}

void CloudWindowTest::otherArrangement_dismissesTheLargeView() {
  CloudFixture f;
  f.trigger("cloud.large");
  QVERIFY(!f.canvas()->isVisible());

  f.trigger("panes.reset");
  QVERIFY(f.canvas()->isVisible());
  QVERIFY(!f.window.bench().commands.find("cloud.large")->isChecked());
}

void CloudWindowTest::ownWindow_holdsTheViewWithItsControls() {
  CloudFixture f;
  f.trigger("tab.compare");
  f.trigger("cloud.window");
  QCOMPARE(f.window.bench().frame.shownTab(), QString("compare"));  // which was in front
  QVERIFY(f.view().window() != &f.window);
  QCOMPARE(f.panel().window(), f.view().window());
  QTRY_VERIFY(f.view().isVisible());
  QTRY_VERIFY(count(f.view().grabFramebuffer(), theme::kCanvas) <
              f.view().width() * f.view().height());

  f.view().window()->close();
  QCOMPARE(f.view().window(), &f.window);
  QTRY_VERIFY(f.view().isVisible());
  QCOMPARE(f.window.bench().frame.shownTab(), QString("cloud"));
  QTRY_VERIFY(count(f.view().grabFramebuffer(), theme::kCanvas) <
              f.view().width() * f.view().height());
}

void CloudWindowTest::choices_areRemembered() {
  CloudFixture f;
  f.choose("cloud.coloring", "disparity");
  f.panel().findChild<QCheckBox*>("cloud.surface")->click();
  f.awaitPoints(96 * 96);

  MainWindow other;  // with the same settings
  other.resize(1000, 700);
  other.show();
  other.bench().frame.showTab("cloud");
  const CloudChoice choice = find<PointCloudPanel>(other).controls().choice();

  QCOMPARE(choice.coloring, CloudColoring::Disparity);
  QVERIFY(choice.is_surface);
}

void CloudWindowTest::surfaceAndTruth_areDrawn() {
  CloudFixture f;
  const QImage points = f.view().grabFramebuffer();
  f.panel().findChild<QCheckBox*>("cloud.surface")->click();
  QTRY_VERIFY(f.view().grabFramebuffer() != points);

  f.choose("cloud.companion", "the ground truth");
  f.choose("cloud.coloring", "one each");
  f.choose("cloud.arrangement", "side by side");
  f.awaitPoints(2 * 96 * 96);
  f.click("cloud.front");
  const QImage both = f.view().grabFramebuffer();

  const auto color = [](int i) {
    return QColor(kSourceColors[i][0], kSourceColors[i][1], kSourceColors[i][2]);
  };
  const QRect left(0, 0, both.width() / 2 - 10, both.height());
  const QRect right(both.width() / 2 + 10, 0, both.width() / 2 - 10, both.height());
  QVERIFY(count(both.copy(left), color(0)) > 500);
  QCOMPARE(count(both.copy(left), color(1)), 0);
  QVERIFY(count(both.copy(right), color(1)) > 500);
  QVERIFY(f.summary().contains("ground truth"));
}

void CloudWindowTest::withoutAResult_theTruthIsSeen() {
  WindowFixture f;
  f.openSmall();
  f.trigger("tab.cloud");
  auto& panel = find<PointCloudPanel>(f.window);
  QTRY_COMPARE_WITH_TIMEOUT(panel.display().view()->pointCount(), std::size_t{96 * 96}, kPatience);
  const auto* summary = panel.findChild<QLabel*>("cloud.summary");
  QTRY_VERIFY2(summary->text().startsWith("Ground truth: "), qPrintable(summary->text()));
  auto* colors = panel.findChild<QComboBox*>("cloud.coloring");
  const QImage in_colors = panel.display().view()->grabFramebuffer();
  colors->setCurrentIndex(colors->findText("disparity"));
  QTRY_VERIFY_WITH_TIMEOUT(panel.display().view()->grabFramebuffer() != in_colors, kPatience);
  f.trigger("tab.estimate");
  f.runAndWait();
  f.trigger("tab.cloud");
  QTRY_VERIFY2_WITH_TIMEOUT(summary->text().startsWith("EPI"), qPrintable(summary->text()),
                            kPatience);
  Session& session = f.window.bench().session;
  session.set_live({0, "Live", session.shown()->estimate, {}}, session.generation());
  QTRY_VERIFY2_WITH_TIMEOUT(summary->text().startsWith("Live"), qPrintable(summary->text()),
                            kPatience);
}

void CloudWindowTest::distance_isToldAsNumberAndColours() {
  CloudFixture f;
  QVERIFY(!f.summary().contains("mean"));

  f.choose("cloud.coloring", "distance");

  QTRY_VERIFY_WITH_TIMEOUT(f.summary().contains("mean"), kPatience);
  QVERIFY(f.summary().contains("nearest of the ground truth"));
  const auto [red, green, blue] = render::color_map("viridis").colors[255];
  QTRY_VERIFY(count(f.view().grabFramebuffer(), QColor(red, green, blue)) > 10);  // color bar
}

void CloudWindowTest::whatIsNotSeen_isNotHeld() {
  CloudFixture f;
  f.trigger("tab.compare");
  QSignalSpy frames(&f.view(), &OffscreenGl::frameDrawn);

  f.window.bench().session.set_view({4, 5});
  QTRY_COMPARE(f.view().pointCount(), std::size_t(0));
  for (int i = 0; i < 20; ++i) f.window.bench().session.set_cross_hair({i, i});
  QTest::qWait(300);
  QCOMPARE(frames.size(), 0);

  f.window.bench().session.set_view({4, 4});
  f.trigger("tab.cloud");
  f.awaitPoints(96 * 96);
}

void CloudWindowTest::export_writesWhatIsSeen() {
  CloudFixture f;
  f.panel().findChild<QCheckBox*>("cloud.surface")->click();
  f.choose("cloud.companion", "the ground truth");
  f.awaitPoints(2 * 96 * 96);
  f.trigger("cloud.export");
  auto* dialog = f.window.findChild<QFileDialog*>("export_cloud");
  QVERIFY(dialog);
  dialog->selectFile(f.path("seen.ply"));
  static_cast<QDialog*>(dialog)->accept();

  QFile file(f.path("seen.ply"));
  QTRY_VERIFY_WITH_TIMEOUT(file.exists(), kPatience);
  QVERIFY(file.open(QIODevice::ReadOnly));
  const QByteArray head = file.read(500);
  QVERIFY(head.contains("element vertex 18432\n"));
  QVERIFY(head.contains("element face "));
}

// Twenty frames a second are fluent; how many there are depends on the machine.
void CloudWindowTest::manyPoints_moveFluently() {
  WindowFixture f;
  scenes::RenderOptions options;
  options.grid = {3, 3};
  options.height = options.width = 768;
  f.openScene("edge", options);
  f.runAndWait();
  f.trigger("tab.cloud");
  f.trigger("cloud.large");
  auto& view = *find<PointCloudPanel>(f.window).display().view();
  QTRY_COMPARE_WITH_TIMEOUT(view.pointCount(), std::size_t(768 * 768), kScenePatience);
  QTRY_VERIFY(view.isVisible());
  const auto frame_ms = [&view] {
    QElapsedTimer timer;
    timer.start();
    (void)view.grabFramebuffer();
    return timer.elapsed();
  };
  std::vector<qint64> all_ms;
  for (int i = 0; i < 5; ++i) all_ms.push_back(frame_ms());
  QTest::mousePress(&view, Qt::LeftButton, {}, middle_of(view));
  std::vector<qint64> times_ms;
  for (int i = 0; i < 20; ++i) {
    QTest::mouseMove(&view, middle_of(view) + QPoint(4 * i, i));
    times_ms.push_back(frame_ms());
  }
  QTest::mouseRelease(&view, Qt::LeftButton, {}, middle_of(view));
  std::ranges::sort(times_ms);
  std::ranges::sort(all_ms);
  qInfo("768×768 points: a frame takes %lld ms, while moving %lld ms (medians)",
        static_cast<long long>(all_ms[2]), static_cast<long long>(times_ms[10]));
  QVERIFY(!view.isMoving() || times_ms[10] < all_ms[2]);
  QTRY_VERIFY(!view.isMoving());
}

}  // namespace episcope::in_cloud_window_test

EPISCOPE_WINDOW_TEST(cloud_window_test, CloudWindowTest)
#include "cloud_window_test.moc"
