// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/image_file.h"
#include "engine/io/formats/write_scene.h"
#include "engine/io/models/order/order_check.h"
#include "engine/io/open.h"
#include "tests/engine/io/archive_files.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <cmath>
#include <limits>

namespace episcope::in_contradiction_test {

using namespace episcope::test;

namespace fs = std::filesystem;

/// Files that are incomplete or contradict themselves: reported, never trusted.
class ContradictionTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<QTemporaryDir> folder_;
  fs::path path(const char* name) const { return fs::path(folder_->path().toStdString()) / name; }
  Scene open(const fs::path& file) const { return io::open_scene(file, {}, Progress(2)); }

  /// The plane as a raw file, with attributes of the test's choice.
  Scene open_with(const std::function<void(io::Hdf5Output&)>& more, RawArchive form = {}) const {
    form.has_attributes = false;
    form.more = more;
    write_raw_archive(path("lf.h5"), plane_scene(), form);
    return open(path("lf.h5"));
  }
  static Scene without_camera() {
    Scene scene = plane_scene();
    LightFieldInfo info = scene.light_field->info();
    info.camera = {};
    scene.light_field = std::make_shared<LightField>(bytes_of(scene).clone(), info);
    return scene;
  }
  static bool warns(const Scene& scene, const char* words) {
    for (const std::string& warning : scene.convention.warnings) {
      if (warning.find(words) != std::string::npos) return true;
    }
    return false;
  }
  QString refusal(const fs::path& file) const {
    try {
      (void)open(file);
    } catch (const IoError& error) {
      return QString::fromStdString(error.what());
    }
    return {};
  }
  static void set_camera(io::Hdf5Output& file, double baseline, double shift) {
    file.set_number("/", "dH", baseline);
    file.set_number("/", "focalLength", 1.5);
    file.set_number("/", "shift", shift);
    file.set_number("/", "camDistance", 12);
  }

 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void unknownCamera_staysUnknownInAnArchive() {
    const Scene scene = without_camera();
    io::write_archive(path("lf.h5"), scene, Progress(2));

    const Scene read = open(path("lf.h5"));

    QVERIFY(!read.light_field->info().camera.is_known());
    QVERIFY(!read.light_field->info().camera.cam_distance);
    QVERIFY(largest_difference(scene.truth->field, read.truth->field) < 1e-5);
  }

  void depthWithoutUsableCamera_saysWhatIsWrong_data() {
    QTest::addColumn<double>("baseline");
    QTest::addColumn<double>("shift");
    QTest::addColumn<QString>("words");
    const double nan = std::numeric_limits<double>::quiet_NaN();
    QTest::newRow("dH") << nan << 5.0 << "dH is not a finite number";
    QTest::newRow("shift") << 40.0 << nan << "shift is not a finite number";
    QTest::newRow("zero dH") << 0.0 << 5.0 << "must be positive";
  }
  void depthWithoutUsableCamera_saysWhatIsWrong() {
    QFETCH(double, baseline);
    QFETCH(double, shift);
    QFETCH(QString, words);

    const Scene read = open_with([&](io::Hdf5Output& file) { set_camera(file, baseline, shift); });

    QVERIFY2(warns(read, words.toUtf8()), describe(read.convention).c_str());
    QVERIFY2(warns(read, "GT_DEPTH is ignored because"), describe(read.convention).c_str());
    QVERIFY(!read.truth->has_disparity());
  }

  void cameraAsWords_isTold() {
    const Scene read = open_with([](io::Hdf5Output& file) {
      file.set_text("/", "dH", "40 mm");
      file.set_number("/", "focalLength", 1.5);
    });

    QVERIFY2(warns(read, "dH is not a single number"), describe(read.convention).c_str());
  }

  void groupForLightField_isNamed() {
    io::AtomicFile target(path("lf.h5"));
    io::Hdf5Output file(target);
    file.add_group("LF");
    file.close();
    target.commit();

    QVERIFY2(refusal(path("lf.h5")).contains("LF is a group"), qPrintable(refusal(path("lf.h5"))));
  }

  void singleLayer_isLeftOutWithAWarning() {
    RawArchive form;
    form.has_depth = false;
    const Scene read = open_with(
        [](io::Hdf5Output& file) {
          set_camera(file, 40, 5);
          file.add_dataset<float>("GT_DEPTH_BACKGROUND", {64, 80}, "", "");
          const std::vector<float> depth(64 * 80, 12.0F);
          file.write("GT_DEPTH_BACKGROUND", {{0, 0}, {64, 80}}, depth.data());
        },
        form);

    QVERIFY2(warns(read, "GT_DEPTH_FOREGROUND, is missing"), describe(read.convention).c_str());
    QVERIFY(read.truth->background.empty());
  }

  void zeroDepth_comesFromTheShift() {
    const Scene read = open_with([](io::Hdf5Output& file) { set_camera(file, 40, 0); });

    QVERIFY2(warns(read, "camDistance says 12"), describe(read.convention).c_str());
    QVERIFY(!read.light_field->info().camera.cam_distance);
  }

  void truthThatExplainsNothing_decidesNoOrder_data() {
    QTest::addColumn<double>("factor");
    for (const double factor : {37.0, 53.0, 71.0, 100.0}) {
      QTest::addRow("%g times too large", factor) << factor;
    }
  }
  void truthThatExplainsNothing_decidesNoOrder() {
    QFETCH(double, factor);
    const Scene scene = plane_scene();
    ViewStack<float> map = scene.truth->field.disparity.clone();
    std::for_each(map.data(), map.data() + map.size(),
                  [&](float& d) { d = static_cast<float>(factor * d); });
    const io::OrderEvidence truth{{2, 2}, {map.view({2, 2}), {}}};

    const io::OrderFinding finding =
        io::find_order(scene.light_field->samples(), {truth}, {{}, "the test says so"},
                       io::Flip::Auto, Progress(1));

    QCOMPARE(finding.order, std::string("as stored"));
    QVERIFY2(finding.check.find("slopes") != std::string::npos, finding.check.c_str());
    QCOMPARE(finding.warnings.size(), std::size_t{1});
  }

  void wrongShift_makesTheTruthPoor_data() {
    QTest::addColumn<double>("shift");
    QTest::addColumn<bool>("is_poor");
    QTest::newRow("right") << 5.0 << false;
    QTest::newRow("wrong") << 1.0 << true;
  }
  void wrongShift_makesTheTruthPoor() {
    QFETCH(double, shift);
    QFETCH(bool, is_poor);

    const Scene read = open_with([&](io::Hdf5Output& file) { set_camera(file, 40, shift); });

    QVERIFY2(warns(read, "hardly explains") == is_poor, describe(read.convention).c_str());
  }

  void sizeInAttributes_isComparedWithTheData() {
    const Scene read = open_with([](io::Hdf5Output& file) {
      file.set_integers("/", "xRes", {640});
      file.set_integers("/", "yRes", {64});
    });

    QVERIFY2(warns(read, "xRes says 640, but LF has 80"), describe(read.convention).c_str());
    QVERIFY(!warns(read, "yRes"));
  }

  void channelsWithoutTheirAxis_areRefused() {
    io::AtomicFile target(path("lf.h5"));
    io::Hdf5Output file(target);
    add_bytes(file, "LF", {3, 3, 8, 24}, std::vector<std::uint8_t>(3 * 3 * 8 * 24));
    file.set_integers("/", "channels", {3});
    file.close();
    target.commit();

    QVERIFY2(refusal(path("lf.h5")).contains("channels says 3"),
             qPrintable(refusal(path("lf.h5"))));
  }

  void floatSamples_areBroughtIntoRange_data() {
    QTest::addColumn<double>("factor");
    QTest::addColumn<int>("nans");
    QTest::addColumn<QString>("words");
    QTest::newRow("of a byte") << 1.0 << 0 << "divided by 255.";
    QTest::newRow("of 16 bits") << 257.0 << 0 << "divided by 65535";
    QTest::newRow("NaN") << 1 / 255.0 << 34909 << "34909 of 384000 samples";
  }
  void floatSamples_areBroughtIntoRange() {
    QFETCH(double, factor);
    QFETCH(int, nans);
    QFETCH(QString, words);
    const Scene scene = plane_scene();
    const ViewStack<std::uint8_t>& bytes = bytes_of(scene);
    ViewStack<float> floats({5, 5}, 64, 80, 3);
    for (std::size_t i = 0; i < floats.size(); ++i) {
      floats.data()[i] = static_cast<float>(factor * bytes.data()[i]);
    }
    for (int i = 0; i < nans; ++i) {
      floats.data()[11 * static_cast<std::size_t>(i)] = std::numeric_limits<float>::quiet_NaN();
    }
    Scene stored = scene;
    stored.light_field = std::make_shared<LightField>(std::move(floats), scene.light_field->info());
    io::write_archive(path("lf.h5"), stored, Progress(2));

    const Scene read = open(path("lf.h5"));

    QVERIFY2(warns(read, words.toUtf8()), describe(read.convention).c_str());
    QVERIFY(QString::fromStdString(read.convention.order_check).contains("truth"));
    QVERIFY2(!warns(read, "hardly explains"), describe(read.convention).c_str());
    const auto view = read.light_field->view<float>({2, 2});
    const auto before = bytes.view({2, 2});
    for (std::size_t i = 0; i < view.size(); ++i) {
      if (view.data[i] == 0) continue;
      QVERIFY(std::abs(view.data[i] - static_cast<float>(before.data[i]) / 255) < 1e-6F);
    }
  }

  void companionsThatDoNotFit_areLeftOutWithAWarning() {
    io::write_archive(path("lf.h5"), plane_scene(), Progress(2));
    const std::pair<const char*, const char*> files[] = {
        {"edge_weights.h5", "EDGE_WEIGHTS"}, {"feature_depth_probabilities.h5", "Probabilities"}};
    for (const auto& [name, dataset] : files) {
      io::AtomicFile target(path(name));
      io::Hdf5Output file(target);
      add_bytes(file, dataset, {5, 5, 80, 64}, std::vector<std::uint8_t>(5 * 5 * 80 * 64));
      file.close();
      target.commit();
    }

    const Scene read = open(path("lf.h5"));

    QVERIFY(read.companions.empty());
    QVERIFY2(warns(read, "The file of edge weights is ignored"), describe(read.convention).c_str());
    QVERIFY(warns(read, "The file of probabilities (depth) is ignored"));
  }

  void damagedPng_isRefused_data() {
    QTest::addColumn<int>("kept");
    QTest::addColumn<int>("changed");
    QTest::addColumn<bool>("is_damaged");
    const int all = 1 << 20;
    QTest::newRow("whole") << all << -1 << false;
    QTest::newRow("cut in the middle") << 300 << -1 << true;
    QTest::newRow("cut after the signature") << 8 << -1 << true;
    QTest::newRow("one byte changed") << all << 200 << true;
    QTest::newRow("no PNG") << all << 0 << true;
  }
  void damagedPng_isRefused() {
    QFETCH(int, kept);
    QFETCH(int, changed);
    QFETCH(bool, is_damaged);
    const Scene scene = plane_scene();
    io::write_png(path("view.png"), bytes_of(scene).view({0, 0}));
    QFile file(QString::fromStdString(path("view.png").string()));
    QVERIFY(file.open(QIODevice::ReadWrite));
    QByteArray bytes = file.readAll().left(kept);
    if (changed >= 0) bytes[changed] = static_cast<char>(bytes[changed] ^ 1);
    file.resize(0);
    file.write(bytes);
    file.close();

    if (is_damaged) {
      QVERIFY_THROWS_EXCEPTION(IoError, (void)io::decode_image(path("view.png")));
    } else {
      QVERIFY(std::get<Image<std::uint8_t>>(io::decode_image(path("view.png"))).width() == 80);
    }
  }

  void unknownCamera_staysUnknownInABenchmarkFolder() {
    io::write_benchmark_folder(path("folder"), without_camera(), Progress(2));

    const Scene read = open(path("folder"));

    QVERIFY(!read.light_field->info().camera.is_known());
    QVERIFY2(read.convention.warnings.empty(), describe(read.convention).c_str());
  }

  void sizeInAConfig_isComparedWithTheViews() {
    const Scene scene = plane_scene();
    io::write_benchmark_folder(path("folder"), scene, Progress(2));
    QFile config(QString::fromStdString((path("folder") / "parameters.cfg").string()));
    QVERIFY(config.open(QIODevice::ReadWrite));
    const QByteArray text = config.readAll().replace("x_px = 80", "x_px = 999");
    config.seek(0);
    config.write(text);
    config.close();

    const Scene read = open(path("folder"));

    QVERIFY2(warns(read, "is 999, but the views have 80 px"), describe(read.convention).c_str());
    QVERIFY(std::abs(read.light_field->info().camera.shift -
                     scene.light_field->info().camera.shift) < 1e-9);
  }
};

}  // namespace episcope::in_contradiction_test

EPISCOPE_TEST(contradiction_test, ContradictionTest)
#include "contradiction_test.moc"
