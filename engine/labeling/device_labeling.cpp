// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/device_labeling.h"

#include "engine/core/parallel.h"
#include "engine/cuda/ray_labels.h"
#include "engine/labeling/ray_labeling.h"
#include "engine/labeling/ray_targets.h"
#include "engine/labeling/solve_views.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <vector>

namespace episcope {
namespace {

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
    if (colors != nullptr) each.colors = colors->view(view).data;
    if (!follows_rays) continue;
    each.disparity = input.disparity->view(view).disparity.data;
    each.valid = input.disparity->view(view).valid.data;
  }
  return views;
}

}  // namespace

bool is_for_device(const RayLabelingInput& input, const RayLabelingParameters& parameters) {
  return parameters.device == Device::Cuda && parameters.smoothness > 0 &&
         input.probabilities->ids.size() > 1;
}

RayLabeling label_on_device(const RayLabelingInput& input, const RayLabelingParameters& parameters,
                            const DeviceLabeling& labeling, const Progress& progress) {
  const LabelProbabilities& p = *input.probabilities;
  const std::vector<Image<float>> weights = boundary_weights_of(input, progress.part(0, 0.05));
  const CostTable costs = cost_table(parameters.floor);
  const ViewStack<std::uint8_t>* const colors =
      labeling.colors != nullptr ? labeling.colors->samples() : nullptr;
  cuda::RayLabelsTask task;
  task.grid = p.grid;
  task.views = views_of(input, weights, colors);
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
