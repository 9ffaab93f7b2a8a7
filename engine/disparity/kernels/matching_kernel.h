// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/isa.h"
#include "engine/disparity/kernels/shared_constants.h"

namespace episcope {

/// Lanes that the matching kernel may read or write beyond the columns it is asked for.
inline constexpr int kMatchingSlack = 16;

/// A tile of the reference view beside one other view at one label. All planes `[row][lane]`.
struct MatchingTile {
  int channels = 0;
  int rows = 0;
  int columns = 0;
  /// Rows and columns [first, last) of the tile whose sample lies within the other view.
  int first_row = 0, last_row = 0;
  int first_column = 0, last_column = 0;

  const float* reference[3] = {};  ///< Reference samples, one plane for each channel.
  const float* samples[3] = {};    ///< The other view's at the first tap of row 0, column 0.
  int reference_pitch = 0;
  int sample_pitch = 0;

  int row_taps = 1;  ///< 1, 2 or 4: how a sample between rows is put together,
  int column_taps = 1;
  float row_weights[4] = {1};
  float column_weights[4] = {1};

  float* lines = nullptr;  ///< Scratch: `channels` rows of `line_pitch` lanes.
  int line_pitch = 0;

  const float* noise = nullptr;  ///< Variance at each reference pixel, one plane like `reference`.
  float noise_lost = 0;          ///< How much of it is added to squared differences.
  float cap = 0;
  float* costs = nullptr;  ///< Added to.
  /// Where samples may be NaN, which costs nothing: 1 is added for every other one, in the layout
  /// of `costs`. Null: none is NaN.
  float* seen = nullptr;
  long cost_pitch = 0;

  /// What may stand before the sample, and a cap for every pixel: null, or both are given together
  /// with `seen`. A sample then counts as clamp((limit − nearest)·steepness, 0, 1) of a view.
  const float* nearest = nullptr;  ///< Like `samples`, at the pixel next to the sample.
  float limit = 0;
  float steepness = 0;
  const float* caps = nullptr;  ///< Instead of `cap`, one plane like `reference`.
};

/// Adds min(cap, √(|samples − reference|² + noise_lost·noise)) to the costs.
struct MatchingKernel {
  void (*add)(const MatchingTile&);
};

EPISCOPE_DECLARE_KERNEL(extern const MatchingKernel kMatchingKernel);

/// Lanes that the guided filter's kernel may read or write beyond the columns of a row.
inline constexpr int kGuidedSlack = 16;
/// Planes of sums: the values alone, and times each channel of the guide.
inline constexpr int kGuidedPlanes = 4;

/// One row of what the filter knows of the guide.
struct GuideRow {
  int channels = 0;
  int width = 0;
  int radius = 0;
  const float* guide[3] = {};
  const float* mean[3] = {};     ///< Over the window.
  const float* inverse[6] = {};  ///< Of covariance + regularization: 00, 01, 02, 11, 12, 22.
  const float* share = nullptr;  ///< 1 / columns of the window that lie within the image.
};

/// Sums along x over the window's columns, of up to 2·radius + 1 rows of it.
struct GuidedSums {
  int rows = 0;
  const float* planes[2 * kMaxGuidedRadius + 1][kGuidedPlanes] = {};
};

/// The three steps of the guided filter, each for one row. `scratch` has width + 2·radius + slack
/// lanes.
struct GuidedKernel {
  /// Sums along x of values and of values · guide.
  void (*sum_products)(const GuideRow&, const float* values, float* scratch, float* const* out);
  /// Solves for the local affine model, a and b with a·guide + b ≈ values in the window, and sums
  /// it along x: b, then a of each channel. `models` has a row of scratch for each plane.
  void (*solve)(const GuideRow&, const GuidedSums&, float* scratch, float* const* models,
                float* const* out);
  /// The mean model applied to the guide.
  void (*apply)(const GuideRow&, const GuidedSums&, float* out);
};

EPISCOPE_DECLARE_KERNEL(extern const GuidedKernel kGuidedKernel);

}  // namespace episcope
