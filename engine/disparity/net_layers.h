// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/light_field.h"
#include "engine/core/memory.h"
#include "engine/core/progress.h"
#include "engine/cuda/net_task.h"
#include "engine/disparity/kernels/net_kernel.h"
#include "engine/disparity/kernels/shared_constants.h"
#include "engine/disparity/net_weights.h"

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace episcope {

/// Most views that are looked at of a sector.
inline constexpr int kNetSectorViews = 12;

/// Where cameras stand, view by view in canonical order (view_places); null = on the regular grid.
using NetPlaces = std::shared_ptr<const std::vector<ViewPlace>>;

/// The views of each sector around a reference, at most kNetSectorViews of each, spread over the
/// distance. Sector k is in the direction of 45 k degrees of the grid, from u to v. Views without a
/// valid pixel are left out.
[[nodiscard]] std::array<std::vector<cuda::NetNeighbor>, kNetSectors> net_sectors(
    const LightField& light_field, ViewIndex reference, const NetPlaces& places);

/// What `net` is told of the reference view: R, G, B − 0.4, 4 (grey(x + 1) − grey(x − 1)), likewise
/// along y, samples in [0, 1], the border repeated. The pixel itself stands for an invalid
/// neighbor; invalid pixels are as stored.
[[nodiscard]] Image<float> net_guide(const LightField& light_field, ViewIndex reference);

/// What evidence is asked for: disparities that all pixels share, or maps.
enum class NetEvidenceOf { Planes, Maps };

/// How unlike the views are at disparities: E(d) of `net` (resources/training/README.md). A view
/// does not count where its sample lies outside the image or an invalid pixel enters it. Holds the
/// rows that a sweep down the image needs, 20 bytes a pixel and view, 32 for maps. The light field
/// must live longer.
class NetEvidence {
 public:
  /// For disparities within `disparities`; cameras stand at `places`.
  NetEvidence(const LightField& light_field, ViewIndex reference, Interval disparities,
              NetEvidenceOf kind, const NetPlaces& places = nullptr);

  /// Reads what rows [first, end) need, and drops what rows before do. Later calls go on from
  /// there. Throws Cancelled.
  void hold(int first, int end, const Progress& progress);

  /// Evidence of a held row: kNetEvidence numbers a pixel. Up to kNetAtOnce disparities, all with
  /// maps or all without, as promised. Thread-safe.
  void compute(int y, std::span<const NetDisparity> disparities) const;

  [[nodiscard]] int height() const { return light_field_.height(); }
  [[nodiscard]] int width() const { return light_field_.width(); }

 private:
  // Numbers of a pixel, on a boundary that loads do not cross.
  struct alignas(4 * kNetPixel) Pixel {
    Pixel() {}  // Leaves them unset.
    std::array<float, kNetPixel> values;
  };
  // Some rows of a view.
  struct Window {
    cuda::NetNeighbor neighbor;
    int first = 0;
    int end = 0;
    std::vector<Pixel> pixels;

    [[nodiscard]] float* data() { return pixels.front().values.data(); }
  };

  void move_window(Window& window, int first, int end) const;
  void read_rows(Window& window, int first) const;
  [[nodiscard]] long row_pixels() const;

  const LightField& light_field_;
  ViewIndex reference_;
  Interval disparities_;
  NetEvidenceOf kind_;
  std::array<int, kNetSectors + 1> sector_begin_{};
  std::vector<Window> windows_;  // Of the reference, then of the views sector by sector.
  std::vector<NetView> views_;
};

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
