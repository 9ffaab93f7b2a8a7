// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/array_input.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/hdf5_output.h"
#include "engine/io/base/npy.h"
#include "engine/io/formats/write_arrays.h"
#include "engine/io/models/open_options.h"
#include "engine/io/open.h"
#include "tests/engine/io/formats/array_files.h"
#include "tests/engine/io/models/order/layered_scene.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <algorithm>

namespace episcope::in_axes_by_motion_test {

using namespace episcope::test;

class AxesByMotionTest : public QObject {
  Q_OBJECT

 private:
  /// Colors of one texture: the waves of plane_scene lie elsewhere in each channel, as if moved.
  static ViewStack<std::uint8_t> coloured_views(GridShape grid) {
    const ViewStack<std::uint8_t> grey = layered_views({.grid = grid});
    ViewStack<std::uint8_t> three(grey.grid(), grey.height(), grey.width(), 3);
    for (std::size_t n = 0; n < three.size(); ++n) {
      three.data()[n] = static_cast<std::uint8_t>(grey.data()[n / 3] * (2 + n % 3) / 4);
    }
    return three;
  }
  static bool has_samples(const Scene& scene, const ViewStack<std::uint8_t>& views) {
    const auto& read = std::get<ViewStack<std::uint8_t>>(scene.light_field->samples());
    return std::equal(views.data(), views.data() + views.size(), read.data(),
                      read.data() + read.size());
  }

 private slots:
  void channelsBesideThreeRows_areToldByMotion_data() {
    QTest::addColumn<QString>("axes");
    for (const char* axes : {"vucyx", "cvuyx", "uvcyx"}) QTest::newRow(axes) << axes;
  }
  void channelsBesideThreeRows_areToldByMotion() {
    QFETCH(QString, axes);
    const QTemporaryDir folder;
    const std::filesystem::path file = folder.filePath("lf.npy").toStdString();
    const std::string letters = axes.toStdString();
    const ViewStack<std::uint8_t> three = coloured_views({3, 3});
    io::write_npy<std::uint8_t>(file, lengths_of(three, letters), in_axes(three, letters));

    const Scene scene = io::open_scene(file, {}, Progress(1));

    QVERIFY2(scene.convention.format.find("(" + letters + ")") != std::string::npos,
             scene.convention.format.c_str());
    QVERIFY(has_samples(scene, three));
  }

  // 48×64×25 could be 48 views of 64×25 px; 48×48×81 as well, though that would be odd.
  void greyListThatComesLast_isToldBySlices_data() {
    QTest::addColumn<int>("side");
    QTest::addColumn<int>("height");
    QTest::addColumn<int>("width");
    QTest::newRow("fewer views than pixels") << 5 << 48 << 64;
    QTest::newRow("more views than pixels") << 9 << 48 << 48;
    QTest::newRow("more views than rows") << 7 << 48 << 64;
  }
  void greyListThatComesLast_isToldBySlices() {
    QFETCH(int, side);
    QFETCH(int, height);
    QFETCH(int, width);
    const QTemporaryDir folder;
    const std::filesystem::path file = folder.filePath("lf.npy").toStdString();
    const ViewStack<std::uint8_t> grey =
        layered_views({.grid = {side, side}, .height = height, .width = width});
    io::write_npy<std::uint8_t>(file,
                                {static_cast<std::size_t>(height), static_cast<std::size_t>(width),
                                 static_cast<std::size_t>(side) * static_cast<std::size_t>(side)},
                                in_axes(grey, "yxvu"));

    const Scene scene = io::open_scene(file, {}, Progress(1));

    QCOMPARE(scene.light_field->grid(), (GridShape{side, side}));
    QVERIFY(has_samples(scene, grey));
  }

  // Slices of such a cube resemble a line of views whichever way it is cut.
  void cubeOfViews_isAsked() {
    const QTemporaryDir folder;
    const std::filesystem::path file = folder.filePath("lf.npy").toStdString();
    const ViewStack<std::uint8_t> line =
        layered_views({.grid = {1, 48}, .height = 48, .width = 48});
    io::write_npy<std::uint8_t>(file, {48, 48, 48}, in_axes(line, "yxvu"));

    QVERIFY_THROWS_EXCEPTION(io::Undecided, (void)io::open_scene(file, {}, Progress(1)));
  }

  void greyViewsInHdf5_areFoundByShapeAndName_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<QString>("axes");
    QTest::addColumn<bool>("is_list");
    QTest::newRow("list") << "data"
                          << "vuyx" << true;
    QTest::newRow("list, LF") << "LF"
                              << "vuyx" << true;
    QTest::newRow("list that comes last") << "lf"
                                          << "yxvu" << true;
    QTest::newRow("grid that comes last") << "LF"
                                          << "yxvu" << false;
  }
  void greyViewsInHdf5_areFoundByShapeAndName() {
    QFETCH(QString, name);
    QFETCH(QString, axes);
    QFETCH(bool, is_list);
    const QTemporaryDir folder;
    const std::filesystem::path path = folder.filePath("views.h5").toStdString();
    const ViewStack<std::uint8_t> grey = layered_views({.height = 48, .width = 64});
    const std::string letters = axes.toStdString();
    io::Hdf5Shape lengths = lengths_of(grey, letters);
    if (is_list) {
      const std::size_t at = letters.find('v');
      lengths[at] *= lengths[at + 1];
      lengths.erase(lengths.begin() + static_cast<std::ptrdiff_t>(at) + 1);
    }
    io::AtomicFile target(path);
    io::Hdf5Output file(target);
    file.add_dataset<std::uint8_t>(name.toStdString(), lengths, "", "");
    file.write(name.toStdString(), {io::Hdf5Shape(lengths.size(), 0), lengths},
               in_axes(grey, letters).data());
    file.close();
    target.commit();

    const Scene scene = io::open_scene(path, {}, Progress(1));

    QVERIFY2(has_samples(scene, grey), scene.convention.format.c_str());
  }

  void channelsOfAList_areNoRowsOfViews_data() {
    QTest::addColumn<QString>("axes");
    QTest::addColumn<QString>("stated");
    QTest::newRow("channels first") << "vucyx"
                                    << "(ncyx)";
    QTest::newRow("views last") << "yxcvu"
                                << "(yxcn)";
  }
  void channelsOfAList_areNoRowsOfViews() {
    QFETCH(QString, axes);
    QFETCH(QString, stated);
    const QTemporaryDir folder;
    const std::filesystem::path file = folder.filePath("lf.npy").toStdString();
    const std::string letters = axes.toStdString();
    const ViewStack<std::uint8_t> views = coloured_views({5, 5});
    io::ArrayShape lengths = lengths_of(views, letters);
    const auto row = letters.find('v');
    lengths[row] *= lengths[row + 1];
    lengths.erase(lengths.begin() + static_cast<std::ptrdiff_t>(row) + 1);
    io::write_npy<std::uint8_t>(file, lengths, in_axes(views, letters));

    const Scene scene = io::open_scene(file, {}, Progress(1));

    QVERIFY2(scene.convention.format.find(stated.toStdString()) != std::string::npos,
             scene.convention.format.c_str());
    QVERIFY(has_samples(scene, views));
  }

  void viewsAfterABatchOfOne_areAList_data() {
    QTest::addColumn<QString>("axes");
    for (const char* axes : {"vuyxc", "vucyx"}) QTest::newRow(axes) << axes;
  }
  void viewsAfterABatchOfOne_areAList() {
    QFETCH(QString, axes);
    const QTemporaryDir folder;
    const std::filesystem::path file = folder.filePath("lf.npy").toStdString();
    const std::string letters = axes.toStdString();
    const ViewStack<std::uint8_t> views = coloured_views({5, 5});
    io::ArrayShape lengths = lengths_of(views, letters);
    lengths[0] = 1;
    lengths[1] = 25;
    io::write_npy<std::uint8_t>(file, lengths, in_axes(views, letters));

    const Scene scene = io::open_scene(file, {}, Progress(1));

    QCOMPARE(scene.light_field->grid(), (GridShape{5, 5}));
    QVERIFY(has_samples(scene, views));
  }

  // As networks for one direction of views take them.
  void greyViewsThatComeLast_areAListAfterABatchOfOne() {
    const QTemporaryDir folder;
    const std::filesystem::path file = folder.filePath("lf.npy").toStdString();
    const ViewStack<std::uint8_t> line = layered_views({.grid = {1, 7}, .height = 48, .width = 64});
    io::write_npy<std::uint8_t>(file, {1, 48, 64, 7}, in_axes(line, "yxvu"));

    const Scene scene = io::open_scene(file, {}, Progress(1));

    QCOMPARE(scene.light_field->grid(), (GridShape{1, 7}));
    QVERIFY(has_samples(scene, line));
  }

  void greyViewsWithAChannel_areAList_data() {
    QTest::addColumn<bool>("is_batch");
    QTest::newRow("N×1×H×W") << false;
    QTest::newRow("1×N×1×H×W") << true;
  }
  void greyViewsWithAChannel_areAList() {
    QFETCH(bool, is_batch);
    const QTemporaryDir folder;
    const std::filesystem::path file = folder.filePath("lf.npy").toStdString();
    const ViewStack<std::uint8_t> views = layered_views({.grid = {5, 5}});
    const auto height = static_cast<std::size_t>(views.height());
    const auto width = static_cast<std::size_t>(views.width());
    io::ArrayShape lengths{25, 1, height, width};
    if (is_batch) lengths.insert(lengths.begin(), 1);
    io::write_npy<std::uint8_t>(file, lengths, in_axes(views, "vuyx"));

    const Scene scene = io::open_scene(file, {}, Progress(1));

    QCOMPARE(scene.light_field->grid(), (GridShape{5, 5}));
    QVERIFY(has_samples(scene, views));
  }

  void channelsOneAfterTheOther_areNoViews() {
    const QTemporaryDir folder;
    const std::filesystem::path file = folder.filePath("lf.npy").toStdString();
    const ViewStack<std::uint8_t> views = coloured_views({5, 5});
    const auto height = static_cast<std::size_t>(views.height());
    const auto width = static_cast<std::size_t>(views.width());
    io::write_npy<std::uint8_t>(file, {75, height, width}, in_axes(views, "vucyx"));

    const Scene scene = io::open_scene(file, {}, Progress(1));

    QCOMPARE(scene.light_field->grid(), (GridShape{5, 5}));
    QVERIFY(has_samples(scene, views));
  }

  void greyListOfThreeTimesSoMany_staysOne() {
    const QTemporaryDir folder;
    const std::filesystem::path file = folder.filePath("lf.npy").toStdString();
    const ViewStack<std::uint8_t> views = layered_views({.grid = {5, 9}});
    const auto height = static_cast<std::size_t>(views.height());
    const auto width = static_cast<std::size_t>(views.width());
    io::write_npy<std::uint8_t>(file, {45, height, width}, in_axes(views, "vuyx"));

    QCOMPARE(io::open_scene(file, {}, Progress(1)).light_field->grid(), (GridShape{5, 9}));
  }

  // What a mosaic becomes when its sides are split.
  void rowsOfViewsBesideThoseOfPixels_areUnderstood_data() {
    QTest::addColumn<QString>("axes");
    for (const char* axes : {"vyuxc", "yvxuc", "yuxvc"}) QTest::newRow(axes) << axes;
  }
  void rowsOfViewsBesideThoseOfPixels_areUnderstood() {
    QFETCH(QString, axes);
    const QTemporaryDir folder;
    const std::filesystem::path file = folder.filePath("lf.npy").toStdString();
    const std::string letters = axes.toStdString();
    const ViewStack<std::uint8_t> views = coloured_views({5, 5});
    io::write_npy<std::uint8_t>(file, lengths_of(views, letters), in_axes(views, letters));

    const Scene scene = io::open_scene(file, {}, Progress(1));

    QVERIFY2(scene.convention.format.find("(" + letters + ")") != std::string::npos,
             scene.convention.format.c_str());
    QVERIFY(has_samples(scene, views));
  }

  void fourthChannelOfDisparity_isNoMask() {
    const QTemporaryDir folder;
    const std::filesystem::path file = folder.filePath("lf.npy").toStdString();
    const ViewStack<std::uint8_t> views = coloured_views({5, 5});
    std::vector<float> samples;
    for (std::size_t n = 0; n < views.size(); ++n) {
      samples.push_back(static_cast<float>(views.data()[n]) / 255);
      if (n % 3 == 2) samples.push_back(0.25F * static_cast<float>(n % 5) - 0.5F);
    }
    io::Hdf5Shape lengths = lengths_of(views, "vuyxc");
    lengths.back() = 4;
    io::write_npy<float>(file, lengths, samples);

    const Scene scene = io::open_scene(file, {}, Progress(1));

    QVERIFY(scene.light_field->is_valid({0, 0}, 0, 0));
    QVERIFY(scene.convention.warnings.front().starts_with("The fourth channel of lf is left out"));
  }

  void onlyRow_staysOne() {
    const QTemporaryDir folder;
    const std::filesystem::path file = folder.filePath("lf.npy").toStdString();
    const ViewStack<std::uint8_t> views = coloured_views({1, 9});
    io::write_npy<std::uint8_t>(file, lengths_of(views, "vuyxc"), in_axes(views, "vuyxc"));

    const Scene scene = io::open_scene(file, {}, Progress(1));

    QCOMPARE(scene.light_field->grid(), (GridShape{1, 9}));
    QVERIFY(has_samples(scene, views));
  }
};

}  // namespace episcope::in_axes_by_motion_test

EPISCOPE_TEST(axes_by_motion_test, AxesByMotionTest)
#include "axes_by_motion_test.moc"
