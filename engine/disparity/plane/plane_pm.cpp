// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/plane/plane_pm.h"

#include "engine/disparity/common/local_noise.h"
#include "engine/disparity/common/packed_views.h"
#include "engine/disparity/common/smoothness_weights.h"
#include "engine/disparity/plane/carried_sides.h"
#include "engine/disparity/plane/carry.h"
#include "engine/disparity/plane/even_views.h"
#include "engine/disparity/plane/silhouette_median.h"
#include "engine/disparity/stereo/volume_trust.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

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
  estimate.confidence = costs.confidence(map, progress.part(0.99, 1));
}

}  // namespace

Schema<PlaneParameters> plane_pm_schema() {
  using P = PlaneParameters;
  return Schema<P>()
      .part(&P::visibility, visibility_schema())
      .part(&P::refinement, plane_refinement_schema())
      .part(&P::labeling, jump_labeling_schema())
      .part(&P::matching, stereo_matching_schema())
      .flag("even", &P::even,
            {"Even brightness",
             "Correct differences in brightness between the views, and their fall-off to the "
             "corners, where there are any"})
      .flag("silhouettes", &P::silhouettes,
            {"Place silhouettes",
             "Beside jumps, take the median of the surroundings, weighted by likeness of colour"})
      .search("smoothness", {0.75, 1.5, 3})
      .search("rounds", {0, 1, 2});
}

namespace {

// Brightness is taken from a map of which so many pixels are sure.
constexpr double kLeastSure = 0.1;
// Between samples of one point without noise.
constexpr double kSmallDifference = 0.015;

struct MapView {
  ImageView<const float> disparity, confidence;
};

// The light field as it is compared, and its data term.
class Evened {
 public:
  Evened(const LightField& lf, const PlaneParameters& parameters, Device device)
      : lf_(lf), parameters_(parameters), device_(device) {}

  [[nodiscard]] const LightField& light_field() const { return even_ ? *even_ : lf_; }
  [[nodiscard]] StereoCosts& stereo() { return stereo_; }

  void begin(const Progress& progress) {
    const ViewIndex view = parameters_.matching.view.value_or(lf_.center());
    if (parameters_.even && lf_.grid().contains(view)) {
      use(brightness_of_means(lf_, view, progress.part(0, 0.2)), progress.part(0.2, 0.4));
    }
    prepare(parameters_.matching, progress.part(0.4, 1));
  }

  // With what the sure part of a map of disparities tells of the brightness of the views.
  void improve(const MapView& map, const Progress& progress) {
    const Image<float> sure =
        sure_surfaces(map.disparity, map.confidence, parameters_.visibility.least_trust);
    const auto known = std::ranges::count_if(sure, [](float d) { return d > kNothingNear; });
    if (!parameters_.even) return;
    Brightness brightness;
    if (known >= kLeastSure * static_cast<double>(sure.size())) {
      brightness = brightness_of_points(lf_, stereo_.view, sure, progress.part(0, 0.4));
    }
    if (!even_ && !brightness.is_uneven()) return;
    use(brightness, progress.part(0.4, 0.6));
    StereoCostParameters matching = parameters_.matching;
    matching.range = stereo_.range;
    prepare(matching, progress.part(0.6, 1));
    if (even_)
      note_ = fmt::format("brightness of the views evened: fall-off {:.3f}", brightness.fall_off);
  }
  [[nodiscard]] const std::string& note() const { return note_; }

 private:
  void use(const Brightness& brightness, const Progress& progress) {
    even_.reset();
    if (brightness.is_uneven()) even_.emplace(even_views(lf_, brightness, progress));
  }
  void prepare(const StereoCostParameters& matching, const Progress& progress) {
    stereo_ =
        prepare_stereo(light_field(), MatchedViews::All, matching, progress.part(0, 0.9), device_);
    set_local_caps(light_field(), parameters_.visibility, progress.part(0.9, 1), stereo_);
  }

  const LightField& lf_;
  const PlaneParameters& parameters_;
  Device device_;
  std::optional<LightField> even_;
  StereoCosts stereo_;
  std::string note_;
};

// The map of a view, of which `known` shows what occludes, without data if nothing is known.
Estimate estimate_one(Evened& data, const PlaneParameters& parameters, const MapView& known,
                      const Progress& progress) {
  data.begin(progress.part(0, 0.06));
  const VisibilityParameters& visibility = parameters.visibility;
  Estimate estimate;
  estimate.range = data.stereo().range;
  const int rounds = visibility.rounds;
  int done = 0;
  MapView map = known;
  for (; done <= rounds && !(done > 0 && progress.finish_requested()); ++done) {
    const double begin = 0.06 + 0.94 * done / (rounds + 1), length = 0.94 / (rounds + 1);
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

// That of another view: what others show of it occludes from the start. `lf`: as it is compared.
Estimate estimate_next(const LightField& lf, const PlaneParameters& parameters, Device device,
                       ViewIndex view, const std::vector<Estimate>& maps,
                       const Progress& progress) {
  PlaneParameters own = parameters;
  own.matching.range = maps.front().range;
  own.matching.view = view;
  own.even = false;
  own.visibility.rounds = 0;
  const CarriedMaps carried = carry_to_views(maps, {view, {1, 1}}, progress.part(0, 0.01));
  Evened data(lf, own, device);
  return estimate_one(data, own, {carried.disparity.view(view), carried.confidence.view(view)},
                      progress.part(0.01, 1));
}

// The views farthest from `from`, which see most of what it does not.
std::vector<ViewIndex> outermost(GridShape grid, ViewIndex from) {
  std::vector<ViewIndex> views;
  for (const int v : {0, grid.v - 1}) {
    for (const int u : {0, grid.u - 1}) {
      const ViewIndex view{v, u};
      if (view != from && std::ranges::find(views, view) == views.end()) views.push_back(view);
    }
  }
  return views;
}

void put_view(const Estimate& map, ViewIndex view, Estimate& estimate) {
  const ImageView<const float> disparity = map.field.disparity.view(view);
  const ImageView<const float> confidence = map.confidence.view(view);
  std::copy_n(disparity.data, disparity.size(), estimate.field.disparity.view(view).data);
  std::copy_n(confidence.data, confidence.size(), estimate.confidence.view(view).data);
}

// The most by which a view counts where sides are chosen: what noise explains, and a little more.
float noise_cap(const LightField& lf, ViewIndex view, const Progress& progress) {
  const double variance = view_noise_variance(lf, view, progress);
  return static_cast<float>(kSmallDifference + 2 * std::sqrt(lf.channels() * variance));
}

}  // namespace

Estimate estimate_planes(const LightField& lf, const PlaneParameters& parameters,
                         ViewSelection views, const Progress& progress, Device device) {
  if (views == ViewSelection::Center || lf.grid().count() == 1) {
    Evened data(lf, parameters, device);
    return estimate_one(data, parameters, {}, progress);
  }
  const ViewIndex from = parameters.matching.view.value_or(lf.center());
  const std::vector<ViewIndex> corners = outermost(lf.grid(), from);
  const double share = 0.9 / static_cast<double>(corners.size() + 1);
  std::vector<Estimate> maps;
  Evened data(lf, parameters, device);
  maps.push_back(estimate_one(data, parameters, {}, progress.part(0, share)));
  for (std::size_t i = 0; i < corners.size() && !progress.finish_requested(); ++i) {
    const auto done = static_cast<double>(i + 1);
    maps.push_back(estimate_next(data.light_field(), parameters, device, corners[i], maps,
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
  choose_carried_sides(packed, noise_cap(compared, from, progress.part(0.93, 0.931)), estimate,
                       progress.part(0.931, 1));
  for (const Estimate& map : maps) put_view(map, map.field.disparity.first(), estimate);
  estimate.notes.push_back(fmt::format("carried to all views from {} of them", maps.size()));
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
       .revision = 6,
       .devices = {Device::Cpu, Device::Cuda}},
      plane_pm_schema(), estimate_planes);
}

}  // namespace episcope
