// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/camera_grid.h"
#include "engine/core/light_field/disparity_field.h"
#include "engine/core/light_field/light_field.h"

#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// What the numbers of a map may be: proportional to disparity, or to depth.
enum class ValueForm { Linear, Inverse };

/// d = `scale` · value + `offset`, or `scale` / value + `offset`, in px per view step: what the
/// numbers of a map of unknown unit mean, as the views themselves say.
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
  /// Of a map of depth; unknown otherwise.
  [[nodiscard]] CameraGrid camera() const;
  /// A sentence that says that the truth rests on a fit.
  [[nodiscard]] std::string warning(const std::string& name) const;
};

/// The form, of those to try, that explains how the views next to `at` differ, with scale and
/// offset (`fit_shift`). A scale of one by a round number, with next to no offset, is taken as
/// exactly that. Nothing if no form does.
[[nodiscard]] std::optional<FittedMeaning> fit_meaning(const LightField::Samples& samples,
                                                       ViewIndex at, const DisparityView& map,
                                                       const std::vector<ValueForm>& forms);

/// Turns the values of all views into disparity; where that is none, pixels become invalid.
void apply_meaning(const FittedMeaning& meaning, DisparityField& field);

}  // namespace episcope::io
