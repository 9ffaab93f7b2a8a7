// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/exchange_files.h"
#include "engine/io/base/image_file.h"
#include "engine/io/base/npy.h"
#include "engine/io/formats/write_arrays.h"
#include "engine/io/models/external_result.h"
#include "tests/engine/io/base/exr_file.h"
#include "tests/engine/io/formats/array_files.h"
#include "tests/test_main.h"

#include <QTemporaryDir>
#include <opencv2/imgcodecs.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace episcope::in_map_forms_test {

namespace {

constexpr GridShape kGrid{3, 5};
constexpr int kHeight = 4;
constexpr int kWidth = 6;

ViewStack<float> sample_maps(GridShape grid) {
  ViewStack<float> maps(grid, kHeight, kWidth);
  for (std::size_t i = 0; i < maps.size(); ++i) {
    maps.data()[i] = 0.1F * static_cast<float>(i) - 1;
  }
  maps.data()[8] = std::numeric_limits<float>::quiet_NaN();
  return maps;
}

/// A result whose maps these are, NaN = invalid.
Estimate result_of(const ViewStack<float>& maps) {
  Estimate estimate;
  estimate.field.disparity = maps.clone();
  io::mark_invalid(estimate.field);
  return estimate;
}

using Write = void (*)(const std::filesystem::path&, const ViewStack<float>&);

void write_mat5(const std::filesystem::path& path, const ViewStack<float>& maps) {
  test::write_mat5_map(path, "disparity", maps.view({0, 0}));
}

void write_csv(const std::filesystem::path& path, const ViewStack<float>& maps) {
  io::write_csv_map(path, maps.view({0, 0}));
}

void write_exr(const std::filesystem::path& path, const ViewStack<float>& maps) {
  test::write_exr(path, {{"Y", maps.view({0, 0})}});
}

void write_npz(const std::filesystem::path& path, const ViewStack<float>& maps) {
  io::write_npz_maps(path, result_of(maps));
}

void write_mat(const std::filesystem::path& path, const ViewStack<float>& maps) {
  io::write_mat_maps(path, result_of(maps));
}

/// An uncompressed TIFF of one strip. `format`: 1 = unsigned, 2 = signed, 3 = float; by default as
/// the samples are.
void write_tiff(const std::filesystem::path& path, const cv::Mat& samples, int format = 0) {
  if (format == 0) format = samples.depth() >= CV_32F ? 3 : 2;
  const auto size = static_cast<std::uint32_t>(samples.total() * samples.elemSize());
  std::string file("II*\0", 4);
  const auto put = [&](std::uint32_t number, int bytes) {
    for (int i = 0; i < bytes; ++i) file += static_cast<char>(number >> (8 * i) & 0xFF);
  };
  put(8 + size, 4);
  file.append(reinterpret_cast<const char*>(samples.data), size);
  const std::vector<std::array<std::uint32_t, 2>> tags{
      {256, static_cast<std::uint32_t>(samples.cols)},
      {257, static_cast<std::uint32_t>(samples.rows)},
      {258, static_cast<std::uint32_t>(8 * samples.elemSize1())},
      {259, 1},
      {262, 1},
      {273, 8},
      {277, 1},
      {278, static_cast<std::uint32_t>(samples.rows)},
      {279, size},
      {339, static_cast<std::uint32_t>(format)}};
  put(static_cast<std::uint32_t>(tags.size()), 2);
  for (const auto& [tag, value] : tags) {
    put(tag, 2);
    put(4, 2);
    put(1, 4);
    put(value, 4);
  }
  put(0, 4);
  io::write_atomically(path, file);
}

/// With confidence, and second disparity in every other pixel.
Estimate full_result(GridShape grid) {
  Estimate estimate = result_of(sample_maps(grid));
  estimate.confidence = ViewStack<float>(grid, kHeight, kWidth);
  estimate.second.disparity = ViewStack<float>(grid, kHeight, kWidth);
  for (std::size_t i = 0; i < estimate.confidence.size(); ++i) {
    estimate.confidence.data()[i] = static_cast<float>(i % 11) / 10;
    estimate.second.disparity.data()[i] =
        i % 2 == 0 ? static_cast<float>(i) : std::numeric_limits<float>::quiet_NaN();
  }
  io::mark_invalid(estimate.second);
  return estimate;
}

}  // namespace

class MapFormsTest : public QObject {
  Q_OBJECT

 private:
  QTemporaryDir folder_;
  std::filesystem::path path(const QString& name) const {
    return std::filesystem::path(folder_.path().toStdString()) / name.toStdString();
  }
  Image<float> csv_map(const char* text) const {
    io::write_atomically(path("map.csv"), std::string_view(text));
    return io::read_text_map(path("map.csv"));
  }

 private slots:
  void mapsOfAllForms_areRead_data() {
    QTest::addColumn<QString>("file");
    QTest::addColumn<Write>("write");
    QTest::addColumn<bool>("has_all_views");
    QTest::newRow("npy") << "a.npy" << &io::write_npy_maps << false;
    QTest::newRow("npz") << "a.npz" << &write_npz << false;
    QTest::newRow("mat 7.3") << "a.mat" << &write_mat << false;
    QTest::newRow("mat 5") << "five.mat" << &write_mat5 << false;
    QTest::newRow("csv") << "a.csv" << &write_csv << false;
    QTest::newRow("text") << "a.txt" << &write_csv << false;
    QTest::newRow("exr") << "a.exr" << &write_exr << false;
    QTest::newRow("npy of all views") << "b.npy" << &io::write_npy_maps << true;
    QTest::newRow("npz of all views") << "b.npz" << &write_npz << true;
    QTest::newRow("mat of all views") << "b.mat" << &write_mat << true;
  }
  void mapsOfAllForms_areRead() {
    QFETCH(QString, file);
    QFETCH(Write, write);
    QFETCH(bool, has_all_views);
    const ViewStack<float> maps = sample_maps(has_all_views ? kGrid : GridShape{1, 1});

    write(path(file), maps);
    const DisparityField read = io::read_disparity_map(path(file), kGrid);

    QCOMPARE(read.disparity.grid(), maps.grid());
    QCOMPARE(read.disparity.first(), has_all_views ? ViewIndex{} : kGrid.center());
    QCOMPARE(read.disparity.height(), kHeight);
    for (std::size_t i = 0; i < maps.size(); ++i) {
      QCOMPARE(read.valid.data()[i] != 0, std::isfinite(maps.data()[i]));
      if (i != 8) QCOMPARE(read.disparity.data()[i], maps.data()[i]);
    }
  }

  void pagesOfATiff_areViewsRowByRow() {
    ViewStack<float> maps = sample_maps(kGrid);
    std::vector<cv::Mat> pages;
    for (int i = 0; i < kGrid.count(); ++i) {
      pages.emplace_back(kHeight, kWidth, CV_32F, maps.view(maps.view_at(i)).data);
    }
    const auto write = [&](const QString& name) {
      QVERIFY(cv::imwritemulti(path(name).string(), pages));
    };
    write("all.tif");
    const DisparityField read = io::read_disparity_map(path("all.tif"), kGrid);
    QCOMPARE(read.disparity.grid(), kGrid);
    QCOMPARE(read.disparity.view({2, 3}).at(1, 1), maps.view({2, 3}).at(1, 1));

    pages.resize(4);
    write("four.tif");
    QVERIFY_THROWS_EXCEPTION(IoError, (void)io::read_disparity_map(path("four.tif"), kGrid));

    pages.resize(2);  // a reduced copy
    pages[1] = pages[1](cv::Rect(0, 0, kWidth / 2, kHeight / 2)).clone();
    write("reduced.tif");
    QCOMPARE(io::read_disparity_map(path("reduced.tif"), kGrid).disparity.first(), kGrid.center());
  }

  void mapsBesideDisparity_areReadBack_data() {
    QTest::addColumn<QString>("file");
    QTest::addColumn<bool>("has_all_views");
    for (const bool has_all : {false, true}) {
      QTest::addRow("npz %d", has_all) << "full.npz" << has_all;
      QTest::addRow("mat %d", has_all) << "full.mat" << has_all;
    }
  }
  void mapsBesideDisparity_areReadBack() {
    QFETCH(QString, file);
    QFETCH(bool, has_all_views);
    const Estimate written = full_result(has_all_views ? kGrid : GridShape{1, 1});

    file.endsWith("npz") ? io::write_npz_maps(path(file), written)
                         : io::write_mat_maps(path(file), written);
    const Estimate read = io::read_external_result(path(file), kGrid, "");

    QCOMPARE(read.confidence.first(), read.field.disparity.first());
    QCOMPARE(read.confidence.size(), written.confidence.size());
    for (std::size_t i = 0; i < written.confidence.size(); ++i) {
      QCOMPARE(read.field.valid.data()[i], written.field.valid.data()[i]);
      QCOMPARE(read.confidence.data()[i], written.confidence.data()[i]);
      QCOMPARE(read.second.valid.data()[i], written.second.valid.data()[i]);
      QCOMPARE(read.second.disparity.data()[i], written.second.disparity.data()[i]);
    }
  }

  void confidenceOfAnotherMeaning_isLeftOut() {
    Estimate estimate = full_result({1, 1});
    estimate.confidence.data()[3] = 7;
    io::write_npz_maps(path("cost.npz"), estimate);

    const Estimate read = io::read_external_result(path("cost.npz"), kGrid, "");

    QVERIFY(read.confidence.empty());
    QVERIFY(read.notes.front().starts_with("confidence is left out"));
  }

  void lightFieldsBesideMaps_areNoResult() {
    ViewStack<std::uint8_t> views(kGrid, kHeight, kWidth, 3);
    std::fill_n(views.data(), views.size(), std::uint8_t{7});
    test::write_mat5(path("lf.mat"), views, {});
    write_npz(path("maps.npz"), sample_maps(kGrid));

    QVERIFY(!io::is_map_archive(path("lf.mat")));
    QVERIFY(io::is_map_archive(path("maps.npz")));
    QVERIFY(!io::is_map_archive(path("none.npz")));
    QVERIFY_THROWS_EXCEPTION(IoError, (void)io::read_disparity_map(path("lf.mat"), kGrid));
  }

  void csv_takesWhatProgramsWrite_data() {
    QTest::addColumn<QString>("text");
    QTest::newRow("commas") << "1,2.5,-3e-1\n4,,6\n";
    QTest::newRow("semicolons, comment, CR LF") << "# a map\r\n1; 2.5; -0.3\r\n4;NaN;6\r\n";
    QTest::newRow("spaces") << "  1 2.5   -.3\n\n4 nan 6";
    QTest::newRow("tabs") << "1\t2.5\t-0.3\n4\t-inf\t+6\n";
    QTest::newRow("decimal commas, a comment of MATLAB") << "% a map\n1;2,5;-0,3\n4;NaN;6\n";
  }
  void csv_takesWhatProgramsWrite() {
    QFETCH(QString, text);

    const Image<float> map = csv_map(text.toUtf8().constData());

    QCOMPARE(map.height(), 2);
    QCOMPARE(map.width(), 3);
    QCOMPARE(map.at(0, 2), -0.3F);
    QVERIFY(std::isnan(map.at(1, 1)));
    QCOMPARE(map.at(1, 2), 6.0F);
  }

  void csv_leavesOutNamesOfRowsAndColumns_data() {
    QTest::addColumn<QString>("header");
    QTest::addColumn<bool>("has_index");
    QTest::newRow("index and numbers, as of pandas") << ",0,1,2,3,4,5,6,7,8" << true;
    QTest::newRow("named index and numbers") << "y,0,1,2,3,4,5,6,7,8" << true;
    QTest::newRow("names") << "a,b,c,d,e,f,g,h,i" << false;
    QTest::newRow("index and names") << ",a,b,c,d,e,f,g,h,i" << true;
    QTest::newRow("named index and names") << "y,a,b,c,d,e,f,g,h,i" << true;
    QTest::newRow("quoted, from 1, as of R") << R"("","1","2","3","4","5","6","7","8","9")" << true;
  }
  void csv_leavesOutNamesOfRowsAndColumns() {
    QFETCH(QString, header);
    QFETCH(bool, has_index);
    std::string text = header.toStdString() + "\n";
    for (int y = 0; y < 10; ++y) {
      if (has_index) text += std::to_string(y) + ",";
      for (int x = 0; x < 9; ++x) text += (x > 0 ? "," : "") + std::to_string(-x - 10 * y);
      text += "\n";
    }

    const Image<float> map = csv_map(text.c_str());

    QVERIFY(io::is_text_map(path("map.csv")));
    QCOMPARE(map.height(), 10);
    QCOMPARE(map.width(), 9);
    QCOMPARE(map.at(0, 0), 0.0F);
    QCOMPARE(map.at(9, 8), -98.0F);
  }

  // A ramp is a map, too.
  void csvOfNumbersThatCount_isWhole() {
    std::string text;
    for (int y = 0; y < 10; ++y) {
      for (int x = 0; x < 9; ++x) text += (x > 0 ? "," : "") + std::to_string(x + y);
      text += "\n";
    }

    const Image<float> map = csv_map(text.c_str());

    QCOMPARE(map.height(), 10);
    QCOMPARE(map.width(), 9);
  }

  void tiffOfOtherSamples_isRead_data() {
    QTest::addColumn<int>("depth");
    QTest::newRow("double") << CV_64F;
    QTest::newRow("int16") << CV_16S;
    QTest::newRow("int32") << CV_32S;
  }
  void tiffOfOtherSamples_isRead() {
    QFETCH(int, depth);
    cv::Mat samples(3, 4, CV_MAKETYPE(depth, 1));
    for (int i = 0; i < 12; ++i)
      cv::Mat(1, 1, CV_64F, cv::Scalar(-3 * i))
          .convertTo(samples(cv::Rect(i % 4, i / 4, 1, 1)), depth);
    write_tiff(path("a.tif"), samples);

    const DisparityField read = io::read_disparity_map(path("a.tif"), kGrid);

    QCOMPARE(read.disparity.view(kGrid.center()).at(2, 3), -33.0F);
    QCOMPARE(io::read_image_header(path("a.tif")).sample_type, SampleType::Float32);
  }

  void tiffOfUnsignedIntegers_isRead() {
    write_tiff(path("u.tif"), cv::Mat(3, 4, CV_32S, cv::Scalar(70'000)), 1);

    QCOMPARE(io::read_disparity_map(path("u.tif"), kGrid).disparity.view(kGrid.center()).at(2, 3),
             70'000.0F);
  }

  void tiffOfHalfFloats_isRead() {
    write_tiff(path("h.tif"), cv::Mat(3, 4, CV_16U, cv::Scalar(0xC180)), 3);

    QCOMPARE(io::read_disparity_map(path("h.tif"), kGrid).disparity.view(kGrid.center()).at(2, 3),
             -2.75F);
    QCOMPARE(io::read_image_header(path("h.tif")).sample_type, SampleType::Float32);
  }

  void csv_refusesWhatIsNoMap() {
    QVERIFY_THROWS_EXCEPTION(IoError, (void)csv_map("1,2\n3\n"));
    QVERIFY_THROWS_EXCEPTION(IoError, (void)csv_map("x,y\n3,4\n"));
    QVERIFY_THROWS_EXCEPTION(IoError, (void)csv_map("\n# nothing\n"));
  }
};

}  // namespace episcope::in_map_forms_test

EPISCOPE_TEST(map_forms_test, MapFormsTest)
#include "map_forms_test.moc"
