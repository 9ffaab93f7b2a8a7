// SPDX-License-Identifier: BSD-3-Clause
// Labels that are hidden, locked, counted and drawn around, on the window that ships.
#include "app/gui/annotate/annotate_controller.h"

#include "app/gui/annotate/annotation_files.h"
#include "app/gui/annotate/scribble_controller.h"
#include "app/session/project_file.h"
#include "app/session/project_store.h"
#include "engine/io/models/scribble_file.h"
#include "tests/app/gui/annotating.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/canvas_tool.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/message_bar.h"
#include "widgets/panels/label_palette.h"

#include <QAction>
#include <QHeaderView>
#include <QInputDialog>
#include <QLineEdit>
#include <QMenu>
#include <QTreeWidget>

#include <algorithm>
#include <set>

namespace episcope::in_label_tools_test {

namespace {

// Columns of the list of labels.
constexpr int kAmount = 3;
constexpr int kShown = 4;
constexpr int kLock = 5;

class Labels : public Annotating {
 public:
  using Annotating::Annotating;

  QTreeWidget& list() { return *window.findChild<QTreeWidget*>("labels.tree"); }
  void clickRow(int row, int column) {
    window.resize(1280, 760);
    const QRect rect = list().visualItemRect(list().topLevelItem(row));
    const int x =
        list().header()->sectionViewportPosition(column) + list().header()->sectionSize(column) / 2;
    QTest::mouseClick(list().viewport(), Qt::LeftButton, {}, {x, rect.center().y()});
  }
  const LabelMarks& marks() { return window.bench().session.place().label_marks; }
  QString message() { return window.findChild<MessageBar*>("messageBar")->text(); }
  void click(PixelIndex pixel, Qt::MouseButton button = Qt::LeftButton) {
    press(pixel, button);
    release(pixel, button);
  }
  PolygonTool& polygon() { return find<PolygonTool>(window); }
  EditKind lastEdit() { return document().history().next_undo()->kind; }
};

}  // namespace

class LabelToolsTest : public QObject {
  Q_OBJECT

 private slots:
  void lockedLabel_isNeitherPaintedNorPaintedOver();
  void lockedLabel_cannotBeRemoved();
  void mergedLabel_isTakenOver_andComesBack();
  void label_isMergedFromItsMenu();
  void nextLabel_withoutLabels_saysSo();
  void nameOfAnotherLabel_isRefused();
  void digits_arePlacesInTheList();
  void label_getsAnotherNumber();
  void numberOfAnotherLabel_isRefused();
  void label_isMovedInTheList();
  void undoOfALockedLabel_isDoneAndSaid();
  void redoneLabel_isChosenAgain();
  void hiddenLabel_isNeitherDrawnNorPaintedOver();
  void hiddenLabel_isShownAgainOncePainted();
  void onlyOne_hidesAllOthers_andShowsThemAgain();
  void marks_comeBackWithTheProject();
  void drawing_goesRound_andIsRemembered();
  void segments_areDrawnAsContours();
  void contoursOfSegments_differFromStrokes();
  void polygon_isPaintedByReturn_andUndone();
  void polygon_isClosedByADoubleClick();
  void polygon_losesItsLastCornerByBackspace_andEndsByEscape();
  void polygon_staysWithItsView();
  void longLists_areFiltered();
  void polygonOfTheRightButton_erases();
  void lasso_paintsWhatItGoesAround();
  void outlinedPixels_areCarriedAsStrokesAre();
  void amounts_followWhatIsPainted();
};

void LabelToolsTest::lockedLabel_isNeitherPaintedNorPaintedOver() {
  Labels f;
  f.drag({40, 20}, {40, 60});
  f.trigger("annotate.add_label");

  f.clickRow(0, kLock);

  QVERIFY(f.marks().locked.contains(1));
  QCOMPARE(f.window.bench().labels.current(), 2);  // only locked, not chosen
  f.drag({20, 40}, {60, 40});
  QCOMPARE(f.labelAt({40, 40}), 1);
  QCOMPARE(f.labelAt({20, 40}), 2);
  f.drag({40, 20}, {40, 60}, Qt::RightButton);
  QCOMPARE(f.labelAt({40, 50}), 1);

  f.key(Qt::Key_1);
  f.drag({70, 20}, {70, 60});
  QCOMPARE(f.labelAt({70, 40}), 0);
  QVERIFY2(f.message().contains("locked"), qPrintable(f.message()));
  QVERIFY(f.window.bench().commands.find("annotate.lock_label")->isChecked());
  f.key(Qt::Key_V, Qt::ShiftModifier);
  f.drag({70, 20}, {70, 60});
  QCOMPARE(f.labelAt({70, 40}), 1);
}

void LabelToolsTest::lockedLabel_cannotBeRemoved() {
  Labels f;
  f.drag({40, 20}, {40, 60});
  f.key(Qt::Key_V, Qt::ShiftModifier);

  f.trigger("annotate.remove_label");

  QCOMPARE(f.document().labels().labels().size(), std::size_t{1});
  QVERIFY2(f.message().contains("unlock"), qPrintable(f.message()));
}

void LabelToolsTest::mergedLabel_isTakenOver_andComesBack() {
  Labels f;
  f.drag({40, 20}, {40, 60});
  f.trigger("annotate.add_label");
  f.drag({60, 20}, {60, 60});

  f.trigger("annotate.merge_label");
  auto* dialog = f.window.findChild<QInputDialog*>("merge_labels");
  QVERIFY(dialog && dialog->isVisible());
  QCOMPARE(dialog->comboBoxItems().size(), 1);
  dialog->accept();

  QCOMPARE(f.document().labels().labels().size(), std::size_t{1});
  QCOMPARE(f.labelAt({60, 40}), 1);
  QCOMPARE(f.window.bench().labels.current(), 1);
  f.key(Qt::Key_Z, Qt::ControlModifier);
  QCOMPARE(f.labelAt({60, 40}), 2);
  QCOMPARE(f.labelAt({40, 40}), 1);
}

void LabelToolsTest::label_isMergedFromItsMenu() {
  Labels f;
  for (int i = 0; i < 3; ++i) f.trigger("annotate.add_label");

  const QPoint first = f.list().visualItemRect(f.list().topLevelItem(0)).center();
  emit f.list().customContextMenuRequested(first);
  auto* menu = f.window.findChild<QMenu*>("labels.menu");
  QVERIFY(menu);
  const QList<QAction*> actions = menu->actions();
  const auto merge = std::ranges::find(actions, QString("Merge into…"), &QAction::text);
  QVERIFY(merge != actions.end());
  (*merge)->trigger();
  menu->close();

  auto* dialog = f.window.findChild<QInputDialog*>("merge_labels");
  QVERIFY(dialog);
  QVERIFY2(dialog->labelText().contains("label 1"), qPrintable(dialog->labelText()));
  dialog->accept();
  QCOMPARE(f.document().labels().labels().size(), 2U);
  QVERIFY(!f.document().labels().contains(1));
}

void LabelToolsTest::nextLabel_withoutLabels_saysSo() {
  Labels f;

  f.key(Qt::Key_N);

  QVERIFY2(f.message().startsWith("No labels yet"), qPrintable(f.message()));
}

void LabelToolsTest::nameOfAnotherLabel_isRefused() {
  Labels f;
  f.trigger("annotate.add_label");
  f.trigger("annotate.add_label");
  const auto names = [&f] { return f.document().labels().labels(); };
  const std::string first = names()[0].name, second = names()[1].name;

  emit f.window.findChild<LabelPalette*>()->renameRequested(2, QString::fromStdString(first));

  QCOMPARE(names()[1].name, second);
  QVERIFY2(f.message().contains("already"), qPrintable(f.message()));
}

void LabelToolsTest::digits_arePlacesInTheList() {
  Labels f;
  f.trigger("annotate.add_label");
  f.trigger("annotate.add_label");
  f.trigger("annotate.add_label");
  f.window.bench().document.edit([](AnnotationDocument& document) { document.remove_label(1); });

  f.key(Qt::Key_1);
  QCOMPARE(f.window.bench().labels.current(), 2);
  f.key(Qt::Key_2);
  QCOMPARE(f.window.bench().labels.current(), 3);
}

void LabelToolsTest::label_getsAnotherNumber() {
  Labels f;
  f.drag({40, 20}, {40, 60});
  f.key(Qt::Key_V);  // hidden labels stay hidden
  const std::string name = f.document().labels().find(1)->name;

  f.trigger("annotate.renumber_label");
  auto* dialog = f.window.findChild<QInputDialog*>("renumber_label");
  QVERIFY(dialog && dialog->isVisible());
  QCOMPARE(dialog->intValue(), 1);
  dialog->setIntValue(40);
  dialog->accept();

  QCOMPARE(f.document().labels().find(40)->name, name);
  QVERIFY(!f.document().labels().contains(1));
  QCOMPARE(f.labelAt({40, 40}), 40);
  QCOMPARE(f.window.bench().labels.current(), 40);
  QCOMPARE(f.marks().hidden, std::set<std::int32_t>{40});
  f.key(Qt::Key_Z, Qt::ControlModifier);
  QCOMPARE(f.labelAt({40, 40}), 1);
  QCOMPARE(f.document().labels().find(1)->name, name);
}

void LabelToolsTest::numberOfAnotherLabel_isRefused() {
  Labels f;
  f.drag({40, 20}, {40, 60});
  f.trigger("annotate.add_label");

  f.trigger("annotate.renumber_label");
  auto* dialog = f.window.findChild<QInputDialog*>("renumber_label");
  dialog->setIntValue(1);
  dialog->accept();

  QVERIFY(f.document().labels().contains(2));
  QCOMPARE(f.labelAt({40, 40}), 1);
  QVERIFY2(f.message().contains("another"), qPrintable(f.message()));
}

// The order is kept in the file, and digits follow it.
void LabelToolsTest::label_isMovedInTheList() {
  Labels f;
  for (int i = 0; i < 3; ++i) f.trigger("annotate.add_label");
  f.drag({40, 20}, {40, 60});
  const auto row = [&f](int i) { return f.list().topLevelItem(i)->text(1); };

  f.trigger("annotate.label_up");
  f.trigger("annotate.label_up");
  f.trigger("annotate.label_up");  // it is the first already

  QCOMPARE(row(0), QString("3"));
  QCOMPARE(row(2), QString("2"));
  QCOMPARE(f.labelAt({40, 40}), 3);
  f.key(Qt::Key_2);
  QCOMPARE(f.window.bench().labels.current(), 1);
  f.trigger("annotate.label_down");
  QCOMPARE(row(2), QString("1"));
  f.key(Qt::Key_Z, Qt::ControlModifier);
  QCOMPARE(row(1), QString("1"));

  const QString file = f.path("labels.h5");
  find<AnnotationFiles>(f.window).saveAs(file);
  QTRY_VERIFY(!f.window.isWindowModified());
  const auto kept =
      io::read_scribbles(file.toStdString(), *f.window.bench().session.scene(), Progress(1));
  QCOMPARE(kept.labels, f.document().labels().labels());
  QCOMPARE(kept.labels.front().id, 3);
}

// As in painting programs: the history goes back whatever was locked since.
void LabelToolsTest::undoOfALockedLabel_isDoneAndSaid() {
  Labels f;
  f.drag({40, 20}, {40, 60});
  f.drag({60, 20}, {60, 60});
  f.key(Qt::Key_V, Qt::ShiftModifier);
  f.trigger("annotate.undo");
  QCOMPARE(f.labelAt({60, 40}), 0);
  QVERIFY2(f.message().startsWith("Undo changed locked labels"), qPrintable(f.message()));
  f.trigger("annotate.redo");
  QCOMPARE(f.labelAt({60, 40}), 1);
  QVERIFY2(f.message().startsWith("Redo changed locked labels"), qPrintable(f.message()));

  f.key(Qt::Key_V, Qt::ShiftModifier);
  f.key(Qt::Key_Escape);
  f.trigger("annotate.undo");
  QVERIFY2(!f.window.findChild<MessageBar*>("messageBar")->isVisible(), qPrintable(f.message()));
}

// The next stroke is of the label that the step brought back.
void LabelToolsTest::redoneLabel_isChosenAgain() {
  Labels f;
  f.drag({40, 20}, {40, 60});
  f.trigger("annotate.add_label");
  f.key(Qt::Key_Escape);
  f.drag({60, 20}, {60, 60});
  QCOMPARE(f.labelAt({60, 40}), 2);
  const LabelChoice& labels = f.window.bench().labels;

  f.trigger("annotate.undo");
  f.trigger("annotate.undo");
  QCOMPARE(labels.current(), 1);
  f.trigger("annotate.redo");
  QCOMPARE(labels.current(), 2);
  f.trigger("annotate.redo");
  QCOMPARE(labels.current(), 2);

  f.key(Qt::Key_1);
  f.trigger("annotate.undo");
  f.trigger("annotate.redo");
  QCOMPARE(labels.current(), 2);

  f.drag({40, 20}, {40, 60});  // over 1
  f.trigger("annotate.undo");
  QCOMPARE(labels.current(), 2);
}

void LabelToolsTest::hiddenLabel_isNeitherDrawnNorPaintedOver() {
  Labels f;
  f.drag({40, 20}, {40, 60});
  f.trigger("annotate.add_label");
  QVERIFY(f.shownAt({40, 30}).alpha() > 0);

  f.clickRow(0, kShown);

  QTRY_COMPARE(f.shownAt({40, 30}).alpha(), 0);
  f.drag({20, 40}, {60, 40});
  QCOMPARE(f.labelAt({40, 40}), 1);
  f.clickRow(0, kShown);
  QTRY_VERIFY(f.shownAt({40, 30}).alpha() > 0);
}

void LabelToolsTest::hiddenLabel_isShownAgainOncePainted() {
  Labels f;
  f.drag({40, 20}, {40, 60});
  f.key(Qt::Key_V);
  QTRY_COMPARE(f.shownAt({40, 30}).alpha(), 0);

  f.drag({70, 20}, {70, 60});

  QTRY_VERIFY(f.shownAt({40, 30}).alpha() > 0);
  QVERIFY(f.shownAt({70, 40}).alpha() > 0);
}

void LabelToolsTest::onlyOne_hidesAllOthers_andShowsThemAgain() {
  Labels f;
  for (int i = 0; i < 3; ++i) f.trigger("annotate.add_label");
  f.key(Qt::Key_2);

  f.trigger("annotate.only_label");

  QVERIFY((f.marks().hidden == std::set<std::int32_t>{1, 3}));
  f.trigger("annotate.only_label");
  QVERIFY(f.marks().hidden.empty());
}

void LabelToolsTest::marks_comeBackWithTheProject() {
  Labels f;
  for (int i = 0; i < 3; ++i) f.trigger("annotate.add_label");
  f.key(Qt::Key_V);
  f.key(Qt::Key_1);
  f.key(Qt::Key_V, Qt::ShiftModifier);
  const std::string file = f.path("kept.episcope").toStdString();

  write_project(file, project_of(f.window.bench().session));

  const LabelMarks read = read_project(file).scenes.front().place.label_marks;
  QVERIFY((read.hidden == std::set<std::int32_t>{3}));
  QVERIFY((read.locked == std::set<std::int32_t>{1}));
}

void LabelToolsTest::drawing_goesRound_andIsRemembered() {
  Labels f;
  f.drag({40, 20}, {40, 60});
  QCOMPARE(f.shownAt({40, 40}).alpha(), 255);
  int edge = 40;  // of the stroke; where it falls depends on the zoom
  while (f.document().scribbles().label_at(f.view(), {edge - 1, 40}) != 0) --edge;

  f.key(Qt::Key_C, Qt::ShiftModifier);

  QTRY_COMPARE(f.shownAt({40, 40}).alpha(), 0);
  QCOMPARE(f.shownAt({edge, 40}).alpha(), 255);
  f.drag({44, 20}, {44, 60});  // what was a contour lies within now
  QCOMPARE(f.shownAt({44, 40}).alpha(), 0);
  QVERIFY2(f.message().contains("contours"), qPrintable(f.message()));
  f.key(Qt::Key_C, Qt::ShiftModifier);
  QTRY_COMPARE(f.shownAt({40, 40}).alpha(), render::kFaintLabel);
  QCOMPARE(f.shownAt({edge, 40}).alpha(), 255);
  {
    const MainWindow next;
    QVERIFY(next.bench().session.label_style().drawing == render::LabelDrawing::Both);
    QVERIFY(!next.bench().commands.find("annotate.drawing")->isEnabled());  // nothing is open
  }
  f.key(Qt::Key_C, Qt::ShiftModifier);
  QVERIFY(f.window.bench().session.label_style().drawing == render::LabelDrawing::Fill);
}

void LabelToolsTest::segments_areDrawnAsContours() {
  Labels f("objects");
  f.key(Qt::Key_L);
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);
  const Overlay& overlay = f.window.bench().overlay;
  QTRY_VERIFY(!overlay.picture().isNull());
  const auto transparent = [&overlay] {
    const QImage picture = overlay.picture();
    int count = 0;
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) count += picture.pixelColor(x, y).alpha() == 0;
    }
    return count;
  };
  QCOMPARE(transparent(), 0);

  f.key(Qt::Key_C, Qt::ShiftModifier);

  QTRY_VERIFY_WITH_TIMEOUT(transparent() > 96 * 96 / 2, kPatience);
  QVERIFY(transparent() < 96 * 96);
  f.key(Qt::Key_C, Qt::ShiftModifier);
  f.key(Qt::Key_C, Qt::ShiftModifier);
  QTRY_COMPARE_WITH_TIMEOUT(transparent(), 0, kPatience);
}

// With contours, strokes are outlined in the color of their label throughout.
void LabelToolsTest::contoursOfSegments_differFromStrokes() {
  Labels f("objects");
  f.key(Qt::Key_L);
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);
  f.key(Qt::Key_C, Qt::ShiftModifier);
  const Overlay& overlay = f.window.bench().overlay;
  std::set<QRgb> colors;
  for (const LabelInfo& label : f.document().labels().labels()) {
    colors.insert(qRgb(label.color[0], label.color[1], label.color[2]));
  }
  const auto count = [&](bool has_color) {
    const QImage picture = overlay.picture();
    int found = 0;
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        const QRgb pixel = picture.pixel(x, y);
        found += qAlpha(pixel) == 255 && colors.contains(pixel) == has_color;
      }
    }
    return found;
  };

  QTRY_VERIFY_WITH_TIMEOUT(count(false) > 0, kPatience);
  const int share = 100 * count(false) / (count(false) + count(true));
  QVERIFY2(share > 30 && share < 70, qPrintable(QString::number(share)));
}

void LabelToolsTest::polygon_isPaintedByReturn_andUndone() {
  Labels f;
  f.trigger("annotate.add_label");
  f.key(Qt::Key_O);
  QVERIFY(!f.window.bench().commands.find("annotate.close_polygon")->isEnabled());

  for (const PixelIndex corner : {PixelIndex{20, 20}, {20, 70}, {70, 70}, {70, 20}}) {
    f.click(corner);
  }
  QCOMPARE(f.polygon().corners().size(), 4);
  QCOMPARE(f.labelAt({40, 40}), 0);
  f.key(Qt::Key_Return);

  QCOMPARE(f.labelAt({40, 40}), 1);
  QCOMPARE(f.labelAt({22, 22}), 1);
  QCOMPARE(f.labelAt({15, 40}), 0);
  QVERIFY(f.shownAt({40, 40}).alpha() > 0);
  QCOMPARE(f.lastEdit(), EditKind::Polygon);
  QVERIFY(!f.polygon().isDrawing());
  f.key(Qt::Key_Z, Qt::ControlModifier);
  QCOMPARE(f.labelAt({40, 40}), 0);
  f.key(Qt::Key_Y, Qt::ControlModifier);
  QCOMPARE(f.labelAt({40, 40}), 1);
}

void LabelToolsTest::polygon_isClosedByADoubleClick() {
  Labels f;
  f.trigger("annotate.add_label");
  f.key(Qt::Key_O);

  f.click({20, 20});
  f.click({20, 70});
  f.click({70, 70});
  QTest::mouseDClick(f.canvas(), Qt::LeftButton, {}, f.at({70, 70}));

  QCOMPARE(f.labelAt({30, 60}), 1);
  QVERIFY(!f.polygon().isDrawing());
}

void LabelToolsTest::polygon_losesItsLastCornerByBackspace_andEndsByEscape() {
  Labels f;
  f.trigger("annotate.add_label");
  const auto edits = f.document().history().count();
  f.key(Qt::Key_O);
  f.click({20, 20});
  f.click({20, 70});
  f.click({70, 70});

  f.key(Qt::Key_Backspace);
  QCOMPARE(f.polygon().corners().size(), 2);
  f.key(Qt::Key_Return);  // two corners enclose nothing
  QCOMPARE(f.document().history().count(), edits);
  f.click({20, 20});
  f.key(Qt::Key_Escape);
  QVERIFY(!f.polygon().isDrawing());
  QCOMPARE(f.document().history().count(), edits);
}

void LabelToolsTest::polygon_staysWithItsView() {
  Labels f;
  f.trigger("annotate.add_label");
  f.key(Qt::Key_O);
  for (const PixelIndex corner : {PixelIndex{20, 20}, {20, 70}, {70, 70}}) f.click(corner);

  f.key(Qt::Key_Right);
  QTRY_VERIFY((f.view() == ViewIndex{4, 5}));
  f.click({50, 50});
  QCOMPARE(find<PolygonTool>(f.window).corners().size(), 3);
  QVERIFY2(f.message().contains("polygon"), qPrintable(f.message()));
  f.key(Qt::Key_Return);

  QTRY_VERIFY((f.view() == ViewIndex{4, 4}));
  QCOMPARE(f.labelAt({30, 60}, {4, 5}), 0);
  QCOMPARE(f.labelAt({30, 60}), 1);
}

void LabelToolsTest::longLists_areFiltered() {
  Labels f;
  auto* filter = f.window.findChild<QLineEdit*>("labels.filter");
  auto* tree = f.window.findChild<QTreeWidget*>("labels.tree");
  QVERIFY(filter && filter->isHidden());
  f.window.bench().document.edit([](AnnotationDocument& document) {
    for (int i = 0; i < 15; ++i)
      document.add_label(i == 7 ? "red chair" : "thing " + std::to_string(i));
  });
  QVERIFY(!filter->isHidden());

  filter->setText("CHAIR");

  int shown = 0;
  for (int i = 0; i < tree->topLevelItemCount(); ++i) shown += !tree->topLevelItem(i)->isHidden();
  QCOMPARE(shown, 1);
  filter->clear();
  QVERIFY(!tree->topLevelItem(0)->isHidden());
}

void LabelToolsTest::polygonOfTheRightButton_erases() {
  Labels f;
  f.drag({40, 20}, {40, 60});
  f.key(Qt::Key_O);

  for (const PixelIndex corner : {PixelIndex{30, 30}, {30, 50}, {50, 50}, {50, 30}}) {
    f.click(corner, Qt::RightButton);
  }
  f.key(Qt::Key_Return);

  QCOMPARE(f.labelAt({40, 40}), 0);
  QCOMPARE(f.labelAt({40, 22}), 1);
}

void LabelToolsTest::lasso_paintsWhatItGoesAround() {
  Labels f;
  f.trigger("annotate.add_label");
  f.key(Qt::Key_Q);

  f.press({20, 20});
  for (const PixelIndex corner : {PixelIndex{20, 70}, {70, 70}, {70, 20}}) f.move(corner);
  QCOMPARE(f.labelAt({40, 40}), 0);
  f.release({70, 20});

  QCOMPARE(f.labelAt({40, 40}), 1);
  QCOMPARE(f.labelAt({80, 40}), 0);
  QCOMPARE(f.lastEdit(), EditKind::Lasso);
  f.press({20, 20});
  f.move({80, 80});
  f.key(Qt::Key_Escape);
  f.release({80, 80});
  QCOMPARE(f.document().history().applied_count(), std::size_t{2});
}

void LabelToolsTest::outlinedPixels_areCarriedAsStrokesAre() {
  Labels f;
  f.trigger("annotate.add_label");
  f.key(Qt::Key_C);
  f.key(Qt::Key_O);
  for (const PixelIndex corner : {PixelIndex{20, 20}, {20, 70}, {70, 70}, {70, 20}}) {
    f.click(corner);
  }

  f.key(Qt::Key_Return);

  const auto& scribbles = find<ScribbleController>(f.window);
  QTRY_VERIFY_WITH_TIMEOUT(scribbles.carried() && !scribbles.isCarrying(), kPatience);
  QTRY_COMPARE_WITH_TIMEOUT(scribbles.carried()->label_at({4, 6}, {40, 45}), 1, kPatience);
}

void LabelToolsTest::amounts_followWhatIsPainted() {
  Labels f;
  f.trigger("annotate.add_label");
  const auto text = [&f] { return f.list().topLevelItem(0)->text(kAmount); };
  QCOMPARE(text(), QString());

  f.key(Qt::Key_O);
  for (const PixelIndex corner : {PixelIndex{20, 20}, {20, 60}, {60, 60}, {60, 20}}) {
    f.click(corner);
  }
  f.key(Qt::Key_Return);

  QTRY_VERIFY(!text().isEmpty());
  int painted = 0;
  for (int y = 0; y < 96; ++y) {
    for (int x = 0; x < 96; ++x) painted += f.labelAt({y, x}) == 1;
  }
  QCOMPARE(text(), QLocale::c().toString(painted));
  QVERIFY(f.list().columnWidth(kAmount) > f.list().fontMetrics().horizontalAdvance(text()));
  const QString tip = f.list().topLevelItem(0)->toolTip(kAmount);
  QVERIFY2(tip.contains("Disparity") && tip.contains("from"), qPrintable(tip));
  f.key(Qt::Key_Right);
  QTRY_COMPARE(text(), QString());
  f.key(Qt::Key_Left);
  QTRY_VERIFY(!text().isEmpty());
}

}  // namespace episcope::in_label_tools_test

EPISCOPE_WINDOW_TEST(label_tools_test, LabelToolsTest)
#include "label_tools_test.moc"
