// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/indices.h"

#include <cstdint>
#include <string>
#include <vector>

namespace episcope::io {

/// A corner in pixels: pixel (y, x) covers [x, x + 1) × [y, y + 1).
struct Corner {
  double x = 0;
  double y = 0;
};
using Polygon = std::vector<Corner>;

/// Gives `label` to the pixels whose centers lie inside, by the even-odd rule. Corners may lie
/// outside of the map. O(corners · rows + pixels).
void fill_polygon(Image<std::int32_t>& map, const Polygon& polygon, std::int32_t label);

/// Gives `label` to the pixels whose centers are at most `radius_px` away from a line through the
/// corners, or from the only corner.
void draw_line(Image<std::int32_t>& map, const Polygon& corners, double radius_px,
               std::int32_t label);

/// A region of connected pixels (by sides) of one label.
struct LabelRegion {
  std::int32_t label = 0;
  Polygon outline;         ///< Along sides of pixels: `fill_polygon` gives exactly its pixels, and
  bool has_holes = false;  ///< the pixels of its holes.
  PixelRect box;           ///< That holds it.
  std::vector<PixelIndex> pixels;
};
/// All regions of labels above 0, by their first pixel. O(pixels).
[[nodiscard]] std::vector<LabelRegion> regions_of(ImageView<const std::int32_t> map);

/// COCO's runs of 0 and 1 in turn, column by column from the first, which may be 0 long. They are
/// packed into a text as pycocotools does (`rleToString` of its maskApi.c).
using Runs = std::vector<std::uint32_t>;
[[nodiscard]] Runs runs_of(ImageView<const std::int32_t> map, std::int32_t label);
[[nodiscard]] std::string packed_runs(const Runs& runs);
/// Throws InvalidInput for a text that is cut off.
[[nodiscard]] Runs unpacked_runs(const std::string& text);
/// Gives `label` to the pixels of the runs of 1. Throws InvalidInput unless they cover the map.
void fill_runs(Image<std::int32_t>& map, const Runs& runs, std::int32_t label);

[[nodiscard]] std::string to_base64(const std::string& bytes);
/// Throws InvalidInput for other letters.
[[nodiscard]] std::string from_base64(const std::string& text);

}  // namespace episcope::io
