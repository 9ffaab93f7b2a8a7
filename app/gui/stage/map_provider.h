// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/picture/map_choice.h"

#include <QString>

#include <optional>

namespace episcope {

/// Gives the overlay the maps of a subject that the session does not hold.
class MapProvider {
 public:
  virtual ~MapProvider() = default;

  /// Whether a quantity can be shown now, in the current view.
  [[nodiscard]] virtual bool has_map(render::Quantity quantity) const = 0;
  /// Whether there may be maps of it later, so that what is shown stays chosen until then.
  [[nodiscard]] virtual bool awaits_map(render::Quantity quantity) const = 0;
  /// What the map shows, in words; empty where the name of the quantity says it.
  [[nodiscard]] virtual QString title(render::Quantity) const { return {}; }
  /// What the map of a view is made from; nothing if there is no such map.
  [[nodiscard]] virtual std::optional<MapSource> map_source(render::Quantity quantity,
                                                            ViewIndex view) const = 0;
};

}  // namespace episcope
