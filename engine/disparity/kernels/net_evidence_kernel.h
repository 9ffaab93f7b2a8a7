// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/isa.h"

namespace episcope {

/// Numbers of a pixel of a view: R, G, B, differences of grey along x and y, 1, 0, 0. Either lies
/// beside the other, or each has a row of its own, of the first five.
inline constexpr int kNetPixel = 8;
inline constexpr int kNetPixelRows = 5;

/// Most disparities whose evidence is computed at once.
inline constexpr int kNetAtOnce = 8;
/// Numbers that may be read behind the end of a view.
inline constexpr int kNetReadBehind = 16;

/// A view beside the reference for one row: pixel (x, y) of disparity d is at
/// (x − d du, y − d dv) of the view.
struct NetView {
  const float* pixels = nullptr;  ///< From row `first_row` on.
  int first_row = 0;
  long row_stride = 0;  ///< Numbers from row to row.
  float du = 0;
  float dv = 0;
};

/// What evidence is wanted of, and where its 16 numbers a pixel go.
struct NetDisparity {
  const float* map = nullptr;  ///< At each pixel of the row; null: the same for all,
  float same = 0;              ///< this.
  float* out = nullptr;
};

/// Evidence of one row of the reference view.
struct NetEvidenceRow {
  int y = 0;
  int width = 0;
  int height = 0;
  const NetView* views = nullptr;    ///< Sector by sector,
  int sector_begin[9] = {};          ///< sector k from this one to the next one's.
  const float* reference = nullptr;  ///< Pixels of the row.
  bool has_invalid = false;          ///< Whether pixels may be NaN.
  const NetDisparity* disparities = nullptr;
  int count = 0;  ///< Of disparities: up to kNetAtOnce.
};

struct NetEvidenceKernel {
  /// Of disparities that are the same for all pixels; each number of a pixel in a row of its own.
  void (*planes)(const NetEvidenceRow&);
  /// Of maps; the numbers of a pixel side by side.
  void (*maps)(const NetEvidenceRow&);
};

EPISCOPE_DECLARE_KERNEL(extern const NetEvidenceKernel kNetEvidenceKernel);

}  // namespace episcope
