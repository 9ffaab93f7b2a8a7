// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/order/list_layout.h"
#include "engine/core/error.h"
#include "tests/engine/io/models/order/layered_scene.h"
#include "tests/test_main.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <mutex>
#include <set>

namespace episcope::in_list_layout_test {

using namespace episcope::test;
using io::ListLayout;
using io::ListOrder;

/// How lists of views are found to lie.
class ListLayoutTest : public QObject {
  Q_OBJECT

 private:
  static ListLayout layout_of_list(const LayeredOptions& options, ListOrder order) {
    ListLayout stored;
    stored.grid = options.grid;
    stored.order = order;
    LightField::Samples list = rearranged(layered_views(options), {1, options.grid.count()},
                                          [&](int i) { return stored.place(i); });
    return io::find_list_layout(list, Progress(2));
  }

 private slots:
  void everyArrangement_isFound_data() {
    QTest::addColumn<int>("rows");
    QTest::addColumn<int>("columns");
    QTest::addColumn<int>("order");
    const auto add = [](int rows, int columns, ListOrder order) {
      QTest::addRow("%dx%d in order %d", rows, columns, static_cast<int>(order))
          << rows << columns << static_cast<int>(order);
    };
    for (const ListOrder order :
         {ListOrder::Rows, ListOrder::Columns, ListOrder::SnakeRows, ListOrder::SnakeColumns}) {
      add(7, 7, order);
      add(3, 8, order);
      add(5, 2, order);
    }
    for (const int count : {2, 3, 9, 49}) {
      add(1, count, ListOrder::Rows);
      add(count, 1, ListOrder::Rows);
    }
    add(2, 2, ListOrder::Rows);
    add(2, 2, ListOrder::Columns);
    add(15, 15, ListOrder::Rows);
  }
  void everyArrangement_isFound() {
    QFETCH(int, rows);
    QFETCH(int, columns);
    QFETCH(int, order);
    LayeredOptions options{.grid = {rows, columns}};
    if (std::max(rows, columns) > 20) {
      options.background_px *= 0.5;
      options.foreground_px *= 0.5;
    }

    const ListLayout found = layout_of_list(options, static_cast<ListOrder>(order));

    QVERIFY2(found.is_decided, found.evidence.c_str());
    QVERIFY2(found.grid == options.grid, io::layout_text(found).c_str());
    if (rows > 1 && columns > 1) QCOMPARE(static_cast<int>(found.order), order);
  }

  void focalStack_isNoLightField_data() {
    QTest::addColumn<int>("sharpest");
    QTest::newRow("the first") << 0;
    QTest::newRow("the middle") << 3;
  }
  void focalStack_isNoLightField() {
    QFETCH(int, sharpest);
    const LightField::Samples one = layered_views({.grid = {1, 1}});
    const auto& sharp = std::get<ViewStack<std::uint8_t>>(one);
    ViewStack<std::uint8_t> stack({1, 7}, sharp.height(), sharp.width(), sharp.channels());
    for (int i = 0; i < 7; ++i) {
      const int radius = std::abs(i - sharpest);
      const auto from = sharp.view({0, 0});
      const auto to = stack.view({0, i});
      // Means over more and more pixels: no point moves.
      for (int y = 0; y < to.height; ++y) {
        for (int x = 0; x < to.width; ++x) {
          for (int c = 0; c < to.channels; ++c) {
            int sum = 0, count = 0;
            for (int dy = -radius; dy <= radius; ++dy) {
              for (int dx = -radius; dx <= radius; ++dx) {
                const int py = std::clamp(y + dy, 0, to.height - 1);
                const int px = std::clamp(x + dx, 0, to.width - 1);
                sum += from.at(py, px, c);
                ++count;
              }
            }
            to.at(y, x, c) = static_cast<std::uint8_t>(sum / count);
          }
        }
      }
    }

    const ListLayout found = io::find_list_layout(std::move(stack), Progress(2));

    QVERIFY(!found.is_decided);
    QVERIFY2(found.evidence.find("as those of a focal stack do") != std::string::npos,
             found.evidence.c_str());
  }

  void poorViews_areStillArranged_data() {
    QTest::addColumn<double>("noise");
    QTest::addColumn<double>("gain");
    QTest::addColumn<double>("background");
    QTest::addColumn<double>("foreground");
    QTest::newRow("noise") << 12.0 << 1.0 << -0.6 << 0.9;
    QTest::newRow("dark") << 3.0 << 0.1 << -0.6 << 0.9;
    QTest::newRow("small disparities") << 2.0 << 1.0 << -0.2 << 0.3;
    QTest::newRow("wide baseline") << 2.0 << 1.0 << 1.0 << 5.0;
    QTest::newRow("one plane in focus") << 2.0 << 1.0 << 0.0 << 1.0;
  }
  void poorViews_areStillArranged() {
    QFETCH(double, noise);
    QFETCH(double, gain);
    QFETCH(double, background);
    QFETCH(double, foreground);
    LayeredOptions options{.grid = {7, 7},
                           .background_px = background,
                           .foreground_px = foreground,
                           .noise = noise,
                           .gain = gain};

    const ListLayout grid = layout_of_list(options, ListOrder::Rows);
    options.grid = {1, 49};
    options.background_px *= 0.5;
    options.foreground_px *= 0.5;
    const ListLayout line = layout_of_list(options, ListOrder::Rows);

    QVERIFY2(grid.is_decided && grid.grid == (GridShape{7, 7}), grid.evidence.c_str());
    QVERIFY2(line.is_decided && line.grid == (GridShape{1, 49}), line.evidence.c_str());
  }

  void viewsWithoutParallax_areNotArranged_data() {
    QTest::addColumn<double>("noise");
    QTest::newRow("the same view") << 0.0;
    QTest::newRow("the same view with noise") << 5.0;
  }
  void viewsWithoutParallax_areNotArranged() {
    QFETCH(double, noise);

    const ListLayout found = layout_of_list(
        {.grid = {4, 4}, .background_px = 0, .foreground_px = 0, .noise = noise}, ListOrder::Rows);

    QVERIFY2(!found.is_decided, found.evidence.c_str());
    QVERIFY(!found.evidence.empty());
  }

  void viewsAtRandom_areNotArranged() {
    const std::array<int, 12> shuffled{7, 2, 11, 4, 0, 9, 5, 1, 10, 3, 8, 6};
    const LightField::Samples list =
        rearranged(layered_views({.grid = {3, 4}}), {1, 12}, [&](int i) {
          return GridShape{3, 4}.view_at(shuffled[static_cast<std::size_t>(i)]);
        });

    const ListLayout found = io::find_list_layout(list, Progress(2));

    QVERIFY2(!found.is_decided, io::layout_text(found).c_str());
  }

  void listsWithGaps_areNotTakenForOtherGrids_data() {
    QTest::addColumn<int>("rows");
    QTest::addColumn<int>("missing");
    QTest::newRow("7x7 without the last view") << 7 << 1;
    QTest::newRow("7x7 without the last two") << 7 << 2;
    QTest::newRow("9x9 without the last view") << 9 << 1;
    QTest::newRow("9x9 without the last two") << 9 << 2;
  }
  void listsWithGaps_areNotTakenForOtherGrids() {
    QFETCH(int, rows);
    QFETCH(int, missing);
    const GridShape grid{rows, rows};
    const LightField::Samples list =
        rearranged(layered_views({.grid = grid}), {1, grid.count() - missing},
                   [&](int i) { return grid.view_at(i); });

    const ListLayout found = io::find_list_layout(list, Progress(2));

    QVERIFY2(!found.is_decided, io::layout_text(found).c_str());
  }

  void darkViews_doNotCount() {
    ViewStack<std::uint8_t> views = layered_views({.grid = {7, 7}});
    for (const ViewIndex corner : {ViewIndex{0, 0}, {0, 6}, {6, 0}, {6, 6}, {0, 1}}) {
      std::fill_n(views.view(corner).data, views.view_size(), std::uint8_t{0});
    }

    const ListLayout found = io::find_list_layout(std::move(views), Progress(2));

    QVERIFY2(found.is_decided && found.grid == (GridShape{7, 7}), found.evidence.c_str());
  }

  void longLists_askForSomeViewsOnly() {
    const ViewStack<std::uint8_t> views =
        layered_views({.grid = {17, 17}, .height = 64, .width = 64, .foreground_px = 0.5});
    std::set<int> asked;
    std::mutex mutex;
    const auto view = [&](int index) {
      const std::lock_guard lock(mutex);
      asked.insert(index);
      const auto bytes = views.view(views.view_at(index));
      Image<float> grey(bytes.height, bytes.width);
      std::copy_n(bytes.data, bytes.size(), grey.data());
      return grey;
    };

    const ListLayout found = io::find_list_layout(289, view, Progress(2));

    QVERIFY2(found.is_decided && found.grid == (GridShape{17, 17}), found.evidence.c_str());
    QVERIFY2(asked.size() <= 140, qPrintable(QString::number(asked.size())));
  }

  void evidence_saysWhatWasMeasured() {
    const ListLayout found = layout_of_list({.grid = {7, 7}}, ListOrder::SnakeColumns);

    QCOMPARE(io::layout_text(found), std::string("7×7, column by column in snake order"));
    QVERIFY2(found.evidence.find("7 lines of 7 in snake order") != std::string::npos,
             found.evidence.c_str());
  }

  void singleView_isRefused() {
    QVERIFY_THROWS_EXCEPTION(InvalidInput,
                             (void)io::find_list_layout(
                                 1, [](int) { return Image<float>(4, 4); }, Progress(1)));
  }
};

}  // namespace episcope::in_list_layout_test

EPISCOPE_TEST(list_layout_test, ListLayoutTest)
#include "list_layout_test.moc"
