// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/epi_c.h"

#include "engine/core/finding.h"
#include "engine/core/parallel.h"
#include "engine/cuda/orientations.h"
#include "engine/cuda/tv_l2.h"
#include "engine/disparity/kernels/line_kernel.h"
#include "engine/disparity/kernels/shared_constants.h"
#include "engine/solvers/ordering_terms.h"
#include "engine/solvers/tv_l2.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace episcope {
namespace {

// One view that lines of another reach, by `steps` in its row or column of the grid.
struct Reached {
  ImageView<const float> disparity, confidence;
  bool vertical = false;
  float steps = 0;
};

std::vector<Reached> views_reached(const ViewStack<float>& disparity,
                                   const ViewStack<float>& confidence, ViewIndex from) {
  std::vector<Reached> reached;
  for (int k = -kOccludedReach; k <= kOccludedReach; ++k) {
    if (k == 0) continue;
    for (const bool vertical : {false, true}) {
      const ViewIndex view{from.v + (vertical ? k : 0), from.u + (vertical ? 0 : k)};
      if (!disparity.contains(view)) continue;
      reached.push_back(
          {disparity.view(view), confidence.view(view), vertical, static_cast<float>(k)});
    }
  }
  return reached;
}

// What lies farther than a ray at the ends of its line.
struct Farther {
  std::array<float, 4 * kOccludedReach> disparity{};
  int count = 0;

  float median() {
    const auto middle = disparity.begin() + count / 2;
    std::nth_element(disparity.begin(), middle, disparity.begin() + count);
    return *middle;
  }
};

void look_along(const Reached& view, PixelIndex p, float disparity, float confidence,
                Farther& farther) {
  const int last = (view.vertical ? view.disparity.height : view.disparity.width) - 1;
  const float at = static_cast<float>(view.vertical ? p.y : p.x) - disparity * view.steps;
  if (!(at >= 0 && at <= static_cast<float>(last))) return;
  const int nearest = static_cast<int>(at + 0.5F);
  const int y = view.vertical ? nearest : p.y, x = view.vertical ? p.x : nearest;
  const float met = view.disparity.at(y, x);
  if (met < disparity - kOccludedFarther && view.confidence.at(y, x) >= confidence) {
    farther.disparity[farther.count++] = met;
  }
}

// Decides rows of one view after the other; one per thread.
class Replacer {
 public:
  Replacer(const PackedViews& views, const ViewStack<float>& disparity,
           const ViewStack<float>& confidence, float noise)
      : disparity_(disparity),
        confidence_(confidence),
        tolerance_(kOccludedTolerance * noise),
        residuals_(views),
        farther_(disparity.width()),
        residual_(disparity.width()) {}

  void begin(ViewIndex view) {
    view_ = view;
    reached_ = views_reached(disparity_, confidence_, view);
    least_views_ =
        std::max(kOccludedMinViews, static_cast<int>(reached_.size()) / kOccludedMinShare);
    residuals_.begin(view);
  }

  // Returns the number of rays changed.
  long replace(int y, float* out) {
    const float* const own = disparity_.view(view_).row(y);
    if (!find_farther(y)) return 0;
    std::copy_n(residuals_.row(y, farther_.data()), residual_.size(), residual_.data());
    const float* const own_residual = residuals_.row(y, own);
    long changed = 0;
    for (std::size_t x = 0; x < farther_.size(); ++x) {
      if (farther_[x] == own[x] || !(residual_[x] <= own_residual[x] + tolerance_)) continue;
      out[x] = farther_[x];
      ++changed;
    }
    return changed;
  }

 private:
  // What each ray of a row could be instead; its own disparity where nothing. Whether there is any.
  bool find_farther(int y) {
    const float* const own = disparity_.view(view_).row(y);
    const float* const confidence = confidence_.view(view_).row(y);
    bool has_any = false;
    for (int x = 0; x < disparity_.width(); ++x) {
      Farther farther;
      for (const Reached& view : reached_) {
        look_along(view, {y, x}, own[x], confidence[x], farther);
      }
      const bool is_seen_through = farther.count >= least_views_;
      farther_[x] = is_seen_through ? farther.median() : own[x];
      has_any = has_any || is_seen_through;
    }
    return has_any;
  }

  const ViewStack<float>&disparity_, &confidence_;
  float tolerance_;
  LineResiduals residuals_;
  std::vector<float> farther_, residual_;
  std::vector<Reached> reached_;
  int least_views_ = kOccludedMinViews;
  ViewIndex view_;
};

// A line violates the ordering where D u is below this, px.
constexpr float kOrderingViolation = -0.05F;
// The least data weight. Less than in EPI_S: pixels that the views contradict should follow their
// neighbors entirely.
constexpr float kOrderingLeastWeight = 0.001F;

constexpr std::array<ViewIndex, 4> kNeighborWays = {{{0, 1}, {0, -1}, {1, 0}, {-1, 0}}};
[[nodiscard]] inline ViewIndex neighbor(ViewIndex view, ViewIndex way) {
  return {view.v + way.v, view.u + way.u};
}
// A point moves by −d per step of u or v.
[[nodiscard]] inline LineStep step_along(ViewIndex way) {
  return {way.v != 0, static_cast<float>(-(way.u + way.v))};
}

// Views that EPI_C denoises: `u` is improved and covers their neighbors in the grid as well, `f`
// is what was observed.
struct OrderedViews {
  const LightField& light_field;
  const EpiCParameters& parameters;
  const ViewStack<float>& f;
  const ViewStack<float>& confidence;
  ViewStack<float>& u;
  [[nodiscard]] OrderingPenalty penalty() const;
};

// Lines from some views that stay within the image, and those that violate the ordering.
struct LineCount {
  long violations = 0, lines = 0;
  LineCount& operator+=(const LineCount& other);
  [[nodiscard]] double share() const;
};

// Calls visit(neighbor, way) for the neighbors of a view whose lines count.
template <class Visit>
void for_each_neighbor(const OrderedViews& work, ViewIndex view, const Visit& visit) {
  for (const ViewIndex way : kNeighborWays) {
    const ViewIndex other = neighbor(view, way);
    if (work.u.contains(other) && count_valid(work.light_field, other) > 0) visit(other, way);
  }
}

// Improves one view after the other; one per thread.
class ViewStep {
 public:
  explicit ViewStep(const OrderedViews& work)
      : work_(work),
        solver_(work.u.height(), work.u.width()),
        weights_(work.u.height(), work.u.width()),
        observed_(weights_.height(), weights_.width()),
        curvature_(weights_.height(), weights_.width()),
        force_(weights_.height(), weights_.width()) {}

  // Returns the relative gap.
  double improve(ViewIndex view, const Progress& progress) {
    pull_from_neighbors(view, progress);
    majorize(view);
    const DenoiseParameters& parameters = work_.parameters.denoising;
    const Image<float> edges =
        smoothness_weights(work_.light_field, view, parameters.edge_strength);
    return solver_
        .solve({observed_, weights_, edges, parameters.lambda},
               {parameters.stop.max_iterations, parameters.stop.gap}, progress, work_.u.view(view))
        .relative_gap();
  }

 private:
  void pull_from_neighbors(ViewIndex view, const Progress& progress) {
    std::fill(curvature_.begin(), curvature_.end(), 0.0F);
    std::fill(force_.begin(), force_.end(), 0.0F);
    const ImageView<const float> here = std::as_const(work_.u).view(view);
    const OrderingPull pull{curvature_.view(), force_.view()};
    for_each_neighbor(work_, view, [&](ViewIndex other, ViewIndex way) {
      const ImageView<const float> there = std::as_const(work_.u).view(other);
      progress.check();
      add_pull_on_from(here, here, there, step_along(way), work_.penalty(), pull);
      const ViewIndex back{-way.v, -way.u};
      add_pull_on_to(there, there, here, step_along(back), work_.penalty(), pull);
    });
  }

  // ½ w (u − f)² and the majorizer as one weighted observation.
  void majorize(ViewIndex view) {
    fill_data_weights(work_.confidence.view(view),
                      {work_.parameters.denoising.weight_power, kOrderingLeastWeight}, weights_);
    const float* const f = work_.f.view(view).data;
    const float* const u = work_.u.view(view).data;
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      const float w = weights_.data()[i], c = curvature_.data()[i];
      observed_.data()[i] = (w * f[i] + c * u[i] + force_.data()[i]) / (w + c);
      weights_.data()[i] = w + c;
    }
  }

  const OrderedViews& work_;
  TvL2Solver solver_;
  Image<float> weights_, observed_, curvature_, force_;
};

OrderingPenalty OrderedViews::penalty() const {
  return {static_cast<float>(std::min(parameters.rise, parameters.fall)),
          static_cast<float>(parameters.fall), static_cast<float>(parameters.softness)};
}

// The views of a rectangle that have one color (0 or 1) of the checkerboard of the grid.
std::vector<ViewIndex> views_of_color(const ViewRectangle& rectangle, int color) {
  std::vector<ViewIndex> views;
  for (int i = 0; i < rectangle.grid.count(); ++i) {
    const ViewIndex view = rectangle.grid.view_at(i, rectangle.first);
    if ((view.u + view.v) % 2 == color) views.push_back(view);
  }
  return views;
}

// Improves views of one color, one after the other, as half a sweep of EPI_C; at
// `progress.finish_requested()` those not yet reached stay as they are. Returns the largest
// relative gap. Throws Cancelled.
double improve(const OrderedViews& work, const std::vector<ViewIndex>& views,
               const Progress& progress) {
  std::vector<double> gaps(views.size());
  parallel_for_workers(static_cast<int>(views.size()), progress, [&] {
    return [&, step = ViewStep(work)](int i) mutable {
      if (!progress.finish_requested()) gaps[i] = step.improve(views[i], progress);
    };
  });
  return views.empty() ? 0 : *std::max_element(gaps.begin(), gaps.end());
}

LineCount& LineCount::operator+=(const LineCount& other) {
  violations += other.violations;
  lines += other.lines;
  return *this;
}

double LineCount::share() const {
  return lines > 0 ? static_cast<double>(violations) / static_cast<double>(lines) : 0;
}

// Of one view; `disparity` covers its neighbors as well. `scratch` has the size of a view.
LineCount count_lines(const ViewStack<float>& disparity, ViewIndex view, Image<float>& scratch) {
  LineCount count;
  const ImageView<const float> here = disparity.view(view);
  for (const ViewIndex way : kNeighborWays) {
    if (!disparity.contains(neighbor(view, way))) continue;
    line_differences(here, here, disparity.view(neighbor(view, way)), step_along(way),
                     scratch.view());
    for (const float a : scratch) {
      count.lines += a == a ? 1 : 0;
      count.violations += a < kOrderingViolation ? 1 : 0;
    }
  }
  return count;
}

// Before each half of a sweep.
void name_sweep(int sweeps, int half, double gap, const Progress& progress) {
  if (half % 2 != 0) return;
  progress.step(fmt::format("ordering, sweep {} of {}{}", half / 2 + 1, sweeps,
                            half > 0 ? fmt::format(", gap {:.1e}", gap) : ""));
}

void keep_center(Estimate& estimate, ViewIndex center) {
  const auto cut = [&](ViewStack<float>& stack) {
    ViewStack<float> one({1, 1}, stack.height(), stack.width(), 1, center);
    std::copy_n(stack.view(center).data, one.size(), one.data());
    stack = std::move(one);
  };
  cut(estimate.field.disparity);
  cut(estimate.confidence);
}

// The same for all views of a color at once, on the device.
double improve_on_device(const OrderedViews& work, const Progress& progress) {
  const EpiCParameters& parameters = work.parameters;
  const OrderingPenalty penalty = work.penalty();
  const GridShape grid = work.u.grid();
  cuda::OrderingSweeps sweeps;
  sweeps.rise = penalty.rise;
  sweeps.fall = penalty.fall;
  sweeps.softness = penalty.softness;
  sweeps.sweeps = parameters.sweeps;
  sweeps.lambda = parameters.denoising.lambda;
  sweeps.weight_power = parameters.denoising.weight_power;
  sweeps.min_weight = kOrderingLeastWeight;
  sweeps.edge_strength = parameters.denoising.edge_strength;
  sweeps.max_iterations = parameters.denoising.stop.max_iterations;
  sweeps.gap = parameters.denoising.stop.gap;
  for (int i = 0; i < grid.count(); ++i) {
    sweeps.counts.push_back(count_valid(work.light_field, grid.view_at(i)) > 0 ? 1 : 0);
  }
  sweeps.on_half = [&](int half, double gap) {
    name_sweep(parameters.sweeps, half, gap, progress);
  };
  return cuda::sweep_in_order(work.light_field, sweeps, work.f, work.confidence, work.u, progress);
}

Schema<EpiCParameters> epi_c_schema() {
  using P = EpiCParameters;
  return Schema<P>()
      .real("fall", &P::fall,
            {"Ordering μ₋",
             "Cost of a line that meets something farther, which violates the ordering"},
            {0.001, 1, true})
      .real("rise", &P::rise,
            {"Occlusion μ₊",
             "Cost of a line that meets something nearer, which occludes its point; at most μ₋"},
            {0, 1})
      .real("softness", &P::softness,
            {"Quadratic below", "Differences along a line below this are penalized quadratically",
             "px"},
            {0.005, 0.5, true})
      .integer("sweeps", &P::sweeps,
               {"Sweeps", "Number of times every view is fitted to its neighbors; 0 = off"},
               {0, 50})
      .flag("replace_occluded", &P::replace_occluded,
            {"Replace occluded",
             "Before the first sweep, replace the disparity of rays that other views see through"})
      .part(&P::line_check, line_check_schema())
      .part(&P::denoising, denoise_schema())
      .part(&P::tensor, epi_l_schema())
      .begin_with(kProfileKey)
      .preset(kProfileKey, kPaperProfile, plain_denoising())
      .preset(kProfileKey, kPaperProfile,
              {{"lambda", 0.1},
               {"rise", 0.01},
               {"sweeps", 4},
               {"choose_sides", false},
               {"check_lines", false},
               {"replace_occluded", false}})
      .preset_search(kProfileKey, kPaperProfile, "lambda", {0.05, 0.1, 0.2, 0.4})
      .search("lambda", {0.03, 0.06, 0.12, 0.24})
      .search("fall", {0.03, 0.1, 0.3});
}

// Note of a result about both shares.
std::string ordering_note(double before, double after) {
  return fmt::format(finding_text("ordering"), 100 * after, 100 * before);
}

}  // namespace

long replace_occluded(const PackedViews& views, ViewStack<float>& disparity,
                      const ViewStack<float>& confidence, const Progress& progress) {
  const ViewStack<float> before = disparity.clone();
  const float noise = residual_noise(views, before) + kMinDifference * kMinDifference;
  std::vector<long> changed(disparity.grid().count());
  parallel_for_workers(disparity.grid().count(), progress, [&] {
    return [&, replacer = Replacer(views, before, confidence, noise)](int i) mutable {
      const ViewIndex view = disparity.view_at(i);
      replacer.begin(view);
      for (int y = 0; y < before.height(); ++y) {
        if (y % 16 == 0) progress.check();
        changed[i] += replacer.replace(y, disparity.view(view).row(y));
      }
    };
  });
  return std::accumulate(changed.begin(), changed.end(), 0L);
}

void replace_occluded(const LightField& lf, ViewStack<float>& disparity,
                      const ViewStack<float>& confidence, const Progress& progress, Device device) {
  if (device == Device::Cuda) return cuda::replace_occluded(lf, disparity, confidence, progress);
  replace_occluded(pack_views(lf, progress.part(0, 0.25)), disparity, confidence,
                   progress.part(0.25, 1));
}

double denoise_with_ordering(const LightField& lf, const EpiCParameters& parameters,
                             const ViewStack<float>& observed, Estimate& estimate,
                             const Progress& progress, Device device) {
  const OrderedViews work{lf, parameters, observed, estimate.confidence, estimate.field.disparity};
  double gap = 0;
  const GridShape grid = work.u.grid();
  const int sweeps = parameters.sweeps;
  const double steps = 2.0 * sweeps;
  if (sweeps > 0 && parameters.replace_occluded) {
    replace_occluded(lf, work.u, work.confidence, progress.part(0, 0.02), device);
  }
  const Progress fitting = progress.part(0.02, 1);
  if (device == Device::Cuda) return improve_on_device(work, fitting);
  for (int i = 0; i < 2 * sweeps && !progress.finish_requested(); ++i) {
    name_sweep(sweeps, i, gap, progress);
    const double other =
        improve(work, views_of_color({{}, grid}, i % 2), fitting.part(i / steps, (i + 1) / steps));
    gap = i % 2 == 0 ? other : std::max(gap, other);
  }
  return gap;
}

double ordering_violations(const ViewStack<float>& disparity, const Progress& progress,
                           Device device) {
  if (device == Device::Cuda) {
    const cuda::OrderedLines all =
        cuda::count_ordered_lines(disparity, kOrderingViolation, progress);
    return LineCount{all.violations, all.lines}.share();
  }
  const GridShape grid = disparity.grid();
  std::vector<LineCount> counts(grid.count());
  parallel_for(grid.count(), progress, [&](int i) {
    Image<float> scratch(disparity.height(), disparity.width());
    counts[i] = count_lines(disparity, grid.view_at(i), scratch);
  });
  LineCount sum;
  for (const LineCount& count : counts) sum += count;
  return sum.share();
}

Estimate estimate_epi_c(const LightField& lf, const EpiCParameters& parameters, ViewSelection views,
                        const Progress& progress, Device device) {
  Estimate estimate = estimate_orientations(lf, parameters.tensor, ViewSelection::All,
                                            progress.part(0, 0.08), device);
  if (!progress.finish_requested()) {
    check_lines(lf, parameters.line_check, estimate, progress.part(0.08, 0.13), device);
  }
  const ViewStack<float> observed = estimate.field.disparity.clone();
  denoise(lf, parameters.denoising, estimate, progress.part(0.13, 0.25), kOrderingLeastWeight, 0,
          device);
  ViewStack<float>& u = estimate.field.disparity;
  const double before = ordering_violations(u, progress.part(0.25, 0.26), device);
  if (parameters.sweeps > 0) {
    const double gap = denoise_with_ordering(lf, parameters, observed, estimate,
                                             progress.part(0.26, 0.97), device);
    if (gap > 0) estimate.notes = {gap_note(gap)};  // else no view was reached
  }
  const double after = ordering_violations(u, progress.part(0.97, 0.98), device);
  estimate.notes.push_back(ordering_note(before, after));
  if (views == ViewSelection::Center) keep_center(estimate, lf.center());
  clamp_to_range(estimate.field.disparity, estimate.range, progress.part(0.98, 1));
  return estimate;
}

Estimator epi_c_estimator() {
  return make_estimator<EpiCParameters>(
      {.id = "epi_c",
       .name = "EPI_C",
       .summary = "EPI_L, denoised over all views with occlusion ordering along the lines",
       .reference = "Goldluecke and Wanner 2013 [GW13]",
       .all_views = true,
       .iterative = true,
       .revision = 6,
       .devices = {Device::Cpu, Device::Cuda},
       .main_parameters = {"range", "lambda", "sweeps"}},
      epi_c_schema(), estimate_epi_c);
}

}  // namespace episcope
