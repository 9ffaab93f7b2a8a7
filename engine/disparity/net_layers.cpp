// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/net_layers.h"

#include "engine/core/isa.h"
#include "engine/core/parallel.h"
#include "engine/disparity/kernels/net_kernel.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

namespace episcope {

namespace {

// Of a place of a source, in products: about what evidence of 80 views costs.
constexpr double kSourceWork = 6000;

int halved(int extent, int stride) {
  return (extent - 1) / stride + 1;
}

std::size_t count_of(const NetShape& shape, int margin, int kept) {
  return static_cast<std::size_t>(kept) * shape.depth * (shape.width + 2 * margin) *
         whole_groups(shape.channels);
}

// Where an axis that is made twice as long is read: the near place has the weight 0.75.
struct Pair {
  int near = 0;
  int far = 0;
};

Pair pair_at(int place, int extent) {
  const int near = place / 2;
  return {near, std::clamp(place % 2 == 0 ? near - 1 : near + 1, 0, extent - 1)};
}

}  // namespace

NetRows::NetRows(NetShape shape, int margin, int kept)
    : shape_(shape),
      margin_(margin),
      kept_(kept),
      values_(
          large_array<float>(allocate_large_zeros(count_of(shape, margin, kept) * sizeof(float)))) {
}

int NetStream::add_source(NetShape shape, Fill fill, Prepare prepare) {
  nodes_.push_back({.shape = shape, .fill = std::move(fill), .prepare = std::move(prepare)});
  return static_cast<int>(nodes_.size()) - 1;
}

int NetStream::add_convolution(const NetLayer& layer, int input, Sums sums) {
  const NetLayerForm& form = layer.form;
  Node& source = nodes_[input];
  assert(source.shape.channels == form.inputs);
  source.margin = std::max(source.margin, form.kernel / 2 * form.dilation);
  const NetShape& from = source.shape;
  const NetShape shape{form.outputs,
                       form.dimensions == 3 ? halved(from.depth, form.stride) : from.depth,
                       halved(from.height, form.stride), halved(from.width, form.stride)};
  nodes_.push_back({.shape = shape, .layer = &layer, .input = input, .sums = sums});
  return static_cast<int>(nodes_.size()) - 1;
}

int NetStream::add_enlarged(int input, int plus) {
  assert(nodes_[input].shape.channels == nodes_[plus].shape.channels);
  nodes_.push_back({.shape = nodes_[plus].shape, .input = input, .sums = {-1, plus}});
  return static_cast<int>(nodes_.size()) - 1;
}

std::vector<int> NetStream::inputs_of(int node) const {
  std::vector<int> inputs;
  for (const int input : {nodes_[node].input, nodes_[node].sums.before, nodes_[node].sums.after}) {
    if (input >= 0) inputs.push_back(input);
  }
  return inputs;
}

// The rows of an input that rows [first, end) of a node need.
std::pair<int, int> NetStream::needed(int node, int input, int first, int end) const {
  const Node& one = nodes_[node];
  const int height = nodes_[input].shape.height;
  if (first >= end) return {height, 0};
  std::pair<int, int> rows{height, 0};
  const auto include = [&](int from, int to) {
    rows = {std::min(rows.first, std::max(from, 0)), std::max(rows.second, std::min(to, height))};
  };
  if (input == one.sums.before || input == one.sums.after) include(first, end);
  if (input == one.input && one.layer != nullptr) {
    const NetLayerForm& form = one.layer->form;
    const int reach = form.kernel / 2 * form.dilation;
    include(first * form.stride - reach, (end - 1) * form.stride + reach + 1);
  } else if (input == one.input) {
    include(first / 2 - 1, (end - 1) / 2 + 2);
  }
  return rows;
}

void NetStream::advance(int node, int end, int output, int band, std::vector<int>& done,
                        Plan& plan) const {
  const int whole = nodes_[output].shape.height;
  const int step = std::max(1, band * nodes_[node].shape.height / whole);
  while (done[node] < end) {
    const int until = std::min(end, done[node] + step);
    for (const int input : inputs_of(node)) {
      advance(input, needed(node, input, done[node], until).second, output, band, done, plan);
    }
    plan.steps.push_back({node, done[node], until});
    const int begun = done[node];
    done[node] = until;
    int oldest = node == output ? begun : until;
    for (int user = 0; user < static_cast<int>(nodes_.size()); ++user) {
      if (std::ranges::count(inputs_of(user), node) == 0) continue;
      oldest = std::min(oldest, needed(user, node, done[user], nodes_[user].shape.height).first);
    }
    plan.kept[node] = std::max({plan.kept[node], until - oldest, until - begun});
  }
}

NetStream::Plan NetStream::plan_of(int output, int band) const {
  Plan plan{.steps = {}, .kept = std::vector<int>(nodes_.size(), 1)};
  std::vector<int> done(nodes_.size(), 0);
  const int height = nodes_[output].shape.height;
  for (int end = band; end < height + band; end += band) {
    advance(output, std::min(end, height), output, band, done, plan);
  }
  for (const Step& step : plan.steps) plan.work += work_of(step);
  return plan;
}

double NetStream::work_of(const Step& step) const {
  const Node& node = nodes_[step.node];
  const double places =
      static_cast<double>(step.end - step.first) * node.shape.depth * node.shape.width;
  if (node.fill) return places * kSourceWork;
  if (node.layer == nullptr) return places * node.shape.channels;
  return places * node.shape.channels * node.layer->form.taps() * node.layer->form.inputs;
}

double NetStream::bytes(int output, int band) const {
  const Plan plan = plan_of(output, band);
  double bytes = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    bytes += static_cast<double>(count_of(nodes_[i].shape, nodes_[i].margin, plan.kept[i])) *
             sizeof(float);
  }
  return bytes;
}

void NetStream::run(int output, int band, const Take& take, const Progress& progress) {
  const Plan plan = plan_of(output, band);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    nodes_[i].rows = NetRows(nodes_[i].shape, nodes_[i].margin, plan.kept[i]);
  }
  double spent = 0;
  for (const Step& step : plan.steps) {
    const double work = work_of(step);
    const Progress part = progress.part(spent / plan.work, (spent + work) / plan.work);
    compute(step, part);
    spent += work;
    if (step.node != output) continue;
    const NetRows& rows = nodes_[output].rows;
    parallel_for(step.end - step.first, part.part(1, 1),
                 [&](int i) { take(step.first + i, rows); });
  }
  for (Node& node : nodes_) node.rows = {};
}

void NetStream::compute(const Step& step, const Progress& progress) {
  Node& node = nodes_[step.node];
  if (node.prepare) node.prepare(step.first, step.end, progress.part(0, 0));
  const int depth = node.shape.depth;
  parallel_for((step.end - step.first) * depth, progress, [&](int i) {
    const int y = step.first + i / depth, z = i % depth;
    if (node.fill) {
      node.fill(y, z, node.rows.at(y, z));
    } else if (node.layer != nullptr) {
      convolve_row(node, y, z);
    } else {
      enlarge_row(node, y, z);
    }
  });
}

namespace {

// The taps of a row that lie within the input.
void add_taps(const NetLayer& layer, const NetRows& input, int y, int z, NetConvolutionRow& row) {
  const NetLayerForm& form = layer.form;
  const int half = form.kernel / 2;
  const int depth_half = form.depth_taps() / 2;
  const int depth_stride = form.dimensions == 3 ? form.stride : 1;
  int tap = 0;
  for (int i = -depth_half; i <= depth_half; ++i) {
    for (int j = -half; j <= half; ++j) {
      const int from_z = z * depth_stride + i * form.dilation;
      const int from_y = y * form.stride + j * form.dilation;
      const bool is_within = from_z >= 0 && from_z < input.shape().depth && from_y >= 0 &&
                             from_y < input.shape().height;
      for (int k = -half; k <= half; ++k, ++tap) {
        if (!is_within) continue;
        row.taps[row.tap_count++] = {input.at(from_y, from_z) + k * form.dilation * input.step(),
                                     layer.weights_data() + tap * layer.tap_stride()};
      }
    }
  }
}

}  // namespace

void NetStream::convolve_row(Node& node, int y, int z) const {
  const NetLayer& layer = *node.layer;
  const NetRows& input = nodes_[node.input].rows;
  const bool is_narrow = layer.form.is_narrow();
  NetConvolutionRow row;
  add_taps(layer, input, y, z, row);
  row.inputs = is_narrow ? input.step() : layer.form.inputs;
  row.input_step = layer.form.stride * input.step();
  row.columns = node.shape.width;
  row.outputs = is_narrow ? layer.form.outputs : whole_groups(layer.form.outputs);
  row.group_stride = layer.group_stride();
  row.bias = layer.bias_data();
  const auto added = [&](int other) -> const float* {
    if (other < 0) return nullptr;
    return nodes_[other].rows.at(y, nodes_[other].shape.depth == 1 ? 0 : z);
  };
  row.before = added(node.sums.before);
  row.after = added(node.sums.after);
  row.is_leaky = layer.form.is_leaky || row.before != nullptr;
  row.out = node.rows.at(y, z);
  row.out_step = node.rows.step();
  const NetKernel& kernel = EPISCOPE_CHOOSE_KERNEL(best_isa(), kNetKernel);
  is_narrow ? kernel.convolve_narrow(row) : kernel.convolve(row);
}

void NetStream::enlarge_row(Node& node, int y, int z) const {
  const NetRows& source = nodes_[node.input].rows;
  const bool is_map = node.shape.depth == 1;
  const Pair rows = pair_at(y, source.shape().height);
  const Pair planes = is_map ? Pair{} : pair_at(z, source.shape().depth);
  const float far = is_map ? 0 : 0.25F;
  const NetEnlargedRow row{
      .rows = {source.at(rows.near, planes.near), source.at(rows.far, planes.near),
               source.at(rows.near, planes.far), source.at(rows.far, planes.far)},
      .weights = {(1 - far) * 0.75F, (1 - far) * 0.25F, far * 0.75F, far * 0.25F},
      .source_columns = source.shape().width,
      .columns = node.shape.width,
      .channels = source.step(),
      .plus = nodes_[node.sums.after].rows.at(y, z),
      .out = node.rows.at(y, z)};
  EPISCOPE_CHOOSE_KERNEL(best_isa(), kNetKernel).enlarge(row);
}

}  // namespace episcope
