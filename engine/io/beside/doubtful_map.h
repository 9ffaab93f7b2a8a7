// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/beside/fitted_meaning.h"
#include "engine/io/order/turned_truth.h"

#include <optional>
#include <vector>

namespace episcope::io {

/// What the numbers of a map mean that may hold others, too, or be stored in another order of
/// pixels.
struct DoubtfulMeaning {
  FittedMeaning meaning;
  std::optional<MapTurn> turn = std::nullopt;  ///< How the map was stored.
};

/// The map as it is where that explains the views well (`fit_meaning`). Else also without each
/// value that may stand for unknown (`possible_unknown_values`), else also turned back
/// (`possible_turns`); each must explain the views far better than those before.
[[nodiscard]] std::optional<DoubtfulMeaning> fit_doubtful_map(const LightField::Samples& samples,
                                                              ViewIndex at,
                                                              const DisparityView& map,
                                                              const std::vector<ValueForm>& forms);

}  // namespace episcope::io
