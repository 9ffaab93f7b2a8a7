// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/indices.h"

namespace episcope {

/// Grids up to this many views are looked at closely; what is reported of larger ones is found from
/// a part of the pixels of each view, so that it does not take seconds (1.3 GB in 27×27 views).
inline constexpr int kLookedAtClosely = 81;

/// Whether what is told of views of this grid comes from a part of the pixels. What changes samples
/// for good and what marks pixels as invalid is measured closely all the same.
[[nodiscard]] inline bool has_many_views(GridShape grid) {
  return grid.count() > kLookedAtClosely;
}

}  // namespace episcope
