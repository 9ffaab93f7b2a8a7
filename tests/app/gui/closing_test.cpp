// SPDX-License-Identifier: BSD-3-Clause
// The window may be closed at any moment; whatever runs ends with it.
#include "app/gui/compare/compare_controller.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/jobs.h"
#include "app/session/session.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/view_canvas.h"

#include <QAction>

#include <memory>

namespace episcope::in_closing_test {

class ClosingTest : public QObject {
  Q_OBJECT

 private slots:
  void whileASceneLoads_data();
  void whileASceneLoads();
  void whileTheNextSceneLoads();
  void whileAMethodRuns();
  void whileTilesAreMade();
};

namespace {

scenes::RenderOptions mediumOptions() {
  scenes::RenderOptions options;
  options.height = options.width = 256;
  return options;
}

}  // namespace

// At several moments: before the file is read, in its midst, at the preview.
void ClosingTest::whileASceneLoads_data() {
  QTest::addColumn<int>("turns");
  for (const int turns : {0, 1, 2, 5, 20, 100}) QTest::addRow("turns %d", turns) << turns;
}

void ClosingTest::whileASceneLoads() {
  QFETCH(int, turns);
  auto f = std::make_unique<WindowFixture>();
  f->window.bench().opener.open(f->writeScene("slant", mediumOptions()));
  QCOMPARE(f->window.bench().jobs.count(), 1);

  for (int i = 0; i < turns && f->window.bench().jobs.count() > 0; ++i) {
    QCoreApplication::processEvents(QEventLoop::AllEvents);
  }
  f->window.close();
  f.reset();

  // What the loading thread had posted finds nobody, and harms nobody.
  QCoreApplication::processEvents(QEventLoop::AllEvents);
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
}

void ClosingTest::whileTheNextSceneLoads() {
  auto f = std::make_unique<WindowFixture>();
  f->openSmall();
  f->window.bench().opener.open(f->writeScene("slant", mediumOptions()));

  // The preview of the next scene over the former one.
  QTRY_VERIFY_WITH_TIMEOUT(f->window.bench().viewer_area.canvas()->picture().width() == 256,
                           kPatience);
  f.reset();
  QCoreApplication::processEvents(QEventLoop::AllEvents);
}

void ClosingTest::whileAMethodRuns() {
  auto f = std::make_unique<WindowFixture>();
  f->openSmall();
  f->window.bench().commands.find("estimate.run")->trigger();
  QVERIFY(f->window.bench().jobs.count() > 0);

  f.reset();
  QCoreApplication::processEvents(QEventLoop::AllEvents);
}

void ClosingTest::whileTilesAreMade() {
  auto f = std::make_unique<WindowFixture>();
  f->openSmall();
  f->runAndWait();
  QTRY_VERIFY_WITH_TIMEOUT(f->window.bench().commands.find("compare.tiles")->isEnabled(),
                           kPatience);

  find<CompareController>(f->window).setMode(CompareMode::Wall);
  f.reset();
  QCoreApplication::processEvents(QEventLoop::AllEvents);
}

}  // namespace episcope::in_closing_test

EPISCOPE_WINDOW_TEST(closing_test, ClosingTest)
#include "closing_test.moc"
