// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/load_scene.h"

#include "app/session/collections.h"
#include "app/session/user_folders.h"
#include "engine/core/error.h"
#include "engine/io/base/image_file.h"
#include "engine/io/models/scribble_file.h"
#include "tests/app/session/tiny_scene.h"
#include "tests/test_main.h"

#include <QFile>
#include <QTemporaryDir>

namespace episcope::in_load_scene_test {

namespace {

std::filesystem::path path_of(const QTemporaryDir& folder) {
  return folder.path().toStdString();
}

scenes::RenderOptions tiny_options() {
  scenes::RenderOptions options;
  options.grid = {3, 3};
  options.height = options.width = 64;
  return options;
}

}  // namespace

class LoadSceneTest : public QObject {
  Q_OBJECT

 private slots:
  void builtinInput_isRecognised_data();
  void builtinInput_isRecognised();
  void cacheFolder_followsTheEnvironment();
  void keptScene_readsBackTheSame();
  void damagedScene_isNotRead();
  void damagedScene_isReplaced();
  void unwritableFolder_keepsNothing();
  void otherOptions_areKeptApart();
  void builtinScene_isTheSameFromTheCache();
  void gantry_isTheSameFromTheCache();
  void sceneWithOptions_isRenderedAndNotKept();
  void unknownBuiltinScene_isRefused();
  void scribblesBesideAnImageGrid_areRead();
  void onlyLightFieldBelow_isOpened();
  void missingFile_isRefusedWithItsPath();
};

void LoadSceneTest::builtinInput_isRecognised_data() {
  QTest::addColumn<QString>("input");
  QTest::addColumn<QString>("id");
  QTest::newRow("demo") << "demo"
                        << "demo";
  QTest::newRow("empty scene") << "demo:"
                               << "demo";
  QTest::newRow("scene") << "demo:slant"
                         << "slant";
  QTest::newRow("options") << "demo?size=64"
                           << "demo?size=64";
  QTest::newRow("path") << "demo.h5"
                        << "";
  QTest::newRow("folder") << "./demo"
                          << "";
}

void LoadSceneTest::builtinInput_isRecognised() {
  QFETCH(QString, input);
  QFETCH(QString, id);

  QCOMPARE(builtin_scene_id(input.toStdString()), id.toStdString());
}

void LoadSceneTest::cacheFolder_followsTheEnvironment() {
  qputenv("XDG_CACHE_HOME", "/somewhere");
  QCOMPARE(default_cache_folder().string(), std::string("/somewhere/episcope"));

  qputenv("XDG_CACHE_HOME", "relative");
  qputenv("HOME", "/home/user");
  QCOMPARE(default_cache_folder().string(), std::string("/home/user/.cache/episcope"));
  qunsetenv("XDG_STATE_HOME");
  QCOMPARE(default_journal_folder().string(),
           std::string("/home/user/.local/state/episcope/journals"));
}

void LoadSceneTest::keptScene_readsBackTheSame() {
  const QTemporaryDir folder;
  const SceneCache cache(path_of(folder));
  const auto scene = tiny_scene();

  QVERIFY(!cache.read("edge", tiny_options(), true, Progress()));
  QVERIFY(cache.write("edge", tiny_options(), *scene, Progress()));
  const auto read = cache.read("edge", tiny_options(), true, Progress());

  QVERIFY(read.has_value());
  QCOMPARE(read->light_field->sample_hash(), scene->light_field->sample_hash());
  const auto& truth = scene->truth->field.disparity;
  const auto& read_truth = read->truth->field.disparity;
  QCOMPARE(read_truth.size(), truth.size());
  // Depth is stored as float: its rounding moves a disparity of a few px by less than 1e-5.
  for (std::size_t i = 0; i < truth.size(); ++i) {
    QVERIFY(std::abs(read_truth.data()[i] - truth.data()[i]) < 1e-5F);
  }
  QCOMPARE(read->truth->labels.size(), scene->truth->labels.size());
}

void LoadSceneTest::damagedScene_isNotRead() {
  const QTemporaryDir folder;
  const SceneCache cache(path_of(folder));
  QVERIFY(cache.write("edge", tiny_options(), *tiny_scene(), Progress()));
  QFile file(QString::fromStdString((cache.place("edge", tiny_options()) / "lf.h5").string()));

  QVERIFY(file.resize(file.size() / 2));

  QVERIFY(!cache.read("edge", tiny_options(), true, Progress()));
  QVERIFY(!file.exists());
}

void LoadSceneTest::damagedScene_isReplaced() {
  const QTemporaryDir folder;
  const SceneCache cache(path_of(folder));
  QVERIFY(cache.write("edge", tiny_options(), *tiny_scene(), Progress()));
  QFile file(QString::fromStdString((cache.place("edge", tiny_options()) / "lf.h5").string()));
  QVERIFY(file.resize(1000));

  QVERIFY(cache.write("edge", tiny_options(), *tiny_scene(), Progress()));

  QVERIFY(cache.read("edge", tiny_options(), true, Progress()).has_value());
}

void LoadSceneTest::unwritableFolder_keepsNothing() {
  const QTemporaryDir folder;
  const std::filesystem::path not_a_folder = path_of(folder) / "file";
  QFile file(QString::fromStdString(not_a_folder.string()));
  QVERIFY(file.open(QIODevice::WriteOnly));
  const SceneCache cache(not_a_folder);

  QVERIFY(!cache.write("edge", tiny_options(), *tiny_scene(), Progress()));
  QVERIFY(!cache.read("edge", tiny_options(), true, Progress()));
  QVERIFY(!SceneCache("").write("edge", tiny_options(), *tiny_scene(), Progress()));
}

void LoadSceneTest::otherOptions_areKeptApart() {
  const SceneCache cache("folder");
  auto noisy = tiny_options();
  noisy.noise_sigma = 1;
  auto reseeded = tiny_options();
  reseeded.seed = 2;

  QVERIFY(cache.place("edge", tiny_options()) != cache.place("edge", noisy));
  QVERIFY(cache.place("edge", tiny_options()) != cache.place("edge", reseeded));
  QVERIFY(cache.place("edge", tiny_options()) != cache.place("slant", tiny_options()));
}

void LoadSceneTest::builtinScene_isTheSameFromTheCache() {
  const QTemporaryDir folder;
  LoadOptions options;
  options.cache_folder = path_of(folder);
  int previews = 0;
  options.open.on_center_view = [&previews](const Image<std::uint8_t>& center,
                                            const LightFieldInfo&, GridShape grid) {
    ++previews;
    QVERIFY(!center.empty());
    QCOMPARE(grid.count(), 81);
  };

  const Scene rendered = load_scene("demo:fronto", options, Progress());
  QCOMPARE(previews, 1);
  store_in_cache("demo:fronto", rendered, options.cache_folder, Progress());
  const Scene kept = load_scene("demo:fronto", options, Progress());

  QVERIFY(std::filesystem::exists(SceneCache(path_of(folder)).place("fronto", {}) / "lf.h5"));
  QCOMPARE(previews, 2);
  QCOMPARE(kept.convention.order, rendered.convention.order);
  QCOMPARE(kept.truth->regions.size(), rendered.truth->regions.size());
  QCOMPARE(kept.light_field->sample_hash(), rendered.light_field->sample_hash());
  QCOMPARE(kept.light_field->info().source, std::string("demo:fronto"));
  QCOMPARE(rendered.light_field->info().source, std::string("demo:fronto"));
  QCOMPARE(kept.light_field->info().name, rendered.light_field->info().name);
}

void LoadSceneTest::gantry_isTheSameFromTheCache() {
  const QTemporaryDir folder;
  const std::string input = "demo:gantry?size=200x150&grid=3x3&seed=5";
  LoadOptions options;
  int previews = 0;
  options.open.on_center_view = [&previews](const Image<std::uint8_t>& center,
                                            const LightFieldInfo&, GridShape grid) {
    ++previews;
    QCOMPARE(center.width(), 200);
    QCOMPARE(grid.count(), 9);
  };

  const Scene made = load_scene(input, options, Progress());
  QVERIFY(!gantry_folder(input, path_of(folder)));
  options.cache_folder = path_of(folder);
  const Scene stored = load_scene(input, options, Progress());
  const Scene kept = load_scene(input, options, Progress());

  QCOMPARE(previews, 3);
  QCOMPARE(stored.light_field->sample_hash(), made.light_field->sample_hash());
  QCOMPARE(kept.light_field->sample_hash(), made.light_field->sample_hash());
  QCOMPARE(kept.light_field->info().source, input);
  const auto demo = gantry_folder(input, path_of(folder));
  QVERIFY(demo);
  QCOMPARE(demo->pattern().size(), 14U);
  QVERIFY(std::filesystem::exists(demo->mesh()) && std::filesystem::exists(demo->picks()));
  QVERIFY(!gantry_folder("demo:gantry?seed=6", path_of(folder)));
  QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)load_scene("demo:gantry?grid=1x1", {}, Progress()));
}

void LoadSceneTest::sceneWithOptions_isRenderedAndNotKept() {
  const QTemporaryDir folder;
  LoadOptions options;
  options.cache_folder = path_of(folder);
  const std::string input = "demo:random?seed=7&kind=thin&size=40x32&grid=3x5";

  const Scene scene = load_scene(input, options, Progress());
  store_in_cache(input, scene, options.cache_folder, Progress());

  QCOMPARE(scene.light_field->grid(), (GridShape{3, 5}));
  QCOMPARE(scene.light_field->width(), 40);
  QCOMPARE(scene.light_field->height(), 32);
  QCOMPARE(scene.light_field->info().name, std::string("random_thin_7"));
  QCOMPARE(scene.light_field->info().source, input);
  QVERIFY(std::filesystem::is_empty(path_of(folder)));
}

void LoadSceneTest::unknownBuiltinScene_isRefused() {
  QVERIFY_THROWS_EXCEPTION(Unavailable, (void)load_scene("demo:slamt", {}, Progress()));
}

void LoadSceneTest::scribblesBesideAnImageGrid_areRead() {
  const QTemporaryDir folder;
  const auto scene = tiny_scene();
  for (int i = 0; i < 9; ++i) {
    const std::string name = "view_0" + std::to_string(i / 3) + "_0" + std::to_string(i % 3);
    io::write_png(path_of(folder) / (name + ".png"),
                  scene->light_field->view<std::uint8_t>({i / 3, i % 3}));
  }
  const Scene read = load_scene(folder.path().toStdString(), {}, Progress());
  QVERIFY(read.scribbles.empty());
  QCOMPARE(label_place(*read.light_field), path_of(folder) / "labels.h5");
  Scribbles painted;
  painted.views.push_back({{0, 2}, Image<std::int32_t>(64, 64)});
  painted.views[0].labels.at(5, 6) = 4;
  painted.labels = {{4, "four", {1, 2, 3}}};

  io::write_scribbles(label_place(*read.light_field), painted, read, Progress());
  const Scene again = load_scene(folder.path().toStdString(), {}, Progress());

  QCOMPARE(again.scribbles.views.size(), std::size_t{1});
  QCOMPARE(again.scribbles.views[0].view, (ViewIndex{0, 2}));
  QCOMPARE(again.scribbles.views[0].labels.at(5, 6), 4);
  QVERIFY(again.scribbles.labels == painted.labels);
}

void LoadSceneTest::onlyLightFieldBelow_isOpened() {
  const QTemporaryDir folder;
  const auto scene = tiny_scene();
  const auto write = [&](const char* inside) {
    const std::filesystem::path views = path_of(folder) / inside / "images" / "views";
    std::filesystem::create_directories(views);
    for (int i = 0; i < 9; ++i) {
      io::write_png(
          views / ("view_0" + std::to_string(i / 3) + "_0" + std::to_string(i % 3) + ".png"),
          scene->light_field->view<std::uint8_t>({i / 3, i % 3}));
    }
  };
  write("one");
  QCOMPARE(load_scene(folder.path().toStdString(), {}, Progress()).light_field->sample_hash(),
           scene->light_field->sample_hash());
  write("two");
  QVERIFY_THROWS_EXCEPTION(IsCollection,
                           (void)load_scene(folder.path().toStdString(), {}, Progress()));
}

void LoadSceneTest::missingFile_isRefusedWithItsPath() {
  try {
    (void)load_scene("/no/such/lf.h5", {}, Progress());
    QFAIL("a missing file was opened");
  } catch (const IoError& error) {
    QVERIFY(std::string(error.what()).find("/no/such/lf.h5") != std::string::npos);
  }
}

}  // namespace episcope::in_load_scene_test

EPISCOPE_CORE_TEST(load_scene_test, LoadSceneTest)
#include "load_scene_test.moc"
