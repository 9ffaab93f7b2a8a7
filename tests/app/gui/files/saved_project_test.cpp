// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/files/file_controller.h"
#include "app/session/project_file.h"
#include "app/session/project_store.h"
#include "tests/app/gui/files/working.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/labels.h"
#include "widgets/controls/message_bar.h"

#include <QComboBox>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QPushButton>
#include <QRegularExpression>
#include <QSignalSpy>

#include <fstream>

// Several light fields are one piece of work, which is saved, opened and moved as one.

namespace episcope::in_saved_project_test {

namespace {

// 3×3 views of 48×48 pixels.
scenes::RenderOptions smaller_options() {
  scenes::RenderOptions options;
  options.grid = {3, 3};
  options.height = options.width = 48;
  return options;
}

// A project whose light fields are no longer where they were.
class Moving : public Working {
 public:
  void begin(const QString& project) {
    window.bench().opener.open(project);
    if (auto* unsaved = window.findChild<QMessageBox*>("unsaved_results")) {
      unsaved->button(QMessageBox::Discard)->click();
    }
  }
  /// Null if nothing is asked.
  QMessageBox* question() {
    QMessageBox* box = nullptr;
    const auto is_asked = [&] {
      box = window.findChild<QMessageBox*>("moved_light_field");
      return box != nullptr;
    };
    return QTest::qWaitFor(is_asked, kPatience) ? box : nullptr;
  }
  void answer(const QString& file) {
    question()->findChild<QPushButton*>("moved_light_field.file")->click();
    auto* dialog = window.findChild<QFileDialog*>("locate_light_field");
    QVERIFY(dialog);
    dialog->close();
    emit dialog->fileSelected(file);
    QTRY_VERIFY(!window.findChild<QMessageBox*>("moved_light_field"));
  }
};

std::string text_of(const QString& path) {
  std::ifstream file(path.toStdString());
  return {std::istreambuf_iterator<char>(file), {}};
}

// Copies the light fields, whose own folder goes with the window, and names the copies instead.
void keep_inputs(Working& f, const QString& path) {
  const QString place = QFileInfo(path).path() + "/data";
  for (const OpenScene* each : f.session().scenes()) {
    const QString target = place + '/' + QString::fromStdString(each->name);
    QVERIFY(QDir().mkpath(target));
    QVERIFY(QFile::copy(QString::fromStdString(each->input), target + "/lf.h5"));
  }
  QString text = QString::fromStdString(text_of(path));
  static const QRegularExpression source("\"source\": \"[^\"]*/(\\w+)/lf.h5\"");
  text.replace(source, "\"source\": \"data/\\1/lf.h5\"");
  std::ofstream(path.toStdString()) << text.toStdString();
}

// Two results on the first, a stroke on the second, which is shown; then quits without a question.
void save_work_of_three(const QTemporaryDir& folder) {
  Working f;
  for (const char* id : {"edge", "slant", "fronto"}) f.openSmall(id);
  f.show(f.session().scenes()[0]->id);
  f.estimate();
  f.estimate("epi_l");
  f.session().rename_estimate(f.session().estimates()[0].id, "with my defaults");
  f.session().show_estimate(f.session().estimates()[0].id);
  f.show(f.session().scenes()[1]->id);
  f.trigger("annotate.mode");
  f.drag({40, 20}, {40, 60});
  f.session().set_view({1, 7});
  f.saveAs(folder.filePath("work.episcope"));
  QVERIFY(!f.window.isWindowModified());
  QCOMPARE(f.window.windowTitle(), QString("slant[*] — work.episcope — Episcope"));
  QVERIFY(!f.project().hasChanged());
  keep_inputs(f, folder.filePath("work.episcope"));
  f.trigger("file.quit");
  QTRY_VERIFY(!f.window.isVisible());
}

}  // namespace

class SavedProjectTest : public QObject {
  Q_OBJECT

 private slots:
  void savedProject_comesBackWhole();
  void filesBesideAProject_areOpenedAfterIt();
  void strokesInAProject_areNotInTheirFile();
  void savedProject_canBeMoved();
  void movedLightFields_areAskedForOnce();
  void anotherLightField_isRefused_whereAMovedOneIsAskedFor();
  void otherSamples_areTold();
  void otherSize_movesThePlaceInside();
  void saveKey_savesTheProjectOnceThereIsOne();
  void saveKey_withoutScribbles_asksForAProject();
  void scribblesThatAreNone_areNotWritten();
  void changedProjectFile_isNotOverwrittenSilently();
  void damagedProject_isToldAndKeepsWhatIsOpen();
  void damagedLightField_leavesTheOthersToChoose();
  void secondSave_keepsOnlyWhatIsNamed();
  void closedLightField_marksTheProject();
};

void SavedProjectTest::savedProject_comesBackWhole() {
  const QTemporaryDir folder;
  const QString path = folder.filePath("work.episcope");
  save_work_of_three(folder);
  Working f;

  f.open(path, 3);

  const auto scenes = f.session().scenes();
  QCOMPARE(scenes[0]->estimates.size(), 2U);
  QCOMPARE(scenes[0]->estimates[0].name, std::string("with my defaults"));
  QCOMPARE(f.session().generation(), scenes[1]->id);
  QCOMPARE(f.session().view(), (ViewIndex{1, 7}));
  QCOMPARE(f.document().scribbles().label_at({4, 4}, {40, 40}), 1);
  f.trigger("annotate.undo");  // with its history
  QCOMPARE(f.document().scribbles().label_at({4, 4}, {40, 40}), 0);
  f.window.bench().document.discardAll();
  f.show(scenes[0]->id);
  QCOMPARE(f.session().shown()->name, std::string("with my defaults"));
  QCOMPARE(f.session().shown()->estimate->method, std::string("st_ch_l"));
}

void SavedProjectTest::filesBesideAProject_areOpenedAfterIt() {
  const QTemporaryDir folder;
  save_work_of_three(folder);
  Working f;

  f.window.findChild<FileController*>()->open({"demo:fronto", folder.filePath("work.episcope")});

  QTRY_COMPARE_WITH_TIMEOUT(f.session().scenes().size(), 4U, kPatience);
  QTRY_COMPARE_WITH_TIMEOUT(f.session().scenes()[3]->input, std::string("demo:fronto"), kPatience);
}

void SavedProjectTest::strokesInAProject_areNotInTheirFile() {
  const QTemporaryDir folder;
  Working f;
  f.openSmall("edge");
  const auto state = [&] {
    return f.window.findChild<ElidedLabel*>("annotation.file")->fullText();
  };
  f.trigger("annotate.mode");
  f.drag({40, 20}, {40, 60});
  QTRY_COMPARE(state(), QString("labels.h5 · not saved"));

  f.saveAs(folder.filePath("work.episcope"));

  QTRY_COMPARE(state(), QString("labels.h5 · in the project only"));
  f.trigger("file.save_scribbles");
  QTRY_COMPARE_WITH_TIMEOUT(state(), QString("labels.h5"), kPatience);
  QVERIFY(QFile::remove(QFileInfo(QString::fromStdString(f.session().scenes()[0]->input)).path() +
                        "/labels.h5"));
  f.trigger("annotate.undo");
  f.trigger("annotate.redo");
  QTRY_COMPARE(state(), QString("no file yet"));
}

void SavedProjectTest::savedProject_canBeMoved() {
  Working f;
  QVERIFY(QDir().mkpath(f.path("here")));
  f.openSmall("edge");
  f.estimate();
  f.saveAs(f.path("here/work.episcope"));

  QVERIFY(QDir().rename(f.path("here"), f.path("there")));
  const Project project = read_project(f.path("there/work.episcope").toStdString());

  QVERIFY(std::filesystem::exists(project.scenes.at(0).estimates.at(0).kept));
  QVERIFY(std::filesystem::exists(project.scenes.at(0).input));
}

void SavedProjectTest::movedLightFields_areAskedForOnce() {
  Moving f;
  f.openSmall("edge");
  f.estimate();
  f.openSmall("slant");
  f.window.bench().document.edit([](AnnotationDocument& document) { document.add_label(); });
  f.saveAs(f.path("work.episcope"));
  f.trigger("file.close");
  QTRY_COMPARE(f.session().scenes().size(), 1U);
  f.window.bench().document.discardAll();
  QDir().mkpath(f.path("elsewhere"));
  QVERIFY(QDir().rename(f.path("edge"), f.path("elsewhere/edge")));
  QVERIFY(QDir().rename(f.path("slant"), f.path("elsewhere/slant")));

  f.begin(f.path("work.episcope"));
  QVERIFY(f.question());
  QVERIFY2(f.question()->text().contains("slant"), qPrintable(f.question()->text()));
  f.answer(f.path("elsewhere/slant/lf.h5"));

  QTRY_VERIFY_WITH_TIMEOUT(f.session().scene(), kScenePatience);
  QCOMPARE(f.session().input(), f.path("elsewhere/slant/lf.h5").toStdString());
  const auto edited = f.window.bench().document.editedDocuments();
  QCOMPARE(edited.size(), 1U);
  QCOMPARE(read_journal(edited[0].journal).owner.source, f.session().input());
  f.show(f.session().scenes()[0]->id);
  QCOMPARE(f.session().input(), f.path("elsewhere/edge/lf.h5").toStdString());
  QCOMPARE(f.session().estimates().size(), 1U);
}

void SavedProjectTest::anotherLightField_isRefused_whereAMovedOneIsAskedFor() {
  Moving f;
  f.openSmall("edge");
  f.estimate();
  QTRY_VERIFY(f.session().scenes()[0]->sample_hash != 0);
  f.saveAs(f.path("work.episcope"));
  QVERIFY(QDir().rename(f.path("edge"), f.path("elsewhere")));
  f.begin(f.path("work.episcope"));
  QVERIFY(f.question());

  f.answer(f.writeScene("slant", smaller_options()));

  const auto* bar = f.window.findChild<MessageBar*>("messageBar");
  QTRY_VERIFY2_WITH_TIMEOUT(bar->text().contains("other samples"), qPrintable(bar->text()),
                            kPatience);
  QVERIFY(!f.session().scene());
  QCOMPARE(f.resultCount(), 1U);  // nothing is lost
  f.window.bench().scenes.show(f.session().scenes()[0]->id);
  QVERIFY(f.question());
  f.answer(f.path("elsewhere/lf.h5"));
  QTRY_VERIFY_WITH_TIMEOUT(f.session().scene(), kScenePatience);
  QCOMPARE(f.session().estimates().size(), 1U);
}

void SavedProjectTest::otherSamples_areTold() {
  Working f;
  f.openSmall("edge");
  f.estimate();
  QTRY_VERIFY(f.session().scenes()[0]->sample_hash != 0);
  f.saveAs(f.path("work.episcope"));
  const QString other = f.writeScene("slant", WindowFixture::smallOptions());
  QVERIFY(QFile::remove(f.path("edge/lf.h5")) && QFile::copy(other, f.path("edge/lf.h5")));

  f.open(f.path("work.episcope"), 1);

  const auto* bar = f.window.findChild<MessageBar*>("messageBar");
  QTRY_VERIFY2(bar->text().contains("other samples"), qPrintable(bar->text()));
  QCOMPARE(f.session().estimates().size(), 1U);
}

// Rendered anew, smaller and with fewer views.
void SavedProjectTest::otherSize_movesThePlaceInside() {
  Working f;
  f.openSmall("edge");
  QTRY_VERIFY(f.session().scenes()[0]->sample_hash != 0);
  f.session().set_view({8, 7});
  f.session().set_cross_hair({90, 90});
  f.session().set_judged(f.session().generation(),
                         {.pixels = JudgedPixels::Rectangle, .rectangle = {60, 60, 90, 90}});
  f.saveAs(f.path("work.episcope"));
  QVERIFY(QDir(f.path("edge")).removeRecursively());
  f.writeScene("edge", smaller_options());

  f.open(f.path("work.episcope"), 1);

  QTRY_VERIFY_WITH_TIMEOUT(
      f.session().scene() && f.session().light_field()->grid() == (GridShape{3, 3}),
      kScenePatience);
  QCOMPARE(f.session().view(), (ViewIndex{1, 1}));
  QCOMPARE(f.session().cross_hair(), (PixelIndex{47, 47}));
  QCOMPARE(f.session().place().judged.pixels, JudgedPixels::Whole);
}

void SavedProjectTest::saveKey_savesTheProjectOnceThereIsOne() {
  Working f;
  f.openSmall("edge");
  f.trigger("annotate.mode");
  f.drag({40, 20}, {40, 60});
  f.trigger("file.save");  // no project yet: the scribbles
  QTRY_VERIFY_WITH_TIMEOUT(!f.window.isWindowModified(), kPatience);
  f.saveAs(f.path("work.episcope"));
  f.drag({60, 20}, {60, 60});
  f.estimate();
  const FileStamp before = stamp_of(f.path("work.episcope").toStdString());

  f.key(Qt::Key_S, Qt::ControlModifier);

  QTRY_VERIFY(stamp_of(f.path("work.episcope").toStdString()) != before);
  QTRY_VERIFY(!f.window.isWindowModified());
  QVERIFY(f.session().estimates()[0].is_saved);
}

void SavedProjectTest::changedProjectFile_isNotOverwrittenSilently() {
  Working f;
  f.openSmall("edge");
  f.saveAs(f.path("work.episcope"));
  std::ofstream(f.path("work.episcope").toStdString(), std::ios::app) << " ";

  f.trigger("file.save");

  auto* box = f.window.findChild<QMessageBox*>("changed_file");
  QVERIFY(box);
  box->findChild<QPushButton*>("changed_file.overwrite")->click();
  QTRY_VERIFY(text_of(f.path("work.episcope")).back() == '\n');
}

void SavedProjectTest::damagedProject_isToldAndKeepsWhatIsOpen() {
  Working f;
  f.openSmall("edge");
  std::ofstream(f.path("bad.episcope").toStdString()) << "{\"format\": \"episcope project\",";
  QSignalSpy failures(&f.window.bench().jobs, &Jobs::failed);

  f.window.bench().opener.open(f.path("bad.episcope"));

  QTRY_COMPARE(failures.size(), 1);
  QVERIFY2(failures[0][0].toString().contains("bad.episcope"),
           qPrintable(failures[0][0].toString()));
  QCOMPARE(f.session().scenes().size(), 1U);
  QVERIFY(f.session().scene());
}

void SavedProjectTest::damagedLightField_leavesTheOthersToChoose() {
  Working f;
  f.openSmall("edge");
  f.openSmall("slant");
  QTRY_VERIFY(f.session().scenes()[1]->sample_hash != 0);
  f.saveAs(f.path("work.episcope"));
  std::ofstream(f.path("slant/lf.h5").toStdString()) << "nothing of the kind";
  QSignalSpy failures(&f.window.bench().jobs, &Jobs::failed);

  f.window.bench().opener.open(f.path("work.episcope"));

  QTRY_COMPARE_WITH_TIMEOUT(failures.size(), 1, kScenePatience);
  const auto* list = f.window.findChild<QComboBox*>("scenes.open");
  QVERIFY(list->isEnabled());
  QCOMPARE(list->count(), 2);
  QVERIFY2(list->placeholderText().contains("none of these"), qPrintable(list->placeholderText()));
  QVERIFY2(f.canvas()->accessibleDescription().startsWith("Choose one"),
           qPrintable(f.canvas()->accessibleDescription()));
  f.trigger("scenes.next");
  QTRY_COMPARE_WITH_TIMEOUT(f.session().generation(), f.session().scenes()[0]->id, kScenePatience);
}

void SavedProjectTest::secondSave_keepsOnlyWhatIsNamed() {
  Working f;
  f.openSmall("edge");
  f.estimate();
  f.estimate();
  f.saveAs(f.path("work.episcope"));
  const QDir files(
      QString::fromStdString(files_of_project(f.path("work.episcope").toStdString()).string()));
  QCOMPARE(files.entryList({"*.h5"}).size(), 2);

  f.trigger("estimate.remove");
  QCoreApplication::processEvents();
  f.saveAs(f.path("work.episcope"));

  QCOMPARE(files.entryList({"*.h5"}).size(), 1);
  f.trigger("estimate.restore");  // its file is gone, but not the result
  f.saveAs(f.path("work.episcope"));
  QCOMPARE(files.entryList({"*.h5"}).size(), 2);
}

void SavedProjectTest::closedLightField_marksTheProject() {
  const QTemporaryDir folder;
  Working f;
  for (const char* id : {"edge", "slant"}) f.openSmall(id);
  f.saveAs(folder.filePath("work.episcope"));
  QVERIFY(!f.window.isWindowModified());

  f.trigger("file.close");
  QTRY_COMPARE(f.session().scenes().size(), 1U);

  QTRY_VERIFY(f.window.isWindowModified());
  f.key(Qt::Key_S, Qt::ControlModifier);
  QTRY_VERIFY_WITH_TIMEOUT(!f.window.isWindowModified(), kScenePatience);
}

// It once wrote an empty labels.h5 into the folder of the light field.
void SavedProjectTest::saveKey_withoutScribbles_asksForAProject() {
  Working f;
  f.openSmall("edge");
  f.estimate();
  const FileStamp before = stamp_of(f.path("edge/labels.h5").toStdString());

  f.key(Qt::Key_S, Qt::ControlModifier);

  auto* dialog = f.window.findChild<QFileDialog*>("save_project");
  QVERIFY(dialog);
  emit dialog->fileSelected(f.path("work.episcope"));
  dialog->reject();
  QTRY_VERIFY_WITH_TIMEOUT(f.session().estimates()[0].is_saved, kScenePatience);
  QVERIFY(stamp_of(f.path("edge/labels.h5").toStdString()) == before);
  QVERIFY(f.window.bench().guards.may_leave(Leaving::Session));
}

void SavedProjectTest::scribblesThatAreNone_areNotWritten() {
  Working f;
  f.openSmall("edge");
  f.trigger("annotate.mode");
  const FileStamp before = stamp_of(f.path("edge/labels.h5").toStdString());

  f.trigger("file.save_scribbles");

  QTRY_VERIFY(f.window.findChild<MessageBar*>("messageBar")->text().contains("Nothing is painted"));
  QCOMPARE(f.window.bench().jobs.count(), 0);
  QVERIFY(stamp_of(f.path("edge/labels.h5").toStdString()) == before);
}

}  // namespace episcope::in_saved_project_test

EPISCOPE_WINDOW_TEST(saved_project_test, SavedProjectTest)
#include "saved_project_test.moc"
