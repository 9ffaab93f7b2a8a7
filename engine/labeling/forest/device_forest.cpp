// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/forest/device_forest.h"

#include <algorithm>
#include <iterator>
#include <vector>

namespace episcope {

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
