// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/camera_grid.h"
#include "engine/core/disparity_field.h"
#include "engine/core/image.h"
#include "engine/core/light_field.h"
#include "engine/core/scene.h"
#include "engine/io/models/order/flipped_truth.h"
#include "engine/io/models/sidecar_maps/disparity_units.h"

#include <cstdint>
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

/// Values of disparity as stored, of which the report speaks as `name`.
struct NamedValues {
  DisparityField& field;
  std::string name;

  /// The view by which the others are judged.
  [[nodiscard]] ViewIndex at(GridShape grid) const;
};

/// Multiplies the values of all views.
void scale_values(DisparityField& field, double factor);

/// The unit of a disparity that explains the views (`settle_unit`). Where none does well, and scale
/// and offset found from the views do clearly better (`fit_meaning`), they are applied to the
/// field, a warning says so, and the unit is px. Zeros that stand for unknown become invalid.
/// Precondition: `units` is not empty.
[[nodiscard]] SettledUnit settle_values(const LightField::Samples& samples,
                                        const std::vector<MapUnit>& units, NamedValues values,
                                        ConventionReport& report);

/// Turns values that may be of any of these forms and of any scale into disparity, and tells the
/// report. Nothing, and the field as it is, if the views do not tell what they mean.
[[nodiscard]] std::optional<FittedMeaning> settle_unknown_values(
    const LightField::Samples& samples, const std::vector<ValueForm>& forms, NamedValues values,
    ConventionReport& report);

/// What the numbers of a map mean that may hold others, too, or be stored in another order of
/// pixels.
struct DoubtfulMeaning {
  FittedMeaning meaning;
  std::optional<MapTurn> turn = std::nullopt;  ///< How the map was stored.
};

/// The map as it is where that explains the views well (`fit_meaning`). Else also without each
/// value that may stand for unknown (`possible_unknown_values`), else also turned back
/// (`possible_turns`); each must explain the views far better than those before.
[[nodiscard]] std::optional<DoubtfulMeaning> fit_doubtful_map(const LightField::Samples& samples,
                                                              ViewIndex at,
                                                              const DisparityView& map,
                                                              const std::vector<ValueForm>& forms);

/// Values by which programs say that nothing is known: 0, −1, and the largest and the smallest one
/// (65535, 1e10, −999); each only if many pixels have just that.
[[nodiscard]] std::vector<float> possible_unknown_values(const DisparityView& map);

/// 1 where the map is valid and has another value, `[y][x]`.
[[nodiscard]] Image<std::uint8_t> valid_without(const DisparityView& map, float value);

/// A value that may stand for unknown.
struct UnknownValue {
  float stored = 0;   ///< By the file,
  float value = 0;    ///< and in the map,
  double factor = 1;  ///< whose values times this are px.
};

/// Marks pixels of exactly this value as invalid, in all views, if hardly any other value is near
/// it and at view `at` the neighbouring views contradict them, though they agree with the rest; of
/// a value other than 0 they must not agree better than without warping. Zeros among other values,
/// many times as many as of any of these, become invalid if the values around them explain the
/// views better there, whatever the noise. Returns what a warning says after the name of the map,
/// also where the views do not tell; or nothing. Linear in the pixels but for sorting values.
[[nodiscard]] std::string drop_unknown_value(const LightField::Samples& samples, ViewIndex at,
                                             const UnknownValue& unknown, DisparityField& field);

}  // namespace episcope::io
