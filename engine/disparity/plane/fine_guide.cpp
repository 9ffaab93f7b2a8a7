// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/plane/fine_guide.h"

#include "engine/core/array/quantile.h"

#include <vector>

namespace episcope {
namespace {

constexpr double kLeastVariance = 3e-5;
constexpr double kNoiseShare = 2;

double noise_variance(const StereoCosts& costs) {
  if (!costs.matching.noise) return 0;
  std::vector<float> variances(costs.matching.noise->begin(), costs.matching.noise->end());
  return quantile(variances, 0.5);
}

}  // namespace

void set_fine_guide(const LightField& lf, const Progress& progress, StereoCosts& costs) {
  if (!costs.guide) return;
  costs.guide =
      std::make_shared<GuideImage>(lf, costs.view, costs.guide->radius(),
                                   kLeastVariance + kNoiseShare * noise_variance(costs), progress);
}

}  // namespace episcope
