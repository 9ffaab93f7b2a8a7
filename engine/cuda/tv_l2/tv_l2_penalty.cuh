// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// What happens between iterations, and between levels; as tv_l2_steps.cuh, of
/// engine/solvers/tv_l2/tv_l2_penalty_kernel.cpp and tv_l2_grid.cpp.

#include "engine/cuda/tv_l2/tv_l2_steps.cuh"

namespace episcope::cuda {

inline constexpr float kTvL2Spread = 16;  ///< Of the penalty.

/// The gradient of u where there are edges, else 0.
struct TvL2Gradient {
  float x = 0, y = 0;
};
__device__ inline TvL2Gradient gradient_at(const TvL2Level& level, int view, long at, long right) {
  const float* const u = level.of(TvL2Plane::U, view);
  const float here = u[at];
  return {level.of(TvL2Plane::Rx, view)[at] > 0 ? u[right] - here : 0.0F,
          level.of(TvL2Plane::Ry, view)[at] > 0 ? u[at + level.pitch] - here : 0.0F};
}

/// Renews the penalty from u, keeping p and d where |p| = g. `first`: z holds p, rx and ry tell
/// where edges are, and d becomes ∇u.
struct Penalise {
  TvL2Level level;
  const TvL2View* views;
  bool first = false;

  __device__ void renew(int view, long at, long right) const {
    const TvL2Gradient gradient = gradient_at(level, view, at, right);
    const float square = gradient.x * gradient.x + gradient.y * gradient.y + 1e-16F;
    const float ratio = views[view].knee * rsqrtf(square);
    const float bent = fminf(fmaxf(sqrtf(fmaxf(ratio, 0.0F)), 1 / kTvL2Spread), kTvL2Spread);
    const float g = level.of(TvL2Plane::G, view)[at];
    const float next = views[view].scale * g * bent;
    float& rx = level.of(TvL2Plane::Rx, view)[at];
    float& ry = level.of(TvL2Plane::Ry, view)[at];
    float& zx = level.of(TvL2Plane::Zx, view)[at];
    float& zy = level.of(TvL2Plane::Zy, view)[at];
    if (first) {
      zx += next * gradient.x;
      zy += next * gradient.y;
    } else {
      const float keep = shrinkage(zx, zy, g);
      const float edge = fmaxf(rx, ry);
      const float stretch = keep + (1 - keep) * next / (edge > 0 ? edge : 1.0F);
      zx *= stretch;
      zy *= stretch;
    }
    rx = rx > 0 ? next : 0.0F;
    ry = ry > 0 ? next : 0.0F;
  }
  __device__ void operator()(int view, int y, int i) const {
    const long even = y * level.pitch + i;
    renew(view, even, even + level.odd);
    renew(view, even + level.odd, even + 1);
  }
};

/// The penalty of the edges between cells of 2×2. Places are those of the fine level's half rows,
/// rows the coarse level's.
struct CoarsenPenalty {
  TvL2Level fine, coarse;
  const TvL2View* views;

  __device__ void operator()(int view, int y, int i) const {
    const float factor = views[view].coarse_edge;
    const float* const rx = fine.of(TvL2Plane::Rx, view) + 2L * y * fine.pitch + fine.odd + i;
    const float* const ry = fine.of(TvL2Plane::Ry, view) + (2L * y + 1) * fine.pitch + i;
    const long to = coarse.at(y, i);
    coarse.of(TvL2Plane::Rx, view)[to] = factor * (rx[0] + rx[fine.pitch]);
    coarse.of(TvL2Plane::Ry, view)[to] = factor * (ry[0] + ry[fine.odd]);
  }
};

/// 1/diagonal of the linear system; 0 in the padding.
struct InvertDiagonal {
  TvL2Level level;

  __device__ void invert(int view, long at, long left) const {
    const float* const rx = level.of(TvL2Plane::Rx, view);
    const float* const ry = level.of(TvL2Plane::Ry, view);
    const float c = level.of(TvL2Plane::C, view)[at];
    const float diagonal = level.data_scale * c + rx[at] + rx[left] + ry[at] + ry[at - level.pitch];
    level.of(TvL2Plane::Inverse, view)[at] = c > 0 ? 1 / diagonal : 0.0F;
  }
  __device__ void operator()(int view, int y, int i) const {
    const long even = y * level.pitch + i, odd = even + level.odd;
    invert(view, even, odd - 1);
    invert(view, odd, even);
  }
};

/// z ← p.
struct Project {
  TvL2Level level;

  __device__ void operator()(int view, int y, int i) const {
    for (int half = 0; half < 2; ++half) {
      const long at = y * level.pitch + half * level.odd + i;
      float& zx = level.of(TvL2Plane::Zx, view)[at];
      float& zy = level.of(TvL2Plane::Zy, view)[at];
      const float keep = shrinkage(zx, zy, level.of(TvL2Plane::G, view)[at]);
      zx *= keep;
      zy *= keep;
    }
  }
};

/// Where a step works on pixels, the two of a place.
template <class Each>
__device__ void for_pixels(const TvL2Level& level, int i, const Each& each) {
  each(2 * i);
  if (2 * i + 1 < level.width) each(2 * i + 1);
}

/// Data term and weights of the coarse image: cells at an odd border count their pixels twice.
struct CoarsenProblem {
  TvL2Level fine, coarse;

  __device__ void operator()(int view, int y, int i) const {
    for_pixels(coarse, i, [&](int x) {
      const int below = min(2 * y + 1, fine.height - 1), right = min(2 * x + 1, fine.width - 1);
      const auto sum = [&](TvL2Plane which) {
        const float* const plane = fine.of(which, view);
        return plane[fine.at(2 * y, 2 * x)] + plane[fine.at(2 * y, right)] +
               plane[fine.at(below, 2 * x)] + plane[fine.at(below, right)];
      };
      const long to = coarse.at(y, x);
      coarse.of(TvL2Plane::C, view)[to] = 0.5F * sum(TvL2Plane::C);
      coarse.of(TvL2Plane::Cf, view)[to] = 0.5F * sum(TvL2Plane::Cf);
      coarse.of(TvL2Plane::G, view)[to] = 0.25F * sum(TvL2Plane::G);
    });
  }
};

/// Edges of penalty 1, for `Penalise` to give them their value.
__device__ inline void open_edges(const TvL2Level& level, int view, int y, int x) {
  const long at = level.at(y, x);
  level.of(TvL2Plane::Rx, view)[at] = x + 1 < level.width ? 1.0F : 0.0F;
  level.of(TvL2Plane::Ry, view)[at] = y + 1 < level.height ? 1.0F : 0.0F;
}

/// u = f, z = 0.
struct StartFromData {
  TvL2Level level;

  __device__ void operator()(int view, int y, int i) const {
    for_pixels(level, i, [&](int x) {
      const long at = level.at(y, x);
      level.of(TvL2Plane::U, view)[at] =
          level.of(TvL2Plane::Cf, view)[at] / level.of(TvL2Plane::C, view)[at];
      level.of(TvL2Plane::Zx, view)[at] = 0;
      level.of(TvL2Plane::Zy, view)[at] = 0;
      open_edges(level, view, y, x);
    });
  }
};

/// Starts the fine level from the solution on the coarse one, whose z is projected: u bilinear, z
/// linear on the faces, and to be projected.
struct Prolong {
  TvL2Level coarse, fine;

  /// Between rows `here` and `beside` of a coarse plane, at cell x.
  __device__ float blend(const float* plane, int here, int beside, float share, int x) const {
    return (1 - share) * plane[coarse.at(here, x)] + share * plane[coarse.at(beside, x)];
  }
  /// Cell centres: a pixel lies a quarter of a cell beside the centre of its cell.
  template <class Cell>
  __device__ float at_centre(int x, const Cell& cell) const {
    const int own = x / 2;
    const int beside = (x & 1) == 0 ? max(own - 1, 0) : min(own + 1, coarse.width - 1);
    return 0.75F * cell(own) + 0.25F * cell(beside);
  }
  __device__ void operator()(int view, int y, int i) const {
    const int own = y / 2;
    const bool lower = (y & 1) != 0;
    const int beside = lower ? min(own + 1, coarse.height - 1) : max(own - 1, 0);
    const float* const u = coarse.of(TvL2Plane::U, view);
    const float* const zx = coarse.of(TvL2Plane::Zx, view);
    const float* const zy = coarse.of(TvL2Plane::Zy, view);
    for_pixels(fine, i, [&](int x) {
      const long to = fine.at(y, x);
      fine.of(TvL2Plane::U, view)[to] =
          at_centre(x, [&](int cell) { return blend(u, own, beside, 0.25F, cell); });
      const auto face = [&](int cell) { return blend(zx, own, beside, 0.25F, cell); };
      const int cell = x / 2;
      float along = face(cell);
      if ((x & 1) == 0) along = cell == 0 ? 0.5F * along : 0.5F * (along + face(cell - 1));
      fine.of(TvL2Plane::Zx, view)[to] = x + 1 < fine.width ? along : 0.0F;
      // The row above the first one is padding: p = 0 there.
      const int above = lower ? own : own - 1;
      const float down = at_centre(x, [&](int each) { return blend(zy, own, above, 0.5F, each); });
      fine.of(TvL2Plane::Zy, view)[to] = y + 1 < fine.height ? down : 0.0F;
      open_edges(fine, view, y, x);
    });
  }
};

}  // namespace episcope::cuda
