// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/forest/flat_tree.h"

#include <opencv2/ml.hpp>

#include <limits>

namespace episcope {

FlatTree flatten_tree(const cv::ml::RTrees& trees, int root) {
  const auto& nodes = trees.getNodes();
  const auto& splits = trees.getSplits();
  FlatTree flat;
  flat.origins.push_back(root);
  for (std::size_t i = 0; i < flat.origins.size(); ++i) {
    const auto& node = nodes[static_cast<std::size_t>(flat.origins[i])];
    if (node.split < 0) {
      flat.nodes.push_back(
          {std::numeric_limits<float>::infinity(), 0, static_cast<unsigned short>(i)});
      flat.leaves.push_back(flat.leaf_count++);
      continue;
    }
    const auto& split = splits[static_cast<std::size_t>(node.split)];
    flat.nodes.push_back({split.c, static_cast<unsigned short>(split.varIdx),
                          static_cast<unsigned short>(flat.origins.size())});
    flat.leaves.push_back(-1);
    flat.origins.push_back(node.left);
    flat.origins.push_back(node.right);
  }
  return flat;
}

}  // namespace episcope
