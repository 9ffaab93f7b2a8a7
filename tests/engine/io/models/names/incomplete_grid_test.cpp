// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/image_file.h"
#include "engine/io/models/names/view_files.h"
#include "engine/io/models/names/view_folders.h"
#include "engine/io/models/open_options.h"
#include "tests/engine/io/models/sidecar_maps/layered_folder.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace episcope::in_incomplete_grid_test {

using namespace episcope::test;

namespace fs = std::filesystem;

/// Grids of which views are missing, with what lies beside them: a square before a wall in 5×5
/// views.
class IncompleteGridTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<LayeredFolder> folder_;

  /// Whether the views are those of the scene from `first` on.
  bool has_views_from(const Scene& scene, ViewIndex first) const {
    const auto& views = std::get<ViewStack<std::uint8_t>>(scene.light_field->samples());
    for (int i = 0; i < views.grid().count(); ++i) {
      const auto found = views.view(views.grid().view_at(i));
      const auto wanted = folder_->scene.views.view(views.grid().view_at(i, first));
      if (std::memcmp(found.data, wanted.data, found.size()) != 0) return false;
    }
    return true;
  }
  bool has_truth_from(const Scene& scene, ViewIndex first) const {
    const ViewStack<float>& found = scene.truth->field.disparity;
    for (int i = 0; i < found.grid().count(); ++i) {
      const ViewIndex view = found.grid().view_at(i, found.first());
      const auto wanted = folder_->scene.disparity.view({view.v + first.v, view.u + first.u});
      if (!std::equal(wanted.data, wanted.data + wanted.size(), found.view(view).data)) {
        return false;
      }
    }
    return true;
  }

 private slots:
  void init() {
    folder_ = std::make_unique<LayeredFolder>(GridShape{5, 5});
    folder_->write_views(LayeredFolder::named("{}_{}.png"));
    fs::remove(folder_->path("4_5.png"));
  }

  void snakeOrder_turnsRowsBeforeTheGap() {
    for (int row = 1; row <= 5; ++row) {
      for (int column = 1; column <= 5; ++column) {
        fs::remove(folder_->path(fmt::format("{}_{}.png", row, column)));
      }
    }
    folder_->write_views([](int row, int column) {
      return fmt::format("{}_{}.png", row, row % 2 == 0 ? 6 - column : column);
    });
    fs::remove(folder_->path("4_5.png"));  // of column 1
    io::OpenOptions options;
    options.snake = true;

    const Scene scene = folder_->open({}, options);

    QCOMPARE(scene.light_field->grid(), (GridShape{5, 4}));
    QVERIFY(has_views_from(scene, {0, 1}));
    QVERIFY(warns_of(scene, "view 4,1 is missing (row,column as in the names, with every second"));
    const io::PatternPreview preview = io::preview_pattern(folder_->path(), {}, true);
    QCOMPARE(preview.grid, (GridShape{5, 4}));
    QCOMPARE(preview.warnings.size(), std::size_t{1});
  }

  void numbersOfFrames_areNoRows() {
    const LayeredFolder cameras(GridShape{4, 4});
    for (const int frame : {1, 2, 3}) {
      cameras.write_views([frame](int row, int column) {
        return fmt::format("pr_{:05}_{:02}.png", frame, 4 * row + column - 5);
      });
    }
    const auto& wanted = cameras.scene.views;

    try {
      (void)cameras.open();
      QFAIL("it was read");
    } catch (const IoError& error) {
      const std::string text = error.what();
      QVERIFY2(text.find("the views of a row lie on a grid of 4×4 themselves") != std::string::npos,
               text.c_str());
    }
    const Scene frame = cameras.open({}, {.pattern = "pr_00002_{index}.png"});
    const auto& views = std::get<ViewStack<std::uint8_t>>(frame.light_field->samples());
    QVERIFY(std::equal(wanted.data(), wanted.data() + wanted.size(), views.data()));
  }

  void missingView_leavesOutItsColumn() {
    const Scene scene = folder_->open();

    QCOMPARE(scene.light_field->grid(), (GridShape{5, 4}));
    QVERIFY(has_views_from(scene, {0, 0}));
    const std::string report = describe(scene.convention);
    QVERIFY2(report.find("Of a grid of 5×5 view 4,5 is missing") != std::string::npos,
             report.c_str());
    QVERIFY2(report.find("4 other views are not used") != std::string::npos, report.c_str());
    const auto is_left_out = [](const FileUse& use) { return !use.is_used && use.count == 4; };
    QVERIFY(std::ranges::any_of(scene.convention.files, is_left_out));
  }

  // Numbers of maps begin at 0, those of views at 1: the missing view must not hide that.
  void mapsOfAllViews_keepTheirViews_data() {
    QTest::addColumn<int>("base");
    QTest::newRow("numbered as the views") << 0;
    QTest::newRow("from 0") << -1;
  }
  void mapsOfAllViews_keepTheirViews() {
    QFETCH(int, base);
    folder_->write_npy(
        [&](int row, int column) {
          return fmt::format("disparity_{}_{}.npy", row + base, column + base);
        },
        folder_->scene.disparity);

    const Scene scene = folder_->open();

    QCOMPARE(scene.truth->field.disparity.grid(), (GridShape{5, 4}));
    QVERIFY(has_truth_from(scene, {0, 0}));
  }

  void mapOfTheCentre_isThatOfTheWholeGrid() {
    for (int column = 1; column < 5; ++column) {
      fs::remove(folder_->path(fmt::format("1_{}.png", column)));
    }
    folder_->write_npy("disparity.npy", folder_->scene.disparity.view({2, 2}));

    const Scene scene = folder_->open();

    // Rows 2 … 5 of all but the last column: the center of the part is another view.
    QCOMPARE(scene.light_field->grid(), (GridShape{4, 4}));
    QVERIFY(has_views_from(scene, {1, 0}));
    QCOMPARE(scene.truth->field.disparity.first(), (ViewIndex{1, 2}));
    QVERIFY(has_truth_from(scene, {1, 0}));
  }

  void listWithAGap_needsTheGrid() {
    for (int i = 0; i < 25; ++i) {
      const fs::path from = folder_->path(fmt::format("{}_{}.png", i / 5 + 1, i % 5 + 1));
      if (fs::exists(from)) fs::rename(from, folder_->path(fmt::format("view{:02}.png", i)));
    }

    QVERIFY_THROWS_EXCEPTION(io::Undecided, (void)folder_->open());

    const Scene scene = folder_->open({}, {.grid = "5x5"});
    QCOMPARE(scene.light_field->grid(), (GridShape{5, 4}));
    QVERIFY(has_views_from(scene, {0, 0}));
  }

  void largestPart_isTheSquarestNearTheCentre() {
    std::vector<bool> is_filled(49, true);
    is_filled[0] = false;  // rows 1 … 6 or columns 1 … 6
    const io::PartOfGrid part = io::largest_filled_part(is_filled, {7, 7});
    QCOMPARE(part.grid, (GridShape{6, 7}));
    QCOMPARE(part.first, (ViewIndex{1, 0}));
    QCOMPARE(*part.in_part({6, 6}), (ViewIndex{5, 6}));
    QVERIFY(!part.in_part({0, 3}));

    const io::PartOfGrid none = io::largest_filled_part(std::vector<bool>(6), {2, 3});
    QCOMPARE(none.grid.count(), 0);
  }
};

}  // namespace episcope::in_incomplete_grid_test

EPISCOPE_TEST(incomplete_grid_test, IncompleteGridTest)
#include "incomplete_grid_test.moc"
