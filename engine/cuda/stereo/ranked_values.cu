// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/stereo/ranked_values.cuh"

#include <bit>
#include <cstddef>

namespace episcope::cuda {
namespace {

// The bits of a value ≥ 0 grow with it: what has a rank is found digit by digit.
constexpr int kDigitBits = 11;
constexpr int kDigits = 1 << kDigitBits;

// Of the values whose bits above the digit are those of a rank, a row of blocks each, how many have
// each digit, `[rank][digit]`.
__global__ void count_digits(const float* values, int count, int shift, const unsigned* above,
                             unsigned* counts) {
  __shared__ unsigned own[kDigits];
  for (int i = static_cast<int>(threadIdx.x); i < kDigits; i += static_cast<int>(blockDim.x)) {
    own[i] = 0;
  }
  __syncthreads();
  const unsigned wanted = above[blockIdx.y];
  const int step = static_cast<int>(gridDim.x * blockDim.x);
  for (int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x); i < count; i += step) {
    const unsigned digit = __float_as_uint(values[i]) >> shift;
    if (digit / kDigits == wanted) atomicAdd(&own[digit % kDigits], 1U);
  }
  __syncthreads();
  unsigned* const of_rank = counts + blockIdx.y * kDigits;
  for (int i = static_cast<int>(threadIdx.x); i < kDigits; i += static_cast<int>(blockDim.x)) {
    if (own[i] != 0) atomicAdd(&of_rank[i], own[i]);
  }
}

// Where a rank falls: its digit, and its rank among the values of that digit.
unsigned digit_of(const unsigned* counts, unsigned& rank) {
  unsigned digit = 0;
  while (digit + 1 < kDigits && counts[digit] <= rank) rank -= counts[digit++];
  return digit;
}

}  // namespace

std::vector<float> ranked_on_device(const float* values, int count, const std::vector<int>& ranks,
                                    const DeviceStream& stream) {
  constexpr int kThreads = 512, kBlocks = 64;
  const std::size_t size = ranks.size();
  DeviceArray<unsigned> counts(size * kDigits, stream), above_there(size, stream);
  std::vector<unsigned> left(ranks.begin(), ranks.end()), above(size, 0), found(size * kDigits);
  for (int shift = 2 * kDigitBits; shift >= 0; shift -= kDigitBits) {
    counts.clear();
    check(cudaMemcpyAsync(above_there.data(), above.data(), above_there.byte_size(),
                          cudaMemcpyHostToDevice, stream.get()));
    launch(stream, {"stereo: ranks", 4.0 * count * static_cast<double>(size)}, [&] {
      count_digits<<<dim3(kBlocks, static_cast<unsigned>(size)), kThreads, 0, stream.get()>>>(
          values, count, shift, above_there.data(), counts.data());
    });
    check(cudaMemcpyAsync(found.data(), counts.data(), counts.byte_size(), cudaMemcpyDeviceToHost,
                          stream.get()));
    stream.wait();
    for (std::size_t i = 0; i < size; ++i) {
      above[i] = above[i] * kDigits + digit_of(&found[i * kDigits], left[i]);
    }
  }
  std::vector<float> results;
  for (const unsigned bits : above) results.push_back(std::bit_cast<float>(bits));
  return results;
}

float median_on_device(const float* values, int count, const DeviceStream& stream) {
  return ranked_on_device(values, count, {count / 2}, stream).front();
}

}  // namespace episcope::cuda
