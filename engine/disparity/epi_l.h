// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/schema.h"
#include "engine/cuda/orientations.h"
#include "engine/disparity/estimator.h"
#include "engine/disparity/structure_tensor.h"

namespace episcope {

/// What disparity is read off a structure tensor: the slope that fits by least squares along the
/// views, or the direction of its eigenvector.
enum class Orientation { LeastSquares, Eigenvector };
[[nodiscard]] Names<Orientation> names_of(Orientation);

/// What becomes of the estimates of both directions: their mean, weighted by coherence^p, where
/// they agree, else the more coherent one; or always the more coherent one.
enum class Fusion { Weighted, Winner };
[[nodiscard]] Names<Fusion> names_of(Fusion);

/// Cross scale of the methods that smooth what EPI_L finds: they need less of it.
inline constexpr double kCrossScaleOfDenoised = 0.5;

/// Parameters of EPI_L, and of every method that begins with it.
struct EpiLParameters {
  ProfileChoice profile = {};
  double inner_scale = 0.5;
  double outer_scale = 1.0;
  double view_scale = 1.8;
  double cross_scale = 1.0;
  double shear_step = 0.5;
  double contrast = 2;
  double noise = 0.15;
  Orientation orientation = Orientation::LeastSquares;
  Fusion fusion = Fusion::Weighted;
  int fusion_power = 8;
  IntervalOrAuto range = {};
};

[[nodiscard]] Schema<EpiLParameters> epi_l_schema();
/// Schema without the profile, for methods that the paper does not have.
[[nodiscard]] Schema<EpiLParameters> orientation_schema();

[[nodiscard]] TensorSearch search_of(const EpiLParameters& parameters, Interval range);

/// EPI_L: disparity of every ray from the orientation of lines on the horizontal and vertical
/// epipolar plane images (StructureTensor), purely local.
///
/// Where both directions agree within 0.3 px their mean weighted by coherence^p is taken, else the
/// more coherent one. Confidence is the coherence in [0, 1].
///
/// The profile `paper` is the published method: one scale, the eigenvector of the tensor of each
/// EPI alone, the coherence ((Jxx − Jss)² + 4Jxs²)/(Jxx + Jss)², of both directions the more
/// coherent one; no gradients toned down, no noise floor, shears only where the range exceeds ±1.2
/// px. The publications do not give the scales: σ = 0.8 px throughout. Outside the range an
/// orientation has no coherence and counts as the nearest end. Reference: Wanner and Goldluecke
/// 2012 [WG12], as EPI_L in Wanner, Meister, Goldluecke 2013 [WMG13].
[[nodiscard]] Estimate estimate_epi_l(const LightField& light_field,
                                      const EpiLParameters& parameters, ViewSelection views,
                                      const Progress& progress, Device device = Device::Cpu);

/// Estimates orientations without clamping them to the range. Methods that denoise begin here,
/// since clamped noise no longer averages out. Values overshoot the range by up to 0.6 px.
[[nodiscard]] Estimate estimate_orientations(const LightField& light_field,
                                             const EpiLParameters& parameters, ViewSelection views,
                                             const Progress& progress, Device device = Device::Cpu);

/// Runs it block by block, in bands of rows. A band depends on the samples of rows within the reach
/// of the structure tensor.
[[nodiscard]] BlockwiseRun orientations_in_blocks(const LightField& light_field,
                                                  const EpiLParameters& parameters,
                                                  ViewSelection views, const Progress& progress);

/// Begins `estimate_orientations`: returns an estimate with its range, and maps of the right shape
/// that are not filled yet.
[[nodiscard]] Estimate begin_orientations(const LightField& light_field,
                                          const EpiLParameters& parameters, ViewSelection views,
                                          const Progress& progress);

/// Settings of the device for a range.
[[nodiscard]] cuda::TensorSettings orientation_settings(const LightField& light_field,
                                                        const EpiLParameters& parameters,
                                                        Interval range);

/// Estimates of the center view by each direction alone.
struct DirectionalOrientations {
  Estimate horizontal, vertical;  ///< Confidence 0 everywhere if the grid has no such direction.
};

/// As `estimate_orientations`, before the directions are merged.
[[nodiscard]] DirectionalOrientations estimate_directions(const LightField& light_field,
                                                          const EpiLParameters& parameters,
                                                          const Progress& progress,
                                                          Device device = Device::Cpu);

void clamp_to_range(ViewStack<float>& disparity, Interval range, const Progress& progress);

[[nodiscard]] Estimator epi_l_estimator();

}  // namespace episcope
