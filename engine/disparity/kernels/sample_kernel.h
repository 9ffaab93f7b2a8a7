// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/isa.h"

#include <cstdint>

namespace episcope {

/// Reads samples, in a version for each instruction set.
struct SampleKernel {
  /// Interleaved bytes to float planes in [0, 1]: out[c][i] = in[i·channels + c]/255.
  void (*deinterleave)(const std::uint8_t* in, int count, int channels, float* const* out);
};

EPISCOPE_DECLARE_KERNEL(extern const SampleKernel kSampleKernel);

}  // namespace episcope
