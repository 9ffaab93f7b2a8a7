// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/scene.h"
#include "engine/io/models/order/view_axes.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// How maps of all views may be stored.
struct StoredOrder {
  bool is_transposed = false;
  ViewFlip flip;

  /// Where the map of a view is stored.
  [[nodiscard]] ViewIndex place(ViewIndex view, GridShape grid) const {
    return flipped(is_transposed ? ViewIndex{view.u, view.v} : view, grid, flip);
  }
  /// "rows and columns of views exchanged", "u reversed", …
  [[nodiscard]] std::string text() const;
};

/// How little maps fit, as a mean.
struct Misfit {
  double sum = 0;
  double count = 0;

  void operator+=(const Misfit& more) {
    sum += more.sum;
    count += more.count;
  }
  [[nodiscard]] double mean() const { return sum / std::max(count, 1e-9); }
};

struct BetterOrder {
  StoredOrder order;
  double misfit = 0;
  double as_stored = 0;
};

/// Finds an order by which maps of all views fit far better, at three views off the center and off
/// the diagonal. `misfit_of(view, place)`: of the map of a view if it is stored at that place.
/// Nothing if the maps fit as stored within `small_misfit`.
[[nodiscard]] std::optional<BetterOrder> find_better_order(
    GridShape grid, double small_misfit,
    const std::function<Misfit(ViewIndex view, ViewIndex place)>& misfit_of);

/// Puts maps and labels of all views, whose center is right, into the order of the views: their
/// rows and columns of views may be exchanged or reversed. Looks at three views off the center and
/// off the diagonal. Maps must agree with the map of the center view, which shows the same points
/// in other places. Edges of labels must lie on jumps of the true disparity, or without it on edges
/// of the views. Another order is taken if this is far better by it. Returns a warning about what
/// was changed. Views are in canonical order.
[[nodiscard]] std::vector<std::string> put_truth_views_in_order(const LightField::Samples& samples,
                                                                GroundTruth& truth);

}  // namespace episcope::io
