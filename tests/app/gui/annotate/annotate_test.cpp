// SPDX-License-Identifier: BSD-3-Clause
// Paints with the mouse and the keys on the window that ships.
#include "app/gui/annotate/annotate_controller.h"

#include "app/gui/annotate/scribble_controller.h"
#include "app/gui/scene/scene_opener.h"
#include "app/gui/shell/commands.h"
#include "app/session/annotation_journal.h"
#include "app/session/session.h"
#include "tests/app/gui/annotating.h"
#include "tests/widgets/pictures.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/canvas_tool.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/panels/label_palette.h"
#include "widgets/panels/value_bar.h"

#include <QAction>
#include <QApplication>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>
#include <QScreen>
#include <QSpinBox>
#include <QTreeWidget>

#include <cstdlib>

namespace episcope::in_annotate_test {

namespace {

StrokeTool& strokeTool(const Annotating& f) {
  return find<StrokeTool>(f.window);
}

}  // namespace

class AnnotateTest : public QObject {
  Q_OBJECT

 private slots:
  void addedLabel_isNamedAtOnce();
  void drag_paintsAStrokeThatUndoTakesBack();
  void rightDrag_erases();
  void shift_protectsOtherLabels();
  void escape_takesTheStrokeBack();
  void wheelAndMiddleDrag_stillZoomAndPan();
  void keys_chooseToolsSizesAndLabels();
  void tipsOfSizes_nameTheKeysOfTheTable();
  void fill_staysWithinEdges();
  void fill_isShownBefore_andWidenedByDragging();
  void fill_goesAroundStrokes();
  void cursorThatLeaves_leavesNothingBehind();
  void pick_takesTheLabelOfASegment();
  void statusBar_namesTheLabelsUnderTheCursor();
  void pick_takesTheLabelUnderTheMouse();
  void otherView_endsTheStroke();
  void heldFill_isTakenBack_byAnotherViewOrTool();
  void undo_jumpsToTheViewItChanges();
  void brushWithoutLabels_addsOne();
  void undoneFirstStroke_leavesNothingToSave();
  void removedLabel_isAskedForOnlyIfPainted();
  void carriedLabels_neverCoverPaintedOnes();
  void otherTab_goesBackToBrowsing();
  void otherTab_hidesWhatIsPainted();
  void preview_cannotBePainted();
  void whileTheFirstIsRead_theHintSaysSo();
};

void AnnotateTest::addedLabel_isNamedAtOnce() {
  Annotating f;
  f.window.activateWindow();
  QVERIFY(QTest::qWaitForWindowActive(&f.window));

  f.click("labels.add");
  QVERIFY(qobject_cast<QLineEdit*>(QApplication::focusWidget()));
  QTest::keyClicks(QApplication::focusWidget(), "brush");
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_Return);

  QTRY_COMPARE(f.document().labels().labels().back().name, std::string("brush"));
  QTRY_COMPARE(QApplication::focusWidget(), f.canvas());
}

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
  QVERIFY(f.window.isWindowModified());

  f.key(Qt::Key_Z, Qt::ControlModifier);

  QCOMPARE(f.labelAt({40, 41}), 0);
  QCOMPARE(f.shownAt({40, 41}).alpha(), 0);
  f.key(Qt::Key_Y, Qt::ControlModifier);
  QCOMPARE(f.labelAt({40, 41}), 1);
}

void AnnotateTest::rightDrag_erases() {
  Annotating f;
  f.drag({40, 20}, {40, 60});

  f.drag({40, 40}, {40, 44}, Qt::RightButton);

  QCOMPARE(f.labelAt({40, 42}), 0);
  QCOMPARE(f.labelAt({40, 20}), 1);
  QCOMPARE(f.document().history().next_undo()->kind, EditKind::Erase);
}

void AnnotateTest::shift_protectsOtherLabels() {
  Annotating f;
  f.drag({40, 20}, {40, 60});
  f.trigger("annotate.add_label");
  QCOMPARE(f.window.bench().labels.current(), 2);

  f.drag({20, 40}, {60, 40}, Qt::LeftButton, Qt::ShiftModifier);

  QCOMPARE(f.labelAt({40, 40}), 1);
  QCOMPARE(f.labelAt({20, 40}), 2);
  f.drag({20, 40}, {60, 40});
  QCOMPARE(f.labelAt({40, 40}), 2);
}

void AnnotateTest::escape_takesTheStrokeBack() {
  Annotating f;
  f.trigger("annotate.add_label");
  f.press({40, 20});
  f.move({40, 60});
  QCOMPARE(f.labelAt({40, 40}), 1);

  f.key(Qt::Key_Escape);

  QCOMPARE(f.labelAt({40, 40}), 0);
  QCOMPARE(f.shownAt({40, 40}).alpha(), 0);
  f.move({60, 60});  // the button is still held
  f.release({60, 60});
  QVERIFY(f.document().scribbles().painted_views().empty());
  f.drag({40, 20}, {40, 60});
  QCOMPARE(f.labelAt({40, 40}), 1);
}

void AnnotateTest::wheelAndMiddleDrag_stillZoomAndPan() {
  Annotating f;
  f.trigger("annotate.add_label");
  const double scale = f.canvas()->canvasTransform().scale;

  test::turn_wheel(*f.canvas(), f.at({40, 40}), 2);
  const QPointF center = f.canvas()->canvasTransform().center;
  f.drag({40, 40}, {50, 50}, Qt::MiddleButton);

  QVERIFY(f.canvas()->canvasTransform().scale > scale);
  QVERIFY(f.canvas()->canvasTransform().center != center);
  QVERIFY(f.document().scribbles().painted_views().empty());
  const double size = strokeTool(f).brushSize();
  test::turn_wheel(*f.canvas(), f.at({40, 40}), 3, Qt::ControlModifier | Qt::ShiftModifier);
  QVERIFY(strokeTool(f).brushSize() > size);
  QCOMPARE(f.window.findChild<QSpinBox*>("brush.spin")->value(), qRound(strokeTool(f).brushSize()));
}

void AnnotateTest::keys_chooseToolsSizesAndLabels() {
  Annotating f;
  AnnotateController& annotate = find<AnnotateController>(f.window);
  for (int i = 0; i < 3; ++i) f.trigger("annotate.add_label");

  f.key(Qt::Key_2);
  QCOMPARE(f.window.bench().labels.current(), 2);
  f.key(Qt::Key_N);
  QCOMPARE(f.window.bench().labels.current(), 3);
  f.key(Qt::Key_N);
  QCOMPARE(f.window.bench().labels.current(), 1);
  f.key(Qt::Key_X);
  QCOMPARE(f.window.bench().labels.current(), 3);
  f.key(Qt::Key_X);
  QCOMPARE(f.window.bench().labels.current(), 1);
  f.key(Qt::Key_E);
  QVERIFY(annotate.tool() == AnnotationTool::Eraser);
  const double eraser = strokeTool(f).eraserSize();
  const double brush = strokeTool(f).brushSize();
  f.key(Qt::Key_BracketRight);
  QVERIFY(strokeTool(f).eraserSize() > eraser);
  QCOMPARE(strokeTool(f).brushSize(), brush);
  f.key(Qt::Key_F);
  QVERIFY(annotate.tool() == AnnotationTool::Fill);
  f.key(Qt::Key_I);
  QVERIFY(annotate.tool() == AnnotationTool::Pick);
  f.key(Qt::Key_B);
  QVERIFY(annotate.tool() == AnnotationTool::Brush);
  for (int i = 0; i < 40; ++i) f.key(Qt::Key_Comma);
  QCOMPARE(strokeTool(f).brushSize(), 1.0);
  for (int i = 0; i < 60; ++i) f.key(Qt::Key_Period);
  QCOMPARE(strokeTool(f).brushSize(), 100.0);
  QVERIFY(f.window.bench().commands.find("annotate.brush")->isChecked());
}

void AnnotateTest::tipsOfSizes_nameTheKeysOfTheTable() {
  WindowFixture f;
  const auto* size = f.window.findChild<QSpinBox*>("brush.spin");
  QVERIFY2(size->toolTip().contains("[ and ]"), qPrintable(size->toolTip()));

  f.window.bench().commands.setKeys("annotate.larger", {QKeySequence("Ctrl+Alt+J")});
  f.window.bench().commands.setKeys("annotate.smaller", {});

  QVERIFY2(size->toolTip().contains("(Ctrl+Alt+J, or"), qPrintable(size->toolTip()));
}

void AnnotateTest::fill_staysWithinEdges() {
  Annotating f("objects");
  f.trigger("annotate.add_label");
  const int label = f.window.bench().labels.current();
  f.window.findChild<QDoubleSpinBox*>("fill.tolerance")->setValue(60);
  f.key(Qt::Key_F);

  f.press({90, 48});
  f.release({90, 48});

  QVERIFY(f.document().history().next_undo()->kind == EditKind::Fill);
  QCOMPARE(f.labelAt({90, 48}), label);
}

void AnnotateTest::fill_isShownBefore_andWidenedByDragging() {
  Annotating f("objects");
  f.trigger("annotate.add_label");
  auto* tolerance = f.window.findChild<QDoubleSpinBox*>("fill.tolerance");
  f.key(Qt::Key_F);
  FillTool& tool = *f.window.findChild<FillTool*>();

  f.move({90, 47});
  f.move({90, 48});
  QTRY_VERIFY(!tool.preview().isNull());
  QVERIFY(f.document().scribbles().painted_views().size() == 1);  // of the scene itself
  const double before = tolerance->value();
  f.press({90, 20});
  f.move({90, 60});
  QVERIFY2(std::fabs(tolerance->value() / before - 2) < 0.1,
           qPrintable(QString::number(tolerance->value())));
  f.window.bench().cancels.cancel();
  QCOMPARE(tolerance->value(), before);
  f.release({90, 60});
  QVERIFY(!f.document().history().next_undo() ||
          f.document().history().next_undo()->kind != EditKind::Fill);

  f.press({90, 20});
  f.move({90, 60});
  f.release({90, 60});
  QVERIFY(f.document().history().next_undo()->kind == EditKind::Fill);
  QCOMPARE(f.labelAt({90, 20}), f.window.bench().labels.current());
}

// Looks at the screen: what is not repainted would stay there.
void AnnotateTest::cursorThatLeaves_leavesNothingBehind() {
  Annotating f;
  f.key(Qt::Key_B);
  const auto shown = [&f] {
    QCoreApplication::processEvents();
    const QRect canvas(f.canvas()->mapTo(&f.window, QPoint()), f.canvas()->size());
    return f.window.screen()->grabWindow(f.window.winId()).copy(canvas).toImage();
  };
  const auto leave = [&f] {
    QEvent event(QEvent::Leave);
    QCoreApplication::sendEvent(f.canvas(), &event);
  };
  // Where a part is drawn anew, pixels at the borders of large samples may differ a little.
  const auto differing = [](const QImage& a, const QImage& b) {
    constexpr int kVisible = 48;
    int count = 0;
    for (int y = 0; y < a.height(); ++y) {
      for (int x = 0; x < a.width(); ++x) {
        count += std::abs(qGray(a.pixel(x, y)) - qGray(b.pixel(x, y))) > kVisible;
      }
    }
    return count;
  };
  leave();
  const QImage before = shown();

  f.move({40, 40});
  QVERIFY(differing(shown(), before) > 0);
  for (int i = 0; i < 12; ++i) f.key(Qt::Key_BracketRight);
  f.move({50, 60});
  for (int i = 0; i < 20; ++i) f.key(Qt::Key_BracketLeft);
  f.move({70, 30});
  leave();
  QTRY_COMPARE(differing(shown(), before), 0);

  f.key(Qt::Key_F);
  f.move({40, 40});
  f.move({41, 41});
  QTRY_VERIFY(!f.window.findChild<FillTool*>()->preview().isNull());
  leave();
  QTRY_COMPARE(differing(shown(), before), 0);
}

void AnnotateTest::fill_goesAroundStrokes() {
  Annotating f;
  f.drag({40, 20}, {40, 60});
  f.trigger("annotate.add_label");
  f.window.findChild<QDoubleSpinBox*>("fill.tolerance")->setValue(500);
  f.key(Qt::Key_F);

  f.press({70, 48});
  f.release({70, 48});
  QCOMPARE(f.labelAt({70, 48}), 2);
  QCOMPARE(f.labelAt({40, 40}), 1);

  f.press({70, 48}, Qt::LeftButton, Qt::ShiftModifier);
  f.release({70, 48});
  QCOMPARE(f.labelAt({40, 40}), 2);
}

void AnnotateTest::statusBar_namesTheLabelsUnderTheCursor() {
  Annotating f("objects");
  f.key(Qt::Key_U);
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);
  const int id = f.segment().labeler().labeling(f.view())->labels.view(f.view()).at(50, 48);
  const QString name = QString::fromStdString(f.document().labels().find(id)->name);

  f.move({50, 47});
  f.move({50, 48});

  const auto text = [&f] { return f.window.findChild<ValueBar*>()->text(); };
  QTRY_VERIFY2(text().contains("segment " + name + " ("), qPrintable(text()));
  QVERIFY2(text().contains("true label "), qPrintable(text()));
  f.drag({50, 40}, {50, 60});
  f.move({50, 50});
  QTRY_VERIFY2(text().contains("painted "), qPrintable(text()));
}

void AnnotateTest::pick_takesTheLabelOfASegment() {
  Annotating f("objects");
  f.key(Qt::Key_U);
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);
  const auto labels = f.segment().labeler().labeling(f.view())->labels.view(f.view());
  const int other =
      labels.at(2, 2) == f.window.bench().labels.current() ? labels.at(50, 48) : labels.at(2, 2);
  const PixelIndex pixel = other == labels.at(2, 2) ? PixelIndex{2, 2} : PixelIndex{50, 48};
  QCOMPARE(f.labelAt(pixel), 0);
  f.key(Qt::Key_I);

  f.press(pixel);
  f.release(pixel);

  QCOMPARE(f.window.bench().labels.current(), other);
}

void AnnotateTest::pick_takesTheLabelUnderTheMouse() {
  Annotating f;
  f.drag({40, 20}, {40, 60});
  f.trigger("annotate.add_label");
  f.key(Qt::Key_I);

  f.press({40, 40});
  f.release({40, 40});

  QCOMPARE(f.window.bench().labels.current(), 1);
  QVERIFY(find<AnnotateController>(f.window).tool() == AnnotationTool::Brush);
}

void AnnotateTest::otherView_endsTheStroke() {
  Annotating f;
  f.trigger("annotate.add_label");
  f.press({40, 20});
  f.move({40, 40});

  f.window.bench().session.set_view({4, 5});
  QTRY_VERIFY(!f.window.bench().document.isStroking());
  f.move({40, 60});
  f.release({40, 60});

  QCOMPARE(f.labelAt({40, 40}), 1);
  QCOMPARE(f.labelAt({40, 60}), 0);
  QVERIFY(f.document().scribbles().view({4, 5}).empty());
  // So does a loss of the focus.
  f.press({60, 20});
  QVERIFY(f.window.bench().document.isStroking());
  f.window.findChild<LabelPalette*>()->findChild<QTreeWidget*>("labels.tree")->setFocus();
  QVERIFY(!f.window.bench().document.isStroking());
}

void AnnotateTest::heldFill_isTakenBack_byAnotherViewOrTool() {
  Annotating f("objects");
  f.trigger("annotate.add_label");
  auto* tolerance = f.window.findChild<QDoubleSpinBox*>("fill.tolerance");
  const double before = tolerance->value();
  const FillTool& tool = *f.window.findChild<FillTool*>();
  const auto has_filled = [&f] {
    const Edit* last = f.document().history().next_undo();
    return last && last->kind == EditKind::Fill;
  };
  f.key(Qt::Key_F);

  f.press({90, 20});
  f.move({90, 60});
  QVERIFY(tolerance->value() > before);
  f.window.bench().session.set_view({4, 5});
  QTRY_COMPARE(tolerance->value(), before);
  QVERIFY(tool.preview().isNull());
  f.release({90, 60});
  QVERIFY(!has_filled());
  QVERIFY(f.document().scribbles().view({4, 5}).empty());

  f.press({90, 20});
  QVERIFY(!tool.preview().isNull());
  f.trigger("annotate.brush");
  f.release({90, 20});
  QVERIFY(tool.preview().isNull());
  QVERIFY(!has_filled());
}

void AnnotateTest::undo_jumpsToTheViewItChanges() {
  Annotating f;
  f.drag({40, 20}, {40, 60});
  f.window.bench().session.set_view({0, 1});
  QTRY_COMPARE(f.canvas()->scribbles().pixelColor(40, 40).alpha(), 0);
  f.drag({60, 20}, {60, 60});
  f.window.bench().session.set_view({8, 8});

  f.key(Qt::Key_Z, Qt::ControlModifier);
  QVERIFY((f.window.bench().session.view() == ViewIndex{0, 1}));
  QCOMPARE(f.labelAt({60, 40}, {0, 1}), 0);
  QCOMPARE(f.labelAt({40, 40}), 1);
  f.key(Qt::Key_Z, Qt::ControlModifier);
  QVERIFY(f.window.bench().session.view() == Annotating::kCenter);
  QCOMPARE(f.labelAt({40, 40}), 0);
  f.key(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  QCOMPARE(f.labelAt({40, 40}), 1);
  QTRY_VERIFY(f.shownAt({40, 40}).alpha() == 255);
}

void AnnotateTest::brushWithoutLabels_addsOne() {
  Annotating f;
  QVERIFY(f.document().labels().labels().empty());

  f.drag({40, 20}, {40, 60});

  QCOMPARE(f.document().labels().labels().size(), std::size_t{1});
  QCOMPARE(f.window.bench().labels.current(), 1);
  QCOMPARE(f.labelAt({40, 40}), 1);
}

void AnnotateTest::undoneFirstStroke_leavesNothingToSave() {
  Annotating f;
  f.drag({40, 20}, {40, 20});
  QVERIFY(f.window.isWindowModified());
  const auto journal = f.window.bench().document.editedDocuments().front().journal;

  f.key(Qt::Key_Z, Qt::ControlModifier);

  QVERIFY(f.document().labels().labels().empty());
  QVERIFY(!f.window.isWindowModified());
  QVERIFY(!read_journal(journal).document.has_unsaved_changes());  // nothing to recover
  f.key(Qt::Key_Y, Qt::ControlModifier);
  QCOMPARE(f.labelAt({40, 20}), 1);
}

void AnnotateTest::removedLabel_isAskedForOnlyIfPainted() {
  Annotating f;
  f.drag({40, 20}, {40, 60});
  f.trigger("annotate.add_label");

  f.trigger("annotate.remove_label");
  QVERIFY(!f.document().labels().contains(2));
  QVERIFY(!f.window.findChild<QMessageBox*>("remove_label"));
  f.trigger("annotate.remove_label");
  auto* box = f.window.findChild<QMessageBox*>("remove_label");
  QVERIFY(box);
  QVERIFY(f.document().labels().contains(1));
  box->findChild<QPushButton*>("remove_label.remove")->click();
  QTRY_VERIFY(!f.document().labels().contains(1));
  QCOMPARE(f.labelAt({40, 40}), 0);
  f.trigger("annotate.undo");
  QCOMPARE(f.labelAt({40, 40}), 1);
}

void AnnotateTest::carriedLabels_neverCoverPaintedOnes() {
  Annotating f;
  f.drag({40, 20}, {40, 70});
  f.window.bench().session.set_view({4, 6});
  f.trigger("annotate.add_label");
  f.drag({30, 45}, {50, 45});

  f.trigger("annotate.carry");  // by the truth: there is no estimate

  QTRY_VERIFY(find<ScribbleController>(f.window).carried());
  const auto& carried = *find<ScribbleController>(f.window).carried();
  QCOMPARE(carried.label_at({4, 6}, {40, 45}), 0);
  QCOMPARE(f.labelAt({40, 45}, {4, 6}), 2);
  QVERIFY(carried.painted_views().size() > 70);
  QVERIFY(f.document().scribbles().painted_views().size() == 2);
  // Carried pixels are drawn fainter than painted ones, in their color.
  int faint = 0;
  for (int x = 0; x < 96; ++x) {
    const int alpha = f.shownAt({40, x}).alpha();
    faint += alpha > 0 && alpha < 255;
  }
  QVERIFY(faint > 20);
  const std::size_t before = carried.painted_views().size();
  f.trigger("annotate.undo");
  f.trigger("annotate.undo");
  f.trigger("annotate.undo");
  QTRY_VERIFY(!find<ScribbleController>(f.window).isCarrying());
  QVERIFY(find<ScribbleController>(f.window).carried()->painted_views().size() < before);
  f.trigger("annotate.carry");
  QVERIFY(!find<ScribbleController>(f.window).carried());
}

void AnnotateTest::otherTab_goesBackToBrowsing() {
  Annotating f;
  QVERIFY(f.canvas()->tool());

  f.trigger("tab.estimate");
  QVERIFY(!f.canvas()->tool());
  QVERIFY(!find<AnnotateController>(f.window).isAnnotating());
  f.trigger("tab.annotate");
  QVERIFY(f.canvas()->tool());
  f.trigger("annotate.mode");
  QVERIFY(!f.canvas()->tool());
  QVERIFY(!f.window.bench().commands.find("annotate.mode")->isChecked());
  // Without a tool in hand a click moves the cross-hair again.
  f.press({10, 12});
  f.release({10, 12});
  QVERIFY((f.window.bench().session.cross_hair() == PixelIndex{10, 12}));
}

void AnnotateTest::otherTab_hidesWhatIsPainted() {
  Annotating f;
  const auto drawnColor = [&f] { return f.canvas()->grab().toImage().pixelColor(f.at({40, 40})); };
  const QColor view = drawnColor();
  f.trigger("annotate.add_label");
  f.drag({40, 20}, {40, 60});
  QVERIFY(drawnColor() != view);

  f.trigger("tab.estimate");
  QCOMPARE(drawnColor(), view);

  f.trigger("tab.annotate");
  f.trigger("annotate.mode");  // browsing, with the strokes in sight
  QVERIFY(drawnColor() != view);
}

void AnnotateTest::preview_cannotBePainted() {
  Annotating f;
  f.trigger("annotate.add_label");

  f.window.bench().viewer_area.showPreview(QImage(96, 96, QImage::Format_RGB32), "being read");
  f.drag({40, 20}, {40, 60});
  QVERIFY(f.document().scribbles().painted_views().empty());
  f.window.bench().viewer_area.endPreview();
  f.window.bench().session.set_view(Annotating::kCenter);  // the drag was parallax
  QCoreApplication::processEvents();
  f.drag({40, 20}, {40, 60});
  QCOMPARE(f.labelAt({40, 40}), 1);
}

void AnnotateTest::whileTheFirstIsRead_theHintSaysSo() {
  WindowFixture f;
  const auto* hint = f.window.findChild<QLabel*>("labels.hint");
  QVERIFY2(hint->text().startsWith("Open "), qPrintable(hint->text()));
  QVERIFY(!f.window.findChild<LabelPalette*>()->isEnabled());

  f.window.bench().viewer_area.showPreview(QImage(96, 96, QImage::Format_RGB32), "being read");
  QVERIFY2(hint->text().contains("still loading"), qPrintable(hint->text()));

  f.window.bench().viewer_area.endPreview();
  QVERIFY(hint->text().startsWith("Open "));
}

}  // namespace episcope::in_annotate_test

EPISCOPE_WINDOW_TEST(annotate_test, AnnotateTest)
#include "annotate_test.moc"
