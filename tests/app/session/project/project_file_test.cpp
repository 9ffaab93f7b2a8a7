// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/project_file.h"

#include "app/session/project_store.h"
#include "engine/core/error.h"
#include "tests/test_main.h"

#include <QDir>
#include <QTemporaryDir>

#include <fstream>
#include <sstream>

namespace episcope::in_project_file_test {

namespace {

Project sample(const std::filesystem::path& folder) {
  ProjectScene scene;
  scene.name = "édge “1”";
  scene.input = folder / "data/edge/lf.h5";
  scene.sample_hash = 0xfedcba9876543210;
  scene.reading = {{"flip", std::string("u")}, {"focus", 0.5}};
  scene.place = {{1, 2},
                 {30, 40},
                 -0.25,
                 render::Quantity::SignedError,
                 {{render::Quantity::SignedError, {-0.5, 0.5}}},
                 {0.05, 2, 1.5},
                 {CompareMode::Wipe, 0.3, true}};
  scene.place.judged = {
      JudgedPixels::Mask, {1, 2, 30, 40}, (folder / "data/mask.png").string(), "planes"};
  scene.place.capture.objects = {
      {.name = "scan",
       .mesh = (folder / "data/scan.ply").string(),
       .pairs = {{"p1", 1.5, 2.25, {1, 2, -3}}, {"p2", 7, 8, {0.5, 0, 4}, true}}}};
  scene.estimates = {{.id = 5,
                      .name = "mine",
                      .estimate = nullptr,
                      .display_range = {-1, 2},
                      .kept = folder / "work_files/a.h5",
                      .note = "too smooth\nat “edges”",
                      .foreign_file = "/elsewhere/map.pfm"}};
  scene.shown = 5;
  scene.strokes = folder / "work_files/edge.strokes";
  scene.labels.file = folder / "work_files/edge_labels.h5";
  scene.labels.strokes = 0x123456789abcdef0;
  ProjectScene demo;
  demo.name = demo.input = "demo";
  scene.id = 11;
  demo.id = 12;
  SweepPoint point{.point = {{"inner_scale", 0.5}}, .estimate = {}, .display_range = {-1, 2}};
  point.seconds = 1.5;
  point.vmv2013 = {{"mse_100", 0.25}};
  point.change_px = 0.125;
  SweepPoint failed{.point = {{"inner_scale", 1.0}}, .estimate = {}};
  failed.problem = "not enough memory";
  Sweep sweep;
  sweep.base = {"epi_l", {{"outer_scale", 2.0}}, {.views = ViewSelection::Center}};
  sweep.swept = {{"inner_scale", {0.5, 1.0}}};
  sweep.scenes = {{12, "demo", {point, failed}}, {11, scene.name, {point}}};
  return {{scene, demo}, 1, 0.1, {sweep}, {}};
}

std::string text_of(const std::filesystem::path& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

}  // namespace

class ProjectFileTest : public QObject {
  Q_OBJECT

 private slots:
  void project_readsBack();
  void sweeps_readBack();
  void sweepsOfUnknownMethods_areLeftOut();
  void paths_moveWithTheFile();
  void truncatedFile_isRefusedInASentence();
  void otherFiles_areRefused_data();
  void otherFiles_areRefused();
  void filesElsewhere_areRefused_data();
  void filesElsewhere_areRefused();
  void linksElsewhere_areRefused();
  void linkedFolderOfFiles_isTheProjectsOwn();
  void placeToSave_isTheProjectsOwnOrForgotten();
  void movedFolder_isFoundForOthers();
  void leftWorkspace_isOfferedOnceNobodyHoldsIt();
};

void ProjectFileTest::project_readsBack() {
  const QTemporaryDir folder;
  const std::filesystem::path root = folder.path().toStdString();
  const Project project = sample(root);

  write_project(root / "work.episcope", project);
  const Project read = read_project(root / "work.episcope");

  QCOMPARE(read.scenes.size(), 2U);
  QCOMPARE(read.current, 1U);
  QCOMPARE(read.bad_threshold_px, 0.1);
  const ProjectScene& scene = read.scenes[0];
  const ProjectScene& before = project.scenes[0];
  QCOMPARE(scene.name, before.name);
  QCOMPARE(scene.input, before.input);
  QCOMPARE(scene.sample_hash, before.sample_hash);
  QVERIFY(scene.reading == before.reading);
  QVERIFY(scene.place == before.place);
  QVERIFY(scene.strokes == before.strokes);
  QVERIFY(scene.labels.file == before.labels.file);
  QCOMPARE(scene.labels.strokes, before.labels.strokes);
  QCOMPARE(scene.estimates.at(0).name, std::string("mine"));
  QCOMPARE(scene.estimates[0].note, before.estimates[0].note);
  QCOMPARE(scene.estimates[0].foreign_file, before.estimates[0].foreign_file);
  QVERIFY(scene.estimates[0].kept == before.estimates[0].kept);
  QCOMPARE(scene.estimates[0].display_range, (Interval{-1, 2}));
  QVERIFY(scene.shown == scene.estimates[0].id && scene.compared == 0);
  QCOMPARE(read.scenes[1].input, std::string("demo"));
  QVERIFY(!read.scenes[1].place.quantity);
}

void ProjectFileTest::sweeps_readBack() {
  const QTemporaryDir folder;
  const std::filesystem::path root = folder.path().toStdString();
  const Project project = sample(root);

  write_project(root / "work.episcope", project);
  const Project read = read_project(root / "work.episcope");

  QCOMPARE(read.sweeps.size(), 1U);
  const Sweep& sweep = read.sweeps[0];
  QCOMPARE(sweep.base.method, std::string("epi_l"));
  QVERIFY(sweep.base.parameters == project.sweeps[0].base.parameters);
  QCOMPARE(sweep.swept.size(), 1U);
  QVERIFY(sweep.swept[0].values == project.sweeps[0].swept[0].values);
  QCOMPARE(sweep.scenes.size(), 2U);
  QCOMPARE(sweep.scenes[0].scene, read.scenes[1].id);
  QCOMPARE(sweep.scenes[0].name, std::string("demo"));
  const SweepPoint& point = sweep.scenes[0].points.at(0);
  const SweepPoint& before = project.sweeps[0].scenes[0].points[0];
  QVERIFY(point.point == before.point && point.vmv2013 == before.vmv2013);
  QCOMPARE(point.change_px, before.change_px);
  QCOMPARE(point.seconds, 1.5);
  QCOMPARE(point.display_range, (Interval{-1, 2}));
  QCOMPARE(sweep.scenes[0].points.at(1).problem, std::string("not enough memory"));
}

// As a later program may write them.
void ProjectFileTest::sweepsOfUnknownMethods_areLeftOut() {
  const QTemporaryDir folder;
  const std::filesystem::path root = folder.path().toStdString();
  Project project = sample(root);
  project.sweeps.push_back(project.sweeps[0]);
  project.sweeps[0].base.method = "later";
  project.sweeps.push_back(project.sweeps[1]);
  project.sweeps[2].swept[0].key = "later";

  write_project(root / "work.episcope", project);

  QCOMPARE(read_project(root / "work.episcope").sweeps.size(), 1U);
}

void ProjectFileTest::paths_moveWithTheFile() {
  const QTemporaryDir folder;
  const std::filesystem::path root = folder.path().toStdString();
  std::filesystem::create_directories(root / "here");
  write_project(root / "here/work.episcope", sample(root / "here"));

  QVERIFY(!QString::fromStdString(text_of(root / "here/work.episcope")).contains(folder.path()));
  std::filesystem::rename(root / "here", root / "there");
  const Project read = read_project(root / "there/work.episcope");

  QCOMPARE(read.scenes[0].input, (root / "there/data/edge/lf.h5").string());
  QVERIFY(read.scenes[0].estimates[0].kept == root / "there/work_files/a.h5");
}

// However short: one sentence that names the file, never half a project.
void ProjectFileTest::truncatedFile_isRefusedInASentence() {
  const QTemporaryDir folder;
  const std::filesystem::path root = folder.path().toStdString();
  write_project(root / "work.episcope", sample(root));
  const std::string whole = text_of(root / "work.episcope");

  for (std::size_t bytes = 0; bytes + 2 < whole.size(); bytes += 17) {
    std::ofstream(root / "cut.episcope") << whole.substr(0, bytes);
    QVERIFY_THROWS_EXCEPTION(IoError, (void)read_project(root / "cut.episcope"));
  }
}

void ProjectFileTest::otherFiles_areRefused_data() {
  QTest::addColumn<QString>("text");
  QTest::addColumn<QString>("told");
  QTest::newRow("not JSON") << "lf.h5"
                            << "is no whole project";
  QTest::newRow("other JSON") << "{\"a\": 1}"
                              << "is no whole project";
  QTest::newRow("another format") << "{\"format\": \"x\", \"version\": 1}"
                                  << "is no project";
  QTest::newRow("a newer one") << "{\"format\": \"episcope project\", \"version\": 99}"
                               << "newer";
  QTest::newRow("a number that fits no int")
      << "{\"format\": \"episcope project\", \"version\": 1e99}"
      << "where a whole number belongs";
  QTest::newRow("nested deeply") << "{\"format\": " + QString(1000000, '[') << "levels";
  QTest::newRow("wrong types") << "{\"format\": \"episcope project\", \"version\": \"one\"}"
                               << "is no whole project";
}

// They would be copied into the project when it is saved.
void ProjectFileTest::filesElsewhere_areRefused_data() {
  QTest::addColumn<QString>("part");
  QTest::newRow("result") << "result";
  QTest::newRow("strokes") << "strokes";
  QTest::newRow("labels") << "labels";
}

void ProjectFileTest::filesElsewhere_areRefused() {
  QFETCH(QString, part);
  const QTemporaryDir folder;
  const std::filesystem::path root = folder.path().toStdString();
  Project project = sample(root);
  ProjectScene& scene = project.scenes[0];
  std::filesystem::path& file = part == "result"    ? scene.estimates[0].kept
                                : part == "strokes" ? scene.strokes
                                                    : scene.labels.file;
  file = root.parent_path() / "secret";
  scene.input = root.parent_path() / "scenes/lf.h5";  // light fields may be anywhere
  const std::filesystem::path path = root / "work.episcope";
  write_project(path, project);

  try {
    (void)read_project(path);
    QFAIL("it was read");
  } catch (const IoError& error) {
    QVERIFY2(QString(error.what()).contains("secret, which is not in the folder"), error.what());
  }
  QCOMPARE(read_project(path, ProjectFiles::Anywhere).scenes[0].input, scene.input);
}

// What is called like a file of the project may be a link to any file of the user's.
void ProjectFileTest::linksElsewhere_areRefused() {
  const QTemporaryDir folder;
  const std::filesystem::path root = folder.path().toStdString();
  std::filesystem::create_directories(root / "here");
  std::ofstream(root / "secret") << "x";
  Project project = sample(root / "here");
  project.scenes[0].labels.file = root / "here/labels.h5";
  write_project(root / "here/work.episcope", project);
  std::filesystem::create_symlink(root / "secret", root / "here/labels.h5");
  JournalOwner owner{.name = {}, .source = {}, .file = (root / "here/labels.h5").string()};

  forget_file_elsewhere(owner, OwnFolders(root / "here/work.episcope"));

  QCOMPARE(owner.file, std::string());
  try {
    (void)read_project(root / "here/work.episcope");
    QFAIL("it was read");
  } catch (const IoError& error) {
    QVERIFY2(QString(error.what()).contains("labels.h5, which is not in the folder"), error.what());
  }
}

// A disk of their own for what is large.
void ProjectFileTest::linkedFolderOfFiles_isTheProjectsOwn() {
  const QTemporaryDir folder;
  const std::filesystem::path root = folder.path().toStdString();
  std::filesystem::create_directories(root / "here");
  std::filesystem::create_directories(root / "disk");
  std::filesystem::create_directory_symlink(root / "disk", root / "here/work_files");
  write_project(root / "here/work.episcope", sample(root / "here"));

  const Project read = read_project(root / "here/work.episcope");

  QVERIFY(std::filesystem::weakly_canonical(read.scenes[0].estimates[0].kept) ==
          std::filesystem::weakly_canonical(root / "disk/a.h5"));
}

void ProjectFileTest::placeToSave_isTheProjectsOwnOrForgotten() {
  const OwnFolders own("/a/work.episcope");
  JournalOwner inside{.name = {}, .source = {}, .file = "/a/labels.h5"};
  JournalOwner outside{.name = {}, .source = {}, .file = "/a/../b/labels.h5"};

  forget_file_elsewhere(inside, own);
  forget_file_elsewhere(outside, own);

  QCOMPARE(inside.file, std::string("/a/labels.h5"));
  QCOMPARE(outside.file, std::string());
}

void ProjectFileTest::otherFiles_areRefused() {
  QFETCH(QString, text);
  QFETCH(QString, told);
  const QTemporaryDir folder;
  const std::string path = folder.filePath("x.episcope").toStdString();
  std::ofstream(path) << text.toStdString();

  try {
    (void)read_project(path);
    QFAIL("it was read");
  } catch (const IoError& error) {
    QVERIFY2(QString(error.what()).contains(told), error.what());
  }
}

void ProjectFileTest::movedFolder_isFoundForOthers() {
  const QTemporaryDir folder;
  const std::filesystem::path root = folder.path().toStdString();
  std::filesystem::create_directories(root / "new/b");
  std::ofstream(root / "new/b/lf.h5") << "x";

  const MovedFolder moved = moved_folder(root / "old/a/lf.h5", root / "new/a/lf.h5");

  QVERIFY(moved.from == root / "old");
  QCOMPARE(moved_input(root / "old/b/lf.h5", moved), (root / "new/b/lf.h5").string());
  QCOMPARE(moved_input(root / "old/c/lf.h5", moved), std::string());  // is not there either
  QCOMPARE(moved_input("/elsewhere/lf.h5", moved), std::string());
  QCOMPARE(moved_input(root / "new/b/lf.h5", moved), std::string());  // is where it was
  QCOMPARE(moved_input("demo", moved), std::string());
}

void ProjectFileTest::leftWorkspace_isOfferedOnceNobodyHoldsIt() {
  const QTemporaryDir folder;
  const std::filesystem::path root = folder.path().toStdString();
  auto held = std::make_unique<Workspace>(root);
  write_project(held->project_file(), sample(root));
  QVERIFY(orphaned_workspaces(root).empty());

  held.reset();
  const auto left = orphaned_workspaces(root);
  QCOMPARE(left.size(), 1U);
  QCOMPARE(left[0].project.scenes.size(), 2U);
  const auto taken = Workspace::take_over(left[0].folder);
  QVERIFY(orphaned_workspaces(root).empty());
  taken->remove();
  QVERIFY(!std::filesystem::exists(left[0].folder));
}

}  // namespace episcope::in_project_file_test

EPISCOPE_TEST(project_file_test, ProjectFileTest)
#include "project_file_test.moc"
