// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/photometric_correction.h"

#include "engine/core/parallel.h"
#include "engine/core/view_stack.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <type_traits>
#include <utility>
#include <variant>

namespace episcope {
namespace {

constexpr double kNotableGain = 0.02;
constexpr double kWorthwhileGain = 0.005;
constexpr double kWorthwhileFallOff = 0.1;

double spread_of_gains(const PhotometricCorrection& correction) {
  if (correction.gains.empty()) return 0;
  double sum = 0;
  for (const auto& gain : correction.gains) {
    for (const double g : gain) sum += std::log(g) * std::log(g);
  }
  return std::sqrt(sum / (3.0 * static_cast<double>(correction.gains.size())));
}

}  // namespace

ViewIndex PhotometricCorrection::most_different() const {
  ViewIndex worst = grid.center();
  double difference = 0;
  for (int i = 0; i < grid.count(); ++i) {
    const double other = std::abs(overall[i] - 1);
    if (!(other > difference)) continue;
    difference = other;
    worst = grid.view_at(i);
  }
  return worst;
}

bool PhotometricCorrection::is_notable() const {
  return std::abs(of(most_different()) - 1) > kNotableGain;
}

double PhotometricCorrection::largest_difference() const {
  double largest = 0;
  for (const auto& view : gains) {
    for (const double gain : view) {
      if (!std::isnan(gain)) largest = std::max(largest, std::abs(gain - 1));
    }
  }
  return largest;
}

bool PhotometricCorrection::is_uneven() const {
  return spread_of_gains(*this) > kWorthwhileGain || std::abs(fall_off) > kWorthwhileFallOff;
}

CornerRadius::CornerRadius(int height, int width)
    : y_(0.5 * (height - 1)), x_(0.5 * (width - 1)), corner_(std::max(1.0, x_ * x_ + y_ * y_)) {}

double divide_by_gains(LightField::Samples& samples, const PhotometricCorrection& correction,
                       const Progress& progress) {
  return std::visit(
      [&]<class T>(ViewStack<T>& stack) {
        std::vector<std::size_t> clipped(stack.grid().count());
        const int channels = stack.channels();
        parallel_for(stack.grid().count(), progress, [&](int i) {
          T* const view = stack.view(stack.view_at(i)).data;
          for (int c = 0; c < channels; ++c) {
            const double gain = correction.gains[i][c];
            if (!(gain > 0)) continue;
            const auto factor = static_cast<float>(1 / gain);
            for (std::size_t n = c; n < stack.view_size(); n += channels) {
              if constexpr (std::is_integral_v<T>) {
                constexpr auto kLargest = static_cast<float>(std::numeric_limits<T>::max());
                const float value = factor * static_cast<float>(view[n]) + 0.5F;
                clipped[i] += value >= kLargest + 1 ? 1 : 0;
                view[n] = static_cast<T>(std::min(value, kLargest));
              } else {
                view[n] *= factor;
              }
            }
          }
        });
        const auto sum = std::accumulate(clipped.begin(), clipped.end(), std::size_t{0});
        return static_cast<double>(sum) / static_cast<double>(stack.size());
      },
      samples);
}

LightField corrected(const LightField& lf, const PhotometricCorrection& correction,
                     const Progress& progress) {
  ViewStack<std::uint16_t> samples(lf.grid(), lf.height(), lf.width(), lf.channels());
  const CornerRadius radius(lf.height(), lf.width());
  parallel_for(lf.grid().count(), progress, [&](int i) {
    const ViewIndex view = lf.grid().view_at(i);
    const ImageView<std::uint16_t> out = samples.view(view);
    std::vector<float> row(static_cast<std::size_t>(lf.width()) * lf.channels());
    for (int y = 0; y < lf.height(); ++y) {
      lf.read_row(view, y, 0, lf.width(), row.data());
      std::size_t k = 0;
      for (int x = 0; x < lf.width(); ++x) {
        const double light = 1 - correction.fall_off * radius.squared(y, x);
        for (int c = 0; c < lf.channels(); ++c, ++k) {
          const auto factor = static_cast<float>(1 / (light * correction.gains[i][c]));
          out.row(y)[k] = to_word_sample(row[k] * factor);
        }
      }
    }
    lf.forget_samples();
  });
  return {std::move(samples), lf.info(), lf.valid().clone()};
}

}  // namespace episcope
