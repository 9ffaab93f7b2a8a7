// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/messages/message_rows.cuh"

namespace episcope::cuda {
namespace {

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

}  // namespace

std::size_t handed_size(const MessageField& field) {
  std::size_t groups = 0;
  with_labels(field, [&](auto each) {
    constexpr int kRows = kGroupRows<decltype(each)::value>;
    groups = (field.height + kRows - 1) / kRows;
  });
  return groups * field.width * field.labels;
}

void sweep_down(const DeviceStream& stream, const MessageField& field, float* handed,
                double* gains) {
  run_sweep<true>(stream, field, handed, gains);
}
void sweep_up(const DeviceStream& stream, const MessageField& field, float* handed, double* gains) {
  run_sweep<false>(stream, field, handed, gains);
}

}  // namespace episcope::cuda
