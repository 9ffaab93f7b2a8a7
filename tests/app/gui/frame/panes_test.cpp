// SPDX-License-Identifier: BSD-3-Clause
// Panes can be sized, torn off, and come back; the window remembers it.
#include "app/gui/frame/panes.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/browse/epi_pane.h"
#include "widgets/canvas/view_canvas.h"

#include <QAction>
#include <QSettings>
#include <QSplitter>
#include <QTabBar>
#include <QTabWidget>

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

}  // namespace

class PanesTest : public QObject {
  Q_OBJECT

 private slots:
  void epis_canBeOfAnyHeight();
  void view_andItsEpiStayAligned();
  void epis_canBeTornOff_andComeBack();
  void tabs_canBeTornOff_andComeBackAtTheirPlace();
  void tornOffPane_hearsTheKeysOfTheViewer();
  void layout_isRememberedAndReset();
};

void PanesTest::epis_canBeOfAnyHeight() {
  WindowFixture f;
  f.openSmall();
  auto& epi = *f.window.bench().stage.horizontalEpi();
  const int height = epi.height();

  drag_handle(splitter(f.window, "split.rows"), {0, -200});

  QVERIFY2(epi.height() > height + 150, qPrintable(QString::number(epi.height())));
  QVERIFY(epi.rowExtent() > 25);  // of nine views
  QVERIFY(f.canvas()->height() > 100);
}

void PanesTest::view_andItsEpiStayAligned() {
  WindowFixture f;
  f.openSmall();
  auto& stage = f.window.bench().stage;
  const auto is_aligned = [&] {
    return f.canvas()->mapTo(&f.window, QPoint()).x() ==
               stage.horizontalEpi()->mapTo(&f.window, QPoint()).x() &&
           f.canvas()->width() == stage.horizontalEpi()->width();
  };
  QVERIFY(is_aligned());
  const int width = stage.verticalEpi()->width();

  drag_handle(splitter(f.window, "split.upper"), {-120, 0});
  QVERIFY(stage.verticalEpi()->width() > width + 80);
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

void PanesTest::epis_canBeTornOff_andComeBack() {
  WindowFixture f;
  f.openSmall();
  auto* epi = f.window.bench().stage.horizontalEpi();
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

void PanesTest::tornOffPane_hearsTheKeysOfTheViewer() {
  WindowFixture f;
  f.openSmall();
  f.trigger("panes.epi.vertical");
  auto* epi = f.window.bench().stage.verticalEpi();
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
  const int first = f.window.bench().stage.horizontalEpi()->height();
  drag_handle(splitter(f.window, "split.rows"), {0, -150});
  const int dragged = f.window.bench().stage.horizontalEpi()->height();
  QVERIFY(dragged > first + 100);
  f.trigger("panes.epi.vertical");
  f.window.bench().frame.showTab("cloud");
  f.trigger("panes.tab");
  f.key(Qt::Key_F11, Qt::ShiftModifier);
  f.window.close();

  MainWindow other;
  other.resize(1280, 800);
  other.show();
  other.start(f.path("edge/lf.h5"));
  const Stage& stage = other.bench().stage;
  QTRY_COMPARE(stage.horizontalEpi()->height(), dragged);
  QVERIFY(stage.verticalEpi()->window() != &other);
  QVERIFY(other.bench().frame.panes().isTorn("tab.cloud"));
  QTRY_VERIFY(other.findChild<QWidget*>("pointCloudPanel")->isVisible());
  QVERIFY(!other.bench().frame.arePanelsShown());

  QVERIFY(other.bench().commands.trigger("panes.reset"));
  QTRY_COMPARE(stage.horizontalEpi()->height(), first);
  QCOMPARE(stage.verticalEpi()->window(), &other);
  QVERIFY(!other.bench().frame.panes().isTorn("tab.cloud"));
  QVERIFY(other.bench().frame.arePanelsShown());
  QTRY_COMPARE_WITH_TIMEOUT(other.bench().jobs.count(), 0, kScenePatience);
}

}  // namespace episcope::in_panes_test

EPISCOPE_WINDOW_TEST(panes_test, PanesTest)
#include "panes_test.moc"
