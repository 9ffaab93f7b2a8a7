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

namespace {

constexpr QuantityInfo kQuantities[] = {
    {.quantity = Quantity::View,
     .id = "view",
     .button = "None",
     .label = "none",
     .tip = "Shows the view alone",
     .unit = "",
     .color_map = "grey",
     .subject = Subject::LightField},
    {.quantity = Quantity::Disparity,
     .id = "disparity",
     .button = "Disparity",
     .label = "disparity",
     .tip = "Shows the disparity of the result over the view",
     .unit = "px",
     .color_map = "viridis",
     .subject = Subject::Result,
     .rule = RangeRule::Disparity},
    {.quantity = Quantity::Second,
     .id = "second",
     .button = "Second",
     .label = "second disparity",
     .tip = "Shows another disparity that pixels beside silhouettes may have",
     .unit = "px",
     .color_map = "viridis",
     .subject = Subject::Result,
     .rule = RangeRule::Disparity,
     .has_button = false},
    {.quantity = Quantity::Background,
     .id = "background",
     .button = "Background",
     .label = "background",
     .tip = "Shows the disparity of the background seen through a surface",
     .unit = "px",
     .color_map = "viridis",
     .subject = Subject::Result,
     .rule = RangeRule::Disparity},
    {.quantity = Quantity::Layers,
     .id = "layers",
     .button = "Layers",
     .label = "layers",
     .tip = "Shows where one surface is visible and where two are",
     .unit = "",
     .color_map = "magma",
     .subject = Subject::Result,
     .rule = RangeRule::Fixed,
     .range = {0, 3}},
    {.quantity = Quantity::Confidence,
     .id = "confidence",
     .button = "Confidence",
     .label = "confidence",
     .tip = "Shows the confidence of the method, from 0 to 1",
     .unit = "",
     .color_map = "magma",
     .subject = Subject::Result,
     .rule = RangeRule::Fixed,
     .range = {0, 1}},
    {.quantity = Quantity::Truth,
     .id = "truth",
     .button = "Truth",
     .label = "truth",
     .tip = "Shows the true disparity",
     .unit = "px",
     .color_map = "viridis",
     .subject = Subject::Truth,
     .rule = RangeRule::Disparity},
    {.quantity = Quantity::TruthBackground,
     .id = "truth_background",
     .button = "Truth behind",
     .label = "true background",
     .tip = "Shows the true disparity of the background seen through a surface",
     .unit = "px",
     .color_map = "viridis",
     .subject = Subject::Truth,
     .rule = RangeRule::Disparity,
     .has_button = false},
    {.quantity = Quantity::SignedError,
     .id = "error",
     .button = "Error",
     .label = "signed error",
     .tip = "Shows truth − estimate: blue is too near, red too far",
     .unit = "px",
     .color_map = "seismic",
     .subject = Subject::Error,
     .rule = RangeRule::Fixed,
     .range = {-0.2, 0.2}},
    {.quantity = Quantity::AbsoluteError,
     .id = "absolute_error",
     .button = "|Error|",
     .label = "absolute error",
     .tip = "Shows the magnitude of the error",
     .unit = "px",
     .color_map = "ylorrd",
     .subject = Subject::Error,
     .rule = RangeRule::Fixed,
     .range = {0, 0.1}},
    // Values of 0.2 (good) and 1 (bad), as `bad_pixel_map` gives them.
    {.quantity = Quantity::BadPixels,
     .id = "bad_pixels",
     .button = "Bad",
     .label = "bad pixels",
     .tip = "Shows the pixels that are off by more than the threshold, 0.07 px at first",
     .unit = "",
     .color_map = "rdylgn_r",
     .subject = Subject::Error,
     .rule = RangeRule::Fixed,
     .range = {0, 1}},
    {.quantity = Quantity::TrueLabels,
     .id = "labels",
     .button = "Labels",
     .label = "labels",
     .tip = "Shows the true object labels",
     .unit = "",
     .color_map = "grey",
     .subject = Subject::TrueLabels},
    {.quantity = Quantity::Segmentation,
     .id = "segmentation",
     .button = "Segments",
     .label = "segmentation",
     .tip = "Shows the segmentation over the view, or hides it",
     .unit = "",
     .color_map = "grey",
     .subject = Subject::Segmentation},
    {.quantity = Quantity::Probability,
     .id = "probability",
     .button = "Probability",
     .label = "probability",
     .tip = "Shows the probability of the current label",
     .unit = "",
     .color_map = "magma",
     .subject = Subject::Segmentation,
     .rule = RangeRule::Fixed,
     .range = {0, 1}},
    {.quantity = Quantity::Uncertainty,
     .id = "uncertainty",
     .button = "Uncertainty",
     .label = "uncertainty",
     .tip = "Shows how uncertain the labels are",
     .unit = "",
     .color_map = "magma",
     .subject = Subject::Segmentation,
     .rule = RangeRule::Fixed,
     .range = {0, 1}},
    {.quantity = Quantity::Edges,
     .id = "edges",
     .button = "Edges",
     .label = "edge probability",
     .tip = "Shows where label boundaries are cheap",
     .unit = "",
     .color_map = "magma",
     .subject = Subject::Segmentation,
     .rule = RangeRule::Fixed,
     .range = {0, 1}},
    // In the colors of bad pixels.
    {.quantity = Quantity::WrongLabels,
     .id = "wrong_labels",
     .button = "Wrong",
     .label = "wrong labels",
     .tip = "Shows the pixels whose label is not the true one",
     .unit = "",
     .color_map = "rdylgn_r",
     .subject = Subject::Segmentation,
     .rule = RangeRule::Fixed,
     .range = {0, 1}},
    {.quantity = Quantity::Difference,
     .id = "difference",
     .button = "Difference",
     .label = "difference",
     .tip = "Shows the current result minus the compared one",
     .unit = "px",
     .color_map = "seismic",
     .subject = Subject::ResultPair,
     .rule = RangeRule::Fixed,
     .range = {-0.2, 0.2}},
};

}  // namespace

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
