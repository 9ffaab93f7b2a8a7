// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/document/pending_edit.h"
#include "annotation/paint/brush.h"

namespace episcope {

enum class PaintTool { Brush, Eraser };

/// The current painting settings.
struct PaintStyle {
  PaintTool tool = PaintTool::Brush;
  int label = 1;  ///< The current label.
  double diameter_px = 10;
  /// If set, a brush paints over unpainted pixels only, and an eraser erases the current label
  /// only.
  bool protects_others = false;
  /// Labels that are neither painted nor painted over.
  LabelIds locked{};
};

/// Ink and menu entry for these settings; also for fills. Throws InvalidInput for a label outside 1
/// … 255.
[[nodiscard]] Ink ink_of(const PaintStyle& style);
[[nodiscard]] EditKind kind_of(const PaintStyle& style);

/// A stroke of a round brush on one view, in progress: what is painted appears in the document at
/// once, and is reverted if the stroke is destroyed before `commit`.
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

/// Paints or erases a region within the view, as one edit: a fill, or what was drawn around.
/// Returns whether that changed anything. Throws InvalidInput as Stroke does.
bool fill_region(AnnotationDocument& document, ViewIndex view, const PixelRegion& region,
                 const PaintStyle& style, EditKind kind = EditKind::Fill);

}  // namespace episcope
