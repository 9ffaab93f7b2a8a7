// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace episcope {

/// The longest filter of the structure tensor, in taps.
inline constexpr int kMaxTaps = 13;

/// A small odd filter, centred: out(n) = Σ taps[i]·in(n + i − radius).
struct Taps {
  int radius = 0;
  float values[kMaxTaps] = {};
};

/// A banded linear map along the view axis: out(r) = Σ_i taps[i]·in(first + i).
struct RowTaps {
  int first = 0;
  int count = 0;
  float values[kMaxTaps] = {};
};

/// Buffers and geometry of one block of EPIs, planes of `rows` views by `pitch` lanes. Neighbours
/// along the image axis lie `stride` lanes apart: 1 for horizontal EPIs (lanes are x), the width of
/// a column block for vertical EPIs (lanes are [y][x]). All buffers belong to the caller.
struct TensorBlock {
  int rows = 0;
  int channels = 0;
  int pitch = 0;   ///< Lanes from row to row of a plane.
  int stride = 1;
  int margin = 0;  ///< Lanes before the payload; samples there repeat the border or are real.
  int length = 0;  ///< Lanes of payload.
  int first_row = 0, last_row = 0;  ///< Rows [first, last) whose result is wanted.

  float* samples = nullptr;   ///< [c][row][lane], overwritten by the pre-smoothed samples.
  float* line = nullptr;      ///< Two rows of scratch.
  float* along[2] = {};       ///< [c][row][lane] d/dx of the samples; [1]: half a pixel to the right.
  float* across[2] = {};      ///< [c][row][lane] smoothed along x; [1] likewise. Unused if no half shear.
  float* tensor[3] = {};      ///< [row][lane] integrated Jxx, Jxs, Jss.
  float* disparity = nullptr;  ///< [row][length] result.
  float* coherence = nullptr;  ///< [row][length] result.
};

/// Filters of the tensor, made by `structure_tensor.cpp`.
struct TensorFilters {
  Taps smooth;          ///< Pre-smoothing along x.
  Taps integrate;       ///< Integration along x,
  Taps integrate_half;  ///< and the same, evaluated half a pixel to the left (even number of taps, see .cpp).
  const RowTaps* row_smooth = nullptr;      ///< [rows] pre-smoothing and Scharr across, along the views.
  const RowTaps* row_derivative = nullptr;  ///< [rows] derivative along s = −u.
  const RowTaps* row_integrate = nullptr;   ///< [rows] integration along the views.
  float noise_energy = 0;  ///< Tensor trace at which confidence is halved.
};

/// One shear: rows are read so that disparity `half_steps`/2 stands upright about `center_row`.
struct Shear {
  int half_steps = 0;
  int center_row = 0;
  float limit = 0;          ///< Largest |d − shear| accepted.
  float min = 0, max = 0;   ///< Disparity range: values beyond are clamped and get coherence 0.
};

/// Samples of any storage type to float planes: out[c][i] = scale·in[i·channels + c].
using DeinterleaveU8 = void (*)(const std::uint8_t* in, int count, int channels, float* const* out);

/// The kernel's entry points, one set for each instruction set.
struct TensorKernel {
  DeinterleaveU8 deinterleave;
  /// Pre-smooths `samples` and fills `along` and `across`.
  void (*differentiate)(const TensorBlock&, const TensorFilters&, bool with_half);
  /// Fills `tensor` for one shear, all channels summed.
  void (*accumulate)(const TensorBlock&, const TensorFilters&, const Shear&);
  /// Reads orientation off `tensor` and keeps the most coherent estimate so far.
  void (*orient)(const TensorBlock&, const TensorFilters&, const Shear&);
};

namespace baseline {
extern const TensorKernel kTensorKernel;
}
namespace avx2 {
extern const TensorKernel kTensorKernel;
}
namespace avx512 {
extern const TensorKernel kTensorKernel;
}

}  // namespace episcope
