// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/indices.h"
#include "engine/io/grid/decode_image.h"

#include <optional>
#include <string>

namespace episcope::io {

/// Along one axis of a picture, equal tiles with equal lines of one colour between them.
struct TileGaps {
  int first = 0;  ///< Where the first tile begins, in px; a margin may come before it,
  int count = 1;
  int length = 0;  ///< Of a tile, in px.
  int gap = 0;     ///< Between two tiles, in px.
};

/// A contact sheet: views side by side with gaps.
struct ContactSheet {
  TileGaps x;
  TileGaps y;

  [[nodiscard]] GridShape grid() const { return {y.count, x.count}; }
  /// "gaps of 4×2 px left out".
  [[nodiscard]] std::string text() const;
};

/// The tiles of a picture with rows or columns of one colour at equal distances, of at least 32 px.
/// Nothing if there are none, or if margins and gaps are those of views that each have the same
/// border: these are views side by side.
[[nodiscard]] std::optional<ContactSheet> find_contact_sheet(const AnyImage& picture);

/// The tiles of the picture side by side.
[[nodiscard]] AnyImage without_gaps(const AnyImage& picture, const ContactSheet& sheet);

}  // namespace episcope::io
