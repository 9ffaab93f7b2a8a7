// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/estimator.h"

namespace episcope {

/// Parameters of EPI_L.
struct EpiLParameters {
  double inner_scale = 0.5;
  double outer_scale = 1.0;
  double view_scale = 1.8;
  double cross_scale = 1.0;
  double shear_step = 0.5;
  double contrast = 2;
  double noise = 0.15;
  int fusion_power = 8;
  IntervalOrAuto range;
};

[[nodiscard]] Schema<EpiLParameters> epi_l_schema();

/// EPI_L: disparity of every ray from the orientation of lines on the horizontal and vertical
/// epipolar plane images (StructureTensor), purely local.
///
/// Where both directions agree within 0.3 px their mean weighted by coherence^p is taken, else the
/// more coherent one. Confidence is the coherence in [0, 1]. Reference: Wanner and Goldluecke 2012
/// [WG12], as EPI_L in Wanner, Meister, Goldluecke 2013 [WMG13].
[[nodiscard]] Estimate estimate_epi_l(const LightField& light_field,
                                      const EpiLParameters& parameters, ViewSelection views,
                                      const Progress& progress);

[[nodiscard]] Estimator epi_l_estimator();

}  // namespace episcope
