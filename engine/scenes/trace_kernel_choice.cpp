// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/trace_kernel.h"

namespace episcope::scenes {

namespace baseline {
void trace_row(const RowJob& job, const RowResult& result);
}
#ifndef EPISCOPE_BASELINE_ONLY
namespace avx2 {
void trace_row(const RowJob& job, const RowResult& result);
}
namespace avx512 {
void trace_row(const RowJob& job, const RowResult& result);
}
#endif

TraceRow trace_row_for(Isa isa) {
#ifndef EPISCOPE_BASELINE_ONLY
  if (isa == Isa::Avx512) return avx512::trace_row;
  if (isa == Isa::Avx2) return avx2::trace_row;
#endif
  static_cast<void>(isa);
  return baseline::trace_row;
}

}  // namespace episcope::scenes
