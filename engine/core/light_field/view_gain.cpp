// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/light_field/view_gain.h"

#include "engine/core/array/quantile.h"
#include "engine/core/parallel/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <type_traits>
#include <variant>

namespace episcope {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr int kBlocksAcross = 12;
constexpr int kMinBlock = 6;  // px
constexpr int kRowsOfBlock = 12;
// Samples in [0, 1]: clipped above, and mean of a block that is too dark to tell a ratio.
constexpr float kClipped = 0.98F;
constexpr float kDark = 0.03F;
// Share of the pixels of a block that may be clipped or invalid.
constexpr double kTolerated = 0.02;
constexpr std::size_t kMinBlocks = 8;
constexpr int kSweeps = 200;
// Channels and their sum.
constexpr int kMaxQuantities = 4;

using Quantities = std::array<float, kMaxQuantities>;

// Means of the blocks of one view; the last quantity is NaN where a block does not count.
using Blocks = std::vector<Quantities>;

template <class T>
constexpr float kUnit = std::is_integral_v<T>
                            ? 1.0F / static_cast<float>(std::numeric_limits<T>::max())
                            : 1.0F;

template <class T>
class BlockMeans {
 public:
  BlockMeans(const ViewStack<T>& stack, const ViewStack<std::uint8_t>& valid)
      : stack_(stack),
        valid_(valid),
        side_(std::max(kMinBlock, std::min(stack.height(), stack.width()) / kBlocksAcross)),
        row_step_(std::max(1, side_ / kRowsOfBlock)) {}

  [[nodiscard]] Blocks of(ViewIndex view) const {
    Blocks blocks;
    for (int y = 0; y + side_ <= stack_.height(); y += side_) {
      for (int x = 0; x + side_ <= stack_.width(); x += side_) blocks.push_back(mean(view, {y, x}));
    }
    return blocks;
  }

 private:
  [[nodiscard]] Quantities mean(ViewIndex view, PixelIndex begin) const {
    const ImageView<const T> image = stack_.view(view);
    Quantities sums{};
    int left_out = 0, pixels = 0;
    for (int y = begin.y; y < begin.y + side_; y += row_step_) {
      const std::uint8_t* const known = valid_.empty() ? nullptr : valid_.view(view).row(y);
      for (int x = begin.x; x < begin.x + side_; ++x) {
        float largest = 0;
        for (int c = 0; c < image.channels; ++c) {
          const float sample = kUnit<T> * static_cast<float>(image.at(y, x, c));
          sums[c] += sample;
          largest = std::max(largest, sample);
        }
        left_out += largest >= kClipped || (known && known[x] == 0) ? 1 : 0;
        ++pixels;
      }
    }
    const int channels = image.channels;
    for (int c = 0; c < channels; ++c) sums[c] /= static_cast<float>(pixels);
    const float overall = std::accumulate(sums.begin(), sums.begin() + channels, 0.0F);
    const bool counts = left_out <= kTolerated * pixels && overall > kDark * channels;
    sums[channels] = counts ? overall : static_cast<float>(kNan);
    return sums;
  }

  const ViewStack<T>& stack_;
  const ViewStack<std::uint8_t>& valid_;
  int side_;
  int row_step_;
};

std::vector<Blocks> block_means(const LightField::Samples& samples,
                                const ViewStack<std::uint8_t>& valid, const Progress& progress) {
  return std::visit(
      [&]<class T>(const ViewStack<T>& stack) {
        const BlockMeans<T> means(stack, valid);
        std::vector<Blocks> blocks(stack.grid().count());
        parallel_for(stack.grid().count(), progress,
                     [&](int i) { blocks[i] = means.of(stack.view_at(i)); });
        return blocks;
      },
      samples);
}

// What two neighbouring views say: the logarithm of their ratio, and how surely.
struct Ratio {
  int from = 0, to = 0;
  double log_ratio = 0, weight = 0;
};

std::optional<Ratio> ratio_of(const std::vector<Blocks>& views, int from, int to, int quantity,
                              int channels) {
  std::vector<float> logs;
  for (std::size_t i = 0; i < views[from].size(); ++i) {
    const Quantities& a = views[from][i];
    const Quantities& b = views[to][i];
    if (!std::isfinite(a[channels] + b[channels]) || a[quantity] <= 0 || b[quantity] <= 0) continue;
    logs.push_back(std::log(b[quantity] / a[quantity]));
  }
  if (logs.size() < kMinBlocks) return {};
  const float median = quantile(logs, 0.5);
  for (float& value : logs) value = std::abs(value - median);
  const double spread = quantile(logs, 0.5);
  // As far as rounding lets ratios agree.
  constexpr double kLeastSpread = 1e-4;
  return Ratio{from, to, median,
               static_cast<double>(logs.size()) / (spread * spread + kLeastSpread * kLeastSpread)};
}

std::vector<Ratio> ratios_of(const std::vector<Blocks>& views, GridShape grid, int quantity,
                             int channels) {
  std::vector<Ratio> ratios;
  for (int i = 0; i < grid.count(); ++i) {
    const bool has_right = i % grid.u + 1 < grid.u, has_below = i / grid.u + 1 < grid.v;
    for (const int to : {has_right ? i + 1 : -1, has_below ? i + grid.u : -1}) {
      if (to < 0) continue;
      if (const auto ratio = ratio_of(views, i, to, quantity, channels)) ratios.push_back(*ratio);
    }
  }
  return ratios;
}

// First values: along the ratios from the centre outwards. NaN for views that none reaches.
std::vector<double> spread_from(int center, int count, const std::vector<Ratio>& ratios) {
  std::vector<double> logs(count, kNan);
  logs[center] = 0;
  for (bool is_growing = true; is_growing;) {
    is_growing = false;
    std::vector<double> next = logs;
    for (const Ratio& ratio : ratios) {
      const double from = logs[ratio.from], to = logs[ratio.to];
      if (std::isnan(from) == std::isnan(to)) continue;
      if (std::isnan(to)) next[ratio.to] = from + ratio.log_ratio;
      if (std::isnan(from)) next[ratio.from] = to - ratio.log_ratio;
      is_growing = true;
    }
    logs.swap(next);
  }
  return logs;
}

// Least squares of all ratios with the centre at 0, by Gauss and Seidel.
void settle(int center, const std::vector<Ratio>& ratios, std::vector<double>& logs) {
  std::vector<double> sums(logs.size()), weights(logs.size());
  std::vector<std::vector<Ratio>> of_view(logs.size());
  for (const Ratio& ratio : ratios) {
    of_view[ratio.to].push_back(ratio);
    of_view[ratio.from].push_back({ratio.to, ratio.from, -ratio.log_ratio, ratio.weight});
  }
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (int i = 0; i < static_cast<int>(logs.size()); ++i) {
      if (i == center || std::isnan(logs[i])) continue;
      double sum = 0, weight = 0;
      for (const Ratio& ratio : of_view[i]) {
        sum += ratio.weight * (logs[ratio.from] + ratio.log_ratio);
        weight += ratio.weight;
      }
      if (weight > 0) logs[i] = sum / weight;
    }
  }
}

}  // namespace

ViewIndex ViewGains::most_different() const {
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

ViewGains measure_view_gains(const LightField::Samples& samples,
                             const ViewStack<std::uint8_t>& valid, const Progress& progress) {
  ViewGains gains;
  std::visit(
      [&gains](const auto& stack) {
        gains.grid = stack.grid();
        gains.channels = stack.channels();
      },
      samples);
  const GridShape grid = gains.grid;
  const int channels = gains.channels;
  const std::vector<Blocks> views = block_means(samples, valid, progress);
  const int center = grid.center().v * grid.u + grid.center().u;
  gains.channel.resize(static_cast<std::size_t>(grid.count()) * channels);
  gains.overall.resize(grid.count());
  for (int quantity = 0; quantity <= channels; ++quantity) {
    const std::vector<Ratio> ratios = ratios_of(views, grid, quantity, channels);
    std::vector<double> logs = spread_from(center, grid.count(), ratios);
    settle(center, ratios, logs);
    for (int i = 0; i < grid.count(); ++i) {
      double& gain = quantity < channels
                         ? gains.channel[static_cast<std::size_t>(i) * channels + quantity]
                         : gains.overall[i];
      gain = std::exp(logs[i]);
    }
  }
  return gains;
}

double divide_by_gains(LightField::Samples& samples, const ViewGains& gains,
                       const Progress& progress) {
  return std::visit(
      [&]<class T>(ViewStack<T>& stack) {
        std::vector<std::size_t> clipped(stack.grid().count());
        parallel_for(stack.grid().count(), progress, [&](int i) {
          T* const view = stack.view(stack.view_at(i)).data;
          const double* const gain = &gains.channel[static_cast<std::size_t>(i) * gains.channels];
          for (int c = 0; c < gains.channels; ++c) {
            if (!(gain[c] > 0)) continue;
            const auto factor = static_cast<float>(1 / gain[c]);
            for (std::size_t n = c; n < stack.view_size(); n += gains.channels) {
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

}  // namespace episcope
