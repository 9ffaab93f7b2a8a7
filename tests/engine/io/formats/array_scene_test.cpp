// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/npy.h"
#include "engine/io/formats/write_arrays.h"
#include "engine/io/models/open_options.h"
#include "engine/io/open.h"
#include "tests/engine/io/archive_files.h"
#include "tests/engine/io/formats/array_files.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <algorithm>
#include <fstream>

namespace episcope::in_array_scene_test {

using namespace episcope::test;

namespace fs = std::filesystem;

namespace {

Scene reference() {
  PlaneOptions options;
  options.grid = {5, 7};
  options.height = 72;
  options.width = 96;
  options.d0 = 1.3;
  return plane_scene(options);
}

Scene open(const fs::path& path, const std::string& axes = {}, const std::string& dataset = {}) {
  io::OpenOptions options;
  options.axes = axes;
  options.dataset = dataset;
  return io::open_scene(path, options, Progress(1));
}

void write_hdf5(const fs::path& path, const ViewStack<std::uint8_t>& views, const std::string& name,
                const std::string& axes, const std::string& stated = {}) {
  io::AtomicFile target(path);
  io::Hdf5Output file(target);
  const auto lengths = lengths_of(views, axes);
  if (stated.empty()) {
    // `add_dataset` states axes always; a file of another program does not.
    file.add_dataset<std::uint8_t>(name, lengths, "", "");
  } else {
    file.add_dataset<std::uint8_t>(name, lengths, stated, "");
  }
  file.write(name, {io::Hdf5Shape(lengths.size(), 0), lengths}, in_axes(views, axes).data());
  file.close();
  target.commit();
}

bool says(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

/// A copy with a mask of valid pixels: the first view and the first column are not.
Scene masked(const Scene& scene) {
  const LightField& field = *scene.light_field;
  ViewStack<std::uint8_t> valid(field.grid(), field.height(), field.width());
  std::fill_n(valid.data(), valid.size(), std::uint8_t{1});
  std::fill_n(valid.view({0, 0}).data, valid.view_size(), std::uint8_t{0});
  for (int y = 0; y < valid.height(); ++y) valid.view({1, 1}).at(y, 0) = 0;
  Scene other;
  other.light_field = std::make_shared<LightField>(
      std::get<ViewStack<std::uint8_t>>(field.samples()).clone(), field.info(), std::move(valid));
  other.truth = scene.truth;
  return other;
}

bool same_mask(const LightField& a, const LightField& b) {
  return a.valid().size() == b.valid().size() &&
         std::equal(a.valid().data(), a.valid().data() + a.valid().size(), b.valid().data());
}

}  // namespace

class ArraySceneTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<QTemporaryDir> folder_;
  Scene scene_ = reference();
  fs::path path(const std::string& name) const {
    return fs::path(folder_->path().toStdString()) / name;
  }
  const ViewStack<std::uint8_t>& views() const { return bytes_of(scene_); }

 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void floatsOfAllViews_areDoubtedIfTheyCannotBeColors_data() {
    QTest::addColumn<float>("white");  // 0 = disparity
    QTest::newRow("disparity") << 0.0F;
    QTest::newRow("gray in 0 to 1") << 1.0F;
    QTest::newRow("gray in 0 to 255") << 254.7F;
  }
  void floatsOfAllViews_areDoubtedIfTheyCannotBeColors() {
    QFETCH(float, white);
    const ViewStack<float>& maps = scene_.truth->field.disparity;
    std::vector<float> values(maps.data(), maps.data() + maps.size());
    for (std::size_t i = 0; white > 0 && i < values.size(); ++i) {
      values[i] = static_cast<float>(views().data()[3 * i]) / 255 * white;
    }
    io::write_npy<float>(path("all.npy"), lengths_of(views(), "vuyx"), values);

    const Scene scene = open(path("all.npy"));

    const bool is_doubted = std::ranges::any_of(
        scene.convention.warnings,
        [](const std::string& text) { return says(text, "disparity maps of all views"); });
    QCOMPARE(is_doubted, white == 0);
  }

  void npy_isReadInAnyOrderOfAxes_data() {
    QTest::addColumn<QString>("axes");
    for (const char* axes : {"vuyxc", "cvuyx", "vucyx", "yxvuc", "cxyuv"}) {
      QTest::newRow(axes) << axes;
    }
  }
  void npy_isReadInAnyOrderOfAxes() {
    QFETCH(QString, axes);
    const std::string letters = axes.toStdString();
    io::write_npy<std::uint8_t>(path("lf.npy"), lengths_of(views(), letters),
                                in_axes(views(), letters));

    const Scene scene = open(path("lf.npy"));

    QVERIFY2(says(scene.convention.format, ("(" + letters + ")").c_str()),
             scene.convention.format.c_str());
    QVERIFY(has_same_samples(scene, scene_));
  }

  void exchangedRowsAndColumnsOfViews_areToldByParallax() {
    io::write_npy<std::uint8_t>(path("lf.npy"), lengths_of(views(), "uvyxc"),
                                in_axes(views(), "uvyxc"));

    const Scene scene = open(path("lf.npy"));

    QVERIFY2(says(scene.convention.format, "(uvyxc)"), scene.convention.format.c_str());
    QVERIFY(has_same_samples(scene, scene_));
  }

  void statedGrid_isTakenOrRefused() {
    ViewStack<std::uint8_t> flat = views().clone();  // no parallax tells
    std::fill_n(flat.data(), flat.size(), std::uint8_t{90});
    io::write_npy<std::uint8_t>(path("lf.npy"), lengths_of(flat, "vuyxc"), in_axes(flat, "vuyxc"));
    const auto grid_read_as = [this](const std::string& grid) {
      io::OpenOptions options;
      options.grid = grid;
      return io::open_scene(path("lf.npy"), options, Progress(1)).light_field->grid();
    };

    QVERIFY(grid_read_as("5x7") == (GridShape{5, 7}));
    QVERIFY(grid_read_as("7x5") == (GridShape{7, 5}));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)grid_read_as("5x5"));
  }

  void statedAxes_areTaken() {
    io::write_npy<std::uint8_t>(path("lf.npy"), lengths_of(views(), "ycvxu"),
                                in_axes(views(), "ycvxu"));

    QVERIFY_THROWS_EXCEPTION(IoError, (void)open(path("lf.npy")));
    QVERIFY(has_same_samples(open(path("lf.npy"), "ycvxu"), scene_));
    for (const char* axes : {"vuyx", "vuyxx", "vuyxq", "vuycx", "nvyxc"}) {
      QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)open(path("lf.npy"), axes));
    }
  }

  void ambiguousShape_isAQuestion() {
    // Three channels, or three rows of views.
    const std::vector<std::uint8_t> samples(3 * 3 * 3 * 8 * 8);
    io::write_npy<std::uint8_t>(path("lf.npy"), {3, 3, 3, 8, 8}, samples);

    try {
      (void)open(path("lf.npy"));
      QFAIL("the file was read");
    } catch (const io::Undecided& question) {
      QCOMPARE(question.option(), std::string("axes"));
      QCOMPARE(question.choices().size(), std::size_t{2});
    }
  }

  void fourthChannel_isAMask() {
    std::vector<std::uint8_t> samples;
    for (std::size_t i = 0; i < views().size(); i += 3) {
      samples.insert(samples.end(), views().data() + i, views().data() + i + 3);
      samples.push_back(i == 3 ? 0 : 255);
    }
    auto lengths = lengths_of(views(), "vuyxc");
    lengths.back() = 4;
    io::write_npy<std::uint8_t>(path("lf.npy"), lengths, samples);

    const Scene scene = open(path("lf.npy"));

    QVERIFY(has_same_samples(scene, scene_));
    QVERIFY(!scene.light_field->is_valid({0, 0}, 0, 1));
    QVERIFY(scene.light_field->is_valid({0, 0}, 0, 0));
  }

  void widerIntegers_becomeTheNarrowestType() {
    const std::vector<std::int32_t> bytes(views().data(), views().data() + views().size());
    std::vector<std::int32_t> words = bytes;
    words[7] = 300;
    io::write_npy<std::int32_t>(path("bytes.npy"), lengths_of(views(), "vuyxc"), bytes);
    io::write_npy<std::int32_t>(path("words.npy"), lengths_of(views(), "vuyxc"), words);

    QVERIFY(open(path("bytes.npy")).light_field->sample_type() == SampleType::UInt8);
    QVERIFY(open(path("words.npy")).light_field->sample_type() == SampleType::UInt16);
  }

  void unsignedIntegersAbove65535_areScaledAsSignedOnes_data() {
    QTest::addColumn<unsigned>("factor");
    QTest::newRow("a little") << 400U;
    QTest::newRow("the whole range") << 15'000'000U;
  }
  void unsignedIntegersAbove65535_areScaledAsSignedOnes() {
    QFETCH(unsigned, factor);
    std::vector<std::int32_t> words(views().size());
    std::transform(views().data(), views().data() + views().size(), words.begin(),
                   [&](std::uint8_t sample) { return static_cast<std::int32_t>(factor * sample); });
    io::write_npy<std::int32_t>(path("wide.npy"), lengths_of(views(), "vuyxc"), words);
    std::fstream file(path("wide.npy"), std::ios::in | std::ios::out | std::ios::binary);
    std::string header(64, ' ');
    file.read(header.data(), 64);
    file.seekp(static_cast<std::streamoff>(header.find("<i4")));
    file << "<u4";
    file.close();

    const Scene scene = open(path("wide.npy"));

    QVERIFY(scene.light_field->sample_type() == SampleType::Float32);
    QVERIFY(!scene.convention.warnings.empty());
    const auto& floats = std::get<ViewStack<float>>(scene.light_field->samples());
    const float ratio = floats.data()[1] / floats.data()[0];
    QVERIFY(std::abs(ratio - 1.0F * views().data()[1] / views().data()[0]) < 1e-4F);
  }

  void mapsBesideAnNpy_areTruth() {
    io::write_npy<std::uint8_t>(path("lf.npy"), lengths_of(views(), "vuyxc"),
                                in_axes(views(), "vuyxc"));
    const ViewStack<std::int32_t>& labels = scene_.truth->labels;
    io::write_npy<std::int32_t>(path("labels.npy"), {5, 7, 72, 96}, {labels.data(), labels.size()});

    const Scene scene = open(fs::path(folder_->path().toStdString()));

    QVERIFY(std::equal(labels.data(), labels.data() + labels.size(), scene.truth->labels.data()));
  }

  void mat5_isRead_data() {
    QTest::addColumn<bool>("compressed");
    QTest::addColumn<bool>("doubles");
    QTest::addColumn<QString>("structure");
    QTest::addColumn<bool>("other");
    QTest::newRow("bytes") << false << false << "" << false;
    QTest::newRow("compressed, beside others") << true << false << "" << true;
    QTest::newRow("double") << false << true << "" << false;
    QTest::newRow("double, compressed") << true << true << "" << false;
    QTest::newRow("in a struct") << false << false << "S" << true;
    QTest::newRow("in a compressed struct") << true << false << "S" << false;
  }
  void mat5_isRead() {
    QFETCH(bool, compressed);
    QFETCH(bool, doubles);
    QFETCH(QString, structure);
    QFETCH(bool, other);
    write_mat5(path("lf.mat"), views(), {compressed, doubles, structure.toStdString(), other});

    const Scene scene = open(path("lf.mat"));

    QVERIFY2(says(scene.convention.format, "(vuyxc)"), scene.convention.format.c_str());
    QVERIFY2(says(scene.convention.format, "parallax agrees"), scene.convention.format.c_str());
    QCOMPARE(scene.light_field->grid(), views().grid());
    if (!doubles) QVERIFY(has_same_samples(scene, scene_));
    const float expected = static_cast<float>(views().view({2, 3}).at(10, 20, 1)) / 255;
    QCOMPARE(scene.light_field->view_as_float({2, 3}).at(10, 20, 1), expected);
    const auto unused = std::ranges::count(scene.convention.files, false, &FileUse::is_used);
    QCOMPARE(unused, (other ? 2 : 0) + (structure.isEmpty() ? 0 : 1));
  }

  // What could not be unpacked was what lay in memory.
  void mat5DamagedInItsSamples_isRefused() {
    write_mat5(path("whole.mat"), views(), {true, false, "", false});
    std::string bytes = bytes_of_file(path("whole.mat"));
    bytes.replace(bytes.size() / 2, 100, std::string(100, '\xff'));
    std::ofstream(path("damaged.mat"), std::ios::binary) << bytes;

    QCOMPARE(open(path("whole.mat")).light_field->grid(), views().grid());
    QVERIFY_THROWS_EXCEPTION(IoError, (void)open(path("damaged.mat")));
  }

  void damagedMat5_isRefused() {
    write_mat5(path("whole.mat"), views(), {true, false, "", true});
    const std::string whole = bytes_of_file(path("whole.mat"));
    unsigned noise = 1;
    for (int i = 0; i < 60; ++i) {
      std::string bytes = whole;
      noise = noise * 1664525U + 1013904223U;
      if (i % 2 == 0) {
        bytes.resize((noise >> 8) % whole.size());
      } else {
        for (int k = 0; k < 8; ++k) {
          noise = noise * 1664525U + 1013904223U;
          bytes[128 + (noise >> 8) % 200] = static_cast<char>(noise >> 24);
        }
      }
      std::ofstream(path("cut.mat"), std::ios::binary) << bytes;
      try {
        (void)open(path("cut.mat"));
        QVERIFY(i % 2 != 0);
      } catch (const IoError&) {
        continue;
      }
    }
  }

  void otherHdf5_isReadByShapeAndByWhatItStates() {
    write_hdf5(path("a.h5"), views(), "data", "vuyxc");
    write_hdf5(path("b.h5"), views(), "LF", "cxyuv");
    write_hdf5(path("c.h5"), views(), "stack", "uvyxc", "u,v,y,x,c");

    for (const char* name : {"a.h5", "b.h5", "c.h5"}) {
      const Scene scene = open(path(name));
      QCOMPARE(scene.light_field->info().reading.reader, std::string("hdf5"));
      QVERIFY2(has_same_samples(scene, scene_), name);
    }
  }

  void planesOfChannels_areOneLightField() {
    io::AtomicFile target(path("planes.h5"));
    io::Hdf5Output file(target);
    file.add_group("LF");
    file.add_group("LF/LF");
    const std::vector<std::uint8_t> all = in_axes(views(), "cvuyx");
    const auto shape = lengths_of(views(), "vuyx");
    for (int c = 0; c < 3; ++c) {
      const std::string name = std::string("LF/LF/") + "rgb"[c];
      file.add_dataset<std::uint8_t>(name, shape, "", "");
      file.write(name, {io::Hdf5Shape(4, 0), shape},
                 all.data() + all.size() / 3 * static_cast<std::size_t>(c));
    }
    file.close();
    target.commit();

    QVERIFY(has_same_samples(open(path("planes.h5")), scene_));
  }

  void npz_isReadDeflated() {
    io::write_npy<std::uint8_t>(path("lf.npy"), lengths_of(views(), "vuyxc"),
                                in_axes(views(), "vuyxc"));
    const std::string bytes = bytes_of_file(path("lf.npy"));
    write_deflated_zip(path("lf.npz"), {{"a.npy", bytes}, {"lf.npy", bytes}});

    const Scene scene = open(path("lf.npz"));

    QVERIFY(has_same_samples(scene, scene_));
    QCOMPARE(scene.convention.files.back().example, std::string("a"));
  }

  void severalArrays_areAQuestion() {
    io::write_npy<std::uint8_t>(path("lf.npy"), lengths_of(views(), "vuyxc"),
                                in_axes(views(), "vuyxc"));
    const std::string bytes = bytes_of_file(path("lf.npy"));
    write_deflated_zip(path("two.npz"), {{"a.npy", bytes}, {"b.npy", bytes}});

    QVERIFY_THROWS_EXCEPTION(io::Undecided, (void)open(path("two.npz")));
    QVERIFY(has_same_samples(open(path("two.npz"), {}, "b"), scene_));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)open(path("two.npz"), {}, "c"));
  }

  void zipBomb_isRefused() {
    const std::string header = io::npy_header({9, 9, 2000, 2000, 3}, io::NumberType::UInt8);
    write_deflated_zip(path("bomb.npz"), {{"lf.npy", header + std::string(1 << 22, '\0')}});

    try {
      (void)open(path("bomb.npz"));
      QFAIL("the file was read");
    } catch (const IoError& error) {
      QVERIFY2(says(error.what(), "cannot hold it"), error.what());
    }
  }

  void damagedZip_isRefused() {
    io::write_npy<std::uint8_t>(path("lf.npy"), lengths_of(views(), "vuyxc"),
                                in_axes(views(), "vuyxc"));
    write_deflated_zip(path("lf.npz"), {{"lf.npy", bytes_of_file(path("lf.npy"))}});
    const std::string whole = bytes_of_file(path("lf.npz"));
    for (std::size_t bytes = 0; bytes < whole.size(); bytes += whole.size() / 17) {
      std::ofstream(path("cut.npz"), std::ios::binary) << whole.substr(0, bytes);
      QVERIFY_THROWS_EXCEPTION(IoError, (void)open(path("cut.npz")));
    }
  }

  void writtenArrays_areReadAgain_data() {
    QTest::addColumn<QString>("name");
    QTest::newRow("npz") << "lf.npz";
    QTest::newRow("mat") << "lf.mat";
  }
  void writtenArrays_areReadAgain() {
    QFETCH(QString, name);
    const Scene scene = masked(scene_);
    const bool is_mat = name.endsWith("mat");

    (is_mat ? io::write_mat : io::write_npz)(path(name.toStdString()), scene, Progress(1));
    const Scene read = open(path(name.toStdString()));

    QVERIFY(has_same_samples(read, scene));
    QVERIFY(same_mask(*read.light_field, *scene.light_field));
    QVERIFY2(largest_difference(read.truth->field, scene.truth->field) == 0,
             describe(read.convention).c_str());
    QCOMPARE(read.truth->labels.size(), scene.truth->labels.size());
    QVERIFY(std::equal(read.truth->labels.data(),
                       read.truth->labels.data() + read.truth->labels.size(),
                       scene.truth->labels.data()));
  }

  void writtenNpy_isReadAgain() {
    io::write_npy(path("lf.npy"), scene_, Progress(1));

    QVERIFY(has_same_samples(open(path("lf.npy")), scene_));
  }

  void writtenMat_isOneOfMatlab() {
    io::write_mat(path("lf.mat"), scene_, Progress(1));

    const io::Hdf5Input file(path("lf.mat"));

    QVERIFY(bytes_of_file(path("lf.mat")).starts_with("MATLAB 7.3 MAT-file"));
    QCOMPARE(bytes_of_file(path("lf.mat")).substr(512, 4), std::string("\x89HDF"));
    QCOMPARE(file.dataset("LF").shape, (io::Hdf5Shape{3, 96, 72, 7, 5}));
    QVERIFY(file.text("LF", "MATLAB_class") == "uint8");
  }

  void preview_isTheCentreView_data() {
    QTest::addColumn<QString>("axes");
    QTest::newRow("views first") << "vuyxc";
    QTest::newRow("views last") << "cxyuv";
  }
  void preview_isTheCentreView() {
    QFETCH(QString, axes);
    const std::string letters = axes.toStdString();
    io::write_npy<std::uint8_t>(path("lf.npy"), lengths_of(views(), letters),
                                in_axes(views(), letters));
    Image<std::uint8_t> picture;
    io::OpenOptions options;
    options.on_center_view = [&](const Image<std::uint8_t>& rgb, const auto&, GridShape) {
      picture = rgb;
    };

    (void)io::open_scene(path("lf.npy"), options, Progress(1));

    const ImageView<const std::uint8_t> center = views().view({2, 3});
    QCOMPARE(picture.size(), center.size());
    QVERIFY(std::equal(picture.begin(), picture.end(), center.data));
  }
};

}  // namespace episcope::in_array_scene_test

EPISCOPE_TEST(array_scene_test, ArraySceneTest)
#include "array_scene_test.moc"
