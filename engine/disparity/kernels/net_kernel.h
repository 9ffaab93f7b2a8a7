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

/// Most taps of a convolution of `net` that are taken one by one.
inline constexpr int kMostNetTaps = 27;

/// Mixed convolutions: outputs of three taps along an axis are computed four at a time, from six
/// products of six mixed inputs and six mixed weights instead of twelve. Winograd 1980 (Arithmetic
/// Complexity of Computations), F(4, 3) for the points 0, ±√½, ±√2 and infinity. Along two axes
/// that rounds about twice as much as plain sums do. Columns are mixed and, where that is wanted,
/// planes: rows or labels.
inline constexpr int kNetTile = 4;
inline constexpr int kNetMixed = 6;
/// Tiles of columns that are computed at once.
inline constexpr int kNetBlock = 24;

/// One tap of a convolution: what it reads for the first output of a row, channels side by side,
/// and its weights of the first group of outputs.
struct NetTap {
  const float* from = nullptr;
  const float* weights = nullptr;
};

/// Where outputs of a row go, and what is added to them before the ReLU and at the end, in the same
/// layout; both may be null.
struct NetOutput {
  float* out = nullptr;
  const float* before = nullptr;
  const float* after = nullptr;
};

/// One row of outputs of a convolution. Taps outside the input are left out; columns outside are
/// zeros in memory. Each output is the same sum, in the order of the taps and of their inputs,
/// whatever else is computed beside it.
struct NetConvolutionRow {
  NetTap taps[kMostNetTaps];
  int tap_count = 0;
  int inputs = 0;
  int input_step = 16;  ///< Numbers from the input of one output to the next's.
  int columns = 0;
  int outputs = 0;        ///< Of narrow layers; else whole groups of 16.
  long group_stride = 0;  ///< Weights from group to group, of narrow layers from output to output.
  const float* bias = nullptr;
  bool is_leaky = false;
  int out_step = 16;
  NetOutput out;
};

/// The columns of a block: tile t begins with column t / dilation · kNetTile · dilation +
/// t mod dilation; its columns are `dilation` apart.
struct NetBlock {
  int first = 0;  ///< Tile.
  int count = 0;  ///< Up to kNetBlock.
  int dilation = 1;
};

/// A block of a row of outputs, or of kNetTile planes of outputs, of a mixed convolution. Of
/// `plain`, `out` is not used, `taps` are those that are not mixed, and `input_step` is the
/// distance of tiles.
struct NetMixedRow {
  NetConvolutionRow plain;
  NetBlock block;
  int planes = 1;  ///< Mixed: 1 or kNetMixed. Kinds of mixed numbers are kNetMixed times as many.
  long weights_stride = 0;      ///< From kind to kind.
  NetOutput outputs[kNetTile];  ///< Without `out` where none is wanted.
};

/// Inputs of a block to be mixed: one row, or one of each of kNetMixed planes.
struct NetMixing {
  const float* rows[kNetMixed] = {};  ///< At the first output's column; null for zeros.
  int planes = 1;                     ///< As in NetMixedRow.
  NetBlock block;
  int channels = 0;      ///< In whole groups; also from column to column.
  float* out = nullptr;  ///< `[tile][kind][channel]`
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

struct NetKernel {
  void (*convolve)(const NetConvolutionRow&);
  /// One or two outputs; inputs in whole groups.
  void (*convolve_narrow)(const NetConvolutionRow&);
  /// Reads kNetBlock tiles.
  void (*convolve_mixed)(const NetMixedRow&);
  void (*mix)(const NetMixing&);
  void (*enlarge)(const NetEnlargedRow&);
};

EPISCOPE_DECLARE_KERNEL(extern const NetKernel kNetKernel);

}  // namespace episcope
