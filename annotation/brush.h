// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/document.h"
#include "annotation/scribble_layer.h"
#include "engine/core/image.h"
#include "engine/core/indices.h"

#include <cstdint>
#include <span>
#include <vector>

namespace episcope {

/// Pixels connected to `seed` by steps to the left, right, up and down that have its label in a
/// segmentation `[y][x]`. Empty if the seed lies outside.
[[nodiscard]] PixelRegion region_of_segment(ImageView<const std::int32_t> segmentation,
                                            PixelIndex seed);

/// A position on a view in px: the pixel (y, x) covers [x, x + 1) × [y, y + 1), its center lies at
/// (x + 0.5, y + 0.5).
struct StrokePoint {
  double y = 0;
  double x = 0;
};

/// The path of a round brush between two points of a stroke.
struct BrushPath {
  StrokePoint from;
  StrokePoint to;
  double diameter_px = 1;
};

constexpr double kMinBrush_px = 1;
constexpr double kMaxBrush_px = 100;

/// Pixels of a `height` × `width` view that the brush covers: those whose center lies within half
/// the diameter of the segment from → to, and the two that contain its ends, so that even the
/// thinnest brush leaves a mark wherever it is set down. At most one span per row, from top to
/// bottom. Complexity O(rows). Throws InvalidInput for a diameter outside [1, 100] or a point that
/// is not finite.
[[nodiscard]] PixelRegion covered_pixels(const BrushPath& path, int height, int width);

/// Pixels of a `height` × `width` view whose centers lie inside a closed polygon (non-zero winding
/// number, so that a loop which crosses itself encloses all its parts), as spans from top to
/// bottom, left to right within a row. Fewer than three corners enclose nothing. Complexity O(rows
/// · corners). Throws InvalidInput for a corner that is not finite.
[[nodiscard]] PixelRegion pixels_in_polygon(std::span<const StrokePoint> corners, int height,
                                            int width);

enum class PaintTool { Brush, Eraser };

/// The current painting settings.
struct PaintStyle {
  PaintTool tool = PaintTool::Brush;
  int label = 1;  ///< The current label.
  double diameter_px = 10;
  /// If set, a brush changes unpainted pixels only, and an eraser erases the current label only.
  bool protects_others = false;
  /// Labels that are neither painted nor painted over.
  LabelIds locked{};
};

[[nodiscard]] EditKind kind_of(const PaintStyle& style);

/// A stroke of a round brush on one view, in progress. Painted pixels appear in the document at
/// once, and are reverted if the stroke is destroyed before `commit`.
class Stroke {
 public:
  /// Throws InvalidInput for an unknown label, a diameter outside [1, 100], a view outside the
  /// grid, or if another edit is in progress.
  Stroke(AnnotationDocument& document, ViewIndex view, const PaintStyle& style);

  /// Sets the brush down, then draws it to each further point. Returns the rectangle to redraw,
  /// empty if the brush passed outside the view. Throws InvalidInput for a point that is not
  /// finite.
  PixelRect extend(StrokePoint point);
  /// As PendingEdit.
  bool commit() { return edit_.commit(); }

 private:
  const ScribbleLayer* layer_;
  ViewIndex view_;
  double diameter_px_;
  Ink ink_;
  PendingEdit edit_;
  std::optional<StrokePoint> last_;
};

struct ViewRegion {
  ViewIndex view;
  PixelRegion region;
};

/// Paints or erases regions within views as one edit: a fill, or the inside of a polygon. Returns
/// whether that changed anything. Throws InvalidInput as Stroke does.
bool fill_regions(AnnotationDocument& document, const std::vector<ViewRegion>& regions,
                  const PaintStyle& style, EditKind kind = EditKind::Fill);
/// Paints or erases a region of one view.
bool fill_region(AnnotationDocument& document, ViewIndex view, const PixelRegion& region,
                 const PaintStyle& style, EditKind kind = EditKind::Fill);

}  // namespace episcope
