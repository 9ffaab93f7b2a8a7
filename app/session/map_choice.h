// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/quantity_map.h"
#include "app/session/session.h"

#include <optional>

namespace episcope {

/// Which map of the session: a quantity, of which estimates.
struct MapChoice {
  render::Quantity quantity = render::Quantity::View;
  int estimate = 0;
  int other = 0;  ///< For a difference: estimate − other.
  friend bool operator==(const MapChoice&, const MapChoice&) = default;
};

/// Whether a quantity can be shown now, in some view. Quantities of a segmentation cannot, since
/// the session does not hold it.
[[nodiscard]] bool is_available(const Session& session, render::Quantity quantity);

/// Looks up what a map of a view is made from. None for the view itself and for maps that do not
/// exist, or not yet: then asks Session::evaluation for what is missing.
[[nodiscard]] std::optional<MapSource> map_source(Session& session, const MapChoice& choice,
                                                  ViewIndex view);

}  // namespace episcope
