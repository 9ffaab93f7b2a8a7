// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/files/autosave.h"
#include "app/session/project_store.h"
#include "tests/app/gui/files/working.h"
#include "tests/app/gui/held_lane.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/message_bar.h"

#include <QDir>
#include <QDirIterator>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QMessageBox>
#include <QProcess>
#include <QPushButton>
#include <QToolButton>

#include <csignal>
#include <filesystem>
#include <memory>
#include <random>

// What was open when the program was killed comes back, all of it.

namespace episcope::in_session_recovery_test {

namespace {

constexpr const char* kScenes[] = {"edge", "slant", "fronto"};

/// What the program told last before it was killed.
struct Told {
  std::size_t made = 0;  ///< Results.
  std::size_t kept = 0;  ///< Those in files by then.
  std::size_t strokes = 0;
};

Told told_in(const QByteArray& output) {
  const QList<QByteArray> lines = output.left(output.lastIndexOf('\n') + 1).trimmed().split('\n');
  const QList<QByteArray> words = lines.last().split(' ');
  if (words.size() != 3) return {};
  return {words[0].toULongLong(), words[1].toULongLong(), words[2].toULongLong()};
}

// Lets the real window work for a while and kills it.
Told work_and_kill(const WindowFixture& f, const QString& state, unsigned seed) {
  QStringList arguments{state, QString::number(seed)};
  for (const char* id : kScenes) arguments << f.writeScene(id, WindowFixture::smallOptions());
  QProcess program;
  program.start(WORKING_PROGRAM, arguments);
  QByteArray output;
  while (!output.contains('\n') && program.waitForReadyRead(kScenePatience)) {
    output += program.readAllStandardOutput();
  }
  std::mt19937 random(seed);
  QTest::qWait(static_cast<int>(random() % 2500));
  ::kill(static_cast<pid_t>(program.processId()), SIGKILL);
  program.waitForFinished();
  return told_in(output + program.readAllStandardOutput());
}

void answer(const WindowFixture& f, QMessageBox::StandardButton button) {
  auto* box = f.window.findChild<QMessageBox*>("discard_work");
  QVERIFY(box);
  box->button(button)->click();
  QTRY_VERIFY(!f.window.findChild<QMessageBox*>("discard_work"));
}

class Recovering : public Working {
 public:
  explicit Recovering(const QString& state) {
    window.bench().document.setJournalFolder((state + "/journals").toStdString());
    autosave().setRoot((state + "/sessions").toStdString());
  }
  MessageBar* bar() { return window.findChild<MessageBar*>("sessionRecoveryBar"); }
  // Takes what is offered; false if nothing is.
  bool recover() {
    window.bench().frame.start();
    if (!QTest::qWaitFor([this] { return bar()->isVisible(); }, 2000)) return false;
    bar()->findChild<QPushButton*>("message.action")->click();
    return QTest::qWaitFor(
        [this] { return session().scene() && window.bench().document.document(); }, kScenePatience);
  }
  std::size_t strokeCount() {
    std::size_t count = 0;
    for (const OpenScene* each : session().scenes()) {
      show(each->id);
      count += document().history().applied_count();
      if (each->estimates.empty()) continue;
      for (const EstimateEntry& entry : each->estimates) {
        if (!entry.estimate) return 0;  // told, but not there
      }
    }
    return count;
  }
};

}  // namespace

class SessionRecoveryTest : public QObject {
  Q_OBJECT

 private slots:
  void killedSession_losesNothingThatWasKept();
  void recoveredSession_isKeptAgain();
  void recoveredSession_isToldWhenItIsShown();
  void recoveredScene_isNamedWhileItIsRead();
  void whatWasDoneBeforeTheOffer_staysOpen();
  void twoSessions_areBothRecovered();
  void offer_isKeptByItsCross_andTheDemoWaitsForIt();
  void discardedSession_isGone();
  void sceneThatWasOnlyLookedAt_comesBackClean();
  void b_comesBack_data();
  void b_comesBack();
  void sessionWithoutLightFields_isNotOffered();
  void leftWindow_leavesNothingBehind();
  void runningSession_isNotOffered();
};

// A result is in a file some milliseconds after it is there. EPISCOPE_KILLS sets how often.
void SessionRecoveryTest::killedSession_losesNothingThatWasKept() {
  const int kills = std::max(3, qEnvironmentVariableIntValue("EPISCOPE_KILLS"));
  std::size_t made = 0, strokes = 0, lost_results = 0, lost_strokes = 0;
  for (int i = 0; i < kills; ++i) {
    const QTemporaryDir state;
    Recovering f(state.path());
    const Told told = work_and_kill(f, state.path(), static_cast<unsigned>(i + 1));
    made += told.made;
    strokes += told.strokes;

    QVERIFY(f.recover());

    QCOMPARE(f.session().scenes().size(), std::size(kScenes));
    const std::size_t results = f.resultCount();
    // A label that is made with the first stroke is a step of its own.
    const std::size_t steps = f.strokeCount();
    // Results are written in the background: on a busy disk the newest are still on their way.
    QVERIFY2(results >= told.kept,
             qPrintable(
                 QString("%1 of %2 results, %3 kept").arg(results).arg(told.made).arg(told.kept)));
    QVERIFY2(steps >= told.strokes,
             qPrintable(QString("%1 of %2 strokes").arg(steps).arg(told.strokes)));
    if (results < told.made) lost_results += told.made - results;
    if (steps < told.strokes) lost_strokes += told.strokes - steps;
    f.window.bench().document.discardAll();
  }
  qInfo("%d kills: %zu of %zu results lost, %zu of %zu strokes", kills, lost_results, made,
        lost_strokes, strokes);
}

void SessionRecoveryTest::recoveredSession_isKeptAgain() {
  const QTemporaryDir state;
  WindowFixture files;
  const Told told = work_and_kill(files, state.path(), 7);
  auto second = std::make_unique<Recovering>(state.path());
  QVERIFY(second->recover());
  const std::size_t results = second->resultCount();
  second->estimate();
  QTRY_VERIFY(second->autosave().isIdle());
  QTRY_VERIFY(!second->session().estimates().back().kept.empty());
  second.reset();  // nobody decided about it

  Recovering third(state.path());
  QVERIFY(third.recover());

  QCOMPARE(third.resultCount(), results + 1);
  QVERIFY(third.strokeCount() >= told.strokes);
  third.window.bench().document.discardAll();
}

namespace {

// A session of one scene with a result that nobody decided about.
void leave_session(const WindowFixture& files, const QString& state,
                   const std::string& id = "edge") {
  Recovering f(state);
  f.open(files.writeScene(id, WindowFixture::smallOptions()), 1);
  f.estimate();
  QTRY_VERIFY(!f.session().estimates()[0].kept.empty());
  QTRY_VERIFY(f.autosave().isIdle());
}

}  // namespace

void SessionRecoveryTest::recoveredSession_isToldWhenItIsShown() {
  const QTemporaryDir state;
  const WindowFixture files;
  leave_session(files, state.path());
  Recovering f(state.path());
  f.window.bench().frame.start();
  QTRY_VERIFY(f.bar()->isVisible());

  f.bar()->findChild<QPushButton*>("message.action")->click();

  const auto* messages = f.window.findChild<MessageBar*>("messageBar");
  QTRY_VERIFY_WITH_TIMEOUT(messages->isVisible() && messages->text().startsWith("Recovered"),
                           kScenePatience);
  QVERIFY(f.session().scene());
  QCOMPARE(f.resultCount(), std::size_t{1});
}

// It was asked about, although it stays.
void SessionRecoveryTest::whatWasDoneBeforeTheOffer_staysOpen() {
  const QTemporaryDir state;
  const WindowFixture files;
  leave_session(files, state.path());
  Recovering f(state.path());
  f.openSmall("slant");
  f.estimate();
  f.window.bench().document.edit([](AnnotationDocument& document) { document.add_label("mine"); });
  const auto own = f.session().generation();
  f.window.bench().frame.start();
  QTRY_VERIFY(f.bar()->isVisible());

  f.bar()->findChild<QPushButton*>("message.action")->click();

  QTRY_COMPARE_WITH_TIMEOUT(f.session().scenes().size(), std::size_t{2}, kScenePatience);
  QVERIFY(f.window.findChildren<QMessageBox*>().isEmpty());
  QCOMPARE(f.session().find_scene(own)->estimates.size(), std::size_t{1});
  QCOMPARE(f.window.bench().document.unsavedScenes(), std::vector{own});
}

// Results of the first may be in its files alone.
void SessionRecoveryTest::twoSessions_areBothRecovered() {
  const QTemporaryDir state;
  const WindowFixture files;
  leave_session(files, state.path(), "edge");
  leave_session(files, state.path(), "slant");
  Recovering f(state.path());

  QVERIFY(f.recover());
  QTRY_VERIFY(f.bar()->isVisible());
  f.bar()->findChild<QPushButton*>("message.action")->click();

  QTRY_COMPARE_WITH_TIMEOUT(f.session().scenes().size(), std::size_t{2}, kScenePatience);
  QTRY_VERIFY(f.autosave().isIdle());
  for (const OpenScene* each : f.session().scenes()) {
    QCOMPARE(each->estimates.size(), std::size_t{1});
    QVERIFY(std::filesystem::exists(each->estimates[0].kept));
  }
}

void SessionRecoveryTest::recoveredScene_isNamedWhileItIsRead() {
  const QTemporaryDir state;
  const WindowFixture files;
  leave_session(files, state.path());
  Recovering f(state.path());
  f.window.bench().frame.start();
  QTRY_VERIFY(f.bar()->isVisible());
  HeldLane held(f.window.bench().jobs, Lane::Open);

  f.bar()->findChild<QPushButton*>("message.action")->click();

  QTRY_COMPARE(f.session().scenes().size(), std::size_t{1});
  QCoreApplication::processEvents();  // the session tells the window of them one turn later
  QCOMPARE(f.canvas()->state(), ViewCanvas::State::Empty);
  QCOMPARE(f.canvas()->accessibleDescription(), QString("Opening edge …"));
  held.release();
  QTRY_COMPARE_WITH_TIMEOUT(f.canvas()->state(), ViewCanvas::State::Picture, kScenePatience);
}

void SessionRecoveryTest::offer_isKeptByItsCross_andTheDemoWaitsForIt() {
  const QTemporaryDir state;
  const WindowFixture files;
  leave_session(files, state.path());
  Recovering f(state.path());
  f.window.start({"demo?size=64&grid=3x3"});
  QTRY_VERIFY_WITH_TIMEOUT(f.session().scene() && f.bar()->isVisible(), kScenePatience);
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 0, kScenePatience);
  QVERIFY(f.session().estimates().empty());

  f.bar()->findChild<QToolButton*>("message.close")->click();

  QVERIFY(!f.bar()->isVisible());
  QTRY_COMPARE_WITH_TIMEOUT(f.session().estimates().size(), std::size_t{1}, kScenePatience);
  QCOMPARE(orphaned_workspaces((state.path() + "/sessions").toStdString()).size(), std::size_t{1});
}

void SessionRecoveryTest::discardedSession_isGone() {
  const QTemporaryDir state;
  Recovering f(state.path());
  (void)work_and_kill(f, state.path(), 3);
  f.window.bench().frame.start();
  QTRY_VERIFY(f.bar()->isVisible());

  const std::filesystem::path sessions = (state.path() + "/sessions").toStdString();

  f.bar()->findChild<QPushButton*>("message.other")->click();
  answer(f, QMessageBox::Cancel);
  QVERIFY(!orphaned_workspaces(sessions).empty());
  QVERIFY(f.bar()->isVisible());
  f.bar()->findChild<QPushButton*>("message.other")->click();
  answer(f, QMessageBox::Discard);

  QVERIFY(orphaned_workspaces(sessions).empty());
}

// An empty journal once came back as scribbles that are not saved.
void SessionRecoveryTest::sceneThatWasOnlyLookedAt_comesBackClean() {
  const QTemporaryDir state;
  const WindowFixture files;
  {
    Recovering f(state.path());
    f.open(files.writeScene("edge", WindowFixture::smallOptions()), 1);
    f.estimate();
    f.trigger("annotate.mode");
    QTRY_VERIFY(!f.session().estimates()[0].kept.empty());
    QVERIFY(QDir(state.path() + "/journals").isEmpty());
    f.window.bench().document.edit([](AnnotationDocument&) {});  // a journal without work
    QVERIFY(!QDir(state.path() + "/journals").isEmpty());
    QTRY_VERIFY(f.autosave().isIdle());
  }  // nobody decided about it

  Recovering f(state.path());
  QVERIFY(f.recover());

  QVERIFY(!f.window.bench().document.hasUnsavedChanges());
}

void SessionRecoveryTest::b_comesBack_data() {
  QTest::addColumn<bool>("is_chosen");
  QTest::newRow("chosen") << true;
  QTest::newRow("shown before") << false;
}

void SessionRecoveryTest::b_comesBack() {
  QFETCH(bool, is_chosen);
  const QTemporaryDir state;
  const WindowFixture files;
  std::string b;
  {
    Recovering f(state.path());
    f.open(files.writeScene("edge", WindowFixture::smallOptions()), 1);
    for (int i = 0; i < 3; ++i) f.estimate();
    const auto& results = f.session().estimates();
    QTRY_VERIFY(!results[2].kept.empty());
    b = results[1].name;
    if (!is_chosen) f.session().show_estimate(results[0].id);
    is_chosen ? f.session().compare_with(results[1].id) : f.session().show_estimate(results[1].id);
    f.session().show_estimate(results[2].id);
    QCOMPARE(f.session().compared()->name, b);
    QCoreApplication::processEvents();
    QTRY_VERIFY(f.autosave().isIdle());
  }  // as if killed

  Recovering f(state.path());
  QVERIFY(f.recover());

  QVERIFY(f.session().compared());
  QCOMPARE(f.session().compared()->name, b);
  QCOMPARE(f.session().shown()->name, f.session().estimates()[2].name);
}

void SessionRecoveryTest::sessionWithoutLightFields_isNotOffered() {
  const QTemporaryDir state;
  const WindowFixture files;
  {
    Recovering f(state.path());
    f.open(files.writeScene("edge", WindowFixture::smallOptions()), 1);
    f.estimate();
    QTRY_VERIFY(!f.session().estimates()[0].kept.empty());
    QTRY_VERIFY(f.autosave().isIdle());
  }  // as if killed, after the light field was closed
  QDirIterator sessions(state.path(), {"session.episcope"}, QDir::Files,
                        QDirIterator::Subdirectories);
  QFile file(sessions.next());
  QVERIFY(file.open(QIODevice::ReadWrite));
  QJsonObject session = QJsonDocument::fromJson(file.readAll()).object();
  session["scenes"] = QJsonArray();
  file.resize(0);
  file.write(QJsonDocument(session).toJson());
  file.close();

  Recovering f(state.path());
  QVERIFY(!f.recover());

  QVERIFY(QDir(state.path() + "/sessions").isEmpty());
}

void SessionRecoveryTest::leftWindow_leavesNothingBehind() {
  const QTemporaryDir state;
  {
    Recovering f(state.path());
    f.openSmall("edge");
    f.estimate();
    QTRY_VERIFY(!f.session().estimates()[0].kept.empty());
    f.trigger("file.quit");
    f.window.findChild<QMessageBox*>("unsaved_results")->button(QMessageBox::Discard)->click();
    QTRY_VERIFY(!f.window.isVisible());
  }

  QVERIFY(QDir(state.path() + "/sessions").isEmpty());
}

void SessionRecoveryTest::runningSession_isNotOffered() {
  const QTemporaryDir state;
  Recovering f(state.path());
  f.openSmall("edge");
  f.estimate();
  QTRY_VERIFY(f.autosave().isIdle());

  QVERIFY(orphaned_workspaces((state.path() + "/sessions").toStdString()).empty());
}

}  // namespace episcope::in_session_recovery_test

EPISCOPE_WINDOW_TEST(session_recovery_test, SessionRecoveryTest)
#include "session_recovery_test.moc"
