// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/view_gain.h"

#include "engine/core/finding.h"
#include "engine/core/numbers.h"
#include "engine/core/parallel.h"
#include "engine/core/view_stack.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <type_traits>
#include <utility>
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

// Two neighboring views: what a block of the one shows stands some px along `way` in the other.
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

// What two neighboring views say of a quantity: the logarithm of their ratio, and how surely.
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

// First values: along the ratios from the center outwards. NaN for views that none reaches.
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

// Least squares of all ratios with the center at 0, by Gauss and Seidel.
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

// Means of views that differ by less speak for gains that do, too.
constexpr double kNotableMeans = 0.01;
constexpr int kPixelStep = 8;  // of the means
constexpr double kUnlikelyMeans = 0.005;

template <class T>
double mean_of(const ViewStack<T>& stack, ViewIndex index) {
  const auto view = stack.view(index);
  double sum = 0;
  int count = 0;
  for (int y = kPixelStep / 2; y < view.height; y += kPixelStep) {
    for (int x = kPixelStep / 2; x < view.width; x += kPixelStep, ++count) {
      for (int c = 0; c < view.channels; ++c) sum += view.at(y, x, c);
    }
  }
  return count > 0 ? sum / count : 0;
}

// Root mean square of log gains against the mean of the views on both sides, as a multiple of
// what independent gains have: objects that come into views change their means steadily.
double unsteadiness(const PhotometricCorrection& correction) {
  double sum = 0;
  int count = 0;
  const GridShape grid = correction.grid;
  for (int i = 0; i < grid.count(); ++i) {
    if (i % grid.u == 0 || i % grid.u == grid.u - 1) continue;
    for (int c = 0; c < 3; ++c, ++count) {
      const auto log = [&](int view) { return std::log(correction.gains[view][c]); };
      const double off = log(i) - 0.5 * (log(i - 1) + log(i + 1));
      sum += off * off / 1.5;
    }
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

// Of a view to another, `here`, over the pixels that are valid in both; 1 where nothing is known.
std::array<double, 3> ratios_of_means(const LightField& lf, ViewIndex view, ViewIndex reference,
                                      const Image<float>& here) {
  const Image<float> there = lf.view_as_float(view);
  std::array<double, 3> sums{}, sums_here{}, gains{1, 1, 1};
  for (int y = 0; y < lf.height(); ++y) {
    for (int x = 0; x < lf.width(); ++x) {
      if (!lf.is_valid(view, y, x) || !lf.is_valid(reference, y, x)) continue;
      for (int c = 0; c < lf.channels(); ++c) {
        sums[c] += there.at(y, x, c);
        sums_here[c] += here.at(y, x, c);
      }
    }
  }
  for (int c = 0; c < lf.channels(); ++c) {
    if (sums[c] > 0 && sums_here[c] > 0) gains[c] = sums[c] / sums_here[c];
  }
  if (lf.channels() == 1) gains.fill(gains[0]);
  return gains;
}

bool keeps_brightness(const LightField& lf) {
  const ParameterValue* const kept = lf.info().reading.find(kKeepBrightness);
  return kept != nullptr && std::get<bool>(*kept);
}

// In memory or on disk, as it fits.
template <class T>
ViewStack<T> copied(const ViewStack<T>& stack, const Progress& progress) {
  ViewStack<T> copy(stack.grid(), stack.height(), stack.width(), stack.channels());
  parallel_for(stack.grid().count(), progress, [&](int i) {
    const ViewIndex view = stack.grid().view_at(i);
    std::copy_n(stack.view(view).data, stack.view_size(), copy.view(view).data);
    forget_view(stack, view);
    forget_view(copy, view);
  });
  return copy;
}

std::optional<EvenLightField> make_even(const LightField& lf, const Progress& progress) {
  if (lf.grid().count() < 2 || keeps_brightness(lf) || !have_notable_means(lf, progress)) return {};
  const auto blocks = has_many_views(lf.grid()) ? GainBlocks::OneOfFour : GainBlocks::All;
  const PhotometricCorrection correction =
      measure_view_gains(lf.samples(), lf.valid(), progress.part(0, 0.4), blocks);
  lf.forget_samples();
  if (!correction.is_notable()) return {};
  LightField::Samples samples = std::visit(
      [&](const auto& stack) {
        return LightField::Samples(copied(stack, progress.part(0.4, 0.7)));
      },
      lf.samples());
  divide_by_gains(samples, correction, progress.part(0.7, 1));
  const double difference = std::abs(correction.of(correction.most_different()) - 1);
  return EvenLightField{LightField(std::move(samples), lf.info(), lf.valid().clone()),
                        fmt::format(finding_text("run.evened"), 100 * difference)};
}

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

PhotometricCorrection measure_view_gains(const LightField::Samples& samples,
                                         const ViewStack<std::uint8_t>& valid,
                                         const Progress& progress, GainBlocks blocks) {
  const GridShape grid = grid_of(samples);
  const int channels = std::visit([](const auto& stack) { return stack.channels(); }, samples);
  const Ratios all = find_ratios(samples, valid, progress, blocks);
  const int center = grid.center().v * grid.u + grid.center().u;
  PhotometricCorrection correction{.grid = grid};
  correction.gains.resize(grid.count());
  correction.overall.resize(grid.count());
  for (int quantity = 0; quantity <= channels; ++quantity) {
    const std::vector<Ratio>& ratios = all[quantity];
    std::vector<double> logs = spread_from(center, grid.count(), ratios);
    settle(center, ratios, logs);
    for (int i = 0; i < grid.count(); ++i) {
      double& gain = quantity < channels ? correction.gains[i][quantity] : correction.overall[i];
      gain = std::exp(logs[i]);
    }
  }
  if (channels == 1) {
    for (auto& gain : correction.gains) gain.fill(gain[0]);
  }
  return correction;
}

bool have_notable_means(const LightField& lf, const Progress& progress) {
  return std::visit(
      [&](const auto& stack) {
        const double center = mean_of(stack, lf.center());
        for (int i = 0; i < lf.grid().count(); ++i) {
          progress.check();
          // The disk reads while the view before is looked at.
          if (i + 1 < lf.grid().count()) lf.fetch_samples(lf.grid().view_at(i + 1), 0, lf.height());
          const double mean = mean_of(stack, lf.grid().view_at(i));
          forget_view(stack, lf.grid().view_at(i));
          if (!(std::abs(mean - center) <= kNotableMeans * center)) return true;
        }
        return false;
      },
      lf.samples());
}

PhotometricCorrection gains_of_means(const LightField& lf, ViewIndex reference,
                                     const Progress& progress) {
  const GridShape grid = lf.grid();
  PhotometricCorrection correction{.grid = grid};
  correction.gains.assign(grid.count(), {1, 1, 1});
  const Image<float> here = lf.view_as_float(reference);
  parallel_for(grid.count(), progress, [&](int i) {
    correction.gains[i] = ratios_of_means(lf, grid.view_at(i), reference, here);
    lf.forget_samples();
  });
  if (unsteadiness(correction) < kUnlikelyMeans) {
    correction.gains.assign(grid.count(), {1, 1, 1});
  }
  return correction;
}

std::shared_ptr<const EvenLightField> EvenViews::of(const LightField& lf,
                                                    const Progress& progress) {
  const std::lock_guard lock(lock_);
  if (measured_ == lf.identity()) return even_;
  std::optional<EvenLightField> made = make_even(lf, progress);
  even_ = made ? std::make_shared<const EvenLightField>(*std::move(made)) : nullptr;
  const bool is_in_memory = even_ && !even_->light_field.is_on_disk();
  bytes_ = is_in_memory ? even_->light_field.byte_size() : 0;
  measured_ = lf.identity();
  return even_;
}

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
