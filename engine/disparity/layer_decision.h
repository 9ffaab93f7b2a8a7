// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/double_orientation.h"
#include "engine/disparity/epi_l.h"
#include "engine/disparity/line_check.h"

namespace episcope {

/// Disparity range that a method for two layers should search, as `search_range`. A range that is
/// found from the light field is extended to the layers of unambiguous pixels: of the center view,
/// on every few tiles, over ±`limit`. Pixels behind a second surface are not coherent for any
/// single disparity. Throws as `require_double_grid`, Cancelled.
[[nodiscard]] Interval search_layer_range(const LightField& light_field,
                                          const EpiLParameters& parameters,
                                          const TensorScales& double_scales,
                                          const Progress& progress, Device device = Device::Cpu,
                                          double limit = 5);

/// How strictly lines must fit (raise_by_line_fit) in a grid: 3 where they reach four views.
/// Nearer, the misfit of another disparity is less, by the square of the distance.
[[nodiscard]] float line_strictness(GridShape grid);

/// Tells view by view whether rays see two layers or one; one object per thread.
class LayerScore {
 public:
  /// `packed` are views of a light field of this grid; `decision` as in EpiTwoLayerParameters.
  LayerScore(const PackedViews& packed, GridShape grid, double decision);

  /// Fills `score`, in [−1, 1] and positive for two layers, and `weight`, how much is seen there.
  /// `fit` is the coherence of one orientation `single` before lines were checked, `confidence` is
  /// the confidence of two orientations near ≥ far, in 1/255. All are `[y][x]` of one size.
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
