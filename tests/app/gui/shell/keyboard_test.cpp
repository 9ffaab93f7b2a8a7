// SPDX-License-Identifier: BSD-3-Clause
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/panels/overlay_bar.h"

#include <QAbstractItemView>
#include <QApplication>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QTabBar>
#include <QTabWidget>

#include <vector>

// The keyboard belongs to the view, wherever the mouse was.

namespace episcope::in_keyboard_test {

namespace {

class Typing : public WindowFixture {
 public:
  Typing() {
    openSmall();
    window.activateWindow();
    QTEST_ASSERT(QTest::qWaitForWindowActive(&window));
    canvas()->setFocus();
  }
  QDoubleSpinBox* focusField() { return window.findChild<QDoubleSpinBox*>("overlay.focusSpin"); }
  void clickInto(QDoubleSpinBox* field) {
    auto* edit = field->findChild<QLineEdit*>();
    QTest::mouseClick(edit, Qt::LeftButton);
    edit->selectAll();
  }
  /// To whatever has the focus, as a keyboard does.
  void type(const QString& text) { QTest::keyClicks(QApplication::focusWidget(), text); }
  void press(Qt::Key key) { QTest::keyClick(QApplication::focusWidget(), key); }
  void waitForHome() { QTRY_COMPARE(QApplication::focusWidget(), canvas()); }
  double focus() { return window.bench().session.focus_px(); }
};

}  // namespace

class KeyboardTest : public QObject {
  Q_OBJECT

 private slots:
  void typedNumber_isTheNumberUsed_data();
  void typedNumber_isTheNumberUsed();
  void return_givesTheKeysBack();
  void escape_dropsWhatIsTypedAndGivesTheKeysBack();
  void clickElsewhere_takesWhatIsTyped();
  void arrows_belongToTheFieldThatIsTypedIn();
  void mouse_leavesTheKeysWithTheView();
  void tab_thatIsShown_leavesTheKeysWithTheView();
  void controlReachedByKeys_keepsItsArrows();
};

void KeyboardTest::typedNumber_isTheNumberUsed_data() {
  QTest::addColumn<QString>("typed");
  QTest::addColumn<double>("used");
  QTest::newRow("within") << "2.4" << 2.4;
  QTest::newRow("beyond the slider") << "9" << 9.0;
  QTest::newRow("negative") << "-12.25" << -12.25;
  QTest::newRow("beyond the limit") << "250" << OverlayBar::kFarthestFocus;
}

void KeyboardTest::typedNumber_isTheNumberUsed() {
  QFETCH(QString, typed);
  QFETCH(double, used);
  Typing f;

  f.clickInto(f.focusField());
  f.type(typed);
  f.press(Qt::Key_Return);

  QCOMPARE(f.focus(), used);
}

void KeyboardTest::return_givesTheKeysBack() {
  Typing f;
  f.clickInto(f.focusField());
  f.type("1.5");

  f.press(Qt::Key_Return);
  f.waitForHome();
  f.press(Qt::Key_Up);
  f.press(Qt::Key_Up);

  QCOMPARE(f.focus(), 1.5);
  QVERIFY((f.view() == ViewIndex{2, 4}));
}

void KeyboardTest::escape_dropsWhatIsTypedAndGivesTheKeysBack() {
  Typing f;
  f.clickInto(f.focusField());
  f.type("1.5");

  f.press(Qt::Key_Escape);
  f.waitForHome();

  QCOMPARE(f.focus(), 0.0);
  QCOMPARE(f.focusField()->value(), 0.0);
}

void KeyboardTest::clickElsewhere_takesWhatIsTyped() {
  Typing f;
  f.clickInto(f.focusField());
  f.type("0.75");

  QTest::mouseClick(f.window.findChild<QTabBar*>(), Qt::LeftButton, {}, {4, 4});

  QCOMPARE(f.focus(), 0.75);
  QCOMPARE(QApplication::focusWidget(), f.canvas());
}

void KeyboardTest::arrows_belongToTheFieldThatIsTypedIn() {
  Typing f;
  f.clickInto(f.focusField());
  f.type("1");

  f.press(Qt::Key_Up);

  QCOMPARE(f.focus(), 1.0 + f.focusField()->singleStep());
  QVERIFY((f.view() == ViewIndex{4, 4}));
}

void KeyboardTest::mouse_leavesTheKeysWithTheView() {
  Typing f;
  auto* method = f.window.findChild<QComboBox*>("method.combo");
  QVERIFY(method);
  int cancelled = 0;
  f.window.bench().cancels.add(CancelRank::Job, [&cancelled] { return ++cancelled > 0; });

  QTest::mouseClick(method, Qt::LeftButton);
  QTest::keyClick(method->view(), Qt::Key_Escape);

  QCOMPARE(QApplication::focusWidget(), f.canvas());
  QVERIFY(!method->view()->isVisible());
  QCOMPARE(cancelled, 0);  // the key closed the list alone
  f.press(Qt::Key_Left);
  QVERIFY((f.view() == ViewIndex{4, 3}));
}

void KeyboardTest::tab_thatIsShown_leavesTheKeysWithTheView() {
  Typing f;
  auto* tabs = f.window.findChild<QTabWidget*>("tabs");

  std::vector<int> shown;  // others have keys of their own
  for (int i = 0; i < tabs->count(); ++i) {
    if (tabs->isTabVisible(i)) shown.push_back(i);
  }
  QVERIFY(shown.size() > 4);
  for (int i = static_cast<int>(shown.size()) - 1; i >= 0; --i) {
    QTest::keyClick(QApplication::focusWidget(), Qt::Key(Qt::Key_1 + i), Qt::ControlModifier);
    QCOMPARE(tabs->currentIndex(), shown[i]);
    f.waitForHome();
    f.press(Qt::Key_Right);
    f.press(Qt::Key_Home);
    QVERIFY((f.view() == ViewIndex{4, 4}));
  }
}

void KeyboardTest::controlReachedByKeys_keepsItsArrows() {
  Typing f;
  auto* method = f.window.findChild<QComboBox*>("method.combo");
  method->setFocus(Qt::TabFocusReason);
  const int before = method->currentIndex();

  f.press(Qt::Key_Down);

  QCOMPARE(method->currentIndex(), before + 1);
  QVERIFY((f.view() == ViewIndex{4, 4}));
}

}  // namespace episcope::in_keyboard_test

EPISCOPE_WINDOW_TEST(keyboard_test, KeyboardTest)
#include "keyboard_test.moc"
