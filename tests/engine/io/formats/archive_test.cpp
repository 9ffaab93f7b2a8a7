// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/formats/archive_companions.h"
#include "engine/io/formats/write_scene.h"
#include "engine/io/write.h"
#include "tests/engine/io/archive_files.h"
#include "tests/engine/io/archive_folder.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <hdf5.h>

#include <cmath>
#include <limits>

namespace episcope::in_archive_test {

using namespace episcope::test;

class ArchiveTest : public QObject, private ArchiveFolder {
  Q_OBJECT

 private slots:
  void init() { renew(); }

  void partsOfNoUse_areLeftOut_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<QString>("fault");
    QTest::newRow("a link to nothing") << "GT_DEPTH"
                                       << "is a link to nothing";
    QTest::newRow("a link to another file") << "GT_LABELS"
                                            << "is a link to another file";
    QTest::newRow("nothing stored") << "GT_DEPTH"
                                    << "is empty";
    QTest::newRow("of length 0") << "SCRIBBLES"
                                 << "is empty";
    QTest::newRow("text") << "GT_LABELS"
                          << "holds no numbers";
  }
  void partsOfNoUse_areLeftOut() {
    QFETCH(QString, name);
    QFETCH(QString, fault);
    const Scene scene = plane_scene();
    io::write_archive(path("lf.h5"), scene, Progress(1));
    const std::string dataset = name.toStdString();
    const QByteArray row = QTest::currentDataTag();
    const hid_t file = H5Fopen(path("lf.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    H5Ldelete(file, dataset.c_str(), H5P_DEFAULT);
    if (row == "a link to nothing") {
      H5Lcreate_soft("/nowhere", file, dataset.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    } else if (row == "a link to another file") {
      H5Lcreate_external("o.h5", "/a", file, dataset.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    } else {
      const hsize_t none = 0;
      const hid_t space = row == "of length 0" ? H5Screate_simple(1, &none, nullptr)
                                               : H5Screate(row == "text" ? H5S_SCALAR : H5S_NULL);
      const hid_t type = row == "text" ? H5T_C_S1 : H5T_NATIVE_FLOAT;
      H5Dclose(
          H5Dcreate2(file, dataset.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
      H5Sclose(space);
    }
    H5Fclose(file);

    const Scene read = open(path());

    QVERIFY(has_same_samples(scene, read));
    QVERIFY2(
        describe(read.convention).find(dataset + " " + fault.toStdString()) != std::string::npos,
        describe(read.convention).c_str());
  }

  void archive_readsWhatItWrote() {
    const Scene scene = plane_scene();

    io::write_archive(path("lf.h5"), scene, Progress(1));
    const Scene read = open(path());

    QVERIFY(has_same_samples(scene, read));
    QVERIFY(largest_difference(scene.truth->field, read.truth->field) < kDepthRounding);
    QCOMPARE(read.convention.order, std::string("as stored"));
    QVERIFY(QString::fromStdString(read.convention.order_check)
                .contains("checked against the ground truth"));
    QCOMPARE(read.light_field->info().camera.shift, 5.0);
    QCOMPARE(*read.light_field->info().disparity_range, (Interval{-3, 3}));
    QCOMPARE(std::memcmp(read.truth->labels.data(), scene.truth->labels.data(),
                         scene.truth->labels.size() * 4),
             0);
    QCOMPARE(read.scribbles.views.at(0).view, scene.scribbles.views.at(0).view);
    QVERIFY(std::equal(read.scribbles.views.at(0).labels.begin(),
                       read.scribbles.views.at(0).labels.end(),
                       scene.scribbles.views.at(0).labels.begin()));
    QVERIFY2(read.convention.warnings.empty(), describe(read.convention).c_str());
  }

  /// It is no second truth, nor a part that is left out.
  void disparityBesideDepth_isWrittenOnRequest() {
    const Scene scene = plane_scene();

    io::write_archive(path("lf.h5"), scene, Progress(1), {.has_disparity = true});
    const io::Hdf5Input file(path("lf.h5"));
    const Scene read = open(path());

    const DisparityField& truth = scene.truth->field;
    std::vector<float> stored(truth.disparity.size());
    const io::Hdf5Shape shape = file.dataset("GT_DISPARITY").shape;
    file.read("GT_DISPARITY", {io::Hdf5Shape(shape.size(), 0), shape}, stored.data());
    QVERIFY(std::equal(stored.begin(), stored.end(), truth.disparity.data()));
    QCOMPARE(*file.text("GT_DISPARITY", "units"), std::string("px per view step"));
    QVERIFY(largest_difference(truth, read.truth->field) < kDepthRounding);
    QVERIFY2(read.convention.warnings.empty(), describe(read.convention).c_str());
    for (const FileUse& use : read.convention.files) QVERIFY2(use.is_used, use.example.c_str());
    io::write_archive(path("lf.h5"), scene, Progress(1));
    QVERIFY(!io::Hdf5Input(path("lf.h5")).has("GT_DISPARITY"));
  }

  /// A result in the place of truth stays one.
  void estimatedDepth_saysHowItWasMade_data() {
    QTest::addColumn<QString>("name");
    for (const char* name : {"lf.h5", "lf.npz", "lf.mat"}) QTest::newRow(name) << name;
  }
  void estimatedDepth_saysHowItWasMade() {
    QFETCH(QString, name);
    const std::filesystem::path file = path(name.toUtf8().constData());
    const Scene made = plane_scene();
    Scene scene;
    scene.light_field = made.light_field;
    auto truth = std::make_shared<GroundTruth>();
    truth->field.disparity = made.truth->field.disparity.clone();
    truth->estimated.emplace();
    truth->estimated->method = "epi_l";
    truth->estimated->parameters = {{"outer_scale", 1.5}};
    truth->estimated->source = "cotton/lf.h5";
    scene.truth = truth;

    io::writer_of(file)->write(file, scene, Progress(1));
    const Scene read = open(file);

    QVERIFY(read.truth->estimated.has_value());
    QCOMPARE(read.truth->estimated->method, std::string("epi_l"));
    QVERIFY(read.truth->estimated->parameters == truth->estimated->parameters);
    QCOMPARE(read.truth->estimated->source, std::string("cotton/lf.h5"));
    QCOMPARE(QString::fromStdString(read.convention.warnings.at(0)),
             QString("The depth of this file is no ground truth: it was estimated by epi_l from "
                     "cotton/lf.h5."));
  }

  void truthNotNeeded_isNotRead_data() {
    QTest::addColumn<bool>("is_reversed");
    QTest::newRow("in order") << false;
    QTest::newRow("h reversed") << true;
  }
  // Everything that needs it is unchanged: the order of views and the units.
  void truthNotNeeded_isNotRead() {
    QFETCH(bool, is_reversed);
    const Scene scene = plane_scene();
    RawArchive form;
    form.flip = {is_reversed, false};
    write_raw_archive(path("lf.h5"), scene, form);

    const Scene read = open(path("lf.h5"), {.needs_truth = false});

    const Scene whole = open(path("lf.h5"));
    QVERIFY(has_same_samples(whole, read));
    QCOMPARE(read.convention.order_check, whole.convention.order_check);
    QCOMPARE(read.convention.units, whole.convention.units);
    QCOMPARE(read.light_field->info().camera.baseline, whole.light_field->info().camera.baseline);
    QVERIFY(read.truth->field.empty());
    QVERIFY(read.truth->labels.empty());
    QVERIFY(whole.truth->has_disparity());
  }

  void archive_keepsInvalidPixels() {
    Scene scene = plane_scene();
    GroundTruth truth;
    truth.field.disparity = scene.truth->field.disparity.clone();
    const ViewStack<float>& like = truth.field.disparity;
    truth.field.valid = ViewStack<std::uint8_t>(like.grid(), like.height(), like.width());
    std::fill_n(truth.field.valid.data(), truth.field.valid.size(), std::uint8_t{1});
    truth.field.valid.view({2, 2}).at(10, 11) = 0;
    scene.truth = std::make_shared<GroundTruth>(std::move(truth));

    io::write_archive(path("lf.h5"), scene, Progress(1));
    const Scene read = open(path("lf.h5"));

    QVERIFY(largest_difference(scene.truth->field, read.truth->field) < kDepthRounding);
    QVERIFY(!read.truth->field.view({2, 2}).is_valid(10, 11));
  }

  void disparityOfAnUnknownCamera_survivesTheArchive() {
    const Scene known = plane_scene();
    Scene scene = plane_scene();
    LightFieldInfo info = known.light_field->info();
    info.camera = {};
    scene.light_field = std::make_shared<LightField>(bytes_of(known).clone(), info);

    io::write_archive(path("lf.h5"), scene, Progress(1));

    QVERIFY(largest_difference(scene.truth->field, open(path("lf.h5")).truth->field) <
            kDepthRounding);
  }

  void twoLightFieldsInAFolder_keepTheirLabelsApart() {
    const Scene small = plane_scene();
    PlaneOptions options;
    options.width = 48;
    const Scene other = plane_scene(options);

    io::write_archive(path("a.h5"), small, Progress(1));
    io::write_archive(path("b.h5"), other, Progress(1));

    QCOMPARE(open(path("a.h5")).truth->labels.width(), 80);
    QCOMPARE(open(path("b.h5")).truth->labels.width(), 48);
  }

  void depthOfTheCenterOnly_isOneView_data() {
    QTest::addColumn<bool>("is_padded");
    QTest::newRow("[y][x]") << false;
    QTest::newRow("[v][h][y][x], other views zero") << true;
  }
  void depthOfTheCenterOnly_isOneView() {
    QFETCH(bool, is_padded);
    const Scene scene = plane_scene();
    RawArchive form;
    form.is_center_only = !is_padded;
    if (is_padded) {
      form.depth = [](ViewIndex view, int, int, float z) {
        return view == ViewIndex{2, 2} ? z : 0.0F;
      };
    }
    write_raw_archive(path("lf.h5"), scene, form);

    const Scene read = open(path("lf.h5"));

    QCOMPARE(read.truth->field.disparity.grid(), (GridShape{1, 1}));
    QCOMPARE(read.truth->field.disparity.first(), (ViewIndex{2, 2}));
    QVERIFY(std::abs(read.truth->field.disparity.view({2, 2}).at(9, 9) -
                     scene.truth->field.disparity.view({2, 2}).at(9, 9)) < kDepthRounding);
  }

  void depthWithoutSurface_isInvalid() {
    const Scene scene = plane_scene();
    RawArchive form;
    form.depth = [](ViewIndex, int y, int x, float z) {
      if (y == 1 && x == 1) return std::numeric_limits<float>::quiet_NaN();
      if (y == 1 && x == 2) return 0.0F;
      if (y == 1 && x == 3) return -4.0F;
      if (y == 1 && x == 4) return std::numeric_limits<float>::infinity();
      return z;
    };
    write_raw_archive(path("lf.h5"), scene, form);

    const Scene read = open(path("lf.h5"));

    const DisparityView map = read.truth->field.view({0, 0});
    for (int x = 1; x <= 4; ++x) QVERIFY(!map.is_valid(1, x));
    QVERIFY(map.is_valid(1, 0) && map.is_valid(1, 5));
    QVERIFY(std::isfinite(map.disparity.at(1, 1)));
    QVERIFY(QString::fromStdString(describe(read.convention)).contains("GT_DEPTH holds no depth"));
  }

  void mask_excludesPixels_data() {
    QTest::addColumn<int>("inside");
    QTest::addColumn<bool>("is_one_view");
    QTest::newRow("0/1, all views") << 1 << false;
    QTest::newRow("0/255, all views") << 255 << false;
    QTest::newRow("0/255, center") << 255 << true;
  }
  void mask_excludesPixels() {
    QFETCH(int, inside);
    QFETCH(bool, is_one_view);
    const Scene scene = plane_scene();
    const std::size_t views = is_one_view ? 1 : 25;
    std::vector<std::uint8_t> mask(views * 64 * 80, static_cast<std::uint8_t>(inside));
    for (std::size_t view = 0; view < views; ++view) mask[view * 64 * 80 + 7] = 0;
    RawArchive form;
    form.is_center_only = is_one_view;
    form.more = [&](io::Hdf5Output& file) {
      add_bytes(file, "GT_DEPTH_MASK",
                is_one_view ? io::Hdf5Shape{64, 80} : io::Hdf5Shape{5, 5, 64, 80}, mask);
    };
    write_raw_archive(path("lf.h5"), scene, form);

    const Scene read = open(path("lf.h5"));
    const DisparityView map = read.truth->field.view({2, 2});

    QVERIFY(!map.is_valid(0, 7));
    QVERIFY(map.is_valid(0, 8));
  }

  void transparency_hasTwoTruths() {
    const Scene scene = plane_scene();
    std::vector<float> near(64 * 80, 9.0F);
    std::vector<float> far(64 * 80, 14.0F);
    std::vector<std::uint8_t> mask(64 * 80, 255);
    mask[5] = 0;
    RawArchive form;
    form.has_depth = false;
    form.more = [&](io::Hdf5Output& file) {
      const io::Hdf5Shape shape{64, 80};
      file.add_dataset<float>("GT_DEPTH_FOREGROUND", shape, "", "");
      file.write("GT_DEPTH_FOREGROUND", {{0, 0}, shape}, near.data());
      file.add_dataset<float>("GT_DEPTH_BACKGROUND", shape, "", "");
      file.write("GT_DEPTH_BACKGROUND", {{0, 0}, shape}, far.data());
      add_bytes(file, "GT_DEPTH_FOREGROUND_MASK", shape, mask);
    };
    write_raw_archive(path("lf.h5"), scene, form);

    const Scene read = open(path("lf.h5"));

    QVERIFY(read.truth->has_layers());
    QVERIFY(!read.truth->has_disparity());
    const CameraGrid& camera = scene.light_field->info().camera;
    const DisparityView foreground = read.truth->foreground.view({2, 2});
    QCOMPARE(foreground.disparity.at(20, 20), static_cast<float>(camera.disparity_from_depth(9)));
    QVERIFY(!foreground.is_valid(0, 5));
    QVERIFY(read.truth->background.view({2, 2}).is_valid(0, 5));
  }

  void companions_areFoundAndReadInTheHouseOrder() {
    const Scene scene = plane_scene();
    RawArchive form;
    form.flip = {true, false};
    write_raw_archive(path("lf.h5"), scene, form);
    const auto write = [&](const char* file, const char* dataset, const io::Hdf5Shape& shape) {
      std::size_t count = 1;
      for (const std::size_t length : shape) count *= length;
      std::vector<float> values(count);
      for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<float>(i);
      io::AtomicFile target(path(file));
      io::Hdf5Output out(target);
      out.add_dataset<float>(dataset, shape, "", "");
      out.write(dataset, {io::Hdf5Shape(shape.size(), 0), shape}, values.data());
      out.close();
      target.commit();
    };
    write("edge_weights.h5", "EDGE_WEIGHTS", {5, 5, 64, 80});
    write("feature_depth_probabilities.h5", "Probabilities", {3, 5, 5, 64, 80});
    write("feature_single_view_probabilities.h5", "Probabilities", {64, 80, 4});

    const Scene read = open(path("lf.h5"));
    const ViewStack<float> weights =
        io::read_edge_probabilities(path("edge_weights.h5"), read, Progress(1));
    const io::ProbabilityFile all(path("feature_depth_probabilities.h5"), read);
    const io::ProbabilityFile single(path("feature_single_view_probabilities.h5"), read);

    QCOMPARE(read.companions.size(), std::size_t{3});
    QCOMPARE(read.companions[0].kind, CompanionKind::EdgeProbabilities);
    QCOMPARE(read.companions[0].shape, std::string("5×5×64×80"));
    QCOMPARE(weights.view({0, 4}).at(0, 3), 3.0F);  // stored at h = 0
    io::write_edge_probabilities(path("written.h5"), weights, read, Progress(1));
    const auto again = io::read_edge_probabilities(path("written.h5"), read, Progress(1));
    QVERIFY(std::equal(again.data(), again.data() + again.size(), weights.data()));
    QCOMPARE(io::Hdf5Input(path("written.h5")).dataset("EDGE_WEIGHTS").shape,
             (io::Hdf5Shape{5, 5, 64, 80}));
    QVERIFY_THROWS_EXCEPTION(
        IoError, io::write_edge_probabilities(path("few.h5"), ViewStack<float>({1, 1}, 64, 80),
                                              read, Progress(1)));
    QCOMPARE(all.label_count(), 3);
    QVERIFY(all.contains({0, 0}));
    QCOMPARE(all.view({0, 4}).at(1, 2, 1), 5.0F * 5 * 64 * 80 + 80 + 2);
    QCOMPARE(single.label_count(), 4);
    QVERIFY(!single.contains({0, 0}) && single.contains({2, 2}));
    QCOMPARE(single.view({2, 2}).at(1, 2, 3), (80.0F + 2) * 4 + 3);
  }

  void centerView_comesFirst() {
    io::write_archive(path("lf.h5"), plane_scene(), Progress(1));
    double fraction = -1;
    double fraction_at_center = -1;
    int calls = 0;
    io::OpenOptions options;
    options.on_center_view = [&](const Image<std::uint8_t>& rgb, const LightFieldInfo&,
                                 GridShape grid) {
      ++calls;
      fraction_at_center = fraction;
      QCOMPARE(grid, (GridShape{5, 5}));
      QCOMPARE(rgb.width(), 80);
      QCOMPARE(rgb.at(3, 4, 1), bytes_of(plane_scene()).view({2, 2}).at(3, 4, 1));
    };
    const Progress progress(
        {}, [&](const ProgressState& state) { fraction = state.fraction; }, 1);

    (void)io::open_scene(path("lf.h5"), options, progress);

    QCOMPARE(calls, 1);
    QVERIFY(fraction_at_center <= 0);
    QVERIFY(fraction > 0.5);
  }

  void epis_areShownBeforeDepthIsRead() {
    io::write_archive(path("lf.h5"), plane_scene(), Progress(1));
    std::string step;
    QStringList steps;
    io::OpenOptions options;
    options.on_center_epis = [&](const io::CenterEpis&) { steps << QString::fromStdString(step); };
    const Progress progress(
        {}, [&](const ProgressState& state) { step = state.step; }, 1);

    (void)io::open_scene(path("lf.h5"), options, progress);

    QVERIFY(!steps.isEmpty());
    QCOMPARE(steps.front(), QString("reading views"));
  }

  void reading_stopsOnRequest() {
    io::write_archive(path("lf.h5"), plane_scene(), Progress(1));
    std::stop_source stop;
    io::OpenOptions options;
    options.on_center_view = [&](const Image<std::uint8_t>&, const LightFieldInfo&, GridShape) {
      stop.request_stop();
    };

    QVERIFY_THROWS_EXCEPTION(
        Cancelled, (void)io::open_scene(path("lf.h5"), options, Progress(stop.get_token(), {}, 1)));
  }

  void writing_stopsOnRequestAndLeavesNothing() {
    std::stop_source stop;
    const Progress progress(
        stop.get_token(),
        [&](const ProgressState& state) {
          if (state.fraction > 0.2) stop.request_stop();
        },
        1);

    QVERIFY_THROWS_EXCEPTION(Cancelled, io::write_archive(path("lf.h5"), plane_scene(), progress));
    QVERIFY(std::filesystem::is_empty(path()));
  }

  void writing_stopsWithinDepth() {
    std::stop_source stop;
    int later = 0;
    const Progress progress(stop.get_token(), [&](const ProgressState& state) {
      later += stop.stop_requested() ? 1 : 0;
      if (state.fraction > 0.61) stop.request_stop();
    });

    QVERIFY_THROWS_EXCEPTION(Cancelled, io::write_archive(path("lf.h5"), plane_scene(), progress));
    QCOMPARE(later, 0);
    QVERIFY(std::filesystem::is_empty(path("")));
  }

  void evenGrids_andGreyViews_areRead() {
    PlaneOptions options;
    options.grid = {4, 6};
    options.channels = 1;
    const Scene scene = plane_scene(options);
    RawArchive form;
    form.flip = {true, false};
    write_raw_archive(path("lf.h5"), scene, form);

    const Scene read = open(path("lf.h5"));

    QVERIFY2(has_same_samples(scene, read), describe(read.convention).c_str());
    QCOMPARE(read.light_field->channels(), 1);
  }

  void sixteenBitSamples_stay() {
    ViewStack<std::uint16_t> views({3, 3}, 8, 9, 1);
    for (std::size_t i = 0; i < views.size(); ++i) {
      views.data()[i] = static_cast<std::uint16_t>(i * 311);
    }
    Scene scene;
    scene.truth = std::make_shared<GroundTruth>();
    scene.light_field = std::make_shared<LightField>(std::move(views), LightFieldInfo{});

    io::write_archive(path("lf.h5"), scene, Progress(1));
    const Scene read = open(path("lf.h5"));

    QCOMPARE(read.light_field->sample_type(), SampleType::UInt16);
    QVERIFY(has_same_samples(scene, read));
  }
};

}  // namespace episcope::in_archive_test

EPISCOPE_TEST(archive_test, ArchiveTest)
#include "archive_test.moc"
