// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/layer_solver.h"

#include "engine/cuda/device.cuh"
#include "engine/solvers/shared_constants.h"

#include <cuda_pipeline.h>

#include <algorithm>
#include <bit>
#include <numeric>
#include <type_traits>
#include <vector>

namespace episcope::cuda {
namespace {

constexpr int kWarp = 32;
constexpr int kMostEach = 16;  // Labels of a lane.

// The messages of a labeling, `[y][x][slot]`: a warp takes a pixel, each of its lanes as many
// labels that follow one another, padded with costs that are never chosen. Slots are in the order
// in which a warp reads them: the first label of every lane, the second of every lane, and so on.
struct MessageField {
  int height = 0, width = 0;
  int labels = 0;  // Padded.
  const float* cost = nullptr;
  const float* weight_across = nullptr;  // `[y][x]` of a pixel and its neighbor to the right,
  const float* weight_down = nullptr;    // and of it and the one below.
  float* across = nullptr;               // Messages of these edges.
  float* down = nullptr;
  float slope = 1, most = 1;
  int reach = 1;  // Lanes beyond which every difference is truncated, a power of 2.

  [[nodiscard]] __host__ __device__ long pixel(int y, int x) const {
    return static_cast<long>(y) * width + x;
  }
  [[nodiscard]] __host__ __device__ int each() const { return labels / kWarp; }
  [[nodiscard]] __host__ __device__ int slot(int label) const {
    return label % each() * kWarp + label / each();
  }
};

// Elements of what groups of rows hand to the next one.
[[nodiscard]] std::size_t handed_size(const MessageField& field);

// How rows of messages are worked on: a block takes a group of rows, each of its warps one of them
// and a pixel behind the row before. A group waits for single values of the one before it, which
// hold `kNotYet` until they are there.

constexpr unsigned kAllLanes = 0xFFFFFFFFU;
constexpr int kNotYet = -1;  // The bits of a NaN that no operation gives.
constexpr float kFar = 1e30F;

// Rows of a group, and pixels that are read ahead.
template <int kEach>
constexpr int kGroupRows = kEach <= 8 ? 8 : 4;
template <int kEach>
constexpr int kAhead = kEach <= 4 ? 4 : 2;

// Floats of one pixel, one for each label of each lane.
template <int kEach>
constexpr int kPixelFloats = kEach* kWarp;

// Labels of one pixel that a lane holds.
template <int kEach>
struct LaneLabels {
  float of[kEach] = {};

  __device__ void read(const float* from) {
#pragma unroll
    for (int k = 0; k < kEach; ++k) of[k] = from[k * kWarp + threadIdx.x];
  }
  __device__ void write(float* to) const {
#pragma unroll
    for (int k = 0; k < kEach; ++k) to[k * kWarp + threadIdx.x] = of[k];
  }
  __device__ void add(const LaneLabels& other) {
#pragma unroll
    for (int k = 0; k < kEach; ++k) of[k] += other.of[k];
  }
};

// Begins to copy one pixel into shared memory; a whole warp calls it.
template <int kEach>
__device__ void begin_to_copy(float* to, const float* from) {
  for (int i = static_cast<int>(threadIdx.x); i < kPixelFloats<kEach> / 4; i += kWarp) {
    __pipeline_memcpy_async(to + 4 * i, from + 4 * i, 4 * sizeof(float));
  }
}

// Numbers in the order of the floats that have the same bits but where the sign is set.
__device__ inline int ordered_bits(float value) {
  const int bits = __float_as_int(value);
  return bits ^ ((bits >> 31) & 0x7FFFFFFF);
}
__device__ inline float from_ordered_bits(int bits) {
  return __int_as_float(bits ^ ((bits >> 31) & 0x7FFFFFFF));
}

// Groups that are on the device at the same time: one that waits must not keep out what it waits
// for.
template <class Kernel>
unsigned groups_at_once(Kernel kernel, int rows, int height, std::size_t shared_bytes) {
  int device = 0, processors = 0, each = 0;
  check(cudaGetDevice(&device));
  check(cudaDeviceGetAttribute(&processors, cudaDevAttrMultiProcessorCount, device));
  check(cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize,
                             static_cast<int>(shared_bytes)));
  check(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&each, kernel, rows * kWarp, shared_bytes));
  const int groups = (height + rows - 1) / rows;
  return static_cast<unsigned>(std::min(groups, std::max(1, processors * each)));
}

// Calls run(kEach) for the labels that each lane holds.
template <class Run>
void with_labels(const MessageField& field, const Run& run) {
  switch (field.each()) {
    case 1:
      return run(std::integral_constant<int, 1>());
    case 2:
      return run(std::integral_constant<int, 2>());
    case 3:
      return run(std::integral_constant<int, 3>());
    case 4:
      return run(std::integral_constant<int, 4>());
    case 8:
      return run(std::integral_constant<int, 8>());
    default:
      return run(std::integral_constant<int, kMostEach>());
  }
}

__device__ float least_of_warp(float value) {
  return from_ordered_bits(__reduce_min_sync(kAllLanes, ordered_bits(value)));
}

template <int kEach>
__device__ float least_of(const float (&values)[kEach]) {
  float low = values[0];
#pragma unroll
  for (int k = 1; k < kEach; ++k) low = fminf(low, values[k]);
  return least_of_warp(low);
}

// min_j in(j) + step·|j − l| of two messages, j in the lanes within `reach`. A lane at an end takes
// itself for the one beyond, which lowers nothing.
template <int kEach>
__device__ void spread(float (&values)[2][kEach], const float (&step)[2], int reach) {
  float rising[2][kEach], falling[2][kEach];  // from lower labels, from higher ones
  float before[2], after[2], cost[2];
#pragma unroll
  for (int e = 0; e < 2; ++e) {
    rising[e][0] = values[e][0];
    falling[e][kEach - 1] = values[e][kEach - 1];
#pragma unroll
    for (int k = 1; k < kEach; ++k) {
      rising[e][k] = fminf(values[e][k], rising[e][k - 1] + step[e]);
      const int back = kEach - 1 - k;
      falling[e][back] = fminf(values[e][back], falling[e][back + 1] + step[e]);
    }
    before[e] = rising[e][kEach - 1];
    after[e] = falling[e][0];
    cost[e] = kEach * step[e];
  }
  for (int shift = 1; shift < reach; shift *= 2) {
#pragma unroll
    for (int e = 0; e < 2; ++e) {
      before[e] = fminf(before[e], __shfl_up_sync(kAllLanes, before[e], shift) + cost[e]);
      after[e] = fminf(after[e], __shfl_down_sync(kAllLanes, after[e], shift) + cost[e]);
      cost[e] *= 2;
    }
  }
#pragma unroll
  for (int e = 0; e < 2; ++e) {
    const float low = __shfl_up_sync(kAllLanes, before[e], 1);
    const float high = __shfl_down_sync(kAllLanes, after[e], 1);
#pragma unroll
    for (int k = 0; k < kEach; ++k) {
      values[e][k] = fminf(fminf(rising[e][k], low + static_cast<float>(k + 1) * step[e]),
                           fminf(falling[e][k], high + static_cast<float>(kEach - k) * step[e]));
    }
  }
}

// What a block holds of the pixels it works on.
template <int kEach>
struct Shared {
  static constexpr int kRows = kGroupRows<kEach>;
  static constexpr int kFloats = kPixelFloats<kEach>;
  float read[kRows][kAhead<kEach>][3][kFloats];  // costs, messages along the row, across rows
  float handed[kAhead<kEach>][kFloats];          // to the first row
  float passed[kRows][2][kFloats];               // from each row to the next, even and odd steps
};

// A row, its pixels numbered in the order of the sweep.
template <int kEach, bool kForward>
class Row {
 public:
  static constexpr int kRows = kGroupRows<kEach>;

  __device__ Row(const MessageField& field, float* handed, int group, Shared<kEach>& shared)
      : field_(field),
        shared_(shared),
        of_group_(static_cast<int>(threadIdx.y)),
        number_(group * kRows + of_group_),
        y_(kForward ? number_ : field.height - 1 - number_),
        group_size_(static_cast<long>(field.width) * field.labels),
        to_next_(handed + group * group_size_) {}

  [[nodiscard]] __device__ bool exists() const { return number_ < field_.height; }

  // Begins to read what does not depend on the row before, and of that what may be there.
  __device__ void read_ahead(int i) const {
    if (i < field_.width) {
      auto& slot = shared_.read[of_group_][i % kAhead<kEach>];
      begin_to_copy<kEach>(slot[0], field_.cost + field_.pixel(y_, place(i)) * field_.labels);
      if (goes_along(i)) begin_to_copy<kEach>(slot[1], to_along(i));
      if (goes_across()) begin_to_copy<kEach>(slot[2], to_across(i));
      if (is_handed()) begin_to_copy<kEach>(shared_.handed[i % kAhead<kEach>], handed_to(i));
    }
    __pipeline_commit();
  }
  __device__ void read_weights(int i) {
    if (i >= field_.width) return;
    if (goes_along(i)) next_weights_[0] = field_.weight_across[edge_along(i)];
    if (goes_across()) next_weights_[1] = field_.weight_down[edge_across(i)];
  }
  // Passes both messages of pixel i on.
  __device__ void pass(int i, int step) {
    __pipeline_wait_prior(kAhead<kEach> - 1);
    __syncwarp();
    const auto& slot = shared_.read[of_group_][i % kAhead<kEach>];
    LaneLabels<kEach> sums, out[2];
    sums.read(slot[0]);
    if (goes_along(i)) out[0].read(slot[1]);
    if (goes_across()) out[1].read(slot[2]);
    sums.add(along_);
    if (number_ > 0) sums.add(before(i, step));
    sums.add(out[0]);
    sums.add(out[1]);
    const float weights[2] = {next_weights_[0], next_weights_[1]};
    __syncwarp();
    read_ahead(i + kAhead<kEach>);
    read_weights(i + 1);
    send(i, step, sums, out, weights);
  }
  [[nodiscard]] __device__ double gain() const { return gain_; }

 private:
  [[nodiscard]] __device__ int place(int i) const { return kForward ? i : field_.width - 1 - i; }
  [[nodiscard]] __device__ bool goes_along(int i) const { return i + 1 < field_.width; }
  [[nodiscard]] __device__ bool goes_across() const { return number_ + 1 < field_.height; }
  [[nodiscard]] __device__ bool is_handed() const { return of_group_ == 0 && number_ > 0; }
  [[nodiscard]] __device__ long edge_along(int i) const {
    return field_.pixel(y_, kForward ? place(i) : place(i) - 1);
  }
  [[nodiscard]] __device__ long edge_across(int i) const {
    return field_.pixel(kForward ? y_ : y_ - 1, place(i));
  }
  [[nodiscard]] __device__ float* to_along(int i) const {
    return field_.across + edge_along(i) * field_.labels;
  }
  [[nodiscard]] __device__ float* to_across(int i) const {
    return field_.down + edge_across(i) * field_.labels;
  }
  [[nodiscard]] __device__ const float* handed_to(int i) const {
    return to_next_ - group_size_ + static_cast<long>(i) * field_.labels;
  }

  // What the row before passes to pixel i.
  __device__ LaneLabels<kEach> before(int i, int step) const {
    LaneLabels<kEach> message;
    if (of_group_ > 0) {
      message.read(shared_.passed[of_group_ - 1][(step - 1) % 2]);
      return message;
    }
    message.read(shared_.handed[i % kAhead<kEach>]);
    const float* const from = handed_to(i) + threadIdx.x;
#pragma unroll
    for (int k = 0; k < kEach; ++k) {
      while (__float_as_int(message.of[k]) == kNotYet) {
        message.of[k] = *static_cast<const volatile float*>(from + k * kWarp);
      }
    }
    __syncwarp();
    return message;
  }

  __device__ void send(int i, int step, const LaneLabels<kEach>& sums,
                       const LaneLabels<kEach> (&old)[2], const float (&weights)[2]) {
    const float low = least_of(sums.of);
    const int taken = (i > 0 ? 1 : 0) + (number_ > 0 ? 1 : 0);
    const int given = (goes_along(i) ? 1 : 0) + (goes_across() ? 1 : 0);
    const float share = 1.0F / static_cast<float>(max(max(taken, given), 1));
    float values[2][kEach], base[2];
#pragma unroll
    for (int e = 0; e < 2; ++e) {
#pragma unroll
      for (int k = 0; k < kEach; ++k) {
        values[e][k] = share * (sums.of[k] - low) - old[e].of[k];
      }
      base[e] = least_of(values[e]);
    }
    spread(values, {weights[0] * field_.slope, weights[1] * field_.slope}, field_.reach);
#pragma unroll
    for (int e = 0; e < 2; ++e) {
      const float limit = weights[e] * field_.most;
#pragma unroll
      for (int k = 0; k < kEach; ++k) values[e][k] = fminf(values[e][k] - base[e], limit);
    }
    float gain = low;
    if (goes_along(i)) {
#pragma unroll
      for (int k = 0; k < kEach; ++k) along_.of[k] = values[0][k];
      along_.write(to_along(i));
      gain += base[0];
    }
    if (goes_across()) {
      send_across(i, step, values[1]);
      gain += base[1];
    }
    gain_ += static_cast<double>(gain);
  }
  __device__ void send_across(int i, int step, const float (&values)[kEach]) const {
    LaneLabels<kEach> message;
#pragma unroll
    for (int k = 0; k < kEach; ++k) message.of[k] = values[k];
    message.write(to_across(i));
    if (of_group_ + 1 < kRows) {
      message.write(shared_.passed[of_group_][step % 2]);
    } else {
      message.write(to_next_ + static_cast<long>(i) * field_.labels);
    }
  }

  const MessageField& field_;
  Shared<kEach>& shared_;
  int of_group_, number_, y_;
  long group_size_;
  float* to_next_;
  LaneLabels<kEach> along_;  // passed to the pixel that comes next
  float next_weights_[2] = {};
  double gain_ = 0;
};

template <int kEach, bool kForward>
__global__ __launch_bounds__(kGroupRows<kEach>* kWarp) void sweep(MessageField field, float* handed,
                                                                  double* gains) {
  extern __shared__ float4 memory[];
  auto& shared = *reinterpret_cast<Shared<kEach>*>(memory);
  constexpr int kRows = kGroupRows<kEach>;
  const int of_group = static_cast<int>(threadIdx.y);
  for (int group = static_cast<int>(blockIdx.x); group * kRows < field.height;
       group += static_cast<int>(gridDim.x)) {
    Row<kEach, kForward> row(field, handed, group, shared);
    if (row.exists()) {
      for (int i = 0; i < kAhead<kEach>; ++i) row.read_ahead(i);
      row.read_weights(0);
    }
    for (int step = 0; step < field.width + kRows - 1; ++step) {
      const int i = step - of_group;
      if (row.exists() && i >= 0 && i < field.width) row.pass(i, step);
      __syncthreads();
    }
    if (row.exists() && threadIdx.x == 0) gains[group * kRows + of_group] = row.gain();
  }
}

template <bool kForward>
void run_sweep(const DeviceStream& stream, const MessageField& field, float* handed,
               double* gains) {
  check(cudaMemsetAsync(handed, 0xFF, handed_size(field) * sizeof(float), stream.get()));
  with_labels(field, [&](auto each) {
    constexpr int kEach = decltype(each)::value;
    const dim3 block(kWarp, kGroupRows<kEach>);
    const std::size_t bytes = sizeof(Shared<kEach>);
    const unsigned groups =
        groups_at_once(sweep<kEach, kForward>, kGroupRows<kEach>, field.height, bytes);
    const double labels = static_cast<double>(field.pixel(field.height, 0)) * field.labels;
    launch(stream, {"messages: sweep", 20 * labels, 40 * labels}, [&] {
      sweep<kEach, kForward><<<groups, block, bytes, stream.get()>>>(field, handed, gains);
    });
  });
}

std::size_t handed_size(const MessageField& field) {
  std::size_t groups = 0;
  with_labels(field, [&](auto each) {
    constexpr int kRows = kGroupRows<decltype(each)::value>;
    groups = (field.height + kRows - 1) / kRows;
  });
  return groups * field.width * field.labels;
}

// Passes messages to the lower right, or to the upper left; fills `gains`, what each row adds to
// the bound. `handed` is scratch memory.
void sweep_down(const DeviceStream& stream, const MessageField& field, float* handed,
                double* gains) {
  run_sweep<true>(stream, field, handed, gains);
}
void sweep_up(const DeviceStream& stream, const MessageField& field, float* handed, double* gains) {
  run_sweep<false>(stream, field, handed, gains);
}

constexpr int kChunk = 8;  // labels of the row above that are read together

__device__ float jump_cost(const MessageField& field, int from, int to) {
  return fminf(field.slope * static_cast<float>(abs(from - to)), field.most);
}

// What a block holds of the pixels it works on.
template <int kEach>
struct SharedSums {
  static constexpr int kRows = kGroupRows<kEach>;
  float read[kRows][kAhead<kEach>][3][kPixelFloats<kEach>];  // costs, messages to the right, down
  int passed[kRows][2];  // labels, from each row to the next, at even and odd steps
};

// A row from left to right.
template <int kEach>
class LabelRow {
 public:
  __device__ LabelRow(const MessageField& field, int* labels, int y, SharedSums<kEach>& shared)
      : field_(field),
        shared_(shared),
        of_group_(static_cast<int>(threadIdx.y)),
        y_(y),
        own_(labels + field.pixel(y, 0)),
        above_(own_ - field.width) {}

  __device__ void begin() {
    for (int x = 0; x < kAhead<kEach>; ++x) read_ahead(x);
    read_above(0);
  }
  __device__ void choose(int x, int step) {
    __pipeline_wait_prior(kAhead<kEach> - 1);
    __syncwarp();
    const LaneLabels<kEach> sums = read_sums(x);
    const int above = label_above(x, step);
    __syncwarp();
    read_ahead(x + kAhead<kEach>);
    const float beside = left_ >= 0 ? field_.weight_across[field_.pixel(y_, x - 1)] : 0;
    const float over = above >= 0 ? field_.weight_down[field_.pixel(y_ - 1, x)] : 0;
    int best = 0;
    float least = kFar;
#pragma unroll
    for (int k = 0; k < kEach; ++k) {
      const int label = static_cast<int>(threadIdx.x) * kEach + k;
      float sum = sums.of[k];
      if (left_ >= 0) sum += beside * jump_cost(field_, label, left_);
      if (above >= 0) sum += over * jump_cost(field_, label, above);
      best = sum < least ? label : best;
      least = fminf(least, sum);
    }
    const int bits = ordered_bits(least);
    const bool is_least = bits == __reduce_min_sync(kAllLanes, bits);
    left_ = static_cast<int>(
        __reduce_min_sync(kAllLanes, is_least ? static_cast<unsigned>(best) : kAllLanes));
    if (threadIdx.x != 0) return;
    own_[x] = left_;
    shared_.passed[of_group_][step % 2] = left_;
  }

 private:
  __device__ void read_ahead(int x) const {
    if (x < field_.width) {
      auto& slot = shared_.read[of_group_][x % kAhead<kEach>];
      const long from = field_.pixel(y_, x) * field_.labels;
      begin_to_copy<kEach>(slot[0], field_.cost + from);
      begin_to_copy<kEach>(slot[1], field_.across + from);
      begin_to_copy<kEach>(slot[2], field_.down + from);
    }
    __pipeline_commit();
  }
  [[nodiscard]] __device__ LaneLabels<kEach> read_sums(int x) const {
    const auto& slot = shared_.read[of_group_][x % kAhead<kEach>];
    LaneLabels<kEach> sums, message;
    sums.read(slot[0]);
    if (x + 1 < field_.width) {
      message.read(slot[1]);
      sums.add(message);
    }
    if (y_ + 1 < field_.height) {
      message.read(slot[2]);
      sums.add(message);
    }
    return sums;
  }

  // Begins to read labels of the group before, from x on, of which some may not yet be there.
  __device__ void read_above(int x) {
    const int lane = static_cast<int>(threadIdx.x);
    if (of_group_ > 0 || y_ == 0 || lane >= kChunk || x + lane >= field_.width) return;
    coming_ = *static_cast<const volatile int*>(above_ + x + lane);
  }
  // −1 in the first row.
  __device__ int label_above(int x, int step) {
    if (y_ == 0) return -1;
    if (of_group_ > 0) return shared_.passed[of_group_ - 1][(step - 1) % 2];
    if (x % kChunk == 0) {
      known_ = coming_;
      read_above(x + kChunk);
    }
    int label = __shfl_sync(kAllLanes, known_, x % kChunk);
    while (label == kNotYet) label = *static_cast<const volatile int*>(above_ + x);
    __syncwarp();
    return label;
  }

  const MessageField& field_;
  SharedSums<kEach>& shared_;
  int of_group_, y_;
  int* own_;
  const int* above_;
  int left_ = -1;
  int known_ = kNotYet, coming_ = kNotYet;
};

template <int kEach>
__global__ __launch_bounds__(kGroupRows<kEach>* kWarp) void read_labels(MessageField field,
                                                                        int* labels) {
  extern __shared__ float4 memory[];
  auto& shared = *reinterpret_cast<SharedSums<kEach>*>(memory);
  constexpr int kRows = kGroupRows<kEach>;
  const int of_group = static_cast<int>(threadIdx.y);
  for (int first = static_cast<int>(blockIdx.x) * kRows; first < field.height;
       first += static_cast<int>(gridDim.x) * kRows) {
    const bool exists = first + of_group < field.height;
    LabelRow<kEach> row(field, labels, first + of_group, shared);
    if (exists) row.begin();
    for (int step = 0; step < field.width + kRows - 1; ++step) {
      const int x = step - of_group;
      if (exists && x >= 0 && x < field.width) row.choose(x, step);
      __syncthreads();
    }
  }
}

// Tiles of 32 pixels by 32 labels.
__global__ void turn(const float* volume, int layers, MessageField field, float* cost) {
  __shared__ float tile[kWarp][kWarp + 1];
  const int y = static_cast<int>(blockIdx.z);
  const int first_x = static_cast<int>(blockIdx.x) * kWarp;
  const int first_l = static_cast<int>(blockIdx.y) * kWarp;
  const int lane = static_cast<int>(threadIdx.x), part = static_cast<int>(threadIdx.y);
  for (int i = part; i < kWarp; i += static_cast<int>(blockDim.y)) {
    const int label = first_l + i, x = first_x + lane;
    const bool is_inside = label < layers && x < field.width;
    tile[i][lane] = is_inside ? volume[(static_cast<long>(y) * layers + label) * field.width + x]
                              : kMessageFiller;
  }
  __syncthreads();
  const int slot = field.slot(first_l + lane);
  for (int i = part; i < kWarp; i += static_cast<int>(blockDim.y)) {
    const int x = first_x + i;
    if (x < field.width) cost[field.pixel(y, x) * field.labels + slot] = tile[lane][i];
  }
}

__global__ void add_energies(MessageField field, const int* labels, double* energies) {
  __shared__ double sums[256];
  const int y = static_cast<int>(blockIdx.x);
  double sum = 0;
  for (int x = static_cast<int>(threadIdx.x); x < field.width; x += 256) {
    const long here = field.pixel(y, x);
    const int label = labels[here];
    sum += static_cast<double>(field.cost[here * field.labels + field.slot(label)]);
    if (x + 1 < field.width) {
      sum += static_cast<double>(field.weight_across[here] *
                                 jump_cost(field, label, labels[here + 1]));
    }
    if (y + 1 < field.height) {
      sum += static_cast<double>(field.weight_down[here] *
                                 jump_cost(field, label, labels[here + field.width]));
    }
  }
  sums[threadIdx.x] = sum;
  __syncthreads();
  for (int half = 128; half > 0; half /= 2) {
    if (static_cast<int>(threadIdx.x) < half) sums[threadIdx.x] += sums[threadIdx.x + half];
    __syncthreads();
  }
  if (threadIdx.x == 0) energies[y] = sums[0];
}

// `[y][label][x]` of `layers` labels to `[y][x][slot]`.
void gather_labels(const DeviceStream& stream, const float* volume, int layers,
                   const MessageField& field, float* cost) {
  const dim3 grid(blocks_for(field.width, kWarp), static_cast<unsigned>(field.each()),
                  static_cast<unsigned>(field.height));
  const double labels = static_cast<double>(field.pixel(field.height, 0)) * field.labels;
  launch(stream, {"messages: costs", 8 * labels},
         [&] { turn<<<grid, dim3(kWarp, 8), 0, stream.get()>>>(volume, layers, field, cost); });
}

// Labels `[y][x]`, each given those above and to the left.
void read_off(const DeviceStream& stream, const MessageField& field, int* labels) {
  const long pixels = field.pixel(field.height, 0);
  check(cudaMemsetAsync(labels, 0xFF, pixels * sizeof(int), stream.get()));
  with_labels(field, [&](auto each) {
    constexpr int kEach = decltype(each)::value;
    constexpr int kRows = kGroupRows<kEach>;
    const std::size_t bytes = sizeof(SharedSums<kEach>);
    const unsigned groups = groups_at_once(read_labels<kEach>, kRows, field.height, bytes);
    const double values = static_cast<double>(pixels) * field.labels;
    launch(stream, {"messages: labels", 12 * values, 12 * values}, [&] {
      read_labels<kEach><<<groups, dim3(kWarp, kRows), bytes, stream.get()>>>(field, labels);
    });
  });
}

// The energy of the labels, `[row]`.
void label_energies(const DeviceStream& stream, const MessageField& field, const int* labels,
                    double* energies) {
  launch(stream, {"messages: energy"}, [&] {
    add_energies<<<static_cast<unsigned>(field.height), 256, 0, stream.get()>>>(field, labels,
                                                                                energies);
  });
}

// Labels that the kernels are made for: up to four of each lane, or a power of two.
int padded_labels(int labels) {
  const auto each = static_cast<unsigned>((labels + kWarp - 1) / kWarp);
  return kWarp * static_cast<int>(each <= 4 ? each : std::bit_ceil(each));
}

// A power of two of lanes, beyond whose labels no difference is below the truncation.
int reach_of(const MessageTask& task, int each) {
  int reach = 1;
  while (reach < kWarp && task.slope * static_cast<float>(each * reach + 1) < task.most) reach *= 2;
  return reach;
}

DeviceArray<float> upload_weights(ImageView<const float> weights, const MessageTask& task,
                                  const DeviceStream& stream, const Progress& progress) {
  const std::size_t size = static_cast<std::size_t>(task.cost.height) * task.cost.width;
  if (!weights.empty()) return upload(weights.data, size, stream, progress);
  const std::vector<float> ones(size, 1.0F);
  return upload(ones.data(), size, stream, progress);
}

// All that the device holds.
class Passing {
 public:
  Passing(const MessageTask& task, const Progress& progress)
      : across_weights_(upload_weights(task.across, task, stream_, progress)),
        down_weights_(upload_weights(task.down, task, stream_, progress)),
        pixels_(static_cast<std::size_t>(task.cost.height) * task.cost.width) {
    field_.height = task.cost.height;
    field_.width = task.cost.width;
    field_.labels = padded_labels(task.cost.layers);
    const std::size_t size = pixels_ * field_.labels;
    cost_ = {size, stream_};
    across_ = {size, stream_};
    down_ = {size, stream_};
    labels_ = {pixels_, stream_};
    sums_ = {static_cast<std::size_t>(field_.height), stream_};
    across_.clear();
    down_.clear();
    gather_labels(stream_, task.cost.values.data(), task.cost.layers, field_, cost_.data());
    field_.cost = cost_.data();
    field_.weight_across = across_weights_.data();
    field_.weight_down = down_weights_.data();
    field_.across = across_.data();
    field_.down = down_.data();
    field_.slope = task.slope;
    field_.most = task.most;
    field_.reach = reach_of(task, field_.each());
    handed_ = {handed_size(field_), stream_};
  }

  // Returns the bound.
  double iterate() {
    sweep_down(stream_, field_, handed_.data(), sums_.data());
    sweep_up(stream_, field_, handed_.data(), sums_.data());
    return sum();
  }
  void finish(MessageAnswer& answer, const Progress& progress) {
    read_off(stream_, field_, labels_.data());
    label_energies(stream_, field_, labels_.data(), sums_.data());
    answer.energy = sum();
    answer.labels = Image<int>(field_.height, field_.width);
    download_bytes(answer.labels.data(), labels_.data(), labels_.byte_size(), stream_, progress);
  }

 private:
  double sum() {
    std::vector<double> rows(sums_.size());
    check(cudaMemcpyAsync(rows.data(), sums_.data(), sums_.byte_size(), cudaMemcpyDeviceToHost,
                          stream_.get()));
    stream_.wait();
    return std::accumulate(rows.begin(), rows.end(), 0.0);
  }

  DeviceStream stream_;
  DeviceArray<float> across_weights_, down_weights_;
  std::size_t pixels_;
  MessageField field_;
  DeviceArray<float> cost_, across_, down_, handed_;
  DeviceArray<int> labels_;
  DeviceArray<double> sums_;
};

}  // namespace

MessageAnswer solve_by_messages(const MessageTask& task, int iterations, const Progress& progress) {
  Passing passing(task, progress.part(0, 0));
  MessageAnswer answer;
  while (answer.iterations < iterations && !progress.finish_requested()) {
    progress.check();
    answer.bound = passing.iterate();
    ++answer.iterations;
    progress.report(static_cast<double>(answer.iterations) / (iterations + 1));
  }
  passing.finish(answer, progress.part(1, 1));
  return answer;
}

}  // namespace episcope::cuda
