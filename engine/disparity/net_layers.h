// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/memory.h"
#include "engine/core/progress.h"
#include "engine/disparity/kernels/net_kernel.h"
#include "engine/disparity/net_weights.h"

#include <functional>
#include <utility>
#include <vector>

namespace episcope {

/// Size of a tensor: channels at each place, labels (1 of a map), rows, columns.
struct NetShape {
  int channels = 1;
  int depth = 1;
  int height = 1;
  int width = 1;
};

/// The rows of a tensor that are kept, `[y][z][x][channel]`, channels in whole groups, columns with
/// zeros on either side.
class NetRows {
 public:
  NetRows() = default;
  NetRows(NetShape shape, int margin, int kept);

  [[nodiscard]] const NetShape& shape() const { return shape_; }
  /// Numbers from column to column.
  [[nodiscard]] int step() const { return whole_groups(shape_.channels); }
  [[nodiscard]] float* at(int y, int z) { return values_.get() + place(y, z); }
  [[nodiscard]] const float* at(int y, int z) const { return values_.get() + place(y, z); }

 private:
  [[nodiscard]] std::ptrdiff_t place(int y, int z) const {
    const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(y % kept_) * shape_.depth + z;
    return (row * (shape_.width + 2 * margin_) + margin_) * step();
  }

  NetShape shape_;
  int margin_ = 0;
  int kept_ = 1;
  LargeArray<float> values_;
};

/// Other nodes that a convolution adds: one before a leaky ReLU, which then follows whatever the
/// layer says, one at the end; −1 = none. A map is added at every label.
struct NetSums {
  int before = -1;
  int after = -1;
};

/// What a node of a network is made of: a convolution, if it has a layer, a source, if it has no
/// input, or its input enlarged.
struct NetOperation {
  const NetLayer* layer = nullptr;
  int input = -1;
  NetSums sums;
};

/// A network of convolutions that runs down its tensors row by row: of each tensor no more rows are
/// kept than later ones need, so memory grows with the width, not with the height. Every number is
/// computed once, by the same operations whatever the band and the number of threads. Nodes are
/// known by the numbers that their makers return.
class NetStream {
 public:
  /// Writes row y of labels z, z + 1, … of a tensor; called on any thread.
  using Fill = std::function<void(int y, int z, NetRows& rows)>;
  /// Is called before rows [first, end) are filled; these ascend.
  using Prepare = std::function<void(int first, int end, const Progress&)>;
  /// Is given each row of the result, on any thread.
  using Take = std::function<void(int y, const NetRows& rows)>;
  /// `fill` writes `labels` at once, of which the shape has a multiple.
  [[nodiscard]] int add_source(NetShape shape, Fill fill, Prepare prepare = {}, int labels = 1);
  /// The layer must live as long as this. Precondition: the channels match.
  [[nodiscard]] int add_convolution(const NetLayer& layer, int input, NetSums sums = {});
  /// Twice as large along rows, columns and labels, linear, cut to the size of `plus`, which is
  /// added.
  [[nodiscard]] int add_enlarged(int input, int plus);
  [[nodiscard]] const NetShape& shape(int node) const { return nodes_[node].shape; }
  /// Of all nodes.
  [[nodiscard]] std::vector<NetOperation> operations() const;

  /// Computes the tensor `output`, about `band` of its rows at a time. Throws Cancelled.
  void run(int output, int band, const Take& take, const Progress& progress);

  /// Bytes that `run` takes for tensors.
  [[nodiscard]] double bytes(int output, int band) const;

 private:
  class MixedInputs;
  struct Node {
    NetShape shape;
    Fill fill{};
    Prepare prepare{};
    int labels = 1;  // That `fill` writes at once.
    const NetLayer* layer = nullptr;
    int input = -1;  // Of a convolution or what is enlarged;
    NetSums sums{};  // `sums.after` is added at the end.
    int margin = 0;  // Columns of zeros that are read.
    NetRows rows{};
  };
  // The rows [first, end) of a node that are computed next.
  struct Step {
    int node = 0;
    int first = 0;
    int end = 0;
  };
  struct Plan {
    std::vector<Step> steps;
    std::vector<int> kept;  // Rows of each node.
    double work = 0;
  };

  [[nodiscard]] std::vector<int> inputs_of(int node) const;
  [[nodiscard]] std::pair<int, int> needed(int node, int input, int first, int end) const;
  void advance(int node, int end, int output, int band, std::vector<int>& done, Plan& plan) const;
  [[nodiscard]] Plan plan_of(int output, int band) const;
  [[nodiscard]] double work_of(const Step& step) const;
  void compute(const Step& step, const Progress& progress);
  void take_scratch(int threads);
  [[nodiscard]] NetConvolutionRow row_of(const Node& node) const;
  [[nodiscard]] NetOutput output_of(Node& node, int y, int z) const;
  void convolve_row(Node& node, int y, int z) const;
  void convolve_block(const Step& step, int y, MixedInputs& inputs);
  void convolve_mixed(const Step& step, const Progress& progress);
  void enlarge_row(Node& node, int y, int z) const;

  std::vector<Node> nodes_;
  LargeArray<float> scratch_;  // Of mixed rows: so many numbers for each thread.
  std::size_t scratch_count_ = 0;
};

}  // namespace episcope
