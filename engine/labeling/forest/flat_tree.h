// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/labeling/forest/forest_kernel.h"

#include <vector>

namespace cv::ml {
class RTrees;
}

namespace episcope {

/// A tree of OpenCV in the form that the kernel walks, numbered breadth first: the children of a
/// node are neighbours, so that one number leads to both.
struct FlatTree {
  std::vector<ForestNode> nodes;
  std::vector<int> leaves;   ///< Number of the leaf at each node, -1 for inner ones.
  std::vector<int> origins;  ///< OpenCV's number of each node.
  int leaf_count = 0;
};

/// The tree of ordered features that begins at node `root`. A tree of at most 65535 nodes.
[[nodiscard]] FlatTree flatten_tree(const cv::ml::RTrees& trees, int root);

}  // namespace episcope
