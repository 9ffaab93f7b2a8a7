// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/picture/quantity_map.h"

#include <memory>

namespace episcope {

/// Which views something is known of: a block of the grid.
struct ViewCoverage {
  GridShape grid{};  ///< Empty = none.
  ViewIndex first{};
};

template <class T>
[[nodiscard]] ViewCoverage coverage_of(const ViewStack<T>& stack) {
  return stack.empty() ? ViewCoverage() : ViewCoverage{stack.grid(), stack.first()};
}

/// How a quantity of a result is found in it: one row of a table.
struct ResultMap {
  render::Quantity quantity;
  const char* what;  ///< In a sentence: "the result has no confidence".
  ViewCoverage (*coverage)(const Estimate& estimate);
  /// Precondition: the view is covered.
  std::shared_ptr<QuantityMap> (*make)(const EstimatePtr& estimate, ViewIndex view);
};

/// The row of a quantity; quantities of other subjects (render::Subject) have that of the
/// disparity, from which they are computed.
[[nodiscard]] const ResultMap& result_map_of(render::Quantity quantity);

/// A map that `owner` keeps alive.
[[nodiscard]] std::shared_ptr<QuantityMap> borrowed_map(const DisparityView& view,
                                                        std::shared_ptr<const void> owner);

}  // namespace episcope
