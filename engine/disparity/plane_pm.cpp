// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/plane_pm.h"

#include "engine/core/estimate.h"
#include "engine/core/light_field.h"
#include "engine/core/photometric_correction.h"
#include "engine/core/progress.h"
#include "engine/core/view_gain.h"
#include "engine/disparity/carried_run.h"
#include "engine/disparity/correction_of_points.h"
#include "engine/disparity/cost_volume.h"
#include "engine/disparity/denoise.h"
#include "engine/disparity/estimator.h"
#include "engine/disparity/plane_labeling.h"
#include "engine/disparity/propagate_planes.h"
#include "engine/disparity/stereo_costs.h"
#include "engine/disparity/view_samples.h"
#include "engine/disparity/visible_costs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace episcope {
namespace {

// Disparity and confidence of one view.
struct MapOfView {
  ImageView<const float> disparity, confidence;
};

// A light field as its views are compared, without differences in brightness, and the data term of
// one view. Refers to light field and parameters. Members throw DeviceFailure, Cancelled.
class EqualizedViews {
 public:
  EqualizedViews(const LightField& light_field, const PlaneParameters& parameters, Device device);

  // The evened one, or the given one if its views are alike.
  [[nodiscard]] const LightField& light_field() const { return even_ ? *even_ : lf_; }
  [[nodiscard]] StereoCosts& stereo() { return stereo_; }

  // By the means of the views, as nothing is known of disparities, and prepares the data term.
  void begin(const Progress& progress);
  // By what the sure part of a map tells, and prepares it anew.
  void improve(const MapOfView& map, const Progress& progress);
  // About what was evened, for the notes of an estimate; may be empty.
  [[nodiscard]] const std::string& note() const { return note_; }

  // What was evened, in numbers of which there is one at least, and the same light field again,
  // without a data term.
  [[nodiscard]] std::vector<double> evened() const;
  void restore(const std::vector<double>& evened, const Progress& progress);

 private:
  void use(const PhotometricCorrection& correction, const Progress& progress);
  void prepare(const StereoCostParameters& matching, const Progress& progress);

  const LightField& lf_;
  const PlaneParameters& parameters_;
  Device device_;
  PhotometricCorrection correction_;
  std::optional<LightField> even_;
  StereoCosts stereo_;
  std::string note_;
};

// Brightness is taken from a map of which so many pixels are sure.
constexpr double kLeastSure = 0.1;

EqualizedViews::EqualizedViews(const LightField& lf, const PlaneParameters& parameters,
                               Device device)
    : lf_(lf), parameters_(parameters), device_(device) {}

void EqualizedViews::begin(const Progress& progress) {
  const ViewIndex view = parameters_.matching.view.value_or(lf_.center());
  if (parameters_.even && lf_.grid().contains(view)) {
    use(gains_of_means(lf_, view, progress.part(0, 0.2)), progress.part(0.2, 0.4));
  }
  prepare(parameters_.matching, progress.part(0.4, 1));
}

void EqualizedViews::improve(const MapOfView& map, const Progress& progress) {
  const Image<float> sure =
      sure_surfaces(map.disparity, map.confidence, parameters_.visibility.least_trust);
  const auto known = std::ranges::count_if(sure, [](float d) { return d > kNothingNear; });
  if (!parameters_.even) return;
  PhotometricCorrection correction;
  if (known >= kLeastSure * static_cast<double>(sure.size())) {
    correction = correction_of_points(lf_, stereo_.view, sure, progress.part(0, 0.4));
  }
  if (!even_ && !correction.is_uneven()) return;
  use(correction, progress.part(0.4, 0.6));
  StereoCostParameters matching = parameters_.matching;
  matching.range = stereo_.range;
  prepare(matching, progress.part(0.6, 1));
  if (even_) {
    note_ = fmt::format("brightness of the views evened: fall-off {:.3f}", correction.fall_off);
  }
}

std::vector<double> EqualizedViews::evened() const {
  std::vector<double> numbers{correction_.fall_off};
  for (const auto& gain : correction_.gains)
    numbers.insert(numbers.end(), gain.begin(), gain.end());
  return numbers;
}

void EqualizedViews::restore(const std::vector<double>& evened, const Progress& progress) {
  PhotometricCorrection correction;
  correction.fall_off = evened.front();
  for (std::size_t i = 1; i + 2 < evened.size(); i += 3) {
    correction.gains.push_back({evened[i], evened[i + 1], evened[i + 2]});
  }
  stereo_ = {};
  use(correction, progress);
}

void EqualizedViews::use(const PhotometricCorrection& correction, const Progress& progress) {
  correction_ = correction;
  even_.reset();
  if (correction.is_uneven()) even_.emplace(corrected(lf_, correction, progress));
}

void EqualizedViews::prepare(const StereoCostParameters& matching, const Progress& progress) {
  stereo_ =
      prepare_stereo(light_field(), MatchedViews::All, matching, progress.part(0, 0.9), device_);
  set_local_caps(light_field(), parameters_.visibility, progress.part(0.9, 1), stereo_);
}

// Labels the costs.
void label_visible(const LightField& lf, const PlaneParameters& parameters,
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
  label_visible(lf, parameters, data, estimate, progress.part(0.42, is_last ? 0.75 : 0.99));
  const ImageView<float> map = estimate.field.disparity.view(stereo.view);
  if (is_last) refine_by_planes(data, parameters.refinement, progress.part(0.75, 0.98), map);
  if (is_last && parameters.silhouettes) {
    place_silhouettes(lf, stereo.view, progress.part(0.98, 0.99), map);
  }
  if (is_last) fill_islands(parameters.islands, progress.part(0.99, 0.99), map);
  estimate.confidence = costs.confidence(map, progress.part(0.99, 1));
}

// The map of the view that `data` was begun for (steps 1 to 3 of plane_pm.h). `known` shows what
// occludes from the start; without data if nothing is known. What the first round tells of the
// brightness of the views goes into `data`. At `progress.finish_requested()` the map of the last
// round that was finished. Throws DeviceFailure, Cancelled.
Estimate estimate_view(EqualizedViews& data, const PlaneParameters& parameters,
                       const MapOfView& known, const Progress& progress) {
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

// The map of another view in one round: what `maps`, of which there is one at least, show there
// occludes. `light_field`: as it is compared, evened. Throws likewise.
Estimate estimate_next_view(const LightField& lf, const PlaneParameters& parameters, Device device,
                            ViewIndex view, const std::vector<Estimate>& maps,
                            const Progress& progress) {
  PlaneParameters own = parameters;
  own.matching.range = maps.front().range;
  own.matching.view = view;
  own.even = false;
  own.visibility.rounds = 0;
  const PropagatedMaps carried = propagate_to_views(maps, {view, {1, 1}}, progress.part(0, 0.01));
  EqualizedViews data(lf, own, device);
  data.begin(progress.part(0.01, 0.06));
  return estimate_view(data, own, {carried.disparity.view(view), carried.confidence.view(view)},
                       progress.part(0.06, 1));
}

class PlaneMethod final : public CarriedMethod {
 public:
  // Evens the views and prepares the data term. Throws InvalidInput as `prepare_stereo`,
  // DeviceFailure, Cancelled.
  PlaneMethod(const LightField& light_field, const PlaneParameters& parameters, Device device,
              const Progress& progress)
      : lf_(light_field),
        parameters_(parameters),
        device_(device),
        data_(light_field, parameters_, device) {
    data_.begin(progress);
    range_ = data_.stereo().range;
  }

  [[nodiscard]] ViewIndex first_view() const override {
    return parameters_.matching.view.value_or(lf_.center());
  }
  [[nodiscard]] Interval range() const override { return range_; }
  [[nodiscard]] const LightField& compared() const override { return data_.light_field(); }

  [[nodiscard]] Estimate estimate_first(const Progress& progress) override {
    Estimate estimate = estimate_view(data_, parameters_, {}, progress);
    data_.stereo() = {};
    return estimate;
  }
  [[nodiscard]] Estimate estimate_next(ViewIndex view, const std::vector<Estimate>& maps,
                                       const Progress& progress) override {
    return estimate_next_view(compared(), parameters_, device_, view, maps, progress);
  }

  [[nodiscard]] std::vector<double> facts() const override { return data_.evened(); }
  void restore(const std::vector<double>& facts, const Progress& progress) override {
    data_.restore(facts, progress);
  }

  // As measured, with what the allocator keeps.
  [[nodiscard]] double bytes_of_view() const override {
    constexpr double kBesideCosts = 160;
    return kBesideCosts * lf_.height() * lf_.width();
  }

 private:
  const LightField& lf_;
  PlaneParameters parameters_;
  Device device_;
  EqualizedViews data_;
  Interval range_;
};

BlockwiseRun planes_in_blocks(const LightField& lf, const PlaneParameters& parameters,
                              ViewSelection views, const Progress& progress) {
  return carried_in_blocks(lf, std::make_unique<PlaneMethod>(lf, parameters, Device::Cpu, progress),
                           views, progress.threads());
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
             "Beside jumps, take the median of the surroundings, weighted by likeness of color"})
      .part(&P::islands, island_schema())
      .search("smoothness", {0.75, 1.5, 3})
      .search("rounds", {0, 1, 2});
}

Estimate estimate_planes(const LightField& lf, const PlaneParameters& parameters,
                         ViewSelection views, const Progress& progress, Device device) {
  PlaneMethod method(lf, parameters, device, progress.part(0, 0.02));
  return run_carried(method, views, progress.part(0.02, 1));
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
       .devices = {Device::Cpu, Device::Cuda},
       .sees_even_views = false},  // evens them itself, and again as it learns more
      plane_pm_schema(), estimate_planes, planes_in_blocks);
}

}  // namespace episcope
