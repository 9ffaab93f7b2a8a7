// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/plane/view_planes.h"

#include "engine/disparity/common/smoothness_weights.h"
#include "engine/disparity/plane/carry.h"
#include "engine/disparity/plane/silhouette_median.h"
#include "engine/disparity/stereo/volume_trust.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace episcope {
namespace {

// Labels the costs.
void label_costs(const LightField& lf, const PlaneParameters& parameters,
                 const PlaneRefinementData& data, Estimate& estimate, const Progress& progress) {
  const ViewIndex view = data.costs.stereo().view;
  estimate.field.disparity = ViewStack<float>({1, 1}, lf.height(), lf.width(), 1, view);
  const PairWeights weights = pair_weights(lf, view, parameters.labeling.edge_strength,
                                           parameters.labeling.least_weight, progress.part(0, 0));
  estimate.notes = {label_with_jumps(data, weights, parameters.labeling, progress,
                                     estimate.field.disparity.view(view))};
}

// What costs are measured by: the mean of the caps, or the one that all pixels share.
double mean_cap(const LightField& lf, const StereoCosts& stereo) {
  const auto& caps = stereo.matching.caps;
  return caps ? mean_of_valid(*caps, lf, stereo.view) : stereo.matching.cap;
}

// Costs with what is known of the visibility, labeled; the last time also refined.
void run_round(const LightField& lf, const PlaneParameters& parameters, const StereoCosts& stereo,
               bool is_last, Estimate& estimate, const Progress& progress) {
  progress.step("matching costs");
  const LabelCosts costs = visible_costs(lf, stereo, progress.part(0, 0.42));
  const Image<float> edges = smoothness_weights(lf, stereo.view, parameters.labeling.edge_strength);
  const PlaneRefinementData data{costs, edges, mean_cap(lf, stereo)};
  label_costs(lf, parameters, data, estimate, progress.part(0.42, is_last ? 0.75 : 0.99));
  const ImageView<float> map = estimate.field.disparity.view(stereo.view);
  if (is_last) refine_by_planes(data, parameters.refinement, progress.part(0.75, 0.98), map);
  if (is_last && parameters.silhouettes) {
    place_silhouettes(lf, stereo.view, progress.part(0.98, 0.99), map);
  }
  if (is_last) fill_islands(parameters.islands, progress.part(0.99, 0.99), map);
  estimate.confidence = costs.confidence(map, progress.part(0.99, 1));
}

}  // namespace

Estimate estimate_view(EvenedViews& data, const PlaneParameters& parameters, const MapOfView& known,
                       const Progress& progress) {
  const VisibilityParameters& visibility = parameters.visibility;
  Estimate estimate;
  estimate.range = data.stereo().range;
  const int rounds = visibility.rounds;
  int done = 0;
  MapOfView map = known;
  for (; done <= rounds && !(done > 0 && progress.finish_requested()); ++done) {
    const double length = 1.0 / (rounds + 1), begin = done * length;
    if (map.disparity.data) {
      if (done == 1) data.improve(map, progress.part(begin, begin + 0.02 * length));
      set_occluders(data.light_field(), map.disparity, map.confidence, visibility,
                    progress.part(begin + 0.02 * length, begin + 0.05 * length), data.stereo());
    }
    const StereoCosts& stereo = data.stereo();
    run_round(data.light_field(), parameters, stereo, done == rounds, estimate,
              progress.part(begin + 0.05 * length, begin + length));
    map = {estimate.field.disparity.view(stereo.view), estimate.confidence.view(stereo.view)};
  }
  for (std::string& note : cost_notes(data.stereo())) estimate.notes.push_back(std::move(note));
  if (!data.note().empty()) estimate.notes.push_back(data.note());
  estimate.notes.push_back(fmt::format("visibility: {} of {} rounds", done - 1, rounds));
  return estimate;
}

Estimate estimate_next_view(const LightField& lf, const PlaneParameters& parameters, Device device,
                            ViewIndex view, const std::vector<Estimate>& maps,
                            const Progress& progress) {
  PlaneParameters own = parameters;
  own.matching.range = maps.front().range;
  own.matching.view = view;
  own.even = false;
  own.visibility.rounds = 0;
  const CarriedMaps carried = carry_to_views(maps, {view, {1, 1}}, progress.part(0, 0.01));
  EvenedViews data(lf, own, device);
  data.begin(progress.part(0.01, 0.06));
  return estimate_view(data, own, {carried.disparity.view(view), carried.confidence.view(view)},
                       progress.part(0.06, 1));
}

std::vector<ViewIndex> outermost_views(GridShape grid, ViewIndex from) {
  std::vector<ViewIndex> views;
  for (const int v : {0, grid.v - 1}) {
    for (const int u : {0, grid.u - 1}) {
      const ViewIndex view{v, u};
      if (view != from && std::ranges::find(views, view) == views.end()) views.push_back(view);
    }
  }
  return views;
}

}  // namespace episcope
