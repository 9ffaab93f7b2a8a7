// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"

namespace episcope::io {

/// How often a picture repeats along its lines: views side by side resemble each other.
struct TileCount {
  int count = 0;           ///< 0 = nothing was found.
  double correlation = 0;  ///< Of the brightness changes of neighbouring tiles, at the best of
                           ///< shifts by up to 8 px.
  double edge = 0;         ///< Differences across borders of tiles over those everywhere.

  /// Whether tiles are views of one scene: correlation 0.3 (unrelated pictures: below 0.15), and
  /// borders that are seen, 1.5.
  [[nodiscard]] bool is_certain() const;
};

/// `lines`: brightness, a line a row. Tries 2 to 32 tiles of at least 32 px, of whole pixels.
[[nodiscard]] TileCount find_tile_count(const Image<float>& lines);

}  // namespace episcope::io
