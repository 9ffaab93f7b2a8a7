// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/cast/trace_kernel.h"

namespace episcope::scenes {

EPISCOPE_DECLARE_KERNEL(void trace_row(const RowJob& job, const RowResult& result));

TraceRow trace_row_for([[maybe_unused]] Isa isa) {
  return EPISCOPE_CHOOSE_KERNEL(isa, trace_row);
}

}  // namespace episcope::scenes
