// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/estimate.h"
#include "engine/core/light_field.h"
#include "engine/core/schema.h"

#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Axes of a map along which its pixels run the other way.
enum class MapFlip { None, X, Y, Both };
[[nodiscard]] Names<MapFlip> names_of(MapFlip);

/// Which part of maps that are padded belongs to the views.
enum class MapCrop { None, Corner, Middle };
[[nodiscard]] Names<MapCrop> names_of(MapCrop);

/// What the numbers of a map are.
enum class MapValues { Disparity, Depth };
[[nodiscard]] Names<MapValues> names_of(MapValues);

/// How maps of other programs are to be read, beyond what their files state: a user says so, since
/// nothing of it is applied unasked. Applied in this order.
struct MapReading {
  bool is_transposed = false;  ///< Rows and columns are exchanged.
  MapFlip flip = MapFlip::None;
  double scale = 1;  ///< Stored values times this are px per view step, or depth. Not 0.
  /// Depth is in units of the camera of the light field.
  MapValues values = MapValues::Disparity;
  /// The maps lack so many pixels at each side of the views: pixel (0, 0) of a map is pixel
  /// (`border_px`, `border_px`) of a view. Only the middle of the views is judged.
  int border_px = 0;
  int down_px = 0;               ///< The maps are moved down by so many pixels,
  int right_px = 0;              ///< and to the right; what leaves the views is lost.
  MapCrop crop = MapCrop::None;  ///< Maps that are larger than the views, as networks pad them.
  /// Stored values, between commas, that stand for no estimate: "-1" or "0,9999". Empty = none.
  std::string missing = {};
  /// Maps have another resolution: their nearest pixels fill the views.
  bool is_resized = false;

  friend bool operator==(const MapReading&, const MapReading&) = default;
};

/// Schema of the options, one row each: `map-transpose`, `map-flip`, `map-scale`, `map-values`,
/// `map-border`, `map-down`, `map-right`, `map-resize`, `map-crop`, `map-missing`.
[[nodiscard]] Schema<MapReading> map_schema();

/// Options that differ from reading a map as it is, by key.
[[nodiscard]] ParameterSet given_options(const MapReading& reading);

/// Its stored values that stand for no estimate. Throws InvalidInput if they are no numbers.
[[nodiscard]] std::vector<float> missing_values(const MapReading& reading);

/// What a reading changes, for sentences: "rows and columns exchanged and values times 0.01".
[[nodiscard]] std::string reading_text(const MapReading& reading);

/// Reads all maps of an estimate so. `light_field` tells size and camera; null = it is not known.
/// Throws InvalidInput for a scale of 0, for an estimate in two layers, for a border, a part,
/// another size or depth if the light field or its camera is not known, for a part of maps smaller
/// than views, for another size with a border or a part, and for missing values that are no
/// numbers.
void apply_reading(const MapReading& reading, const LightField* light_field, Estimate& estimate);

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
/// reversed, negated, another scale, depth instead of disparity, a map without a border
/// that lies in the upper left corner, with nothing beside it, and with truth a map that is up to
/// 16 px off its place. So does a value that stands for no
/// estimate: one that many pixels have, far beyond all others or 0 or -1, where the truth is not
/// near it. With truth, the mean absolute error
/// decides, over all combinations of turns and values: it must be less than half of the error as
/// read, and of the error of the best constant. Without, the views decide alone, over turns with
/// either sign, and values of maps that are not turned: the error of the next views must be below
/// 0.6 of the error as read, and of the error without warping (as in put_truth_upright). Returns
/// nothing if the map is best as it is. Looks at about 10,000 pixels of the truth; linear in the
/// pixels of the views. Precondition: the map has the size of a view.
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
