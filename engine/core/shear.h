// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/estimate.h"
#include "engine/core/indices.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"

#include <algorithm>
#include <array>
#include <limits>
#include <type_traits>

namespace episcope {

/// Weights of the samples −1, 0, 1 and 2 for a place `t` in [0, 1) after sample 0 (Keys 1981,
/// a = −1/2).
[[nodiscard]] constexpr std::array<float, 4> cubic_weights(float t) {
  return {((-0.5F * t + 1) * t - 0.5F) * t, (1.5F * t - 2.5F) * t * t + 1,
          ((-1.5F * t + 2) * t + 0.5F) * t, (0.5F * t - 0.5F) * t * t};
}

/// An interpolated value as a sample: integers are clamped to their range, from 0 on, and rounded.
template <class T>
[[nodiscard]] T interpolated_sample(float value) {
  if constexpr (std::is_integral_v<T>) {
    constexpr auto largest = static_cast<float>(std::numeric_limits<T>::max());
    const float above = std::clamp(value, 0.0F, largest) + 0.5F;
    return static_cast<T>(above);
  } else {
    return value;
  }
}

/// Bakes in a focus plane: disparity d becomes d − focus_px, so that points of disparity `focus_px`
/// get 0. View (u, v) is sampled at (x − focus_px·(u − u_c), y − focus_px·(v − v_c)): the center
/// view stays as it is, the others move. Source: refocusing by shear, Ng 2006 [Ng06].
///
/// A shear by whole pixels is exact. Between pixels, samples are interpolated cubically (Keys 1981,
/// a = −1/2) to keep the views sharp; outside the image its border is repeated. All functions are
/// linear in the size.

/// A sample that an invalid pixel entered is invalid. Throws InvalidInput if `focus_px` is not
/// finite or moves a view out of the image; Cancelled.
[[nodiscard]] LightFieldPtr sheared(const LightField& light_field, double focus_px,
                                    const Progress& progress);

/// Disparity minus `focus_px`, moved along with its views. Interpolated linearly within a surface;
/// of the nearest pixel where the four around differ by more than 0.1 px or one is invalid. Invalid
/// where the light field repeats its border. `center` is the center of the light field. Throws
/// Cancelled.
[[nodiscard]] DisparityField sheared(const DisparityField& field, ViewIndex center, double focus_px,
                                     const Progress& progress);

/// Light field, truth, labels and scribbles; the camera's shift and the promised range follow, so
/// that depth stays what it was. Companions are dropped: they keep the former geometry.
/// `ConventionReport::focus_px` adds up. Throws as above.
[[nodiscard]] Scene sheared(const Scene& scene, double focus_px, const Progress& progress);

/// Labels, moved with the views by whole pixels; 0 outside the original view. Throws Cancelled.
[[nodiscard]] ViewStack<std::int32_t> sheared(const ViewStack<std::int32_t>& labels,
                                              ViewIndex center, double focus_px,
                                              const Progress& progress);
[[nodiscard]] Scribbles sheared(const Scribbles& scribbles, ViewIndex center, double focus_px);

/// The inverse for scribbles: transfers what was painted on sheared views to the original views.
/// Outside the sheared views the scribbles `before` are kept, unless their label is gone.
[[nodiscard]] Scribbles unsheared(const Scribbles& scribbles, const Scribbles& before,
                                  ViewIndex center, double focus_px);

/// Transfers an estimate to a sheared light field, whose center is `center` and whose hash is
/// `sample_hash`. The searched range is shifted; a note says so. Throws Cancelled.
struct ShearedInto {
  ViewIndex center;
  std::uint64_t sample_hash = 0;
};
[[nodiscard]] Estimate sheared(const Estimate& estimate, const ShearedInto& into, double focus_px,
                               const Progress& progress);

/// A light field of the pixels `part` of every view, samples in their stored type.
/// Precondition: `part` is not empty and lies within the views. Throws Cancelled.
[[nodiscard]] LightField cropped(const LightField& light_field, const PixelRect& part,
                                 const Progress& progress);

}  // namespace episcope
