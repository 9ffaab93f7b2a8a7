// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/common/disparity_range.h"

#include "engine/disparity/common/label_support.h"
#include "engine/disparity/common/matching_cost.h"
#include "engine/disparity/common/orientation_histogram.h"
#include "engine/disparity/common/smaller_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

namespace episcope {
namespace {

// The range begins and ends where this share of the coherent pixels lies close together.
constexpr double kTail = 0.002;
// The same of smaller views, whose noise is smaller and whose ends are less exact.
constexpr double kSmallTail = 0.006;
// Labels at which pixels are matched, and how far they go beyond the orientations seen.
constexpr double kLabelStep = 0.25;
constexpr double kBeyond = 1.5;
// Orientations count where this share of the distinctly matching pixels does so within `kNear`.
constexpr double kSupport = 0.002;
constexpr double kNear = 0.65;
// What is taken off the ends that smaller views give, pixels of theirs.
constexpr double kInexact = 0.15;
// No range found reaches farther, px per view step.
constexpr double kMaxDisparity = 16;

// Leaves out orientations that hardly any pixel confirms by matching: aliases of repeated patterns
// and of noise.
void clear_unsupported(const LightField& lf, Interval seen, OrientationHistogram& histogram,
                       const Progress& progress) {
  const Interval range{seen.min - kBeyond, seen.max + kBeyond};
  const int count = static_cast<int>(std::ceil(range.length() / kLabelStep)) + 1;
  const std::vector<float> labels = equidistant_labels(range, count);
  const std::vector<double> support = label_support(lf, labels, progress);
  // All is one repeated pattern: nothing tells which of its orientations are true.
  if (std::ranges::all_of(support, [](double share) { return share == 0; })) return;
  for (int cell = 0; cell < histogram.size(); ++cell) {
    double sum = 0;
    for (int l = 0; l < count; ++l) {
      if (std::fabs(labels[l] - histogram.middle(cell)) <= kNear) sum += support[l];
    }
    if (sum < kSupport) histogram.clear(cell);
  }
}

// None if hardly anything is seen or nothing of it is confirmed.
std::optional<Interval> confirmed_range(const LightField& lf, double limit, double tail,
                                        const Progress& progress) {
  OrientationHistogram histogram(lf, limit, progress.part(0, 0.8));
  constexpr double least = 100;
  if (histogram.total() < least) return {};
  const std::optional<Interval> seen = histogram.ends(tail);
  if (!seen) return {};
  clear_unsupported(lf, *seen, histogram, progress.part(0.8, 1));
  return histogram.ends(tail);
}

// Smaller views show what noise and blur hide, but their ends are less exact.
std::optional<Interval> range_of_smaller_views(const LightField& lf, int factor, double limit,
                                               const Progress& progress) {
  constexpr int least = 48;
  if (std::min(lf.height(), lf.width()) < least * factor) return {};
  const LightField smaller = smaller_views(lf, factor, progress.part(0, 0.2));
  const std::optional<Interval> found =
      confirmed_range(smaller, limit / factor, kSmallTail, progress.part(0.2, 1));
  if (!found) return {};
  const double inset = kInexact * factor;
  return Interval{factor * found->min + inset, factor * found->max - inset};
}

// The range found last, for runs that follow on the same light field: nothing else decides it.
class KeptRange {
 public:
  template <class Find>
  Interval of(const LightField& lf, const Find& find) {
    {
      const std::lock_guard lock(mutex_);
      if (identity_ == lf.identity()) return range_;
    }
    const Interval found = find();
    const std::lock_guard lock(mutex_);
    identity_ = lf.identity();
    return range_ = found;
  }

 private:
  std::mutex mutex_;
  std::uint64_t identity_ = 0;
  Interval range_;
};

// An end that is hardly farther out is the same end, less exact.
Interval widened(Interval range, Interval coarse) {
  constexpr double worth = 0.25;
  if (coarse.min < range.min - worth) range.min = coarse.min;
  if (coarse.max > range.max + worth) range.max = coarse.max;
  return range;
}

}  // namespace

// The largest disparity whose neighbouring views still share most of the image.
double farthest_found(const LightField& lf) {
  const int along = std::min(lf.grid().u > 1 ? lf.width() : lf.height(),
                             lf.grid().v > 1 ? lf.height() : lf.width());
  return std::clamp(along / 6.0, 2.0, kMaxDisparity);
}

std::string limited_range_note(const LightField& lf, Interval range) {
  constexpr double near = 0.25;  // the width in which pixels are counted, and a little
  const double limit = farthest_found(lf);
  if (range.min > near - limit && range.max < limit - near) return {};
  return fmt::format(
      "the disparity range found, {:.2f} … {:.2f} px, ends where the search does, at ±{:.2f} px: "
      "the scene may reach farther; give a range to search it",
      range.min, range.max, limit);
}

Interval find_disparity_range(const LightField& lf, const Progress& progress) {
  const double limit = farthest_found(lf);
  std::optional<Interval> found = confirmed_range(lf, limit, kTail, progress.part(0, 0.6));
  for (const int factor : {2, 4}) {
    const Progress part = factor == 2 ? progress.part(0.6, 0.85) : progress.part(0.85, 1);
    const std::optional<Interval> coarse = range_of_smaller_views(lf, factor, limit, part);
    if (!coarse) continue;
    found = found ? widened(*found, *coarse) : *coarse;
  }
  return found.value_or(Interval{-1, 1});
}

RangeSource range_source(const LightField& lf, const IntervalOrAuto& wanted) {
  if (wanted) return RangeSource::Given;
  const bool is_promised = !wanted.is_found && lf.info().disparity_range;
  return is_promised ? RangeSource::Promised : RangeSource::Found;
}

std::string found_range_note(Interval range) {
  return fmt::format("disparity range {:.2f} … {:.2f} px, found from the images", range.min,
                     range.max);
}

Interval search_range(const LightField& lf, const IntervalOrAuto& wanted,
                      const Progress& progress) {
  const RangeSource source = range_source(lf, wanted);
  if (source == RangeSource::Given) return *wanted;
  if (source == RangeSource::Promised) return *lf.info().disparity_range;
  static KeptRange kept;
  return kept.of(lf, [&] {
    progress.step("disparity range");
    return find_disparity_range(lf, progress);
  });
}

}  // namespace episcope
