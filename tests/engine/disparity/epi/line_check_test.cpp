// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/line_check.h"

#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace episcope::in_line_check_test {

using namespace episcope::test;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Disparities about a mean, and confidences, both uneven.
Estimate uneven_estimate(const LightField& lf, double mean = 0.37, double spread = 0.4) {
  Estimate estimate;
  estimate.field.disparity = ViewStack<float>(lf.grid(), lf.height(), lf.width());
  estimate.confidence = ViewStack<float>(lf.grid(), lf.height(), lf.width());
  std::mt19937 random(4);
  std::normal_distribution<double> noise;
  std::uniform_real_distribution<float> uniform(0.1F, 1);
  for (std::size_t i = 0; i < estimate.confidence.size(); ++i) {
    estimate.field.disparity.data()[i] = static_cast<float>(mean + spread * noise(random));
    estimate.confidence.data()[i] = uniform(random);
  }
  return estimate;
}

// The formulas of the header, literally, pixel by pixel.
class Definition {
 public:
  Definition(const LightField& lf, const ViewStack<float>& disparity)
      : samples_(float_samples(lf)), disparity_(disparity) {
    std::vector<double> known;
    for (int y = 0; y < lf.height(); ++y) {
      for (int x = 0; x < lf.width(); ++x) {
        const double e = line_error(lf.center(), y, x);
        if (std::isfinite(e)) known.push_back(e);
      }
    }
    std::sort(known.begin(), known.end());
    variance_ = known[known.size() / 2];
    least_ = 1 / (255.0 * 255.0) + variance_;
  }

  [[nodiscard]] double factor(ViewIndex view, int y, int x) const {
    const double e = line_error(view, y, x);
    const double line = std::isfinite(e) ? least_ / (least_ + std::max(0.0, e - variance_)) : 1.0;
    return std::pow(line * texture(view, y, x), 0.25);
  }

 private:
  // Of a sample as it is kept, in 10 bits.
  [[nodiscard]] double kept(ViewIndex view, int y, int x, int c) const {
    return std::floor(samples_.view(view).at(y, x, c) * 1023 + 0.5) / 1023;
  }

  [[nodiscard]] double line_error(ViewIndex view, int y, int x) const {
    const int min_views = std::clamp(std::max(samples_.grid().u, samples_.grid().v) / 2, 1, 2);
    double least = kInfinity;
    for (const ViewIndex way : {ViewIndex{0, 1}, {0, -1}, {1, 0}, {-1, 0}}) {
      double sum = 0;
      int count = 0;
      for (int k = 1; k <= 4; ++k) {
        const ViewIndex other{view.v + k * way.v, view.u + k * way.u};
        if (!samples_.contains(other)) break;
        const double square = squared_difference(view, y, x, other);
        if (!std::isfinite(square)) break;
        sum += square;
        ++count;
      }
      if (count >= min_views) least = std::min(least, sum / count);
    }
    return least;
  }

  // Infinite where the line is not within the image.
  [[nodiscard]] double squared_difference(ViewIndex view, int y, int x, ViewIndex other) const {
    const double d = disparity_.view(view).at(y, x);
    const double at_y = y - d * (other.v - view.v), at_x = x - d * (other.u - view.u);
    if (at_y < 0 || at_x < 0 || at_y > samples_.height() - 1 || at_x > samples_.width() - 1) {
      return kInfinity;
    }
    const int y0 = std::min(static_cast<int>(at_y), samples_.height() - 2);
    const int x0 = std::min(static_cast<int>(at_x), samples_.width() - 2);
    double sum = 0;
    for (int c = 0; c < 3; ++c) {
      double met = 0;
      for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < 2; ++i) {
          met += std::fabs(1 - j - (at_y - y0)) * std::fabs(1 - i - (at_x - x0)) *
                 kept(other, y0 + j, x0 + i, c);
        }
      }
      sum += std::pow(met - kept(view, y, x, c), 2);
    }
    return sum;
  }

  // Squared differences to the neighbors along one axis, those that exist.
  [[nodiscard]] std::vector<double> differences(ViewIndex view, int y, int x, bool down) const {
    std::vector<double> found;
    for (const int step : {-1, 1}) {
      const int j = y + (down ? step : 0), i = x + (down ? 0 : step);
      if (j < 0 || i < 0 || j >= samples_.height() || i >= samples_.width()) continue;
      double sum = 0;
      for (int c = 0; c < 3; ++c) sum += std::pow(kept(view, y, x, c) - kept(view, j, i, c), 2);
      found.push_back(sum);
    }
    return found;
  }

  [[nodiscard]] double texture(ViewIndex view, int y, int x) const {
    double own = 0, window = 0;
    int count = 0;
    for (const bool down : {false, true}) {
      const auto both = differences(view, y, x, down);
      own += *std::min_element(both.begin(), both.end());
    }
    for (int j = std::max(0, y - 2); j <= std::min(samples_.height() - 1, y + 2); ++j) {
      for (int i = std::max(0, x - 2); i <= std::min(samples_.width() - 1, x + 2); ++i, ++count) {
        for (const bool down : {false, true}) {
          const auto both = differences(view, j, i, down);
          window += (both.front() + both.back()) / 2;
        }
      }
    }
    return std::min(1.0, 4 * (own + least_) / (window / count + least_));
  }

  ViewStack<float> samples_;
  const ViewStack<float>& disparity_;
  double variance_ = 0, least_ = 0;
};

}  // namespace

class LineCheckTest : public QObject {
  Q_OBJECT

 private slots:
  void confidence_isReducedAsDefined_data();
  void confidence_isReducedAsDefined();
  void fattenedEdge_losesConfidence();
  void anyThreadCount_givesTheSame();
};

void LineCheckTest::confidence_isReducedAsDefined_data() {
  QTest::addColumn<int>("rows");
  QTest::addColumn<int>("columns");
  QTest::addColumn<double>("mean");
  QTest::addColumn<double>("spread");
  QTest::newRow("5x7") << 5 << 7 << 0.37 << 0.4;
  QTest::newRow("5x7, lines almost parallel") << 5 << 7 << -0.6 << 0.05;
  QTest::newRow("5x7, whole pixels") << 5 << 7 << -2.0 << 0.0;
  QTest::newRow("5x7, lines in all directions") << 5 << 7 << 0.0 << 5.0;
  QTest::newRow("1x9, no way up or down") << 1 << 9 << 0.37 << 0.4;
  QTest::newRow("3x1, arms of one view") << 3 << 1 << 0.37 << 0.4;
}

void LineCheckTest::confidence_isReducedAsDefined() {
  QFETCH(int, rows);
  QFETCH(int, columns);
  QFETCH(double, mean);
  QFETCH(double, spread);
  const Scene scene = render("objects", 23, 37, {rows, columns}, 1, 4);
  const LightField& lf = *scene.light_field;
  Estimate estimate = uneven_estimate(lf, mean, spread);
  const ViewStack<float> before = estimate.confidence.clone();
  const Definition definition(lf, estimate.field.disparity);

  reduce_confidence(lf, estimate, Progress());

  for (int i = 0; i < lf.grid().count(); ++i) {
    const ViewIndex view = lf.grid().view_at(i);
    for (int y = 0; y < lf.height(); ++y) {
      for (int x = 0; x < lf.width(); ++x) {
        const double expected = before.view(view).at(y, x) * definition.factor(view, y, x);
        const double found = estimate.confidence.view(view).at(y, x);
        QVERIFY2(std::fabs(found - expected) < 2e-4,
                 qPrintable(
                     QString("%1 instead of %2 at %3,%4").arg(found).arg(expected).arg(y).arg(x)));
      }
    }
  }
}

// Pixels of the background that were given the foreground's disparity, two beside its edge.
void LineCheckTest::fattenedEdge_losesConfidence() {
  const Scene scene = render("edge", 48, 64, {7, 7});
  const ViewIndex view = scene.light_field->center();
  Estimate estimate;
  estimate.field.disparity = scene.truth->field.disparity.clone();
  estimate.confidence = ViewStack<float>(scene.light_field->grid(), 48, 64);
  std::fill_n(estimate.confidence.data(), estimate.confidence.size(), 1.0F);
  const ImageView<float> map = estimate.field.disparity.view(view);
  const auto& truth = scene.truth->field.disparity;
  std::vector<PixelIndex> fattened;
  for (int y = 0; y < 48; ++y) {
    for (int x = 2; x < 62; ++x) {
      const auto row = truth.view(view).row(y);
      const float near = std::max({row[x - 2], row[x - 1], row[x + 1], row[x + 2]});
      if (near < row[x] + 1) continue;
      map.at(y, x) = near;
      fattened.push_back({y, x});
    }
  }
  QVERIFY(fattened.size() > 48);

  reduce_confidence(*scene.light_field, estimate, Progress());

  double of_wrong = 0;
  for (const PixelIndex p : fattened) {
    of_wrong += estimate.confidence.view(view).at(p.y, p.x) / static_cast<double>(fattened.size());
  }
  const double of_all = mean(std::as_const(estimate).confidence.view(view));
  QVERIFY2(of_wrong < 0.6 * of_all, qPrintable(QString("%1, all %2").arg(of_wrong).arg(of_all)));
}

void LineCheckTest::anyThreadCount_givesTheSame() {
  const Scene scene = render("objects", 30, 41, {5, 5});
  Estimate one = uneven_estimate(*scene.light_field), three = uneven_estimate(*scene.light_field);

  reduce_confidence(*scene.light_field, one, Progress(1));
  reduce_confidence(*scene.light_field, three, Progress(3));

  QVERIFY(same_bytes(one.confidence, three.confidence));
}

}  // namespace episcope::in_line_check_test

EPISCOPE_TEST(line_check_test, LineCheckTest)
#include "line_check_test.moc"
