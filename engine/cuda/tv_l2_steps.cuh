// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/device.cuh"
#include "engine/solvers/shared_constants.h"

#include <cstdint>
#include <utility>

namespace episcope::cuda {

/// What a level of the solver holds for every pixel; as in engine/solvers/tv_l2_kernel.h.
enum class TvL2Plane { Cf, C, G, U, Zx, Zy, Rx, Ry, Inverse, B };
inline constexpr int kTvL2Planes = 10;
/// Those that an iteration moves have a second plane, which it writes to.
inline constexpr TvL2Plane kTvL2Moved[] = {TvL2Plane::U, TvL2Plane::Zx, TvL2Plane::Zy,
                                           TvL2Plane::B};
inline constexpr int kTvL2Slots = kTvL2Planes + 4;

/// One level of the grid hierarchy for all views, `[plane][view][row][half][i]`. Rows are split:
/// first the pixels of the even columns, `odd` floats further those of the odd ones, so that the
/// pixels of either color of a checkerboard, and their neighbors, are contiguous. One row of
/// padding above and two below, padding after each half row; it is 0, and stays so because the
/// coefficients there are 0.
struct TvL2Level {
  /// Pixel (0, 0) of the first view in each plane; the last four are the second planes of those
  /// that are moved.
  float* planes[kTvL2Slots] = {};
  long view = 0;  ///< Floats from view to view.
  int height = 0, width = 0;
  long pitch = 0, odd = 0;
  float data_scale = 1;  ///< Factor of c when the level serves as multigrid level.

  /// Pixel (0, 0) of a view.
  [[nodiscard]] __device__ float* of(TvL2Plane which, int v) const {
    return planes[static_cast<int>(which)] + v * view;
  }
  /// The second plane of kTvL2Moved[moved].
  [[nodiscard]] __device__ float* second(int moved, int v) const {
    return planes[kTvL2Planes + moved] + v * view;
  }
  /// The second planes take the place of the first.
  void swap_moved() {
    for (int i = 0; i < kTvL2Slots - kTvL2Planes; ++i) {
      std::swap(planes[static_cast<int>(kTvL2Moved[i])], planes[kTvL2Planes + i]);
    }
  }
  [[nodiscard]] __host__ __device__ long at(int y, int x) const {
    return y * pitch + (x & 1) * odd + (x >> 1);
  }
  /// Pixels of the longer half of a row.
  [[nodiscard]] __host__ __device__ int half() const { return (width + 1) / 2; }
};

/// The pixels of one color of row y, x + y + color even: one half of it. Their neighbors to the
/// left and right are the other half, from `left` and from one float further.
struct ColorRow {
  long own = 0;
  long left = 0;
};

__device__ inline ColorRow color_row(const TvL2Level& level, int y, int color) {
  const long even = y * level.pitch;
  if (((y + color) & 1) == 0) return {even, even + level.odd - 1};
  return {even + level.odd, even};
}

/// What differs from view to view, on the device.
struct TvL2View {
  std::uint8_t is_active = 1;  ///< 0 = done: nothing is changed any more.
  float offset = 0;            ///< Weighted mean of f, taken off for the sake of float.
  float scale = 1, knee = 1;   ///< Of the penalty.
  float coarse_edge = 0.75F;   ///< Factor of the edges of multigrid levels,
  float relaxation = 1.7F;     ///< and ADMM's: the pace.
};

/// The levels of a solver by value, for kernels.
inline constexpr int kMaxTvL2Levels = 16;
struct TvL2Levels {
  TvL2Level level[kMaxTvL2Levels];
  int count = 0;
};

/// The steps of an iteration, each for one place of the half rows of one view; they can run in any
/// order within a step. What they compute is engine/solvers/tv_l2_kernel.cpp, which tells
/// why.

/// Factor that projects z to |p| ≤ g.
__device__ inline float shrinkage(float zx, float zy, float g) {
  return fminf(1.0F, g * rsqrtf(fmaxf(zx * zx + zy * zy, 1e-30F)));
}

/// Gauss-Seidel on a pixel whose neighbors beside are given.
__device__ inline void relax_at(const TvL2Level& level, int view, const ColorRow& row, int i,
                                float b, float left, float right, float up, float down) {
  const float* const rx = level.of(TvL2Plane::Rx, view);
  const float* const ry = level.of(TvL2Plane::Ry, view) + row.own + i;
  const float along = b + rx[row.own + i] * right + rx[row.left + i] * left;
  const float across = ry[0] * down + ry[-level.pitch] * up;
  level.of(TvL2Plane::U, view)[row.own + i] =
      (along + across) * level.of(TvL2Plane::Inverse, view)[row.own + i];
}

/// Relaxes one color.
struct RelaxColor {
  TvL2Level level;
  int color = 0;

  __device__ void operator()(int view, int y, int i) const {
    const ColorRow row = color_row(level, y, color);
    const float* const u = level.of(TvL2Plane::U, view);
    const float* const own = u + row.own + i;
    const float b = level.of(TvL2Plane::B, view)[row.own + i];
    relax_at(level, view, row, i, b, u[row.left + i], u[row.left + i + 1], own[-level.pitch],
             own[level.pitch]);
  }
};

/// Adds the correction of the coarse cells to the pixels of color 0, which are not stored, and
/// relaxes color 1 with them; color 0 is relaxed next, from color 1 alone.
struct CorrectAndRelax {
  TvL2Level level, coarse;

  __device__ void operator()(int view, int y, int i) const {
    const ColorRow row = color_row(level, y, 1);
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

/// Relaxes color 0 from u = 0.
struct RelaxFromZero {
  TvL2Level level;

  __device__ void operator()(int view, int y, int i) const {
    const long own = color_row(level, y, 0).own + i;
    level.of(TvL2Plane::U, view)[own] =
        level.of(TvL2Plane::B, view)[own] * level.of(TvL2Plane::Inverse, view)[own];
  }
};

/// Residual of color 0 in row y.
__device__ inline float residual_at(const TvL2Level& level, int view, int y, int i) {
  const ColorRow row = color_row(level, y, 0);
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

/// The residual of fine cells of 2×2, summed; color 1, relaxed last, has none. Places are those of
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

/// b ← c·f + div(2p − z), and relaxes color 0, which no dual needs any more.
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
    const ColorRow row = color_row(level, y, 0);
    const float* const u = level.of(TvL2Plane::U, view);
    const float* const own = u + row.own + i;
    relax_at(level, view, row, i, row.own < row.left ? b_even : b_odd, u[row.left + i],
             u[row.left + i + 1], own[-level.pitch], own[level.pitch]);
  }
};

/// What happens between iterations, and between levels; as tv_l2_steps.cuh, of
/// engine/solvers/tv_l2_kernel.cpp and tv_l2.cpp.

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
struct Penalize {
  TvL2Level level;
  const TvL2View* views;
  bool first = false;

  __device__ void renew(int view, long at, long right) const {
    const TvL2Gradient gradient = gradient_at(level, view, at, right);
    const float square = gradient.x * gradient.x + gradient.y * gradient.y + 1e-16F;
    const float ratio = views[view].knee * rsqrtf(square);
    const float bent =
        fminf(fmaxf(sqrtf(fmaxf(ratio, 0.0F)), 1 / kTvL2PenaltySpread), kTvL2PenaltySpread);
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

/// Edges of penalty 1, for `Penalize` to give them their value.
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
  /// Cell centers: a pixel lies a quarter of a cell beside the center of its cell.
  template <class Cell>
  __device__ float at_center(int x, const Cell& cell) const {
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
          at_center(x, [&](int cell) { return blend(u, own, beside, 0.25F, cell); });
      const auto face = [&](int cell) { return blend(zx, own, beside, 0.25F, cell); };
      const int cell = x / 2;
      float along = face(cell);
      if ((x & 1) == 0) along = cell == 0 ? 0.5F * along : 0.5F * (along + face(cell - 1));
      fine.of(TvL2Plane::Zx, view)[to] = x + 1 < fine.width ? along : 0.0F;
      // The row above the first one is padding: p = 0 there.
      const int above = lower ? own : own - 1;
      const float down = at_center(x, [&](int each) { return blend(zy, own, above, 0.5F, each); });
      fine.of(TvL2Plane::Zy, view)[to] = y + 1 < fine.height ? down : 0.0F;
      open_edges(fine, view, y, x);
    });
  }
};

}  // namespace episcope::cuda
