// SPDX-License-Identifier: BSD-3-Clause
// Compiled once for each instruction set: see engine/core/parallel/isa.h for what may stand here.
#include "engine/solvers/tv_l2/tv_l2_kernel.h"

#include "engine/core/parallel/simd.h"

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

inline int padded_pairs(const TvL2Level& level) {
  return (level.width + 2 * kLanes - 1) / (2 * kLanes) * (2 * kLanes);
}

// Lanes of one colour of the chequerboard in row y.
inline IntVec colour_mask(int y, int colour) {
  IntVec mask;
  for (int i = 0; i < kLanes; ++i) mask[i] = ((i + y + colour) & 1) ? 0 : -1;
  return mask;
}

// Gauss-Seidel on the pixels of one colour of row y.
void relax_row(const TvL2Level& level, int y, int colour) {
  if (y < 0 || y >= level.height) return;
  const long at = y * level.pitch;
  const long pitch = level.pitch;
  float* const u = level.u + at;
  const float* const rx = level.rx + at;
  const float* const ry = level.ry + at;
  const float* const b = level.b + at;
  const float* const inverse = level.inverse + at;
  const IntVec mask = colour_mask(y, colour);
  const int end = whole_registers(level.width);
  Vec left = load(u - 1);
  for (int x = 0; x < end; x += kLanes) {
    const Vec here = load(u + x);
    const Vec sum = load(b + x) + load(rx + x) * load(u + x + 1) + load(rx + x - 1) * left +
                    load(ry + x) * load(u + x + pitch) + load(ry + x - pitch) * load(u + x - pitch);
    left = load(u + x + kLanes - 1);  // of the other colour where it counts: not yet overtaken
    store(u + x, choose(mask, sum * load(inverse + x), here));
  }
}

// The same from u = 0.
void relax_row_from_zero(const TvL2Level& level, int y, int colour) {
  if (y < 0 || y >= level.height) return;
  const long at = y * level.pitch;
  const IntVec mask = colour_mask(y, colour);
  const int end = whole_registers(level.width);
  for (int x = 0; x < end; x += kLanes) {
    store(level.u + at + x,
          choose(mask, load(level.b + at + x) * load(level.inverse + at + x), splat(0)));
  }
}

inline Vec residual_at(const TvL2Level& level, long i) {
  const float* const u = level.u + i;
  const long pitch = level.pitch;
  const Vec here = load(u);
  return load(level.b + i) - level.data_scale * load(level.c + i) * here +
         load(level.rx + i) * (load(u + 1) - here) + load(level.rx + i - 1) * (load(u - 1) - here) +
         load(level.ry + i) * (load(u + pitch) - here) +
         load(level.ry + i - pitch) * (load(u - pitch) - here);
}

inline Vec sums_of_pairs(Vec low, Vec high) {
  IntVec even, odd;
  for (int i = 0; i < kLanes; ++i) even[i] = 2 * i;
  for (int i = 0; i < kLanes; ++i) odd[i] = 2 * i + 1;
  return __builtin_shuffle(low, high, even) + __builtin_shuffle(low, high, odd);
}

// Residual of fine rows 2y and 2y + 1 summed over cells of 2×2.
void restrict_row(const TvL2Level& fine, const TvL2Level& coarse, int y) {
  if (y < 0 || y >= coarse.height) return;
  const int end = padded_pairs(fine);
  const bool both = 2 * y + 1 < fine.height;
  for (int x = 0; x < end; x += 2 * kLanes) {
    const long i = 2L * y * fine.pitch + x;
    Vec low = residual_at(fine, i);
    Vec high = residual_at(fine, i + kLanes);
    if (both) {
      low += residual_at(fine, i + fine.pitch);
      high += residual_at(fine, i + fine.pitch + kLanes);
    }
    store(coarse.b + y * coarse.pitch + x / 2, sums_of_pairs(low, high));
  }
}

// u += correction of the coarse cell.
void correct_row(const TvL2Level& fine, const TvL2Level& coarse, int y) {
  if (y < 0 || y >= fine.height) return;
  IntVec low, high;
  for (int i = 0; i < kLanes; ++i) low[i] = i / 2;
  for (int i = 0; i < kLanes; ++i) high[i] = (i + kLanes) / 2;
  const int end = padded_pairs(fine);
  const float* const correction = coarse.u + (y / 2) * coarse.pitch;
  float* const u = fine.u + y * fine.pitch;
  for (int x = 0; x < end; x += 2 * kLanes) {
    const Vec cell = load(correction + x / 2);
    store(u + x, load(u + x) + __builtin_shuffle(cell, low));
    store(u + x + kLanes, load(u + x + kLanes) + __builtin_shuffle(cell, high));
  }
}

// Factor that projects z to |p| ≤ g.
inline Vec shrinkage(Vec zx, Vec zy, Vec g) {
  return least(splat(1), g * reciprocal_root(greatest(zx * zx + zy * zy, splat(1e-30F))));
}

// z ← p + relaxed step along the gradient, then b ← c·f + div(2p − z).
void dual_row(const TvL2Level& level, int y, const TvL2Step& step) {
  if (y < 0 || y >= level.height) return;
  const long at = y * level.pitch;
  float* const qx = step.rows + kTvL2Margin;
  float* const qy = qx + level.pitch * (1 + (y & 1));
  const float* const above = qx + level.pitch * (2 - (y & 1));
  const Vec ahead = splat(step.relaxation);
  const Vec back = splat(1 - step.relaxation);
  const int end = whole_registers(level.width);
  for (int x = 0; x < end; x += kLanes) {
    const long i = at + x;
    const Vec g = load(level.g + i);
    const Vec here = load(level.u + i);
    const Vec zx = load(level.zx + i), zy = load(level.zy + i);
    const Vec keep = shrinkage(zx, zy, g);
    const Vec stay = keep + back * (1.0F - keep);  // p + (1 − relaxation)(z − p), over z
    const Vec nx = zx * stay + ahead * load(level.rx + i) * (load(level.u + i + 1) - here);
    const Vec ny =
        zy * stay + ahead * load(level.ry + i) * (load(level.u + i + level.pitch) - here);
    store(level.zx + i, nx);
    store(level.zy + i, ny);
    const Vec mirror = 2.0F * shrinkage(nx, ny, g) - 1.0F;
    store(qx + x, nx * mirror);
    store(qy + x, ny * mirror);
  }
  for (int x = 0; x < end; x += kLanes) {
    const long i = at + x;
    const Vec divergence = load(qx + x) - load(qx + x - 1) + load(qy + x) - load(above + x);
    store(level.b + i, load(level.c + i) * load(level.f + i) + divergence);
  }
}

void clear_rows(float* rows, long count) {
  for (long i = 0; i < count; ++i) rows[i] = 0;
}

void iterate(const TvL2Level& level, const TvL2Level& coarse, const TvL2Step& step) {
  clear_rows(step.rows, 3 * level.pitch);
  // Each stage follows the one before it at the least distance its stencil allows.
  for (int t = 0; t < level.height + 7; ++t) {
    if (!step.first) {
      correct_row(level, coarse, t);
      relax_row(level, t - 1, 1);
      relax_row(level, t - 2, 0);
    }
    dual_row(level, t - 3, step);
    relax_row(level, t - 3, 0);
    relax_row(level, t - 4, 1);
    if (((t - 6) & 1) == 0) restrict_row(level, coarse, (t - 6) >> 1);
  }
}

void descend(const TvL2Level& level, const TvL2Level& coarse) {
  for (int t = 0; t < level.height + 5; ++t) {
    relax_row_from_zero(level, t, 0);
    relax_row(level, t - 1, 1);
    if (((t - 3) & 1) == 0) restrict_row(level, coarse, (t - 3) >> 1);
  }
}

void ascend(const TvL2Level& level, const TvL2Level& coarse) {
  for (int t = 0; t < level.height + 2; ++t) {
    correct_row(level, coarse, t);
    relax_row(level, t - 1, 1);
    relax_row(level, t - 2, 0);
  }
}

void solve(const TvL2Level& level) {
  constexpr int kSweeps = 8;
  for (int y = 0; y < level.height; ++y) relax_row_from_zero(level, y, 0);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (int y = 0; y < level.height; ++y) relax_row(level, y, 1);
    for (int y = 0; y < level.height; ++y) relax_row(level, y, 0);
  }
}

void penalise(const TvL2Level& level, const TvL2Penalty& penalty) {
  const Vec low = splat(1 / penalty.spread), high = splat(penalty.spread);
  const int end = whole_registers(level.width);
  for (int y = 0; y < level.height; ++y) {
    for (int x = 0; x < end; x += kLanes) {
      const long i = y * level.pitch + x;
      const Vec rx = load(level.rx + i), ry = load(level.ry + i);
      const Vec here = load(level.u + i);
      const Vec zero = splat(0);
      const Vec gx = choose(rx > 0.0F, load(level.u + i + 1) - here, zero);
      const Vec gy = choose(ry > 0.0F, load(level.u + i + level.pitch) - here, zero);
      const Vec ratio = penalty.knee * reciprocal_root(gx * gx + gy * gy + 1e-16F);
      const Vec g = load(level.g + i);
      const Vec next = penalty.scale * g * least(greatest(square_root(ratio), low), high);
      const Vec zx = load(level.zx + i), zy = load(level.zy + i);
      if (penalty.first) {  // z holds p, d = ∇u
        store(level.zx + i, zx + next * gx);
        store(level.zy + i, zy + next * gy);
      } else {
        const Vec keep = shrinkage(zx, zy, g);
        const Vec any = greatest(rx, ry);
        const Vec stretch = keep + (1.0F - keep) * next / choose(any > 0.0F, any, splat(1));
        store(level.zx + i, zx * stretch);
        store(level.zy + i, zy * stretch);
      }
      store(level.rx + i, choose(rx > 0.0F, next, zero));
      store(level.ry + i, choose(ry > 0.0F, next, zero));
    }
  }
}

void project(const TvL2Level& level) {
  const int end = whole_registers(level.width);
  for (int y = 0; y < level.height; ++y) {
    for (int x = 0; x < end; x += kLanes) {
      const long i = y * level.pitch + x;
      const Vec zx = load(level.zx + i), zy = load(level.zy + i);
      const Vec keep = shrinkage(zx, zy, load(level.g + i));
      store(level.zx + i, zx * keep);
      store(level.zy + i, zy * keep);
    }
  }
}

inline double total(Vec lanes) {
  double sum = 0;
  for (int i = 0; i < kLanes; ++i) sum += static_cast<double>(lanes[i]);
  return sum;
}

TvL2Sums measure(const TvL2Level& level, float* rows) {
  clear_rows(rows, 3 * level.pitch);
  TvL2Sums sums;
  const int end = whole_registers(level.width);
  for (int y = 0; y < level.height; ++y) {
    float* const px = rows + kTvL2Margin;
    float* const py = px + level.pitch * (1 + (y & 1));
    const float* const above = px + level.pitch * (2 - (y & 1));
    Vec energy{}, dual{};
    for (int x = 0; x < end; x += kLanes) {
      const long i = y * level.pitch + x;
      const Vec zx = load(level.zx + i), zy = load(level.zy + i), g = load(level.g + i);
      const Vec keep = shrinkage(zx, zy, g);
      store(px + x, zx * keep);
      store(py + x, zy * keep);
      const Vec here = load(level.u + i);
      const Vec gx = choose(load(level.rx + i) > 0.0F, load(level.u + i + 1) - here, splat(0));
      const Vec gy =
          choose(load(level.ry + i) > 0.0F, load(level.u + i + level.pitch) - here, splat(0));
      const Vec off = here - load(level.f + i);
      energy += g * square_root(gx * gx + gy * gy) + 0.5F * load(level.c + i) * off * off;
    }
    for (int x = 0; x < end; x += kLanes) {
      const long i = y * level.pitch + x;
      const Vec c = load(level.c + i);
      const Vec divergence = load(px + x) - load(px + x - 1) + load(py + x) - load(above + x);
      dual -= divergence * (load(level.f + i) + 0.5F * divergence / choose(c > 0.0F, c, splat(1)));
    }
    sums.energy += total(energy);
    sums.dual += total(dual);
  }
  return sums;
}

}  // namespace

const TvL2Kernel kTvL2Kernel = {iterate, descend, ascend, solve, penalise, project, measure};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
