// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/denoise.h"
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

/// Parameters of EPI_TWO_LAYER: the two layers and their denoising, and the parameters of EPI_L for
/// single orientations.
struct EpiTwoLayerParameters {
  double decision = 0.15;
  double region_smoothness = 4;
  double least_distance = 0.2;
  double lambda = 0.1;
  double layer_smoothness = 3;
  double weight_power = 4;
  double edge_strength = 15;
  double double_inner_scale = 0.8;
  double double_outer_scale = 2;
  double double_contrast = 10;
  StopParameters stop{.max_iterations = 30};
  LineCheck line_check = {};
  EpiLParameters tensor{.cross_scale = kCrossScaleOfDenoised};
};

/// EPI_TWO_LAYER: a transparent or reflective surface and the background seen through it.
///
/// 1. The single orientation d of every ray and its coherence r (EPI_L), and the double orientation
///    near ≥ far with its confidence c (DoubleOrientation), on horizontal and vertical EPIs; where
///    both directions agree their mean with weights c^8, else the more confident one.
/// 2. Lines of d are checked as in EPI_S (check_lines), for what is not in the region.
///    Single or double: the misfit of one orientation as share of both misfits,
///    e = `single_misfit_share(r, c)`, with r the best within 2 px before that check and at least
///    the fit of lines of one disparity (raise_by_line_fit), so that silhouettes are not taken for
///    two layers. e above `decision` speaks for two. Where the two are no surfaces
///    (layer_steadiness), one layer is taken, however badly its lines fit: noise and crossing
///    silhouettes are not two layers, and there the result equals EPI_S.
/// 3. The region of two layers in each view by TV segmentation of that score, weighted by max(r, c)
///    as far as it is above what noise alone reaches, with one layer where nothing else is seen
///    (`segment_binary`): a blank wall in the noise of a camera is not two walls.
/// 4. Foreground and background of each view by TvL2Solver: in the region near and far with weights
///    c^p, outside the single estimate with weights r^p in both, r as lowered by the check. The
///    surface is an area, not a texture: it is smoothed `layer_smoothness` times as much, ignores
///    image edges and may jump
///    at the border of the region.
/// Foreground ≥ background holds everywhere (the mean of both where it would not); both are equal
/// where `layers` is 1. `field` is the foreground; confidence is c in the region, r outside.
///
/// [Ano13] gives the model and its null vector; how it decides and smooths was not recovered, so
/// steps 2 to 4 are this program's own.
/// Throws InvalidInput if no axis of the grid has three views.
[[nodiscard]] Estimate estimate_epi_two_layer(const LightField& light_field,
                                              const EpiTwoLayerParameters& parameters,
                                              ViewSelection views, const Progress& progress,
                                              Device device = Device::Cpu);

[[nodiscard]] Estimator epi_two_layer_estimator();

}  // namespace episcope
