// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/estimate.h"
#include "engine/core/light_field.h"
#include "engine/core/schema.h"

#include <algorithm>
#include <cstdlib>
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
  /// The maps are moved down by so many pixels, and to the right; maps that are smaller than the
  /// views from the middle of these. What leaves the views is lost, and a border as wide as the
  /// part of the views that is left bare is not judged.
  int down_px = 0;
  int right_px = 0;
  MapCrop crop = MapCrop::None;  ///< Maps that are larger than the views, as networks pad them.
  /// Stored values, between commas, that stand for no estimate: "-1" or "0,9999". Empty = none.
  std::string missing = {};
  /// Maps have another resolution: their nearest pixels fill the views.
  bool is_resized = false;

  /// Pixels that maps are moved, along rows or columns, whichever are more.
  [[nodiscard]] int moved_px() const { return std::max(std::abs(down_px), std::abs(right_px)); }
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

/// Size of a view, the camera that depth belongs to, and pixels of padding above and on the left.
struct MapTarget {
  int height = 0;
  int width = 0;
  CameraGrid camera{};
  int above = 0;
  int left = 0;
};

/// The value of a map at a pixel of the view by a reading; NaN if it has none there.
[[nodiscard]] float value_by(const DisparityView& map, const MapReading& reading,
                             const MapTarget& target, int y, int x);

}  // namespace episcope::io
