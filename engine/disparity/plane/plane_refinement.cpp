// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/plane/plane_refinement.h"

#include "engine/core/parallel/parallel.h"
#include "engine/disparity/stereo/volume_trust.h"
#include "engine/solvers/planes/plane_labeling.h"
#include "engine/solvers/tgv_l2/tgv_l2.h"

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

float label_step(const StereoCosts& stereo) {
  return stereo.labels[1] - stereo.labels[0];
}

void match_planes(const PlaneRefinementData& data, const PlaneRefinementParameters& parameters,
                  const Progress& progress, ImageView<float> disparity) {
  const float step = label_step(data.stereo);
  Image<Plane> planes(disparity.height, disparity.width);
  for (int y = 0; y < disparity.height; ++y) {
    for (int x = 0; x < disparity.width; ++x) planes.at(y, x).value = disparity.at(y, x);
  }
  improve_planes({.cost = data.costs,
                  .first = data.stereo.labels.front(),
                  .step = step,
                  .g = data.edges,
                  .smoothness = static_cast<float>(parameters.plane_smoothness * data.scale),
                  .truncation = static_cast<float>(parameters.truncation)},
                 {.sweeps = parameters.sweeps, .value_noise = 2 * step}, progress, planes.view());
  const auto reach = static_cast<float>(parameters.reach);
  for (int y = 0; y < disparity.height; ++y) {
    for (int x = 0; x < disparity.width; ++x) {
      float& d = disparity.at(y, x);
      const float value = planes.at(y, x).value;
      if (std::abs(value - d) <= reach) d = value;
    }
  }
}

// What the costs around each disparity say, and how much.
struct Observations {
  Image<float> values, weights;
};

Observations observe(const PlaneRefinementData& data, ImageView<const float> disparity,
                     const Progress& progress) {
  Observations all{Image<float>(disparity.height, disparity.width),
                   Image<float>(disparity.height, disparity.width)};
  const float step = label_step(data.stereo), first = data.stereo.labels.front();
  parallel_for(disparity.height, progress, [&](int y) {
    for (int x = 0; x < disparity.width; ++x) {
      const float place = (disparity.at(y, x) - first) / step;
      const int label = std::clamp(static_cast<int>(place + 0.5F), 0, data.costs.layers - 1);
      const Placement placed = place_by_costs(data.stereo, data.costs, data.means, y, x, label);
      all.values.at(y, x) = placed.disparity;
      all.weights.at(y, x) = placed.weight;
    }
  });
  return all;
}

}  // namespace

Schema<PlaneRefinementParameters> plane_refinement_schema() {
  using P = PlaneRefinementParameters;
  return Schema<P>()
      .integer(
          "sweeps", &P::sweeps,
          {"Sweeps", "Number of times every pixel tries the planes of its neighbours; 0 = off"},
          {0, 50})
      .real("plane_smoothness", &P::plane_smoothness,
            {"Plane smoothness",
             "Weight of a px by which neighbouring planes do not continue each other, relative to "
             "the mean matching cost"},
            {0, 100})
      .real("truncation", &P::truncation,
            {"Truncation", "No pair of neighbours is taken to differ by more than this", "px"},
            {0.001, 20, true})
      .real("reach", &P::reach, {"Reach", "Planes move no pixel by more than this", "px"}, {0, 20})
      .real("tgv", &P::tgv, {"TGV²", "Strength of the final denoising with TGV²; 0 = off"}, {0, 10})
      .real("bend", &P::bend,
            {"Bend", "Cost of a bend against that of a jump in the final denoising", "px"},
            {0.01, 100, true})
      .integer("tgv_iterations", &P::tgv_iterations,
               {"TGV² iterations", "Number of iterations of the final denoising"}, {1, 5000, true});
}

void refine_by_planes(const PlaneRefinementData& data, const PlaneRefinementParameters& parameters,
                      const Progress& progress, ImageView<float> disparity) {
  if (progress.finish_requested()) return;
  if (parameters.sweeps > 0 && data.costs.layers >= 4) {
    progress.step("matching planes");
    match_planes(data, parameters, progress.part(0, 0.5), disparity);
  }
  if (parameters.tgv <= 0 || progress.finish_requested()) return;
  progress.step("denoising");
  Observations seen = observe(data, disparity, progress.part(0.5, 0.55));
  solve_tgv_l2({seen.values, seen.weights, data.edges, parameters.tgv, parameters.bend},
               parameters.tgv_iterations, progress.part(0.55, 1), seen.values.view());
  const float step = label_step(data.stereo);
  for (int y = 0; y < disparity.height; ++y) {
    for (int x = 0; x < disparity.width; ++x) {
      float& d = disparity.at(y, x);
      d = std::clamp(seen.values.at(y, x), d - step, d + step);
    }
  }
}

}  // namespace episcope
