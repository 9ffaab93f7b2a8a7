// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/plenoptic/lens_grid.h"
#include "engine/capture/plenoptic/decode.h"
#include "engine/core/error.h"

#include "tests/test_main.h"

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

QString problem_of(const Image<float>& picture) {
  try {
    (void)fit_lens_grid(picture, Progress(1));
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
    QVERIFY(std::abs(grid.rotation_degrees - degrees) < 0.02);
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

  void pitchOfTheOptics_isChecked() {
    PlenopticPictures pictures;
    const Array array;
    const Image<float> light = picture_of({.noise = 0});
    pictures.raw.samples = Image<std::uint16_t>(array.height, array.width);
    for (std::size_t i = 0; i < light.size(); ++i) {
      pictures.raw.samples.data()[i] = static_cast<std::uint16_t>(20000 * light.data()[i]);
    }
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
    QVERIFY(problem_of(Image<float>(300, 400, 1, 0.5F)).contains("it is even"));
    QVERIFY(problem_of(Image<float>(20, 400)).contains("only 400×20 px"));
    Image<float> stripes(300, 400);
    for (int y = 0; y < 300; ++y) {
      for (int x = 0; x < 400; ++x) stripes.at(y, x) = static_cast<float>(std::sin(0.6 * x));
    }
    QVERIFY2(problem_of(stripes).contains("no array"), qPrintable(problem_of(stripes)));
  }

  // An even area decodes to even views, whatever the lenses shade and however pixels err.
  void evenArea_decodesToEvenViews() {
    const Array array;
    const Image<float> light = picture_of({.noise = 0});
    PlenopticPictures pictures;
    pictures.raw.samples = Image<std::uint16_t>(array.height, array.width);
    for (std::size_t i = 0; i < light.size(); ++i) {
      pictures.raw.samples.data()[i] = static_cast<std::uint16_t>(20000 * light.data()[i]);
    }
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

  void tooManyViews_areRefused() {
    const Array array;
    PlenopticPictures pictures;
    pictures.raw.samples = Image<std::uint16_t>(array.height, array.width);
    const Image<float> light = picture_of(array);
    for (std::size_t i = 0; i < light.size(); ++i) {
      pictures.raw.samples.data()[i] =
          static_cast<std::uint16_t>(std::max(0.0F, 20000 * light.data()[i]));
    }
    const LensGrid grid = find_lenses(pictures, Progress(2));
    try {
      (void)decode(pictures, grid, {.views = 21}, Progress(2));
      QFAIL("21 views were made");
    } catch (const InvalidInput& error) {
      QVERIFY(QString::fromUtf8(error.what()).contains("ask for fewer views"));
    }
    QCOMPARE(decode(pictures, grid, {.views = 3}, Progress(2)).warnings.size(), std::size_t{1});
  }
};

}  // namespace episcope::in_lens_grid_test

EPISCOPE_TEST(lens_grid_test, LensGridTest)
#include "lens_grid_test.moc"
