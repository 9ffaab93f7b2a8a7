// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/disparity_field.h"
#include "engine/core/parameter/parameter.h"

#include <memory>
#include <string>
#include <vector>

namespace episcope {

/// A second and further results of a method that estimates layers (transparent scenes).
struct LayeredDisparity {
  DisparityField foreground;
  DisparityField background;
  ViewStack<std::uint8_t> layers;  ///< 1 or 2 surfaces per pixel; 0 = unknown.
};

/// A disparity estimate with all it takes to repeat it. Covers all views or one.
struct Estimate {
  DisparityField field;
  ViewStack<float> confidence;  ///< In [0, 1], shape of `field.disparity`; empty = unknown.
  LayeredDisparity layered;     ///< Empty unless the method estimates two layers.

  std::string method;             ///< Id as in `episcope-cli methods`; of foreign results any name.
  ParameterSet parameters;        ///< Every parameter of the method with the value used.
  Interval range{};               ///< Disparity range searched, px per view step; {0, 0} = unknown.
  double seconds = 0;             ///< Wall-clock time; 0 = unknown.
  std::string version;            ///< Of Episcope.
  std::string source;             ///< Path or name of the light field.
  std::uint64_t source_hash = 0;  ///< LightField::sample_hash, 0 = unknown.
  std::vector<std::string> notes;  ///< What a user should know of this run: gap, unsolved views.

  [[nodiscard]] bool contains(ViewIndex view) const { return field.contains(view); }
};

using EstimatePtr = std::shared_ptr<const Estimate>;

}  // namespace episcope
