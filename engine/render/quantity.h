// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/indices.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace episcope::render {

/// A map whose numbers are summed up.
struct MeasuredMap {
  ImageView<const float> values;
  ImageView<const std::uint8_t> valid;   ///< 0 = no value; empty = all valid.
  ImageView<const std::uint8_t> inside;  ///< 0 = does not count at all; empty = all count.
};

/// How often values of a part of an axis occur; what lies beside the axis is left out.
struct Histogram {
  Interval axis{};
  std::vector<std::uint32_t> counts;  ///< Of equal parts of the axis, from its lower end.
};

/// Statistics of a part of a map. All numbers are 0 and there are no counts without a valid pixel.
struct RegionStatistics {
  std::size_t count = 0;    ///< Pixels with a value.
  std::size_t invalid = 0;  ///< Pixels without, NaN among them.
  double min = 0;
  double median = 0;
  double mean = 0;
  double max = 0;
  Interval robust{};  ///< From the 1 % to the 99 % quantile: the automatic range.
  Histogram histogram;
};

/// Sums up a part of a map, which is clipped to the map. The axis of the histogram spans `shown`
/// and the quantiles of 0.2 % and 99.8 %, with a little room on both sides. So a few outliers do
/// not squeeze all else into one bar. Linear in the region; 590 000 pixels take about 15 ms, so it
/// is for a worker.
[[nodiscard]] RegionStatistics region_statistics(const MeasuredMap& map, PixelRect region,
                                                 Interval shown, int bars);

/// The quantities that a picture of a view can show.
enum class Quantity : std::uint8_t {
  View,
  Disparity,
  Second,      ///< Another disparity that a pixel may have.
  Background,  ///< Disparity of the background seen through a surface.
  Layers,      ///< Number of surfaces, 1 or 2.
  Confidence,
  Truth,
  TruthBackground,  ///< Of transparent scenes: the background seen through the surface.
  SignedError,
  AbsoluteError,
  BadPixels,
  TrueLabels,
  Segmentation,  ///< Labels learnt from scribbles.
  Probability,   ///< Of one label.
  Uncertainty,   ///< How undecided labels are.
  Edges,         ///< How probable an edge is.
  WrongLabels,   ///< Where the segmentation differs from the ground truth.
  Difference     ///< Of two disparities.
};

/// Object that a quantity describes.
enum class Subject : std::uint8_t {
  LightField,
  Truth,
  TrueLabels,
  Result,       ///< A disparity estimate.
  Error,        ///< An estimate judged against the truth.
  ResultPair,   ///< Two estimates.
  Segmentation  ///< Labels learnt from scribbles; Edges need none.
};

/// Rule for the ends of the color range.
enum class RangeRule : std::uint8_t {
  None,       ///< There are no numbers: samples or labels in colors of their own.
  Disparity,  ///< The disparities of the scene, whatever the method.
  Fixed       ///< `QuantityInfo::range`.
};

/// All that tool bars, menus, color bars, command lines, tiles and exported pictures know of a
/// quantity. Invalid pixels have the color ColorMap::invalid.
struct QuantityInfo {
  Quantity quantity;
  const char* id;      ///< As on the command line: `show --what error`. Also names commands.
  const char* button;  ///< As on a button: "Error".
  const char* label;   ///< As in a sentence: "signed error".
  const char* tip;     ///< One sentence, in the imperative third person, for tool tips.
  const char* unit;    ///< "px"; empty for pure numbers.
  const char* color_map;
  Subject subject;
  RangeRule rule = RangeRule::None;
  Interval range{};  ///< For RangeRule::Fixed.

  [[nodiscard]] bool has_scale() const { return rule != RangeRule::None; }
  /// Whether zero belongs in the middle of the colors.
  [[nodiscard]] bool is_signed() const { return rule == RangeRule::Fixed && range.min < 0; }
};

/// Every quantity, in the order of lists.
[[nodiscard]] std::span<const QuantityInfo> quantities();

/// The row of a quantity.
[[nodiscard]] const QuantityInfo& info_of(Quantity quantity);

/// The row with this id; null for an unknown one.
[[nodiscard]] const QuantityInfo* find_quantity(const std::string& id);

}  // namespace episcope::render
