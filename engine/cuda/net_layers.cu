// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/net_layers.cuh"

#include <algorithm>
#include <cassert>

namespace episcope::cuda {
namespace {

// Each thread sums kRun columns of up to kOutputsOfThread outputs; a warp has 4 runs of 8 rows.
constexpr int kRun = TensorShape::kRun;
constexpr int kWarpColumns = 32, kWarpRows = 8;
constexpr int kOutputsOfThread = 8;
// Inputs that are held in shared memory at once, while the next are fetched.
constexpr int kChunk = 4;
constexpr int kQuad = 4;  // Numbers that are fetched at once.

struct Convolution {
  const float* input;
  float* out;
  const float* before;  // In the layout of `out`; of a map, labels are 0 numbers apart.
  const float* after;
  const float* weights;  // `[block of outputs][z][chunk][input of it][y][x][output of the block]`
  const float* bias;
  TensorShape from, to;
  long before_label, before_channel;
  int depth_taps, depth_stride;
  bool is_leaky;
};

// How a block computes: kGroups warps of kOut outputs each beside each other, kTiles × 8 rows.
template <int kKernel_, int kStride_, int kDilation_, int kGroups_, int kTiles_, int kOut_>
struct Blocking {
  static constexpr int kKernel = kKernel_, kStride = kStride_, kDilation = kDilation_;
  static constexpr int kGroups = kGroups_, kTiles = kTiles_, kOut = kOut_;
  static constexpr int kReach = kKernel / 2 * kDilation;
  static constexpr int kMargin = kReach > 0 ? kQuad : 0;
  static_assert(kReach <= kQuad);
  static constexpr int kColumns = kWarpColumns * kStride + kMargin + (kStride == 1 ? kMargin : 0);
  static constexpr int kRows = (kWarpRows * kTiles - 1) * kStride + 1 + 2 * kReach;
  // Rows begin in banks that make reads of a warp free of conflicts, or nearly so.
  static constexpr int kPitch = kColumns + (kColumns % 32 == 8 || kColumns % 32 == 0 ? 4 : 8);
  static constexpr int kTaps = kKernel * kKernel;
  static constexpr int kOutputs = kGroups * kOut;
  static constexpr int kInputNumbers = kChunk * kRows * kPitch;
  static constexpr int kWeightNumbers = kChunk * kTaps * kOutputs;
  static constexpr int kStage = kInputNumbers + kWeightNumbers;
  static constexpr int kThreads = 32 * kGroups * kTiles;
  static constexpr int kSpan = (kRun - 1) * kStride + 2 * kReach + 1;  // Columns a run reads.
};

// 16 bytes, of which the last are zeros where there are less.
__device__ void fetch_quad(float* to, const float* from, int bytes) {
  const auto address = static_cast<unsigned>(__cvta_generic_to_shared(to));
  asm volatile("cp.async.cg.shared.global [%0], [%1], 16, %2;\n" ::"r"(address), "l"(from),
               "r"(bytes));
}
__device__ void end_stage() {
  asm volatile("cp.async.commit_group;\n");
}
template <int kPending>
__device__ void wait_for_stages() {
  asm volatile("cp.async.wait_group %0;\n" ::"n"(kPending));
}

// Fetches inputs of a chunk at one label, and their weights.
template <class B>
__device__ void fetch(const Convolution& work, int x, int y, int z, int chunk, const float* weights,
                      float* stage) {
  for (int i = static_cast<int>(threadIdx.x); i < kChunk * B::kRows * (B::kColumns / kQuad);
       i += B::kThreads) {
    const int quad = i % (B::kColumns / kQuad), line = i / (B::kColumns / kQuad);
    const int row = line % B::kRows, part = line / B::kRows;
    const int channel = chunk * kChunk + part;
    const int from_x = x * B::kStride - B::kMargin + quad * kQuad;
    const int from_y = y * B::kStride - B::kReach + row;
    const bool is_within = channel < work.from.channels && from_y >= 0 &&
                           from_y < work.from.height && from_x >= 0 && from_x < work.from.width;
    const float* const from =
        is_within ? work.input + work.from.at(channel, z, from_y, from_x) : work.input;
    const int bytes = is_within ? 4 * min(kQuad, work.from.width - from_x) : 0;
    fetch_quad(stage + line * B::kPitch + quad * kQuad, from, bytes);
  }
  float* const to = stage + B::kInputNumbers;
  for (int i = static_cast<int>(threadIdx.x); i < B::kWeightNumbers / kQuad; i += B::kThreads) {
    fetch_quad(to + i * kQuad, weights + i * kQuad, 16);
  }
}

// What a run reads of a row, from column `from` on, whose margin is on a boundary of quads.
template <class B>
__device__ void load_span(const float* from, float (&span)[B::kSpan]) {
  constexpr int kBegin = B::kMargin - B::kReach, kEnd = kBegin + B::kSpan;
#pragma unroll
  for (int quad = kBegin / kQuad; quad * kQuad < kEnd; ++quad) {
    const int first = quad * kQuad;
    if (first >= kBegin && first + kQuad <= kEnd) {
      const float4 four = *reinterpret_cast<const float4*>(from + first);
      span[first - kBegin] = four.x;
      span[first - kBegin + 1] = four.y;
      span[first - kBegin + 2] = four.z;
      span[first - kBegin + 3] = four.w;
    } else {
#pragma unroll
      for (int i = first; i < first + kQuad; ++i) {
        if (i >= kBegin && i < kEnd) span[i - kBegin] = from[i];
      }
    }
  }
}

template <int kOut>
__device__ void load_weights(const float* from, float (&weights)[kOut]) {
  if constexpr (kOut % kQuad == 0) {
#pragma unroll
    for (int i = 0; i < kOut; i += kQuad) {
      const float4 four = *reinterpret_cast<const float4*>(from + i);
      weights[i] = four.x;
      weights[i + 1] = four.y;
      weights[i + 2] = four.z;
      weights[i + 3] = four.w;
    }
  } else {
#pragma unroll
    for (int i = 0; i < kOut; ++i) weights[i] = from[i];
  }
}

template <class B>
__device__ void add_products(const float* inputs, const float* weights,
                             float (&sums)[B::kOut][kRun]) {
#pragma unroll 1
  for (int part = 0; part < kChunk; ++part) {
#pragma unroll
    for (int i = 0; i < B::kKernel; ++i) {
      float span[B::kSpan];
      load_span<B>(inputs + (part * B::kRows + i * B::kDilation) * B::kPitch, span);
#pragma unroll
      for (int j = 0; j < B::kKernel; ++j) {
        float weight[B::kOut];
        load_weights(weights + (part * B::kTaps + i * B::kKernel + j) * B::kOutputs, weight);
#pragma unroll
        for (int o = 0; o < B::kOut; ++o) {
#pragma unroll
          for (int p = 0; p < kRun; ++p) {
            sums[o][p] += weight[o] * span[p * B::kStride + j * B::kDilation];
          }
        }
      }
    }
  }
}

__device__ void load_run(const float* from, float (&run)[kRun]) {
  load_weights<kRun>(from, run);
}

// A run of one output: bias, sums and the ReLU.
__device__ void finish_run(const Convolution& work, int channel, int z, int y, int x,
                           const float (&sums)[kRun]) {
  const long at = work.to.at(channel, z, y, x);
  const float bias = work.bias[channel];
  float run[kRun], added[kRun];
#pragma unroll
  for (int p = 0; p < kRun; ++p) run[p] = sums[p] + bias;
  if (work.before != nullptr) {
    load_run(work.before + channel * work.before_channel + z * work.before_label +
                 static_cast<long>(y) * work.to.pitch() + x,
             added);
#pragma unroll
    for (int p = 0; p < kRun; ++p) run[p] += added[p];
  }
  if (work.is_leaky) {
#pragma unroll
    for (int p = 0; p < kRun; ++p) run[p] = fmaxf(run[p], kNetLeak * run[p]);
  }
  if (work.after != nullptr) {
    load_run(work.after + at, added);
#pragma unroll
    for (int p = 0; p < kRun; ++p) run[p] += added[p];
  }
  auto* const out = reinterpret_cast<float4*>(work.out + at);
  out[0] = {run[0], run[1], run[2], run[3]};
  out[1] = {run[4], run[5], run[6], run[7]};
}

template <class B>
__global__ __launch_bounds__(B::kThreads,
                             B::kThreads > 128 ? 2 : 4) void convolve_tiles(Convolution work) {
  extern __shared__ float stages[];
  const int columns = (work.to.width + kWarpColumns - 1) / kWarpColumns;
  const int tile_x = static_cast<int>(blockIdx.x) % columns * kWarpColumns;
  const int tile_y = static_cast<int>(blockIdx.x) / columns * kWarpRows * B::kTiles;
  const int z = static_cast<int>(blockIdx.z);
  const int warp = static_cast<int>(threadIdx.x) / 32, lane = static_cast<int>(threadIdx.x) % 32;
  const int group = warp % B::kGroups, run_x = lane % 4 * kRun;
  const int run_y = warp / B::kGroups * kWarpRows + lane / 4;

  const int chunks = (work.from.channels + kChunk - 1) / kChunk;
  const int first_z = z * work.depth_stride - work.depth_taps / 2;
  const int begin = max(0, -first_z), end = min(work.depth_taps, work.from.depth - first_z);
  const float* weights = work.weights + (static_cast<long>(blockIdx.y) * work.depth_taps + begin) *
                                            chunks * B::kWeightNumbers;
  const int count = (end - begin) * chunks;
  const auto begin_stage = [&](int i) {
    fetch<B>(work, tile_x, tile_y, first_z + begin + i / chunks, i % chunks,
             weights + static_cast<long>(i) * B::kWeightNumbers, stages + i % 2 * B::kStage);
    end_stage();
  };

  float sums[B::kOut][kRun] = {};
  begin_stage(0);
  for (int i = 0; i < count; ++i) {
    if (i + 1 < count) {
      begin_stage(i + 1);
      wait_for_stages<1>();
    } else {
      wait_for_stages<0>();
    }
    __syncthreads();
    const float* const stage = stages + i % 2 * B::kStage;
    add_products<B>(stage + run_y * B::kStride * B::kPitch + run_x * B::kStride,
                    stage + B::kInputNumbers + group * B::kOut, sums);
    __syncthreads();
  }
  const int x = tile_x + run_x, y = tile_y + run_y;
  if (x >= work.to.width || y >= work.to.height) return;
#pragma unroll
  for (int o = 0; o < B::kOut; ++o) {
    const int channel = static_cast<int>(blockIdx.y) * B::kOutputs + group * B::kOut + o;
    if (channel < work.to.channels) finish_run(work, channel, z, y, x, sums[o]);
  }
}

// Outputs of a block: so many warps that these cover all, or halves of more than 64.
int groups_of(int outputs) {
  const int groups = (outputs + kOutputsOfThread - 1) / kOutputsOfThread;
  return groups > 8 ? (groups + 1) / 2 : groups;
}
int outputs_of_block(int outputs) {
  return outputs <= 2 ? outputs : groups_of(outputs) * kOutputsOfThread;
}
int blocks_of_outputs(int outputs) {
  return (outputs + outputs_of_block(outputs) - 1) / outputs_of_block(outputs);
}

template <class B>
void launch_tiles(const Convolution& work, const DeviceStream& stream) {
  constexpr int kBytes = 2 * B::kStage * static_cast<int>(sizeof(float));
  static const bool is_set =
      (check(cudaFuncSetAttribute(convolve_tiles<B>, cudaFuncAttributeMaxDynamicSharedMemorySize,
                                  kBytes)),
       true);
  static_cast<void>(is_set);
  const unsigned tiles =
      blocks_for(work.to.width, kWarpColumns) * blocks_for(work.to.height, kWarpRows * B::kTiles);
  const dim3 grid(tiles, blocks_of_outputs(work.to.channels), work.to.depth);
  convolve_tiles<B><<<grid, B::kThreads, kBytes, stream.get()>>>(work);
}

// Throws for a form that `net` does not have.
[[noreturn]] void refuse() {
  throw DeviceFailure("this build has no kernel for a layer of these weights");
}

template <int kKernel, int kStride, int kDilation>
void launch_groups(const Convolution& work, const DeviceStream& stream) {
  switch (groups_of(work.to.channels)) {
    case 4:
      return launch_tiles<Blocking<kKernel, kStride, kDilation, 4, 1, 8>>(work, stream);
    case 6:
      return launch_tiles<Blocking<kKernel, kStride, kDilation, 6, 1, 8>>(work, stream);
    case 7:
      return launch_tiles<Blocking<kKernel, kStride, kDilation, 7, 1, 8>>(work, stream);
    case 8:
      return launch_tiles<Blocking<kKernel, kStride, kDilation, 8, 1, 8>>(work, stream);
    default:
      refuse();
  }
}

// The layers with the most work: few outputs, more rows.
void launch_plain(const Convolution& work, const DeviceStream& stream) {
  if (work.to.channels == 1) return launch_tiles<Blocking<3, 1, 1, 1, 8, 1>>(work, stream);
  if (work.to.channels == 2) return launch_tiles<Blocking<3, 1, 1, 1, 8, 2>>(work, stream);
  switch (groups_of(work.to.channels)) {
    case 1:
      return launch_tiles<Blocking<3, 1, 1, 1, 8, 8>>(work, stream);
    case 2:
      return launch_tiles<Blocking<3, 1, 1, 2, 4, 8>>(work, stream);
    case 4:
      return launch_tiles<Blocking<3, 1, 1, 4, 2, 8>>(work, stream);
    default:
      return launch_groups<3, 1, 1>(work, stream);
  }
}

void launch_convolution(const Convolution& work, const NetConvolution& form,
                        const DeviceStream& stream) {
  if (form.kernel == 1) {
    if (groups_of(form.outputs) != 2) return launch_groups<1, 1, 1>(work, stream);
    return launch_tiles<Blocking<1, 1, 1, 2, 4, 8>>(work, stream);
  }
  if (form.stride == 2) return launch_groups<3, 2, 1>(work, stream);
  if (form.dilation == 1) return launch_plain(work, stream);
  if (form.dilation == 2) return launch_groups<3, 1, 2>(work, stream);
  if (form.dilation == 4) return launch_groups<3, 1, 4>(work, stream);
  refuse();
}

// Doubling.

struct Enlarging {
  const float* from;
  const float* plus;
  float* out;
  TensorShape shape, to;
};

// A place between two of half as many: the near one weighs 3/4.
struct Between {
  int near;
  int far;
};
__device__ Between between(int place, int extent) {
  const int near = place / 2;
  return {near, min(max(place % 2 == 0 ? near - 1 : near + 1, 0), extent - 1)};
}

__global__ void enlarge_rows(Enlarging work) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y);
  const int channel = static_cast<int>(blockIdx.z) / work.to.depth;
  const int z = static_cast<int>(blockIdx.z) % work.to.depth;
  if (x >= work.to.width) return;
  const Between columns = between(x, work.shape.width), rows = between(y, work.shape.height);
  const auto row_at = [&](int label, int row) {
    const float* const from = work.from + work.shape.at(channel, label, row, 0);
    return 0.75F * from[columns.near] + 0.25F * from[columns.far];
  };
  const auto plane_at = [&](int label) {
    return 0.75F * row_at(label, rows.near) + 0.25F * row_at(label, rows.far);
  };
  float value = 0;
  if (work.to.depth == 1) {
    value = plane_at(0);
  } else {
    const Between labels = between(z, work.shape.depth);
    value = 0.75F * plane_at(labels.near) + 0.25F * plane_at(labels.far);
  }
  const long at = work.to.at(channel, z, y, x);
  work.out[at] = value + work.plus[at];
}

void enlarge(const NetTensor& input, const NetTensor& plus, NetTensor& out,
             const DeviceStream& stream) {
  constexpr int kThreads = 128;
  const TensorShape& to = out.shape;
  const Enlarging work{input.values.data(), plus.values.data(), out.values.data(), input.shape, to};
  const auto size = static_cast<double>(to.size());
  launch(stream, {"net: doubling", 4 * (2 * size + size / 8), 15 * size}, [&] {
    const dim3 grid(blocks_for(to.width, kThreads), to.height, to.channels * to.depth);
    enlarge_rows<<<grid, kThreads, 0, stream.get()>>>(work);
  });
}

// Weights in the order of Convolution; zeros fill up chunks and blocks.
std::vector<float> ordered_weights(const NetConvolution& form) {
  const int taps = form.kernel * form.kernel, of_block = outputs_of_block(form.outputs);
  const int chunks = (form.inputs + kChunk - 1) / kChunk;
  const std::size_t of_chunk = static_cast<std::size_t>(kChunk) * taps * of_block;
  std::vector<float> ordered(of_chunk * chunks * form.depth_taps * blocks_of_outputs(form.outputs));
  const float* next = form.weights.data();
  for (int output = 0; output < form.outputs; ++output) {
    for (int input = 0; input < form.inputs; ++input) {
      for (int z = 0; z < form.depth_taps; ++z) {
        const std::size_t chunk =
            (static_cast<std::size_t>(output / of_block) * form.depth_taps + z) * chunks +
            input / kChunk;
        for (int tap = 0; tap < taps; ++tap) {
          ordered[chunk * of_chunk +
                  (static_cast<std::size_t>(input % kChunk) * taps + tap) * of_block +
                  output % of_block] = *next++;
        }
      }
    }
  }
  return ordered;
}

int halved(int extent, int stride) {
  return (extent - 1) / stride + 1;
}

}  // namespace

DevicePart::DevicePart(const NetPart& part, const DeviceStream& stream, const Progress& progress) {
  for (const NetStep& from : part) {
    Step step{from.convolution, from.input, from.before, from.after, 0, {}, {}};
    const int number = static_cast<int>(steps_.size());
    for (const int input : {step.input, step.before, step.after}) {
      if (input >= 0) steps_[input].last_use = number;
    }
    if (step.form.kernel > 0) {
      const std::vector<float> weights = ordered_weights(from.convolution);
      std::vector<float> bias = from.convolution.bias;
      bias.resize(step.form.outputs);
      step.weights = upload(weights.data(), weights.size(), stream, progress);
      step.bias = upload(bias.data(), bias.size(), stream, progress);
    }
    step.form.weights.clear();
    steps_.push_back(std::move(step));
  }
}

TensorShape DevicePart::shape_of(const Step& step, const std::vector<TensorShape>& known) const {
  if (step.form.kernel == 0) return known[step.after];
  const TensorShape& from = known[step.input];
  const int depth = step.form.depth_taps > 1 ? halved(from.depth, step.form.stride) : from.depth;
  return {step.form.outputs, depth, halved(from.height, step.form.stride),
          halved(from.width, step.form.stride)};
}

void DevicePart::convolve(const Step& step, const std::vector<NetTensor>& tensors, NetTensor& out,
                          const DeviceStream& stream) const {
  const auto values = [&](int number) {
    return number < 0 ? nullptr : tensors[number].values.data();
  };
  const NetTensor& input = tensors[step.input];
  const NetConvolution& form = step.form;
  assert(input.shape.channels == form.inputs);
  Convolution work{values(step.input),  out.values.data(), values(step.before), values(step.after),
                   step.weights.data(), step.bias.data(),  input.shape,         out.shape};
  if (step.before >= 0) {
    const TensorShape& before = tensors[step.before].shape;
    work.before_label = before.depth == 1 ? 0 : before.plane();
    work.before_channel = before.depth * before.plane();
  }
  work.depth_taps = form.depth_taps;
  work.depth_stride = form.depth_taps > 1 ? form.stride : 1;
  work.is_leaky = form.is_leaky || step.before >= 0;
  const auto size = static_cast<double>(out.shape.size());
  const double products = size * form.inputs * form.depth_taps * form.kernel * form.kernel;
  launch(stream,
         {form.depth_taps > 1 ? "net: convolutions of labels" : "net: convolutions",
          4 * (size + static_cast<double>(input.shape.size())), 2 * products},
         [&] { launch_convolution(work, form, stream); });
}

NetTensor DevicePart::run(std::vector<NetTensor> sources, const DeviceStream& stream,
                          const Progress& progress) const {
  std::vector<NetTensor> tensors(steps_.size());
  std::vector<TensorShape> shapes;
  auto source = sources.begin();
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const Step& step = steps_[i];
    if (step.input < 0) {
      tensors[i] = std::move(*source++);
    } else {
      tensors[i] = NetTensor(shape_of(step, shapes), stream);
      step.form.kernel > 0 ? convolve(step, tensors, tensors[i], stream)
                           : enlarge(tensors[step.input], tensors[step.after], tensors[i], stream);
      stream.wait();
      progress.check();
      progress.report(static_cast<double>(i) / static_cast<double>(steps_.size()));
    }
    shapes.push_back(tensors[i].shape);
    for (std::size_t j = 0; j < i; ++j) {
      if (steps_[j].last_use == static_cast<int>(i)) tensors[j] = {};
    }
  }
  return std::move(tensors.back());
}

double DevicePart::bytes(const std::vector<TensorShape>& sources) const {
  std::vector<TensorShape> shapes;
  auto source = sources.begin();
  double held = 0, most = 0;
  const auto bytes_of = [](const TensorShape& shape) {
    return static_cast<double>(shape.size() * sizeof(float));
  };
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    shapes.push_back(steps_[i].input < 0 ? *source++ : shape_of(steps_[i], shapes));
    held += bytes_of(shapes.back());
    most = std::max(most, held);
    for (std::size_t j = 0; j < i; ++j) {
      if (steps_[j].last_use == static_cast<int>(i)) held -= bytes_of(shapes[j]);
    }
  }
  return most;
}

}  // namespace episcope::cuda
