// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/plane/plane_pm.h"

#include "engine/disparity/common/smoothness_weights.h"
#include "engine/disparity/stereo/volume_trust.h"

#include <fmt/format.h>

#include <algorithm>

namespace episcope {
namespace {

// Labels the costs, with every pixel placed at the parabola through its label and the two beside.
void label_costs(const LightField& lf, const PlaneParameters& parameters,
                 const PlaneRefinementData& data, Estimate& estimate, const Progress& progress) {
  const auto place = [&](int y, int x, int label) {
    return place_by_costs(data.stereo, data.costs, data.means, y, x, label);
  };
  estimate.notes.clear();
  label_globally(lf, {data.stereo.view, data.stereo.labels, data.costs, data.scale, place},
                 parameters.labeling, estimate, progress);
}

// Costs with what is known of the visibility, labeled; the last time also refined.
void run_round(const LightField& lf, const PlaneParameters& parameters, const StereoCosts& stereo,
               bool is_last, Estimate& estimate, const Progress& progress) {
  progress.step("matching costs");
  const Volume<float> volume = visible_costs(lf, stereo, progress.part(0, 0.4));
  const Image<float> means = mean_costs(volume.view(), progress.part(0.4, 0.42));
  const Image<float> edges = smoothness_weights(lf, stereo.view, parameters.labeling.edge_strength);
  const PlaneRefinementData data{stereo, volume.view(), means, edges,
                                 mean_of_valid(means, lf, stereo.view)};
  label_costs(lf, parameters, data, estimate, progress.part(0.42, is_last ? 0.75 : 0.99));
  const ImageView<float> map = estimate.field.disparity.view(stereo.view);
  if (is_last) refine_by_planes(data, parameters.refinement, progress.part(0.75, 0.99), map);
  estimate.confidence =
      volume_confidence(map, stereo, volume.view(), means, progress.part(0.99, 1));
}

}  // namespace

Schema<PlaneParameters> plane_pm_schema() {
  using P = PlaneParameters;
  return Schema<P>()
      .part(&P::visibility, visibility_schema())
      .part(&P::refinement, plane_refinement_schema())
      .part(&P::labeling, global_labeling_schema())
      .part(&P::matching, stereo_matching_schema())
      .search("smoothness", {0.75, 1.5, 3})
      .search("rounds", {0, 1, 2});
}

Estimate estimate_planes(const LightField& lf, const PlaneParameters& parameters, ViewSelection,
                         const Progress& progress) {
  StereoCosts stereo =
      prepare_stereo(lf, MatchedViews::All, parameters.matching, progress.part(0, 0.05));
  const VisibilityParameters& visibility = parameters.visibility;
  set_local_caps(lf, visibility, progress.part(0.05, 0.06), stereo);
  Estimate estimate;
  estimate.range = stereo.range;
  const int rounds = visibility.rounds;
  int done = 0;
  for (; done <= rounds && !(done > 0 && progress.finish_requested()); ++done) {
    const double begin = 0.06 + 0.94 * done / (rounds + 1), length = 0.94 / (rounds + 1);
    if (done > 0) {
      set_occluders(lf, estimate.field.disparity.view(stereo.view), visibility,
                    progress.part(begin, begin + 0.03 * length), stereo);
    }
    run_round(lf, parameters, stereo, done == rounds, estimate,
              progress.part(begin + 0.03 * length, begin + length));
  }
  for (std::string& note : cost_notes(stereo)) estimate.notes.push_back(std::move(note));
  estimate.notes.push_back(fmt::format("visibility: {} of {} rounds", done - 1, rounds));
  return estimate;
}

Estimator plane_pm_estimator() {
  return make_estimator<PlaneParameters>(
      {.id = "plane_pm",
       .name = "PLANE_PM",
       .summary = "Multi-view stereo over visible views, refined by planes and TGV",
       .reference = "Own; builds on Pock et al. 2010 [PCBC10], Bleyer et al. 2011 [BRR11] and "
                    "Bredies et al. 2010 [BKP10]",
       .iterative = true},
      plane_pm_schema(), estimate_planes);
}

}  // namespace episcope
