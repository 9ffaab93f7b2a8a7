// SPDX-License-Identifier: BSD-3-Clause
// Paints with the mouse and the keys on the window that ships.
#include "app/gui/annotate_controller.h"

#include "app/gui/action_table.h"
#include "app/gui/scribble_controller.h"
#include "tests/app/gui/window_fixture.h"
#include "widgets/view_canvas.h"

#include <QAction>
#include <QTabWidget>
#include <QTest>

using namespace episcope;

namespace {

constexpr ViewIndex kCenter{4, 4};

// The window in annotate mode, on a light field that nothing is painted on.
class Annotating : public WindowFixture {
 public:
  explicit Annotating(const std::string& id = "edge") {
    openSmall(id);
    [&] { QTRY_VERIFY(window.document().document()); }();
    trigger("annotate.mode");
  }

  AnnotationDocument& document() { return *window.document().document(); }
  ViewCanvas* canvas() { return window.panels().canvas; }
  int labelAt(PixelIndex pixel, ViewIndex view = kCenter) {
    return document().scribbles().label_at(view, pixel);
  }
  void trigger(const char* id) {
    QAction* action = window.actions().find(id);
    QVERIFY2(action && action->isEnabled(), id);
    action->trigger();
  }
  void key(Qt::Key key, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    window.activateWindow();  // shortcuts are heard in the active window only
    QVERIFY(QTest::qWaitForWindowActive(&window));
    canvas()->setFocus();
    QTest::keyClick(canvas(), key, modifiers);
  }
  QPoint at(PixelIndex pixel) { return canvas()->positionOf(pixel).toPoint(); }
  void press(PixelIndex pixel, Qt::MouseButton button = Qt::LeftButton,
             Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    QTest::mouseMove(canvas(), at(pixel));
    QTest::mousePress(canvas(), button, modifiers, at(pixel));
  }
  void move(PixelIndex pixel) { QTest::mouseMove(canvas(), at(pixel)); }
  void release(PixelIndex pixel, Qt::MouseButton button = Qt::LeftButton) {
    QTest::mouseRelease(canvas(), button, {}, at(pixel));
  }
  void drag(PixelIndex from, PixelIndex to, Qt::MouseButton button = Qt::LeftButton,
            Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    press(from, button, modifiers);
    move(to);
    release(to, button);
  }
  QColor shownAt(PixelIndex pixel) { return canvas()->scribbles().pixelColor(pixel.x, pixel.y); }
};

}  // namespace

class AnnotateTest : public QObject {
  Q_OBJECT

 private slots:
  void drag_paintsAStrokeThatUndoTakesBack();
};

void AnnotateTest::drag_paintsAStrokeThatUndoTakesBack() {
  Annotating f;
  f.trigger("annotate.add_label");

  f.drag({40, 20}, {40, 60});

  QCOMPARE(f.labelAt({40, 20}), 1);
  QCOMPARE(f.labelAt({40, 41}), 1);
  QCOMPARE(f.labelAt({40, 60}), 1);
  QCOMPARE(f.labelAt({50, 41}), 0);
  const Rgb color = f.document().labels().find(1)->color;
  QCOMPARE(f.shownAt({40, 41}), QColor(color[0], color[1], color[2]));

  f.key(Qt::Key_Z, Qt::ControlModifier);

  QCOMPARE(f.labelAt({40, 41}), 0);
  QCOMPARE(f.shownAt({40, 41}).alpha(), 0);
  f.key(Qt::Key_Y, Qt::ControlModifier);
  QCOMPARE(f.labelAt({40, 41}), 1);
}

QTEST_MAIN(AnnotateTest)
#include "annotate_test.moc"
