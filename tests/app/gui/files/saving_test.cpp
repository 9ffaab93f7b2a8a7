// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/files/file_controller.h"
#include "app/gui/shell/dialogs.h"
#include "engine/io/open.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/controls/message_bar.h"
#include "widgets/panels/metric_table.h"

#include <QAction>
#include <QDir>
#include <QFile>
#include <QFileDialog>

namespace episcope::in_saving_test {

class SavingTest : public QObject {
  Q_OBJECT

 private:
  static QString message(WindowFixture& f) {
    return f.window.findChild<MessageBar*>("messageBar")->text();
  }

 private slots:
  void everyForm_isWritten_data();
  void everyForm_isWritten();
  void whatIsPainted_isSaved();
  void openLightField_isNotWrittenOver();
  void saveDialogs_beginBesideTheLightFieldInFrontWithItsName();
  void saveDialogs_beginWhereFilesCanBeMade();
  void withoutScene_nothingCanBeSaved();
};

void SavingTest::everyForm_isWritten_data() {
  QTest::addColumn<QString>("form");
  for (const io::Writer& writer : io::writers()) QTest::newRow(writer.id) << QString(writer.id);
}

void SavingTest::everyForm_isWritten() {
  QFETCH(QString, form);
  WindowFixture f;
  f.openSmall();
  const io::Writer& writer = *io::writer_named(form.toStdString());
  const QString name = f.path("saved") + (writer.writes_folder() ? "" : writer.suffixes.front());
  auto* action = f.window.findChild<QAction*>("file.save_as." + form);
  QVERIFY(action);
  action->trigger();
  auto* dialog = f.window.findChild<QFileDialog*>("save_light_field");

  emit dialog->fileSelected(name);

  QTRY_VERIFY2_WITH_TIMEOUT(message(f).startsWith("Saved: "), qPrintable(message(f)), kPatience);
  if (writer.holds.has_rows) {
    const Scene scene = io::open_scene(name.toStdString(), {}, Progress());
    QCOMPARE(scene.light_field->sample_hash(),
             f.window.bench().session.light_field()->sample_hash());
  }
  const auto losses = io::unsupported_parts(writer, *f.window.bench().session.scene());
  for (const std::string& sentence : losses) {
    QVERIFY2(message(f).contains(QString::fromStdString(sentence)), qPrintable(message(f)));
  }
}

void SavingTest::whatIsPainted_isSaved() {
  WindowFixture f;
  f.openSmall();
  f.trigger("annotate.mode");
  f.drag({20, 20}, {20, 40});
  QTRY_VERIFY(!f.document().scribbles().painted_views().empty());

  save_light_field(f.window.bench(), *io::writer_named("archive"), f.path("saved.h5"));

  QTRY_VERIFY2_WITH_TIMEOUT(message(f).startsWith("Saved: "), qPrintable(message(f)), kPatience);
  const Scene scene = io::open_scene(f.path("saved.h5").toStdString(), {}, Progress());
  QCOMPARE(scene.scribbles.views.size(), std::size_t{1});
  QVERIFY(scene.scribbles.views.front().labels.at(20, 30) != 0);
}

void SavingTest::openLightField_isNotWrittenOver() {
  WindowFixture f;
  f.openSmall();
  const QString open = QString::fromStdString(f.window.bench().session.input());
  QFile file(open);
  QVERIFY(file.open(QIODevice::ReadOnly));
  const QByteArray before = file.readAll();
  file.close();

  save_light_field(f.window.bench(), *io::writer_named("archive"), open);

  QVERIFY2(message(f).contains("belongs to the light field that is open"), qPrintable(message(f)));
  QVERIFY(file.open(QIODevice::ReadOnly));
  QVERIFY(file.readAll() == before);
}

void SavingTest::saveDialogs_beginBesideTheLightFieldInFrontWithItsName() {
  WindowFixture f;
  f.openSmall("slant");
  f.openSmall("edge");
  f.runAndWait();
  begin_dialogs_beside(f.path("elsewhere/result.h5"));
  struct Asked {
    const char* command;
    const char* dialog;
  };
  for (const auto& [command, name] :
       {Asked{"file.save_picture", "save_picture"}, Asked{"file.save_map", "save_map"},
        Asked{"file.save_project", "save_project"},
        Asked{"file.save_scribbles_as", "save_scribbles"}, Asked{"file.export", "export_result"},
        Asked{nullptr, "save_table"}}) {
    command ? f.trigger(command) : find<MetricTable>(f.window).saveRequested("csv", "");
    auto* dialog = f.window.findChild<QFileDialog*>(name);
    QVERIFY2(dialog, name);
    QVERIFY2(dialog->directory() == QDir(f.path("edge")),
             qPrintable(name + (": " + dialog->directory().path())));
    const QString file = QFileInfo(dialog->selectedFiles().value(0)).fileName();
    QVERIFY2(file.startsWith("edge") || file == "labels.h5", qPrintable(name + (": " + file)));
    dialog->reject();
  }
}

// A folder where a file could not be written was once proposed ever after.
void SavingTest::saveDialogs_beginWhereFilesCanBeMade() {
  WindowFixture f;
  f.openSmall();
  QDir(f.path("edge")).removeRecursively();
  const auto folder = [&f](const QString& chosen) {
    f.trigger("file.save_picture");
    auto* dialog = f.window.findChild<QFileDialog*>("save_picture");
    const QDir found = dialog->directory();
    if (!chosen.isEmpty()) emit dialog->fileSelected(chosen);
    dialog->reject();
    QTest::qWait(0);  // it deletes itself
    return found;
  };
  QDir().mkpath(f.path("there"));

  QCOMPARE(folder(f.path("gone/a.png")), QDir::home());
  QCOMPARE(folder(f.path("there/a.png")), QDir::home());
  QCOMPARE(folder({}), QDir(f.path("there")));
}

void SavingTest::withoutScene_nothingCanBeSaved() {
  WindowFixture f;

  QVERIFY(!f.window.bench().commands.find("file.save_as")->isEnabled());
}

}  // namespace episcope::in_saving_test

EPISCOPE_WINDOW_TEST(saving_test, SavingTest)
#include "saving_test.moc"
