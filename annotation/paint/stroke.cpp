// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/paint/stroke.h"

#include "engine/core/error.h"

#include <fmt/format.h>

#include <string>

namespace episcope {

Ink ink_of(const PaintStyle& style) {
  if (style.label < 1 || style.label > LabelSet::kMaxId) {
    throw InvalidInput(
        fmt::format("the label id {} is out of range; ids range from 1 to 255", style.label));
  }
  const auto label = static_cast<std::uint8_t>(style.label);
  Ink ink;
  if (style.tool == PaintTool::Brush) ink.label = label;
  if (style.protects_others) {
    ink.kept = all_labels_but(style.tool == PaintTool::Brush ? 0 : label);
  }
  ink.kept |= style.locked;
  if (ink.label != 0 && style.locked[label]) ink.kept.set();
  return ink;
}

EditKind kind_of(const PaintStyle& style) {
  return style.tool == PaintTool::Brush ? EditKind::Paint : EditKind::Erase;
}

Stroke::Stroke(AnnotationDocument& document, ViewIndex view, const PaintStyle& style)
    : layer_(&document.scribbles()),
      view_(view),
      diameter_px_(style.diameter_px),
      ink_(ink_of(style)),
      edit_(document, kind_of(style)) {
  edit_.paint(view, covered_pixels({{}, {}, diameter_px_}, 0, 0), ink_);  // Checks all three.
}

PixelRect Stroke::extend(StrokePoint point) {
  const BrushPath path{last_.value_or(point), point, diameter_px_};
  const PixelRegion region = covered_pixels(path, layer_->height(), layer_->width());
  last_ = point;
  return edit_.paint(view_, region, ink_);
}

bool fill_region(AnnotationDocument& document, ViewIndex view, const PixelRegion& region,
                 const PaintStyle& style, EditKind kind) {
  PendingEdit edit(document, kind);
  edit.paint(view, region, ink_of(style));
  return edit.commit();
}

}  // namespace episcope
