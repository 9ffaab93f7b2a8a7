// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/models/map_reading.h"

#include <optional>

namespace episcope::io {

/// What the map of one view is compared with.
struct MapEvidence {
  const LightField& light_field;
  ViewIndex view;
  DisparityView truth{};  ///< Of that view; empty = there is none.
};

/// How far a map is from the evidence.
struct MapErrors {
  std::optional<double> mse_100;      ///< Against the truth, where both have a value.
  std::optional<double> grey_levels;  ///< Mean error of the next views warped by the map; none if
                                      ///< it moves most pixels out of them.
};

/// A reading that explains a map far better.
struct BetterReading {
  MapReading reading;
  MapErrors as_read;
  MapErrors better;

  /// Whether the views fit the map better as it is, or the reading moves most pixels out of them:
  /// then the truth may be at fault.
  [[nodiscard]] bool is_contradicted() const;
};

/// Looks for a reading of a map in the ways in which people err: rows and columns exchanged,
/// reversed, negated, another scale, depth instead of disparity, a map without a border that lies
/// in the upper left corner, with nothing beside it, and a value that stands for no estimate: one
/// that many pixels have, far beyond all others or 0 or -1. With truth also for a map that is up to
/// 16 px off its place. With truth, the mean absolute error decides, over all combinations of turns
/// and values: it must be less than half of the error as read, and of the error of the best
/// constant. Without, the views decide alone, over turns with either sign, and values of maps that
/// are not turned: the error of the next views must be below 0.6 of the error as read, and of the
/// error without warping (as in put_truth_upright). Returns nothing if the map is best as it is.
/// Looks at about 10,000 pixels of the truth; linear in the pixels of the views. Precondition: the
/// map has the size of a view.
[[nodiscard]] std::optional<BetterReading> find_better_reading(const DisparityView& map,
                                                               const MapEvidence& evidence);

/// Errors of a map that explains little of the truth.
struct PoorFit {
  double mse_100 = 0;
  double constant_mse_100 = 0;  ///< Of the best map of one value, over the same pixels.
};

/// Compares a map with the best map of one value. It explains little if both its mean absolute and
/// its mean squared error are more than half of that one's, and the former is above 0.1 px.
/// Returns nothing otherwise, and if the map has values at few of the pixels. Linear in the pixels.
/// Precondition: map and truth have one size.
[[nodiscard]] std::optional<PoorFit> find_poor_fit(const DisparityView& map,
                                                   const DisparityView& truth);

}  // namespace episcope::io
