// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/stereo_costs.h"

#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>

namespace episcope::in_guided_filter_test {

using namespace episcope::test;

namespace {

constexpr int kHeight = 23;
constexpr int kWidth = 37;
constexpr double kRegularization = 1e-3;

float hashed(int y, int x, int c) {
  const double number = std::sin(12.9898 * x + 78.233 * y + 9.151 * c) * 43758.5453;
  return static_cast<float>(number - std::floor(number));
}

LightField guide(int channels) {
  return make_light_field({1, 1}, kHeight, kWidth, channels,
                          [](ViewIndex, int y, int x, int c) { return hashed(y, x, c); });
}

Volume<float> layers() {
  Volume<float> volume(kHeight, 2, kWidth);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      volume.view().at(y, 0, x) = hashed(y, x, 7);
      volume.view().at(y, 1, x) = 0.1F * static_cast<float>((x + y) % 4);
    }
  }
  return volume;
}

Volume<float> filtered(const GuideImage& image, Volume<float> values) {
  GuidedFilter(image).apply(0, values.view(), Progress());
  return values;
}

struct Window {
  int y0, y1, x0, x1;
  Window(int y, int x, int radius)
      : y0(std::max(0, y - radius)),
        y1(std::min(kHeight, y + radius + 1)),
        x0(std::max(0, x - radius)),
        x1(std::min(kWidth, x + radius + 1)) {}
  template <class Value>
  [[nodiscard]] double mean(const Value& value) const {
    double sum = 0;
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) sum += value(y, x);
    }
    return sum / ((y1 - y0) * (x1 - x0));
  }
};

// He, Sun and Tang's definition for one channel, window by window.
double defined(const LightField& lf, VolumeView<const float> values, int layer, int radius, int y,
               int x) {
  const Image<float> image = lf.view_as_float({0, 0});
  const auto g = [&](int j, int i) { return image.at(j, i); };
  const auto p = [&](int j, int i) { return values.at(j, layer, i); };
  const auto model_at = [&](int j, int i) {
    const Window window(j, i, radius);
    const double mean_g = window.mean(g);
    const double mean_p = window.mean(p);
    const double product = window.mean([&](int b, int a) { return double{g(b, a)} * p(b, a); });
    const double square = window.mean([&](int b, int a) { return double{g(b, a)} * g(b, a); });
    const double a = (product - mean_g * mean_p) / (square - mean_g * mean_g + kRegularization);
    return std::pair(a, mean_p - a * mean_g);
  };
  const Window window(y, x, radius);
  const double a = window.mean([&](int j, int i) { return model_at(j, i).first; });
  const double b = window.mean([&](int j, int i) { return model_at(j, i).second; });
  return a * g(y, x) + b;
}

}  // namespace

class GuidedFilterTest : public QObject {
  Q_OBJECT

 private slots:
  void greyGuide_givesWhatIsDefined_data();
  void greyGuide_givesWhatIsDefined();
  void constantLayer_staysConstant();
  void layerLikeTheGuide_isKept();
  void band_isThatOfTheWhole();
};

void GuidedFilterTest::greyGuide_givesWhatIsDefined_data() {
  QTest::addColumn<int>("radius");
  for (const int radius : {1, 2, 8}) QTest::addRow("%d", radius) << radius;
}

void GuidedFilterTest::greyGuide_givesWhatIsDefined() {
  QFETCH(int, radius);
  const LightField lf = guide(1);
  const Volume<float> before = layers();
  const Volume<float> after =
      filtered(GuideImage(lf, {0, 0}, radius, kRegularization, Progress()), layers());
  for (const PixelIndex at : {PixelIndex{0, 0}, {11, 20}, {22, 36}, {3, 35}, {20, 1}}) {
    for (const int layer : {0, 1}) {
      const double expected = defined(lf, before.view(), layer, radius, at.y, at.x);
      QVERIFY(std::fabs(after.view().at(at.y, layer, at.x) - expected) < 1e-5);
    }
  }
}

void GuidedFilterTest::constantLayer_staysConstant() {
  Volume<float> values = layers();
  std::fill_n(values.view().data, values.view().size(), 0.3F);
  const Volume<float> after =
      filtered(GuideImage(guide(3), {0, 0}, 2, kRegularization, Progress()), std::move(values));
  for (std::size_t i = 0; i < after.view().size(); ++i) {
    QVERIFY(std::fabs(after.view().data[i] - 0.3F) < 1e-5F);
  }
}

// What is affine in the colors of the guide has edges where the guide has them: it passes, but for
// the regularization.
void GuidedFilterTest::layerLikeTheGuide_isKept() {
  Volume<float> values = layers();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      values.view().at(y, 0, x) = 0.2F + 0.5F * hashed(y, x, 0) - 0.3F * hashed(y, x, 2);
    }
  }
  const GuideImage image(guide(3), {0, 0}, 2, 1e-7, Progress());
  const Volume<float> after = filtered(image, std::move(values));
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double expected = 0.2 + 0.5 * hashed(y, x, 0) - 0.3 * hashed(y, x, 2);
      QVERIFY(std::fabs(after.view().at(y, 0, x) - expected) < 1e-3);
    }
  }
}

void GuidedFilterTest::band_isThatOfTheWhole() {
  const GuideImage image(guide(3), {0, 0}, 2, kRegularization, Progress());
  const Volume<float> whole = filtered(image, layers());
  Volume<float> cut = layers();
  const VolumeView<float> band{cut.view().row(5, 0), 12, 2, kWidth};
  GuidedFilter(image).apply(5, band, Progress());
  for (int y = 4; y < 8; ++y) {
    for (int x = 0; x < kWidth; ++x) QCOMPARE(band.at(y, 0, x), whole.view().at(5 + y, 0, x));
  }
}

}  // namespace episcope::in_guided_filter_test

EPISCOPE_TEST(guided_filter_test, GuidedFilterTest)
#include "guided_filter_test.moc"
