// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/image_header.h"
#include "engine/io/open.h"
#include "tests/engine/io/base/exr_file.h"
#include "tests/engine/io/models/sidecar_maps/layered_folder.h"
#include "tests/test_main.h"

#include <algorithm>
#include <fstream>

namespace episcope::in_shifted_window_test {

using namespace episcope::test;

namespace fs = std::filesystem;

namespace {

using Bytes = std::string;

Bytes number(std::size_t value, int bytes) {
  Bytes text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> 8 * i & 255);
  return text;
}

struct Tag {
  std::size_t id = 0;
  std::size_t type = 4;  ///< 4: whole numbers, 5: ratios.
  std::vector<std::size_t> values{};
};

/// A TIFF of gray pages, byte by byte, each with further tags.
void write_tiff_pages(const fs::path& path, const std::vector<ImageView<const std::uint8_t>>& pages,
                      const std::function<std::vector<Tag>(std::size_t page)>& further) {
  Bytes file("II*\0\0\0\0\0", 8);
  std::size_t link = 4;  // where the place of the next directory belongs
  for (std::size_t page = 0; page < pages.size(); ++page) {
    const auto& image = pages[page];
    const std::size_t samples = file.size();
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) file += static_cast<char>(image.at(y, x, 0));
    }
    if (file.size() % 2 != 0) file += '\0';
    const auto height = static_cast<std::size_t>(image.height);
    const auto width = static_cast<std::size_t>(image.width);
    std::vector<Tag> tags{{256, 4, {width}}, {257, 4, {height}}, {258, 4, {8}},
                          {259, 4, {1}},     {262, 4, {1}},      {273, 4, {samples}},
                          {277, 4, {1}},     {278, 4, {height}}, {279, 4, {width * height}}};
    std::ranges::copy(further(page), std::back_inserter(tags));
    std::ranges::sort(tags, {}, &Tag::id);
    const std::size_t directory = file.size();
    file.replace(link, 4, number(directory, 4));
    std::size_t values_at = directory + 2 + 12 * tags.size() + 4;
    Bytes entries = number(tags.size(), 2), values;
    for (const Tag& tag : tags) {
      const std::size_t count = tag.values.size() / (tag.type == 5 ? 2 : 1);
      entries += number(tag.id, 2) + number(tag.type, 2) + number(count, 4);
      if (tag.values.size() == 1) {
        entries += number(tag.values[0], 4);
        continue;
      }
      entries += number(values_at + values.size(), 4);
      for (const std::size_t value : tag.values) values += number(value, 4);
    }
    link = file.size() + entries.size();
    file += entries + number(0, 4) + values;
  }
  std::ofstream(path, std::ios::binary) << file;
}

/// Position in inches at 100 pixels an inch.
std::vector<Tag> placed_at(std::size_t x) {
  return {{282, 5, {100, 1}}, {283, 5, {100, 1}}, {286, 5, {x, 100}}, {287, 5, {0, 100}}};
}

}  // namespace

/// Views that were cut out at different places look as if the cameras had moved: no parallax tells
/// the difference, only what files state.
class ShiftedWindowTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<LayeredFolder> folder_;

  std::vector<ImageView<const std::uint8_t>> pages() const {
    std::vector<ImageView<const std::uint8_t>> all;
    for (int i = 0; i < 9; ++i) all.push_back(folder_->scene.views.view({i / 3, i % 3}));
    return all;
  }
  QString refusal_of(const std::string& name) const {
    try {
      (void)folder_->open(name);
    } catch (const IoError& error) {
      return error.what();
    }
    return {};
  }

 private slots:
  void init() { folder_ = std::make_unique<LayeredFolder>(); }

  void disparity_doesNotMoveWithTheWindow_data() {
    QTest::addColumn<int>("step");
    QTest::newRow("all at one place") << 0;
    QTest::newRow("each further to the right") << 2;
    QTest::newRow("each further to the left") << -2;
  }
  void disparity_doesNotMoveWithTheWindow() {
    QFETCH(int, step);
    constexpr int kMargin = 6;
    const int height = folder_->scene.views.height(), width = folder_->scene.views.width();
    const auto left_of = [&](ViewIndex view) { return kMargin + step * (view.u - 1); };
    folder_->for_views(LayeredFolder::named("{}_{}.exr"), [&](const fs::path& path,
                                                              ViewIndex view) {
      // A window of the same size, at another place of the page.
      const int left = left_of(view), stored = width - 2 * kMargin;
      Image<float> part(height, stored);
      const auto whole = folder_->scene.views.view(view);
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < stored; ++x) {
          part.at(y, x) = 0.1F + static_cast<float>(whole.at(y, left + x, 0)) / 255;
        }
      }
      write_exr(path, {{"Y", part.view()}}, DisplayWindow{-left, 0, width - 1 - left, height - 1});
    });

    const Scene scene = folder_->open();

    const auto& found = std::get<ViewStack<float>>(scene.light_field->samples());
    QCOMPARE(found.width(), width);
    for (int i = 0; i < 9; ++i) {
      const ViewIndex view = scene.light_field->grid().view_at(i);
      const auto whole = folder_->scene.views.view(view);
      const int left = left_of(view), x = width / 2;
      const float expected = 0.1F + static_cast<float>(whole.at(20, x, 0)) / 255;
      QVERIFY(std::abs(found.view(view).at(20, x, 0) - expected) < 1e-5F);
      QCOMPARE(scene.light_field->valid().view(view).at(20, left - 1), std::uint8_t{0});
      QCOMPARE(scene.light_field->valid().view(view).at(20, left), std::uint8_t{1});
    }
  }

  void pagesCutOutAtDifferentPlaces_areRefused_data() {
    QTest::addColumn<int>("step");
    QTest::newRow("all at one place") << 0;
    QTest::newRow("each at its own") << 3;
  }
  void pagesCutOutAtDifferentPlaces_areRefused() {
    QFETCH(int, step);
    write_tiff_pages(folder_->path("pages.tif"), pages(), [&](std::size_t page) {
      return placed_at(10 + page % 3 * static_cast<std::size_t>(step));
    });

    const QString refusal = refusal_of("pages.tif");

    const QString expected =
        step == 0 ? "" : "page 1 states that it lies at (13, 0) px, but the first at (10, 0)";
    QVERIFY2(step == 0 ? refusal.isEmpty() : refusal.contains(expected), qPrintable(refusal));
  }

  void pagesOfATurnedCamera_areUpright_data() {
    QTest::addColumn<bool>("is_one_file");
    QTest::newRow("pages of one file") << true;
    QTest::newRow("a file each") << false;
  }
  void pagesOfATurnedCamera_areUpright() {
    QFETCH(bool, is_one_file);
    const auto upside_down = [](std::size_t) { return std::vector<Tag>{{274, 4, {3}}}; };
    std::vector<Image<std::uint8_t>> turned;
    std::vector<ImageView<const std::uint8_t>> views;
    for (const auto& view : pages()) {
      Image<std::uint8_t>& image = turned.emplace_back(view.height, view.width);
      for (int y = 0; y < view.height; ++y) {
        for (int x = 0; x < view.width; ++x) {
          image.at(y, x) = view.at(view.height - 1 - y, view.width - 1 - x, 0);
        }
      }
    }
    for (const auto& image : turned) views.push_back(image.view());
    if (is_one_file) {
      write_tiff_pages(folder_->path("pages.tif"), views, upside_down);
    } else {
      folder_->for_views(LayeredFolder::named("{}_{}.tif"),
                         [&](const fs::path& path, ViewIndex view) {
                           const auto at = static_cast<std::size_t>(view.v * 3 + view.u);
                           write_tiff_pages(path, {views[at]}, upside_down);
                         });
    }

    const Scene scene = folder_->open(is_one_file ? "pages.tif" : "", {.grid = "3x3"});

    const auto& found = std::get<ViewStack<std::uint8_t>>(scene.light_field->samples());
    for (int i = 0; i < 9; ++i) {
      const ViewIndex view{i / 3, i % 3};
      QCOMPARE(found.view(view).at(7, 11, 0), folder_->scene.views.view(view).at(7, 11, 0));
      QCOMPARE(found.view(view).at(50, 60, 0), folder_->scene.views.view(view).at(50, 60, 0));
    }
  }

  void cropsOfRawPictures_areRefusedWhereTheyDiffer_data() {
    QTest::addColumn<int>("tag");
    QTest::addColumn<int>("step");
    QTest::newRow("one crop") << 50719 << 0;
    QTest::newRow("crops that differ") << 50719 << 2;
    QTest::newRow("areas that differ") << 50829 << 2;
  }
  void cropsOfRawPictures_areRefusedWhereTheyDiffer() {
    QFETCH(int, tag);
    QFETCH(int, step);
    folder_->for_views(LayeredFolder::named("{}_{}.tif"), [&](const fs::path& path,
                                                              ViewIndex view) {
      const auto left = static_cast<std::size_t>(8 + step * view.u);
      write_tiff_pages(path, {folder_->scene.views.view(view)}, [&](std::size_t) {
        const Tag crop = tag == 50719 ? Tag{50719, 4, {left, 4}} : Tag{50829, 4, {4, left, 64, 80}};
        return std::vector<Tag>{crop};
      });
    });

    const QString refusal = refusal_of("");

    QVERIFY2(step == 0 ? refusal.isEmpty() : refusal.contains("px of a page"), qPrintable(refusal));
    QCOMPARE(io::stated_place(folder_->path("1_1.tif")), (io::PagePlace{8, 4}));
  }
};

}  // namespace episcope::in_shifted_window_test

EPISCOPE_TEST(shifted_window_test, ShiftedWindowTest)
#include "shifted_window_test.moc"
