// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/epi_c.h"

#include "engine/core/parallel.h"
#include "engine/cuda/ordering.h"
#include "engine/disparity/denoise.h"
#include "engine/disparity/estimator.h"
#include "engine/disparity/kernels/line_kernel.h"
#include "engine/disparity/replace_occluded.h"
#include "engine/solvers/ordering_terms.h"
#include "engine/solvers/tv_l2.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace episcope {
namespace {

// A line violates the ordering where D u is below this, px.
constexpr float kOrderingViolation = -0.05F;
// The least data weight. Less than in EPI_S: pixels that the views contradict should follow their
// neighbors entirely.
constexpr float kOrderingLeastWeight = 0.001F;

// From a view to its neighbors in the grid.
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

// Maps that are kept.
constexpr int kObserved = 0, kDenoisedMaps = 1;
// Facts, of which the first two are those of the check of lines.
enum Fact { kGapOfViews = 2, kGapOfSweep, kNoise, kBefore, kAfter, kFacts };
using Facts = std::vector<double>;

// A view more on each side, within the grid.
ViewRectangle extended_by(const ViewRectangle& views, int above, int beside, GridShape grid) {
  const ViewIndex first{std::max(views.first.v - above, 0), std::max(views.first.u - beside, 0)};
  const ViewIndex end{std::min(views.first.v + views.grid.v + above, grid.v),
                      std::min(views.first.u + views.grid.u + beside, grid.u)};
  return {first, {end.v - first.v, end.u - first.u}};
}

void copy_views(const ViewStack<float>& from, const ViewRectangle& views, ViewStack<float>& to) {
  for (int i = 0; i < views.grid.count(); ++i) {
    const ViewIndex view = views.grid.view_at(i, views.first);
    std::copy_n(from.view(view).data, from.view_size(), to.view(view).data);
  }
}

class OrderedBlocks {
 public:
  OrderedBlocks(const LightField& lf, const EpiCParameters& parameters, Interval range, int threads)
      : lf_(lf), parameters_(parameters), range_(range), threads_(threads) {}

  [[nodiscard]] int sweeps() const { return parameters_.sweeps; }
  [[nodiscard]] bool replaces() const { return sweeps() > 0 && parameters_.replace_occluded; }

  [[nodiscard]] Facts find_noise(const ReadBlock& read, const Progress& progress) const {
    Facts facts = line_check_noise(lf_, parameters_.line_check, read(whole(center())), progress);
    facts.resize(kFacts);
    return facts;
  }

  [[nodiscard]] FinishedBlock denoise_views(const MapBlock& block, const ReadBlock& read,
                                            const Facts& facts, const Progress& progress) const {
    FinishedBlock made{read(block)};
    const LineCheck& check = parameters_.line_check;
    if (check.does_anything()) {
      const PackedViews packed = pack_around(lf_, block.views, kMaxArmViews, progress.part(0, 0.1));
      check_lines(packed, check, facts, made.maps, progress.part(0.1, 0.4));
    }
    ViewStack<float>& disparity = made.maps.field.disparity;
    made.maps.kept.push_back(disparity.clone());
    const double gap = denoise(lf_, parameters_.denoising, {kOrderingLeastWeight}, disparity,
                               made.maps.confidence, progress.part(0.4, 1));
    made.maps.kept.push_back(disparity.clone());
    made.facts = facts;
    made.facts[kGapOfViews] = std::max(gap, facts[kGapOfViews]);
    return made;
  }

  [[nodiscard]] Facts find_replacement_noise(const ReadBlock& read, Facts facts,
                                             const Progress& progress) const {
    const PackedViews packed = pack_around(lf_, center(), kMaxArmViews, progress);
    const ViewStack<float> denoised = read.kept(whole(center()), kDenoisedMaps);
    facts[kNoise] = replacement_noise(packed, lf_.center(), denoised.view(lf_.center()));
    return facts;
  }

  [[nodiscard]] FinishedBlock replace(const MapBlock& block, const ReadBlock& read,
                                      const Facts& facts, const Progress& progress) const {
    const ViewRectangle reached = extended_by(block.views, kMaxArmViews, kMaxArmViews, lf_.grid());
    ViewStack<float> before = views_of(reached), confidence = views_of(reached);
    for (const ViewRectangle& arms : {extended_by(block.views, 0, kMaxArmViews, lf_.grid()),
                                      extended_by(block.views, kMaxArmViews, 0, lf_.grid())}) {
      copy_views(read.kept(whole(arms), kDenoisedMaps), arms, before);
      copy_views(read(whole(arms)).confidence, arms, confidence);
    }
    const PackedViews packed = pack_around(lf_, block.views, kMaxArmViews, progress.part(0, 0.1));
    FinishedBlock made{read(block)};
    replace_occluded(packed, static_cast<float>(facts[kNoise]), before, confidence,
                     made.maps.field.disparity, progress.part(0.1, 1));
    return made;
  }

  // Half a sweep; the second half counts the gap of both.
  [[nodiscard]] FinishedBlock sweep(int half, const MapBlock& block, const ReadBlock& read,
                                    const Facts& facts, const Progress& progress) const {
    const ViewRectangle reached = extended_by(block.views, 1, 1, lf_.grid());
    ViewStack<float> u = read(whole(reached)).field.disparity;
    FinishedBlock made{read(block)};
    const ViewStack<float> observed = read.kept(block, kObserved);
    const double gap = improve({lf_, parameters_, observed, made.maps.confidence, u},
                               views_of_color(block.views, half % 2), progress);
    copy_views(u, block.views, made.maps.field.disparity);
    made.facts = facts;
    made.facts[kGapOfSweep] = std::max(gap, facts[kGapOfSweep]);
    return made;
  }

  [[nodiscard]] Facts count_violations(const ReadBlock& read, Facts facts,
                                       const Progress& progress) const {
    LineCount before, after;
    Image<float> scratch(lf_.height(), lf_.width());
    for (int i = 0; i < lf_.grid().count(); ++i) {
      progress.check();
      const ViewIndex view = lf_.grid().view_at(i);
      const MapBlock block = whole(extended_by({view, {1, 1}}, 1, 1, lf_.grid()));
      before += count_lines(read.kept(block, kDenoisedMaps), view, scratch);
      after += count_lines(read(block).field.disparity, view, scratch);
    }
    facts[kBefore] = before.share();
    facts[kAfter] = after.share();
    return facts;
  }

  [[nodiscard]] FinishedBlock finish(const MapBlock& block, const ReadBlock& read,
                                     const Progress& progress) const {
    FinishedBlock made{read(block)};
    clamp_to_range(made.maps.field.disparity, range_, progress);
    return made;
  }

  // What a view takes that is denoised, with what is looked at around it.
  [[nodiscard]] double bytes_of_denoised(int count) const {
    constexpr double kMaps = 17, kSmoothed = 96, kChecked = 24;
    return around_bytes(count, 4) +
           pixels() * (kMaps * count + kChecked + kSmoothed * std::min(count, threads_));
  }
  [[nodiscard]] double bytes_of_replaced(int count) const {
    constexpr double kMaps = 9, kReplaced = 24;
    return around_bytes(count, 20) + pixels() * (kMaps * count + kReplaced);
  }
  [[nodiscard]] double bytes_of_swept(int count) const {
    constexpr double kAround = 8, kMaps = 13, kSwept = 124;
    const double looked_at = lf_.is_on_disk() ? sample_bytes() * std::min(count, threads_) : 0;
    return pixels() *
               (kAround * 3 * (count + 2) + kMaps * count + kSwept * std::min(count, threads_)) +
           looked_at;
  }
  [[nodiscard]] double bytes_of_finished(int count) const {
    constexpr double kMaps = 9, kCounted = 9 * 12 + 4;
    return pixels() * std::max(kMaps * count, kCounted);
  }

 private:
  [[nodiscard]] ViewRectangle center() const { return {lf_.center(), {1, 1}}; }
  [[nodiscard]] MapBlock whole(const ViewRectangle& views) const {
    return {views, 0, lf_.height()};
  }
  [[nodiscard]] ViewStack<float> views_of(const ViewRectangle& views) const {
    return {views.grid, lf_.height(), lf_.width(), 1, views.first};
  }
  [[nodiscard]] double pixels() const { return static_cast<double>(lf_.height()) * lf_.width(); }
  // Of a view.
  [[nodiscard]] double sample_bytes() const {
    return static_cast<double>(lf_.byte_size()) / lf_.grid().count();
  }
  [[nodiscard]] double around_bytes(int count, double of_pixel) const {
    return packed_around(count, kMaxArmViews) *
           (of_pixel * pixels() + (lf_.is_on_disk() ? sample_bytes() : 0));
  }

  const LightField& lf_;
  EpiCParameters parameters_;
  Interval range_;
  int threads_;
};

using OrderedBlocksPtr = std::shared_ptr<const OrderedBlocks>;

BlockPass views_pass(std::string step) {
  BlockPass pass;
  pass.step = std::move(step);
  pass.unit = BlockUnit::Views;
  return pass;
}

BlockPass denoising(const OrderedBlocksPtr& blocks) {
  BlockPass pass = views_pass("checking lines and denoising");
  pass.bytes = [blocks](int count) { return blocks->bytes_of_denoised(count); };
  pass.prepare = [blocks](const ReadBlock& read, const Facts&, const Progress& progress) {
    return blocks->find_noise(read, progress);
  };
  pass.compute = [blocks](const MapBlock& block, const ReadBlock& read, const Facts& facts,
                          const Progress& progress) {
    return blocks->denoise_views(block, read, facts, progress);
  };
  return pass;
}

BlockPass replacing(const OrderedBlocksPtr& blocks) {
  BlockPass pass = views_pass("replacing rays that other views see through");
  pass.bytes = [blocks](int count) { return blocks->bytes_of_replaced(count); };
  pass.prepare = [blocks](const ReadBlock& read, const Facts& facts, const Progress& progress) {
    return blocks->find_replacement_noise(read, facts, progress);
  };
  pass.compute = [blocks](const MapBlock& block, const ReadBlock& read, const Facts& facts,
                          const Progress& progress) {
    return blocks->replace(block, read, facts, progress);
  };
  return pass;
}

BlockPass sweeping(const OrderedBlocksPtr& blocks, int half) {
  BlockPass pass =
      views_pass(fmt::format("ordering, sweep {} of {}", half / 2 + 1, blocks->sweeps()));
  pass.bytes = [blocks](int count) { return blocks->bytes_of_swept(count); };
  if (half % 2 == 0) {
    pass.prepare = [](const ReadBlock&, Facts facts, const Progress&) {
      facts[kGapOfSweep] = 0;
      return facts;
    };
  }
  pass.compute = [blocks, half](const MapBlock& block, const ReadBlock& read, const Facts& facts,
                                const Progress& progress) {
    return blocks->sweep(half, block, read, facts, progress);
  };
  return pass;
}

BlockPass finishing(const OrderedBlocksPtr& blocks) {
  BlockPass pass = views_pass("counting violations of the ordering");
  pass.bytes = [blocks](int count) { return blocks->bytes_of_finished(count); };
  pass.prepare = [blocks](const ReadBlock& read, const Facts& facts, const Progress& progress) {
    return blocks->count_violations(read, facts, progress);
  };
  pass.compute = [blocks](const MapBlock& block, const ReadBlock& read, const Facts&,
                          const Progress& progress) {
    return blocks->finish(block, read, progress);
  };
  return pass;
}

// One block that needs the maps of all views.
BlockwiseRun center_in_one(const LightField& lf, const EpiCParameters& parameters, BlockwiseRun run,
                           int threads) {
  run.maps = {{1, 1}, lf.center(), lf.height(), lf.width()};
  BlockPass pass = views_pass("estimating all views for the one in the middle");
  pass.only = {lf.center()};
  pass.bytes = [&lf, threads](int) {
    constexpr double kOfRay = 20, kOfView = 124;
    const double rays = static_cast<double>(lf.height()) * lf.width() * lf.grid().count();
    return kOfRay * rays + kOfView * threads * lf.height() * lf.width() +
           (lf.is_on_disk() ? static_cast<double>(lf.byte_size()) : 0);
  };
  pass.compute = [&lf, parameters](const MapBlock&, const ReadBlock&, const Facts&,
                                   const Progress& progress) {
    Estimate estimate = estimate_epi_c(lf, parameters, ViewSelection::Center, progress);
    FinishedBlock made{{std::move(estimate.field), std::move(estimate.confidence)}};
    made.notes = std::move(estimate.notes);
    return made;
  };
  run.passes = {std::move(pass)};
  return run;
}

// EPI_C in blocks: orientations in bands of rows; then views of one row of the grid after the
// other, whose lines are checked and which are denoised by themselves; then rays that other views
// see through are replaced, and every half of a sweep is one pass, which needs the views above and
// below. What was observed and what was denoised before the first sweep are kept. The center view
// alone needs all others and is one block.
//
// Refers to the light field. Takes no result early. Throws as `estimate_epi_c`.
BlockwiseRun epi_c_in_blocks(const LightField& lf, const EpiCParameters& parameters,
                             ViewSelection views, const Progress& progress) {
  BlockwiseRun run = orientations_in_blocks(lf, parameters.tensor, ViewSelection::All, progress);
  if (views == ViewSelection::Center) {
    return center_in_one(lf, parameters, std::move(run), progress.threads());
  }
  const auto blocks = std::make_shared<const OrderedBlocks>(lf, parameters, run.provenance.range,
                                                            progress.threads());
  run.kept = 2;
  run.passes.push_back(denoising(blocks));
  if (blocks->replaces()) run.passes.push_back(replacing(blocks));
  for (int half = 0; half < 2 * blocks->sweeps(); ++half) {
    run.passes.push_back(sweeping(blocks, half));
  }
  run.passes.push_back(finishing(blocks));
  run.notes = [](const BlockProgress& end) {
    const Facts& facts = end.facts;
    const double gap = facts[kGapOfSweep] > 0 ? facts[kGapOfSweep] : facts[kGapOfViews];
    return std::vector<std::string>{gap_note(gap), ordering_note(facts[kBefore], facts[kAfter])};
  };
  return run;
}

// λ Σ g |∇u| + ½ Σ w (u − f)² of one view.
double own_energy(const OrderedViews& work, ViewIndex view, ImageView<const float> u,
                  const Image<float>& edges) {
  const DenoiseParameters& parameters = work.parameters.denoising;
  Image<float> weights(u.height, u.width);
  fill_data_weights(work.confidence.view(view), {parameters.weight_power, kOrderingLeastWeight},
                    weights);
  double sum = 0;
  for (int y = 0; y < u.height; ++y) {
    const float* const row = u.row(y);
    const float* const below = u.row(std::min(y + 1, u.height - 1));
    const float* const f = work.f.view(view).row(y);
    const float* const w = weights.row(y);
    const float* const g = edges.row(y);
    const auto lambda = static_cast<float>(parameters.lambda);
    float of_row = 0;
    for (int x = 0; x < u.width; ++x) {
      const float right = row[std::min(x + 1, u.width - 1)] - row[x], down = below[x] - row[x];
      const float off = row[x] - f[x];
      of_row += lambda * g[x] * std::sqrt(right * right + down * down) + 0.5F * w[x] * off * off;
    }
    sum += static_cast<double>(of_row);
  }
  return sum;
}

// The same and its lines.
double energy_of(const OrderedViews& work, ViewIndex view, const Image<float>& edges) {
  const ImageView<const float> u = std::as_const(work.u).view(view);
  double sum = own_energy(work, view, u, edges);
  for_each_neighbor(work, view, [&](ViewIndex other, ViewIndex way) {
    sum +=
        ordering_energy(u, u, std::as_const(work.u).view(other), step_along(way), work.penalty());
  });
  return sum;
}

// Before each half of a sweep.
void name_sweep(int sweeps, int half, double gap, const Progress& progress) {
  if (half % 2 != 0) return;
  progress.step(fmt::format("ordering, sweep {} of {}{}", half / 2 + 1, sweeps,
                            half > 0 ? fmt::format(", gap {:.1e}", gap) : ""));
}

// Keeps the view in the middle.
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

}  // namespace

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

double epi_c_energy(const LightField& lf, const EpiCParameters& parameters,
                    const ViewStack<float>& observed, Estimate& estimate,
                    const Progress& progress) {
  const OrderedViews work{lf, parameters, observed, estimate.confidence, estimate.field.disparity};
  const GridShape grid = work.u.grid();
  std::vector<double> energies(grid.count());
  parallel_for(grid.count(), progress, [&](int i) {
    const ViewIndex view = grid.view_at(i);
    const Image<float> edges = smoothness_weights(lf, view, parameters.denoising.edge_strength);
    energies[i] = energy_of(work, view, edges);
  });
  return std::accumulate(energies.begin(), energies.end(), 0.0);
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

std::string ordering_note(double before, double after) {
  return fmt::format("ordering violated by {:.3f} % of the lines, {:.3f} % before", 100 * after,
                     100 * before);
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
            {"Softness", "Differences along a line below this are penalized quadratically", "px"},
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
       .devices = {Device::Cpu, Device::Cuda}},
      epi_c_schema(), estimate_epi_c, epi_c_in_blocks);
}

}  // namespace episcope
