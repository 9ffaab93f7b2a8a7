// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/common/denoise.h"
#include "engine/disparity/common/estimator.h"
#include "engine/disparity/common/islands.h"
#include "engine/disparity/common/run_options.h"
#include "engine/disparity/common/sub_label.h"
#include "engine/disparity/stereo/stereo_costs.h"

namespace episcope {

/// Parameters of the local stereo methods ST_AV_L and ST_CH_L.
struct StereoLocalParameters {
  StereoCostParameters matching = {};
  Refinement refinement = Refinement::Parabola;
};

/// Parameters of the denoised ones, ST_AV_S and ST_CH_S.
struct StereoSmoothParameters {
  DenoiseParameters denoising{.lambda = 0.1, .weight_power = 2};
  double map_noise = 0.1;  ///< σ₀ of `denoise`, px.
  IslandParameters islands = {};
  StereoLocalParameters local = {};
};

/// The profile `paper` has no refinement, weights neither data nor variation, and leaves islands; λ
/// = 0.2.
[[nodiscard]] Schema<StereoLocalParameters> stereo_local_schema(MatchedViews views);
[[nodiscard]] Schema<StereoSmoothParameters> stereo_smooth_schema(MatchedViews views);

/// The label of the least cost at every pixel of one view, moved between labels by `refinement`:
/// none, a parabola through the costs of the label and its neighbours, or two lines of equal slope
/// (equiangular), by half a label at most. Costs are computed band by band and never held.
///
/// Confidence: 1 − least cost / mean cost over the labels. It is near 0 where all labels are alike
/// and falls with noise, since noise raises the least cost. The ε used is reported in the notes.
/// Throws InvalidInput as `prepare_stereo`, DeviceFailure, Cancelled.
[[nodiscard]] Estimate estimate_stereo_local(const LightField& light_field, MatchedViews views,
                                             const StereoLocalParameters& parameters,
                                             const Progress& progress, Device device = Device::Cpu);

/// The same block by block: bands of rows, under costs that were prepared for all.
[[nodiscard]] BlockwiseRun stereo_local_in_blocks(const LightField& light_field, MatchedViews views,
                                                  const StereoLocalParameters& parameters,
                                                  const Progress& progress);

/// The same, denoised (engine/disparity/common/denoise.h) and without islands
/// (engine/disparity/common/islands.h); the duality gap is in the notes.
[[nodiscard]] Estimate estimate_stereo_smooth(const LightField& light_field, MatchedViews views,
                                              const StereoSmoothParameters& parameters,
                                              const Progress& progress,
                                              Device device = Device::Cpu);

/// The same in blocks: bands of rows, then the view is denoised as a whole.
[[nodiscard]] BlockwiseRun stereo_smooth_in_blocks(const LightField& light_field,
                                                   MatchedViews views,
                                                   const StereoSmoothParameters& parameters,
                                                   const Progress& progress);

}  // namespace episcope
