// SPDX-License-Identifier: BSD-3-Clause
#include "engine/render/quantity.h"

#include "engine/core/numbers.h"

#include <algorithm>
#include <cmath>

namespace episcope::render {
namespace {

constexpr double kAxisQuantile = 0.002;
constexpr double kRobustQuantile = 0.01;
constexpr double kAxisRoom = 0.03;  // part of the axis that stays free on each side

PixelRect clipped(const PixelRect& region, int height, int width) {
  return {std::max(0, region.y0), std::max(0, region.x0), std::min(height, region.y1),
          std::min(width, region.x1)};
}

std::vector<float> values_in(const MeasuredMap& map, const PixelRect& region,
                             std::size_t& invalid) {
  std::vector<float> values;
  const int rows = std::max(0, region.y1 - region.y0);
  const int columns = std::max(0, region.x1 - region.x0);
  values.reserve(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
  for (int y = region.y0; y < region.y1; ++y) {
    const float* row = map.values.row(y);
    const std::uint8_t* valid = map.valid.empty() ? nullptr : map.valid.row(y);
    const std::uint8_t* inside = map.inside.empty() ? nullptr : map.inside.row(y);
    for (int x = region.x0; x < region.x1; ++x) {
      if (inside && inside[x] == 0) continue;
      if ((valid && valid[x] == 0) || !std::isfinite(row[x])) {
        ++invalid;
      } else {
        values.push_back(row[x]);
      }
    }
  }
  return values;
}

Histogram histogram_of(const std::vector<float>& values, Interval axis, int bars) {
  if (axis.length() <= 0) axis = {axis.min - 0.5, axis.min + 0.5};
  const double room = kAxisRoom * axis.length();
  Histogram histogram{{axis.min - room, axis.max + room},
                      std::vector<std::uint32_t>(static_cast<std::size_t>(bars))};
  const double scale = bars / histogram.axis.length();
  for (const float value : values) {
    const double place = std::floor((value - histogram.axis.min) * scale);
    if (place >= 0 && place < bars) ++histogram.counts[static_cast<std::size_t>(place)];
  }
  return histogram;
}

// Ranges that belong to quantities.
constexpr Interval kShares{0, 1}, kErrors{-0.2, 0.2}, kSizes{0, 0.1}, kLayerCounts{0, 3};

constexpr QuantityInfo kQuantities[] = {
    // Id, button, label, tip, unit, color map, subject, and how the range is found.
    {Quantity::View, "view", "None", "none", "Shows the view alone", "", "grey",
     Subject::LightField},
    {Quantity::Disparity, "disparity", "Disparity", "disparity",
     "Shows the disparity of the result over the view", "px", "viridis", Subject::Result,
     RangeRule::Disparity},
    {Quantity::Second, "second", "Second", "second disparity",
     "Shows another disparity that pixels beside silhouettes may have", "px", "viridis",
     Subject::Result, RangeRule::Disparity},
    {Quantity::Background, "background", "Background", "background",
     "Shows the disparity of the background seen through a surface", "px", "viridis",
     Subject::Result, RangeRule::Disparity},
    {Quantity::Layers, "layers", "Layers", "layers",
     "Shows where one surface is visible and where two are", "", "magma", Subject::Result,
     RangeRule::Fixed, kLayerCounts},
    {Quantity::Confidence, "confidence", "Confidence", "confidence",
     "Shows the confidence of the method, from 0 to 1", "", "magma", Subject::Result,
     RangeRule::Fixed, kShares},
    {Quantity::Truth, "truth", "Ground truth", "ground truth", "Shows the true disparity", "px",
     "viridis", Subject::Truth, RangeRule::Disparity},
    {Quantity::TruthBackground, "truth_background", "True background", "true background",
     "Shows the true disparity of the background seen through a surface", "px", "viridis",
     Subject::Truth, RangeRule::Disparity},
    {Quantity::SignedError, "error", "Error", "signed error",
     "Shows truth − estimate: blue is too near, red too far", "px", "seismic", Subject::Error,
     RangeRule::Fixed, kErrors},
    {Quantity::AbsoluteError, "absolute_error", "|Error|", "absolute error",
     "Shows the magnitude of the error", "px", "ylorrd", Subject::Error, RangeRule::Fixed, kSizes},
    // Values of 0.2 (good) and 1 (bad), as `bad_pixel_map` gives them.
    {Quantity::BadPixels, "bad_pixels", "Bad pixels", "bad pixels",
     "Shows the pixels that are off by more than the threshold, 0.07 px at first", "", "rdylgn_r",
     Subject::Error, RangeRule::Fixed, kShares},
    {Quantity::TrueLabels, "labels", "Labels", "labels", "Shows the true object labels", "", "grey",
     Subject::TrueLabels},
    {Quantity::Segmentation, "segmentation", "Segments", "segmentation",
     "Shows the segmentation over the view, or hides it", "", "grey", Subject::Segmentation},
    {Quantity::Probability, "probability", "Probability", "probability",
     "Shows the probability of the current label", "", "magma", Subject::Segmentation,
     RangeRule::Fixed, kShares},
    {Quantity::Uncertainty, "uncertainty", "Uncertainty", "uncertainty",
     "Shows how uncertain the labels are", "", "magma", Subject::Segmentation, RangeRule::Fixed,
     kShares},
    {Quantity::Edges, "edges", "Edges", "edge probability",
     "Shows where label boundaries are cheap", "", "magma", Subject::Segmentation, RangeRule::Fixed,
     kShares},
    // In the colors of bad pixels.
    {Quantity::WrongLabels, "wrong_labels", "Wrong", "wrong labels",
     "Shows the pixels whose label is not the true one", "", "rdylgn_r", Subject::Segmentation,
     RangeRule::Fixed, kShares},
    {Quantity::Difference, "difference", "Difference", "difference",
     "Shows the current result minus the compared one", "px", "seismic", Subject::ResultPair,
     RangeRule::Fixed, kErrors},
};

}  // namespace

RegionStatistics region_statistics(const MeasuredMap& map, PixelRect region, Interval shown,
                                   int bars) {
  region = clipped(region, map.values.height, map.values.width);
  RegionStatistics statistics;
  std::vector<float> values = values_in(map, region, statistics.invalid);
  statistics.count = values.size();
  if (values.empty()) return statistics;
  double sum = 0;
  for (const float value : values) sum += value;
  statistics.mean = sum / static_cast<double>(values.size());
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  statistics.min = *least;
  statistics.max = *greatest;
  statistics.median = quantile(values, 0.5);
  statistics.robust = {quantile(values, kRobustQuantile), quantile(values, 1 - kRobustQuantile)};
  Interval axis{quantile(values, kAxisQuantile), quantile(values, 1 - kAxisQuantile)};
  if (shown.length() > 0) {
    axis = {std::min(axis.min, shown.min), std::max(axis.max, shown.max)};
  }
  statistics.histogram = histogram_of(values, axis, bars);
  return statistics;
}

std::span<const QuantityInfo> quantities() {
  return kQuantities;
}

const QuantityInfo& info_of(Quantity quantity) {
  return *std::ranges::find(kQuantities, quantity, &QuantityInfo::quantity);
}

const QuantityInfo* find_quantity(const std::string& id) {
  const auto* found = std::ranges::find(kQuantities, id, &QuantityInfo::id);
  return found == std::end(kQuantities) ? nullptr : found;
}

}  // namespace episcope::render
