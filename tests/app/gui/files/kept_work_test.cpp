// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/annotate/segment_controller.h"
#include "app/gui/compare/compare_controller.h"
#include "app/session/project_file.h"
#include "tests/app/gui/files/working.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/panels/result_list.h"

#include <QDialog>
#include <QPlainTextEdit>
#include <QTreeWidget>

#include <algorithm>
#include <filesystem>

// Segmentations, comparisons and notes stay with their scene, and with the project.

namespace episcope::in_kept_work_test {

namespace {

class Keeping : public Working {
 public:
  SegmentController& segment() { return find<SegmentController>(window); }
  CompareController& compare() { return find<CompareController>(window); }
  LabelingPtr labels() { return segment().labeler().labeling(view()); }
  void segmentAll() {
    key(Qt::Key_U, Qt::ShiftModifier);
    QTRY_VERIFY_WITH_TIMEOUT(
        labels() && labels()->labels.grid().count() == 81 && window.bench().jobs.count() == 0,
        kScenePatience);
  }
  QTreeWidgetItem* row() { return window.findChild<QTreeWidget*>("results.tree")->topLevelItem(0); }
};

bool same(const Labeling& a, const Labeling& b) {
  return a.labels.size() == b.labels.size() &&
         std::equal(a.labels.data(), a.labels.data() + a.labels.size(), b.labels.data());
}

}  // namespace

class KeptWorkTest : public QObject {
  Q_OBJECT

 private slots:
  void labels_stayWithTheirScene();
  void labels_comeBackWithTheProject();
  void labels_areKeptForACrash();
  void comparison_comesBack();
  void note_isShown_andComesBack();
};

void KeptWorkTest::labels_stayWithTheirScene() {
  Keeping f;
  f.openSmall("objects");
  const auto first = f.session().generation();
  f.segmentAll();
  const LabelingPtr before = f.labels();
  QCOMPARE(f.session().labels().labeling, before);

  f.openSmall("edge");
  QVERIFY(!f.labels());
  f.show(first);

  QTRY_COMPARE(f.labels(), before);
  QVERIFY(f.segment().labeler().is_up_to_date(f.view()));
  QTRY_COMPARE(f.window.bench().overlay.quantity(), render::Quantity::Segmentation);
}

void KeptWorkTest::labels_comeBackWithTheProject() {
  Keeping f;
  f.openSmall("objects");
  f.segmentAll();
  const QString path = f.path("work.episcope");
  f.saveAs(path);
  const Project project = read_project(path.toStdString());
  QVERIFY(project.scenes.at(0).labels.file.parent_path() == f.path("work_files").toStdString());

  Keeping other;
  other.open(path, 1);

  QTRY_VERIFY_WITH_TIMEOUT(other.labels(), kPatience);
  QVERIFY(same(*other.labels(), *f.labels()));
  QVERIFY(other.segment().labeler().is_up_to_date(other.view()));
  QTRY_VERIFY(!other.window.bench().overlay.picture().isNull());
  QCOMPARE(other.window.bench().overlay.picture(), f.window.bench().overlay.picture());

  // What is painted since makes them out of date.
  other.trigger("annotate.mode");
  other.drag({5, 5}, {5, 40});
  QVERIFY(!other.segment().labeler().is_up_to_date(other.view()));
  other.saveAs(path);
  Keeping third;
  third.open(path, 1);
  QTRY_VERIFY_WITH_TIMEOUT(third.labels(), kPatience);
  QVERIFY(!third.segment().labeler().is_up_to_date(third.view()));
}

void KeptWorkTest::labels_areKeptForACrash() {
  Keeping f;
  f.openSmall("objects");
  const auto kept = [&f] { return f.session().labels().file; };
  f.segmentAll();
  QTRY_VERIFY_WITH_TIMEOUT(!kept().empty() && f.autosave().isIdle(), kPatience);
  const auto first = kept();
  QVERIFY(std::filesystem::exists(first));
  std::filesystem::path project;
  for (const auto& each : std::filesystem::directory_iterator(first.parent_path())) {
    if (names_project(each.path())) project = each.path();
  }
  QVERIFY(read_project(project).scenes.at(0).labels.file == first);

  // Newer labels take its place.
  f.trigger("annotate.mode");
  f.drag({5, 5}, {5, 40});
  QTRY_VERIFY_WITH_TIMEOUT(!kept().empty() && kept() != first && f.autosave().isIdle(), kPatience);
  QVERIFY(!std::filesystem::exists(first));
  QVERIFY(read_project(project).scenes.at(0).labels.file == kept());
}

void KeptWorkTest::comparison_comesBack() {
  Keeping f;
  f.openSmall("edge");
  const auto first = f.session().generation();
  f.estimate();
  f.estimate("epi_l");
  f.key(Qt::Key_W);
  QCOMPARE(f.compare().mode(), CompareMode::Wipe);
  const int x = f.canvas()->width();
  const int y = f.canvas()->height() / 3;
  QTest::mousePress(f.canvas(), Qt::LeftButton, {}, QPoint(x / 2, y));
  QTest::mouseMove(f.canvas(), QPoint(x / 3, y));
  QTest::mouseMove(f.canvas(), QPoint(x / 4, y));
  QTest::mouseRelease(f.canvas(), Qt::LeftButton, {}, QPoint(x / 4, y));
  const double position = f.canvas()->wipePosition().value_or(0);
  QVERIFY2(position < 0.4, qPrintable(QString::number(position)));

  f.openSmall("slant");
  QCOMPARE(f.compare().mode(), CompareMode::Single);
  f.show(first);
  QTRY_COMPARE(f.compare().mode(), CompareMode::Wipe);
  QCOMPARE(f.canvas()->wipePosition(), std::optional(position));

  f.saveAs(f.path("work.episcope"));
  Keeping other;
  other.open(f.path("work.episcope"), 2);
  QTRY_COMPARE_WITH_TIMEOUT(other.compare().mode(), CompareMode::Wipe, kPatience);
  QCOMPARE(other.canvas()->wipePosition(), std::optional(position));
  other.key(Qt::Key_D);  // the difference, too
  QVERIFY(other.window.bench().overlay.showsDifference());
  other.saveAs(f.path("work.episcope"));
  Keeping third;
  third.open(f.path("work.episcope"), 2);
  QTRY_VERIFY_WITH_TIMEOUT(third.window.bench().overlay.showsDifference(), kPatience);
  QCOMPARE(third.compare().mode(), CompareMode::Single);
}

void KeptWorkTest::note_isShown_andComesBack() {
  Keeping f;
  f.openSmall("edge");
  f.estimate();

  f.key(Qt::Key_N, Qt::ControlModifier | Qt::AltModifier);
  auto* dialog = f.window.findChild<QDialog*>("result_note");
  QVERIFY(dialog);
  auto* editor = dialog->findChild<QPlainTextEdit*>();
  QTest::keyClicks(editor, "too smooth");
  QTest::keyClick(editor, Qt::Key_Return);
  QTest::keyClicks(editor, "try 0.1");
  dialog->accept();

  QCOMPARE(f.session().shown()->note, std::string("too smooth\ntry 0.1"));
  QTRY_VERIFY(f.row()->text(4).contains("too smooth"));
  QVERIFY(!f.row()->text(4).contains("try 0.1"));
  QVERIFY(f.row()->toolTip(4).contains("try 0.1"));
  f.saveAs(f.path("work.episcope"));
  QVERIFY(!f.project().hasChanged());
  f.session().set_note(f.session().shown()->id, "fine");
  QVERIFY(f.project().hasChanged());
  Keeping other;
  other.open(f.path("work.episcope"), 1);
  QCOMPARE(other.session().shown()->note, std::string("too smooth\ntry 0.1"));
}

}  // namespace episcope::in_kept_work_test

EPISCOPE_WINDOW_TEST(kept_work_test, KeptWorkTest)
#include "kept_work_test.moc"
