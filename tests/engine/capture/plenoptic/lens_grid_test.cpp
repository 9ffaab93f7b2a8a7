// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/plenoptic/lens_grid.h"
#include "engine/capture/plenoptic/decode.h"
#include "engine/core/error.h"

#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace episcope::in_lens_grid_test {

using namespace capture;

namespace {

/// Lenses as bright discs with a soft edge, at exact places.
struct Array {
  bool is_hexagonal = true;
  double pitch = 10.1;
  double degrees = 0.4;
  double bend = 0;  ///< px at the corner, radial.
  double noise = 0.01;
  int width = 420;
  int height = 360;

  [[nodiscard]] PlanePoint center(int i, int j) const {
    const double x = (i + (is_hexagonal ? j / 2.0 : 0)) * pitch;
    const double y = j * pitch * (is_hexagonal ? std::sqrt(0.75) : 1);
    const double t = degrees * std::numbers::pi / 180;
    const double rx = x * std::cos(t) - y * std::sin(t), ry = x * std::sin(t) + y * std::cos(t);
    const double corner = std::hypot(width, height) / 2;
    const double r = std::hypot(rx, ry) / corner;
    const double factor = 1 + bend / corner * r * r;
    return {width / 2.0 + 1.3 + rx * factor, height / 2.0 - 2.2 + ry * factor};
  }
};

Image<float> picture_of(const Array& array) {
  Image<float> light(array.height, array.width);
  const int most = static_cast<int>(2 * (array.width + array.height) / array.pitch);
  const double radius = 0.47 * array.pitch;
  for (int j = -most; j <= most; ++j) {
    for (int i = -most; i <= most; ++i) {
      const PlanePoint at = array.center(i, j);
      for (int y = std::max(0, int(at.y - array.pitch));
           y < std::min<double>(array.height, at.y + array.pitch); ++y) {
        for (int x = std::max(0, int(at.x - array.pitch));
             x < std::min<double>(array.width, at.x + array.pitch); ++x) {
          const double r = std::hypot(x - at.x, y - at.y);
          light.at(y, x) += static_cast<float>(0.8 * std::clamp(radius - r + 0.5, 0.0, 1.0));
        }
      }
    }
  }
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, array.noise);
  for (float& value : light) value += static_cast<float>(0.05 + noise(random));
  return light;
}

RawPicture raw_of(const Image<float>& light) {
  RawPicture raw;
  raw.samples = Image<std::uint16_t>(light.height(), light.width());
  std::ranges::transform(light, raw.samples.begin(), [](float value) {
    return static_cast<std::uint16_t>(std::max(0.0F, 20000 * value));
  });
  return raw;
}

/// Root mean square distance of fitted centers from the nearest true ones.
double rms_error(const LensGrid& grid, const Array& array) {
  const LensBlock block = lens_block(grid, array.height, array.width, array.pitch);
  double sum = 0;
  int count = 0;
  for (int j = block.first_row; j < block.first_row + block.rows; ++j) {
    for (int k = 0; k < static_cast<int>(block.columns); ++k) {
      const PlanePoint at = grid.center(std::ceil(lens_at(grid, block.first_column, j)) + k, j);
      double best = 1e9;
      const double t = -array.degrees * std::numbers::pi / 180;
      const double dx = at.x - array.center(0, 0).x, dy = at.y - array.center(0, 0).y;
      const double row = array.pitch * (array.is_hexagonal ? std::sqrt(0.75) : 1);
      const int near_j = static_cast<int>(std::lround((dx * std::sin(t) + dy * std::cos(t)) / row));
      const double along = (dx * std::cos(t) - dy * std::sin(t)) / array.pitch;
      for (int dj = -1; dj <= 1; ++dj) {
        const int j2 = near_j + dj;
        const int i2 = static_cast<int>(std::lround(along - (array.is_hexagonal ? j2 / 2.0 : 0)));
        for (int i = i2 - 1; i <= i2 + 1; ++i) {
          const PlanePoint truth = array.center(i, j2);
          best = std::min(best, std::hypot(truth.x - at.x, truth.y - at.y));
        }
      }
      sum += best * best;
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

QString problem_of(const Image<float>& picture, LensLight light = LensLight::Even) {
  try {
    (void)fit_lens_grid(picture, Progress(2), light);
  } catch (const InvalidInput& error) {
    return QString::fromUtf8(error.what());
  }
  return "an array was found";
}

}  // namespace

class LensGridTest : public QObject {
  Q_OBJECT

 private slots:
  void centers_areFoundTo005Px_data() {
    QTest::addColumn<bool>("is_hexagonal");
    QTest::addColumn<double>("pitch");
    QTest::addColumn<double>("degrees");
    QTest::addColumn<double>("bend");
    QTest::addColumn<double>("noise");
    QTest::newRow("hexagonal") << true << 10.12 << 0.4 << 0.0 << 0.01;
    QTest::newRow("turned the other way") << true << 9.91 << -0.5 << 0.0 << 0.02;
    QTest::newRow("Illum") << true << 14.31 << 0.1 << 0.0 << 0.02;
    QTest::newRow("bent") << true << 10.02 << 0.2 << 1.5 << 0.01;
    QTest::newRow("square") << false << 12.37 << 0.3 << 0.0 << 0.02;
    QTest::newRow("large") << false << 30.2 << -0.2 << 0.0 << 0.02;
    QTest::newRow("columns") << true << 10.12 << 30.2 << 0.0 << 0.01;
    QTest::newRow("small") << true << 5.3 << 0.5 << 0.0 << 0.01;
  }
  void centers_areFoundTo005Px() {
    QFETCH(bool, is_hexagonal);
    QFETCH(double, pitch);
    QFETCH(double, degrees);
    QFETCH(double, bend);
    QFETCH(double, noise);
    const Array array{is_hexagonal, pitch, degrees, bend, noise};

    const LensGrid grid = fit_lens_grid(picture_of(array), Progress(2));

    QCOMPARE(grid.lattice, is_hexagonal ? LensLattice::Hexagonal : LensLattice::Square);
    const double error = rms_error(grid, array);
    QVERIFY2(error <= 0.05, qPrintable(QString("off by %1 px rms").arg(error)));
    QCOMPARE(grid.has_columns, degrees > 15);
    QVERIFY(std::abs(grid.rotation_degrees - (grid.has_columns ? degrees - 30 : degrees)) < 0.02);
  }

  // Texture disturbs single lenses; many around each tell where it is.
  void lensesOfAScene_areFoundByTheirShading() {
    const Array array{.pitch = 10.02, .degrees = 0.1, .width = 900, .height = 700};
    Image<float> picture = picture_of(array);
    for (int y = 0; y < array.height; ++y) {
      for (int x = 0; x < array.width; ++x) {
        const bool is_bright = (x / 37 + y / 29) % 2 == 0;
        picture.at(y, x) *= static_cast<float>(is_bright ? 1 : 0.2) *
                            static_cast<float>(1 + 0.3 * std::sin(0.21 * x + 0.13 * y));
      }
    }

    const LensGrid grid = fit_lens_grid(picture, Progress(2), LensLight::Scene);

    QCOMPARE(grid.lattice, LensLattice::Hexagonal);
    const double error = rms_error(grid, array);
    QVERIFY2(error <= 0.2, qPrintable(QString("off by %1 px rms").arg(error)));
  }

  // Windows around lenses would overlap so much that any texture fits.
  void fewCoarseLensesOfAScene_areRefused() {
    const Array array{.pitch = 19.2, .width = 320, .height = 256};
    QCOMPARE(problem_of(picture_of(array)), QString("an array was found"));
    const QString problem = problem_of(picture_of(array), LensLight::Scene);
    QVERIFY2(problem.contains("too coarse to be told from texture"), qPrintable(problem));
    // As large as those of the laboratory raw picture, which shows 27×20 of them.
    const Array large{
        .is_hexagonal = false, .pitch = 48.2, .degrees = 0.13, .width = 1280, .height = 960};
    QCOMPARE(problem_of(picture_of(large), LensLight::Scene), QString("an array was found"));
  }

  void pitchOfTheOptics_isChecked() {
    PlenopticPictures pictures{raw_of(picture_of({.noise = 0})), {}, {}};
    pictures.white = pictures.raw;
    pictures.raw.facts.pixel_pitch_um = 1.4;
    for (const double lens_pitch_um : {14.0, 20.0}) {
      pictures.raw.facts.lens_pitch_um = lens_pitch_um;
      const Decoded decoded = decode(pictures, find_lenses(pictures, Progress(2)), {}, Progress(2));
      QCOMPARE(decoded.warnings.size(), std::size_t(lens_pitch_um == 20 ? 1 : 0));
    }
  }

  void threads_changeNothing() {
    const Image<float> picture = picture_of({});
    const LensGrid one = fit_lens_grid(picture, Progress(1)),
                   two = fit_lens_grid(picture, Progress(2));
    QCOMPARE(one.center(7, 5).x, two.center(7, 5).x);
  }

  void pictureWithoutLenses_isRefused() {
    Image<float> noise(300, 400);
    std::mt19937 random(3);
    for (float& value : noise) value = static_cast<float>(random() % 1000) / 1000;
    QVERIFY(problem_of(noise).contains("no array of microlenses was found"));
    QVERIFY(problem_of(noise, LensLight::Scene).contains("no array of microlenses was found"));
    QVERIFY(problem_of(Image<float>(300, 400, 1, 0.5F)).contains("it is even"));
    QVERIFY(problem_of(Image<float>(20, 400)).contains("only 400×20 px"));
    Image<float> stripes(300, 400);
    for (int y = 0; y < 300; ++y) {
      for (int x = 0; x < 400; ++x) stripes.at(y, x) = static_cast<float>(std::sin(0.6 * x));
    }
    QVERIFY2(problem_of(stripes).contains("no array"), qPrintable(problem_of(stripes)));
  }

  void whitePictureOfAnotherCamera_isRefused_data() {
    QTest::addColumn<double>("pitch");
    QTest::addColumn<double>("degrees");
    QTest::addColumn<bool>("is_hexagonal");
    QTest::addColumn<QString>("told");
    QTest::newRow("the same") << 10.1 << 0.4 << true << "";
    QTest::newRow("pitch") << 10.2 << 0.4 << true << "those of the raw picture raw are hexagonal";
    QTest::newRow("rotation") << 10.1 << -0.3 << true << "of another camera or zoom";
    QTest::newRow("lattice") << 10.1 << 0.4 << false << "its lenses are square";
  }
  void whitePictureOfAnotherCamera_isRefused() {
    QFETCH(double, pitch);
    QFETCH(double, degrees);
    QFETCH(bool, is_hexagonal);
    QFETCH(QString, told);
    PlenopticPictures pictures{raw_of(picture_of({.width = 700, .height = 600})), {}, {}};
    pictures.white = raw_of(picture_of({is_hexagonal, pitch, degrees, 0, 0.01, 700, 600}));
    pictures.raw.name = "raw";
    QString found;
    try {
      const LensGrid grid = find_lenses(pictures, Progress(2));
      QVERIFY(decode(pictures, grid, {}, Progress(2)).warnings.empty());
    } catch (const InvalidInput& error) {
      found = QString::fromUtf8(error.what());
    }
    QVERIFY2(told.isEmpty() ? found.isEmpty() : found.contains(told), qPrintable(found));
  }

  // An even area decodes to even views, whatever the lenses shade and however pixels err.
  void evenArea_decodesToEvenViews() {
    PlenopticPictures pictures{raw_of(picture_of({.noise = 0})), {}, {}};
    pictures.white = pictures.raw;
    for (auto& sample : pictures.raw.samples) sample = static_cast<std::uint16_t>(sample * 2);
    pictures.raw.samples.at(180, 210) = 65535;  // hot
    const LensGrid grid = find_lenses(pictures, Progress(2));
    const Decoded decoded = decode(pictures, grid, {}, Progress(2));
    QCOMPARE(decoded.light_field->grid(), (GridShape{9, 9}));
    QVERIFY(decoded.hot_pixels >= 1);
    const LightField& field = *decoded.light_field;
    // The white picture's centers, 17000 of 65535, are 1; so is what the raw picture has there.
    const double expected = 2 * 17000 / 65535.0 / (17000 / 17000.0);
    for (int k = 0; k < field.grid().count(); ++k) {
      const ViewIndex view = field.grid().view_at(k);
      const Image<float> samples = field.view_as_float(view);
      for (int y = 2; y < samples.height() - 2; ++y) {
        for (int x = 2; x < samples.width() - 2; ++x) {
          if (!field.is_valid(view, y, x)) continue;
          QVERIFY2(std::abs(samples.at(y, x) / expected - 1) < 0.02,
                   qPrintable(QString("view %1,%2 at %3,%4: %5")
                                  .arg(view.v)
                                  .arg(view.u)
                                  .arg(y)
                                  .arg(x)
                                  .arg(samples.at(y, x))));
        }
      }
    }
  }

  // Views of an array with upright columns stand upright, and are where they look from.
  void columns_decodeToUprightViews() {
    const Array array{.degrees = 30.2, .noise = 0};
    PlenopticPictures pictures{raw_of(picture_of(array)), {}, {}};
    pictures.white = pictures.raw;
    const LensGrid grid = find_lenses(pictures, Progress(2));
    Image<std::uint16_t>& samples = pictures.raw.samples;
    for (int y = 0; y < array.height; ++y) {
      for (int x = 0; x < array.width; ++x) samples.at(y, x) += static_cast<std::uint16_t>(20 * x);
    }
    const Decoded decoded = decode(pictures, grid, {}, Progress(2));
    const LightField& field = *decoded.light_field;
    const Image<float> center = field.view_as_float(field.center());
    const int width = center.width(), height = center.height(), middle = field.center().u;
    QVERIFY2(width > height, qPrintable(QString("%1×%2").arg(width).arg(height)));
    QVERIFY(center.at(height / 2, width - 4) > center.at(height / 2, 3) + 0.1F);
    QVERIFY(std::abs(center.at(height - 4, width / 2) - center.at(3, width / 2)) < 0.02F);
    const auto at = [&](int v, int u) {
      return field.view_as_float({v, u}).at(height / 2, width / 2);
    };
    QVERIFY(at(middle, middle + 3) > at(middle, middle - 3) + 1e-3F);
    QVERIFY(std::abs(at(middle + 3, middle) - at(middle - 3, middle)) < 1e-3F);
  }

  void colorsOfABareSensor_areMadeNeutral() {
    PlenopticPictures pictures{raw_of(picture_of({.noise = 0})), {}, {}};
    pictures.raw.mosaic = Mosaic::Rggb;
    for (int y = 0; y < pictures.raw.samples.height(); y += 2) {
      for (int x = 0; x < pictures.raw.samples.width(); x += 2) {
        pictures.raw.samples.at(y, x) /= 2;  // red
      }
    }
    pictures.white = pictures.raw;
    const LensGrid grid = find_lenses(pictures, Progress(2));
    const Decoded decoded = decode(pictures, grid, {}, Progress(2));
    const LightField& field = *decoded.light_field;
    const Image<float> view = field.view_as_float(field.center());
    const float red = view.at(10, 10, 0), green = view.at(10, 10, 1);
    QVERIFY2(std::abs(red / green - 1) < 0.02, qPrintable(QString::number(red / green)));
    const QString told = QString::fromStdString(decoded.warnings.front());
    QVERIFY2(told.contains("red times 2.0"), qPrintable(told));
    pictures.raw.colors.is_balanced = true;
    QVERIFY(decode(pictures, grid, {}, Progress(2)).warnings.empty());
  }

  void badlyExposedWhitePicture_isTold() {
    PlenopticPictures pictures{raw_of(picture_of({})), raw_of(picture_of({})), {}};
    const LensGrid grid = find_lenses(pictures, Progress(2));
    const auto told = [&] {
      const auto warnings = decode(pictures, grid, {}, Progress(2)).warnings;
      return warnings.empty() ? QString() : QString::fromStdString(warnings.front());
    };
    QCOMPARE(told(), QString());
    for (auto& sample : pictures.white->samples) sample /= 10;
    QVERIFY2(told().contains("has only 2.6 % of the light"), qPrintable(told()));
    for (auto& sample : pictures.white->samples) sample = std::min(sample * 80, 65535);
    QVERIFY2(told().contains("of the white picture is saturated"), qPrintable(told()));
  }

  // Texture of a scene is no hot pixel, and without a white picture looks like one.
  void withoutWhitePicture_noPixelIsHot() {
    PlenopticPictures pictures{raw_of(picture_of({.noise = 0.1})), {}, {}};
    const LensGrid grid = find_lenses(pictures, Progress(2));
    QCOMPARE(decode(pictures, grid, {}, Progress(2)).hot_pixels, std::size_t(0));
  }

  void tooManyViews_areRefused() {
    const PlenopticPictures pictures{raw_of(picture_of({})), {}, {}};
    const LensGrid grid = find_lenses(pictures, Progress(2));
    for (const DecodeOptions& options : {DecodeOptions{.views = 21}, DecodeOptions{.step_px = 7},
                                         DecodeOptions{.views = 1, .step_px = 100}}) {
      try {
        (void)decode(pictures, grid, options, Progress(2));
        QFAIL("they were made");
      } catch (const InvalidInput& error) {
        QVERIFY(QString::fromUtf8(error.what()).contains("ask for fewer views"));
      }
    }
    QVERIFY_THROWS_EXCEPTION(InvalidInput,
                             decode(pictures, grid, {.step_px = std::nan("")}, Progress(2)));
    QCOMPARE(decode(pictures, grid, {.views = 3}, Progress(2)).warnings.size(), std::size_t{1});
  }
};

}  // namespace episcope::in_lens_grid_test

EPISCOPE_TEST(lens_grid_test, LensGridTest)
#include "lens_grid_test.moc"
