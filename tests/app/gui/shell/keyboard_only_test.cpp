// SPDX-License-Identifier: BSD-3-Clause
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/view_canvas.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QAccessible>
#include <QApplication>
#include <QComboBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QHeaderView>
#include <QLineEdit>
#include <QScrollBar>
#include <QTabBar>

// From start to export without a mouse, and what a screen reader says of the controls.

namespace episcope::in_keyboard_only_test {

namespace {

constexpr int kMostTabs = 120;

/// Types on whatever has the keyboard, as a person does.
class Typist : public WindowFixture {
 public:
  Typist() {
    window.activateWindow();
    QTEST_ASSERT(QTest::qWaitForWindowActive(&window));
  }
  static QWidget* focus() {
    QWidget* focus = QApplication::focusWidget();
    return focus ? focus : QApplication::activeWindow();
  }
  static void press(int key, Qt::KeyboardModifiers modifiers = {}) {
    QTest::keyClick(focus(), static_cast<Qt::Key>(key), modifiers);
  }
  /// Into the dialog for files that was asked for.
  void answer(const QString& path) {
    QTRY_VERIFY(qobject_cast<QFileDialog*>(QApplication::activeModalWidget()));
    QTRY_VERIFY(qobject_cast<QLineEdit*>(focus()));
    QTest::keyClick(focus(), Qt::Key_A, Qt::ControlModifier);
    QTest::keyClicks(focus(), path);
    press(Qt::Key_Return);
    QTRY_VERIFY(!QApplication::activeModalWidget());
    window.activateWindow();  // as a desktop does
    QVERIFY(QTest::qWaitForWindowActive(&window));
  }
  /// Shift+Tab by Shift+Tab: Tab alone flips between A and B while the view has the keyboard.
  void goTo(const QString& object_name) {
    for (int i = 0; i < kMostTabs && focus()->objectName() != object_name; ++i) {
      press(Qt::Key_Backtab, Qt::ShiftModifier);
    }
    QCOMPARE(focus()->objectName(), object_name);
  }
  Session& session() { return window.bench().session; }
};

bool is_control(const QWidget& widget) {
  return qobject_cast<const QAbstractButton*>(&widget) ||
         qobject_cast<const QAbstractSpinBox*>(&widget) ||
         qobject_cast<const QComboBox*>(&widget) || qobject_cast<const QLineEdit*>(&widget) ||
         qobject_cast<const QAbstractItemView*>(&widget) ||
         qobject_cast<const QAbstractSlider*>(&widget);
}

// Parts that Qt makes of others, which a reader passes by.
bool is_part(const QWidget& widget) {
  const QWidget* parent = widget.parentWidget();
  return widget.objectName().startsWith("qt_") || qobject_cast<const QHeaderView*>(&widget) ||
         qobject_cast<const QScrollBar*>(&widget) ||
         qobject_cast<const QAbstractSpinBox*>(parent) ||
         qobject_cast<const QAbstractItemView*>(parent) || qobject_cast<const QTabBar*>(parent) ||
         (parent && parent->objectName() == "qt_scrollarea_viewport" && parent->parentWidget() &&
          qobject_cast<const QAbstractItemView*>(parent->parentWidget())) ||
         (parent && parent->inherits("QComboBoxPrivateContainer")) ||
         qobject_cast<const QComboBox*>(parent) || qobject_cast<const QLineEdit*>(parent);
}

// A button that is shown once it has something to offer.
bool waitsForItsText(const QWidget& widget) {
  const auto* button = qobject_cast<const QAbstractButton*>(&widget);
  return button && !button->isVisible() && button->text().isEmpty() && button->icon().isNull();
}

QString path_of(const QWidget& widget) {
  const QWidget* parent = widget.parentWidget();
  return QString("%1 “%2” in “%3”")
      .arg(widget.metaObject()->className(), widget.objectName(),
           parent ? parent->objectName() : QString());
}

}  // namespace

class KeyboardOnlyTest : public QObject {
  Q_OBJECT

 private slots:
  void fromStartToExport_keysAreEnough();
  void everyControl_hasANameForScreenReaders();
};

void KeyboardOnlyTest::fromStartToExport_keysAreEnough() {
  Typist f;
  const QString scene = f.writeScene("edge", WindowFixture::smallOptions());

  Typist::press(Qt::Key_O, Qt::ControlModifier);
  f.answer(scene);
  QTRY_VERIFY_WITH_TIMEOUT(f.session().scene(), kScenePatience);

  Typist::press(Qt::Key_1, Qt::ControlModifier);
  f.canvas()->setFocus();
  f.goTo("method.combo");
  Typist::press(Qt::Key_Home);
  const int first = qobject_cast<QComboBox*>(Typist::focus())->currentIndex();
  Typist::press(Qt::Key_Down);
  QVERIFY(qobject_cast<QComboBox*>(Typist::focus())->currentIndex() != first);
  Typist::press(Qt::Key_Up);
  for (std::size_t runs = 1; runs <= 2; ++runs) {
    Typist::press(Qt::Key_Return, Qt::ControlModifier);
    QTRY_COMPARE_WITH_TIMEOUT(f.session().estimates().size(), runs, kScenePatience);
  }

  const int newest = f.session().shown()->id;
  Typist::press(Qt::Key_PageUp, Qt::ControlModifier);
  QTRY_VERIFY(f.session().shown()->id != newest);

  const QString file = f.path("exported.h5");
  Typist::press(Qt::Key_E, Qt::ControlModifier);
  f.answer(file);
  QTRY_VERIFY_WITH_TIMEOUT(QFileInfo(file).size() > 0, kPatience);
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 0, kPatience);
}

void KeyboardOnlyTest::everyControl_hasANameForScreenReaders() {
  Typist f;
  f.openSmall();
  f.runAndWait();  // with a map there is a color bar
  f.trigger("annotate.add_label");
  for (const Tab& tab : f.window.bench().frame.tabs()) {
    if (tab.id != "cloud") f.window.bench().frame.showTab(tab.id);  // that needs OpenGL
  }
  QStringList nameless;
  int count = 0;
  for (const QWidget* widget : f.window.findChildren<QWidget*>()) {
    if (!is_control(*widget) || is_part(*widget) || waitsForItsText(*widget)) continue;
    ++count;
    QAccessibleInterface* reader =
        QAccessible::queryAccessibleInterface(const_cast<QWidget*>(widget));
    if (!reader || reader->text(QAccessible::Name).trimmed().isEmpty()) {
      nameless << path_of(*widget);
      qWarning("without a name: %s", qPrintable(nameless.back()));
    }
  }
  QVERIFY2(nameless.isEmpty(), qPrintable(nameless.join(", ")));
  QVERIFY(count > 100);
}

}  // namespace episcope::in_keyboard_only_test

EPISCOPE_WINDOW_TEST(keyboard_only_test, KeyboardOnlyTest)
#include "keyboard_only_test.moc"
