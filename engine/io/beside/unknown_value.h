// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"
#include "engine/core/light_field/disparity_field.h"
#include "engine/core/light_field/light_field.h"

#include <cstdint>
#include <string>
#include <vector>

namespace episcope::io {

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
