// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/view_gain.h"

#include "engine/core/numbers.h"
#include "engine/core/parallel.h"
#include "engine/core/view_stack.h"

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
constexpr int kBlocksAcross = 10;
constexpr int kMinBlock = 6;       // px
constexpr int kSamplesAcross = 6;  // of a block, in each direction
constexpr int kSamples = kSamplesAcross * kSamplesAcross;
constexpr int kLeastSamples = kSamples * 4 / 5;  // that must count
constexpr int kReach = 6;                        // px of disparity
// Samples in [0, 1]: clipped above, and mean of a block that is too dark to tell a ratio.
constexpr float kClipped = 0.98F;
constexpr float kDark = 0.03F;
constexpr std::size_t kMinBlocks = 8;
constexpr int kGainSweeps = 200;
// Channels and their sum.
constexpr int kMaxQuantities = 4;

using Quantities = std::array<float, kMaxQuantities>;

// Two neighbouring views: what a block of the one shows stands some px along `way` in the other.
struct Pair {
  ViewIndex from, to;
  PixelIndex way;
};

// Compares blocks of two views of one light field.
template <class T>
class BlockRatios {
 public:
  BlockRatios(const ViewStack<T>& stack, const ViewStack<std::uint8_t>& valid)
      : stack_(stack),
        valid_(valid),
        side_(std::max(kMinBlock, std::min(stack.height(), stack.width()) / kBlocksAcross)) {}

  // Logarithms of the ratios of each quantity, by blocks that can be compared.
  [[nodiscard]] std::vector<Quantities> of(const Pair& pair, GainBlocks wanted) const {
    if (wanted == GainBlocks::OneOfFour) {
      std::vector<Quantities> some = every(2, pair);
      if (some.size() >= kMinBlocks) return some;
    }
    return every(1, pair);
  }

 private:
  struct Match {
    Quantities log_ratio;
    float misfit = 0;
  };

  struct View {
    ImageView<const T> samples;
    ImageView<const std::uint8_t> valid;
  };
  // The views of a pair.
  struct Looked {
    View from, to;
    PixelIndex way;
  };

  [[nodiscard]] View look_at(ViewIndex view) const {
    return {stack_.view(view),
            valid_.empty() ? ImageView<const std::uint8_t>() : valid_.view(view)};
  }

  // Of one block of `step` in each direction.
  [[nodiscard]] std::vector<Quantities> every(int step, const Pair& views) const {
    const Looked pair{look_at(views.from), look_at(views.to), views.way};
    std::vector<Quantities> ratios;
    for (int y = 0; y + side_ <= stack_.height(); y += step * side_) {
      for (int x = 0; x + side_ <= stack_.width(); x += step * side_) {
        if (const auto ratio = best_match(pair, {y, x})) ratios.push_back(*ratio);
      }
    }
    return ratios;
  }

  // Channels and their sum; empty where the sample does not count.
  [[nodiscard]] std::optional<Quantities> sample(const View& view, PixelIndex at) const {
    const ImageView<const T>& image = view.samples;
    if (at.y < 0 || at.x < 0 || at.y >= image.height || at.x >= image.width) return {};
    if (!view.valid.empty() && view.valid.at(at.y, at.x) == 0) return {};
    Quantities values{};
    for (int c = 0; c < image.channels; ++c) {
      values[c] = kSampleStep<T> * static_cast<float>(image.at(at.y, at.x, c));
      if (!(values[c] < kClipped)) return {};
      values[image.channels] += values[c];
    }
    return values;
  }

  // Samples of a block that count, in the view that pairs begin with.
  struct Block {
    std::array<PixelIndex, kSamples> at;
    std::array<Quantities, kSamples> values;
    int count = 0;
  };

  [[nodiscard]] Block block_at(const View& view, PixelIndex begin) const {
    Block block;
    for (int i = 0; i < kSamples; ++i) {
      const PixelIndex at{begin.y + i / kSamplesAcross * side_ / kSamplesAcross,
                          begin.x + i % kSamplesAcross * side_ / kSamplesAcross};
      const auto values = sample(view, at);
      if (!values) continue;
      block.at[block.count] = at;
      block.values[block.count++] = *values;
    }
    return block;
  }

  [[nodiscard]] std::optional<Match> match(const Looked& pair, const Block& block,
                                           int shift) const {
    const int overall = stack_.channels();
    std::array<std::array<float, 2>, kSamples> brightness;
    Quantities from{}, to{};
    int count = 0;
    for (int i = 0; i < block.count; ++i) {
      const PixelIndex at = block.at[i];
      const auto there = sample(pair.to, {at.y + shift * pair.way.y, at.x + shift * pair.way.x});
      if (!there) continue;
      for (int q = 0; q <= overall; ++q) {
        from[q] += block.values[i][q];
        to[q] += (*there)[q];
      }
      brightness[count++] = {block.values[i][overall], (*there)[overall]};
    }
    const auto counted = static_cast<float>(count);
    const bool is_dark =
        std::min(from[overall], to[overall]) < kDark * counted * static_cast<float>(overall);
    if (count < kLeastSamples || is_dark) return {};
    Match match;
    for (int q = 0; q <= overall; ++q) match.log_ratio[q] = std::log(to[q] / from[q]);
    const float ratio = to[overall] / from[overall];
    for (int i = 0; i < count; ++i) {
      match.misfit += std::abs(brightness[i][1] - ratio * brightness[i][0]) / counted;
    }
    return match;
  }

  // Every other shift first, then those beside the best.
  [[nodiscard]] std::optional<Quantities> best_match(const Looked& pair, PixelIndex begin) const {
    const Block block = block_at(pair.from, begin);
    if (block.count < kLeastSamples) return {};
    std::optional<Match> best;
    int best_shift = 0;
    const auto look = [&](int shift) {
      const auto other = match(pair, block, shift);
      if (!other || (best && best->misfit <= other->misfit)) return;
      best = other;
      best_shift = shift;
    };
    for (int shift = -kReach; shift <= kReach; shift += 2) look(shift);
    if (!best) return {};
    for (const int shift : {best_shift - 1, best_shift + 1}) look(shift);
    return best->log_ratio;
  }

  const ViewStack<T>& stack_;
  const ViewStack<std::uint8_t>& valid_;
  int side_;
};

std::vector<Pair> pairs_of(GridShape grid) {
  std::vector<Pair> pairs;
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex view = grid.view_at(i);
    const ViewIndex right{view.v, view.u + 1}, below{view.v + 1, view.u};
    if (grid.contains(right)) pairs.push_back({view, right, {0, 1}});
    if (grid.contains(below)) pairs.push_back({view, below, {1, 0}});
  }
  return pairs;
}

// What two neighbouring views say of a quantity: the logarithm of their ratio, and how surely.
struct Ratio {
  int from = 0, to = 0;
  double log_ratio = 0, weight = 0;
};

std::optional<Ratio> summed_up(const std::vector<Quantities>& blocks, int quantity) {
  std::vector<float> logs;
  for (const Quantities& block : blocks) {
    if (std::isfinite(block[quantity])) logs.push_back(block[quantity]);
  }
  if (logs.size() < kMinBlocks) return {};
  const auto count = static_cast<double>(logs.size());
  const float median = quantile(logs, 0.5);
  for (float& value : logs) value = std::abs(value - median);
  const double spread = quantile(logs, 0.5);
  constexpr double kLeastSpread = 1e-3;  // of rounding
  return Ratio{0, 0, median, count / (spread * spread + kLeastSpread * kLeastSpread)};
}

// By quantity.
using Ratios = std::array<std::vector<Ratio>, kMaxQuantities>;

Ratios find_ratios(const LightField::Samples& samples, const ViewStack<std::uint8_t>& valid,
                   const Progress& progress, GainBlocks wanted) {
  const GridShape grid = grid_of(samples);
  const std::vector<Pair> pairs = pairs_of(grid);
  std::vector<std::vector<Quantities>> blocks(pairs.size());
  std::visit(
      [&]<class T>(const ViewStack<T>& stack) {
        const BlockRatios<T> ratios(stack, valid);
        parallel_for(static_cast<int>(pairs.size()), progress, [&](int i) {
          blocks[i] = ratios.of(pairs[i], wanted);
          forget_view(stack, pairs[i].from);
          forget_view(stack, pairs[i].to);
        });
      },
      samples);
  Ratios ratios;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (int quantity = 0; quantity < kMaxQuantities; ++quantity) {
      std::optional<Ratio> ratio = summed_up(blocks[i], quantity);
      if (!ratio) continue;
      ratio->from = pairs[i].from.v * grid.u + pairs[i].from.u;
      ratio->to = pairs[i].to.v * grid.u + pairs[i].to.u;
      ratios[quantity].push_back(*ratio);
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
  for (int sweep = 0; sweep < kGainSweeps; ++sweep) {
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
                             const ViewStack<std::uint8_t>& valid, const Progress& progress,
                             GainBlocks blocks) {
  ViewGains gains;
  std::visit(
      [&gains](const auto& stack) {
        gains.grid = stack.grid();
        gains.channels = stack.channels();
      },
      samples);
  const GridShape grid = gains.grid;
  const int channels = gains.channels;
  const Ratios all = find_ratios(samples, valid, progress, blocks);
  const int center = grid.center().v * grid.u + grid.center().u;
  gains.channel.resize(static_cast<std::size_t>(grid.count()) * channels);
  gains.overall.resize(grid.count());
  for (int quantity = 0; quantity <= channels; ++quantity) {
    const std::vector<Ratio>& ratios = all[quantity];
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
