// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/beside/truth_sign.h"

#include "engine/io/order/sign_check.h"

#include <fmt/format.h>

#include <optional>

namespace episcope::io {
namespace {

constexpr const char* kByOrder =
    "no depth edges tell near from far: the sign is the one that leaves the views in the order in "
    "which they are stored";

std::optional<TruthSign> sign_by_views(const LightField::Samples& samples,
                                       const Explanation& explanation) {
  const ViewFlip flip{explanation.reversed_u, explanation.reversed_v};
  const SignFinding views = check_sign(samples, flip, true, Progress(1));
  if (!views.is_decided) return std::nullopt;
  const bool is_negated = !(views.flip == flip);
  return TruthSign{is_negated, true,
                   fmt::format("{} values are nearer, by {}", is_negated ? "smaller" : "larger",
                               views.evidence)};
}

}  // namespace

TruthSign find_truth_sign(const LightField::Samples& samples, const NearSide& side,
                          const Explanation& explanation) {
  if (side.is_decided()) {
    return {!side.larger_is_nearer(), true,
            fmt::format("{} values are nearer: they {}",
                        side.larger_is_nearer() ? "larger" : "smaller", hiding_text(side))};
  }
  const GridShape grid = grid_of(samples);
  if (!explanation.is_good() || explanation.is_transposed || grid.count() == 1) return {};
  if (auto sign = sign_by_views(samples, explanation)) return std::move(*sign);
  const bool runs_backwards =
      (grid.u == 1 || explanation.reversed_u) && (grid.v == 1 || explanation.reversed_v);
  return {runs_backwards, false, runs_backwards ? kByOrder : ""};
}

}  // namespace episcope::io
