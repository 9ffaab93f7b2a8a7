// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/kernels/sample_kernel.h"

// Compiled once for each instruction set: see engine/core/isa.h for what may stand here.

#if defined(__x86_64__)
#include <immintrin.h>
#endif

// The intrinsics of GCC 12 leave lanes that they overwrite uninitialized (GCC PR105593).
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

constexpr float kSampleScale = 1.0F / 255;

#if defined(__AVX512BW__) && EPISCOPE_VECTOR_BYTES == 64

// Byte `channel` of each of the four pixels at the start of 16 bytes, widened to 32 bits.
inline __m512i channel_bytes(int channel) {
  const int low = static_cast<int>(0x80808000U) + channel;
  return _mm512_broadcast_i32x4(_mm_setr_epi32(low, low + 3, low + 6, low + 9));
}

// 16 pixels: quarters of 12 bytes, each moved to the start of 16.
inline void deinterleave_16(const std::uint8_t* in, float* const* out) {
  const __m512i quarters = _mm512_setr_epi32(0, 1, 2, 0, 3, 4, 5, 0, 6, 7, 8, 0, 9, 10, 11, 0);
  const __m512i bytes =
      _mm512_maskz_permutexvar_epi32(0x7777, quarters, _mm512_maskz_loadu_epi32(0x0FFF, in));
  for (int c = 0; c < 3; ++c) {
    const __m512i samples = _mm512_shuffle_epi8(bytes, channel_bytes(c));
    _mm512_storeu_ps(out[c], _mm512_set1_ps(kSampleScale) * _mm512_cvtepi32_ps(samples));
  }
}

#else

typedef std::uint8_t Bytes __attribute__((vector_size(16)));

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

inline void deinterleave_16(const std::uint8_t* in, float* const* out) {
  Bytes bytes[3];
  __builtin_memcpy(bytes, in, sizeof bytes);
  store_channel<0>(bytes[0], bytes[1], bytes[2], out[0]);
  store_channel<1>(bytes[0], bytes[1], bytes[2], out[1]);
  store_channel<2>(bytes[0], bytes[1], bytes[2], out[2]);
}

#endif

void deinterleave(const std::uint8_t* in, int count, int channels, float* const* out) {
  if (channels == 1) {
    for (int i = 0; i < count; ++i) out[0][i] = kSampleScale * static_cast<float>(in[i]);
    return;
  }
  int i = 0;
  for (; i + 16 <= count; i += 16) {
    float* const to[3] = {out[0] + i, out[1] + i, out[2] + i};
    deinterleave_16(in + 3 * static_cast<long>(i), to);
  }
  for (; i < count; ++i) {
    for (int c = 0; c < 3; ++c) out[c][i] = kSampleScale * static_cast<float>(in[3 * i + c]);
  }
}

}  // namespace

extern const SampleKernel kSampleKernel;
const SampleKernel kSampleKernel{deinterleave};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
