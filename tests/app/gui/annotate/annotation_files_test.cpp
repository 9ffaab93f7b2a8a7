// SPDX-License-Identifier: BSD-3-Clause
// What is painted goes to files, and is not lost by leaving it.
#include "app/gui/annotate/annotation_files.h"
#include "app/gui/annotate/label_exchange.h"

#include "annotation/brush.h"
#include "annotation/exchange.h"
#include "app/gui/scene/scene_switcher.h"
#include "app/gui/shell/jobs.h"
#include "app/session/session.h"
#include "engine/io/base/image_file.h"
#include "engine/io/models/scribble_file.h"
#include "tests/app/gui/annotating.h"
#include "tests/window_test_main.h"
#include "widgets/controls/message_bar.h"

#include <QDir>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>
#include <QSignalSpy>

#include <unistd.h>

#include <filesystem>
#include <utility>

namespace episcope::in_annotation_files_test {

namespace {

// A folder that cannot be written meanwhile, not even by root: access(2) asks for the real user.
class ReadOnlyFolder {
 public:
  explicit ReadOnlyFolder(QString folder) : folder_(std::move(folder)) {
    QFile::setPermissions(folder_, QFile::ReadOwner | QFile::ExeOwner);
    if (is_root_) is_root_ = ::setresuid(kNobody, 0, 0) == 0;
  }
  ~ReadOnlyFolder() {
    if (is_root_ && ::setresuid(0, 0, 0) != 0) qFatal("the user cannot be changed back");
    QFile::setPermissions(folder_, QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
  }
  ReadOnlyFolder(const ReadOnlyFolder&) = delete;
  ReadOnlyFolder& operator=(const ReadOnlyFolder&) = delete;

 private:
  static constexpr uid_t kNobody = 65534;
  QString folder_;
  bool is_root_ = ::getuid() == 0;
};

}  // namespace

class AnnotationFilesTest : public QObject {
  Q_OBJECT

 private slots:
  void failedSave_keepsTheDocument();
  void exportedPictures_comeBackByImport();
  void close_asksAboutUnsavedChanges_data();
  void close_asksAboutUnsavedChanges();
  void openAnother_keepsUnsavedChanges();
  void fileChangedOnDisk_isNotOverwrittenSilently_data();
  void fileChangedOnDisk_isNotOverwrittenSilently();
  void ownSave_isNoChangeOnDisk();
  void anotherFile_isReplacedWhenConfirmed();
  void placeThatCannotBeWritten_isTold();
  void folderThatIsTyped_isMade();
  void strokesOfTwoViews_takeLittleRoom();
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

void AnnotationFilesTest::placeThatCannotBeWritten_isTold() {
  Annotating f;
  f.drag({40, 20}, {40, 60});
  const QString folder = QFileInfo(QString::fromStdString(f.window.bench().session.input())).path();
  {
    const ReadOnlyFolder is_read_only(folder);
    f.trigger("file.save_scribbles");
  }

  const auto* dialog = f.window.findChild<QFileDialog*>("save_scribbles");
  QVERIFY(dialog && dialog->isVisible());
  const QString told = f.window.findChild<MessageBar*>("messageBar")->text();
  QVERIFY2(told.contains(folder) && told.contains("cannot be written"), qPrintable(told));
}

void AnnotationFilesTest::folderThatIsTyped_isMade() {
  Annotating f;
  f.drag({40, 20}, {40, 60});
  f.trigger("file.export_scribbles");
  auto* dialog = f.window.findChild<QFileDialog*>("export_scribbles");
  QVERIFY(dialog);
  dialog->setDirectory(f.path(""));

  dialog->findChild<QLineEdit*>("fileNameEdit")->setText("new pictures");
  QTest::keyClick(dialog->findChild<QLineEdit*>("fileNameEdit"), Qt::Key_Return);

  QTRY_VERIFY(QFile::exists(f.path("new pictures/scribbles_04_04.png")));
}

void AnnotationFilesTest::strokesOfTwoViews_takeLittleRoom() {
  Annotating f;
  f.drag({40, 20}, {40, 60});
  f.key(Qt::Key_Right);
  QTRY_VERIFY((f.view() == ViewIndex{4, 5}));
  f.drag({60, 20}, {60, 60});
  const QString file = f.path("strokes.h5");

  find<AnnotationFiles>(f.window).saveAs(file);

  QTRY_VERIFY(!f.window.isWindowModified());
  const qint64 size = QFileInfo(file).size();
  QVERIFY2(size < 81 * 96 * 96 / 8, qPrintable(QString::number(size)));  // a bit for each ray
}

void AnnotationFilesTest::exportedPictures_comeBackByImport() {
  Annotating f;
  f.drag({40, 20}, {40, 60});
  QDir().mkpath(f.path("pictures"));
  const auto told = [&f] { return f.window.findChild<MessageBar*>("messageBar")->text(); };
  find<AnnotationFiles>(f.window).exportPictures(f.path("pictures"));
  QTRY_VERIFY(told().contains("Saved"));
  f.trigger("annotate.undo");
  QCOMPARE(f.labelAt({40, 40}), 0);

  find<LabelImporter>(f.window).open({f.path("pictures")});
  QTRY_VERIFY(f.window.findChild<QPushButton*>("importLabels.import"));
  f.window.findChild<QPushButton*>("importLabels.import")->click();
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

void AnnotationFilesTest::fileChangedOnDisk_isNotOverwrittenSilently_data() {
  QTest::addColumn<QString>("button");
  QTest::addColumn<int>("mine");    // label of the stroke painted here, as the file has it then
  QTest::addColumn<int>("theirs");  // of the stroke painted in the other window
  QTest::addColumn<int>("open");    // of that stroke, as it is open here then
  QTest::newRow("overwrite") << "changed_file.overwrite" << 1 << 0 << 0;
  QTest::newRow("reload") << "changed_file.reload" << 0 << 1 << 1;
}

void AnnotationFilesTest::fileChangedOnDisk_isNotOverwrittenSilently() {
  QFETCH(QString, button);
  QFETCH(int, mine);
  QFETCH(int, theirs);
  QFETCH(int, open);
  Annotating f;
  const QString file = f.path("edge/labels.h5");
  const Scene& scene = *f.window.bench().session.scene();
  f.drag({20, 20}, {20, 60});  // makes the label, which both windows have
  f.trigger("file.save_scribbles");
  QTRY_VERIFY_WITH_TIMEOUT(!f.window.isWindowModified(), kPatience);
  AnnotationDocument other(f.document().labels(), f.document().scribbles(), 0);
  Stroke stroke(other, Annotating::kCenter, {.label = 1});
  stroke.extend({70, 50});
  QVERIFY(stroke.commit());
  f.drag({40, 20}, {40, 60});
  io::write_scribbles(file.toStdString(), scribbles_of(other), scene, Progress());

  f.trigger("file.save_scribbles");
  QTRY_VERIFY(f.window.findChild<QMessageBox*>("changed_file"));
  f.click(button);
  QTRY_VERIFY_WITH_TIMEOUT(!f.window.isWindowModified(), kPatience);

  const Scribbles read = io::read_scribbles(file.toStdString(), scene, Progress());
  const AnnotationDocument written = document_from(read, scene.light_field->grid(), 96, 96);
  QCOMPARE(written.scribbles().label_at(Annotating::kCenter, {40, 40}), mine);
  QCOMPARE(written.scribbles().label_at(Annotating::kCenter, {70, 50}), theirs);
  QCOMPARE(f.labelAt({70, 50}), open);
}

void AnnotationFilesTest::ownSave_isNoChangeOnDisk() {
  Annotating f;
  for (int y : {40, 60}) {
    f.drag({y, 20}, {y, 60});
    f.trigger("file.save_scribbles");
    QTRY_VERIFY_WITH_TIMEOUT(!f.window.isWindowModified(), kPatience);
  }
  QVERIFY(!f.window.findChild<QMessageBox*>("changed_file"));
}

void AnnotationFilesTest::anotherFile_isReplacedWhenConfirmed() {
  Annotating f;
  const QString other = f.path("other.h5");
  std::filesystem::copy_file(f.path("edge/labels.h5").toStdString(), other.toStdString());
  const auto bytes = [&other] {
    QFile file(other);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
  };
  const QByteArray before = bytes();
  f.drag({40, 20}, {40, 60});

  f.trigger("file.save_scribbles_as");
  auto* dialog = f.window.findChild<QFileDialog*>("save_scribbles");
  QVERIFY(dialog);
  emit dialog->fileSelected(other);
  auto* box = f.window.findChild<QMessageBox*>("replace_files");
  QVERIFY(box);
  QVERIFY(box->text().contains("other.h5"));
  QCOMPARE(bytes(), before);
  box->button(QMessageBox::Yes)->click();

  QTRY_VERIFY_WITH_TIMEOUT(!f.window.isWindowModified(), kPatience);
  QVERIFY(bytes() != before);
  dialog->reject();
}

void AnnotationFilesTest::openAnother_keepsUnsavedChanges() {
  Annotating f;
  f.drag({40, 20}, {40, 60});
  const auto first = f.window.bench().session.generation();
  const QString other = f.writeScene("slant", WindowFixture::smallOptions());

  f.window.bench().opener.open(other);
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().session.input(), other.toStdString(), kPatience);
  QTRY_VERIFY(f.window.bench().document.document());
  QVERIFY(!f.window.findChild<QMessageBox*>("unsaved_scribbles"));
  QVERIFY(f.document().scribbles().painted_views().empty());
  QVERIFY(!f.window.isWindowModified());

  f.window.bench().scenes.show(first);
  QTRY_VERIFY(f.window.isWindowModified());
  QCOMPARE(f.labelAt({40, 40}), 1);
  f.trigger("annotate.undo");
  QCOMPARE(f.labelAt({40, 40}), 0);
  f.window.bench().document.discardAll();
}

}  // namespace episcope::in_annotation_files_test

EPISCOPE_WINDOW_TEST(annotation_files_test, AnnotationFilesTest)
#include "annotation_files_test.moc"
