// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace episcope {

/// While it exists, this thread treats denormal floats as zero, where the processor supports it.
/// Iterations decay to denormals in flat areas, which would slow down every operation on them.
class FlushDenormals {
#if defined(__x86_64__)
 public:
  FlushDenormals() : before_(_mm_getcsr()) {
    constexpr unsigned denormals_are_zeros = 0x0040;
    _mm_setcsr(before_ | _MM_FLUSH_ZERO_ON | denormals_are_zeros);
  }
  ~FlushDenormals() {
    _mm_setcsr(before_);
  }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned before_;
#endif
};

}  // namespace episcope
