// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"

#include <cstdint>
#include <span>
#include <string>

namespace episcope::render {

/// The quantities that a picture of a view can show.
enum class Quantity : std::uint8_t {
  View,
  Disparity,
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
  bool has_button =
      true;  ///< Whether it is frequent enough for a button; else it is in menus only.

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
