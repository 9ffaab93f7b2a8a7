// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/isa.h"

namespace episcope {

/// Numbers of a pixel of a view: R, G, B, differences of grey along x and y, 1, 0, 0.
inline constexpr int kNetPixel = 8;

/// Pixels that evidence is summed for at once.
inline constexpr int kNetRun = 64;

/// A view beside the reference for one row: pixel (x, y) of disparity d is at
/// (x − d du, y − d dv) of the view.
struct NetView {
  const float* pixels = nullptr;  ///< From row `first_row` on.
  int first_row = 0;
  long row_stride = 0;  ///< Numbers from row to row.
  float du = 0;
  float dv = 0;
};

/// Evidence of one row of the reference view.
struct NetEvidenceRow {
  int y = 0;
  int width = 0;
  int height = 0;
  const NetView* views = nullptr;      ///< Sector by sector,
  int sector_begin[9] = {};            ///< sector k from this one to the next one's.
  const float* reference = nullptr;    ///< Pixels of the row.
  const float* disparities = nullptr;  ///< At each pixel; null: the same for all,
  float disparity = 0;                 ///< this.
  bool has_invalid = false;            ///< Whether pixels may be NaN.
  float* out = nullptr;                ///< 16 numbers a pixel,
  int out_step = 16;                   ///< so many apart.
};

EPISCOPE_DECLARE_KERNEL(void net_evidence(const NetEvidenceRow& row));

}  // namespace episcope
