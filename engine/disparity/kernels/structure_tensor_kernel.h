// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/isa.h"
#include "engine/disparity/kernels/shared_constants.h"

namespace episcope {

/// The longest filter of the structure tensor, in taps.
inline constexpr int kMaxTensorViews = 160;  ///< Along an EPI.

/// A small odd filter, centerd: out(n) = Σ taps[i]·in(n + i − radius). Half a sample further it has
/// one tap more.
struct Taps {
  int radius = 0;
  float values[kMaxTaps + 1] = {};
};

/// Calls run.operator()<k>() with the radius of a filter as k, 6 at most.
template <int kRadius = 0, class Run>
void with_radius(int radius, const Run& run) {
  if constexpr (kRadius < 6) {
    if (radius != kRadius) return with_radius<kRadius + 1>(radius, run);
  }
  run.template operator()<kRadius>();
}

/// A banded linear map along the view axis: out(r) = Σ_i taps[i]·in(first + i).
struct RowTaps {
  int first = 0;
  int count = 0;
  float values[kMaxTaps] = {};
};

/// Buffers and geometry of one block of EPIs, planes of `rows` views by `pitch` lanes. Neighbors
/// along the image axis lie `stride` lanes apart: 1 for horizontal EPIs (lanes are x), the width of
/// a column block for vertical EPIs (lanes are [y][x]). All buffers belong to the caller.
struct TensorBlock {
  int rows = 0;
  int channels = 0;
  int stride = 1;
  int pitch = 0;         ///< Lanes from row to row of a plane of samples or derivatives.
  int margin = 0;        ///< Lanes before the payload there; samples repeat the border or are real.
  int tensor_pitch = 0;  ///< Pitch of the planes in sheared coordinates.
  int tensor_margin = 0;
  int length = 0;                   ///< Lanes of payload.
  int first_row = 0, last_row = 0;  ///< Rows [first, last) whose result is wanted.

  float* samples = nullptr;  ///< [c][row][lane]; NaN = invalid, if `has_invalid`.
  /// Whether samples may be NaN: gradients that one of them enters then count nothing.
  bool has_invalid = false;
  float* line = nullptr;  ///< Two rows of scratch.
  float* along[2] = {};   ///< [c][row][lane] d/dx of the samples; [1]: half a pixel to the right.
  float* across[2] = {};  ///< [c][row][lane] smoothed along x; [1] likewise.
  float* tensor[3] = {};  ///< [row][lane] Jxx, Jxs, Jss of one shear, integrated along the views.
  float* best[4] = {};  ///< [row][length] of the best shear: Jxx, Jxs, Jss unsheared, coherence².
  int best_pitch = 0;
};

/// Filters of the tensor, made by `structure_tensor.cpp`.
struct TensorFilters {
  Taps smooth;                          ///< Pre-smoothing along x.
  Taps integrate;                       ///< Integration along x,
  Taps integrate_half;                  ///< and the same half a pixel further: one tap more.
  const RowTaps* row_smooth = nullptr;  ///< [rows] pre-smoothing and Scharr across, along views.
  const RowTaps* row_derivative = nullptr;  ///< [rows] derivative along s = −u.
  const RowTaps* row_integrate = nullptr;   ///< [rows] integration along the views.
  float contrast_energy = 0;  ///< Gradient energy at which its weight in the tensor is halved.
  float noise_energy = 0;     ///< Tensor trace at which coherence is halved.
};

/// One shear: rows are read so that disparity `half_steps`/2 stands upright about `center_row`.
struct Shear {
  int half_steps = 0;
  int center_row = 0;
  float limit = 0;         ///< Largest |d − shear| accepted, below 1.
  float min = 0, max = 0;  ///< Disparities beyond are not accepted.
};

/// Tensors of neighboring EPIs to be averaged, and where the result goes.
struct TensorAverage {
  int count = 0;
  const float* tensor[kMaxTaps][3] = {};  ///< Jxx, Jxs, Jss, unsheared, `length` lanes each.
  float weights[kMaxTaps] = {};
  int length = 0;
  float noise_energy = 0;
  float min = 0, max = 0;
  float* disparity = nullptr;
  float* coherence = nullptr;
};

/// Where the sheared coordinates of a row begin, whole pixels: the floor of half steps.
constexpr int floor_half(int half_steps) {
  return half_steps >> 1;
}

/// The kernels' entry points, a set of each for each instruction set.
struct TensorKernel {
  /// Pre-smooths `samples` and fills `along` and `across`; those half a pixel to the right only for
  /// rows at an odd distance from row `rows`/2, which must be the center of all shears.
  void (*differentiate)(const TensorBlock&, const TensorFilters&, bool with_half);
  /// Fills `tensor` for one shear, all channels summed.
  void (*accumulate)(const TensorBlock&, const TensorFilters&, const Shear&);
};

struct OrientationKernel {
  /// Integrates `tensor` along x and keeps in `best` the tensor of the most coherent shear so far.
  void (*select)(const TensorBlock&, const TensorFilters&, const Shear&);
  /// Averages tensors and reads disparity and coherence off the mean.
  void (*resolve)(const TensorAverage&);
  /// Merges `count` estimates of one direction into the estimates of the other: see
  /// merge_orientations.
  void (*merge)(const float* disparity, const float* coherence, int count, int power,
                float* to_disparity, float* to_coherence);
};

EPISCOPE_DECLARE_KERNEL(extern const TensorKernel kTensorKernel);
EPISCOPE_DECLARE_KERNEL(extern const OrientationKernel kOrientationKernel);

/// The orientation of a tensor computed in full, where OrientationKernel only compares.
struct EigenvectorKernel {
  /// As OrientationKernel::select, for limits of any size, and without regard to the range: resolve
  /// takes the coherence of what lies beyond. With `replace` the tensor kept is the
  /// one whose least-squares disparity and coherence, as OrientationKernel::resolve reads them, are
  /// those of the eigenvector in the sheared frame: d = −2Jxs/(Jxx − Jss + √((Jxx − Jss)² +
  /// 4Jxs²)), r = √((Jxx − Jss)² + 4Jxs²)/(Jxx + Jss + n²).
  void (*select)(const TensorBlock&, const TensorFilters&, const Shear&, bool replace);
};

EPISCOPE_DECLARE_KERNEL(extern const EigenvectorKernel kEigenvectorKernel);

}  // namespace episcope
