// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/plane_pm.h"

#include "engine/core/estimate.h"
#include "engine/core/light_field.h"
#include "engine/core/memory.h"
#include "engine/core/photometric_correction.h"
#include "engine/core/progress.h"
#include "engine/core/view_gain.h"
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

// The corners of the grid but `from`: the views that see most of what it does not.
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

ViewStack<float> rows_of_all(const MapGeometry& maps, int rows) {
  return {maps.grid, rows, maps.width, 1, maps.first};
}

void copy_rows(ImageView<const float> from, int from_row, int rows, float* to) {
  std::copy_n(from.row(from_row), static_cast<std::size_t>(rows) * from.width, to);
}

class PlaneBlocks {
 public:
  PlaneBlocks(const LightField& light_field, const PlaneParameters& parameters,
              ViewSelection selection, const Progress& progress)
      : lf_(light_field),
        parameters_(parameters),
        data_(light_field, parameters_, Device::Cpu),
        from_(parameters.matching.view.value_or(light_field.center())),
        threads_(progress.threads()) {
    data_.begin(progress);
    range_ = data_.stereo().range;
    views_ = {from_};
    maps_ = {{1, 1}, from_, lf_.height(), lf_.width()};
    if (selection == ViewSelection::Center || lf_.grid().count() == 1) return;
    maps_ = {lf_.grid(), {}, lf_.height(), lf_.width()};
    for (const ViewIndex view : outermost_views(lf_.grid(), from_)) views_.push_back(view);
  }

  [[nodiscard]] const MapGeometry& maps() const { return maps_; }
  [[nodiscard]] Interval range() const { return range_; }
  // Those that are estimated.
  [[nodiscard]] const std::vector<ViewIndex>& views() const { return views_; }

  [[nodiscard]] FinishedBlock estimate(ViewIndex view, const ReadBlock& read,
                                       const std::vector<double>& facts, const Progress& progress) {
    const MemorySetAside aside(static_cast<std::size_t>(bytes_of_view()));
    FinishedBlock made;
    if (view == from_) {
      known_.push_back(estimate_view(data_, parameters_, {}, progress));
      made.notes = known_.back().notes;
      made.facts = data_.evened();
      data_.stereo() = {};
    } else {
      restore(facts, progress.part(0, 0.02));
      const auto before = std::ranges::find(views_, view) - views_.begin();
      load(static_cast<std::size_t>(before), read);
      known_.push_back(estimate_next_view(data_.light_field(), parameters_, Device::Cpu, view,
                                          known_, progress.part(0.02, 1)));
    }
    is_restored_ = true;
    made.maps.field.disparity = known_.back().field.disparity.clone();
    made.maps.confidence = known_.back().confidence.clone();
    return made;
  }

  [[nodiscard]] FinishedBlock carry(const MapBlock& block, const ReadBlock& read,
                                    const Progress& progress) {
    load(views_.size(), read);
    PropagatedMaps carried = propagate_to_views(known_, block.views, progress);
    for (const Estimate& map : known_) put_map(map, 0, carried.disparity, carried.confidence);
    return {{{std::move(carried.disparity), {}}, std::move(carried.confidence)}};
  }

  [[nodiscard]] FinishedBlock choose(const MapBlock& block, const ReadBlock& read,
                                     const std::vector<double>& facts, const Progress& progress) {
    load(views_.size(), read);
    restore(facts, progress.part(0, 0.02));
    begin_sides(progress.part(0.02, 0.05));
    const int first = std::max(block.first_row - reach_, 0);
    const int end = std::min(block.end_row + reach_, maps_.height);
    const LightField& compared = data_.light_field();
    compared.fetch_samples(first, end);
    const ViewStack<float> before = rows_before(first, block.first_row, end, read, progress);
    const PackedViews packed = pack_rows(compared, first, end, progress.part(0.1, 0.2));
    FinishedBlock made{read(block)};
    choose_propagated_sides({packed, before, first, maps_.height}, cap_, block.first_row,
                            made.maps.field.disparity, progress.part(0.2, 1));
    for (const Estimate& map : known_) {
      put_map(map, block.first_row, made.maps.field.disparity, made.maps.confidence);
    }
    keep(before, first, std::max(block.end_row - reach_, first), block.end_row);
    return made;
  }

  // Beside large arrays, as measured, with what the allocator keeps.
  [[nodiscard]] double bytes_of_view() const {
    constexpr double kBesideCosts = 160;
    return pixels() * (kBesideCosts + kOfMap * static_cast<double>(views_.size()));
  }
  [[nodiscard]] double bytes_of_carried(int count) const {
    const auto known = static_cast<double>(views_.size());
    const double shown = kOfMap * known + sizeof(float);
    return pixels() * (kOfMap * (known + count) + shown * std::min(count, threads_));
  }
  [[nodiscard]] double bytes_of_bands(int rows) const {
    const double farthest = std::max(std::abs(range_.min), std::abs(range_.max)) + 0.5;
    const int reach = propagated_reach(maps_.grid, farthest);
    const double band = std::min(rows + 2 * reach, maps_.height);
    const double rays = static_cast<double>(maps_.grid.count()) * maps_.width;
    const double sample =
        static_cast<double>(lf_.byte_size()) / static_cast<double>(maps_.grid.count()) / pixels();
    const double looked_at = lf_.is_on_disk() ? sample : 0;
    constexpr double kBeforeAndRead = 12, kMade = 9, kKept = 4;
    return pixels() * (kOfMap + sizeof(float)) * static_cast<double>(views_.size()) +
           rays * ((kBeforeAndRead + looked_at) * band + kMade * rows + kKept * reach);
  }

 private:
  static constexpr double kOfMap = 8;

  [[nodiscard]] double pixels() const { return static_cast<double>(maps_.height) * maps_.width; }

  // The light field as it is compared.
  void restore(const std::vector<double>& facts, const Progress& progress) {
    if (!is_restored_) data_.restore(facts, progress);
    is_restored_ = true;
  }

  // The first maps, as far as this program has not made them.
  void load(std::size_t count, const ReadBlock& read) {
    while (known_.size() < count) {
      const ViewIndex view = views_[known_.size()];
      BlockMaps stored = read({{view, {1, 1}}, 0, maps_.height});
      Estimate map;
      map.range = range_;
      map.field = std::move(stored.field);
      map.confidence = std::move(stored.confidence);
      known_.push_back(std::move(map));
    }
  }

  [[nodiscard]] ViewStack<float> carried_disparity(ViewIndex view, const Progress& progress) const {
    return propagate_to_views(known_, {view, {1, 1}}, progress).disparity;
  }

  // What all bands have in common.
  void begin_sides(const Progress& progress) {
    if (reach_ > 0) return;
    double farthest = 0;
    for (const Estimate& map : known_) {
      const ViewStack<float>& disparity = map.field.disparity;
      for (std::size_t i = 0; i < disparity.size(); ++i) {
        farthest = std::max<double>(farthest, std::abs(disparity.data()[i]));
      }
      carried_.push_back(carried_disparity(disparity.first(), progress.part(0, 0)));
    }
    cap_ = propagated_cap(data_.light_field(), from_, progress);
    reach_ = propagated_reach(maps_.grid, farthest);
  }

  // Carried maps of all views, rows [first, end), of which those before `replaced` may be lost.
  [[nodiscard]] ViewStack<float> rows_before(int first, int replaced, int end,
                                             const ReadBlock& read,
                                             const Progress& progress) const {
    const ViewStack<float> stored =
        read({{maps_.first, maps_.grid}, replaced, end}).field.disparity;
    const bool is_kept = !kept_.empty() && kept_first_ <= first && kept_end_ == replaced;
    ViewStack<float> before = rows_of_all(maps_, end - first);
    for (int i = 0; i < maps_.grid.count(); ++i) {
      const ViewIndex view = maps_.grid.view_at(i);
      const ImageView<float> out = before.view(view);
      copy_rows(stored.view(view), 0, end - replaced, out.row(replaced - first));
      if (first == replaced) continue;
      if (is_kept) {
        copy_rows(kept_.view(view), first - kept_first_, replaced - first, out.row(0));
      } else {
        const ViewStack<float> again = carried_disparity(view, progress.part(0.05, 0.05));
        copy_rows(again.view(view), first, replaced - first, out.row(0));
      }
    }
    // Views that were estimated are stored as they were, not as they are carried.
    for (const ViewStack<float>& carried : carried_) {
      copy_rows(carried.view(carried.first()), first, end - first,
                before.view(carried.first()).row(0));
    }
    return before;
  }

  // Rows that the next band looks at.
  void keep(const ViewStack<float>& before, int first, int keep_first, int keep_end) {
    kept_ = rows_of_all(maps_, keep_end - keep_first);
    kept_first_ = keep_first;
    kept_end_ = keep_end;
    for (int i = 0; i < maps_.grid.count(); ++i) {
      const ViewIndex view = maps_.grid.view_at(i);
      copy_rows(before.view(view), keep_first - first, keep_end - keep_first,
                kept_.view(view).row(0));
    }
  }

  const LightField& lf_;
  PlaneParameters parameters_;
  EqualizedViews data_;
  ViewIndex from_;
  int threads_;
  Interval range_;
  MapGeometry maps_;
  std::vector<ViewIndex> views_;
  bool is_restored_ = false;
  std::vector<Estimate> known_;  // Of the first of `views_`.
  // Of the choice of sides: what known maps are where they are carried to their own views, and rows
  // that were replaced.
  std::vector<ViewStack<float>> carried_;
  float cap_ = 0;
  int reach_ = 0;
  ViewStack<float> kept_;
  int kept_first_ = 0, kept_end_ = 0;
};

using SharedPlanes = std::shared_ptr<PlaneBlocks>;

BlockPass estimating(const SharedPlanes& planes) {
  BlockPass pass;
  pass.step = "estimating views";
  pass.unit = BlockUnit::Views;
  pass.only = planes->views();
  pass.bytes = [planes](int) { return planes->bytes_of_view(); };
  pass.compute = [planes](const MapBlock& block, const ReadBlock& read,
                          const std::vector<double>& facts, const Progress& progress) {
    return planes->estimate(block.views.first, read, facts, progress);
  };
  return pass;
}

BlockPass carrying(const SharedPlanes& planes) {
  BlockPass pass;
  pass.step = "carrying to other views";
  pass.unit = BlockUnit::Views;
  pass.bytes = [planes](int count) { return planes->bytes_of_carried(count); };
  pass.compute = [planes](const MapBlock& block, const ReadBlock& read, const std::vector<double>&,
                          const Progress& progress) {
    return planes->carry(block, read, progress);
  };
  return pass;
}

BlockPass choosing(const SharedPlanes& planes) {
  BlockPass pass;
  pass.step = "choosing sides";
  pass.bytes = [planes](int rows) { return planes->bytes_of_bands(rows); };
  pass.compute = [planes](const MapBlock& block, const ReadBlock& read,
                          const std::vector<double>& facts, const Progress& progress) {
    return planes->choose(block, read, facts, progress);
  };
  return pass;
}

// Changes nothing: the last pass marks invalid pixels, whose values the choice of sides needs until
// it has ended.
BlockPass marking(const MapGeometry& maps) {
  BlockPass pass;
  pass.step = "marking invalid pixels";
  pass.bytes = [maps](int rows) {
    constexpr double kMaps = 9;
    return kMaps * rows * maps.width * maps.grid.count();
  };
  pass.compute = [](const MapBlock& block, const ReadBlock& read, const std::vector<double>&,
                    const Progress&) { return FinishedBlock{read(block)}; };
  return pass;
}

// The run of plane_pm (plane_pm.h) in blocks. Views are estimated one after the other, each of
// which is kept when it is done; then all others are carried, view by view; then sides are chosen
// in bands of rows of all views. Of a view at once it needs its costs and what occludes what;
// these are large arrays, which go to disk beyond the memory budget (memory.h). Bands need
// maps and samples of all views as far beyond them as disparities reach; rows above that the pass
// has replaced are still in memory, or, in a program that continues, carried again.
//
// Refers to the light field. Takes no result early. Throws InvalidInput as `prepare_stereo`,
// Cancelled.
BlockwiseRun planes_in_blocks(const LightField& lf, const PlaneParameters& parameters,
                              ViewSelection views, const Progress& progress) {
  const auto planes = std::make_shared<PlaneBlocks>(lf, parameters, views, progress);
  BlockwiseRun run;
  run.maps = planes->maps();
  run.provenance.range = planes->range();
  run.passes.push_back(estimating(planes));
  const std::size_t estimated = planes->views().size();
  if (run.maps.grid.count() == 1) return run;
  run.passes.push_back(carrying(planes));
  run.passes.push_back(choosing(planes));
  if (!lf.valid().empty()) run.passes.push_back(marking(run.maps));
  run.notes = [estimated](const BlockProgress&) { return std::vector{propagated_note(estimated)}; };
  return run;
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
  if (views == ViewSelection::Center || lf.grid().count() == 1) {
    EqualizedViews data(lf, parameters, device);
    data.begin(progress.part(0, 0.06));
    return estimate_view(data, parameters, {}, progress.part(0.06, 1));
  }
  const ViewIndex from = parameters.matching.view.value_or(lf.center());
  const std::vector<ViewIndex> corners = outermost_views(lf.grid(), from);
  const double share = 0.9 / static_cast<double>(corners.size() + 1);
  std::vector<Estimate> maps;
  EqualizedViews data(lf, parameters, device);
  data.begin(progress.part(0, 0.06 * share));
  maps.push_back(estimate_view(data, parameters, {}, progress.part(0.06 * share, share)));
  for (std::size_t i = 0; i < corners.size() && !progress.finish_requested(); ++i) {
    const auto done = static_cast<double>(i + 1);
    maps.push_back(estimate_next_view(data.light_field(), parameters, device, corners[i], maps,
                                      progress.part(share * done, share * (done + 1))));
  }
  PropagatedMaps carried = propagate_to_views(maps, {{}, lf.grid()}, progress.part(0.9, 0.92));
  const Estimate& first = maps.front();
  Estimate estimate;
  estimate.set_provenance(first.provenance());
  estimate.field.disparity = std::move(carried.disparity);
  estimate.confidence = std::move(carried.confidence);
  const LightField& compared = data.light_field();
  const PackedViews packed = pack_views(compared, progress.part(0.92, 0.93));
  choose_propagated_sides(packed, propagated_cap(compared, from, progress.part(0.93, 0.931)),
                          estimate, progress.part(0.931, 1));
  for (const Estimate& map : maps) put_map(map, 0, estimate.field.disparity, estimate.confidence);
  estimate.notes.push_back(propagated_note(maps.size()));
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
       .devices = {Device::Cpu, Device::Cuda},
       .sees_even_views = false},  // evens them itself, and again as it learns more
      plane_pm_schema(), estimate_planes, planes_in_blocks);
}

}  // namespace episcope
