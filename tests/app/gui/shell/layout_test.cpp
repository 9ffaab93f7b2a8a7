// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/frame.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/canvas_geometry.h"
#include "widgets/canvas/epi_pane.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/message_bar.h"
#include "widgets/panels/value_bar.h"

#include <QAction>
#include <QDialog>
#include <QPointer>
#include <QProgressBar>
#include <QScreen>
#include <QSettings>
#include <QSplitter>
#include <QTabBar>
#include <QTabWidget>

// Nothing moves under the mouse, and everything fits the screen.

namespace episcope::in_layout_test {

namespace {

quint64 start_endless(Jobs& jobs) {
  return jobs.start<int>(
      Lane::Export, "endless",
      [](const Progress& progress) -> int {
        while (true) progress.check();
      },
      [](int) {});
}

QRect place_of(const QWidget& widget, const QWidget& window) {
  return {widget.mapTo(&window, QPoint()), widget.size()};
}

}  // namespace

class LayoutTest : public QObject {
  Q_OBJECT

 private slots:
  void message_movesNothing();
  void message_coversNoCaptionAtTheTop();
  void epis_takeTheDarkMarginsOfALargeWindow();
  void jobs_moveNothing();
  void twoJobs_fitASmallScreen();
  void longMessage_isSeenWhole();
  void firstWindow_fitsTheScreen();
  void dialogs_closeWithTheWindow();
  void panels_canBeHidden_andTheViewGetsTheirRoom();
  void fullScreen_isEnteredAndLeft();
  void everyTab_fitsTheSideOfASmallScreen();
  void tabsAndThoseBelowThem_fitASmallScreen();
  void tabThatComesLate_isSeenAmongTheOthers();
};

void LayoutTest::message_movesNothing() {
  WindowFixture f;
  f.openSmall();
  const QRect before = place_of(*f.canvas(), f.window);

  f.window.bench().messages.warn("Something to read, of some length.");
  QCoreApplication::processEvents();

  QVERIFY(f.window.findChild<MessageBar*>("messageBar")->isVisible());
  QCOMPARE(place_of(*f.canvas(), f.window), before);
}

void LayoutTest::panels_canBeHidden_andTheViewGetsTheirRoom() {
  WindowFixture f;
  f.openSmall();
  const auto* tabs = f.window.findChild<QTabWidget*>("tabs");
  const int width = f.canvas()->width();

  f.key(Qt::Key_F11, Qt::ShiftModifier);
  QVERIFY(!tabs->isVisible());
  QTRY_VERIFY(f.canvas()->width() > width + 300);
  f.key(Qt::Key_Left);  // keys work as before
  QTRY_VERIFY((f.view() == ViewIndex{4, 3}));

  f.trigger("tab.compare");  // who asks for a tab wants to see it
  QVERIFY(tabs->isVisible());
  f.key(Qt::Key_F11, Qt::ShiftModifier);
  f.key(Qt::Key_F11, Qt::ShiftModifier);
  QVERIFY(tabs->isVisible());
  QTRY_COMPARE(f.canvas()->width(), width);
}

void LayoutTest::fullScreen_isEnteredAndLeft() {
  WindowFixture f;
  f.openSmall();
  f.key(Qt::Key_F11);
  QVERIFY(f.window.isFullScreen());
  QVERIFY(f.window.bench().commands.find("view.full_screen")->isChecked());
  f.key(Qt::Key_F11);
  QVERIFY(!f.window.isFullScreen());
}

void LayoutTest::everyTab_fitsTheSideOfASmallScreen() {
  WindowFixture f;
  f.openSmall();
  for (const char* tab : {"tab.capture", "tab.sweep", "tab.errors"}) f.trigger(tab);  // come late
  const auto* tabs = f.window.findChild<QTabWidget*>("tabs");
  for (int i = 0; i < tabs->count(); ++i) {
    const int least = tabs->widget(i)->minimumSizeHint().width();
    QVERIFY2(least <= 380, qPrintable(QString("%1: %2").arg(tabs->tabText(i)).arg(least)));
  }
}

void LayoutTest::tabsAndThoseBelowThem_fitASmallScreen() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  const QSize small(1276, 740);
  f.window.resize(small);

  f.trigger("panes.stack.epi.horizontal");
  f.trigger("tab.sweep");
  f.click("sweep.run");  // the list of sweeps takes room, too
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 0, kScenePatience);
  for (const char* tab : {"tab.capture", "tab.errors", "tab.measure", "tab.cloud"}) f.trigger(tab);
  QCoreApplication::processEvents();

  QCOMPARE(f.window.size(), small);
}

// With an invisible tab behind it, Qt would move the others out of sight.
void LayoutTest::tabThatComesLate_isSeenAmongTheOthers() {
  WindowFixture f;
  f.openSmall();
  const auto* bar = f.window.findChild<QTabWidget*>("tabs")->tabBar();

  for (const char* tab : {"tab.sweep", "tab.errors", "tab.measure", "tab.capture"}) {
    f.trigger(tab);
    QCoreApplication::processEvents();

    QVERIFY2(bar->rect().contains(bar->tabRect(bar->currentIndex())), tab);
    QVERIFY2(bar->tabRect(0).left() <= 0, tab);  // no gap before the first
    QVERIFY2(bar->tabRect(bar->count() - 1).right() > bar->width() / 2, tab);
  }
}

void LayoutTest::message_coversNoCaptionAtTheTop() {
  WindowFixture f;
  f.openSmall();

  f.window.bench().messages.hint("Something was done.");
  QCoreApplication::processEvents();

  const QRect message = place_of(*f.window.findChild<MessageBar*>("messageBar"), f.window);
  const QRect view = place_of(*f.canvas(), f.window);
  QVERIFY(message.top() >= view.top() + caption_depth(QFontMetricsF(f.canvas()->font())));
  QVERIFY(message.intersects(view));
}

// Until the user divides the room.
void LayoutTest::epis_takeTheDarkMarginsOfALargeWindow() {
  WindowFixture f;
  f.openSmall();
  const auto* epi = f.window.bench().viewer_area.verticalEpi();
  const int first = epi->width();

  f.window.resize(2560, 1440);
  QTRY_VERIFY2(epi->width() > first + 100, qPrintable(QString::number(epi->width())));
  QVERIFY(f.canvas()->width() >= f.canvas()->height());       // the view loses nothing
  QVERIFY(f.canvas()->width() < 1.1 * f.canvas()->height());  // and is all that is left
  const int other = f.window.bench().viewer_area.horizontalEpi()->height();
  QVERIFY2(4 * other >= epi->width() - 4, qPrintable(QString::number(other)));
  QVERIFY(f.window.findChild<QSplitter*>("split.column")->width() > 280);
  f.window.resize(1280, 800);
  QTRY_COMPARE(epi->width(), first);

  auto* upper = f.window.findChild<QSplitter*>("split.upper");
  QTest::mousePress(upper->handle(1), Qt::LeftButton, {}, {2, 20});
  QTest::mouseMove(upper->handle(1), {-60, 20});
  QTest::mouseRelease(upper->handle(1), Qt::LeftButton, {}, {2, 20});
  const int dragged = epi->width();
  QVERIFY(dragged > first);
  f.window.resize(1400, 800);
  QCoreApplication::processEvents();
  QCOMPARE(epi->width(), dragged);
}

void LayoutTest::jobs_moveNothing() {
  WindowFixture f;
  f.openSmall();
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 0, kPatience);
  const auto* tabs = f.window.findChild<QTabWidget*>("tabs");
  const QRect before = place_of(*tabs, f.window);

  for (int i = 0; i < 4; ++i) start_endless(f.window.bench().jobs);
  QTest::qWait(50);

  QCOMPARE(f.window.findChild<JobPanel*>()->jobCount(), 4);
  QCOMPARE(place_of(*tabs, f.window), before);
  f.window.bench().jobs.cancelLane(Lane::Export);
}

void LayoutTest::twoJobs_fitASmallScreen() {
  WindowFixture f;
  f.openSmall();
  const QSize small(1280, 740);  // of 800, without panel and title
  f.window.resize(small);
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 0, kPatience);

  for (int i = 0; i < 2; ++i) start_endless(f.window.bench().jobs);

  const auto* panel = f.window.findChild<JobPanel*>();
  QTRY_COMPARE(panel->findChildren<QProgressBar*>().size(), 2);
  QCoreApplication::processEvents();
  QCOMPARE(f.window.size(), small);
  for (const QProgressBar* bar : panel->findChildren<QProgressBar*>()) {
    const QWidget* row = bar->parentWidget();
    QCOMPARE(row->visibleRegion().boundingRect(), row->rect());
  }
  f.window.bench().jobs.cancelLane(Lane::Export);
}

void LayoutTest::longMessage_isSeenWhole() {
  WindowFixture f;
  f.openSmall();
  auto* bar = f.window.findChild<MessageBar*>("messageBar");

  f.window.bench().messages.warn(QString("words and words ").repeated(40));
  QCoreApplication::processEvents();

  QVERIFY(bar->height() >= bar->heightForWidth(bar->width()));
  QVERIFY(bar->parentWidget()->rect().contains(bar->geometry()));
}

void LayoutTest::firstWindow_fitsTheScreen() {
  WindowFixture f;  // its settings know of no window
  MainWindow window;
  window.show();
  const QSize room = window.screen()->availableSize();

  QVERIFY2(window.frameSize().width() <= room.width(), qPrintable(QString::number(window.width())));
  QVERIFY(window.frameSize().height() <= room.height());
  const auto* values = window.findChild<ValueBar*>();
  QVERIFY(window.rect().contains(place_of(*values, window)));
}

void LayoutTest::dialogs_closeWithTheWindow() {
  WindowFixture f;
  f.trigger("help.keys");
  const QPointer<QDialog> keys = f.window.findChild<QDialog*>("shortcut_window");
  QVERIFY(keys && keys->isVisible());

  f.window.close();

  QVERIFY(!keys || !keys->isVisible());
}

}  // namespace episcope::in_layout_test

EPISCOPE_WINDOW_TEST(layout_test, LayoutTest)
#include "layout_test.moc"
