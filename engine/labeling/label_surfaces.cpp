// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/label_surfaces.h"

#include "engine/core/numbers.h"
#include "engine/core/parallel.h"
#include "engine/labeling/feature_kernel.h"
#include "engine/labeling/forest_kernel.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace episcope {
namespace {

constexpr std::size_t kFewestSamples = 8;
constexpr int kRounds = 12;
constexpr double kShortStroke = 1.0 / 80;  // Of the larger side: half of its slope is believed.
constexpr double kOutlier = 3;             // Of the Cauchy weights, in robust standard deviations.
constexpr double kLeastScale = 1e-3;       // So that exact planes have one.
constexpr double kLeverage = 0.08;         // What leverage adds to the variance.
constexpr float kWeight = 1.5F;
constexpr float kLeastProbability = 0.02F;

// Far from everything: beyond the labels there is no surface.
constexpr float kNowhere = 1e6F;

enum Term { kIsKnown, kMiddle, kAt, kAcross, kVariance, kFlat, kSlope, kBend, kTerms };

// What SurfaceRow points to.
struct RowTerms {
  explicit RowTerms(int labels) : pitch(labels), values(static_cast<std::size_t>(kTerms) * labels) {
    for (const auto& [term, value] :
         {std::pair{kIsKnown, 1.0F}, std::pair{kAt, kNowhere}, std::pair{kVariance, 1.0F}}) {
      std::fill_n(values.begin() + term * pitch, pitch, value);
    }
  }
  [[nodiscard]] SurfaceRow row() const {
    const auto term = [this](Term of) { return values.data() + of * pitch; };
    SurfaceRow row;
    row.pitch = pitch;
    row.is_known = term(kIsKnown);
    row.middle = term(kMiddle);
    row.at = term(kAt);
    row.across = term(kAcross);
    row.variance = term(kVariance);
    row.flat = term(kFlat);
    row.slope = term(kSlope);
    row.bend = term(kBend);
    return row;
  }

  int pitch;
  std::vector<float> values;  // [term][label]
};

}  // namespace

LabelSurfaces::LabelSurfaces(ImageView<const std::int32_t> strokes, int label_count,
                             ImageView<const float> disparity, ImageView<const float> trust,
                             const Progress& progress)
    : disparity_(disparity),
      trust_(trust),
      pitch_(round_up(label_count, kVectorLanes)),
      misfits_(make_large<float>(static_cast<std::size_t>(disparity.height * row_size()))) {
  std::vector<std::vector<Sample>> samples(static_cast<std::size_t>(label_count));
  for (int y = 0; y < strokes.height; ++y) {
    for (int x = 0; x < strokes.width; ++x) {
      const std::int32_t label = strokes.at(y, x) - 1;
      if (label < 0) continue;
      samples[static_cast<std::size_t>(label)].push_back({static_cast<double>(x),
                                                          static_cast<double>(y),
                                                          static_cast<double>(disparity.at(y, x))});
    }
  }
  const double ridge = kShortStroke * std::max(strokes.height, strokes.width);
  for (const auto& of_label : samples) surfaces_.push_back(fit(of_label, ridge * ridge));
  parallel_for(disparity.height, progress, [this](int y) { find_misfits(y); });
}

LabelSurfaces::Surface LabelSurfaces::fit(const std::vector<Sample>& samples, double ridge_px2) {
  Surface surface;
  if (samples.size() < kFewestSamples) return surface;
  surface.is_known = true;
  for (const Sample& sample : samples) {
    surface.x += sample.x / static_cast<double>(samples.size());
    surface.y += sample.y / static_cast<double>(samples.size());
  }
  std::vector<double> weights(samples.size(), 1.0);
  std::vector<double> misses(samples.size());
  for (int round = 0; round < kRounds; ++round) {
    solve(samples, weights, ridge_px2, surface);
    std::ranges::transform(samples, misses.begin(), [&](const Sample& s) {
      const auto& [at, across, down] = surface.plane;
      return std::abs(s.d - at - across * (s.x - surface.x) - down * (s.y - surface.y));
    });
    // 1.4826: from the median to the standard deviation of a Gaussian.
    const double scale = kOutlier * (1.4826 * median(misses) + kLeastScale);
    double sum = 0, all = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      weights[i] = 1 / (1 + misses[i] * misses[i] / (scale * scale));
      sum += weights[i] * misses[i] * misses[i];
      all += weights[i];
    }
    surface.variance = sum / all;
  }
  return surface;
}

// Normal equations of (1, x, y), divided by the sum of the weights.
void LabelSurfaces::solve(const std::vector<Sample>& samples, const std::vector<double>& weights,
                          double ridge_px2, Surface& surface) {
  double one = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0, d = 0, dx = 0, dy = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double w = weights[i];
    const double at_x = samples[i].x - surface.x, at_y = samples[i].y - surface.y;
    one += w;
    x += w * at_x;
    y += w * at_y;
    xx += w * at_x * at_x;
    xy += w * at_x * at_y;
    yy += w * at_y * at_y;
    d += w * samples[i].d;
    dx += w * at_x * samples[i].d;
    dy += w * at_y * samples[i].d;
  }
  for (double* sum : {&x, &y, &xx, &xy, &yy, &d, &dx, &dy}) *sum /= one;
  xx += ridge_px2;
  yy += ridge_px2;
  // Cofactors of the first row.
  const double c0 = xx * yy - xy * xy, c1 = y * xy - x * yy, c2 = x * xy - xx * y;
  const double determinant = c0 + x * c1 + y * c2;
  auto& m = surface.inverse;
  m = {c0, c1, c2, yy - y * y, x * y - xy, xx - x * x};
  for (double& entry : m) entry /= determinant;
  surface.plane = {m[0] * d + m[1] * dx + m[2] * dy, m[1] * d + m[3] * dx + m[4] * dy,
                   m[2] * d + m[4] * dx + m[5] * dy};
}

void LabelSurfaces::find_misfits(int y) {
  static const LabelWeightsKernel& kernel = EPISCOPE_CHOOSE_KERNEL(best_isa(), kLabelWeightsKernel);
  RowTerms terms(pitch_);
  float* const arrays = terms.values.data();
  for (std::size_t l = 0; l < surfaces_.size(); ++l) {
    const Surface& surface = surfaces_[l];
    const auto& m = surface.inverse;
    const double dy = y - surface.y;
    const auto set = [&](int term, double value) {
      arrays[term * pitch_ + static_cast<std::ptrdiff_t>(l)] = static_cast<float>(value);
    };
    set(kIsKnown, surface.is_known ? 1 : 0);
    set(kMiddle, surface.x);
    set(kAt, surface.plane[0] + surface.plane[2] * dy);
    set(kAcross, surface.plane[1]);
    set(kVariance, kNoise_px * kNoise_px + surface.variance);
    set(kFlat, kLeverage * (m[0] + (2 * m[2] + m[5] * dy) * dy));
    set(kSlope, kLeverage * 2 * (m[1] + m[4] * dy));
    set(kBend, kLeverage * m[3]);
  }
  SurfaceRow row = terms.row();
  row.width = disparity_.width;
  row.disparity = disparity_.row(y);
  row.noise = static_cast<float>(kNoise_px * kNoise_px);
  row.most = kMostMisfit;
  kernel.misfits(row, misfits_.get() + y * row_size());
}

void LabelSurfaces::set_support(const std::vector<float>& support, const Progress& progress) {
  parallel_for(disparity_.height, progress, [&](int y) {
    float* misfit = misfits_.get() + y * row_size();
    for (int x = 0; x < disparity_.width; ++x, misfit += pitch_) {
      const float least = *std::min_element(misfit, misfit + support.size());
      for (std::size_t l = 0; l < support.size(); ++l) {
        misfit[l] = std::lerp(least, misfit[l], support[l]);
      }
    }
  });
}

void LabelSurfaces::weigh_row(int y, float* probabilities) const {
  static const LabelWeightsKernel& kernel = EPISCOPE_CHOOSE_KERNEL(best_isa(), kLabelWeightsKernel);
  std::vector<float> strength(static_cast<std::size_t>(disparity_.width), kWeight);
  if (!trust_.empty()) {
    std::transform(trust_.row(y), trust_.row(y) + disparity_.width, strength.begin(),
                   [](float trust) { return kWeight * trust; });
  }
  std::vector<float> is_label(static_cast<std::size_t>(pitch_)), floor(is_label.size());
  std::fill_n(is_label.begin(), surfaces_.size(), 1.0F);
  std::fill_n(floor.begin(), surfaces_.size(), kLeastProbability);
  kernel.weigh({disparity_.width, pitch_, misfits(y), strength.data(), is_label.data(),
                floor.data(), kMostMisfit},
               probabilities);
}

}  // namespace episcope
