// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/scribble_layer.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace episcope {

/// Kind of an edit, for the menu entry "Undo …".
enum class EditKind : std::uint8_t {
  Paint,
  Erase,
  Fill,
  AddLabel,
  RenameLabel,
  RecolorLabel,
  RemoveLabel,
  Import,
  SmoothBoundaries,
  Polygon,
  Lasso,
  MergeLabel,
  RenumberLabel,
  MoveLabel,
  AddPaintedLabel,  ///< A label for the edit that follows; the two are undone and redone together.
  ImportSegmentation  ///< Labels that are no strokes: a step also if names and colors stay.
};

/// The last of them: journals keep their numbers, so that new ones come after it.
inline constexpr EditKind kLastEditKind = EditKind::ImportSegmentation;

/// Consecutive pixels of a row that had the same label and got the same label.
struct LabelRun {
  std::uint16_t y = 0;
  std::uint16_t x = 0;
  std::uint16_t length = 0;
  std::uint8_t before = 0;
  std::uint8_t after = 0;
  friend bool operator==(const LabelRun&, const LabelRun&) = default;
};

/// The changed pixels of one view: a masked rectangle, whose mask, old and new labels are kept as
/// runs, which take a few bytes per row however large the brush is.
struct ViewEdit {
  ViewIndex view;
  PixelRect rect;              ///< Of the changed pixels.
  std::vector<LabelRun> runs;  ///< By row, then column.
  friend bool operator==(const ViewEdit&, const ViewEdit&) = default;
};

struct LabelSetEdit {
  LabelSet before;
  LabelSet after;
  friend bool operator==(const LabelSetEdit&, const LabelSetEdit&) = default;
};

/// Change of the smoothing of segment boundaries, in px (AnnotationDocument).
struct SmoothingEdit {
  double before = 0;
  double after = 0;
  friend bool operator==(const SmoothingEdit&, const SmoothingEdit&) = default;
};

/// One step of the user: a stroke, a fill or a change of labels, on one or several views, or of the
/// smoothing.
struct Edit {
  EditKind kind = EditKind::Paint;
  std::vector<ViewEdit> views;
  std::optional<LabelSetEdit> labels;
  std::optional<SmoothingEdit> smoothing{};

  [[nodiscard]] bool empty() const {
    return kind != EditKind::ImportSegmentation && views.empty() && !labels && !smoothing;
  }
  /// Memory used, in bytes.
  [[nodiscard]] std::size_t byte_size() const;
  friend bool operator==(const Edit&, const Edit&) = default;
};

/// The difference of two images of labels within `rect`; no runs if there is none. An empty
/// `before` stands for zeros. The images have the same size, at most 65535 px high and wide.
[[nodiscard]] ViewEdit difference(ViewIndex view, ImageView<const std::uint8_t> before,
                                  ImageView<const std::uint8_t> after, const PixelRect& rect);

enum class EditSide { Before, After };

/// Sets the edited pixels of a view to the labels of one side.
void put_labels(const ViewEdit& edit, EditSide side, ScribbleLayer& layer);

}  // namespace episcope
