// SPDX-License-Identifier: BSD-3-Clause
// Compiled once for each instruction set: see engine/core/parallel/isa.h for what may stand here.
#include "engine/disparity/epi/side_choice_kernel.h"

#include "engine/core/parallel/simd.h"

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

void gather_neighbours(const NeighbourRow& row) {
  for (int x = 0; x < row.width; x += kLanes) {
    Vec far = load(row.disparity[0] + x), near = far;
    Vec far_confidence = load(row.confidence[0] + x), near_confidence = far_confidence;
    for (int k = 1; k < kNeighbours; ++k) {
      const Vec d = load(row.disparity[k] + x), r = load(row.confidence[k] + x);
      far_confidence = choose(d < far, r, far_confidence);
      near_confidence = choose(d > near, r, near_confidence);
      far = least(far, d);
      near = greatest(near, d);
    }
    store(row.far + x, far);
    store(row.near + x, near);
    store(row.far_confidence + x, far_confidence);
    store(row.near_confidence + x, near_confidence);
  }
}

struct Votes {
  Vec own{}, far{}, near{};
};

// Sums of residuals of the pixels around, by similarity of colour.
inline Votes collect(const SideRow& row, int x) {
  Vec own_color[3];
  for (int c = 0; c < 3; ++c) own_color[c] = load(row.color[c][kVoteRadius] + x);
  Votes votes;
  for (int j = 0; j < kVoteRows; ++j) {
    for (int i = x - kVoteRadius; i <= x + kVoteRadius; ++i) {
      Vec square{};
      for (int c = 0; c < 3; ++c) {
        const Vec off = load(row.color[c][j] + i) - own_color[c];
        square += off * off;
      }
      // (1 − t/4)⁴ for exp(−t)
      const Vec root = greatest(1.0F - row.sharpness * square, splat(0));
      const Vec weight = root * root * root * root;
      votes.own += weight * load(row.residual[0][j] + i);
      votes.far += weight * load(row.residual[1][j] + i);
      votes.near += weight * load(row.residual[2][j] + i);
    }
  }
  return votes;
}

inline IntVec differs(const SideRow& row, Vec a, Vec b) {
  return absolute(a - b) > row.least_step;
}

void choose_side(const SideRow& row) {
  for (int x = 0; x < row.width; x += kLanes) {
    const Vec own = load(row.disparity + x), far = load(row.far + x), near = load(row.near + x);
    const IntVec has_far = differs(row, own, far), has_near = differs(row, own, near);
    if (!any(has_far | has_near)) continue;
    const Votes votes = collect(row, x);
    const Vec limit = row.advantage * votes.own;
    const IntVec takes_far =
        has_far & (votes.far < limit) & (~has_near | (votes.far <= votes.near));
    const IntVec takes_near = has_near & (votes.near < limit) & ~takes_far;
    const Vec confidence =
        choose(takes_far, load(row.far_confidence + x),
               choose(takes_near, load(row.near_confidence + x), load(row.confidence + x)));
    store(row.disparity + x, choose(takes_far, far, choose(takes_near, near, own)));
    store(row.confidence + x, confidence);
  }
}

}  // namespace

const SideKernel kSideKernel = {gather_neighbours, choose_side};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
