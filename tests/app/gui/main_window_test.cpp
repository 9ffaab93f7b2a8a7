// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/main_window.h"

#include "app/gui/shell/jobs.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/message_bar.h"
#include "widgets/panels/info_panel.h"
#include "widgets/panels/overlay_bar.h"
#include "widgets/panels/segment_panel.h"

#include <QAction>
#include <QScrollArea>
#include <QScrollBar>
#include <QTabWidget>
#include <QThreadPool>
#include <QToolBar>

#include <sys/resource.h>

#include <latch>
#include <mutex>
#include <set>
#include <thread>

namespace episcope::in_main_window_test {

namespace {

// However quick the machine is, another one is still running and keeps it waiting.
void begin_run_that_waits(WindowFixture& f) {
  f.window.bench().jobs.start<int>(
      Lane::Estimate, "endless",
      [](const Progress& progress) -> int {
        while (true) progress.check();
      },
      [](int) {});
  f.trigger("estimate.run");
  QCOMPARE(f.window.bench().jobs.count(), 2);
}

}  // namespace

class MainWindowTest : public QObject {
  Q_OBJECT

 private slots:
  void emptyWindow_saysWhatToDo();
  void formOfTheFirstMethod_isSeenWhole();
  void escape_cancelsTheRun();
  void runThatTookLong_isAskedForBeforeItEnds_data();
  void runThatTookLong_isAskedForBeforeItEnds();
  void largerWindow_givesItsRoomToTheView();
  void smallWindow_showsEveryButton();
  void threadsThatDraw_haveThePriorityOfTheWindow();
};

void MainWindowTest::emptyWindow_saysWhatToDo() {
  WindowFixture f;

  QCOMPARE(f.window.bench().viewer_area.canvas()->state(), ViewCanvas::State::Empty);
  QVERIFY(!f.window.bench().commands.find("estimate.run")->isEnabled());
  QVERIFY(!f.window.bench().commands.find("overlay.error")->isEnabled());
  QVERIFY(f.window.findChild<SegmentPanel*>()->state().isEmpty());  // nothing to segment
}

void MainWindowTest::formOfTheFirstMethod_isSeenWhole() {
  WindowFixture f;
  f.openSmall();

  const auto* scroll = f.window.findChild<QScrollArea*>("method.scroll");

  QTRY_COMPARE_WITH_TIMEOUT(scroll->verticalScrollBar()->maximum(), 0, kPatience);
  // Nor is room wasted under it.
  QVERIFY(scroll->viewport()->height() < scroll->widget()->sizeHint().height() + 40);
}

void MainWindowTest::escape_cancelsTheRun() {
  WindowFixture f;
  f.openSmall();
  auto* canvas = f.window.bench().viewer_area.canvas();
  canvas->setFocus();
  f.window.activateWindow();
  begin_run_that_waits(f);

  QTest::keyClick(canvas, Qt::Key_Escape);
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 1, kPatience);
  QTest::keyClick(canvas, Qt::Key_Escape);
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 0, kPatience);

  QVERIFY(f.window.bench().session.estimates().empty());
  QCOMPARE(f.window.findChild<MessageBar*>("messageBar")->text(),
           QString("endless was cancelled at 0 %."));
}

void MainWindowTest::runThatTookLong_isAskedForBeforeItEnds_data() {
  QTest::addColumn<QString>("button");
  QTest::newRow("button of the method") << "method.cancel";
  QTest::newRow("button of the job") << "job.%1.cancel";
}

void MainWindowTest::runThatTookLong_isAskedForBeforeItEnds() {
  QFETCH(QString, button);
  WindowFixture f;
  f.openSmall();
  begin_run_that_waits(f);
  Jobs& jobs = f.window.bench().jobs;
  f.window.bench().job_cancel.setWorthAsking(0);
  const quint64 run = jobs.newest(f.window.bench().session.generation())->id;
  button = button.replace("%1", QString::number(run));
  const auto* messages = f.window.findChild<MessageBar*>("messageBar");
  QTRY_VERIFY(f.window.findChild<QWidget*>(button)->isVisible());

  f.click(button);
  QVERIFY2(messages->text().startsWith("EPI_L · edge is at 0 %"), qPrintable(messages->text()));
  QVERIFY(!jobs.find(run)->is_cancelling);
  f.click(button);

  QTRY_VERIFY_WITH_TIMEOUT(!jobs.find(run), kPatience);
  QCOMPARE(messages->text(), QString("EPI_L · edge was cancelled at 0 %."));
}

void MainWindowTest::largerWindow_givesItsRoomToTheView() {
  WindowFixture f;
  f.openSmall();
  const int side = f.window.findChild<InfoPanel*>()->width();
  const int tabs = f.window.findChild<QTabWidget*>()->width();
  const int view = f.window.bench().viewer_area.canvas()->width();

  f.window.resize(2560, 1440);

  const auto* canvas = f.window.bench().viewer_area.canvas();
  // The picture is square: what is left beside it goes to the EPI.
  QTRY_VERIFY_WITH_TIMEOUT(canvas->width() > view + 700 && canvas->height() > 1200, kPatience);
  const int column = f.window.findChild<InfoPanel*>()->width();
  QVERIFY(column > side && column < side + 120);  // its texts are seen whole
  QCOMPARE(f.window.findChild<QTabWidget*>()->width(), tabs);
}

void MainWindowTest::smallWindow_showsEveryButton() {
  WindowFixture f;
  f.openSmall();
  f.window.bench().viewer_area.overlayBar()->setFocusRange({-30, 30});  // wide numbers
  for (int job = 0; job < 10; ++job) f.window.findChild<JobPanel*>()->addJob(100 + job, "EPI_L");
  f.window.resize(1280, 800);
  QCoreApplication::processEvents();

  QVERIFY2(f.window.minimumSizeHint().height() <= 800,
           qPrintable(QString::number(f.window.minimumSizeHint().height())));
  QVERIFY2(f.window.size() == QSize(1280, 800), qPrintable(QString::number(f.window.width())));
  const QToolBar* bar = f.window.findChild<QToolBar*>();
  for (QAction* action : bar->actions()) {
    const QWidget* button = bar->widgetForAction(action);
    QVERIFY2(button && button->isVisible(), qPrintable(action->objectName()));
    QVERIFY2(bar->rect().contains(button->geometry()), qPrintable(action->objectName()));
  }
}

// Whoever gives them work: Qt's own would have that of the thread that needed them first.
void MainWindowTest::threadsThatDraw_haveThePriorityOfTheWindow() {
  const int own = getpriority(PRIO_PROCESS, 0);
  if (own >= 19) QSKIP("nothing is lower");
  WindowFixture f;
  QThreadPool& pool = *QThreadPool::globalInstance();
  const int count = pool.maxThreadCount();
  std::latch all(count);
  std::mutex mutex;
  std::multiset<int> priorities;

  std::jthread([&] {
    setpriority(PRIO_PROCESS, 0, own + 1);
    for (int i = 0; i < count; ++i) {
      pool.start([&] {
        all.arrive_and_wait();
        const std::scoped_lock lock(mutex);
        priorities.insert(getpriority(PRIO_PROCESS, 0));
      });
    }
  }).join();
  pool.waitForDone();

  QCOMPARE(priorities.size(), static_cast<std::size_t>(count));
  QCOMPARE(priorities.count(own), static_cast<std::size_t>(count));
}

}  // namespace episcope::in_main_window_test

EPISCOPE_WINDOW_TEST(main_window_test, MainWindowTest)
#include "main_window_test.moc"
