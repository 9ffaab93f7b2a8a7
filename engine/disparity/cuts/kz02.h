// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/common/estimator.h"
#include "engine/disparity/common/sub_label.h"
#include "engine/disparity/stereo/stereo_costs.h"

namespace episcope {

struct Kz02Parameters {
  Profile profile = Profile::Tuned;
  int labels = 64;
  int distance = 3;
  double limit = 0;
  double smoothness = 0.2;
  int truncation = 3;
  int cycles = 4;
  Refinement refinement = Refinement::Parabola;
  IntervalOrAuto range;
  ViewOrAuto view;
};

[[nodiscard]] Schema<Kz02Parameters> kz02_schema();

[[nodiscard]] Estimate estimate_kz02(const LightField& light_field,
                                     const Kz02Parameters& parameters, const Progress& progress);

[[nodiscard]] Estimator kz02_estimator();

}  // namespace episcope
