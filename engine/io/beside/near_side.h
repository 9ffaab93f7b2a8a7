// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/beside/map_scale.h"

#include <string>

namespace episcope::io {

/// Which values of a disparity map hide the others: where two pixels of a view fall on the same
/// pixel of another view, that one shows the nearer of them.
struct NearSide {
  double larger = 0;   ///< Mean grey error (0 … 255) of the pixels of larger disparity,
  double smaller = 0;  ///< and of those of smaller disparity.
  int points = 0;      ///< Pairs that were compared.

  [[nodiscard]] bool is_decided() const;
  [[nodiscard]] bool larger_is_nearer() const { return larger < smaller; }
};

/// Moves view `at` by the map times `factor` into views up to four steps away, in the order of
/// views that `explanation` found, and compares pairs of clearly different grey. The order alone
/// does not tell near from far: reversing it together with the signs moves every pixel to the same
/// place. Linear in the pixels.
[[nodiscard]] NearSide find_near_side(const LightField::Samples& samples, ViewIndex at,
                                      const DisparityView& map, double factor,
                                      const Explanation& explanation);

/// What the nearer values do, for reports: "hide others in other views (…)".
[[nodiscard]] std::string hiding_text(const NearSide& side);

/// What reports say of values that were negated though nothing hides anything.
inline constexpr const char* kSignByOrder =
    "no depth edges tell near from far: the sign is the one that leaves the views in the order in "
    "which they are stored";

/// Whether larger values of a disparity map are farther, by what hides what. Where that is not
/// decided: whether only that puts the views into the order in which they are stored, since maps of
/// the other sign are more common than views that run backwards along every axis.
[[nodiscard]] bool has_other_sign(const NearSide& side, const Explanation& explanation,
                                  GridShape grid);

}  // namespace episcope::io
