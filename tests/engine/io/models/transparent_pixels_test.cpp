// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/image_file.h"
#include "engine/io/open.h"
#include "tests/engine/io/base/exr_file.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <QTemporaryDir>
#include <opencv2/imgcodecs.hpp>

#include <functional>

namespace episcope::in_transparent_pixels_test {

using namespace episcope::test;

namespace fs = std::filesystem;

namespace {

constexpr int kTransparentColumns = 5;

/// A view in BGRA, its first columns transparent.
cv::Mat with_alpha(const Scene& scene, ViewIndex view, int depth) {
  const auto image = bytes_of(scene).view(view);
  const cv::Mat rgb(image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.data));
  cv::Mat bgra(rgb.size(), CV_8UC4, cv::Scalar::all(255));
  cv::mixChannels(rgb, bgra, {0, 2, 1, 1, 2, 0});
  bgra(cv::Rect(0, 0, kTransparentColumns, bgra.rows)) &= cv::Scalar(255, 255, 255, 0);
  cv::Mat out;
  bgra.convertTo(out, depth, depth == CV_16U ? 257 : 1);
  return out;
}

std::size_t invalid_pixels(const Scene& scene) {
  const ViewStack<std::uint8_t>& valid = scene.light_field->valid();
  return static_cast<std::size_t>(
      std::count(valid.data(), valid.data() + valid.size(), std::uint8_t{0}));
}

bool are_first_columns_invalid(const Scene& scene, int columns) {
  const LightField& field = *scene.light_field;
  if (field.valid().empty()) return false;
  for (int i = 0; i < field.grid().count(); ++i) {
    const auto valid = field.valid().view(field.grid().view_at(i));
    for (int y = 0; y < field.height(); ++y) {
      for (int x = 0; x < field.width(); ++x) {
        if ((valid.at(y, x) == 0) != (x < columns)) return false;
      }
    }
  }
  return true;
}

}  // namespace

/// Alpha of 0, and what lies outside of stored pixels, is no content of a light field.
class TransparentPixelsTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<QTemporaryDir> folder_;
  const Scene scene_ = plane_scene({.grid = {3, 3}});

  fs::path path(const std::string& name = "") const {
    return fs::path(folder_->path().toStdString()) / name;
  }
  void for_views(const std::function<void(const std::string&, ViewIndex)>& write) const {
    for (int i = 0; i < 9; ++i) {
      const ViewIndex view{i / 3, i % 3};
      write(std::to_string(view.v) + "_" + std::to_string(view.u), view);
    }
  }
  Scene open(const std::string& name = "", const io::OpenOptions& options = {}) const {
    return io::open_scene(path(name), options, Progress(2));
  }

 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void viewsWithAlpha_haveInvalidPixels_data() {
    QTest::addColumn<QString>("suffix");
    QTest::addColumn<int>("depth");
    QTest::newRow("PNG") << ".png" << CV_8U;
    QTest::newRow("PNG of 16 bit") << ".png" << CV_16U;
    QTest::newRow("TIFF") << ".tif" << CV_8U;
    QTest::newRow("TIFF of 16 bit") << ".tif" << CV_16U;
    QTest::newRow("WebP") << ".webp" << CV_8U;
  }
  void viewsWithAlpha_haveInvalidPixels() {
    QFETCH(QString, suffix);
    QFETCH(int, depth);
    for_views([&](const std::string& name, ViewIndex view) {
      const std::string file = path(name + suffix.toStdString()).string();
      QVERIFY(cv::imwrite(file, with_alpha(scene_, view, depth),
                          {cv::IMWRITE_WEBP_QUALITY, 101}));  // above 100: without loss
    });

    const Scene read = open();

    QCOMPARE(read.light_field->channels(), 3);
    QVERIFY2(are_first_columns_invalid(read, kTransparentColumns),
             QByteArray::number(qulonglong(invalid_pixels(read))));
  }

  void opaqueViews_areValid() {
    for_views([&](const std::string& name, ViewIndex view) {
      cv::Mat opaque = with_alpha(scene_, view, CV_8U) | cv::Scalar(0, 0, 0, 1);
      cv::imwrite(path(name + ".png").string(), opaque);
    });

    QVERIFY(open().light_field->valid().empty());
  }

  // Programs that know no alpha write such files.
  void alphaThatIsZeroEverywhere_meansNothing() {
    for_views([&](const std::string& name, ViewIndex view) {
      cv::Mat clear = with_alpha(scene_, view, CV_8U) & cv::Scalar(255, 255, 255, 0);
      cv::imwrite(path(name + ".png").string(), clear);
    });

    QVERIFY(open().light_field->valid().empty());
  }

  void mosaicWithAlpha_hasInvalidPixels() {
    cv::Mat rows;
    for (int v = 0; v < 3; ++v) {
      cv::Mat row;
      cv::hconcat(std::vector{with_alpha(scene_, {v, 0}, CV_8U), with_alpha(scene_, {v, 1}, CV_8U),
                              with_alpha(scene_, {v, 2}, CV_8U)},
                  row);
      rows.push_back(row);
    }
    cv::imwrite(path("views.png").string(), rows);

    const Scene read = open("views.png", {.grid = "3x3", .mosaic = io::Mosaic::Views});

    QVERIFY(are_first_columns_invalid(read, kTransparentColumns));
  }

  void pagesWithAlpha_haveInvalidPixels() {
    std::vector<cv::Mat> pages;
    for (int i = 0; i < 9; ++i) pages.push_back(with_alpha(scene_, {i / 3, i % 3}, CV_8U));
    QVERIFY(cv::imwritemulti(path("pages.tif").string(), pages));

    const Scene read = open("pages.tif", {.grid = "3x3"});

    QVERIFY(are_first_columns_invalid(read, kTransparentColumns));
  }

  void exrAlpha_isReadInLayersToo_data() {
    QTest::addColumn<QString>("prefix");
    QTest::newRow("plain") << "";
    QTest::newRow("layer") << "View Layer.Combined.";
  }
  void exrAlpha_isReadInLayersToo() {
    QFETCH(QString, prefix);
    for_views([&](const std::string& name, ViewIndex view) {
      const auto bytes = bytes_of(scene_).view(view);
      std::vector<Image<float>> planes(4, Image<float>(bytes.height, bytes.width));
      for (int y = 0; y < bytes.height; ++y) {
        for (int x = 0; x < bytes.width; ++x) {
          for (int c = 0; c < 3; ++c) {
            planes[static_cast<std::size_t>(c)].at(y, x) =
                static_cast<float>(bytes.at(y, x, c)) / 255;
          }
          planes[3].at(y, x) = x < kTransparentColumns ? 0.0F : 1.0F;
        }
      }
      ExrChannels channels;
      for (int c = 0; c < 4; ++c) {
        channels.emplace(prefix.toStdString() + "RGBA"[c],
                         planes[static_cast<std::size_t>(c)].view());
      }
      channels.emplace("View Layer.AO.V", planes[3].view());
      write_exr(path(name + ".exr"), channels);
    });

    const Scene read = open();

    QCOMPARE(read.light_field->channels(), 3);
    QVERIFY2(are_first_columns_invalid(read, kTransparentColumns),
             QByteArray::number(qulonglong(invalid_pixels(read))));
  }

  void placesWithoutStoredPixels_areInvalid() {
    constexpr int kMargin = 3;
    for_views([&](const std::string& name, ViewIndex view) {
      const auto bytes = bytes_of(scene_).view(view);
      Image<float> grey(bytes.height, bytes.width);
      for (int y = 0; y < bytes.height; ++y) {
        for (int x = 0; x < bytes.width; ++x) {
          grey.at(y, x) = 0.1F + static_cast<float>(bytes.at(y, x, 1)) / 255;
        }
      }
      write_exr(path(name + ".exr"), {{"Y", grey.view()}},
                DisplayWindow{-kMargin, 0, bytes.width - 1, bytes.height - 1});
    });

    const Scene read = open();

    QCOMPARE(read.light_field->width(), 80 + kMargin);
    QVERIFY2(are_first_columns_invalid(read, kMargin),
             QByteArray::number(qulonglong(invalid_pixels(read))));
  }
};

}  // namespace episcope::in_transparent_pixels_test

EPISCOPE_TEST(transparent_pixels_test, TransparentPixelsTest)
#include "transparent_pixels_test.moc"
