// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/order/sign_check.h"

#include <fmt/format.h>

#include <algorithm>

namespace episcope::io {
namespace {

constexpr int kLargestSide = 1024;
constexpr int kSmallestSide = 256;

std::string counted(const OcclusionVotes& votes) {
  return fmt::format("{} points to {}, in {} squares of the view to {}",
                     std::max(votes.forward, votes.reversed),
                     std::min(votes.forward, votes.reversed),
                     std::max(votes.forward_squares, votes.reversed_squares),
                     std::min(votes.forward_squares, votes.reversed_squares));
}

/// Both axes together, counted for the order `flip`.
OcclusionVotes votes_for(const OcclusionByAxis& votes, ViewFlip flip) {
  OcclusionVotes sum = flip.u ? votes.u.turned() : votes.u;
  sum += flip.v ? votes.v.turned() : votes.v;
  return sum;
}

SignFinding related_axes(const OcclusionByAxis& votes, ViewFlip flip) {
  const OcclusionVotes sum = votes_for(votes, flip);
  if (!sum.is_decided()) return {flip, false, {}};
  if (sum.says_reversed()) flip = {!flip.u, !flip.v};
  return {flip, true, "occlusion: " + counted(sum)};
}

SignFinding single_axes(const OcclusionByAxis& votes, GridShape grid, ViewFlip flip) {
  const bool needs_u = grid.u > 1;
  const bool needs_v = grid.v > 1;
  SignFinding found{flip, false, {}};
  found.is_decided = (!needs_u || votes.u.is_decided()) && (!needs_v || votes.v.is_decided());
  if (!found.is_decided) return found;
  if (needs_u) found.flip.u = votes.u.says_reversed();
  if (needs_v) found.flip.v = votes.v.says_reversed();
  found.evidence = "occlusion: ";
  if (needs_u) found.evidence += "along u " + counted(votes.u);
  if (needs_u && needs_v) found.evidence += "; ";
  if (needs_v) found.evidence += "along v " + counted(votes.v);
  return found;
}

}  // namespace

SignFinding check_sign(const LightField::Samples& samples, ViewFlip flip, bool are_axes_related,
                       const Progress& progress) {
  const auto [grid, larger] = std::visit(
      [](const auto& stack) {
        return std::pair(stack.grid(), std::max(stack.width(), stack.height()));
      },
      samples);
  SignFinding found{flip, false, {}};
  if (std::max(grid.u, grid.v) < 3) {
    found.evidence = "occlusion cannot be seen in fewer than three views in a row";
    return found;
  }
  OcclusionVotes most;
  for (int side = std::min(larger, kLargestSide); side >= std::min(kSmallestSide, larger);
       side = (side + 1) / 2) {
    progress.check();
    const OcclusionByAxis votes = count_occlusions(samples, side, progress);
    found = are_axes_related ? related_axes(votes, flip) : single_axes(votes, grid, flip);
    if (found.is_decided) return found;
    const OcclusionVotes sum = votes_for(votes, flip);
    if (sum.forward + sum.reversed > most.forward + most.reversed) most = sum;
    if (side <= kSmallestSide) break;
  }
  found.evidence =
      fmt::format("no depth edges with clear occlusion: {} points for this order, {} against",
                  most.forward, most.reversed);
  return found;
}

}  // namespace episcope::io
