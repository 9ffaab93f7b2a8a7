// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/parallel.h"

#include <array>
#include <concepts>
#include <type_traits>

namespace episcope::io {

/// `look(false)` along u and `look(true)` along v, at the same time where there are threads for it.
/// Reports no progress of its own. Throws what `look` throws.
template <class Look>
requires std::invocable<const Look&, bool>
[[nodiscard]] auto along_both_axes(const Progress& progress, const Look& look) {
  std::array<std::invoke_result_t<const Look&, bool>, 2> found;
  parallel_for(2, progress.part(0, 0),
               [&](int axis) { found[static_cast<std::size_t>(axis)] = look(axis == 1); });
  return found;
}

}  // namespace episcope::io
