// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/hdf5_output.h"
#include "engine/io/base/image_file.h"
#include "engine/io/base/npy.h"
#include "engine/io/models/sidecar_maps/map_name.h"
#include "engine/io/open.h"
#include "tests/engine/io/models/sidecar_maps/layered_folder.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace episcope::in_true_names_test {

using namespace episcope::test;

namespace fs = std::filesystem;

namespace {

constexpr ViewIndex kCenter{1, 1};

io::Hdf5Shape shape_of(ImageView<const float> map) {
  return {static_cast<std::size_t>(map.height), static_cast<std::size_t>(map.width)};
}

template <class T>
void add(io::Hdf5Output& file, const std::string& name, const io::Hdf5Shape& shape, const T* data) {
  file.add_dataset<T>(name, shape, "", "");
  file.write(name, {io::Hdf5Shape(shape.size(), 0), shape}, data);
}

}  // namespace

/// Which of several maps beside views, or in their file, is taken for true.
class TrueNamesTest : public QObject {
  Q_OBJECT

 private:
  LayeredFolder folder_;
  Image<float> guess_;  ///< Another map of the center view.

  ImageView<const float> truth() const { return folder_.scene.disparity.view(kCenter); }
  const LayeredScene& scene() const { return folder_.scene; }

  void write_arrays(const std::string& name,
                    const std::function<void(io::Hdf5Output&)>& add_others) const {
    const ViewStack<std::uint8_t>& views = scene().views;
    io::AtomicFile target(folder_.place(name));
    io::Hdf5Output file(target);
    add(file, "LF",
        {3, 3, static_cast<std::size_t>(views.height()), static_cast<std::size_t>(views.width()),
         static_cast<std::size_t>(views.channels())},
        views.data());
    add_others(file);
    file.close();
    target.commit();
  }
  /// All views in one picture: side by side, or as lenslets.
  void write_mosaic(const fs::path& file, bool are_lenslets) const {
    const ViewStack<std::uint8_t>& views = scene().views;
    const int height = views.height(), width = views.width();
    Image<std::uint8_t> mosaic(3 * height, 3 * width, views.channels());
    for (int y = 0; y < mosaic.height(); ++y) {
      for (int x = 0; x < mosaic.width(); ++x) {
        const ViewIndex view =
            are_lenslets ? ViewIndex{y % 3, x % 3} : ViewIndex{y / height, x / width};
        const auto from = views.view(view);
        for (int c = 0; c < views.channels(); ++c) {
          mosaic.at(y, x, c) =
              are_lenslets ? from.at(y / 3, x / 3, c) : from.at(y % height, x % width, c);
        }
      }
    }
    io::write_png(file, mosaic.view());
  }
  /// A light field in the form that its suffix names, or as views: "cam/{}_{}.png".
  void write_as(const std::string& name) const {
    const ViewStack<std::uint8_t>& views = scene().views;
    if (name.find('{') != std::string::npos) return folder_.write_views(LayeredFolder::named(name));
    if (name.ends_with(".h5")) return write_arrays(name, [](io::Hdf5Output&) {});
    if (name.ends_with(".png")) {
      return write_mosaic(folder_.place(name), name.find("eslf") != std::string::npos);
    }
    io::write_npy<std::uint8_t>(
        folder_.place(name),
        {3, 3, static_cast<std::size_t>(views.height()), static_cast<std::size_t>(views.width()),
         static_cast<std::size_t>(views.channels())},
        {views.data(), views.size()});
  }
  /// Writes and opens it.
  Scene open_as(const std::string& name) const {
    write_as(name);
    const bool is_of_views = name.find('{') != std::string::npos;
    io::OpenOptions options;
    if (name.ends_with(".png") && !is_of_views) options.grid = "3x3";
    return folder_.open(is_of_views ? fs::path(name).parent_path().string() : name, options);
  }
  bool is_true(const Scene& scene) const {
    if (!scene.truth->field.contains(kCenter)) return false;
    const DisparityView map = scene.truth->field.view(kCenter);
    return std::equal(truth().data, truth().data + truth().size(), map.disparity.data);
  }
  static std::vector<std::string> warnings_of(const Scene& scene) {
    return scene.convention.warnings;
  }
  Image<std::uint8_t> left_half() const {
    Image<std::uint8_t> mask(truth().height, truth().width);
    for (int y = 0; y < mask.height(); ++y) std::fill_n(&mask.at(y, 0), mask.width() / 2, 255);
    return mask;
  }

 private slots:
  void init() {
    folder_ = LayeredFolder();
    guess_ = Image<float>(truth().height, truth().width);
    std::transform(truth().data, truth().data + truth().size(), guess_.begin(),
                   [](float d) { return d + 0.25F; });
  }

  void namesOfTruth_win_data() {
    QTest::addColumn<QString>("other");
    QTest::addColumn<QString>("name");
    const auto row = [](const char* other, const char* name) {
      QTest::newRow(name) << other << name;
    };
    row("disp_est", "disp_gt");
    row("disparity_epinet", "disparity_gt");
    row("disparity", "gt_disparity");
    row("disp", "gt");
    row("disparity_map", "ground_truth");
    row("disparity_raw", "disparity_true");
    row("a_disp", "z_gt_disp");
    row("disparity_filtered", "gt_disp");
    row("disparity_error", "true_disparity");
    row("disparity_std", "disparity");
  }
  void namesOfTruth_win() {
    QFETCH(QString, other);
    QFETCH(QString, name);
    folder_.write_views(LayeredFolder::named("views/{}_{}.png"));
    folder_.write_npy("views/" + other.toStdString() + ".npy", std::as_const(guess_).view());
    folder_.write_npy("views/" + name.toStdString() + ".npy", truth());
    write_arrays("lf.h5", [&](io::Hdf5Output& file) {
      add(file, other.toStdString(), shape_of(truth()), guess_.data());
      add(file, name.toStdString(), shape_of(truth()), truth().data);
    });

    for (const char* input : {"views", "lf.h5"}) {
      const Scene read = folder_.open(input);
      QVERIFY2(is_true(read), describe(read.convention).c_str());
      QVERIFY2(!warns_of(read, "is taken for true"), input);
    }
  }

  void namesAlike_areNoted() {
    folder_.write_views(LayeredFolder::named("views/{}_{}.png"));
    folder_.write_npy("views/disparity_a.npy", truth());
    folder_.write_npy("views/disparity_b.npy", std::as_const(guess_).view());
    write_arrays("lf.h5", [&](io::Hdf5Output& file) {
      add(file, "disparity_a", shape_of(truth()), truth().data);
      add(file, "disparity_b", shape_of(truth()), guess_.data());
    });

    for (const char* input : {"views", "lf.h5"}) {
      const Scene read = folder_.open(input);
      QVERIFY(is_true(read));
      QVERIFY2(warns_of(read, "is taken for true and disparity_b"),
               describe(read.convention).c_str());
    }
  }

  void estimateAlone_isNoTruthAndSaysSo() {
    folder_.write_views(LayeredFolder::named("views/{}_{}.png"));
    folder_.write_npy("views/disparity_confidence.npy", std::as_const(guess_).view());
    write_arrays("lf.h5", [&](io::Hdf5Output& file) {
      add(file, "disparity_confidence", shape_of(truth()), guess_.data());
    });

    for (const char* input : {"views", "lf.h5"}) {
      const Scene read = folder_.open(input);
      QVERIFY(!read.truth->has_disparity());
      QVERIFY2(warns_of(read, "its name is that of an estimate"),
               describe(read.convention).c_str());
    }
  }

  void trueLabels_win_data() {
    QTest::addColumn<QString>("other");
    QTest::addColumn<QString>("name");
    QTest::newRow("crf") << "labels_crf"
                         << "labels_true";
    QTest::newRow("segmentation") << "label"
                                  << "segmentation_gt";
    QTest::newRow("gt") << "labels"
                        << "gt_labels";
  }
  void trueLabels_win() {
    QFETCH(QString, other);
    QFETCH(QString, name);
    const auto labels = scene().labels.view(kCenter);
    const std::vector<std::int32_t> ones(labels.size(), 1);
    folder_.write_views(LayeredFolder::named("views/{}_{}.png"));
    folder_.write_npy("views/" + other.toStdString() + ".npy",
                      ImageView<const std::int32_t>{ones.data(), labels.height, labels.width, 1});
    folder_.write_npy("views/" + name.toStdString() + ".npy", labels);
    write_arrays("lf.h5", [&](io::Hdf5Output& file) {
      add(file, other.toStdString(), shape_of(truth()), ones.data());
      add(file, name.toStdString(), shape_of(truth()), labels.data);
    });

    for (const char* input : {"views", "lf.h5"}) {
      const Scene read = folder_.open(input);
      QVERIFY2(!read.truth->labels.empty(), describe(read.convention).c_str());
      const auto found = read.truth->labels.view(kCenter);
      QVERIFY2(std::equal(labels.data, labels.data + labels.size(), found.data), input);
    }
  }

  void masks_areOfValidPixelsByNameOnly_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<bool>("masks");
    for (const char* name : {"mask", "valid_mask", "disparity_mask", "gt_mask", "mask_center"}) {
      QTest::newRow(name) << name << true;
    }
    for (const char* name : {"object_mask", "sky_mask", "mask_occlusion", "foreground_mask"}) {
      QTest::newRow(name) << name << false;
    }
  }
  void masks_areOfValidPixelsByNameOnly() {
    QFETCH(QString, name);
    QFETCH(bool, masks);
    const Image<std::uint8_t> mask = left_half();
    folder_.write_views(LayeredFolder::named("views/{}_{}.png"));
    folder_.write_npy("views/gt_disparity.npy", truth());
    io::write_png(folder_.place("views/" + name.toStdString() + ".png"), mask.view());
    write_arrays("lf.h5", [&](io::Hdf5Output& file) {
      add(file, "disparity", shape_of(truth()), truth().data);
      add(file, name.toStdString(), shape_of(truth()), mask.data());
    });

    for (const char* input : {"views", "lf.h5"}) {
      const Scene read = folder_.open(input);
      QCOMPARE(read.truth->field.view(kCenter).is_valid(3, truth().width - 1), !masks);
      QVERIFY(read.truth->field.view(kCenter).is_valid(3, 3));
      QVERIFY2(warns_of(read, "leaves out 50.0 % of the ground truth") == masks,
               describe(read.convention).c_str());
      QCOMPARE(read.truth->regions.empty(), masks);
    }
  }

  void formsOfArrays_areRead_data() {
    QTest::addColumn<QString>("form");
    for (const char* form : {"nyx", "vuyx1", "yx1", "1yx"}) QTest::newRow(form) << form;
  }
  void formsOfArrays_areRead() {
    QFETCH(QString, form);
    io::Hdf5Shape shape;
    for (const QChar letter : form) {
      const auto pixels = shape_of(truth());
      shape.push_back(letter == 'n'   ? 9
                      : letter == '1' ? 1
                      : letter == 'y' ? pixels[0]
                      : letter == 'x' ? pixels[1]
                                      : 3);
    }
    const bool is_of_all = form.startsWith('n') || form.startsWith('v');
    write_arrays("lf.h5", [&](io::Hdf5Output& file) {
      add(file, "disparity", shape, is_of_all ? scene().disparity.data() : truth().data);
    });

    const Scene read = folder_.open("lf.h5");

    QVERIFY2(is_true(read), describe(read.convention).c_str());
    QCOMPARE(read.truth->field.disparity.grid().count(), is_of_all ? 9 : 1);
    QCOMPARE(warns_of(read, "row by row"), form.startsWith('n'));
  }

  void mapThatDoesNotFit_isWarnedOf() {
    write_arrays("lf.h5", [&](io::Hdf5Output& file) {
      auto shape = shape_of(truth());
      shape.insert(shape.begin(), 7);
      const std::vector<float> all(7 * truth().size(), 1);
      add(file, "gt_disparity", shape, all.data());
    });

    const Scene read = folder_.open("lf.h5");

    QVERIFY2(warns_of(read, "gt_disparity is named like a map and not used"),
             describe(read.convention).c_str());
  }

  void filesNamedAfterAFile_areItsTruth_data() {
    QTest::addColumn<QString>("map");
    QTest::addColumn<bool>("is_own");
    QTest::newRow("its name") << "cotton_disparity.npy" << true;
    QTest::newRow("in a folder of truth") << "gt/cotton.npy" << true;
    QTest::newRow("another") << "dino_disparity.npy" << false;
    QTest::newRow("no name") << "gt_disparity.npy" << false;
  }
  void filesNamedAfterAFile_areItsTruth() {
    QFETCH(QString, map);
    QFETCH(bool, is_own);
    write_arrays("cotton.h5", [](io::Hdf5Output&) {});
    folder_.write_npy(map.toStdString(), truth());

    const Scene read = folder_.open("cotton.h5");

    QVERIFY2(is_true(read) == is_own, describe(read.convention).c_str());
  }

  void foldersOfTruth_holdAMapOfEachScene() {
    folder_.write_views(LayeredFolder::named("cotton/{}_{}.png"));
    folder_.write_views(LayeredFolder::named("dino/{}_{}.png"));
    folder_.write_npy("truth/cotton.npy", truth());

    QVERIFY(is_true(folder_.open("cotton")));
    QVERIFY(!folder_.open("dino").truth->has_disparity());
  }

  void folderOfTruth_holdsTheMapOfTheOnlyScene() {
    folder_.write_views(LayeredFolder::named("cotton/{}_{}.png"));
    folder_.write_npy("gt/cotton.npy", truth());

    QVERIFY(is_true(folder_.open("cotton")));
  }

  void mapsOfNoView_areTold() {
    folder_.write_views(LayeredFolder::named("{}_{}.png"));
    folder_.write_npy(LayeredFolder::named("{}_{}_disparity.npy"), scene().disparity);
    folder_.write_npy("7_1_disparity.npy", truth());

    QVERIFY(warns_of(folder_.open(), "1 of 10 files #_#_disparity.npy belong to no view"));
  }

  void labelsOfAnotherScene_areNotTaken() {
    const auto labels = scene().labels.view(kCenter);
    folder_.write_views(LayeredFolder::named("s/dino/{}_{}.png"));
    write_arrays("s/cotton/lf.h5", [](io::Hdf5Output&) {});
    folder_.write_npy("s/cotton_labels/labels.npy", labels);
    folder_.write_npy("s/cotton_labels.npy", labels);
    QVERIFY(folder_.open("s/dino").truth->labels.empty());

    folder_.write_npy("s/labels.npy", labels);
    QVERIFY(!folder_.open("s/dino").truth->labels.empty());
  }

  void unknownWords_areNoOtherScene_data() {
    QTest::addColumn<QString>("light_field");
    QTest::addColumn<QString>("map");
    const auto row = [](const char* light_field, const char* map) {
      QTest::newRow(map) << light_field << map;
    };
    row("cotton/cam/{}_{}.png", "cotton/disparity_px.npy");
    row("cotton/cam/{}_{}.png", "cotton/disparity_pfm/2_2.npy");
    row("lf.npy", "disparity_final.npy");
    row("lf.png", "gt_disparity_mm.npy");
  }
  void unknownWords_areNoOtherScene() {
    QFETCH(QString, light_field);
    QFETCH(QString, map);
    folder_.write_npy(map.toStdString(), truth());

    const Scene read = open_as(light_field.toStdString());

    QVERIFY2(is_true(read), describe(read.convention).c_str());
  }

  void otherForms_areOfTheSameScene_data() {
    QTest::addColumn<QString>("light_field");
    QTest::addColumn<QString>("other");
    QTest::addColumn<QString>("map");
    const auto row = [](const char* light_field, const char* other, const char* map) {
      QTest::addRow("%s beside %s", light_field, other) << light_field << other << map;
    };
    row("flower_eslf.png", "flower/{}_{}.png", "flower_disparity.npy");
    row("lf.npy", "lf.h5", "lf_disparity.npy");
    row("lf.npy", "lf/{}_{}.png", "lf_disparity.npy");
    row("cotton.h5", "cotton/{}_{}.png", "cotton_disparity.npy");
  }
  void otherForms_areOfTheSameScene() {
    QFETCH(QString, light_field);
    QFETCH(QString, other);
    QFETCH(QString, map);
    write_as(other.toStdString());
    folder_.write_npy(map.toStdString(), truth());

    const Scene read = open_as(light_field.toStdString());

    QVERIFY2(is_true(read), describe(read.convention).c_str());
  }

  void masksNamedAfterAScene_areOfValidPixels_data() {
    QTest::addColumn<QString>("light_field");
    QTest::addColumn<QString>("name");
    QTest::newRow("views") << "out_{:02}_{:02}.png"
                           << "out_02_02";
    QTest::newRow("mosaic") << "flower_eslf.png"
                            << "flower";
    QTest::newRow("NumPy") << "cotton.npy"
                           << "cotton";
    QTest::newRow("HDF5") << "cotton.h5"
                          << "cotton";
  }
  void masksNamedAfterAScene_areOfValidPixels() {
    QFETCH(QString, light_field);
    QFETCH(QString, name);
    folder_.write_npy(name.toStdString() + "_disparity.npy", truth());
    Image<std::int32_t> numbers(truth().height, truth().width);
    std::ranges::copy(left_half(), numbers.begin());
    if (light_field.endsWith(".npy")) {
      folder_.write_npy("cotton_mask.npy", ImageView<const std::int32_t>(numbers));
    } else {
      io::write_png(folder_.place(name.toStdString() + "_mask.png"), left_half().view());
    }

    const Scene read = open_as(light_field.toStdString());

    QVERIFY2(read.truth->has_disparity(), describe(read.convention).c_str());
    QVERIFY2(!read.truth->field.view(kCenter).is_valid(3, truth().width - 1),
             describe(read.convention).c_str());
    QVERIFY(read.truth->field.view(kCenter).is_valid(3, 3));
    QVERIFY(read.truth->regions.empty());
  }

  void regions_mayBeNamedByTheirFolder() {
    folder_.write_views(LayeredFolder::named("{}_{}.png"));
    io::write_png(folder_.place("object_masks/2_2.png"), left_half().view());
    io::write_png(folder_.place("mask_net.png"), left_half().view());

    const Scene read = folder_.open();

    QVERIFY2(read.truth->regions.contains("object"), describe(read.convention).c_str());
    QVERIFY(read.truth->regions.contains("net"));
    QCOMPARE(read.truth->regions.size(), std::size_t{2});
  }

  void wordsOfOwners_areNoClaims_data() {
    QTest::addColumn<QString>("light_field");
    QTest::addColumn<QString>("map");
    QTest::newRow("views") << "net_{:02}_{:02}.png"
                           << "net_02_02_disp.npy";
    QTest::newRow("mosaic") << "raw_lf_eslf.png"
                            << "raw_lf_disparity.npy";
    QTest::newRow("NumPy") << "raw_lf.npy"
                           << "raw_lf_disparity.npy";
    QTest::newRow("HDF5") << "raw_lf.h5"
                          << "raw_lf_disparity.npy";
  }
  void wordsOfOwners_areNoClaims() {
    QFETCH(QString, light_field);
    QFETCH(QString, map);
    folder_.write_npy(map.toStdString(), truth());

    const Scene read = open_as(light_field.toStdString());

    QVERIFY2(is_true(read), describe(read.convention).c_str());
  }

  void groups_nameNoSteps() {
    write_arrays("lf.h5", [&](io::Hdf5Output& file) {
      file.add_group("raw");
      add(file, "raw/disparity", shape_of(truth()), truth().data);
    });
    QVERIFY(is_true(folder_.open("lf.h5")));

    write_arrays("lf.h5", [&](io::Hdf5Output& file) {
      file.add_group("estimate");
      add(file, "estimate/disparity", shape_of(truth()), truth().data);
    });
    QVERIFY(!folder_.open("lf.h5").truth->has_disparity());
  }

  void foldersOfMethods_areWarnedOf() {
    folder_.write_views(LayeredFolder::named("{}_{}.png"));
    folder_.write_npy("disparity_filtered/2_2.npy", truth());
    io::write_png(folder_.place("disparity_filtered/mask.png"), left_half().view());
    QVERIFY(warns_of(folder_.open(), "disparity_filtered/2_2.npy is not taken for true"));

    folder_.write_npy("gt_disparity.npy", truth());
    const Scene read = folder_.open();
    QVERIFY2(is_true(read), describe(read.convention).c_str());
    QVERIFY(read.truth->field.view(kCenter).is_valid(3, truth().width - 1));
    QVERIFY(!warns_of(read, "is not taken for true"));
  }

  void labelsBesideTwoFiles_areOfNone() {
    for (const char* name : {"cotton.h5", "dino.h5"}) write_arrays(name, [](io::Hdf5Output&) {});
    {
      const std::vector<std::uint8_t> labels(truth().size(), 2);
      io::AtomicFile target(folder_.place("labels.h5"));
      io::Hdf5Output file(target);
      add(file, "GT_LABELS", shape_of(truth()), labels.data());
      file.close();
      target.commit();
    }

    QVERIFY(folder_.open("dino.h5").truth->labels.empty());
    fs::remove(folder_.path("cotton.h5"));
    QVERIFY(!folder_.open("dino.h5").truth->labels.empty());
  }

  void frames_haveMapsOfTheirOwn() {
    for (const char* frame : {"0", "1"}) {
      folder_.write_views(LayeredFolder::named("cam{}{}_frame00" + std::string(frame) + ".png"));
    }
    folder_.write_npy("disparity_frame000.npy", std::as_const(guess_).view());
    folder_.write_npy("disparity_frame001.npy", truth());
    io::OpenOptions options;
    options.frame = 1;

    const Scene read = folder_.open("", options);

    QVERIFY2(is_true(read), describe(read.convention).c_str());
    QCOMPARE(read.truth->field.disparity.grid().count(), 1);
  }
};

}  // namespace episcope::in_true_names_test

EPISCOPE_TEST(true_names_test, TrueNamesTest)

#include "true_names_test.moc"
