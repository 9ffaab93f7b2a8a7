// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/plane/plane_refinement.h"

#include "engine/core/parallel/parallel.h"
#include "engine/cuda/tgv_l2/tgv_l2.h"
#include "engine/cuda/tv_l2/tv_l2.h"
#include "engine/disparity/plane/regional_trust.h"
#include "engine/solvers/tgv_l2/tgv_l2.h"
#include "engine/solvers/tv_l2/tv_l2.h"

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

// λ of the denoising of single pixels, as in ST_AV_S, and the weight above which those that are
// trusted count more than in proportion.
constexpr double kWinnerSmoothing = 0.1;
constexpr float kSureWeight = 0.12F;

float label_step(const StereoCosts& stereo) {
  return stereo.labels[1] - stereo.labels[0];
}

// What the costs around each disparity say, and how much.
Placements observe(const PlaneRefinementData& data, ImageView<const float> disparity,
                   const Progress& progress) {
  const StereoCosts& stereo = data.costs.stereo();
  const float step = label_step(stereo), first = stereo.labels.front();
  const int last = static_cast<int>(stereo.labels.size()) - 1;
  Image<int> labels(disparity.height, disparity.width);
  parallel_for(disparity.height, progress.part(0, 0.2), [&](int y) {
    for (int x = 0; x < disparity.width; ++x) {
      const float place = (disparity.at(y, x) - first) / step;
      labels.at(y, x) = std::clamp(static_cast<int>(place + 0.5F), 0, last);
    }
  });
  return data.costs.place(labels, progress.part(0.2, 1));
}

// The best label of every pixel by itself, placed between labels and denoised by its trust.
Image<float> denoised_winners(const PlaneRefinementData& data, const Progress& progress) {
  Placements all =
      data.costs.place(data.costs.best_labels(progress.part(0, 0.15)), progress.part(0.15, 0.3));
  for (float& weight : all.weight) weight *= 1 + weight / kSureWeight;
  const Progress solving = progress.part(0.3, 1);
  if (data.costs.on_device()) {
    cuda::solve_tv_l2(all.disparity, all.weight, data.edges, kWinnerSmoothing, solving);
  } else {
    TvL2Solver(all.disparity.height(), all.disparity.width())
        .solve({all.disparity, all.weight, data.edges, kWinnerSmoothing}, {}, solving,
               all.disparity.view());
  }
  return std::move(all.disparity);
}

// Where costs hardly tell labels apart, a labeling settles for whole regions of one wrong label,
// and for silhouettes that are a little too wide; the mean of what the pixels say by themselves is
// then nearer to the truth, but coarser where both agree.
void settle_doubt(const PlaneRefinementData& data, const PlaneRefinementParameters& parameters,
                  const Progress& progress, ImageView<float> disparity) {
  const Image<float> trust = regional_trust(
      data.costs.confidence(disparity, progress.part(0, 0.1)).view(data.costs.stereo().view));
  const Image<float> denoised = denoised_winners(data, progress.part(0.1, 1));
  const auto doubt = static_cast<float>(parameters.doubt);
  const auto leeway = static_cast<float>(std::max(parameters.leeway, 1e-6));
  for (int y = 0; y < disparity.height; ++y) {
    for (int x = 0; x < disparity.width; ++x) {
      float& d = disparity.at(y, x);
      const float other = denoised.at(y, x);
      const float trusted = std::clamp((trust.at(y, x) / doubt - 1) * 2, 0.0F, 1.0F);
      const float agreed = std::clamp(2 - std::abs(d - other) / leeway, 0.0F, 1.0F);
      d = other + std::max(trusted, agreed) * (d - other);
    }
  }
}

}  // namespace

Schema<PlaneRefinementParameters> plane_refinement_schema() {
  using P = PlaneRefinementParameters;
  return Schema<P>()
      .real("tgv", &P::tgv, {"TGV²", "Strength of the final denoising with TGV²; 0 = off"}, {0, 10})
      .real("doubt", &P::doubt,
            {"Doubt",
             "Where the mean confidence of a region is below this, its pixels are placed by "
             "denoising what each says by itself, if that is elsewhere; 0 = nowhere"},
            {0, 1})
      .real("leeway", &P::leeway,
            {"Leeway", "Labels in doubt stay where the denoised pixels differ by no more than this",
             "px"},
            {0, 20})
      .real("bend", &P::bend,
            {"Bend", "Cost of a bend against that of a jump in the final denoising", "px"},
            {0.01, 100, true})
      .integer("tgv_iterations", &P::tgv_iterations,
               {"TGV² iterations", "Number of iterations of the final denoising"}, {1, 5000, true});
}

void refine_by_planes(const PlaneRefinementData& data, const PlaneRefinementParameters& parameters,
                      const Progress& progress, ImageView<float> disparity) {
  if (parameters.tgv <= 0 || progress.finish_requested()) return;
  progress.step("denoising");
  Placements seen = observe(data, disparity, progress.part(0, 0.1));
  const Progress solving = progress.part(0.1, 0.9);
  if (data.costs.on_device()) {
    cuda::solve_tgv_l2(seen.disparity, {seen.weight, data.edges, parameters.tgv, parameters.bend},
                       parameters.tgv_iterations, solving);
  } else {
    solve_tgv_l2({seen.disparity, seen.weight, data.edges, parameters.tgv, parameters.bend},
                 parameters.tgv_iterations, solving, seen.disparity.view());
  }
  const float step = label_step(data.costs.stereo());
  for (int y = 0; y < disparity.height; ++y) {
    for (int x = 0; x < disparity.width; ++x) {
      float& d = disparity.at(y, x);
      d = std::clamp(seen.disparity.at(y, x), d - step, d + step);
    }
  }
  if (parameters.doubt > 0) settle_doubt(data, parameters, progress.part(0.9, 1), disparity);
}

}  // namespace episcope
