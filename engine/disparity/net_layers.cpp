// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/net_layers.h"

#include "engine/core/isa.h"
#include "engine/core/parallel.h"

#include <algorithm>
#include <atomic>
#include <cassert>

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

const NetKernel& kernels() {
  return EPISCOPE_CHOOSE_KERNEL(best_isa(), kNetKernel);
}

}  // namespace

NetRows::NetRows(NetShape shape, int margin, int kept)
    : shape_(shape),
      margin_(margin),
      kept_(kept),
      values_(
          large_array<float>(allocate_large_zeros(count_of(shape, margin, kept) * sizeof(float)))) {
}

int NetStream::add_source(NetShape shape, Fill fill, Prepare prepare, int labels) {
  assert(shape.depth % labels == 0);
  nodes_.push_back(
      {.shape = shape, .fill = std::move(fill), .prepare = std::move(prepare), .labels = labels});
  return static_cast<int>(nodes_.size()) - 1;
}

int NetStream::add_convolution(const NetLayer& layer, int input, NetSums sums) {
  const NetLayerForm& form = layer.form;
  Node& source = nodes_[input];
  assert(source.shape.channels == form.inputs);
  // The last tile of columns begins within the row.
  const int reach = form.is_mixed() ? kNetTile + 1 : form.kernel / 2;
  source.margin = std::max(source.margin, reach * form.dilation);
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

std::vector<NetOperation> NetStream::operations() const {
  std::vector<NetOperation> operations;
  for (const Node& node : nodes_) operations.push_back({node.layer, node.input, node.sums});
  return operations;
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
    const int tile = form.mixes_rows() ? kNetTile : 1;
    first = first / tile * tile;
    end = (end + tile - 1) / tile * tile;
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
  take_scratch(progress.threads());
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
  scratch_ = {};
}

void NetStream::compute(const Step& step, const Progress& progress) {
  Node& node = nodes_[step.node];
  if (node.prepare) node.prepare(step.first, step.end, progress.part(0, 0));
  if (node.layer != nullptr && node.layer->form.is_mixed()) return convolve_mixed(step, progress);
  const int items = node.shape.depth / node.labels;
  parallel_for((step.end - step.first) * items, progress, [&](int i) {
    const int y = step.first + i / items, z = i % items * node.labels;
    if (node.fill) {
      node.fill(y, z, node.rows);
    } else if (node.layer != nullptr) {
      convolve_row(node, y, z);
    } else {
      enlarge_row(node, y, z);
    }
  });
}

// What all rows of a convolution have in common.
NetConvolutionRow NetStream::row_of(const Node& node) const {
  const NetLayer& layer = *node.layer;
  const int step = nodes_[node.input].rows.step();
  const bool is_narrow = layer.form.is_narrow();
  NetConvolutionRow row;
  row.inputs = is_narrow ? step : layer.form.inputs;
  row.input_step = layer.form.stride * step;
  row.columns = node.shape.width;
  row.outputs = is_narrow ? layer.form.outputs : whole_groups(layer.form.outputs);
  row.group_stride = layer.group_stride();
  row.bias = layer.bias_data();
  row.is_leaky = layer.form.is_leaky || node.sums.before >= 0;
  row.out_step = node.rows.step();
  return row;
}

NetOutput NetStream::output_of(Node& node, int y, int z) const {
  const auto added = [&](int other) -> const float* {
    if (other < 0) return nullptr;
    return nodes_[other].rows.at(y, nodes_[other].shape.depth == 1 ? 0 : z);
  };
  return {node.rows.at(y, z), added(node.sums.before), added(node.sums.after)};
}

void NetStream::convolve_row(Node& node, int y, int z) const {
  NetConvolutionRow row = row_of(node);
  add_taps(*node.layer, nodes_[node.input].rows, y, z, row);
  row.out = output_of(node, y, z);
  node.layer->form.is_narrow() ? kernels().convolve_narrow(row) : kernels().convolve(row);
}

// Mixed inputs of a block of columns, as many rows as outputs of a row need.
class NetStream::MixedInputs {
 public:
  MixedInputs(const NetLayerForm& form, const NetRows& input)
      : form_(form), input_(input), held_((form.plain_taps() - 1) * form.dilation + 1) {}

  /// Tiles of a whole row.
  [[nodiscard]] int tiles() const {
    const int span = kNetTile * form_.dilation;
    return (input_.shape().width + span - 1) / span * form_.dilation;
  }
  [[nodiscard]] const NetBlock& block() const { return block_; }
  [[nodiscard]] int first_label() const { return z_; }
  /// Numbers that they take.
  [[nodiscard]] std::size_t count() const { return row_count() * held_.size(); }

  /// Goes on with another block and labels from `z` on, in memory for `count` numbers.
  void begin(const NetBlock& block, int z, float* values) {
    block_ = block;
    z_ = z;
    values_ = values;
    std::ranges::fill(held_, -1);
  }

  /// What a tap of a row reads, or taps of the rows from there on that are mixed.
  const float* at(int y) {
    const std::size_t slot = static_cast<std::size_t>(y) % held_.size();
    float* const out = values_ + slot * row_count();
    if (std::exchange(held_[slot], y) == y) return out;
    NetMixing mixing{.rows = {},
                     .planes = form_.mixed_planes(),
                     .block = block_,
                     .channels = input_.step(),
                     .out = out};
    for (int i = 0; i < mixing.planes; ++i) {
      const int z = form_.mixes_labels() ? z_ + i - 1 : z_;
      const int from = form_.mixes_rows() ? y + i - 1 : y;
      const bool is_within =
          z >= 0 && z < input_.shape().depth && from >= 0 && from < input_.shape().height;
      if (is_within) mixing.rows[i] = input_.at(from, z);
    }
    kernels().mix(mixing);
    return out;
  }

 private:
  [[nodiscard]] std::size_t row_count() const {
    return static_cast<std::size_t>(kNetBlock) * form_.mixed_planes() * kNetMixed * input_.step();
  }

  const NetLayerForm& form_;
  const NetRows& input_;
  std::vector<int> held_;
  NetBlock block_;
  int z_ = 0;
  float* values_ = nullptr;
};

// Memory for the mixed inputs of each thread.
void NetStream::take_scratch(int threads) {
  scratch_count_ = 0;
  for (const Node& node : nodes_) {
    if (node.layer == nullptr || !node.layer->form.is_mixed()) continue;
    const MixedInputs inputs(node.layer->form, nodes_[node.input].rows);
    scratch_count_ = std::max(scratch_count_, inputs.count());
  }
  scratch_ = make_large<float>(scratch_count_ * threads);
}

// A block of row y, or of the rows from there on that are mixed.
void NetStream::convolve_block(const Step& step, int y, MixedInputs& inputs) {
  Node& node = nodes_[step.node];
  const NetLayer& layer = *node.layer;
  const NetLayerForm& form = layer.form;
  NetMixedRow row;
  row.plain = row_of(node);
  row.block = inputs.block();
  row.planes = form.mixed_planes();
  row.weights_stride = form.plain_taps() * layer.tap_stride();
  for (int i = 0; i < form.plain_taps(); ++i) {
    const int from = y + (i - form.plain_taps() / 2) * form.dilation;
    if (from < 0 || from >= node.shape.height) continue;
    row.plain.taps[row.plain.tap_count++] = {inputs.at(from),
                                             layer.weights_data() + i * layer.tap_stride()};
  }
  for (int i = 0; i < (row.planes == 1 ? 1 : kNetTile); ++i) {
    const int to_y = form.mixes_rows() ? y + i : y;
    const int to_z = inputs.first_label() + (form.mixes_labels() ? i : 0);
    if (to_y < step.first || to_y >= step.end || to_z >= node.shape.depth) continue;
    row.outputs[i] = output_of(node, to_y, to_z);
  }
  kernels().convolve_mixed(row);
}

// Threads take blocks of several rows, so that mixed inputs serve as many rows as they have taps.
void NetStream::convolve_mixed(const Step& step, const Progress& progress) {
  const Node& node = nodes_[step.node];
  const NetLayerForm& form = node.layer->form;
  const auto parts = [](int count, int size) { return (count + size - 1) / size; };
  const int row_step = form.mixes_rows() ? kNetTile : 1;
  const int label_step = form.mixes_labels() ? kNetTile : 1;
  const int first = step.first / row_step * row_step;
  const int rows = parts(step.end - first, row_step), labels = parts(node.shape.depth, label_step);
  const int tiles = MixedInputs(form, nodes_[node.input].rows).tiles();
  const int blocks = parts(tiles, kNetBlock) * labels;
  const int piece = std::clamp(rows * blocks / (4 * progress.threads()), 1, rows);
  std::atomic<std::size_t> workers = 0;
  parallel_for_workers(parts(rows, piece) * blocks, progress, [&] {
    float* const scratch = scratch_.get() + workers++ * scratch_count_;
    return [&, scratch, inputs = MixedInputs(form, nodes_[node.input].rows)](int i) mutable {
      const int block = i % blocks / labels * kNetBlock, begin = i / blocks * piece;
      inputs.begin({block, std::min(kNetBlock, tiles - block), form.dilation},
                   i % labels * label_step, scratch);
      for (int row = begin; row < std::min(begin + piece, rows); ++row) {
        convolve_block(step, first + row * row_step, inputs);
      }
    };
  });
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
  kernels().enlarge(row);
}

}  // namespace episcope
