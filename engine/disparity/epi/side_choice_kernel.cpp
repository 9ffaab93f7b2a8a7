// SPDX-License-Identifier: BSD-3-Clause
// Compiled once for each instruction set: see engine/core/parallel/isa.h for what may stand here.
#include "engine/disparity/epi/side_choice_kernel.h"

#include "engine/core/parallel/simd.h"

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

void gather_neighbours(const NeighbourRow& row) {
  for (int x = 0; x < row.width; x += kLanes) {
    Vec far = load(row.own_disparity + x), near = far;
    Vec far_confidence = load(row.own_confidence + x), near_confidence = far_confidence;
    const Vec least_trust = row.far_trust * far_confidence;
    for (int k = 0; k < kNeighbours; ++k) {
      const Vec d = load(row.disparity[k] + x), r = load(row.confidence[k] + x);
      const IntVec is_farther = (d < far) & (r >= least_trust);
      far_confidence = choose(is_farther, r, far_confidence);
      near_confidence = choose(d > near, r, near_confidence);
      far = choose(is_farther, d, far);
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

// What is left of the confidence of rays that keep their disparity.
inline Vec kept_share(const SideRow& row, const Votes& votes) {
  const Vec excess = votes.far / greatest(votes.own, splat(1e-20F)) - 1.0F;
  return least(greatest(row.doubtful_share + row.relief * excess, splat(0)), splat(1));
}

void choose_side(const SideRow& row) {
  for (int x = 0; x < row.width; x += kLanes) {
    const Vec own = load(row.disparity + x), far = load(row.far + x), near = load(row.near + x);
    const IntVec has_far = own - far > row.least_step, has_near = near - own > row.least_step;
    if (!any(has_far | has_near)) continue;
    const Votes votes = collect(row, x);
    const IntVec takes_far = has_far & (votes.far < row.far_advantage * votes.own) &
                             (~has_near | (votes.far <= votes.near));
    const IntVec takes_near = has_near & (votes.near < row.near_advantage * votes.own) & ~takes_far;
    const IntVec is_doubtful = own - far > row.doubtful_step;
    const Vec confidence = load(row.confidence + x);
    const Vec kept = choose(is_doubtful, confidence * kept_share(row, votes), confidence);
    store(row.disparity + x, choose(takes_far, far, choose(takes_near, near, own)));
    store(row.confidence + x, choose(takes_far, load(row.far_confidence + x),
                                     choose(takes_near, load(row.near_confidence + x), kept)));
  }
}

}  // namespace

const SideKernel kSideKernel = {gather_neighbours, choose_side};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
