// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/light_field.h"
#include "engine/core/scene.h"
#include "engine/io/models/order/order_check.h"
#include "engine/io/models/sidecar_maps/disparity_units.h"

#include <string>
#include <vector>

namespace episcope::io {

/// Stored disparity values, called `name` in the report.
struct NamedValues {
  DisparityField& field;
  std::string name;

  /// View by which the others are judged.
  [[nodiscard]] ViewIndex at(GridShape grid) const;
};

/// Multiplies the values of all views.
void scale_values(DisparityField& field, double factor);

/// Determines the unit of a disparity from the views (`settle_unit`). Turns maps that were stored
/// in another order of pixels back (`possible_turns`), with a warning. Marks values that stand for
/// unknown as invalid. Precondition: `units` is not empty.
[[nodiscard]] SettledUnit infer_units(const LightField::Samples& samples,
                                      const std::vector<MapUnit>& units, NamedValues values,
                                      ConventionReport& report);

/// Values by which programs mark unknown pixels: 0, −1, and the largest and the smallest value
/// (65535, 1e10, −999). Only values that many pixels have exactly.
[[nodiscard]] std::vector<float> possible_unknown_values(const DisparityView& map);

/// Value that may mark unknown pixels.
struct UnknownValue {
  float value = 0;    ///< In the map,
  double factor = 1;  ///< whose values times this are px.
};

/// Marks pixels of exactly this value as invalid, in all views, if hardly any other value is near
/// it and the neighbors of view `at` contradict these pixels but agree with the rest. Values other
/// than 0 must not agree better than without warping. Returns the end of a warning, after the name
/// of the map, or nothing. Linear in the pixels.
[[nodiscard]] std::string drop_unknown_value(const LightField::Samples& samples, ViewIndex at,
                                             const UnknownValue& unknown, DisparityField& field);

}  // namespace episcope::io
