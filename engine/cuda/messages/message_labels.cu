// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/messages/message_rows.cuh"

namespace episcope::cuda {
namespace {

constexpr float kNever = 1e6F;  // of labels that only fill a warp
constexpr int kChunk = 8;       // labels of the row above that are read together

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
    tile[i][lane] =
        is_inside ? volume[(static_cast<long>(y) * layers + label) * field.width + x] : kNever;
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

}  // namespace

void gather_labels(const DeviceStream& stream, const float* volume, int layers,
                   const MessageField& field, float* cost) {
  const dim3 grid(blocks_for(field.width, kWarp), static_cast<unsigned>(field.each()),
                  static_cast<unsigned>(field.height));
  const double labels = static_cast<double>(field.pixel(field.height, 0)) * field.labels;
  launch(stream, {"messages: costs", 8 * labels},
         [&] { turn<<<grid, dim3(kWarp, 8), 0, stream.get()>>>(volume, layers, field, cost); });
}

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

void label_energies(const DeviceStream& stream, const MessageField& field, const int* labels,
                    double* energies) {
  launch(stream, {"messages: energy"}, [&] {
    add_energies<<<static_cast<unsigned>(field.height), 256, 0, stream.get()>>>(field, labels,
                                                                                energies);
  });
}

}  // namespace episcope::cuda
