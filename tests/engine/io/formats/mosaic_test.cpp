// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/image_file.h"
#include "engine/io/base/image_header.h"
#include "engine/io/models/open_options.h"
#include "engine/io/models/reader.h"
#include "engine/io/open.h"
#include "engine/io/write.h"
#include "tests/engine/io/archive_folder.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <opencv2/imgcodecs.hpp>

#include <cmath>
#include <numbers>

namespace episcope::in_mosaic_test {

using namespace episcope::test;

namespace fs = std::filesystem;

namespace {

Scene plane(GridShape grid) {
  PlaneOptions options;
  options.grid = grid;
  return plane_scene(options);
}

Scene in_16_bit(const Scene& scene) {
  const ViewStack<std::uint8_t>& bytes = bytes_of(scene);
  ViewStack<std::uint16_t> words(bytes.grid(), bytes.height(), bytes.width(), bytes.channels());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    words.data()[i] = static_cast<std::uint16_t>(bytes.data()[i] * 256 + i % 256);
  }
  Scene deep;
  deep.light_field = std::make_shared<LightField>(std::move(words), LightFieldInfo{});
  deep.truth = std::make_shared<GroundTruth>();
  return deep;
}

/// Views side by side with white lines between and around them.
Image<std::uint8_t> with_gaps(const Scene& scene, int gap, int margin) {
  const ViewStack<std::uint8_t>& views = bytes_of(scene);
  const GridShape grid = views.grid();
  Image<std::uint8_t> picture(grid.v * (views.height() + gap) - gap + 2 * margin,
                              grid.u * (views.width() + gap) - gap + 2 * margin, views.channels(),
                              255);
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex view = grid.view_at(i);
    for (int y = 0; y < views.height(); ++y) {
      std::copy_n(views.view(view).row(y), views.width() * views.channels(),
                  &picture.at(margin + view.v * (views.height() + gap) + y,
                              margin + view.u * (views.width() + gap)));
    }
  }
  return picture;
}

/// Brightness where lenses begin at the corner, a pitch apart.
double light_under_lenses(double x, double y, double pitch_px) {
  const double turn = 2 * std::numbers::pi / pitch_px;
  return 120 - 50 * std::cos(turn * x) - 50 * std::cos(turn * y);
}

Image<std::uint8_t> lenslets_apart(double pitch_px, io::ImageSize size) {
  Image<std::uint8_t> raw(size.height, size.width);
  for (int y = 0; y < raw.height(); ++y) {
    for (int x = 0; x < raw.width(); ++x) {
      raw.at(y, x) =
          static_cast<std::uint8_t>(std::lround(light_under_lenses(x + 0.5, y + 0.5, pitch_px)));
    }
  }
  return raw;
}

Image<std::uint8_t> tiled(const Scene& scene) {
  return with_gaps(scene, 0, 0);
}

}  // namespace

class MosaicTest : public QObject, private test::PictureFolder {
  Q_OBJECT

 private:
  void write(const std::string& name, const Scene& scene) const {
    io::write_eslf(path(name), scene, Progress(2));
  }

 private slots:
  void init() { renew(); }

  void lenslets_areFoundByTheirPeriod_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<int>("side");
    QTest::newRow("ESLF") << "flower_eslf.png" << 9;
    QTest::newRow("ESLF in capitals") << "IMG_1_ESLF.png" << 5;
    QTest::newRow("MacPI") << "flower_macpi.png" << 7;
    QTest::newRow("lf") << "lf.png" << 9;
    QTest::newRow("without a telling name") << "flower.png" << 7;
  }
  void lenslets_areFoundByTheirPeriod() {
    QFETCH(QString, name);
    QFETCH(int, side);
    const Scene scene = plane({side, side});
    write(name.toStdString(), scene);

    const Scene read = open(name.toStdString());

    QCOMPARE(read.light_field->grid(), (GridShape{side, side}));
    QVERIFY2(has_same_samples(scene, read), describe(read.convention).c_str());
    QVERIFY(QString::fromStdString(read.convention.format).contains("% of the changes"));
    QCOMPARE(read.light_field->info().reading.reader, std::string("mosaic"));
    QCOMPARE(read.convention.files.size(), std::size_t{1});
  }

  void listOfMosaics_tellsTheViews_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<bool>("is_told");
    QTest::newRow("ESLF") << "a_eslf.png" << true;
    QTest::newRow("MacPI") << "a_macpi.png" << true;
    QTest::newRow("a name that tells nothing") << "a.png" << false;
  }
  void listOfMosaics_tellsTheViews() {
    QFETCH(QString, name);
    QFETCH(bool, is_told);
    const Scene scene = plane({7, 7});
    write(name.toStdString(), scene);

    const io::SceneProbe probe = io::reader_named("mosaic")->probe(path(name.toStdString()), {});

    QCOMPARE(probe.grid, (is_told ? GridShape{7, 7} : GridShape{}));
    QCOMPARE(probe.height, is_told ? scene.light_field->height() : 0);
    QCOMPARE(probe.width, is_told ? scene.light_field->width() : 0);
    QCOMPARE(probe.channels, is_told ? 3 : 0);
  }

  void topOfAPng_isThatOfTheWhole() {
    write("a_eslf.png", plane({5, 5}));

    const auto whole = std::get<Image<std::uint8_t>>(io::decode_png(path("a_eslf.png")));
    const auto top = std::get<Image<std::uint8_t>>(io::decode_png_top(path("a_eslf.png"), 11));

    QCOMPARE(top.height(), 11);
    QCOMPARE(top.width(), whole.width());
    QVERIFY(std::equal(top.begin(), top.end(), whole.begin()));
  }

  void sixteenBit_stays() {
    const Scene scene = in_16_bit(plane({5, 5}));
    write("a_eslf.png", scene);

    const Scene read = open("a_eslf.png");

    QCOMPARE(read.light_field->sample_type(), SampleType::UInt16);
    QVERIFY(has_same_samples(scene, read));
  }

  void remainder_isLeftOutAndTold() {
    const Scene scene = plane({5, 5});
    const Image<std::uint8_t> whole = [&] {
      write("a_eslf.png", scene);
      const cv::Mat stored = cv::imread(path("a_eslf.png").string());
      Image<std::uint8_t> padded(stored.rows + 2, stored.cols + 3, 3);
      for (int y = 0; y < stored.rows; ++y) {
        for (int x = 0; x < stored.cols; ++x) {
          for (int c = 0; c < 3; ++c) padded.at(y, x, 2 - c) = stored.ptr(y, x)[c];
        }
      }
      return padded;
    }();
    io::write_png(path("a_eslf.png"), whole.view());

    const Scene read = open("a_eslf.png");

    QVERIFY2(has_same_samples(scene, read), describe(read.convention).c_str());
    QVERIFY(QString::fromStdString(describe(read.convention))
                .contains("the last 3 columns and 2 rows of pixels are left out"));
  }

  void options_decideWhereThePictureDoesNot() {
    // All the same color: nothing repeats.
    io::write_png(path("flat_eslf.png"), Image<std::uint8_t>(72, 144, 3, 40).view());

    QVERIFY_THROWS_EXCEPTION(io::Undecided, (void)open("flat_eslf.png"));
    io::OpenOptions options;
    options.lenslet = 9;
    QCOMPARE(open("flat_eslf.png", options).light_field->grid(), (GridShape{9, 9}));
    options = {};
    options.grid = "3x5";
    QCOMPARE(open("flat_eslf.png", options).light_field->width(), 28);
    options.mosaic = io::Mosaic::Views;
    QVERIFY(QString::fromStdString(open("flat_eslf.png", options).convention.format)
                .startsWith("mosaic of 3×5 views side by side"));
  }

  void lytroSize_isTakenWithTheName() {
    io::write_png(path("flat_eslf.png"), Image<std::uint8_t>(56, 84, 3, 40).view());

    const Scene read = open("flat_eslf.png");

    QCOMPARE(read.light_field->grid(), (GridShape{14, 14}));
    QVERIFY(QString::fromStdString(read.convention.format).contains("14 divides both sides"));
  }

  void pitchThatIsNoWholeNumber_isTold() {
    // Spots of lenslets 15.38 px apart.
    Image<std::uint8_t> raw(300, 320);
    for (int y = 0; y < raw.height(); ++y) {
      for (int x = 0; x < raw.width(); ++x) {
        const double dx = std::remainder(x, 15.38), dy = std::remainder(y, 15.38);
        raw.at(y, x) = static_cast<std::uint8_t>(20 + 200 / (1 + 0.05 * (dx * dx + dy * dy)));
      }
    }
    io::write_png(path("raw.png"), raw.view());
    io::OpenOptions options;
    options.mosaic = io::Mosaic::Lenslets;

    for (const QString& refusal : {refusal_of("raw.png"), refusal_of("raw.png", options)}) {
      QVERIFY2(refusal.contains("give their distance, as --lenslet 15.38"), qPrintable(refusal));
      QVERIFY2(refusal.contains("use episcope-cli decode"), qPrintable(refusal));
    }
  }

  void pitchThatIsNoWholeNumber_isResampled_data() {
    QTest::addColumn<double>("pitch_px");
    QTest::addColumn<int>("views");
    QTest::newRow("smaller") << 15.38 << 15;
    QTest::newRow("larger") << 8.6 << 9;
  }
  void pitchThatIsNoWholeNumber_isResampled() {
    QFETCH(double, pitch_px);
    QFETCH(int, views);
    io::write_png(path("raw.png"), lenslets_apart(pitch_px, {300, 320}).view());
    io::OpenOptions options;
    options.lenslet = pitch_px;
    options.crop = "all";  // also those that see the dark between lenses

    const Scene read = open("raw.png", options);

    QCOMPARE(read.light_field->grid(), (GridShape{views, views}));
    QCOMPARE(read.light_field->height(), static_cast<int>(300 / pitch_px));
    QCOMPARE(read.light_field->width(), static_cast<int>(320 / pitch_px));
    QVERIFY(QString::fromStdString(read.convention.format).contains("resampled from"));
    // Each view sees all lenses at one place. Rounding and cubic interpolation are off by 1 of 200
    // gray levels; without resampling, the last lens is off by a third of a pitch or more.
    const auto& samples = bytes_of(read);
    for (int i = 0; i < samples.grid().count(); ++i) {
      const ViewIndex view = samples.grid().view_at(i);
      const double wanted = light_under_lenses((view.u + 0.5) * pitch_px / views,
                                               (view.v + 0.5) * pitch_px / views, pitch_px);
      const auto seen = samples.view(view);
      for (const int x : {1, 7, seen.width - 2}) {
        QVERIFY(std::abs(seen.at(seen.height - 2, x) - wanted) < 3);
      }
    }
  }

  void lensletsThatCannotBe_areRefused() {
    io::write_png(path("raw.png"), lenslets_apart(8.6, {20, 40}).view());

    for (const double pitch_px : {0.5, 10.1}) {
      io::OpenOptions options;
      options.lenslet = pitch_px;
      QVERIFY(refusal_of("raw.png", options).contains("correct --lenslet"));
    }
  }

  void viewsSideBySide_areFound() {
    const Scene scene = plane({3, 4});
    io::write_png(path("array.png"), tiled(scene).view());

    const Scene read = open("array.png");

    QCOMPARE(read.light_field->grid(), (GridShape{3, 4}));
    QVERIFY2(has_same_samples(scene, read), describe(read.convention).c_str());
  }

  void gapsBetweenViews_areLeftOut_data() {
    QTest::addColumn<int>("gap");
    QTest::addColumn<int>("margin");
    QTest::addColumn<QString>("grid");
    QTest::newRow("lines") << 1 << 0 << "";
    QTest::newRow("frames") << 4 << 4 << "";
    QTest::newRow("stated grid") << 3 << 0 << "5x7";
  }
  void gapsBetweenViews_areLeftOut() {
    QFETCH(int, gap);
    QFETCH(int, margin);
    QFETCH(QString, grid);
    const Scene scene = plane({5, 7});
    io::write_png(path("sheet.png"), with_gaps(scene, gap, margin).view());
    io::OpenOptions options;
    options.grid = grid.toStdString();
    if (!grid.isEmpty()) options.mosaic = io::Mosaic::Views;

    const Scene read = open("sheet.png", options);

    QCOMPARE(read.light_field->grid(), (GridShape{5, 7}));
    QVERIFY2(has_same_samples(read, scene), read.convention.format.c_str());
    QVERIFY(read.convention.warnings.empty());
  }

  void viewsSideBySide_followTheOption() {
    const Scene scene = plane({2, 3});
    io::write_png(path("array.png"), tiled(scene).view());
    io::OpenOptions options;
    options.mosaic = io::Mosaic::Views;
    options.grid = "2x3";

    QVERIFY(has_same_samples(scene, open("array.png", options)));
    options.grid = "200x3";
    QVERIFY(refusal_of("array.png", options).contains("too small for 200×3 views"));
  }

  void folderOfOne_opensItsPicture() {
    const Scene scene = plane({5, 5});
    write("flower_eslf.png", scene);
    io::write_png(path("thumbnail.png"), Image<std::uint8_t>(9, 9, 3).view());

    const Scene read = open("");

    QVERIFY(has_same_samples(scene, read));
    QCOMPARE(read.convention.files.back().example, std::string("thumbnail.png"));
    QVERIFY(!read.convention.files.back().is_used);
  }

  void oneOfSeveral_opensAlone() {
    for (const char* name : {"a_eslf.png", "b_eslf.png", "c_eslf.png"}) write(name, plane({3, 3}));
    const Scene scene = plane({5, 5});
    write("d_eslf.png", scene);

    QVERIFY(has_same_samples(scene, open("d_eslf.png")));
    QVERIFY(refusal_of("").contains("holds 4 light fields"));
  }

  void mosaicsOfOneSize_areNoViews_data() {
    QTest::addColumn<QStringList>("names");
    QTest::newRow("scenes") << QStringList{"scene01.png", "scene02.png"};
    QTest::newRow("frames") << QStringList{"f_0.png", "f_1.png", "f_2.png", "f_3.png"};
    QTest::newRow("without numbers") << QStringList{"bikes.png", "toys.png"};
  }
  void mosaicsOfOneSize_areNoViews() {
    QFETCH(QStringList, names);
    for (int i = 0; i < names.size(); ++i) {
      PlaneOptions options;
      options.grid = {3, 4};
      options.d0 = 0.3 + 0.4 * i;
      io::write_png(path(names[i].toStdString()), tiled(plane_scene(options)).view());
    }

    const Scene read = open(names.front().toStdString());

    QVERIFY2(has_same_samples(plane({3, 4}), read), describe(read.convention).c_str());
    const QString refusal = refusal_of("");
    if (refusal.isEmpty()) QVERIFY(open("").convention.format.starts_with("sequence"));
  }

  void largestOfManyViews_isNoMosaic() {
    const Scene scene = plane({3, 3});
    for (int i = 0; i < 9; ++i) {
      io::write_png(path(std::to_string(i / 3) + "_" + std::to_string(i % 3) + ".png"),
                    bytes_of(scene).view({i / 3, i % 3}));
    }

    QVERIFY(has_same_samples(scene, open("2_2.png")));
  }

  void contradiction_isRefused() {
    write("a_eslf.png", plane({5, 5}));
    io::OpenOptions options;
    options.lenslet = 5;
    options.grid = "3x3";
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)open("a_eslf.png", options));
    options.grid = "";
    options.mosaic = io::Mosaic::Views;
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)open("a_eslf.png", options));
  }

  void centerView_isShownBeforeTheOthers() {
    const Scene scene = plane({5, 5});
    write("a_eslf.png", scene);
    io::OpenOptions options;
    Image<std::uint8_t> shown;
    options.on_center_view = [&](const Image<std::uint8_t>& center, const LightFieldInfo&,
                                 GridShape grid) {
      shown = center;
      QCOMPARE(grid, (GridShape{5, 5}));
    };

    (void)open("a_eslf.png", options);

    const auto center = bytes_of(scene).view({2, 2});
    QVERIFY(std::equal(shown.begin(), shown.end(), center.data, center.data + center.size()));
  }

  void floatSamples_areNotWritten() {
    Scene scene;
    ViewStack<float> views({1, 2}, 3, 4);
    std::fill_n(views.data(), views.size(), 0.5F);
    scene.light_field = std::make_shared<LightField>(std::move(views), LightFieldInfo{});

    QVERIFY_THROWS_EXCEPTION(IoError, write("a.png", scene));
    QVERIFY(!fs::exists(path("a.png")));
  }

  void headers_tellTheSize_data() {
    QTest::addColumn<QString>("suffix");
    for (const char* suffix : {".png", ".jpg", ".bmp", ".tiff"}) QTest::newRow(suffix) << suffix;
  }
  void headers_tellTheSize() {
    QFETCH(QString, suffix);
    const fs::path file = path("a" + suffix.toStdString());
    cv::imwrite(file.string(), cv::Mat(17, 300, CV_8UC3, cv::Scalar(1, 2, 3)));

    QVERIFY(io::image_size(file) == (io::ImageSize{17, 300}));
    fs::resize_file(file, 6);
    QVERIFY(!io::image_size(file));
  }
};

}  // namespace episcope::in_mosaic_test

EPISCOPE_TEST(mosaic_test, MosaicTest)
#include "mosaic_test.moc"
