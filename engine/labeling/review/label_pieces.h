// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/labeling/review/blob.h"

namespace episcope {

/// Main: the largest connected part of a label. Island: another part of it. Hole: other labels that
/// it encloses.
enum class PieceKind : std::uint8_t { Main, Island, Hole };

/// A part of a label, or a hole in it.
struct LabelPiece {
  PieceKind kind = PieceKind::Main;
  std::int32_t label = 0;  ///< Of a hole, the label that most of its pixels have.
  Blob blob;
};

/// The parts of a label, whose pixels touch at their sides, and what they enclose: the sets of
/// pixels of other labels, touching at corners too, that do not reach the border of the image.
/// `labels` is `[y][x]`. The main part comes first, then islands and holes, the largest first.
/// Empty if no pixel has the label.
[[nodiscard]] std::vector<LabelPiece> pieces_of(ImageView<const std::int32_t> labels,
                                                std::int32_t label);

}  // namespace episcope
