// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/exchange_files.h"
#include "engine/io/base/image_file.h"
#include "engine/io/open.h"
#include "tests/engine/io/models/sidecar_maps/layered_folder.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <fmt/format.h>

#include <fstream>
#include <functional>

namespace episcope::in_benchmark_folder_test {

using namespace episcope::test;

namespace fs = std::filesystem;

/// Folders of the 2016 benchmark as others make them: a square before a wall in 3×3 views.
class BenchmarkFolderTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<LayeredFolder> folder_;

  void write_config() const {
    std::ofstream(folder_->path("parameters.cfg"))
        << "[extrinsics]\nnum_cams_x = 3\nnum_cams_y = 3\n";
  }
  void write_views(const std::string& inside, int count = 9) const {
    int number = 0;
    folder_->for_views(
        LayeredFolder::named(inside + "v{}_{}"), [&](const fs::path& path, ViewIndex view) {
          if (number == count) return;
          const fs::path file = path.parent_path() / fmt::format("input_Cam{:03}.png", number++);
          io::write_png(file, folder_->scene.views.view(view));
        });
  }
  /// By what is to be written at (y, x), of the true map.
  using Value = std::function<float(int y, int x, const Image<float>& map)>;
  void write_truth(const char* name, const Value& value) const {
    const auto center = folder_->scene.disparity.view({1, 1});
    Image<float> map(center.height, center.width);
    std::copy_n(center.data, center.size(), map.data());
    Image<float> written(center.height, center.width);
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) written.at(y, x) = value(y, x, map);
    }
    io::write_pfm(folder_->path(name), written.view());
  }
  void write_truth(const char* name, float sign) const {
    write_truth(name,
                [sign](int y, int x, const Image<float>& map) { return sign * map.at(y, x); });
  }
  /// Of the truth of the center view.
  double error(const Scene& scene) const {
    const auto wanted = folder_->scene.disparity.view({1, 1});
    const DisparityView found = scene.truth->field.view({1, 1});
    double largest = 0;
    for (int y = 0; y < wanted.height; ++y) {
      for (int x = 0; x < wanted.width; ++x) {
        largest = std::max<double>(largest, std::abs(wanted.at(y, x) - found.disparity.at(y, x)));
      }
    }
    return largest;
  }
  static std::string warnings_of(const Scene& scene) {
    std::string all;
    for (const std::string& warning : scene.convention.warnings) all += warning + "\n";
    return all;
  }
  bool has_views_in_order(const Scene& scene) const {
    const auto& views = std::get<ViewStack<std::uint8_t>>(scene.light_field->samples());
    return std::equal(views.data(), views.data() + views.size(), folder_->scene.views.data());
  }

 private slots:
  void init() {
    folder_ = std::make_unique<LayeredFolder>();
    write_config();
  }

  void truthOfTheOtherSign_turnsNoViewsRound() {
    write_views("");
    write_truth("gt_disp_lowres.pfm", -1);

    const Scene scene = folder_->open();

    QVERIFY2(has_views_in_order(scene), scene.convention.order.c_str());
    QCOMPARE(error(scene), 0.0);
    QVERIFY2(scene.convention.units.find("negative = nearer") != std::string::npos,
             scene.convention.units.c_str());
  }

  void valueThatTheViewsContradict_isNotKnown() {
    write_views("");
    write_truth("gt_disp_lowres.pfm", [](int y, int x, const Image<float>& map) {
      return x < 20 && y < 20 ? -999 : map.at(y, x);
    });

    const Scene scene = folder_->open();

    const DisparityView found = scene.truth->field.view({1, 1});
    QVERIFY2(!found.is_valid(10, 10), warnings_of(scene).c_str());
    QVERIFY(found.is_valid(10, 30));
  }

  void maskBesideTheViews_saysWhatIsNotKnown() {
    write_views("");
    write_truth("gt_disp_lowres.pfm", 1);
    const auto center = folder_->scene.disparity.view({1, 1});
    Image<std::uint8_t> mask(center.height, center.width, 1, 255);
    for (int y = 0; y < 20; ++y) std::fill_n(mask.row(y), 20, std::uint8_t{0});
    io::write_png(folder_->path("valid_mask.png"), mask.view());

    const Scene scene = folder_->open();

    const DisparityView found = scene.truth->field.view({1, 1});
    QVERIFY2(!found.is_valid(10, 10), warnings_of(scene).c_str());
    QVERIFY(found.is_valid(10, 30));
    for (const FileUse& use : scene.convention.files) QVERIFY2(use.is_used, use.example.c_str());
  }

  void missingView_leavesAPartWithTheTruthInItsPlace() {
    write_views("");
    write_truth("gt_disp_lowres.pfm", 1);
    fs::remove(folder_->path("input_Cam002.png"));

    const Scene scene = folder_->open();

    QCOMPARE(scene.light_field->grid(), (GridShape{2, 3}));
    QVERIFY2(warns_of(scene, "view 0,2 is missing"), warnings_of(scene).c_str());
    // What was the center view is one in the first row of the part.
    const DisparityView truth = scene.truth->field.view({0, 1});
    const auto wanted = folder_->scene.disparity.view({1, 1});
    QVERIFY(std::equal(wanted.data, wanted.data + wanted.size(), truth.disparity.data));
    const auto& views = std::get<ViewStack<std::uint8_t>>(scene.light_field->samples());
    const auto first = folder_->scene.views.view({1, 0});
    QVERIFY(std::equal(views.data(), views.data() + views.size(), first.data));
  }

  void rangeOfTheOtherSign_isNegatedWithTheTruth() {
    write_views("");
    write_truth("gt_disp_lowres.pfm", -1);
    std::ofstream(folder_->path("parameters.cfg"))
        << "num_cams_x = 3\nnum_cams_y = 3\ndisp_min = -1.6\ndisp_max = 0.6\n";

    const Scene scene = folder_->open();

    QCOMPARE(scene.light_field->info().disparity_range->min, -0.6);
    QCOMPARE(scene.light_field->info().disparity_range->max, 1.6);
    QVERIFY2(warns_of(scene, "the other sign"), warnings_of(scene).c_str());
  }

  void rangeWithoutTheTruth_isTold() {
    write_views("");
    write_truth("gt_disp_lowres.pfm", 1);
    const auto warns = [this](const std::string& range, const char* words) {
      std::ofstream(folder_->path("parameters.cfg")) << "num_cams_x = 3\nnum_cams_y = 3\n"
                                                     << range << '\n';
      const Scene scene = folder_->open();
      return warns_of(scene, words);
    };

    QVERIFY(warns("disp_min = -0.1\ndisp_max = 0.1", "but the ground truth has"));
    QVERIFY(!warns("disp_min = -2\ndisp_max = 2", "but the ground truth has"));
    QVERIFY(warns("disp_min = 2\ndisp_max = -2", "is not below disp_max"));
  }

  void rowsAndColumnsOfViews_areThoseThatTheViewsShow_data() {
    QTest::addColumn<bool>("is_by_columns");
    QTest::newRow("numbers of cameras exchanged") << false;
    QTest::newRow("column by column") << true;
  }
  void rowsAndColumnsOfViews_areThoseThatTheViewsShow() {
    QFETCH(bool, is_by_columns);
    folder_ = std::make_unique<LayeredFolder>(GridShape{3, 5});
    std::ofstream(folder_->path("parameters.cfg"))
        << (is_by_columns ? "num_cams_x = 5\nnum_cams_y = 3\n"
                          : "num_cams_x = 3\nnum_cams_y = 5\n");
    folder_->for_views(LayeredFolder::named("v{}_{}"), [&](const fs::path& path, ViewIndex view) {
      const int number = is_by_columns ? 3 * view.u + view.v : 5 * view.v + view.u;
      io::write_png(path.parent_path() / fmt::format("input_Cam{:03}.png", number),
                    folder_->scene.views.view(view));
    });

    const Scene scene = folder_->open();

    QCOMPARE(scene.light_field->grid(), (GridShape{3, 5}));
    QVERIFY2(has_views_in_order(scene), describe(scene.convention).c_str());
    QVERIFY2(warns_of(scene, "The views are not"), warnings_of(scene).c_str());
  }

  void truthInHighResolutionAlone_isRead() {
    write_views("");
    const auto center = folder_->scene.disparity.view({1, 1});
    Image<float> map(10 * center.height, 10 * center.width);
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) map.at(y, x) = center.at(y / 10, x / 10);
    }
    io::write_pfm(folder_->path("gt_disp_highres.pfm"), map.view());

    const Scene scene = folder_->open();

    QCOMPARE(error(scene), 0.0);
    QVERIFY2(!warns_of(scene, "left out"), warnings_of(scene).c_str());
  }

  void truthOfThreeEqualChannels_isRead() {
    write_views("");
    const auto center = folder_->scene.disparity.view({1, 1});
    Image<float> map(center.height, center.width, 3);
    for (std::size_t i = 0; i < map.size(); ++i) map.data()[i] = center.data[i / 3];
    io::write_pfm(folder_->path("gt_disp_lowres.pfm"), map.view());

    QCOMPARE(error(folder_->open()), 0.0);
  }

  void viewsInAFolderInside_areFound() {
    write_views("input/");
    write_truth("gt_disp_lowres.pfm", 1);

    const Scene scene = folder_->open();

    QVERIFY(has_views_in_order(scene));
    QCOMPARE(error(scene), 0.0);
    QCOMPARE(count_used(scene, "views"), 9);
  }

  void truthOfAnotherName_isRead() {
    write_views("");
    write_truth("gt_disp.pfm", 1);

    QCOMPARE(error(folder_->open()), 0.0);
  }

  void commentsAndDecimalCommas_areRead() {
    write_views("");
    std::ofstream(folder_->path("parameters.cfg"))
        << "# by hand\r\n[intrinsics]\r\nfocal_length_mm = 100,0 ; mm\r\nsensor_size_mm = 35.0\t# "
           "mm\r\n"
           "[extrinsics]\r\nnum_cams_x = 3\r\nnum_cams_y = 3 ; rows\r\nbaseline_mm = 50,5\r\n"
           "focus_distance_m = 9\r\n";

    const Scene scene = folder_->open();

    QCOMPARE(scene.light_field->grid(), (GridShape{3, 3}));
    QCOMPARE(scene.light_field->info().camera.baseline, 50.5);
  }

  void truthThatDoesNotFit_isLeftOut_data() {
    QTest::addColumn<QString>("file");
    QTest::addColumn<QString>("content");
    QTest::addColumn<QString>("reason");
    const QString disparity = "gt_disp_lowres.pfm";
    QTest::newRow("another size") << disparity << "Pf\n1 1\n-1\nabcd"
                                  << "this map has 1×1 px, but the views have";
    QTest::newRow("cut") << disparity << "Pf\n80 64\n-1\nabcd"
                         << "truncated";
    QTest::newRow("boundless") << disparity << "Pf\n65536 65536\n-1\n"
                               << "0 of 65536 rows are present";
    QTest::newRow("region") << "mask_planes_lowres.png"
                            << "no image"
                            << "cannot be decoded";
    QTest::newRow("labels") << "objectids_lowres.png"
                            << "no image"
                            << "cannot be decoded";
  }
  void truthThatDoesNotFit_isLeftOut() {
    QFETCH(QString, file);
    QFETCH(QString, content);
    QFETCH(QString, reason);
    write_views("");
    std::ofstream(folder_->path(file.toStdString())) << content.toStdString();

    const Scene scene = folder_->open();

    QVERIFY(has_views_in_order(scene));
    QVERIFY(!scene.truth || (scene.truth->field.empty() && scene.truth->regions.empty() &&
                             scene.truth->labels.empty()));
    QVERIFY2(warns_of(scene, reason.toStdString()), warnings_of(scene).c_str());
  }

  void truthOfOneViewThatIsDamaged_leavesTheOthers() {
    write_views("");
    for (int i = 0; i < 9; ++i) {
      const auto view = folder_->scene.disparity.view({i / 3, i % 3});
      io::write_pfm(folder_->path(fmt::format("gt_disp_lowres_Cam{:03}.pfm", i)), view);
    }
    fs::resize_file(folder_->path("gt_disp_lowres_Cam002.pfm"), 500);

    const Scene scene = folder_->open();

    QVERIFY2(has_views_in_order(scene), scene.convention.order.c_str());
    QCOMPARE(error(scene), 0.0);
    QCOMPARE(count_used(scene, "disparity maps"), 8);
    const auto lost = scene.truth->field.valid.view({0, 2});
    QVERIFY(std::all_of(lost.data, lost.data + lost.size(), [](auto valid) { return valid == 0; }));
    QVERIFY2(warns_of(scene, "1 of 9 disparity maps are left out"), warnings_of(scene).c_str());
  }

  void valuesThatAreNoNumbers_areNotUsed() {
    write_views("");
    std::ofstream(folder_->path("parameters.cfg"))
        << "focal_length_mm = 100\nsensor_size_mm = 35\nbaseline_mm = 50\nnum_cams_x = many\n"
           "num_cams_y = 3\nfocus_distance_m = nan\n";

    const Scene scene = folder_->open();

    QVERIFY(has_views_in_order(scene));
    QVERIFY2(warns_of(scene, "num_cams_x is 'many'"), warnings_of(scene).c_str());
    QVERIFY2(warns_of(scene, "focus_distance_m is 'nan'"), warnings_of(scene).c_str());
    QVERIFY2(warns_of(scene, "focus_distance_m is missing"), warnings_of(scene).c_str());
  }

  void configOfAnotherScene_losesToTheFiles_data() {
    QTest::addColumn<int>("columns");
    QTest::newRow("less") << 2;
    QTest::newRow("more") << 5;
  }
  void configOfAnotherScene_losesToTheFiles() {
    QFETCH(int, columns);
    write_views("");
    write_truth("gt_disp_lowres.pfm", 1);
    std::ofstream(folder_->path("parameters.cfg"))
        << fmt::format("[extrinsics]\nnum_cams_x = {}\nnum_cams_y = 3\n", columns);

    const Scene scene = folder_->open();

    QVERIFY2(has_views_in_order(scene), scene.convention.order.c_str());
    const auto& warnings = scene.convention.warnings;
    QVERIFY(!warnings.empty());
    QVERIFY2(
        warnings.front().find(fmt::format("promises 3×{} views", columns)) != std::string::npos,
        warnings.front().c_str());
  }

  void gridThatContradictsConfig_isRefused_data() {
    QTest::addColumn<QString>("grid");
    QTest::newRow("fewer views") << "2x2";
    QTest::newRow("as many, otherwise") << "1x9";
  }
  void gridThatContradictsConfig_isRefused() {
    QFETCH(QString, grid);
    write_views("");
    std::ofstream(folder_->path("parameters.cfg"))
        << "[extrinsics]\nnum_cams_x = 3\nnum_cams_y = 3\n";
    QVERIFY_THROWS_EXCEPTION(InvalidInput, folder_->open("", {.grid = grid.toStdString()}));
    QVERIFY_THROWS_EXCEPTION(InvalidInput,
                             folder_->open("", {.equalize = true, .keep_brightness = true}));
  }

  void withoutConfig_gridsThatAreNotSquareAreLists() {
    fs::remove(folder_->path("parameters.cfg"));
    write_views("", 6);
    write_truth("gt_disp_lowres.pfm", 1);

    const Scene scene = folder_->open("", {.grid = "2x3"});

    QCOMPARE(scene.light_field->grid(), (GridShape{2, 3}));
    try {
      QCOMPARE(folder_->open().light_field->grid(), (GridShape{2, 3}));
    } catch (const IoError& question) {  // six views may be too few to tell
      QVERIFY2(std::string(question.what()).find("--grid") != std::string::npos, question.what());
    }
  }
};

}  // namespace episcope::in_benchmark_folder_test

EPISCOPE_TEST(benchmark_folder_test, BenchmarkFolderTest)
#include "benchmark_folder_test.moc"
