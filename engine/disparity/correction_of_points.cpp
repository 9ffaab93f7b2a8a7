// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/correction_of_points.h"

#include "engine/core/memory.h"
#include "engine/core/numbers.h"
#include "engine/core/parallel.h"
#include "engine/disparity/matching_cost.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace episcope {
namespace {

// Samples that count: beyond, noise and saturation decide.
constexpr float kDarkest = 0.04F, kBrightest = 0.97F;
// Pixels between those that are looked at, and of a view about so many at most.
constexpr int kLeastStride = 3;
constexpr double kMostPoints = 30000;
constexpr int kRounds = 6;
// Steps of the fall-off that no sample would show.
constexpr double kSmallStep = 1e-4;
// Of log ratios, in medians of their size.
constexpr float kRatioTolerance = 3, kLeastTolerance = 0.05F;
constexpr double kMostFallOff = 0.9;

// What a point says of one view and channel: log of the ratio, and r² here and there.
struct Ratio {
  float log, here, there;
};

float without_fall_off(const Ratio& ratio, float k) {
  return ratio.log - std::log((1 - k * ratio.there) / (1 - k * ratio.here));
}

int stride_for(const LightField& lf) {
  const double pixels = static_cast<double>(lf.height()) * lf.width();
  return std::max(kLeastStride, static_cast<int>(std::ceil(std::sqrt(pixels / kMostPoints))));
}

bool counts(float sample) {
  return sample > kDarkest && sample < kBrightest;
}

// What is known of every view and channel, of each at most so much: beyond the memory budget on
// disk.
template <class T>
class OfChannels {
 public:
  OfChannels(std::size_t channels, std::size_t most)
      : most_(most), values_(make_large<T>(channels * most)), sizes_(channels) {}

  [[nodiscard]] std::size_t channels() const { return sizes_.size(); }
  [[nodiscard]] std::size_t most() const { return most_; }
  [[nodiscard]] std::span<const T> operator[](std::size_t channel) const {
    return {values_.get() + channel * most_, sizes_[channel]};
  }
  // Room for all that may be known of a channel, of which the first `size` then count.
  [[nodiscard]] T* room(std::size_t channel) { return values_.get() + channel * most_; }
  void set_size(std::size_t channel, std::size_t size) { sizes_[channel] = size; }

 private:
  std::size_t most_;
  LargeArray<T> values_;
  std::vector<std::size_t> sizes_;
};

using Ratios = OfChannels<Ratio>;
using Logs = OfChannels<float>;  // Of the ratios, without a fall-off.

class Points {
 public:
  Points(const LightField& lf, ViewIndex reference, ImageView<const float> disparity)
      : lf_(lf),
        reference_(reference),
        disparity_(disparity),
        here_(lf.view_as_float(reference)),
        stride_(stride_for(lf)) {}

  // The most that there are.
  [[nodiscard]] std::size_t count() const {
    const auto along = [this](int length) {
      return static_cast<std::size_t>(length / stride_) + 1;
    };
    return along(lf_.height()) * along(lf_.width());
  }

  // Those of a view, from the channel `first` on.
  void add_ratios(ViewIndex view, std::size_t first, Ratios& ratios) const {
    std::array<Ratio*, 3> room{};
    for (int c = 0; c < lf_.channels(); ++c) room[c] = ratios.room(first + c);
    std::array<std::size_t, 3> sizes{};
    const Image<float> there = lf_.view_as_float(view);
    const CornerRadius radius(lf_.height(), lf_.width());
    for (int y = 1; y < lf_.height(); y += stride_) {
      for (int x = 1; x < lf_.width(); x += stride_) {
        if (!lf_.is_valid(reference_, y, x)) continue;
        const float d = disparity_.at(y, x);
        if (d <= kNothingNear) continue;
        const float to_y = static_cast<float>(y) - d * static_cast<float>(view.v - reference_.v);
        const float to_x = static_cast<float>(x) - d * static_cast<float>(view.u - reference_.u);
        const int row = static_cast<int>(std::floor(to_y)),
                  column = static_cast<int>(std::floor(to_x));
        if (!sees(view, row, column)) continue;
        const auto here = static_cast<float>(radius.squared(y, x));
        const auto far = static_cast<float>(radius.squared(to_y, to_x));
        const float ty = to_y - static_cast<float>(row), tx = to_x - static_cast<float>(column);
        for (int c = 0; c < lf_.channels(); ++c) {
          const float a = here_.at(y, x, c);
          const float b =
              (1 - ty) * ((1 - tx) * there.at(row, column, c) + tx * there.at(row, column + 1, c)) +
              ty *
                  ((1 - tx) * there.at(row + 1, column, c) + tx * there.at(row + 1, column + 1, c));
          if (counts(a) && counts(b)) room[c][sizes[c]++] = {std::log(b / a), here, far};
        }
      }
    }
    for (int c = 0; c < lf_.channels(); ++c) ratios.set_size(first + c, sizes[c]);
  }

 private:
  // Whether the four samples around a place are there.
  [[nodiscard]] bool sees(ViewIndex view, int row, int column) const {
    return row >= 0 && column >= 0 && row + 1 < lf_.height() && column + 1 < lf_.width() &&
           lf_.is_valid(view, row, column) && lf_.is_valid(view, row, column + 1) &&
           lf_.is_valid(view, row + 1, column) && lf_.is_valid(view, row + 1, column + 1);
  }

  const LightField& lf_;
  ViewIndex reference_;
  ImageView<const float> disparity_;
  Image<float> here_;
  int stride_;
};

void remove_fall_off(const Ratios& ratios, double fall_off, const Progress& progress, Logs& logs) {
  const auto k = static_cast<float>(fall_off);
  parallel_for(static_cast<int>(ratios.channels()), progress, [&](int i) {
    std::ranges::transform(ratios[i], logs.room(i),
                           [&](const Ratio& ratio) { return without_fall_off(ratio, k); });
    logs.set_size(i, ratios[i].size());
  });
}

std::vector<double> medians(const Logs& logs, const Progress& progress) {
  std::vector<double> middle(logs.channels());
  parallel_for(static_cast<int>(logs.channels()), progress, [&](int i) {
    if (logs[i].size() < 50) return;
    std::vector<float> values(logs[i].begin(), logs[i].end());
    middle[i] = quantile(values, 0.5);
  });
  return middle;
}

// How far ratios that fit may be off: noise sets it.
float tolerance(std::span<const float> logs, double log) {
  std::vector<float> off(logs.size());
  std::ranges::transform(logs, off.begin(),
                         [&](float each) { return std::abs(each - static_cast<float>(log)); });
  return std::max(kLeastTolerance, kRatioTolerance * static_cast<float>(quantile(off, 0.5)));
}

// Sums of a Gauss-Newton step.
struct Step {
  double product = 0, square = 1e-9;
};

Step gauss_newton_step(std::span<const Ratio> ratios, std::span<const float> logs, double log,
                       double k) {
  Step step;
  if (ratios.empty()) return step;
  const double most = tolerance(logs, log);
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    const Ratio& ratio = ratios[i];
    const double off = logs[i] - log;
    if (std::abs(off) > most) continue;
    const double slope = ratio.here / (1 - k * ratio.here) - ratio.there / (1 - k * ratio.there);
    const double trust = 1 - off * off / (most * most);
    step.product += trust * slope * off;
    step.square += trust * slope * slope;
  }
  return step;
}

// A step of k, at which the ratios have these logs, on points whose ratio fits about, the others
// being occluded or wrong.
double better_fall_off(const Ratios& ratios, const Logs& logs, double k, const Progress& progress) {
  const std::vector<double> middle = medians(logs, progress);
  std::vector<Step> steps(ratios.channels());
  parallel_for(static_cast<int>(ratios.channels()), progress,
               [&](int i) { steps[i] = gauss_newton_step(ratios[i], logs[i], middle[i], k); });
  Step sum;
  for (const Step& step : steps) {
    sum.product += step.product;
    sum.square += step.square;
  }
  return std::clamp(k + sum.product / sum.square, -kMostFallOff, kMostFallOff);
}

}  // namespace

PhotometricCorrection correction_of_points(const LightField& lf, ViewIndex reference,
                                           ImageView<const float> disparity,
                                           const Progress& progress) {
  const GridShape grid = lf.grid();
  const int channels = lf.channels();
  const Points points(lf, reference, disparity);
  Ratios ratios(static_cast<std::size_t>(grid.count()) * channels, points.count());
  parallel_for(grid.count(), progress.part(0, 0.6), [&](int i) {
    if (grid.view_at(i) == reference) return;
    points.add_ratios(grid.view_at(i), static_cast<std::size_t>(i) * channels, ratios);
    lf.forget_samples();
  });
  PhotometricCorrection correction{.grid = grid};
  Logs evened(ratios.channels(), ratios.most());
  remove_fall_off(ratios, 0, progress, evened);
  for (int i = 0; i < kRounds; ++i) {
    const double before = correction.fall_off;
    correction.fall_off = better_fall_off(ratios, evened, before, progress);
    remove_fall_off(ratios, correction.fall_off, progress, evened);
    if (std::abs(correction.fall_off - before) < kSmallStep) break;
  }
  const std::vector<double> logs = medians(evened, progress);
  correction.gains.assign(grid.count(), {1, 1, 1});
  for (int i = 0; i < grid.count(); ++i) {
    for (int c = 0; c < 3; ++c) {
      correction.gains[i][c] = std::exp(logs[i * channels + std::min(c, channels - 1)]);
    }
  }
  return correction;
}

}  // namespace episcope
