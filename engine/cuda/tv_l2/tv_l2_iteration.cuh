// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/tv_l2/tv_l2_level.cuh"

namespace episcope::cuda {

/// One iteration on the level being solved, all steps in one kernel: corrects (unless it is the
/// first) and relaxes both colours, moves the dual, renews b, relaxes both colours, restricts the
/// residual to `coarse`. What it moves goes to the second planes.
void iterate_by_tiles(const DeviceStream& stream, const TvL2Level& level, const TvL2Level& coarse,
                      int views, const TvL2View* of_views, bool is_first);
/// The same, quicker where there are enough strips of the level to keep the device busy.
void iterate_by_strips(const DeviceStream& stream, const TvL2Level& level, const TvL2Level& coarse,
                       int views, const TvL2View* of_views, bool is_first);
[[nodiscard]] bool has_enough_strips(const TvL2Level& level, int views);

/// Multigrid, down: smooths `level` from 0 and restricts the residual to `coarse`. u is not stored.
void descend_level(const DeviceStream& stream, const TvL2Level& level, const TvL2Level& coarse,
                   int views, const TvL2View* of_views);

/// Multigrid, up: u of `level` after the correction by `coarse`.
void ascend_level(const DeviceStream& stream, const TvL2Level& level, const TvL2Level& coarse,
                  int views, const TvL2View* of_views);

}  // namespace episcope::cuda
