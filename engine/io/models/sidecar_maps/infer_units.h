// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/camera_grid.h"
#include "engine/core/disparity_field.h"
#include "engine/core/light_field.h"
#include "engine/core/scene.h"
#include "engine/io/models/order/order_check.h"
#include "engine/io/models/sidecar_maps/disparity_units.h"

#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Relation of the numbers of a map: proportional to disparity, or to depth.
enum class ValueForm { Linear, Inverse };

/// Meaning of the numbers of a map of unknown unit, fitted to the views: d = `scale` · value +
/// `offset`, or `scale` / value + `offset`, in px per view step.
struct FittedMeaning {
  ValueForm form = ValueForm::Linear;
  double scale = 0;
  double offset = 0;
  double error = 0;              ///< Mean grey error of the next views, warped by it,
  double unwarped = 0;           ///< and as they are.
  std::string text;              ///< "d = value/100 px per view step",
  std::string check;             ///< and the evidence.
  bool is_sign_assumed = false;  ///< Nothing tells near from far.

  /// NaN where a depth is not positive.
  [[nodiscard]] float disparity(float value) const;
  /// Camera of a map of depth; unknown for other maps.
  [[nodiscard]] CameraGrid camera() const;
  /// A sentence that says that the truth rests on a fit.
  [[nodiscard]] std::string warning(const std::string& name) const;
};

/// Stored disparity values, called `name` in the report.
struct NamedValues {
  DisparityField& field;
  std::string name;

  /// View by which the others are judged.
  [[nodiscard]] ViewIndex at(GridShape grid) const;
};

/// Multiplies the values of all views.
void scale_values(DisparityField& field, double factor);

/// Determines the unit of a disparity from the views (`settle_unit`). If no unit explains them well
/// and a fitted scale and offset do clearly better, applies the fit to the field, adds a warning,
/// and returns px as the unit. Marks zeros that stand for unknown as invalid. Precondition: `units`
/// is not empty.
[[nodiscard]] SettledUnit infer_units(const LightField::Samples& samples,
                                      const std::vector<MapUnit>& units, NamedValues values,
                                      ConventionReport& report);

/// Turns values of any of these forms and of any scale into disparity, and continues the report.
/// Returns nothing and keeps the field if the views do not tell the meaning of the values.
[[nodiscard]] std::optional<FittedMeaning> infer_unknown_units(const LightField::Samples& samples,
                                                               const std::vector<ValueForm>& forms,
                                                               NamedValues values,
                                                               ConventionReport& report);

/// Values by which programs mark unknown pixels: 0, −1, and the largest and the smallest value
/// (65535, 1e10, −999). Only values that many pixels have exactly.
[[nodiscard]] std::vector<float> possible_unknown_values(const DisparityView& map);

/// Value that may mark unknown pixels.
struct UnknownValue {
  float stored = 0;   ///< By the file,
  float value = 0;    ///< and in the map,
  double factor = 1;  ///< whose values times this are px.
};

/// Marks pixels of exactly this value as invalid, in all views, if hardly any other value is near
/// it and the neighbors of view `at` contradict these pixels but agree with the rest. Values other
/// than 0 must not agree better than without warping. Isolated zeros become invalid if the values
/// around them explain the views better. Returns the end of a warning, after the name of the map,
/// also where the views do not tell; or nothing. Linear in the pixels but for sorting values.
[[nodiscard]] std::string drop_unknown_value(const LightField::Samples& samples, ViewIndex at,
                                             const UnknownValue& unknown, DisparityField& field);

}  // namespace episcope::io
