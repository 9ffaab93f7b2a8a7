// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/panes.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/epi_pane.h"
#include "widgets/canvas/view_canvas.h"

#include <QAction>
#include <QMenu>
#include <QSettings>
#include <QSplitter>
#include <QTabBar>
#include <QTabWidget>
#include <QToolButton>

#include <tuple>

// Panes can be sized, torn off, and come back; the window remembers it.

namespace episcope::in_panes_test {

namespace {

QSplitter& splitter(const QWidget& window, const char* name) {
  auto* found = window.findChild<QSplitter*>(name);
  if (!found) qFatal("the window has no splitter %s", name);
  return *found;
}

/// Drags the handle before the second part of a splitter.
void drag_handle(QSplitter& splitter, QPoint by) {
  QWidget* handle = splitter.handle(1);
  const QPoint from = handle->rect().center();
  QTest::mousePress(handle, Qt::LeftButton, {}, from);
  QTest::mouseMove(handle, from + by);
  QTest::mouseRelease(handle, Qt::LeftButton, {}, from + by);
}

/// Whether the horizontal EPI is as wide as the view, and right below it.
bool is_epi_aligned(const WindowFixture& f) {
  const EpiPane& epi = *f.window.bench().viewer_area.horizontalEpi();
  return f.canvas()->mapTo(&f.window, QPoint()).x() == epi.mapTo(&f.window, QPoint()).x() &&
         f.canvas()->width() == epi.width();
}

}  // namespace

class PanesTest : public QObject {
  Q_OBJECT

 private slots:
  void epis_canBeOfAnyHeight();
  void view_andItsEpiStayAligned();
  void view_andItsEpiStayAligned_inEverySize();
  void epis_canBeTornOff_andComeBack();
  void tabs_canBeTornOff_andComeBackAtTheirPlace();
  void tornOffTab_makesWayForTheOneBefore();
  void tornOffPane_hearsTheKeysOfTheViewer();
  void layout_isRememberedAndReset();
  void panes_areStackedBelowTheTabs_andComeBack();
  void stack_takesHalfOfTheColumn_whereThereIsRoom();
  void stackedPane_mayBeTornOff();
  void stack_isRememberedAndReset();
  void pages_areThoseOfTheirTask();
  void page_mayBeDetachedAlone();
  void everyTab_isInTheList();
};

void PanesTest::epis_canBeOfAnyHeight() {
  WindowFixture f;
  f.openSmall();
  auto& epi = *f.window.bench().viewer_area.horizontalEpi();
  const int height = epi.height();

  drag_handle(splitter(f.window, "split.rows"), {0, -200});

  QVERIFY2(epi.height() > height + 150, qPrintable(QString::number(epi.height())));
  QVERIFY(epi.rowExtent() > 25);  // of nine views
  QVERIFY(f.canvas()->height() > 100);
}

void PanesTest::view_andItsEpiStayAligned() {
  WindowFixture f;
  f.openSmall();
  auto& viewer_area = f.window.bench().viewer_area;
  const auto is_aligned = [&f] { return is_epi_aligned(f); };
  QVERIFY(is_aligned());
  const int width = viewer_area.verticalEpi()->width();

  drag_handle(splitter(f.window, "split.upper"), {-120, 0});
  QVERIFY(viewer_area.verticalEpi()->width() > width + 80);
  QTRY_VERIFY(is_aligned());
  drag_handle(splitter(f.window, "split.lower"), {60, 0});
  QVERIFY(is_aligned());
  f.window.resize(1500, 900);
  QTRY_VERIFY(is_aligned());
  f.trigger("panes.epi.vertical");
  QTRY_VERIFY(is_aligned());  // the legend makes way
  f.trigger("panes.epi.vertical");
  QTRY_VERIFY(is_aligned());
}

void PanesTest::view_andItsEpiStayAligned_inEverySize() {
  WindowFixture f;
  f.openSmall();

  // Also before anything else happens: the next frame shows them as they are now.
  for (const QSize size : {QSize(700, 450), QSize(1000, 600), QSize(1280, 800)}) {
    f.window.resize(size);
    QVERIFY2(is_epi_aligned(f), qPrintable(QString::number(size.width())));
    QCoreApplication::processEvents();
    QVERIFY2(is_epi_aligned(f), qPrintable(QString::number(size.width())));
  }
}

void PanesTest::epis_canBeTornOff_andComeBack() {
  WindowFixture f;
  f.openSmall();
  auto* epi = f.window.bench().viewer_area.horizontalEpi();
  const int height = f.canvas()->height();
  const int epi_height = epi->height();

  f.trigger("panes.epi.horizontal");
  QVERIFY(epi->window() != &f.window && epi->isVisible());
  epi->window()->resize(700, 500);
  QTRY_COMPARE(epi->height(), 500);
  QVERIFY(f.window.bench().commands.find("panes.epi.horizontal")->isChecked());
  QTest::mouseClick(epi, Qt::LeftButton, {}, epi->rect().center());  // still moves the cross-hair
  QTRY_VERIFY(std::abs(f.window.bench().session.cross_hair().x - 48) < 20);

  epi->window()->close();
  QCOMPARE(epi->window(), &f.window);
  QTRY_COMPARE(epi->height(), epi_height);
  QCOMPARE(f.canvas()->height(), height);
  f.trigger("panes.epi.horizontal");
  QTRY_COMPARE(epi->window()->size(), QSize(700, 500));  // as it was left
  f.trigger("panes.epi.horizontal");
}

void PanesTest::tabs_canBeTornOff_andComeBackAtTheirPlace() {
  WindowFixture f;
  f.openSmall();
  auto* tabs = f.window.findChild<QTabWidget*>("tabs");
  Frame& frame = f.window.bench().frame;
  frame.showTab("compare");
  const int place = tabs->currentIndex();
  QWidget* compare = tabs->currentWidget();

  QTest::mouseDClick(tabs->tabBar(), Qt::LeftButton, {}, tabs->tabBar()->tabRect(place).center());
  QVERIFY(frame.panes().isTorn("tab.compare"));
  QVERIFY(compare->isVisible() && compare->window() != &f.window);
  QCOMPARE(tabs->indexOf(compare), -1);
  frame.showTab("annotate");  // the others are where they were
  QCOMPARE(frame.shownTab(), QString("annotate"));
  frame.showTab("compare");  // raises its window
  QCOMPARE(frame.shownTab(), QString("annotate"));

  compare->window()->close();
  QCOMPARE(tabs->indexOf(compare), place);
  QCOMPARE(frame.shownTab(), QString("compare"));
  f.trigger("panes.tab");
  QVERIFY(frame.panes().isTorn("tab.compare"));
}

// Not for its neighbor: with the Annotate tab in front, the mouse would paint.
void PanesTest::tornOffTab_makesWayForTheOneBefore() {
  WindowFixture f;
  f.openSmall();
  f.trigger("tab.compare");

  f.trigger("panes.tab");

  QCOMPARE(f.window.bench().frame.shownTab(), QString("estimate"));
  QVERIFY(!f.window.bench().commands.find("annotate.mode")->isChecked());
}

void PanesTest::tornOffPane_hearsTheKeysOfTheViewer() {
  WindowFixture f;
  f.openSmall();
  f.trigger("panes.epi.vertical");
  auto* epi = f.window.bench().viewer_area.verticalEpi();
  epi->window()->activateWindow();
  QVERIFY(QTest::qWaitForWindowActive(epi->window()));

  QTest::keyClick(epi->window(), Qt::Key_Left);  // of the viewer
  QTRY_COMPARE(f.view(), (ViewIndex{4, 3}));
  QTest::keyClick(epi->window(), Qt::Key_F8);  // of the window
  QTRY_COMPARE(epi->window(), &f.window);
}

void PanesTest::layout_isRememberedAndReset() {
  WindowFixture f;
  f.openSmall();
  const int first = f.window.bench().viewer_area.horizontalEpi()->height();
  drag_handle(splitter(f.window, "split.rows"), {0, -150});
  const int dragged = f.window.bench().viewer_area.horizontalEpi()->height();
  QVERIFY(dragged > first + 100);
  f.trigger("panes.epi.vertical");
  QVERIFY(f.window.bench().viewer_area.canvas()->height() > 250);  // the legend below takes little
  f.window.bench().frame.showTab("cloud");
  f.trigger("panes.tab");
  f.key(Qt::Key_F11, Qt::ShiftModifier);
  f.window.close();

  MainWindow other;
  other.resize(1280, 800);
  other.show();
  other.start({f.path("edge/lf.h5")});
  const ViewerArea& viewer_area = other.bench().viewer_area;
  QTRY_COMPARE(viewer_area.horizontalEpi()->height(), dragged);
  QVERIFY(viewer_area.verticalEpi()->window() != &other);
  QVERIFY(other.bench().frame.panes().isTorn("tab.cloud"));
  QTRY_VERIFY(other.findChild<QWidget*>("pointCloudPanel")->isVisible());
  QVERIFY(!other.bench().frame.arePanelsShown());

  QVERIFY(other.bench().commands.trigger("panes.reset"));
  QTRY_COMPARE(viewer_area.horizontalEpi()->height(), first);
  QCOMPARE(viewer_area.verticalEpi()->window(), &other);
  QVERIFY(!other.bench().frame.panes().isTorn("tab.cloud"));
  QVERIFY(other.bench().frame.arePanelsShown());
  QTRY_COMPARE_WITH_TIMEOUT(other.bench().jobs.count(), 0, kScenePatience);
}

void PanesTest::panes_areStackedBelowTheTabs_andComeBack() {
  WindowFixture f;
  f.openSmall();
  Frame& frame = f.window.bench().frame;
  auto* tabs = f.window.findChild<QTabWidget*>("tabs");
  auto* stack = f.window.findChild<QTabWidget*>("tabs.stack");
  QVERIFY(!stack->isVisible());
  frame.showTab("compare");
  QWidget* compare = tabs->currentWidget();
  const int place = tabs->currentIndex();

  f.key(Qt::Key_F6, Qt::ShiftModifier);
  QVERIFY(stack->isVisible() && compare->isVisible());
  QVERIFY(stack->currentWidget()->isAncestorOf(compare));
  frame.showTab("estimate");
  QVERIFY(compare->isVisible());  // both are seen

  f.key(Qt::Key_F7, Qt::ShiftModifier);
  f.key(Qt::Key_F8, Qt::ShiftModifier);
  auto& viewer_area = f.window.bench().viewer_area;
  QCOMPARE(stack->count(), 3);
  QVERIFY(viewer_area.verticalEpi()->isVisible() && !viewer_area.horizontalEpi()->isVisible());
  QVERIFY(!compare->isVisible());
  QVERIFY(f.window.height() <= 800);  // what finds no room is scrolled
  // A vertical EPI lies on its side there, where there is more room to the right.
  auto& vertical = *viewer_area.verticalEpi();
  QVERIFY(vertical.width() > vertical.height());
  QCOMPARE(vertical.rowExtent(), vertical.height() / 9.0);
  frame.showTab("compare");
  QVERIFY(compare->isVisible() && !viewer_area.verticalEpi()->isVisible());

  f.key(Qt::Key_F7, Qt::ShiftModifier);
  QTRY_VERIFY(viewer_area.horizontalEpi()->isVisible());
  QVERIFY(!stack->isAncestorOf(viewer_area.horizontalEpi()));
  emit stack->tabCloseRequested(stack->currentIndex());
  QCOMPARE(tabs->indexOf(compare), place);
  QCOMPARE(frame.shownTab(), QString("compare"));
  f.trigger("panes.stack.epi.vertical");
  QVERIFY(!stack->isVisible());
  QTRY_VERIFY(viewer_area.verticalEpi()->isVisible());
  QTRY_COMPARE(vertical.rowExtent(), vertical.width() / 9.0);
}

void PanesTest::stack_takesHalfOfTheColumn_whereThereIsRoom() {
  WindowFixture f;
  f.openSmall();
  f.window.resize(1600, 1400);
  f.window.bench().frame.showTab("compare");

  f.key(Qt::Key_F6, Qt::ShiftModifier);

  const auto* stack = f.window.findChild<QTabWidget*>("tabs.stack");
  const auto share = [&] {
    return static_cast<double>(stack->height()) / splitter(f.window, "split.side").height();
  };
  QTRY_VERIFY2(share() > 0.45 && share() < 0.55, qPrintable(QString::number(share())));
}

void PanesTest::stackedPane_mayBeTornOff() {
  WindowFixture f;
  f.openSmall();
  auto* epi = f.window.bench().viewer_area.horizontalEpi();
  f.trigger("panes.stack.epi.horizontal");
  f.trigger("panes.epi.horizontal");
  QVERIFY(epi->isVisible() && epi->window() != &f.window);
  QVERIFY(!f.window.findChild<QTabWidget*>("tabs.stack")->isVisible());
  f.trigger("panes.stack.epi.horizontal");
  QCOMPARE(epi->window(), &f.window);
  QVERIFY(f.window.findChild<QTabWidget*>("tabs.stack")->isAncestorOf(epi) && epi->isVisible());
  QVERIFY(!f.window.bench().commands.find("panes.epi.horizontal")->isChecked());
}

void PanesTest::stack_isRememberedAndReset() {
  WindowFixture f;
  f.openSmall();
  f.window.bench().frame.showTab("compare");
  f.trigger("panes.stack_tab");
  f.trigger("panes.stack.epi.vertical");
  drag_handle(splitter(f.window, "split.side"), {0, 60});
  const int height = f.window.findChild<QTabWidget*>("tabs.stack")->height();
  f.window.close();

  MainWindow other;
  other.resize(1280, 800);
  other.show();
  other.start({f.path("edge/lf.h5")});
  auto* stack = other.findChild<QTabWidget*>("tabs.stack");
  QCOMPARE(stack->count(), 2);
  // The panels below may want some pixels more or less than before.
  QTRY_VERIFY2(std::abs(stack->height() - height) < 10,
               qPrintable(QString::number(stack->height())));
  QVERIFY(other.bench().frame.panes().isStacked("tab.compare"));
  QVERIFY(stack->isAncestorOf(other.bench().viewer_area.verticalEpi()));

  QVERIFY(other.bench().commands.trigger("panes.reset"));
  QCOMPARE(stack->count(), 0);
  QVERIFY(!stack->isVisible());
  QTRY_COMPARE_WITH_TIMEOUT(other.bench().jobs.count(), 0, kScenePatience);
}

void PanesTest::pages_areThoseOfTheirTask() {
  WindowFixture f;
  f.openSmall();
  Frame& frame = f.window.bench().frame;
  const auto* tabs = f.window.findChild<QTabWidget*>("tabs");
  for (const auto& [page, task, title] :
       {std::tuple("sweep", "estimate", "Estimate"), std::tuple("errors", "compare", "Compare"),
        std::tuple("check", "annotate", "Annotate")}) {
    frame.showTab(task);
    QVERIFY(!frame.panes().isSeen(QString("tab.") + page));
    frame.showTab(page);

    QCOMPARE(frame.shownTab(), QString(page));
    QCOMPARE(tabs->tabText(tabs->currentIndex()), QString(title));
    QVERIFY(frame.panes().isSeen(QString("tab.") + page));
    QVERIFY(!frame.panes().isSeen(QString("tab.") + task));
    auto* pages = f.window.findChild<QTabWidget*>(QString("pages.") + task);
    QCOMPARE(pages->count(), 2);
    QTest::mouseClick(pages->tabBar(), Qt::LeftButton, {}, pages->tabBar()->tabRect(0).center());
    QCOMPARE(frame.shownTab(), QString(task));
  }
  frame.showTab("estimate");
  QVERIFY(!frame.panes().isSeen("tab.annotate"));  // its page is in front, but not itself
}

void PanesTest::page_mayBeDetachedAlone() {
  WindowFixture f;
  f.openSmall();
  Frame& frame = f.window.bench().frame;
  auto* pages = f.window.findChild<QTabWidget*>("pages.compare");
  frame.showTab("errors");
  const QWidget* errors = pages->currentWidget();

  f.trigger("panes.tab");

  QVERIFY(frame.panes().isTorn("tab.errors") && errors->isVisible());
  QVERIFY(errors->window() != &f.window && !pages->tabBar()->isVisible());
  QCOMPARE(frame.shownTab(), QString("compare"));
  f.trigger("panes.tab");  // then the task, without it
  QVERIFY(frame.panes().isTorn("tab.compare"));
  errors->window()->close();  // docks it where its task is
  QVERIFY(pages->isVisible() && pages->window() != &f.window && pages->isAncestorOf(errors));
  pages->window()->close();
  QCOMPARE(frame.shownTab(), QString("errors"));
  QVERIFY(f.window.findChild<QTabWidget*>("tabs")->isAncestorOf(errors));
}

// However many there are, and however long their titles.
void PanesTest::everyTab_isInTheList() {
  WindowFixture f;
  f.openSmall();
  const Frame& frame = f.window.bench().frame;
  for (const Tab& tab : frame.tabs()) f.window.bench().frame.showTab(tab.id);
  auto* tabs = f.window.findChild<QTabWidget*>("tabs");
  QVERIFY(tabs->tabBar()->width() <= tabs->width());
  auto* list = f.window.findChild<QToolButton*>("tabs.list");
  QVERIFY(list->isVisible());
  QTest::mouseClick(list, Qt::LeftButton);
  auto* menu = list->findChild<QMenu*>();
  QVERIFY(menu && menu->isVisible());
  menu->close();
  const auto actions = menu->actions();
  QCOMPARE(static_cast<std::size_t>(actions.size()), frame.tabs().size());

  for (int i = 0; i < actions.size(); ++i) {
    actions[i]->trigger();
    const QRect shown = tabs->tabBar()->tabRect(tabs->currentIndex());
    QCOMPARE(frame.shownTab(), frame.tabs()[static_cast<std::size_t>(i)].id);
    QVERIFY2(shown.left() >= -20 && shown.right() <= tabs->tabBar()->width() + 20,
             qPrintable(frame.shownTab()));  // it is scrolled to
  }
}

}  // namespace episcope::in_panes_test

EPISCOPE_WINDOW_TEST(panes_test, PanesTest)
#include "panes_test.moc"
