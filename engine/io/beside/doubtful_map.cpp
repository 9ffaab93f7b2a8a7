// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/beside/doubtful_map.h"

#include "engine/io/beside/unknown_value.h"

#include <utility>

namespace episcope::io {
namespace {

/// A map that explains views this well, as a share of the error without warping, is as it should
/// be.
constexpr double kWell = 0.5;
/// Share of the error of what was found before.
constexpr double kFarBetter = 0.6;

}  // namespace

std::optional<DoubtfulMeaning> fit_doubtful_map(const LightField::Samples& samples, ViewIndex at,
                                                const DisparityView& map,
                                                const std::vector<ValueForm>& forms) {
  std::optional<DoubtfulMeaning> best;
  const auto is_well = [&] { return best && best->meaning.error < kWell * best->meaning.unwarped; };
  const auto look = [&](const DisparityView& part, const std::optional<MapTurn>& turn) {
    auto meaning = fit_meaning(samples, at, part, forms);
    if (!meaning || (best && meaning->error > kFarBetter * best->meaning.error)) return;
    best = {std::move(*meaning), turn};
  };
  look(map, std::nullopt);
  for (const float unknown : possible_unknown_values(map)) {
    if (is_well()) break;
    const Image<std::uint8_t> valid = valid_without(map, unknown);
    look({map.disparity, valid.view()}, std::nullopt);
  }
  for (const MapTurn& turn : possible_turns(map.disparity.height, map.disparity.width)) {
    if (is_well()) break;
    look(turned_back(map, turn).view({}), turn);
  }
  return best;
}

}  // namespace episcope::io
