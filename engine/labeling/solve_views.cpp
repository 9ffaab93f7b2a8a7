// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/solve_views.h"

#include "engine/core/hash.h"
#include "engine/core/parallel.h"
#include "engine/cuda/ray_labels.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <numeric>

namespace episcope {
namespace {

// Views of one row of the grid that are solved one after the other, each beginning where the last
// ended, and how many such chains there are at least, for as many threads.
constexpr int kLongestChain = 9;
constexpr int kMinChains = 8;

// Iterations between two checks of the gap. A check costs half an iteration, and 30 iterations
// suffice.
constexpr int kGapCheckEvery = 5;

// Iterations for which far labels are left out at first, and when a kept solver continues.
constexpr int kRacingIterations = 25, kRacingWhenGoingOn = 10;

std::vector<ViewChain> view_chains(GridShape grid) {
  std::vector<ViewChain> chains;
  for (int v = 0; v < grid.v; ++v) {
    int length = std::clamp(grid.count() / kMinChains, 1, kLongestChain);
    // An odd number of long chains would leave one of two threads without work.
    if (v == grid.v - 1) length = (length + 1) / 2;
    for (int u = 0; u < grid.u; u += length) {
      chains.push_back({v * grid.u + u, v * grid.u + std::min(u + length, grid.u)});
    }
  }
  return chains;
}

// As far as one undoes without a thought.
constexpr std::size_t kMostSolved = 16;

void add(const float* values, std::size_t count, Fnv1a& hash) {
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t word = 0;
    std::memcpy(&word, values + i, sizeof word);
    hash.add_word(word);
  }
}

std::uint64_t hash_of(const SimplexProblem& problem) {
  Fnv1a hash;
  const VolumeView<const float>& cost = problem.cost;
  add(cost.data, static_cast<std::size_t>(cost.height) * cost.layers * cost.width, hash);
  add(problem.g.data, problem.g.size(), hash);
  const auto smoothness = static_cast<float>(problem.smoothness);
  add(&smoothness, 1, hash);
  return hash.value();
}

std::vector<std::vector<int>> chains_of(GridShape grid) {
  std::vector<std::vector<int>> chains;
  for (const ViewChain& each : view_chains(grid)) {
    std::vector<int>& chain = chains.emplace_back(each.end - each.begin);
    std::iota(chain.begin(), chain.end(), each.begin);
  }
  std::ranges::stable_sort(chains, std::ranges::greater{}, &std::vector<int>::size);
  return chains;
}

// Of all views or none.
bool has_disparity(const RayLabelingInput& input) {
  const LabelProbabilities& p = *input.probabilities;
  const DisparityField* const disparity = input.disparity;
  if (disparity == nullptr || disparity->empty() ||
      disparity->disparity.height() != p.views[0].height() ||
      disparity->disparity.width() != p.views[0].width()) {
    return false;
  }
  for (int i = 0; i < p.grid.count(); ++i) {
    if (!disparity->contains(p.view_at(i))) return false;
  }
  return true;
}

std::vector<cuda::RayView> views_of(const RayLabelingInput& input,
                                    const std::vector<Image<float>>& weights,
                                    const std::vector<Image<std::int32_t>>& painted,
                                    const ViewStack<std::uint8_t>* colors) {
  const LabelProbabilities& p = *input.probabilities;
  const bool follows_rays = has_disparity(input);
  std::vector<cuda::RayView> views;
  for (int i = 0; i < p.grid.count(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const ViewIndex view = p.view_at(i);
    cuda::RayView& each = views.emplace_back();
    each.probabilities = p.views[at].view();
    each.weights = weights[at].data();
    each.painted = painted[at].data();
    if (colors != nullptr) each.colors = colors->view(view).data;
    if (!follows_rays) continue;
    each.disparity = input.disparity->view(view).disparity.data;
    each.valid = input.disparity->view(view).valid.data;
  }
  return views;
}

}  // namespace

SimplexOptions simplex_options(const RayLabelingParameters& parameters, double gap) {
  SimplexOptions options;
  options.gap = gap;
  options.max_iterations = parameters.max_iterations;
  options.check_every = kGapCheckEvery;
  options.racing_iterations = kRacingIterations;
  return options;
}

RayLabeling solve_views(const ViewProblems& problems, const Progress& progress) {
  const LabelProbabilities& p = *problems.input.probabilities;
  RayLabeling result = unlabeled(p);
  const std::vector<ViewChain> chains = view_chains(p.grid);
  std::vector<SimplexResult> parts(p.views.size());
  progress.step("views");
  // Whole views side by side: threads that share a view wait for each other at every iteration.
  const Progress alone = progress.part(0, 0).on_one_thread();
  parallel_for_workers(static_cast<int>(chains.size()), progress, [&] {
    return [&, problem = ViewProblem(problems.input, problems.parameters, problems.colors)](
               int k) mutable {
      ViewProblem::Task task{{}, problems.parameters.gap_all_views, {}};
      for (int i = chains[k].begin; i < chains[k].end; ++i) {
        task.view = p.view_at(i);
        problems.fill(problem, task.view, alone);
        parts[i] = problem.solve(task, alone, result.labels.view(task.view));
        task.last = task.view;
      }
    };
  });
  for (const auto& part : parts) add_part(part, result);
  return result;
}

RayLabeling solve_view(const ViewProblems& problems, ViewIndex view, const Progress& progress) {
  RayLabeling result = unlabeled(*problems.input.probabilities, view);
  ViewProblem problem(problems.input, problems.parameters, problems.colors);
  problems.fill(problem, view, progress.part(0, 0.2));
  const ViewProblem::Task task{view, problems.parameters.gap, {}};
  add_part(problem.solve(task, progress.part(0.2, 1), result.labels.view(view)), result);
  return result;
}

void replace_layers_by_ids(const std::vector<std::int32_t>& ids, RayLabeling& labeling) {
  ViewStack<std::int32_t>& labels = labeling.labels;
  std::for_each(labels.data(), labels.data() + labels.size(),
                [&ids](std::int32_t& label) { label = ids[label]; });
}

ViewProblem::ViewProblem(const RayLabelingInput& input, const RayLabelingParameters& parameters,
                         const RayColors& colors)
    : input_(input),
      parameters_(parameters),
      colors_(colors),
      table_(cost_table(parameters.floor)),
      costs_(input.probabilities->views[0].height(), input.probabilities->views[0].layers(),
             input.probabilities->views[0].width()) {}

void ViewProblem::fill_own(ViewIndex view) {
  fill_costs(input_.probabilities->view(view).view(), table_, costs_.view());
}

void ViewProblem::fill_tracks(ViewIndex view, TrackViews others, const Progress& progress) {
  fill_track_costs({*input_.probabilities, *input_.disparity, view, others, &colors_}, table_,
                   progress, costs_.view());
}

// Where the pixels of `view` were in `last`; empty if that is not known.
ImageView<const std::int32_t> ViewProblem::places_in(ViewIndex last, ViewIndex view) {
  const DisparityField* const disparity = input_.disparity;
  if (disparity == nullptr || !disparity->contains(last) || !disparity->contains(view)) return {};
  const int height = costs_.view().height, width = costs_.view().width;
  if (disparity->disparity.height() != height || disparity->disparity.width() != width) return {};
  if (places_.empty()) places_ = Image<std::int32_t>(height, width);
  for (int y = 0; y < height; ++y) {
    find_ray_targets(disparity->view(view), disparity->view(last),
                     {last.v - view.v, last.u - view.u}, y, places_.row(y));
  }
  return places_;
}

SimplexResult ViewProblem::solve(const Task& task, const Progress& progress,
                                 ImageView<std::int32_t> labels) {
  const Image<float> g = boundary_weights_of(input_, task.view);
  const Image<std::int32_t> painted = painted_layers(input_, task.view);
  hold_painted(painted, price_of_held(parameters_.smoothness), costs_.view());
  const SimplexResult result =
      solve(task, {costs_.view(), g, parameters_.smoothness}, progress, labels);
  keep_painted(painted, labels);
  return result;
}

SimplexResult ViewProblem::solve(const Task& task, const SimplexProblem& problem,
                                 const Progress& progress, ImageView<std::int32_t> labels) {
  SimplexOptions options = simplex_options(parameters_, task.gap);
  if (KeptSolver* const kept = input_.kept) {
    options.goes_on = kept->prepare(*input_.probabilities, task.view);
    if (options.goes_on) options.racing_iterations = kRacingWhenGoingOn;
    return kept->solve(problem, options, progress, labels);
  }
  if (task.last) options.from_last = places_in(*task.last, task.view);
  return own_solver().solve(problem, options, progress, labels);
}

SimplexSolver& ViewProblem::own_solver() {
  if (!solver_) solver_.emplace(costs_.height(), costs_.layers(), costs_.width());
  return *solver_;
}

double KeptSolver::bytes(double pixels, int labels) {
  return (8 * 4.0 / 3 + 1.0 / 3) * sizeof(float) * pixels * labels;
}

bool KeptSolver::prepare(const LabelProbabilities& probabilities, ViewIndex view) {
  const ProbabilityMap& map = probabilities.view(view);
  if (solver_ && view == view_ && map.height() == height_ && map.width() == width_ &&
      probabilities.ids == ids_) {
    return true;
  }
  drop();
  solver_.emplace(map.height(), map.layers(), map.width());
  view_ = view;
  height_ = map.height();
  width_ = map.width();
  ids_ = probabilities.ids;
  return false;
}

SimplexResult KeptSolver::solve(const SimplexProblem& problem, const SimplexOptions& options,
                                const Progress& progress, ImageView<int> labels) {
  const std::uint64_t hash = hash_of(problem);
  const auto known = std::ranges::find_if(solved_, [&](const Solved& each) {
    return each.problem == hash && each.result.converged && each.gap <= options.gap;
  });
  if (known != solved_.end()) {
    std::ranges::copy(known->labels, labels.data);
    return known->result;
  }
  const SimplexResult result = solver_->solve(problem, options, progress, labels);
  if (solved_.size() == kMostSolved) solved_.pop_front();
  solved_.push_back({hash, options.gap, result, {labels.data, labels.data + labels.size()}});
  return result;
}

void KeptSolver::drop() {
  solver_.reset();
  solved_.clear();
}

bool is_for_device(const RayLabelingInput& input, const RayLabelingParameters& parameters) {
  return parameters.device == Device::Cuda && parameters.smoothness > 0 &&
         input.probabilities->ids.size() > 1;
}

RayLabeling label_on_device(const RayLabelingInput& input, const RayLabelingParameters& parameters,
                            const DeviceLabeling& labeling, const Progress& progress) {
  const LabelProbabilities& p = *input.probabilities;
  const std::vector<Image<float>> weights = boundary_weights_of(input, progress.part(0, 0.05));
  const CostTable costs = cost_table(parameters.floor);
  std::vector<Image<std::int32_t>> painted;
  for (int i = 0; i < p.grid.count(); ++i) painted.push_back(painted_layers(input, p.view_at(i)));
  const ViewStack<std::uint8_t>* const colors =
      labeling.colors != nullptr ? labeling.colors->samples() : nullptr;
  cuda::RayLabelsTask task;
  task.grid = p.grid;
  task.views = views_of(input, weights, painted, colors);
  task.chains = chains_of(p.grid);
  task.costs = costs;
  task.tolerance_px = kSamePointTolerance_px;
  if (labeling.colors != nullptr) task.near_views = kNearViews;
  if (colors != nullptr) {
    task.channels = colors->channels();
    task.trusts = labeling.colors->trusts();
  }
  task.votes = labeling.votes;
  task.smoothness = parameters.smoothness;
  task.price_of_held = price_of_held(parameters.smoothness);
  task.gap = parameters.gap_all_views;
  task.max_iterations = parameters.max_iterations;
  task.check_every = kGapCheckEvery;
  task.racing_iterations = kRacingIterations;
  RayLabeling result = unlabeled(p);
  progress.step("views");
  const cuda::RayLabelsAnswer answer =
      cuda::label_rays(task, progress.part(0.05, 1), result.labels);
  result.energy = answer.energy;
  result.bound = answer.bound;
  result.iterations = answer.iterations;
  for (int i = 0; i < p.grid.count(); ++i) {
    keep_painted(painted[static_cast<std::size_t>(i)], result.labels.view(p.view_at(i)));
  }
  replace_layers_by_ids(p.ids, result);
  return result;
}

std::shared_ptr<const cuda::DeviceForest> copy_to_device(const FlatForest& forest,
                                                         const Progress& progress) {
  std::vector<cuda::TreeNode> nodes;
  std::transform(forest.nodes, forest.nodes + forest.node_count, std::back_inserter(nodes),
                 [](const ForestNode& node) {
                   return cuda::TreeNode{node.threshold, node.feature, node.next};
                 });
  const auto node_count = nodes.size();
  const cuda::ForestTables tables{
      .nodes = nodes,
      .roots = {forest.roots, static_cast<std::size_t>(forest.tree_count)},
      .votes_of = {forest.votes_of, node_count},
      .votes = {forest.votes, static_cast<std::size_t>(forest.leaf_count) *
                                  static_cast<std::size_t>(forest.pitch)},
      .pitch = forest.pitch};
  return std::make_shared<const cuda::DeviceForest>(tables, progress);
}

}  // namespace episcope
