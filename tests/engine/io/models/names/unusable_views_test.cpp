// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/image_file.h"
#include "engine/io/formats/image_grid.h"
#include "tests/engine/io/models/sidecar_maps/layered_folder.h"
#include "tests/test_main.h"

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>

namespace episcope::in_unusable_views_test {

using namespace episcope::test;

namespace fs = std::filesystem;

/// Grids of which a file is damaged or does not fit the others: 5×5 views, the last of which, or
/// another one, is odd.
class UnusableViewsTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<LayeredFolder> folder_;

  bool has_views_from(const Scene& scene, ViewIndex first) const {
    const auto& views = std::get<ViewStack<std::uint8_t>>(scene.light_field->samples());
    for (int i = 0; i < views.grid().count(); ++i) {
      const auto found = views.view(views.grid().view_at(i));
      const auto wanted = folder_->scene.views.view(views.grid().view_at(i, first));
      if (!std::equal(wanted.data, wanted.data + wanted.size(), found.data)) return false;
    }
    return true;
  }
  void write(const std::string& form) const { folder_->write_views(LayeredFolder::named(form)); }

 private slots:
  void init() { folder_ = std::make_unique<LayeredFolder>(GridShape{5, 5}); }

  void damagedView_isAsIfMissing() {
    write("{}_{}.png");
    fs::resize_file(folder_->path("5_4.png"), 60);

    const Scene scene = folder_->open();

    QCOMPARE(scene.light_field->grid(), (GridShape{4, 5}));
    QVERIFY(has_views_from(scene, {0, 0}));
    QVERIFY(warns_of(scene, "5_4.png cannot be used: the image cannot be decoded"));
    QVERIFY(warns_of(scene, "Of a grid of 5×5 view 4,3 is missing (row,column from 0)"));
    QCOMPARE(count_unused(scene, "unusable views"), 1);
  }

  void viewOfAnotherSize_isLeftOut_data() {
    QTest::addColumn<QString>("name");
    QTest::newRow("a corner") << "5_5.png";
    QTest::newRow("the center, which others are compared with") << "3_3.png";
  }
  void viewOfAnotherSize_isLeftOut() {
    QFETCH(QString, name);
    write("{}_{}.png");
    io::write_png(folder_->path(name.toStdString()), Image<std::uint8_t>(50, 50, 3).view());

    const Scene scene = folder_->open();

    QVERIFY(warns_of(scene, name.toStdString() + " cannot be used: this view has 50×50 px"));
    QCOMPARE(scene.light_field->width(), folder_->scene.views.width());
    QCOMPARE(io::probe_image_grid(folder_->path(), {}).grid, scene.light_field->grid());
    QVERIFY(scene.light_field->grid().count() >= 10);
  }

  void listWithADamagedView_isArrangedByTheOthers() {
    folder_->write_views(
        [](int row, int column) { return fmt::format("{:02}.png", 5 * row + column - 6); });
    fs::resize_file(folder_->path("24.png"), 60);

    const Scene scene = folder_->open();

    QCOMPARE(scene.light_field->grid(), (GridShape{4, 5}));
    QVERIFY(has_views_from(scene, {0, 0}));
  }

  void truthOfAllViews_keepsTheirPlaces() {
    write("{}_{}.png");
    folder_->write_npy(LayeredFolder::named("disparity_{}_{}.npy"), folder_->scene.disparity);
    fs::resize_file(folder_->path("1_1.png"), 0);

    const Scene scene = folder_->open();

    QCOMPARE(scene.light_field->grid(), (GridShape{4, 5}));
    const ViewStack<float>& found = scene.truth->field.disparity;
    const auto first = found.view({0, 0});
    const auto wanted = folder_->scene.disparity.view({1, 0});
    QVERIFY(std::equal(wanted.data, wanted.data + wanted.size(), first.data));
  }

  void greyCentreAmongColours_becomesColour() {
    write("{}_{}.png");
    const auto center = folder_->scene.views.view({2, 2});
    Image<std::uint8_t> grey(center.height, center.width);
    for (int y = 0; y < center.height; ++y) {
      for (int x = 0; x < center.width; ++x) grey.at(y, x) = center.at(y, x, 0);
    }
    io::write_png(folder_->path("3_3.png"), grey.view());

    const Scene scene = folder_->open();

    QCOMPARE(scene.light_field->grid(), (GridShape{5, 5}));
    QCOMPARE(scene.light_field->channels(), folder_->scene.views.channels());
  }

  // Libraries decode these, grey from where the file ends.
  void jpegThatIsCutOff_isDamaged() {
    cv::Mat picture(64, 64, CV_8UC3);
    cv::randu(picture, 0, 255);
    const fs::path path = folder_->path("cut.jpg");
    cv::imwrite(path.string(), picture);
    QCOMPARE(std::get<Image<std::uint8_t>>(io::decode_image(path)).width(), 64);

    fs::resize_file(path, fs::file_size(path) * 2 / 3);

    QVERIFY_THROWS_EXCEPTION(IoError, (void)io::decode_image(path));
  }
};

}  // namespace episcope::in_unusable_views_test

EPISCOPE_TEST(unusable_views_test, UnusableViewsTest)
#include "unusable_views_test.moc"
