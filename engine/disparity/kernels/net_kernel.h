// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/isa.h"

namespace episcope {

/// Most taps of a convolution of `net`.
inline constexpr int kMostNetTaps = 27;

/// One tap of a convolution: what it reads for the first output of a row, channels side by side,
/// and its weights of the first group of outputs.
struct NetTap {
  const float* from = nullptr;
  const float* weights = nullptr;
};

/// One row of outputs of a convolution. Taps outside the input are left out; columns outside are
/// zeros in memory. Each output is the bias plus products in the order of the taps and of their
/// inputs, whatever else is computed beside it.
struct NetConvolutionRow {
  NetTap taps[kMostNetTaps];
  int tap_count = 0;
  int inputs = 0;
  int input_step = 16;  ///< Numbers from the input of one output to the next's.
  int columns = 0;
  int outputs = 0;        ///< Of narrow layers; else whole groups of 16.
  long group_stride = 0;  ///< Weights from group to group, of narrow layers from output to output.
  const float* bias = nullptr;
  const float* before = nullptr;  ///< Added before the ReLU, in the layout of `out`; may be null.
  const float* after = nullptr;   ///< Added at the end, likewise.
  bool is_leaky = false;
  float* out = nullptr;
  int out_step = 16;
};

/// One row of a tensor made twice as wide, from up to four rows of its source.
struct NetEnlargedRow {
  const float* rows[4] = {};
  float weights[4] = {};
  int source_columns = 0;
  int columns = 0;
  int channels = 0;             ///< In whole groups; also from column to column.
  const float* plus = nullptr;  ///< Added, in the layout of `out`.
  float* out = nullptr;
};

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

struct NetKernel {
  void (*convolve)(const NetConvolutionRow&);
  /// One or two outputs; inputs in whole groups.
  void (*convolve_narrow)(const NetConvolutionRow&);
  void (*enlarge)(const NetEnlargedRow&);
  void (*evidence)(const NetEvidenceRow&);
};

EPISCOPE_DECLARE_KERNEL(extern const NetKernel kNetKernel);

}  // namespace episcope
