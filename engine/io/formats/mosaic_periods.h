// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/io/base/image_file.h"

namespace episcope::io {

enum class LineAxis { X, Y };

/// Brightness along up to 400 rows (LineAxis::X) or columns (LineAxis::Y) spread over a picture: a
/// line a row, in units of the samples, the mean of the channels.
[[nodiscard]] Image<float> picture_lines(const AnyImage& picture, LineAxis axis);

/// The period with which the brightness of a picture changes along its lines. From one lenslet to
/// the next, the view jumps from the last to the first, and so does the brightness; lenslets with
/// dark borders show their period in the brightness itself.
struct LensletPeriod {
  int period_px = 0;     ///< 0 = none was found.
  double explained = 0;  ///< Part of the variance of differences of neighbors that repeats,
  double jump = 0;       ///< their largest over their median within a period,
  double shading = 0;    ///< and part of the variance of the brightness itself that repeats.

  /// Whether the lines are those of lenslets: half of the variance repeats, with a jump of 1.5. Of
  /// multiples of 4 the brightness must repeat as well, because pictures that were compressed as
  /// JPEG have jumps every 8 or 16 px.
  [[nodiscard]] bool is_certain() const;
  /// The same without regard to compression: for a picture of which one knows otherwise that it
  /// consists of lenslets.
  [[nodiscard]] bool is_likely() const;
  /// For such a picture that is a JPEG: of multiples of 8 the brightness must repeat.
  [[nodiscard]] bool is_likely_in_jpeg() const;
};

/// `lines`: brightness, a line a row. Periods of 3 to 32 px are tried.
[[nodiscard]] LensletPeriod find_lenslet_period(const Image<float>& lines);

/// Tiles of views side by side are looked for from this length on, in px.
inline constexpr int kSmallestTile = 32;

/// How often a picture repeats along its lines: views side by side resemble each other.
struct TileCount {
  int count = 0;           ///< 0 = nothing was found.
  double correlation = 0;  ///< Of the brightness changes of neighboring tiles, at the best of
                           ///< shifts by up to 8 px.
  double edge = 0;         ///< Differences across borders of tiles over those everywhere.

  /// Whether tiles are views of one scene: correlation 0.3 (unrelated pictures: below 0.15), and
  /// borders that are seen, 1.5.
  [[nodiscard]] bool is_certain() const;
};

/// `lines`: brightness, a line a row. Tries 2 to 32 tiles of at least 32 px, of whole pixels.
[[nodiscard]] TileCount find_tile_count(const Image<float>& lines);

/// How alike `count` tiles are; count 0 if they are no whole pixels.
[[nodiscard]] TileCount tiles_of_count(const Image<float>& lines, int count);

}  // namespace episcope::io
