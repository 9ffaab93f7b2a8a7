// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// The steps of an iteration, each for one place of the half rows of one view; they can run in any
/// order within a step. What they compute is engine/solvers/tv_l2/tv_l2_kernel.cpp, which tells
/// why.

#include "engine/cuda/tv_l2/tv_l2_level.cuh"

namespace episcope::cuda {

/// Factor that projects z to |p| ≤ g.
__device__ inline float shrinkage(float zx, float zy, float g) {
  return fminf(1.0F, g * rsqrtf(fmaxf(zx * zx + zy * zy, 1e-30F)));
}

/// Gauss-Seidel on a pixel whose neighbours beside are given.
__device__ inline void relax_at(const TvL2Level& level, int view, const ColourRow& row, int i,
                                float b, float left, float right, float up, float down) {
  const float* const rx = level.of(TvL2Plane::Rx, view);
  const float* const ry = level.of(TvL2Plane::Ry, view) + row.own + i;
  const float along = b + rx[row.own + i] * right + rx[row.left + i] * left;
  const float across = ry[0] * down + ry[-level.pitch] * up;
  level.of(TvL2Plane::U, view)[row.own + i] =
      (along + across) * level.of(TvL2Plane::Inverse, view)[row.own + i];
}

/// Relaxes one colour.
struct RelaxColour {
  TvL2Level level;
  int colour = 0;

  __device__ void operator()(int view, int y, int i) const {
    const ColourRow row = colour_row(level, y, colour);
    const float* const u = level.of(TvL2Plane::U, view);
    const float* const own = u + row.own + i;
    const float b = level.of(TvL2Plane::B, view)[row.own + i];
    relax_at(level, view, row, i, b, u[row.left + i], u[row.left + i + 1], own[-level.pitch],
             own[level.pitch]);
  }
};

/// Adds the correction of the coarse cells to the pixels of colour 0, which are not stored, and
/// relaxes colour 1 with them; colour 0 is relaxed next, from colour 1 alone.
struct CorrectAndRelax {
  TvL2Level level, coarse;

  __device__ void operator()(int view, int y, int i) const {
    const ColourRow row = colour_row(level, y, 1);
    const float* const u = level.of(TvL2Plane::U, view);
    const float* const own = u + row.own + i;
    const float* const cells = coarse.of(TvL2Plane::U, view);
    const int first = row.left < row.own ? i : i - 1;  // cell of the pixel to the left
    const float* const beside = cells + (y >> 1) * coarse.pitch;
    const auto cell = [&](const float* of_row, int x) {
      return of_row[(x & 1) * coarse.odd + (x >> 1)];
    };
    const float up = own[-level.pitch] + cell(cells + ((y - 1) >> 1) * coarse.pitch, i);
    const float down = own[level.pitch] + cell(cells + ((y + 1) >> 1) * coarse.pitch, i);
    relax_at(level, view, row, i, level.of(TvL2Plane::B, view)[row.own + i],
             u[row.left + i] + cell(beside, first), u[row.left + i + 1] + cell(beside, first + 1),
             up, down);
  }
};

/// Relaxes colour 0 from u = 0.
struct RelaxFromZero {
  TvL2Level level;

  __device__ void operator()(int view, int y, int i) const {
    const long own = colour_row(level, y, 0).own + i;
    level.of(TvL2Plane::U, view)[own] =
        level.of(TvL2Plane::B, view)[own] * level.of(TvL2Plane::Inverse, view)[own];
  }
};

/// Residual of colour 0 in row y.
__device__ inline float residual_at(const TvL2Level& level, int view, int y, int i) {
  const ColourRow row = colour_row(level, y, 0);
  const long own = row.own + i;
  const float* const u = level.of(TvL2Plane::U, view);
  const float* const rx = level.of(TvL2Plane::Rx, view);
  const float* const ry = level.of(TvL2Plane::Ry, view);
  const float here = u[own];
  return level.of(TvL2Plane::B, view)[own] -
         level.data_scale * level.of(TvL2Plane::C, view)[own] * here +
         rx[own] * (u[row.left + i + 1] - here) + rx[row.left + i] * (u[row.left + i] - here) +
         ry[own] * (u[own + level.pitch] - here) +
         ry[own - level.pitch] * (u[own - level.pitch] - here);
}

/// The residual of fine cells of 2×2, summed; colour 1, relaxed last, has none. Places are those of
/// the fine level's half rows, rows the coarse level's.
struct Restrict {
  TvL2Level fine, coarse;

  __device__ void operator()(int view, int y, int i) const {
    float sum = residual_at(fine, view, 2 * y, i);
    if (2 * y + 1 < fine.height) sum += residual_at(fine, view, 2 * y + 1, i);
    coarse.of(TvL2Plane::B, view)[coarse.at(y, i)] = sum;
  }
};

/// z ← p + relaxed step along the gradient, for both pixels of a place.
struct MoveDual {
  TvL2Level level;
  const TvL2View* views;

  __device__ void move(int view, long at, float along, float down) const {
    const float factor = views[view].relaxation;
    float* const zx = level.of(TvL2Plane::Zx, view) + at;
    float* const zy = level.of(TvL2Plane::Zy, view) + at;
    const float x = *zx, y = *zy;
    const float stay = 1 - factor * (1 - shrinkage(x, y, level.of(TvL2Plane::G, view)[at]));
    *zx = x * stay + factor * level.of(TvL2Plane::Rx, view)[at] * along;
    *zy = y * stay + factor * level.of(TvL2Plane::Ry, view)[at] * down;
  }
  __device__ void operator()(int view, int y, int i) const {
    const long even = y * level.pitch + i, odd = even + level.odd;
    const float* const u = level.of(TvL2Plane::U, view);
    const float of_even = u[even], of_odd = u[odd];
    move(view, even, of_odd - of_even, u[even + level.pitch] - of_even);
    move(view, odd, u[even + 1] - of_odd, u[odd + level.pitch] - of_odd);
  }
};

/// b ← c·f + div(2p − z), and relaxes colour 0, which no dual needs any more.
struct RenewAndRelax {
  TvL2Level level;

  struct Vector {
    float x = 0, y = 0;
  };
  /// 2p − z.
  __device__ Vector reflected(int view, long at) const {
    const float x = level.of(TvL2Plane::Zx, view)[at], y = level.of(TvL2Plane::Zy, view)[at];
    const float mirror = 2 * shrinkage(x, y, level.of(TvL2Plane::G, view)[at]) - 1;
    return {x * mirror, y * mirror};
  }
  __device__ void operator()(int view, int y, int i) const {
    const long even = y * level.pitch + i, odd = even + level.odd;
    const Vector of_even = reflected(view, even), of_odd = reflected(view, odd);
    const float left = reflected(view, odd - 1).x;
    const float above_even = reflected(view, even - level.pitch).y;
    const float above_odd = reflected(view, odd - level.pitch).y;
    const float* const cf = level.of(TvL2Plane::Cf, view);
    const float b_even = cf[even] + (of_even.x - left) + (of_even.y - above_even);
    const float b_odd = cf[odd] + (of_odd.x - of_even.x) + (of_odd.y - above_odd);
    float* const b = level.of(TvL2Plane::B, view);
    b[even] = b_even;
    b[odd] = b_odd;
    const ColourRow row = colour_row(level, y, 0);
    const float* const u = level.of(TvL2Plane::U, view);
    const float* const own = u + row.own + i;
    relax_at(level, view, row, i, row.own < row.left ? b_even : b_odd, u[row.left + i],
             u[row.left + i + 1], own[-level.pitch], own[level.pitch]);
  }
};

}  // namespace episcope::cuda
