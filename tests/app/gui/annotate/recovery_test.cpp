// SPDX-License-Identifier: BSD-3-Clause
// What a killed window had painted is offered by the next one.
#include "app/gui/annotate/label_controller.h"

#include "app/gui/annotate/annotate_controller.h"
#include "app/gui/annotate/annotation_files.h"
#include "app/gui/scene/document_controller.h"
#include "app/gui/scene/scene_opener.h"
#include "app/gui/shell/commands.h"
#include "app/session/session.h"
#include "tests/app/gui/annotate/document_digest.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/message_bar.h"

#include <QAction>
#include <QFile>
#include <QFileInfo>
#include <QMessageBox>
#include <QProcess>
#include <QPushButton>

#include <csignal>
#include <memory>

namespace episcope::in_recovery_test {

namespace {

constexpr int kStrokes = 25;

struct Painted {
  std::size_t steps = 0;
  QByteArray digest;
};

// Lets the real window paint and kills it in the midst; gives what it told last.
Painted paint_and_kill(WindowFixture& f, const QString& light_field) {
  QProcess program;
  program.start(PAINTING_PROGRAM,
                {QString::fromStdString(f.window.bench().document.journalFolder()), light_field,
                 f.path("settings of the dead")});
  QByteArray told;
  int lines = 0;
  while (lines < kStrokes && (program.canReadLine() || program.waitForReadyRead(kPatience))) {
    if (!program.canReadLine()) continue;
    told = program.readLine();
    ++lines;
  }
  ::kill(static_cast<pid_t>(program.processId()), SIGKILL);
  program.waitForFinished();
  // What it went on to paint before it died.
  const QByteArray rest = program.readAllStandardOutput();
  const QList<QByteArray> whole = rest.left(rest.lastIndexOf('\n') + 1).trimmed().split('\n');
  if (!whole.last().isEmpty()) told = whole.last();
  const QList<QByteArray> words = told.trimmed().split(' ');
  return {static_cast<std::size_t>(words.front().toULongLong()), words.back()};
}

QPushButton* button(const WindowFixture& f, const char* name) {
  return f.window.findChild<MessageBar*>("recoveryBar")->findChild<QPushButton*>(name);
}

}  // namespace

class RecoveryTest : public QObject {
  Q_OBJECT

 private slots:
  void killedWindow_losesAtMostTheStrokeInProgress();
  void discardedJournal_isGone();
  void journalThatCannotBeKeptAnew_stays();
  void whatWasPaintedAtAFocusPlane_comesBackThere();
  void whatWasPaintedMeanwhile_isNotLost();
  void whatWasSavedElsewhere_isSavedThereAgain();
  void withoutAJournal_nothingIsOffered();
};

void RecoveryTest::killedWindow_losesAtMostTheStrokeInProgress() {
  WindowFixture f;
  const QString light_field = f.writeScene("edge", WindowFixture::smallOptions());
  const Painted painted = paint_and_kill(f, light_field);
  QVERIFY(painted.steps >= kStrokes);
  QCOMPARE(painted.digest.size(), 40);

  f.window.bench().frame.start();
  QTRY_VERIFY(f.window.findChild<MessageBar*>("recoveryBar")->isVisible());
  QVERIFY(f.window.findChild<MessageBar*>("recoveryBar")->text().contains("lf") ||
          f.window.findChild<MessageBar*>("recoveryBar")->text().contains("edge"));
  button(f, "message.action")->click();

  QTRY_VERIFY_WITH_TIMEOUT(f.window.isWindowModified(), kPatience);
  const AnnotationDocument& document = *f.window.bench().document.document();
  const std::size_t steps = document.history().applied_count();
  QVERIFY2(steps == painted.steps || steps == painted.steps + 1 || steps == painted.steps + 2,
           qPrintable(QString("%1 of %2 steps").arg(steps).arg(painted.steps)));
  // A step that was not told any more was on its way when the window died.
  while (document.history().applied_count() > painted.steps) f.window.bench().document.undo();
  QCOMPARE(digest_of(document), painted.digest);
  QVERIFY(find<AnnotateController>(f.window).isAnnotating());
  QVERIFY(!f.window.findChild<MessageBar*>("recoveryBar")->isVisible());
  // It can be undone, and a journal of its own has taken the place of the one that was left.
  f.window.bench().commands.find("annotate.undo")->trigger();
  QCOMPARE(document.history().applied_count(), painted.steps - 1);
  QVERIFY(recoverable_journals(f.window.bench().document.journalFolder()).empty());
  f.window.bench().document.discardChanges();
}

void RecoveryTest::discardedJournal_isGone() {
  WindowFixture f;
  f.openSmall();
  (void)paint_and_kill(f, QString::fromStdString(f.window.bench().session.input()));
  f.window.bench().frame.start();
  QTRY_VERIFY(f.window.findChild<MessageBar*>("recoveryBar")->isVisible());

  button(f, "message.other")->click();
  auto* box = f.window.findChild<QMessageBox*>("discard_work");
  QVERIFY(box);
  QCOMPARE(recoverable_journals(f.window.bench().document.journalFolder()).size(), 1U);
  box->button(QMessageBox::Discard)->click();

  QVERIFY(!f.window.findChild<MessageBar*>("recoveryBar")->isVisible());
  QVERIFY(recoverable_journals(f.window.bench().document.journalFolder()).empty());
  QVERIFY(!f.window.isWindowModified());
}

void RecoveryTest::journalThatCannotBeKeptAnew_stays() {
  WindowFixture f;
  f.openSmall();
  (void)paint_and_kill(f, QString::fromStdString(f.window.bench().session.input()));
  f.window.bench().frame.start();
  QTRY_VERIFY(f.window.findChild<MessageBar*>("recoveryBar")->isVisible());
  const std::filesystem::path folder = f.window.bench().document.journalFolder();
  QCOMPARE(recoverable_journals(folder).size(), 1U);
  QFile file(f.path("file"));
  QVERIFY(file.open(QIODevice::WriteOnly));
  f.window.bench().document.setJournalFolder(f.path("file/no folder").toStdString());

  button(f, "message.action")->click();

  QTRY_VERIFY_WITH_TIMEOUT(f.window.isWindowModified(), kPatience);
  QCOMPARE(recoverable_journals(folder).size(), 1U);
  f.window.bench().document.discardChanges();
}

void RecoveryTest::whatWasPaintedAtAFocusPlane_comesBackThere() {
  WindowFixture f;
  auto dying = std::make_unique<WindowFixture>();
  dying->window.bench().document.setJournalFolder(f.window.bench().document.journalFolder());
  dying->window.bench().opener.open(f.writeScene("edge", WindowFixture::smallOptions()));
  QTRY_VERIFY_WITH_TIMEOUT(dying->window.bench().document.document(), kPatience);
  dying->window.bench().opener.reopenAt(0.5, nullptr);
  QTRY_COMPARE_WITH_TIMEOUT(dying->window.bench().session.scene()->convention.focus_px, 0.5,
                            kPatience);
  QTRY_VERIFY(dying->window.bench().document.document());
  dying->trigger("annotate.mode");
  dying->drag({40, 20}, {40, 60});
  dying->drag({60, 20}, {60, 60});
  dying->trigger("annotate.add_label");  // is no stroke
  dying.reset();                         // nobody decided about the changes

  f.window.bench().frame.start();
  QTRY_VERIFY(f.window.findChild<MessageBar*>("recoveryBar")->isVisible());
  const QString offer = f.window.findChild<MessageBar*>("recoveryBar")->text();
  QVERIFY2(offer.contains("recover: 2."), qPrintable(offer));
  button(f, "message.action")->click();

  QTRY_VERIFY_WITH_TIMEOUT(f.window.isWindowModified(), kPatience);
  QCOMPARE(f.window.bench().session.scene()->convention.focus_px, 0.5);
  QCOMPARE(f.document().scribbles().label_at({4, 4}, {40, 41}), 1);
  f.window.bench().document.discardChanges();
}

void RecoveryTest::whatWasPaintedMeanwhile_isNotLost() {
  WindowFixture f;
  f.openSmall();
  const Painted painted =
      paint_and_kill(f, QString::fromStdString(f.window.bench().session.input()));
  QTRY_VERIFY(f.window.bench().document.document());
  find<LabelController>(f.window).add();
  f.window.bench().frame.start();
  QTRY_VERIFY(f.window.findChild<MessageBar*>("recoveryBar")->isVisible());

  button(f, "message.action")->click();
  auto* box = f.window.findChild<QMessageBox*>("unsaved_scribbles");
  QVERIFY(box);
  QCOMPARE(f.window.bench().document.document()->labels().labels().size(), std::size_t{1});
  box->button(QMessageBox::Save)->click();

  QTRY_VERIFY(f.window.bench().document.document()->history().count() >= painted.steps);
  f.window.bench().document.discardChanges();
}

void RecoveryTest::whatWasSavedElsewhere_isSavedThereAgain() {
  WindowFixture f;
  auto dying = std::make_unique<WindowFixture>();
  dying->window.bench().document.setJournalFolder(f.window.bench().document.journalFolder());
  const QString scene = f.writeScene("edge", WindowFixture::smallOptions());
  dying->window.bench().opener.open(scene);
  QTRY_VERIFY_WITH_TIMEOUT(dying->window.bench().document.document(), kPatience);
  dying->trigger("annotate.mode");
  dying->drag({40, 20}, {40, 60});
  const QString elsewhere = f.path("elsewhere.h5");
  find<AnnotationFiles>(dying->window).saveAs(elsewhere);
  QTRY_VERIFY(!dying->window.isWindowModified());
  dying->drag({60, 20}, {60, 60});
  dying.reset();  // nobody decided about the second stroke
  const FileStamp before = stamp_of(elsewhere.toStdString());
  const std::string beside = (QFileInfo(scene).path() + "/labels.h5").toStdString();
  const FileStamp beside_before = stamp_of(beside);

  f.window.bench().frame.start();
  QTRY_VERIFY(f.window.findChild<MessageBar*>("recoveryBar")->isVisible());
  button(f, "message.action")->click();
  QTRY_VERIFY_WITH_TIMEOUT(f.window.isWindowModified(), kPatience);
  QCOMPARE(find<AnnotationFiles>(f.window).place(), elsewhere);
  find<AnnotationFiles>(f.window).save();

  QTRY_VERIFY(!f.window.isWindowModified());
  QVERIFY(stamp_of(elsewhere.toStdString()) != before);
  QVERIFY(stamp_of(beside) == beside_before);
}

void RecoveryTest::withoutAJournal_nothingIsOffered() {
  WindowFixture f;
  f.openSmall();

  f.window.bench().frame.start();
  QTest::qWait(50);

  QVERIFY(!f.window.findChild<MessageBar*>("recoveryBar")->isVisible());
}

}  // namespace episcope::in_recovery_test

EPISCOPE_WINDOW_TEST(recovery_test, RecoveryTest)
#include "recovery_test.moc"
