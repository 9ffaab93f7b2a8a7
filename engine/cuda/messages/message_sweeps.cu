// SPDX-License-Identifier: BSD-3-Clause
// A warp goes along a row, lanes being labels; the row after it follows a few pixels behind.
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/messages/message_sweeps.cuh"

#include <algorithm>

namespace episcope::cuda {
namespace {

constexpr float kFar = 1e30F;
constexpr float kNever = 1e6F;  // of labels that only fill a warp
constexpr int kStep = 8;        // pixels between two looks at the row before
constexpr unsigned kAll = 0xFFFFFFFFU;

__device__ float least_of_warp(float value) {
  for (int offset = kWarp / 2; offset > 0; offset /= 2) {
    value = fminf(value, __shfl_xor_sync(kAll, value, offset));
  }
  return value;
}

// Waits until the row before has passed `count` pixels.
__device__ void wait_for(const int* done, int count) {
  if (threadIdx.x == 0) {
    while (*static_cast<const volatile int*>(done) < count) __nanosleep(40);
  }
  __syncwarp();
  __threadfence();
}

__device__ void publish(int* done, int count) {
  __threadfence();
  __syncwarp();
  if (threadIdx.x == 0) *static_cast<volatile int*>(done) = count;
}

// Numbers of the labels of one pixel that a lane holds.
template <int kEach>
struct Lane {
  float of[kEach];

  // What another row may have written.
  __device__ void read(const float* from) {
#pragma unroll
    for (int k = 0; k < kEach; ++k) of[k] = __ldcg(from + k * kWarp + threadIdx.x);
  }
  __device__ void write(float* to) const {
#pragma unroll
    for (int k = 0; k < kEach; ++k) to[k * kWarp + threadIdx.x] = of[k];
  }
  __device__ void fill(float value) {
#pragma unroll
    for (int k = 0; k < kEach; ++k) of[k] = value;
  }
  [[nodiscard]] __device__ float least() const {
    float low = of[0];
#pragma unroll
    for (int k = 1; k < kEach; ++k) low = fminf(low, of[k]);
    return least_of_warp(low);
  }
};

// min_j in(j) + step·|j − l|, by shifts of 1, 2, 4 … up to `reach`. `rows` holds two rows.
template <int kEach>
__device__ void spread(Lane<kEach>& values, float step, int reach, float* rows) {
  constexpr int kLabels = kEach * kWarp;
  float* from = rows;
  float* to = rows + kLabels;
  for (int shift = 1; shift <= reach; shift *= 2) {
    values.write(from);
    __syncwarp();
    const float cost = step * static_cast<float>(shift);
#pragma unroll
    for (int k = 0; k < kEach; ++k) {
      const int l = k * kWarp + static_cast<int>(threadIdx.x);
      const float before = l >= shift ? from[l - shift] : kFar;
      const float after = l + shift < kLabels ? from[l + shift] : kFar;
      values.of[k] = fminf(values.of[k], fminf(before, after) + cost);
    }
    float* const next = from;
    from = to;
    to = next;
  }
  __syncwarp();
}

// One pixel and the edges that meet there: `in` come from where the sweep was, `out` go on.
template <int kEach>
struct Pixel {
  Lane<kEach> cost, in_along, in_across, out_along, out_across;
  bool has_in_along = false, has_in_across = false, has_out_along = false, has_out_across = false;
  float weight_along = 0, weight_across = 0;  // of the edges out
  float* to_along = nullptr;
  float* to_across = nullptr;
};

template <int kEach, bool kForward>
class Row {
 public:
  __device__ Row(const MessageField& field, int y, float* rows)
      : field_(field), y_(y), rows_(rows) {}

  // What does not depend on the row before.
  __device__ void read(int x, Pixel<kEach>& pixel) const {
    const long here = field_.pixel(y_, x);
    pixel.cost.read(field_.cost + here * field_.labels);
    const int after_x = kForward ? x : x - 1, after_y = kForward ? y_ : y_ - 1;
    pixel.has_out_along = kForward ? x + 1 < field_.width : x > 0;
    pixel.has_out_across = kForward ? y_ + 1 < field_.height : y_ > 0;
    pixel.has_in_along = kForward ? x > 0 : x + 1 < field_.width;
    pixel.has_in_across = kForward ? y_ > 0 : y_ + 1 < field_.height;
    if (pixel.has_out_along) {
      const long edge = field_.pixel(y_, after_x);
      pixel.weight_along = field_.weight_across[edge];
      pixel.to_along = field_.across + edge * field_.labels;
      pixel.out_along.read(pixel.to_along);
    }
    if (pixel.has_out_across) {
      const long edge = field_.pixel(after_y, x);
      pixel.weight_across = field_.weight_down[edge];
      pixel.to_across = field_.down + edge * field_.labels;
      pixel.out_across.read(pixel.to_across);
    }
  }
  __device__ void read_before(int x, Pixel<kEach>& pixel) const {
    if (!pixel.has_in_across) return;
    const long edge = field_.pixel(kForward ? y_ - 1 : y_, x);
    pixel.in_across.read(field_.down + edge * field_.labels);
  }
  // Passes both messages on; that along the row is what the next pixel takes in. Returns what the
  // bound gains.
  __device__ float pass(Pixel<kEach>& pixel, Lane<kEach>& along) const {
    Lane<kEach> sums = pixel.cost;
    add(sums, kForward ? pixel.has_in_along : pixel.has_out_along,
        kForward ? along : pixel.out_along);
    add(sums, kForward ? pixel.has_in_across : pixel.has_out_across,
        kForward ? pixel.in_across : pixel.out_across);
    add(sums, kForward ? pixel.has_out_along : pixel.has_in_along,
        kForward ? pixel.out_along : along);
    add(sums, kForward ? pixel.has_out_across : pixel.has_in_across,
        kForward ? pixel.out_across : pixel.in_across);
    const float low = sums.least();
    const int before = (pixel.has_in_along ? 1 : 0) + (pixel.has_in_across ? 1 : 0);
    const int after = (pixel.has_out_along ? 1 : 0) + (pixel.has_out_across ? 1 : 0);
    const float share = 1.0F / static_cast<float>(max(max(before, after), 1));
    float gain = low;
    if (pixel.has_out_along) {
      gain += send(sums, low, share, pixel.weight_along, pixel.out_along, pixel.to_along);
      along = pixel.out_along;
    }
    if (pixel.has_out_across) {
      gain += send(sums, low, share, pixel.weight_across, pixel.out_across, pixel.to_across);
    }
    return gain;
  }

 private:
  __device__ static void add(Lane<kEach>& sums, bool has, const Lane<kEach>& message) {
    if (!has) return;
#pragma unroll
    for (int k = 0; k < kEach; ++k) sums.of[k] += message.of[k];
  }
  __device__ float send(const Lane<kEach>& sums, float low, float share, float weight,
                        Lane<kEach>& message, float* to) const {
#pragma unroll
    for (int k = 0; k < kEach; ++k) {
      message.of[k] = share * (sums.of[k] - low) - message.of[k];
    }
    const float base = message.least();
    spread(message, weight * field_.slope, field_.reach, rows_);
    const float limit = weight * field_.most;
#pragma unroll
    for (int k = 0; k < kEach; ++k) message.of[k] = fminf(message.of[k] - base, limit);
    message.write(to);
    return base;
  }

  const MessageField& field_;
  int y_;
  float* rows_;
};

template <int kEach, bool kForward>
__global__ void sweep(MessageField field, SweepState state) {
  __shared__ float rows[2 * kEach * kWarp];
  for (int number = static_cast<int>(blockIdx.x); number < field.height;
       number += static_cast<int>(gridDim.x)) {
    const Row<kEach, kForward> row(field, kForward ? number : field.height - 1 - number, rows);
    const auto place = [&](int i) { return kForward ? i : field.width - 1 - i; };
    Pixel<kEach> pixel, next;
    Lane<kEach> along;
    double gain = 0;
    row.read(place(0), next);
    for (int i = 0; i < field.width; ++i) {
      pixel = next;
      if (number > 0 && i % kStep == 0) {
        wait_for(state.done + number - 1, min(i + kStep, field.width));
      }
      row.read_before(place(i), pixel);
      if (i + 1 < field.width) row.read(place(i + 1), next);
      gain += static_cast<double>(row.pass(pixel, along));
      if (i % kStep == kStep - 1 || i + 1 == field.width) publish(state.done + number, i + 1);
    }
    if (threadIdx.x == 0) state.gains[number] = gain;
  }
}

// The label of least cost, of equals the lowest.
struct Choice {
  float cost;
  int label;
};
__device__ Choice best_of_warp(Choice own) {
  for (int offset = kWarp / 2; offset > 0; offset /= 2) {
    const float cost = __shfl_xor_sync(kAll, own.cost, offset);
    const int label = __shfl_xor_sync(kAll, own.label, offset);
    if (cost < own.cost || (cost == own.cost && label < own.label)) own = {cost, label};
  }
  return own;
}

__device__ float jump_cost(const MessageField& field, int from, int to) {
  return fminf(field.slope * static_cast<float>(abs(from - to)), field.most);
}

template <int kEach>
__global__ void read_labels(MessageField field, SweepState state) {
  for (int y = static_cast<int>(blockIdx.x); y < field.height; y += static_cast<int>(gridDim.x)) {
    int left = -1;
    for (int x = 0; x < field.width; ++x) {
      if (y > 0 && x % kStep == 0) wait_for(state.done + y - 1, min(x + kStep, field.width));
      const long here = field.pixel(y, x);
      const int above = y > 0 ? __ldcg(state.labels + here - field.width) : -1;
      const float beside = left >= 0 ? field.weight_across[here - 1] : 0;
      const float over = above >= 0 ? field.weight_down[here - field.width] : 0;
      Choice best{kFar, 0};
#pragma unroll
      for (int k = 0; k < kEach; ++k) {
        const int l = k * kWarp + static_cast<int>(threadIdx.x);
        const long at = here * field.labels + l;
        float sum = field.cost[at];
        if (x + 1 < field.width) sum += field.across[at];
        if (y + 1 < field.height) sum += field.down[at];
        if (left >= 0) sum += beside * jump_cost(field, l, left);
        if (above >= 0) sum += over * jump_cost(field, l, above);
        if (sum < best.cost) best = {sum, l};
      }
      left = best_of_warp(best).label;
      if (threadIdx.x == 0) state.labels[here] = left;
      if (x % kStep == kStep - 1 || x + 1 == field.width) publish(state.done + y, x + 1);
    }
  }
}

// Rows that are on the device at the same time: one that waits must not keep out what it waits for.
template <class Kernel>
unsigned rows_at_once(Kernel kernel, int height) {
  int device = 0, processors = 0, each = 0;
  check(cudaGetDevice(&device));
  check(cudaDeviceGetAttribute(&processors, cudaDevAttrMultiProcessorCount, device));
  check(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&each, kernel, kWarp, 0));
  return static_cast<unsigned>(std::min(height, std::max(1, processors * each)));
}

template <class Kernel>
void run_rows(const DeviceStream& stream, const char* name, double floats, Kernel kernel,
              const MessageField& field, const SweepState& state) {
  check(cudaMemsetAsync(state.done, 0, field.height * sizeof(int), stream.get()));
  const double labels = static_cast<double>(field.pixel(field.height, 0)) * field.labels;
  const unsigned blocks = rows_at_once(kernel, field.height);
  launch(stream, {name, 4 * floats * labels, 30 * labels},
         [&] { kernel<<<blocks, kWarp, 0, stream.get()>>>(field, state); });
}

// Calls run(kEach) for the labels that each lane holds.
template <class Run>
void with_labels(const MessageField& field, const Run& run) {
  const int each = field.labels / kWarp;
  if (each <= 1) return run(std::integral_constant<int, 1>());
  if (each <= 2) return run(std::integral_constant<int, 2>());
  if (each <= 4) return run(std::integral_constant<int, 4>());
  if (each <= 8) return run(std::integral_constant<int, 8>());
  return run(std::integral_constant<int, 16>());
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
  for (int i = part; i < kWarp; i += static_cast<int>(blockDim.y)) {
    const int x = first_x + i;
    if (x < field.width) cost[field.pixel(y, x) * field.labels + first_l + lane] = tile[lane][i];
  }
}

__global__ void add_energies(MessageField field, const int* labels, double* energies) {
  __shared__ double sums[256];
  const int y = static_cast<int>(blockIdx.x);
  double sum = 0;
  for (int x = static_cast<int>(threadIdx.x); x < field.width; x += 256) {
    const long here = field.pixel(y, x);
    const int label = labels[here];
    sum += static_cast<double>(field.cost[here * field.labels + label]);
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
  const dim3 grid(blocks_for(field.width, kWarp), static_cast<unsigned>(field.labels / kWarp),
                  static_cast<unsigned>(field.height));
  const double labels = static_cast<double>(field.pixel(field.height, 0)) * field.labels;
  launch(stream, {"messages: costs", 8 * labels},
         [&] { turn<<<grid, dim3(kWarp, 8), 0, stream.get()>>>(volume, layers, field, cost); });
}

void sweep_down(const DeviceStream& stream, const MessageField& field, const SweepState& state) {
  with_labels(field, [&](auto each) {
    run_rows(stream, "messages: sweep", 6, sweep<decltype(each)::value, true>, field, state);
  });
}

void sweep_up(const DeviceStream& stream, const MessageField& field, const SweepState& state) {
  with_labels(field, [&](auto each) {
    run_rows(stream, "messages: sweep", 6, sweep<decltype(each)::value, false>, field, state);
  });
}

void read_off(const DeviceStream& stream, const MessageField& field, const SweepState& state) {
  with_labels(field, [&](auto each) {
    run_rows(stream, "messages: labels", 3, read_labels<decltype(each)::value>, field, state);
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
