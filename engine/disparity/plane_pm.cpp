// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/plane_pm.h"
#include "engine/disparity/propagate_planes.h"

#include "engine/core/estimate.h"
#include "engine/core/finding.h"
#include "engine/core/memory.h"
#include "engine/core/numbers.h"
#include "engine/core/parallel.h"
#include "engine/disparity/carried_run.h"
#include "engine/disparity/matching_cost.h"
#include "engine/disparity/view_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace episcope {
namespace {

// Samples that count: beyond, noise and saturation decide.
constexpr float kDarkest = 0.04F, kBrightest = 0.97F;
// Pixels between those that are looked at, and of a view about so many at most.
constexpr int kLeastStride = 3;
constexpr double kMostPoints = 30000;
constexpr int kRounds = 6;
// Steps of the fall-off that no sample would show.
constexpr double kSmallStep = 1e-4;
// Of log ratios, in medians of their size.
constexpr float kRatioTolerance = 3, kLeastTolerance = 0.05F;
constexpr double kMostFallOff = 0.9;

// What a point says of one view and channel: log of the ratio, and r² here and there.
struct Ratio {
  float log, here, there;
};

float without_fall_off(const Ratio& ratio, float k) {
  return ratio.log - std::log((1 - k * ratio.there) / (1 - k * ratio.here));
}

int stride_for(const LightField& lf) {
  const double pixels = static_cast<double>(lf.height()) * lf.width();
  return std::max(kLeastStride, static_cast<int>(std::ceil(std::sqrt(pixels / kMostPoints))));
}

bool counts(float sample) {
  return sample > kDarkest && sample < kBrightest;
}

// What is known of every view and channel, of each at most so much: beyond the memory budget on
// disk.
template <class T>
class OfChannels {
 public:
  OfChannels(std::size_t channels, std::size_t most)
      : most_(most), values_(make_large<T>(channels * most)), sizes_(channels) {}

  [[nodiscard]] std::size_t channels() const { return sizes_.size(); }
  [[nodiscard]] std::size_t most() const { return most_; }
  [[nodiscard]] std::span<const T> operator[](std::size_t channel) const {
    return {values_.get() + channel * most_, sizes_[channel]};
  }
  // Room for all that may be known of a channel, of which the first `size` then count.
  [[nodiscard]] T* room(std::size_t channel) { return values_.get() + channel * most_; }
  void set_size(std::size_t channel, std::size_t size) { sizes_[channel] = size; }

 private:
  std::size_t most_;
  LargeArray<T> values_;
  std::vector<std::size_t> sizes_;
};

using Ratios = OfChannels<Ratio>;
using Logs = OfChannels<float>;  // Of the ratios, without a fall-off.

class Points {
 public:
  Points(const LightField& lf, ViewIndex reference, ImageView<const float> disparity)
      : lf_(lf),
        reference_(reference),
        disparity_(disparity),
        here_(lf.view_as_float(reference)),
        stride_(stride_for(lf)) {}

  // The most that there are.
  [[nodiscard]] std::size_t count() const {
    const auto along = [this](int length) {
      return static_cast<std::size_t>(length / stride_) + 1;
    };
    return along(lf_.height()) * along(lf_.width());
  }

  // Those of a view, from the channel `first` on.
  void add_ratios(ViewIndex view, std::size_t first, Ratios& ratios) const {
    std::array<Ratio*, 3> room{};
    for (int c = 0; c < lf_.channels(); ++c) room[c] = ratios.room(first + c);
    std::array<std::size_t, 3> sizes{};
    const Image<float> there = lf_.view_as_float(view);
    const CornerRadius radius(lf_.height(), lf_.width());
    for (int y = 1; y < lf_.height(); y += stride_) {
      for (int x = 1; x < lf_.width(); x += stride_) {
        if (!lf_.is_valid(reference_, y, x)) continue;
        const float d = disparity_.at(y, x);
        if (d <= kNothingNear) continue;
        const float to_y = static_cast<float>(y) - d * static_cast<float>(view.v - reference_.v);
        const float to_x = static_cast<float>(x) - d * static_cast<float>(view.u - reference_.u);
        const int row = static_cast<int>(std::floor(to_y)),
                  column = static_cast<int>(std::floor(to_x));
        if (!sees(view, row, column)) continue;
        const auto here = static_cast<float>(radius.squared(y, x));
        const auto far = static_cast<float>(radius.squared(to_y, to_x));
        const float ty = to_y - static_cast<float>(row), tx = to_x - static_cast<float>(column);
        for (int c = 0; c < lf_.channels(); ++c) {
          const float a = here_.at(y, x, c);
          const float b =
              (1 - ty) * ((1 - tx) * there.at(row, column, c) + tx * there.at(row, column + 1, c)) +
              ty *
                  ((1 - tx) * there.at(row + 1, column, c) + tx * there.at(row + 1, column + 1, c));
          if (counts(a) && counts(b)) room[c][sizes[c]++] = {std::log(b / a), here, far};
        }
      }
    }
    for (int c = 0; c < lf_.channels(); ++c) ratios.set_size(first + c, sizes[c]);
  }

 private:
  // Whether the four samples around a place are there.
  [[nodiscard]] bool sees(ViewIndex view, int row, int column) const {
    return row >= 0 && column >= 0 && row + 1 < lf_.height() && column + 1 < lf_.width() &&
           lf_.is_valid(view, row, column) && lf_.is_valid(view, row, column + 1) &&
           lf_.is_valid(view, row + 1, column) && lf_.is_valid(view, row + 1, column + 1);
  }

  const LightField& lf_;
  ViewIndex reference_;
  ImageView<const float> disparity_;
  Image<float> here_;
  int stride_;
};

void remove_fall_off(const Ratios& ratios, double fall_off, const Progress& progress, Logs& logs) {
  const auto k = static_cast<float>(fall_off);
  parallel_for(static_cast<int>(ratios.channels()), progress, [&](int i) {
    std::ranges::transform(ratios[i], logs.room(i),
                           [&](const Ratio& ratio) { return without_fall_off(ratio, k); });
    logs.set_size(i, ratios[i].size());
  });
}

std::vector<double> medians(const Logs& logs, const Progress& progress) {
  std::vector<double> middle(logs.channels());
  parallel_for(static_cast<int>(logs.channels()), progress, [&](int i) {
    if (logs[i].size() < 50) return;
    std::vector<float> values(logs[i].begin(), logs[i].end());
    middle[i] = quantile(values, 0.5);
  });
  return middle;
}

// How far ratios that fit may be off: noise sets it.
float tolerance(std::span<const float> logs, double log) {
  std::vector<float> off(logs.size());
  std::ranges::transform(logs, off.begin(),
                         [&](float each) { return std::abs(each - static_cast<float>(log)); });
  return std::max(kLeastTolerance, kRatioTolerance * static_cast<float>(quantile(off, 0.5)));
}

// Sums of a Gauss-Newton step.
struct Step {
  double product = 0, square = 1e-9;
};

Step gauss_newton_step(std::span<const Ratio> ratios, std::span<const float> logs, double log,
                       double k) {
  Step step;
  if (ratios.empty()) return step;
  const double most = tolerance(logs, log);
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    const Ratio& ratio = ratios[i];
    const double off = logs[i] - log;
    if (std::abs(off) > most) continue;
    const double slope = ratio.here / (1 - k * ratio.here) - ratio.there / (1 - k * ratio.there);
    const double trust = 1 - off * off / (most * most);
    step.product += trust * slope * off;
    step.square += trust * slope * slope;
  }
  return step;
}

// A step of k, at which the ratios have these logs, on points whose ratio fits about, the others
// being occluded or wrong.
double better_fall_off(const Ratios& ratios, const Logs& logs, double k, const Progress& progress) {
  const std::vector<double> middle = medians(logs, progress);
  std::vector<Step> steps(ratios.channels());
  parallel_for(static_cast<int>(ratios.channels()), progress,
               [&](int i) { steps[i] = gauss_newton_step(ratios[i], logs[i], middle[i], k); });
  Step sum;
  for (const Step& step : steps) {
    sum.product += step.product;
    sum.square += step.square;
  }
  return std::clamp(k + sum.product / sum.square, -kMostFallOff, kMostFallOff);
}

struct MapOfView {
  ImageView<const float> disparity, confidence;
};

// Brightness is taken from a map of which so many pixels are sure.
constexpr double kLeastSure = 0.1;

// A light field as its views are compared, without differences in brightness, and the data term of
// one view. Refers to light field and parameters. Members throw DeviceFailure, Cancelled.
class EqualizedViews {
 public:
  EqualizedViews(const LightField& lf, const PlaneParameters& parameters, Device device)
      : lf_(lf), parameters_(parameters), device_(device) {}

  // The evened one, or the given one if its views are alike.
  [[nodiscard]] const LightField& light_field() const { return even_ ? *even_ : lf_; }
  [[nodiscard]] StereoCosts& stereo() { return stereo_; }

  // By the means of the views, as nothing is known of disparities, and prepares the data term.
  void begin(const Progress& progress) {
    const ViewIndex view = parameters_.matching.view.value_or(lf_.center());
    if (parameters_.even && lf_.grid().contains(view)) {
      use(gains_of_means(lf_, view, progress.part(0, 0.2)), progress.part(0.2, 0.4));
    }
    prepare(parameters_.matching, progress.part(0.4, 1));
  }

  // By what the sure part of a map tells, and prepares it anew.
  void improve(const MapOfView& map, const Progress& progress) {
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
      note_ = fmt::format(finding_text("brightness.fall_off"), correction.fall_off);
    }
  }

  // About what was evened, for the notes of an estimate; may be empty.
  [[nodiscard]] const std::string& note() const { return note_; }

  // What was evened, in numbers of which there is one at least, and the same light field again,
  // without a data term.
  [[nodiscard]] std::vector<double> evened() const {
    std::vector<double> numbers{correction_.fall_off};
    for (const auto& gain : correction_.gains)
      numbers.insert(numbers.end(), gain.begin(), gain.end());
    return numbers;
  }

  void restore(const std::vector<double>& evened, const Progress& progress) {
    PhotometricCorrection correction;
    correction.fall_off = evened.front();
    for (std::size_t i = 1; i + 2 < evened.size(); i += 3) {
      correction.gains.push_back({evened[i], evened[i + 1], evened[i + 2]});
    }
    stereo_ = {};
    use(correction, progress);
  }

 private:
  void use(const PhotometricCorrection& correction, const Progress& progress) {
    correction_ = correction;
    even_.reset();
    if (correction.is_uneven()) even_.emplace(corrected(lf_, correction, progress));
  }

  void prepare(const StereoCostParameters& matching, const Progress& progress) {
    stereo_ =
        prepare_stereo(light_field(), MatchedViews::All, matching, progress.part(0, 0.9), device_);
    set_local_caps(light_field(), parameters_.visibility, progress.part(0.9, 1), stereo_);
  }

  const LightField& lf_;
  const PlaneParameters& parameters_;
  Device device_;
  PhotometricCorrection correction_;
  std::optional<LightField> even_;
  StereoCosts stereo_;
  std::string note_;
};

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
  const LabelCosts costs = visible_costs(lf, stereo, progress.part(0, 0.1));
  const Image<float> edges = smoothness_weights(lf, stereo.view, parameters.labeling.edge_strength);
  const PlaneRefinementData data{costs, edges, mean_cap(lf, stereo)};
  label_visible(lf, parameters, data, estimate, progress.part(0.1, is_last ? 0.65 : 0.99));
  const ImageView<float> map = estimate.field.disparity.view(stereo.view);
  if (is_last) refine_by_planes(data, parameters.refinement, progress.part(0.65, 0.98), map);
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
  estimate.notes.push_back(fmt::format(finding_text("visibility"), done - 1, rounds));
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

Schema<PlaneParameters> plane_pm_schema() {
  using P = PlaneParameters;
  return Schema<P>()
      .part(&P::visibility, visibility_schema())
      .part(&P::refinement, plane_refinement_schema())
      .part(&P::labeling, jump_labeling_schema())
      .part(&P::matching, stereo_matching_schema())
      .flag("even", &P::even,
            {"Equalize brightness",
             "Correct differences in brightness between the views, and their fall-off to the "
             "corners, where there are any"})
      .flag("silhouettes", &P::silhouettes,
            {"Place silhouettes",
             "At depth jumps, take the median of the neighbors, weighted by similarity of color"})
      .part(&P::islands, island_schema())
      .search("smoothness", {0.75, 1.5, 3})
      .search("rounds", {0, 1, 2});
}

}  // namespace

PhotometricCorrection correction_of_points(const LightField& lf, ViewIndex reference,
                                           ImageView<const float> disparity,
                                           const Progress& progress) {
  const GridShape grid = lf.grid();
  const int channels = lf.channels();
  const Points points(lf, reference, disparity);
  Ratios ratios(static_cast<std::size_t>(grid.count()) * channels, points.count());
  parallel_for(grid.count(), progress.part(0, 0.6), [&](int i) {
    if (grid.view_at(i) == reference) return;
    points.add_ratios(grid.view_at(i), static_cast<std::size_t>(i) * channels, ratios);
    lf.forget_samples();
  });
  PhotometricCorrection correction{.grid = grid};
  Logs evened(ratios.channels(), ratios.most());
  remove_fall_off(ratios, 0, progress, evened);
  for (int i = 0; i < kRounds; ++i) {
    const double before = correction.fall_off;
    correction.fall_off = better_fall_off(ratios, evened, before, progress);
    remove_fall_off(ratios, correction.fall_off, progress, evened);
    if (std::abs(correction.fall_off - before) < kSmallStep) break;
  }
  const std::vector<double> logs = medians(evened, progress);
  correction.gains.assign(grid.count(), {1, 1, 1});
  for (int i = 0; i < grid.count(); ++i) {
    for (int c = 0; c < 3; ++c) {
      correction.gains[i][c] = std::exp(logs[i * channels + std::min(c, channels - 1)]);
    }
  }
  return correction;
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
       .summary = "Multi-view stereo over visible views, refined by TGV, propagated to all views",
       .reference = "Own; builds on Kolmogorov 2006 [Kol06] and Bredies et al. 2010 [BKP10]",
       .all_views = true,
       .iterative = true,
       .revision = 7,
       .devices = {Device::Cpu, Device::Cuda},
       .sees_even_views = false,  // evens them itself, and again as it learns more
       .main_parameters = {"range", "labels", "smoothness"}},
      plane_pm_schema(), estimate_planes, planes_in_blocks);
}

}  // namespace episcope
