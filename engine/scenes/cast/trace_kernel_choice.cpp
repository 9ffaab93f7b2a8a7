// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/cast/trace_kernel.h"

namespace episcope::scenes {

namespace baseline {
void trace_row(const RowJob& job, const RowResult& result);
}
namespace avx2 {
void trace_row(const RowJob& job, const RowResult& result);
}
namespace avx512 {
void trace_row(const RowJob& job, const RowResult& result);
}

TraceRow trace_row_for([[maybe_unused]] Isa isa) {
  return EPISCOPE_CHOOSE_KERNEL(isa, trace_row);
}

}  // namespace episcope::scenes
