// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter/named.h"
#include "engine/core/parameter/schema.h"
#include "engine/disparity/common/profile.h"
#include "engine/disparity/tensor/structure_tensor.h"

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
/// The same without the profile, for a method that the paper does not have.
[[nodiscard]] Schema<EpiLParameters> orientation_schema();

/// What the structure tensor takes of them.
[[nodiscard]] TensorScales scales_of(const EpiLParameters& parameters);
[[nodiscard]] TensorSearch search_of(const EpiLParameters& parameters, Interval range);

}  // namespace episcope
