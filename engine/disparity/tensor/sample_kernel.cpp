// SPDX-License-Identifier: BSD-3-Clause
// Compiled once for each instruction set: see engine/core/parallel/isa.h for what may stand here.
#include "engine/disparity/tensor/structure_tensor_kernel.h"

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

typedef std::uint8_t Bytes __attribute__((vector_size(16)));

constexpr float kSampleScale = 1.0F / 255;

// Where sample i of a channel stands among 48 interleaved bytes: gathered from the first two
// vectors, then from the third.
constexpr int from_two(int i, int channel) {
  return 3 * i + channel < 32 ? 3 * i + channel : 0;
}
constexpr int from_third(int i, int channel) {
  return 3 * i + channel < 32 ? i : 3 * i + channel - 16;
}

template <int kChannel>
inline void store_channel(Bytes first, Bytes second, Bytes third, float* out) {
  const Bytes low = __builtin_shufflevector(
      first, second, from_two(0, kChannel), from_two(1, kChannel), from_two(2, kChannel),
      from_two(3, kChannel), from_two(4, kChannel), from_two(5, kChannel), from_two(6, kChannel),
      from_two(7, kChannel), from_two(8, kChannel), from_two(9, kChannel), from_two(10, kChannel),
      from_two(11, kChannel), from_two(12, kChannel), from_two(13, kChannel),
      from_two(14, kChannel), from_two(15, kChannel));
  const Bytes all = __builtin_shufflevector(
      low, third, from_third(0, kChannel), from_third(1, kChannel), from_third(2, kChannel),
      from_third(3, kChannel), from_third(4, kChannel), from_third(5, kChannel),
      from_third(6, kChannel), from_third(7, kChannel), from_third(8, kChannel),
      from_third(9, kChannel), from_third(10, kChannel), from_third(11, kChannel),
      from_third(12, kChannel), from_third(13, kChannel), from_third(14, kChannel),
      from_third(15, kChannel));
  // Through memory: the compiler widens a loop, but takes vector conversions apart.
  std::uint8_t bytes[16];
  __builtin_memcpy(bytes, &all, sizeof bytes);
  for (int i = 0; i < 16; ++i) out[i] = kSampleScale * static_cast<float>(bytes[i]);
}

void deinterleave(const std::uint8_t* in, int count, int channels, float* const* out) {
  if (channels == 1) {
    for (int i = 0; i < count; ++i) out[0][i] = kSampleScale * static_cast<float>(in[i]);
    return;
  }
  int i = 0;
  for (; i + 16 <= count; i += 16) {
    Bytes bytes[3];
    __builtin_memcpy(bytes, in + 3 * static_cast<long>(i), sizeof bytes);
    store_channel<0>(bytes[0], bytes[1], bytes[2], out[0] + i);
    store_channel<1>(bytes[0], bytes[1], bytes[2], out[1] + i);
    store_channel<2>(bytes[0], bytes[1], bytes[2], out[2] + i);
  }
  for (; i < count; ++i) {
    for (int c = 0; c < 3; ++c) out[c][i] = kSampleScale * static_cast<float>(in[3 * i + c]);
  }
}

}  // namespace

extern const SampleKernel kSampleKernel;
const SampleKernel kSampleKernel{deinterleave};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
