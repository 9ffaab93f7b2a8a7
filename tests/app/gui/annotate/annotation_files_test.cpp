// SPDX-License-Identifier: BSD-3-Clause
// What is painted goes to files, and is not lost by leaving it.
#include "app/gui/annotate/annotation_files.h"

#include "app/gui/frame/jobs.h"
#include "app/session/session.h"
#include "tests/app/gui/annotating.h"
#include "tests/window_test_main.h"
#include "widgets/controls/message_bar.h"

#include <QDir>
#include <QMessageBox>
#include <QPushButton>
#include <QSignalSpy>

#include <filesystem>

namespace episcope::in_annotation_files_test {

class AnnotationFilesTest : public QObject {
  Q_OBJECT

 private slots:
  void failedSave_keepsTheDocument();
  void exportedPictures_comeBackByImport();
  void close_asksAboutUnsavedChanges_data();
  void close_asksAboutUnsavedChanges();
  void openAnother_asksAboutUnsavedChanges();
};

void AnnotationFilesTest::failedSave_keepsTheDocument() {
  Annotating f;
  f.drag({40, 20}, {40, 60});
  QSignalSpy failures(&f.window.bench().jobs, &Jobs::failed);

  find<AnnotationFiles>(f.window).saveAs(f.path("none/labels.h5"));

  QTRY_COMPARE(failures.size(), 1);
  QVERIFY(f.window.findChild<MessageBar*>("messageBar")->text().contains("labels.h5"));
  QVERIFY(f.window.isWindowModified());
  QCOMPARE(f.labelAt({40, 40}), 1);
}

void AnnotationFilesTest::exportedPictures_comeBackByImport() {
  Annotating f;
  f.drag({40, 20}, {40, 60});
  QDir().mkpath(f.path("pictures"));
  const auto told = [&f] { return f.window.findChild<MessageBar*>("messageBar")->text(); };
  find<AnnotationFiles>(f.window).exportPictures(f.path("pictures"));
  QTRY_VERIFY(told().contains("Written"));
  f.trigger("annotate.undo");
  QCOMPARE(f.labelAt({40, 40}), 0);

  find<AnnotationFiles>(f.window).importFrom(f.path("pictures"));
  QTRY_VERIFY(told().contains("Imported"));

  QCOMPARE(f.labelAt({40, 40}), 1);
  QCOMPARE(f.document().history().next_undo()->kind, EditKind::Import);
}

void AnnotationFilesTest::close_asksAboutUnsavedChanges_data() {
  QTest::addColumn<int>("answer");
  QTest::addColumn<bool>("closes");
  QTest::addColumn<bool>("saves");
  QTest::newRow("cancel") << static_cast<int>(QMessageBox::Cancel) << false << false;
  QTest::newRow("discard") << static_cast<int>(QMessageBox::Discard) << true << false;
  QTest::newRow("save") << static_cast<int>(QMessageBox::Save) << true << true;
}

void AnnotationFilesTest::close_asksAboutUnsavedChanges() {
  QFETCH(int, answer);
  QFETCH(bool, closes);
  QFETCH(bool, saves);
  Annotating f;
  f.drag({40, 20}, {40, 60});
  const std::filesystem::path file = f.path("edge/labels.h5").toStdString();
  const auto written = std::filesystem::last_write_time(file);

  f.window.close();
  QVERIFY(f.window.isVisible());
  auto* box = f.window.findChild<QMessageBox*>("unsaved_scribbles");
  QVERIFY(box);
  box->button(static_cast<QMessageBox::StandardButton>(answer))->click();

  QTRY_COMPARE(!f.window.isVisible(), closes);
  QCOMPARE(std::filesystem::last_write_time(file) != written, saves);
  QCOMPARE(f.labelAt({40, 40}), 1);
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  if (!closes) f.window.bench().document.discardChanges();
}

void AnnotationFilesTest::openAnother_asksAboutUnsavedChanges() {
  Annotating f;
  f.drag({40, 20}, {40, 60});
  const QString other = f.writeScene("slant", WindowFixture::smallOptions());

  f.window.bench().opener.open(other);
  auto* box = f.window.findChild<QMessageBox*>("unsaved_scribbles");
  QVERIFY(box);
  box->button(QMessageBox::Cancel)->click();
  QCOMPARE(f.window.bench().jobs.count(), 0);
  QCOMPARE(f.labelAt({40, 40}), 1);
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);

  f.window.bench().opener.open(other);
  box = f.window.findChild<QMessageBox*>("unsaved_scribbles");
  QVERIFY(box);
  box->button(QMessageBox::Discard)->click();
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().session.input(), other.toStdString(), kPatience);
  QTRY_VERIFY(f.window.bench().document.document());
  QVERIFY(f.document().scribbles().painted_views().empty());
  // The journal of what was discarded is gone.
  QVERIFY(left_journals(f.window.bench().document.journalFolder()).empty());
}

}  // namespace episcope::in_annotation_files_test

EPISCOPE_WINDOW_TEST(annotation_files_test, AnnotationFilesTest)
#include "annotation_files_test.moc"
