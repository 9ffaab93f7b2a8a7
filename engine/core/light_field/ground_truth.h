// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/disparity_field.h"
#include "engine/core/light_field/high_res_truth.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>

namespace episcope {

/// The ground truth of a light field, kept apart from it so that no estimator can see it. Every
/// part may be missing. Parts cover all views or the centre view only.
struct GroundTruth {
  DisparityField field;  ///< Disparity; `valid` holds the archive's GT_DEPTH_MASK and finiteness.
  DisparityField foreground;       ///< Of transparent scenes: the surface,
  DisparityField background;       ///< and what is seen through it.
  ViewStack<std::int32_t> labels;  ///< Object label per pixel (GT_LABELS, object ids).
  /// Region masks by name ("discontinuities", "planes", …), centre view, non-zero = inside; those
  /// whose parts are numbered (`is_numbered_region`) hold the numbers.
  std::map<std::string, Image<std::uint8_t>> regions;
  HighResTruthPtr high_res{};  ///< Of the centre view; null = there is none.
  /// Which scene of the 2016 benchmark this is, as far as its files say so.
  StratifiedScene stratified = StratifiedScene::None;

  [[nodiscard]] bool has_disparity() const { return !field.empty(); }
  [[nodiscard]] bool has_layers() const { return !foreground.empty() && !background.empty(); }
};

/// Whether the mask of this name tells parts of a scene of the 2016 benchmark apart by numbers.
[[nodiscard]] inline bool is_numbered_region(const std::string& name) {
  return name == "boxes" || name == "dots_by_size" || name == "vertical_bins";
}

using GroundTruthPtr = std::shared_ptr<const GroundTruth>;

}  // namespace episcope
