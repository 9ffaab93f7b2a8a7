// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/isa.h"
#include "engine/scenes/stage.h"

namespace episcope::scenes {

/// Casts the rays of one row: one in double through every pixel center, for the truth, and 4×4 in
/// float through every pixel, for the mean color. All instruction sets give the same bits.
using TraceRow = void (*)(const RowJob& job, const RowResult& result);

/// Columns are worked on in groups of this many: rows are padded to a multiple.
inline constexpr int kTraceGroup = 16;

[[nodiscard]] TraceRow trace_row_for(Isa isa);

}  // namespace episcope::scenes
