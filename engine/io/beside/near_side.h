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
  double doubt = 0;    ///< Standard error of the difference of these means.

  [[nodiscard]] bool is_decided() const;
  [[nodiscard]] bool larger_is_nearer() const { return larger < smaller; }
};

/// Moves view `at` by the map times `factor` into views up to four steps away, in the order of
/// views that `explanation` found, and compares pairs of clearly different grey: first by 15
/// levels, where that decides nothing by more than noise. The order alone does not tell near from
/// far: reversing it together with the signs moves every pixel to the same place. Linear in the
/// pixels.
[[nodiscard]] NearSide find_near_side(const LightField::Samples& samples, ViewIndex at,
                                      const DisparityView& map, double factor,
                                      const Explanation& explanation);

/// What the nearer values do, for reports: "hide others in other views (…)".
[[nodiscard]] std::string hiding_text(const NearSide& side);

}  // namespace episcope::io
