// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/annotate/annotation_files.h"
#include "app/session/project_file.h"
#include "app/session/project_store.h"
#include "app/session/result_files.h"
#include "tests/app/gui/files/working.h"
#include "tests/window_test_main.h"

#include <QDir>
#include <QFile>

#include <sys/resource.h>
#include <algorithm>
#include <csignal>

// What a project holds and the window cannot show stays in it; what was done counts as work.

namespace episcope::in_unlost_work_test {

namespace {

/// As on a full disk: files cannot grow.
class NoRoom {
 public:
  NoRoom() {
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &former_);
    const rlimit none{1, former_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &none);
  }
  ~NoRoom() {
    setrlimit(RLIMIT_FSIZE, &former_);
    std::signal(SIGXFSZ, handler_);
  }
  NoRoom(const NoRoom&) = delete;
  NoRoom& operator=(const NoRoom&) = delete;

 private:
  rlimit former_{};
  void (*handler_)(int) = nullptr;
};

scenes::RenderOptions smaller_options() {
  scenes::RenderOptions options = WindowFixture::smallOptions();
  options.grid = {3, 3};
  options.height = options.width = 48;
  return options;
}

void annotate(Working& f) {
  QVERIFY(f.window.bench().document.edit(
      [](AnnotationDocument& document) { document.add_label("mine"); }));
}

QStringList files_of(const QString& project, const QString& suffix) {
  const auto folder = files_of_project(project.toStdString());
  return QDir(QString::fromStdString(folder.string())).entryList({'*' + suffix});
}

// A result and a stroke on a light field that is then rendered anew, smaller.
void save_what_will_not_fit(Working& f, const QString& path) {
  f.openSmall("edge");
  f.estimate();
  annotate(f);
  f.saveAs(path);
  QVERIFY(QDir(f.path("edge")).removeRecursively());
  f.writeScene("edge", smaller_options());
  f.open(path, 1);
  QTRY_VERIFY_WITH_TIMEOUT(
      f.session().scene() && f.session().light_field()->grid() == (GridShape{3, 3}),
      kScenePatience);
}

}  // namespace

class UnlostWorkTest : public QObject {
  Q_OBJECT

 private slots:
  void whatDoesNotFit_staysInTheProject();
  void strokesThatCannotBeRead_stayBesideNewOnes();
  void keptLines_areAskedFor();
  void keptLines_markTheProject();
  void mapThatWasOpened_isAFileAlready();
  void scribblesSavedOnTheWayToAnotherScene_areSaved();
  void fullDisk_whileAProjectIsSaved_isTold();
  void manyResults_areEvaluatedOnce();
};

void UnlostWorkTest::whatDoesNotFit_staysInTheProject() {
  Working f;
  const QString path = f.path("work.episcope");
  save_what_will_not_fit(f, path);
  QVERIFY(f.session().estimates().empty());
  QVERIFY(!f.project().hasChanged());

  f.saveAs(path);

  QCOMPARE(files_of(path, ".h5").size(), 1);
  QCOMPARE(files_of(path, ".strokes").size(), 1);
  const Project kept = read_project(path.toStdString());
  QCOMPARE(kept.scenes.at(0).estimates.size(), 1U);
  QVERIFY(std::filesystem::exists(kept.scenes[0].strokes));
  const QString copy = f.path("copy.episcope");
  f.saveAs(copy);
  QCOMPARE(files_of(copy, ".h5").size(), 1);
  QCOMPARE(files_of(copy, ".strokes").size(), 1);
}

void UnlostWorkTest::strokesThatCannotBeRead_stayBesideNewOnes() {
  Working f;
  const QString path = f.path("work.episcope");
  save_what_will_not_fit(f, path);

  annotate(f);
  f.saveAs(path);

  QCOMPARE(files_of(path, ".strokes").size(), 2);
}

void UnlostWorkTest::keptLines_areAskedFor() {
  Working f;
  f.openSmall("edge");
  QVERIFY(f.window.bench().guards.may_leave(Leaving::Scene));

  f.session().set_measurements({.list = {{.name = "line 1"}}});

  QVERIFY(!f.window.bench().guards.may_leave(Leaving::Scene));
  f.saveAs(f.path("work.episcope"));
  QVERIFY(f.window.bench().guards.may_leave(Leaving::Scene));
}

void UnlostWorkTest::keptLines_markTheProject() {
  Working f;
  f.openSmall("edge");
  f.saveAs(f.path("work.episcope"));
  f.session().set_view({1, 7});
  QVERIFY(!f.project().hasChanged());

  f.session().set_measurements({.list = {{.name = "line 1"}}});

  QVERIFY(f.project().hasChanged());
  f.saveAs(f.path("work.episcope"));
  QVERIFY(!f.project().hasChanged());
  f.session().set_label_marks({.hidden = {3}, .locked = {}});
  QVERIFY(f.project().hasChanged());
}

void UnlostWorkTest::scribblesSavedOnTheWayToAnotherScene_areSaved() {
  Working f;
  f.openSmall("edge");
  f.openSmall("slant");
  annotate(f);
  const auto first = f.session().scenes()[0]->id;
  QCOMPARE(f.window.bench().document.unsavedScenes().size(), 1U);

  f.trigger("file.save_scribbles");
  f.show(first);

  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().document.unsavedScenes().empty(), kPatience);
}

void UnlostWorkTest::fullDisk_whileAProjectIsSaved_isTold() {
  Working f;
  f.openSmall("edge");
  annotate(f);
  f.openSmall("slant");
  annotate(f);
  DocumentController& document = f.window.bench().document;
  QStringList problems;
  connect(&document, &DocumentController::problem, this,
          [&](const QString& sentence) { problems << sentence; });
  {
    const NoRoom full;
    document.noteKept(document.editedDocuments());
  }

  QVERIFY(!problems.isEmpty());
  QVERIFY2(problems[0].contains("can no longer be recovered"), qPrintable(problems[0]));
}

// More than the evaluations that are kept of results which nobody asks for.
void UnlostWorkTest::manyResults_areEvaluatedOnce() {
  constexpr int kMany = 30;
  Working f;
  f.openSmall("edge");
  f.estimate();
  const EstimatePtr estimate = f.session().estimates()[0].estimate;
  for (int i = 1; i < kMany; ++i) {
    f.session().add_estimate(estimate, {-1, 1}, f.session().generation());
  }
  const auto has_all = [&f] {
    return std::ranges::all_of(f.session().estimates(), [&f](const EstimateEntry& each) {
      const ViewIndex center = f.session().light_field()->center();
      return f.session().evaluation({each.id, center, Protocol::Vmv2013}) &&
             f.session().evaluation({each.id, center, Protocol::Benchmark2016});
    });
  };
  QTRY_VERIFY_WITH_TIMEOUT(!f.session().is_evaluating() && has_all(), kScenePatience);

  QTest::qWait(200);

  QVERIFY(!f.session().is_evaluating());
  QVERIFY(has_all());
}

// Also after a crash, when the session comes back from its own files.
void UnlostWorkTest::mapThatWasOpened_isAFileAlready() {
  Working f;
  f.openSmall("edge");
  f.estimate();
  save_map(f.path("map.pfm").toStdString(), *f.session().estimates()[0].estimate,
           f.session().view());
  f.session().remove_estimate(f.session().estimates()[0].id);

  f.window.bench().results.open(f.path("map.pfm"));

  QTRY_COMPARE_WITH_TIMEOUT(f.session().estimates().size(), 1U, kScenePatience);
  QVERIFY(f.window.bench().guards.may_leave(Leaving::Session));
  const auto left = project_of(f.session());
  QVERIFY(scene_of(left.scenes.at(0), false).estimates.at(0).is_saved);
  f.saveAs(f.path("work.episcope"));
  QVERIFY(
      read_project(f.path("work.episcope").toStdString()).scenes.at(0).estimates.at(0).is_saved);
}

}  // namespace episcope::in_unlost_work_test

EPISCOPE_WINDOW_TEST(unlost_work_test, UnlostWorkTest)
#include "unlost_work_test.moc"
