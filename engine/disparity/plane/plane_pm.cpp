// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/plane/plane_pm.h"

#include "engine/disparity/common/packed_views.h"
#include "engine/disparity/plane/carried_sides.h"
#include "engine/disparity/plane/carry.h"
#include "engine/disparity/plane/plane_blocks.h"
#include "engine/disparity/plane/view_planes.h"

#include <vector>

namespace episcope {

Estimate estimate_planes(const LightField& lf, const PlaneParameters& parameters,
                         ViewSelection views, const Progress& progress, Device device) {
  if (views == ViewSelection::Center || lf.grid().count() == 1) {
    EvenedViews data(lf, parameters, device);
    data.begin(progress.part(0, 0.06));
    return estimate_view(data, parameters, {}, progress.part(0.06, 1));
  }
  const ViewIndex from = parameters.matching.view.value_or(lf.center());
  const std::vector<ViewIndex> corners = outermost_views(lf.grid(), from);
  const double share = 0.9 / static_cast<double>(corners.size() + 1);
  std::vector<Estimate> maps;
  EvenedViews data(lf, parameters, device);
  data.begin(progress.part(0, 0.06 * share));
  maps.push_back(estimate_view(data, parameters, {}, progress.part(0.06 * share, share)));
  for (std::size_t i = 0; i < corners.size() && !progress.finish_requested(); ++i) {
    const auto done = static_cast<double>(i + 1);
    maps.push_back(estimate_next_view(data.light_field(), parameters, device, corners[i], maps,
                                      progress.part(share * done, share * (done + 1))));
  }
  CarriedMaps carried = carry_to_views(maps, {{}, lf.grid()}, progress.part(0.9, 0.92));
  const Estimate& first = maps.front();
  Estimate estimate;
  estimate.set_provenance(first.provenance());
  estimate.field.disparity = std::move(carried.disparity);
  estimate.confidence = std::move(carried.confidence);
  const LightField& compared = data.light_field();
  const PackedViews packed = pack_views(compared, progress.part(0.92, 0.93));
  choose_carried_sides(packed, carried_cap(compared, from, progress.part(0.93, 0.931)), estimate,
                       progress.part(0.931, 1));
  for (const Estimate& map : maps) put_map(map, 0, estimate.field.disparity, estimate.confidence);
  estimate.notes.push_back(carried_note(maps.size()));
  return estimate;
}

Estimator plane_pm_estimator() {
  return make_estimator<PlaneParameters>(
      {.id = "plane_pm",
       .name = "PLANE_PM",
       .summary = "Multi-view stereo over visible views, refined by TGV, carried to all views",
       .reference = "Own; builds on Kolmogorov 2006 [Kol06] and Bredies et al. 2010 [BKP10]",
       .all_views = true,
       .iterative = true,
       .revision = 7,
       .devices = {Device::Cpu, Device::Cuda}},
      plane_pm_schema(), estimate_planes, planes_in_blocks);
}

}  // namespace episcope
