// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/files/file_controller.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"

#include <QFileDialog>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QToolButton>

// What somebody sees who starts the program for the first time.

namespace episcope::in_start_test {

namespace {

constexpr const char* kDemo = "demo?size=64&grid=3x3";

class Starting : public WindowFixture {
 public:
  QWidget* strip() { return window.findChild<QWidget*>("startStrip"); }
  void start() {
    window.start({kDemo});
    awaitDemo();
  }
  void awaitDemo() {
    QTRY_VERIFY_WITH_TIMEOUT(window.bench().session.scene(), kScenePatience);
    QTRY_VERIFY_WITH_TIMEOUT(!window.bench().session.estimates().empty(), kScenePatience);
  }
};

}  // namespace

class StartTest : public QObject {
  Q_OBJECT

 private slots:
  void strip_standsAboveTheDemo_untilAnOwnLightFieldIsOpened();
  void strip_opensFilesAndRecentInputs();
  void strip_leadsThroughTheSteps();
  void strip_isClosedByItsCross();
};

void StartTest::strip_standsAboveTheDemo_untilAnOwnLightFieldIsOpened() {
  Starting f;
  QVERIFY(!f.strip()->isVisible());
  f.window.start({kDemo});
  QVERIFY(f.strip()->isVisible());  // the demo may take a while
  f.awaitDemo();
  QVERIFY(f.strip()->isVisible());
  const QWidget& canvas = *f.window.bench().viewer_area.canvas();
  const QRect view(canvas.mapTo(&f.window, QPoint()), canvas.size());
  QVERIFY(!f.strip()->geometry().translated(f.strip()->parentWidget()->pos()).intersects(view));

  f.openSmall();

  QVERIFY(!f.strip()->isVisible());
  f.window.bench().opener.open(kDemo);
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().session.input(), std::string(kDemo), kScenePatience);
  QVERIFY(!f.strip()->isVisible());
}

void StartTest::strip_opensFilesAndRecentInputs() {
  Starting f;
  f.start();
  auto* recent = f.window.findChild<QPushButton*>("start.recent");
  QVERIFY(!recent->isEnabled());
  remember_recent(f.writeScene("edge", WindowFixture::smallOptions()));

  MainWindow again;  // with the same settings
  again.bench().opener.setCacheFolder({});
  again.show();
  again.start({kDemo});
  QTRY_VERIFY_WITH_TIMEOUT(again.bench().session.scene(), kScenePatience);
  recent = again.findChild<QPushButton*>("start.recent");
  QVERIFY(recent->isVisible() && recent->isEnabled());
  recent->menu()->actions().front()->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(!again.findChild<QWidget*>("startStrip")->isVisible(), kScenePatience);
  QTRY_COMPARE_WITH_TIMEOUT(again.bench().jobs.count(), 0, kScenePatience);
  f.click("start.open");
  QVERIFY(f.window.findChild<QFileDialog*>("open_file"));
}

void StartTest::strip_leadsThroughTheSteps() {
  Starting f;
  f.start();

  emit f.window.findChild<QLabel*>("start.steps")->linkActivated("tab.compare");

  QCOMPARE(f.window.bench().frame.shownTab(), QString("compare"));
}

void StartTest::strip_isClosedByItsCross() {
  Starting f;
  f.start();

  f.click("start.close");

  QVERIFY(!f.strip()->isVisible());
  f.runAndWait();
  QVERIFY(!f.strip()->isVisible());
}

}  // namespace episcope::in_start_test

EPISCOPE_WINDOW_TEST(start_test, StartTest)
#include "start_test.moc"
