// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/ray_labeling.h"

#include "engine/core/error.h"
#include "engine/core/hash.h"
#include "engine/core/parallel.h"
#include "engine/core/scene.h"
#include "engine/cuda/ray_labels.h"
#include "engine/labeling/ray_kernel.h"
#include "engine/solvers/layered_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>

namespace episcope {

double RayLabeling::relative_gap() const {
  return labeling_gap(energy, bound);
}

RayLabeling unlabeled(const LabelProbabilities& p) {
  RayLabeling result;
  result.labels =
      ViewStack<std::int32_t>(p.grid, p.views[0].height(), p.views[0].width(), 1, p.first);
  return result;
}

RayLabeling unlabeled(const LabelProbabilities& p, ViewIndex view) {
  RayLabeling result;
  result.labels =
      ViewStack<std::int32_t>({1, 1}, p.view(view).height(), p.view(view).width(), 1, view);
  return result;
}

Image<std::int32_t> painted_layers(const RayLabelingInput& input, ViewIndex view) {
  if (input.strokes == nullptr) return {};
  const auto& views = input.strokes->views;
  const auto found = std::ranges::find(views, view, &ViewScribbles::view);
  if (found == views.end()) return {};
  Image<std::int32_t> layers(found->labels.height(), found->labels.width());
  const std::vector<std::int32_t>& ids = input.probabilities->ids;
  std::ranges::transform(found->labels, layers.begin(), [&](std::int32_t id) {
    const auto place = id > 0 ? std::ranges::find(ids, id) : ids.end();
    return place == ids.end() ? -1 : static_cast<std::int32_t>(place - ids.begin());
  });
  return layers;
}

float price_of_held(double smoothness) {
  return static_cast<float>(8 * smoothness + 8);
}

void hold_painted(const Image<std::int32_t>& painted, float price, VolumeView<float> costs) {
  for (int y = 0; y < painted.height(); ++y) {
    for (int x = 0; x < painted.width(); ++x) {
      if (painted.at(y, x) < 0) continue;
      for (int l = 0; l < costs.layers; ++l) costs.row(y, l)[x] = price;
      costs.row(y, painted.at(y, x))[x] = 0;
    }
  }
}

void keep_painted(const Image<std::int32_t>& painted, ImageView<std::int32_t> layers) {
  for (std::size_t i = 0; i < painted.size(); ++i) {
    if (painted.data()[i] >= 0) layers.data[i] = painted.data()[i];
  }
}

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

// What one thread sums up of one row.
struct CostRow {
  explicit CostRow(int width) : targets(width), trusts(width), weight(width) {}
  std::vector<std::int32_t> targets;
  std::vector<float> trusts;  // How much each ray is trusted, 0 where it arrives nowhere,
  std::vector<float> weight;  // and of all views, by column.
  std::vector<ColumnRange> wanted;
};

void find_rays(const TrackSources& sources, ViewIndex other, int y, CostRow& row) {
  const RayColors* const colors = sources.colors;
  for (const ColumnRange columns : row.wanted) {
    find_ray_targets(sources.disparity.view(sources.view), sources.disparity.view(other),
                     {other.v - sources.view.v, other.u - sources.view.u}, y, columns,
                     row.targets.data());
    if (colors != nullptr) {
      colors->trusts(colors->pair(sources.view, y, other), columns, row.targets.data(),
                     row.trusts.data());
    }
    for (int x = columns.begin; x < columns.end; ++x) {
      if (colors == nullptr) row.trusts[x] = row.targets[x] < 0 ? 0.0F : 1.0F;
      row.weight[x] += row.trusts[x];
    }
  }
}

void add_view(VolumeView<const std::uint8_t> p, const CostTable& table, const CostRow& row,
              float* costs) {
  static const RayKernel& kernel = EPISCOPE_CHOOSE_KERNEL(best_isa(), kRayKernel);
  RayCosts rays;
  rays.codes = p.data;
  rays.size = static_cast<long>(p.size());
  rays.table = table.data();
  rays.labels = p.layers;
  rays.width = p.width;
  rays.targets = row.targets.data();
  rays.trusts = row.trusts.data();
  kernel.add_costs(rays, costs);
}

// Whether `at` of `count` places is among those nearest to `here`, as many at the border.
bool is_near(int at, int here, int count) {
  const int first = std::clamp(here - kNearViews / 2, 0, std::max(count - kNearViews, 0));
  return at >= first && at < first + kNearViews;
}

bool are_near(ViewRectangle views, ViewIndex view, ViewIndex other) {
  const auto& [v, u] = views.first;
  return is_near(other.v - v, view.v - v, views.grid.v) &&
         is_near(other.u - u, view.u - u, views.grid.u);
}

bool is_asked(const TrackSources& sources, ViewIndex other) {
  const ViewIndex view = sources.view;
  if (other == view || !sources.disparity.contains(other)) return false;
  if (sources.others == TrackViews::All) return true;
  return are_near({sources.probabilities.first, sources.probabilities.grid}, view, other);
}

void fill_row(const TrackSources& sources, const CostTable& table, VolumeView<float> costs, int y,
              CostRow& row) {
  const LabelProbabilities& probabilities = sources.probabilities;
  row.wanted = {{0, costs.width}};
  if (!sources.wanted.empty()) row.wanted = marked_columns(sources.wanted.row(y), costs.width);
  if (row.wanted.empty()) return;
  std::ranges::fill(row.trusts, 0.0F);
  const std::uint8_t* const own = probabilities.view(sources.view).view().row(y, 0);
  float* const sums = costs.row(y, 0);
  std::transform(own, own + static_cast<std::ptrdiff_t>(costs.layers) * costs.width, sums,
                 [&table](std::uint8_t p) { return table[p]; });
  std::fill(row.weight.begin(), row.weight.end(), 1.0F);
  for (int i = 0; i < probabilities.grid.count(); ++i) {
    const ViewIndex other = probabilities.view_at(i);
    if (!is_asked(sources, other)) continue;
    find_rays(sources, other, y, row);
    add_view(probabilities.view(other).view(), table, row, sums);
  }
  for (int layer = 0; layer < costs.layers; ++layer) {
    float* const sum = costs.row(y, layer);
    for (int x = 0; x < costs.width; ++x) sum[x] /= row.weight[x];
  }
}

// A row of fewer rays than the widest vector has lanes, with rays beside it that arrive nowhere.
void find_few_targets(const RayKernel& kernel, RayRow rays, std::int32_t* targets) {
  float disparity[kRayColumns];
  std::uint8_t valid[kRayColumns] = {};
  std::int32_t found[kRayColumns];
  std::fill_n(disparity, kRayColumns, std::numeric_limits<float>::quiet_NaN());
  std::copy_n(rays.disparity, rays.end, disparity);
  if (rays.valid != nullptr) {
    std::copy_n(rays.valid, rays.end, valid);
    rays.valid = valid;
  }
  const int count = rays.end;
  rays.disparity = disparity;
  rays.end = kRayColumns;
  kernel.find_targets(rays, found);
  std::copy_n(found, count, targets);
}

constexpr float kSigma = 10;  // of 255

void store_view(const LightField& lf, ViewIndex view, ImageView<std::uint8_t> colors) {
  std::vector<float> row(static_cast<std::size_t>(colors.width) * colors.channels);
  for (int y = 0; y < colors.height; ++y) {
    lf.read_row(view, y, 0, colors.width, row.data());
    std::transform(row.begin(), row.end(), colors.row(y), [](float sample) {
      return static_cast<std::uint8_t>(std::clamp(sample, 0.0F, 1.0F) * 255 + 0.5F);
    });
  }
}

std::unique_ptr<const ViewStack<std::uint8_t>> rounded_views(const LightField& lf, GridShape grid,
                                                             ViewIndex first,
                                                             const Progress& progress) {
  auto colors = std::make_unique<ViewStack<std::uint8_t>>(grid, lf.height(), lf.width(),
                                                          lf.channels(), first);
  parallel_for(grid.count(), progress, [&](int i) {
    const ViewIndex view = grid.view_at(i, first);
    store_view(lf, view, colors->view(view));
  });
  return colors;
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

std::vector<ColumnRange> marked_columns(const std::uint8_t* marks, int width) {
  std::vector<ColumnRange> found;
  for (int x = 0; x < width; x += kRayColumns) {
    const int end = std::min(x + kRayColumns, width);
    // Without an early end the compiler takes all of them at once.
    if (std::accumulate(marks + x, marks + end, std::uint8_t{0}, std::bit_or<std::uint8_t>()) == 0)
      continue;
    if (found.empty() || found.back().end < x) found.push_back({x, x});
    found.back().end = end;
  }
  // At the border there may be too few columns.
  if (!found.empty()) {
    ColumnRange& last = found.back();
    last.begin = std::max(std::min(last.begin, last.end - kRayColumns), 0);
  }
  return found;
}

std::vector<ViewIndex> near_views(ViewRectangle views, ViewIndex view) {
  std::vector<ViewIndex> near;
  for (int i = 0; i < views.grid.count(); ++i) {
    const ViewIndex other = views.grid.view_at(i, views.first);
    if (other != view && are_near(views, view, other)) near.push_back(other);
  }
  return near;
}

CostTable cost_table(double floor) {
  CostTable table;
  for (std::size_t i = 0; i < table.size(); ++i) {
    table[i] = static_cast<float>(-std::log(std::max(static_cast<double>(i) / 255, floor)));
  }
  return table;
}

void fill_costs(VolumeView<const std::uint8_t> probabilities, const CostTable& table,
                VolumeView<float> costs) {
  std::transform(probabilities.data, probabilities.data + probabilities.size(), costs.data,
                 [&table](std::uint8_t p) { return table[p]; });
}

void fill_track_costs(const TrackSources& sources, const CostTable& table, const Progress& progress,
                      VolumeView<float> costs) {
  parallel_for_workers(costs.height, progress, [&] {
    return
        [&, row = CostRow(costs.width)](int y) mutable { fill_row(sources, table, costs, y, row); };
  });
}

Image<float> larger_edge_probability(ImageView<const float> edge_probability) {
  const auto& edge = edge_probability;
  Image<float> larger(edge.height, edge.width);
  for (int y = 0; y < edge.height; ++y) {
    for (int x = 0; x < edge.width; ++x) {
      larger.at(y, x) = std::max(edge.at(y, x), edge.at(y, x, edge.channels - 1));
    }
  }
  return larger;
}

Image<float> boundary_weights(ImageView<const float> edge_probability) {
  Image<float> weights = larger_edge_probability(edge_probability);
  for (float& weight : weights) weight = std::clamp(1 - weight, kMinBoundaryWeight, 1.0F);
  return weights;
}

Image<float> boundary_weights_of(const RayLabelingInput& input, ViewIndex view) {
  if (input.edges == nullptr || input.edges->empty() || !input.edges->contains(view)) return {};
  return boundary_weights(input.edges->view(view));
}

std::vector<Image<float>> boundary_weights_of(const RayLabelingInput& input,
                                              const Progress& progress) {
  const LabelProbabilities& p = *input.probabilities;
  std::vector<Image<float>> weights(p.views.size());
  parallel_for(p.grid.count(), progress,
               [&](int i) { weights[i] = boundary_weights_of(input, p.view_at(i)); });
  return weights;
}

LabelProbabilities empty_probabilities(const std::vector<std::int32_t>& ids, ViewRectangle views) {
  LabelProbabilities probabilities;
  probabilities.ids = ids;
  probabilities.grid = views.grid;
  probabilities.first = views.first;
  probabilities.views.resize(static_cast<std::size_t>(views.grid.count()));
  return probabilities;
}

Image<std::int32_t> most_probable_labels(VolumeView<const std::uint8_t> probabilities,
                                         const std::vector<std::int32_t>& ids) {
  if (static_cast<int>(ids.size()) != probabilities.layers) {
    throw InvalidInput(fmt::format("there are {} label ids for {} layers of probabilities",
                                   ids.size(), probabilities.layers));
  }
  Image<std::int32_t> labels(probabilities.height, probabilities.width);
  std::vector<std::uint8_t> best(probabilities.width);
  for (int y = 0; y < probabilities.height; ++y) {
    std::int32_t* out = labels.row(y);
    const std::uint8_t* first = probabilities.row(y, 0);
    best.assign(first, first + probabilities.width);
    std::fill_n(out, probabilities.width, ids[0]);
    for (int layer = 1; layer < probabilities.layers; ++layer) {
      const std::uint8_t* p = probabilities.row(y, layer);
      for (int x = 0; x < probabilities.width; ++x) {
        if (p[x] <= best[x]) continue;
        best[x] = p[x];
        out[x] = ids[layer];
      }
    }
  }
  return labels;
}

void find_layers(ImageView<const std::int32_t> labels, const std::vector<std::int32_t>& ids,
                 ImageView<std::int32_t> layers) {
  std::int32_t last = ids.front(), layer = 0;
  std::transform(labels.data, labels.data + labels.size(), layers.data, [&](std::int32_t id) {
    if (id == last) return layer;
    const auto found = std::ranges::lower_bound(ids, id);
    last = id;
    layer = found == ids.end() || *found != id ? 0 : static_cast<std::int32_t>(found - ids.begin());
    return layer;
  });
}

Image<float> label_uncertainty(VolumeView<const std::uint8_t> probabilities) {
  Image<float> uncertainty(probabilities.height, probabilities.width);
  if (probabilities.layers < 2) return uncertainty;
  const float full = std::log(static_cast<float>(probabilities.layers));
  std::vector<float> sum(probabilities.width);
  std::vector<float> sum_log(probabilities.width);  // of p log p
  for (int y = 0; y < probabilities.height; ++y) {
    std::fill(sum.begin(), sum.end(), 0.F);
    std::fill(sum_log.begin(), sum_log.end(), 0.F);
    for (int layer = 0; layer < probabilities.layers; ++layer) {
      const std::uint8_t* p = probabilities.row(y, layer);
      for (int x = 0; x < probabilities.width; ++x) {
        if (p[x] == 0) continue;
        sum[x] += p[x];
        sum_log[x] += p[x] * std::log(static_cast<float>(p[x]));
      }
    }
    for (int x = 0; x < probabilities.width; ++x) {
      // Of p over its sum s: H = log s − (Σ p log p) / s; nothing known at all is full entropy.
      const float entropy = sum[x] > 0 ? std::log(sum[x]) - sum_log[x] / sum[x] : full;
      uncertainty.at(y, x) = std::fmin(std::fmax(entropy / full, 0.F), 1.F);
    }
  }
  return uncertainty;
}

void find_ray_targets(const DisparityView& from, const DisparityView& to, ViewIndex step, int y,
                      std::int32_t* targets) {
  find_ray_targets(from, to, step, y, {0, from.disparity.width}, targets);
}

void find_ray_targets(const DisparityView& from, const DisparityView& to, ViewIndex step, int y,
                      ColumnRange columns, std::int32_t* targets) {
  static const RayKernel& kernel = EPISCOPE_CHOOSE_KERNEL(best_isa(), kRayKernel);
  RayRow rays;
  rays.height = from.disparity.height;
  rays.width = from.disparity.width;
  rays.begin = columns.begin;
  rays.end = columns.end;
  rays.row = static_cast<float>(y);
  rays.step_x = static_cast<float>(step.u);
  rays.step_y = static_cast<float>(step.v);
  rays.disparity = from.disparity.row(y);
  rays.valid = from.valid.empty() ? nullptr : from.valid.row(y);
  rays.there = to.disparity.data;
  rays.valid_there = to.valid.empty() ? nullptr : to.valid.data;
  rays.tolerance = kSamePointTolerance_px;
  if (rays.width < kRayColumns) return find_few_targets(kernel, rays, targets);
  kernel.find_targets(rays, targets);
}

RayColors::RayColors(const LightField& light_field, GridShape grid, ViewIndex first,
                     const Progress& progress)
    : colors_(std::get_if<ViewStack<std::uint8_t>>(&light_field.samples())) {
  for (int s = 0; s < kNoTrust; ++s) {
    table_[s] = std::exp(-static_cast<float>(s) / (2 * kSigma * kSigma));
  }
  table_[kNoTrust] = 0;
  if (colors_ != nullptr) return;
  rounded_ = rounded_views(light_field, grid, first, progress);
  colors_ = rounded_.get();
}

void RayColors::trusts(const Pair& pair, ColumnRange columns, const std::int32_t* targets,
                       float* trusts) const {
  if (colors_ != nullptr && colors_->channels() == 3) {
    static const RayKernel& kernel = EPISCOPE_CHOOSE_KERNEL(best_isa(), kRayKernel);
    RayTrusts rays;
    rays.begin = columns.begin;
    rays.end = columns.end;
    rays.width = colors_->width();
    rays.row = pair.row;
    rays.other = pair.other;
    rays.last = colors_->height() * colors_->width() - 1;
    rays.targets = targets;
    rays.table = table_.data();
    rays.most = kNoTrust;
    return kernel.find_trusts(rays, trusts);
  }
  for (int x = columns.begin; x < columns.end; ++x) {
    trusts[x] = targets[x] < 0 ? 0.0F : trust(pair, x, targets[x]);
  }
}

float RayColors::trust(const Pair& pair, int x, std::int32_t target) const {
  if (pair.row == nullptr) return 1;
  const std::ptrdiff_t channels = colors_->channels();
  int sum = 0;
  for (std::ptrdiff_t c = 0; c < channels; ++c) {
    const int difference = pair.row[x * channels + c] - pair.other[target * channels + c];
    sum += difference * difference;
  }
  if (channels == 1) sum *= 3;
  return table_[std::min(sum, kNoTrust)];
}

}  // namespace episcope
