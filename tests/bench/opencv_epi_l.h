// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/estimate.h"
#include "engine/core/light_field.h"
#include "engine/disparity/epi_l.h"

namespace episcope::bench {

struct OpenCvRun {
  double seconds = 0;   ///< For all EPIs, scaled up from those done.
  double share = 1;     ///< Of the EPIs that were done.
  double agreeing = 0;  ///< Share of its confident pixels within 0.05 px of `ours`.
};

/// The work of EPI_L as one writes it with OpenCV: for each epipolar plane image one call for each
/// step (separable filters for smoothing, derivatives and integration, whole-plane arithmetic for
/// products and orientation), with the same scales, shears and channels as `parameters` and the
/// range of `ours`, for all views. EPIs run on all threads, OpenCV itself on one. Only every
/// `step`th horizontal and vertical EPI is done; the average over neighboring EPIs then takes
/// copies of the one there is.
[[nodiscard]] OpenCvRun run_opencv_epi_l(const LightField& light_field,
                                         const EpiLParameters& parameters, const Estimate& ours,
                                         int step);

}  // namespace episcope::bench
