// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/epi/line_residuals.h"

namespace episcope {

/// How strictly lines must fit (raise_by_line_fit) in a grid: 3 where they reach four views.
/// Nearer, the misfit of another disparity is less, by the square of the distance.
[[nodiscard]] float line_strictness(GridShape grid);

/// Tells view by view whether rays see two layers or one; one object per thread.
class LayerScore {
 public:
  /// `packed` are views of a light field of this grid; `decision` as in EpiTwoLayerParameters.
  LayerScore(const PackedViews& packed, GridShape grid, double decision);

  /// Fills `score`, in [−1, 1] and positive for two layers, and `weight`, how much is seen there.
  /// `fit` is the coherence of one orientation `single` before lines were checked, `confidence`
  /// that of two orientations near ≥ far, in 1/255. All are `[y][x]` of one size.
  struct Maps {
    ImageView<const float> fit, single, near, far;
    ImageView<const std::uint8_t> confidence;
  };
  void judge(ViewIndex view, const Maps& maps, ImageView<float> score, ImageView<float> weight);

 private:
  const PackedViews& packed_;
  float decision_;
  float strictness_;
  LineResiduals residuals_;
  Image<float> rows_, coherence_;
};

}  // namespace episcope
