// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/tv_l2_kernel.h"

#include "engine/core/simd.h"

// Compiled once for each instruction set: see engine/core/isa.h for what may stand here.
// First vectors of pixels in the split rows of TvL2Level, then what an iteration does, then what
// happens between iterations.

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

/// Lanes of a half row, whole vectors.
inline int half_lanes(const TvL2Level& level) {
  return whole_registers((level.width + 1) / 2);
}
/// The same in whole pairs of vectors.
inline int half_pairs(const TvL2Level& level) {
  return ((level.width + 1) / 2 + 2 * kLanes - 1) / (2 * kLanes) * (2 * kLanes);
}

/// {0, 1 …} · stride + first.
inline IntVec ramp(int first, int stride) {
  IntVec lanes;
  for (int i = 0; i < kLanes; ++i) lanes[i] = first + i * stride;
  return lanes;
}

/// The last lane of `before`, then all but the last of `here`.
inline Vec shifted(Vec before, Vec here) {
  return shuffled(before, here, ramp(kLanes - 1, 1));
}

/// One value for each of a vector of even pixels and the odd ones to their right.
struct Halves {
  Vec even, odd;
};

inline Halves load_halves(const TvL2Level& level, const float* plane, long at) {
  return {load(plane + at), load(plane + at + level.odd)};
}
inline void store_halves(const TvL2Level& level, float* plane, long at, Halves values) {
  store(plane + at, values.even);
  store(plane + at + level.odd, values.odd);
}
/// The neighbors to the left.
inline Halves load_left(const TvL2Level& level, const float* plane, long at) {
  return {load(plane + at + level.odd - 1), load(plane + at)};
}

/// Factor that projects z to |p| ≤ g.
inline Vec shrinkage(Vec zx, Vec zy, Vec g) {
  return least(splat(1), g * reciprocal_root(greatest(zx * zx + zy * zy, splat(1e-30F))));
}

inline void clear_row(float* row, long count) {
  for (long i = 0; i < count; ++i) row[i] = 0;
}

// The pixels of one color of a row, x + y + color even: one half of it. Their neighbors to the
// left and right are the other half, from `left` and from one float further.
struct ColorRow {
  long own = 0;
  long left = 0;
};

inline ColorRow color_row(const TvL2Level& level, int y, int color) {
  const long even = y * level.pitch;
  if (((y + color) & 1) == 0) return {even, even + level.odd - 1};
  return {even + level.odd, even};
}

// Rows ahead that memory is asked for, in every stage what it reads first: so memory works all the
// time, and not only while one stage waits for it.
constexpr int kAhead = 2;
constexpr long kTwoRowsAhead = 2 * kAhead;

inline void prefetch(const float* from) {
  __builtin_prefetch(from, 0, 2);
}
inline void prefetch_halves(const TvL2Level& level, const float* plane, long at) {
  prefetch(plane + at);
  prefetch(plane + at + level.odd);
}

// Gauss-Seidel on the pixels of one color of row y.
template <bool kFirst>
void relax_row(const TvL2Level& level, int y, int color) {
  if (y < 0 || y >= level.height) return;
  const auto [own, left] = color_row(level, y, color);
  const long pitch = level.pitch;
  float* const u = level.u + own;
  const float* const beside = level.u + left;
  const float* const rx = level.rx + own;
  const float* const rx_left = level.rx + left;
  const float* const ry = level.ry + own;
  const float* const b = level.b + own;
  const float* const inverse = level.inverse + own;
  const int end = half_lanes(level);
  for (int x = 0; x < end; x += kLanes) {
    if constexpr (kFirst) {
      prefetch(b + x + kAhead * pitch);
      prefetch(inverse + x + kAhead * pitch);
      prefetch(rx + x + kAhead * pitch);
      prefetch(ry + x + kAhead * pitch);
    }
    const Vec along =
        load(b + x) + load(rx + x) * load(beside + x + 1) + load(rx_left + x) * load(beside + x);
    const Vec across =
        load(ry + x) * load(u + x + pitch) + load(ry + x - pitch) * load(u + x - pitch);
    store(u + x, (along + across) * load(inverse + x));
  }
}

// The same from u = 0.
void relax_row_from_zero(const TvL2Level& level, int y, int color) {
  if (y < 0 || y >= level.height) return;
  const long own = color_row(level, y, color).own;
  const int end = half_lanes(level);
  for (int x = 0; x < end; x += kLanes) {
    store(level.u + own + x, load(level.b + own + x) * load(level.inverse + own + x));
  }
}

// Residual of color 0 in row y, in the columns of a vector.
inline Vec residual_at(const TvL2Level& level, const ColorRow& row, int x) {
  const long i = row.own + x;
  const float* const u = level.u + i;
  const float* const beside = level.u + row.left + x;
  const long pitch = level.pitch;
  const Vec here = load(u);
  return load(level.b + i) - level.data_scale * load(level.c + i) * here +
         load(level.rx + i) * (load(beside + 1) - here) +
         load(level.rx + row.left + x) * (load(beside) - here) +
         load(level.ry + i) * (load(u + pitch) - here) +
         load(level.ry + i - pitch) * (load(u - pitch) - here);
}

// Residual of fine rows 2y and 2y + 1 summed over cells of 2×2. Color 1, relaxed last, has none.
void restrict_row(const TvL2Level& fine, const TvL2Level& coarse, int y) {
  if (y < 0 || y >= coarse.height) return;
  const int end = half_pairs(fine);
  const bool both = 2 * y + 1 < fine.height;
  const ColorRow upper = color_row(fine, 2 * y, 0), lower = color_row(fine, 2 * y + 1, 0);
  float* const b = coarse.b + y * coarse.pitch;
  for (int x = 0; x < end; x += 2 * kLanes) {
    for (int i = 0; i < 2 * kLanes; i += kLanes) {
      prefetch(fine.c + upper.own + x + i + kTwoRowsAhead * fine.pitch);
      prefetch(fine.c + lower.own + x + i + kTwoRowsAhead * fine.pitch);
    }
    Vec low = residual_at(fine, upper, x);
    Vec high = residual_at(fine, upper, x + kLanes);
    if (both) {
      low += residual_at(fine, lower, x);
      high += residual_at(fine, lower, x + kLanes);
    }
    store(b + x / 2, shuffled(low, high, ramp(0, 2)));
    store(b + x / 2 + coarse.odd, shuffled(low, high, ramp(1, 2)));
  }
}

// Lanes of two vectors by turns, from their lane `first`.
inline IntVec interleaved(int first) {
  IntVec lanes;
  for (int i = 0; i < kLanes; ++i) lanes[i] = first + i / 2 + (i & 1) * kLanes;
  return lanes;
}

// u += correction of the coarse cell, for color 0: color 1 is relaxed next, from color 0 alone.
void correct_row(const TvL2Level& fine, const TvL2Level& coarse, int y) {
  if (y < 0 || y >= fine.height) return;
  const int end = half_pairs(fine);
  const float* const correction = coarse.u + (y / 2) * coarse.pitch;
  float* const u = fine.u + color_row(fine, y, 0).own;
  for (int x = 0; x < end; x += 2 * kLanes) {
    for (int i = 0; i < 2 * kLanes; i += kLanes) {
      prefetch(u + x + i + kAhead * fine.pitch);
      prefetch(u + x + i + (kAhead + 1) * fine.pitch);
    }
    const Halves cells = load_halves(coarse, correction, x / 2);
    store(u + x, load(u + x) + shuffled(cells.even, cells.odd, interleaved(0)));
    store(u + x + kLanes,
          load(u + x + kLanes) + shuffled(cells.even, cells.odd, interleaved(kLanes / 2)));
  }
}

// A vector of pixels of one half of a row, and u around them.
struct Around {
  long at = 0;
  Vec here, left, right, down;
  Vec rx, rx_left, ry;
};

// 2p − z.
struct Reflected {
  Vec x, y;
};

// Factors of 1 − |p|/|z|: of z as stored, if it is yet to be relaxed, and as it is to be stored.
struct Relaxation {
  Vec gradient, before, after;
};

// z ← p + relaxed step along the gradient.
template <bool kResumes>
inline Reflected move_dual(const TvL2Level& level, const Around& pixels,
                           const Relaxation& factors) {
  const long i = pixels.at;
  const Vec g = load(level.g + i);
  Vec zx = load(level.zx + i), zy = load(level.zy + i);
  if constexpr (!kResumes) {
    const Vec stay = 1.0F - factors.before * (1.0F - shrinkage(zx, zy, g));
    zx *= stay;
    zy *= stay;
  }
  zx += factors.gradient * pixels.rx * (pixels.right - pixels.here);
  zy += factors.gradient * pixels.ry * (pixels.down - pixels.here);
  const Vec keep = shrinkage(zx, zy, g);
  const Vec stay = 1.0F - factors.after * (1.0F - keep);
  store(level.zx + i, zx * stay);
  store(level.zy + i, zy * stay);
  const Vec mirror = 2.0F * keep - 1.0F;
  return {zx * mirror, zy * mirror};
}

inline void relax(const TvL2Level& level, const Around& pixels, Vec b) {
  const long i = pixels.at;
  const Vec along = b + pixels.rx * pixels.right + pixels.rx_left * pixels.left;
  const Vec across =
      pixels.ry * pixels.down + load(level.ry + i - level.pitch) * load(level.u + i - level.pitch);
  store(level.u + i, (along + across) * load(level.inverse + i));
}

// Moves the dual of row y, then b ← c·f + div(2p − z) and relaxes color 0, which no dual needs any
// more. `row` holds the vertical part of the row above, and then of this one.
template <bool kResumes, bool kRelaxesEven>
void dual_row_as(const TvL2Level& level, int y, const Relaxation& factors, float* row) {
  const int end = half_lanes(level);
  Vec q_left = splat(0), u_left = splat(0), rx_left = splat(0);  // of the odd pixels before
  for (int x = 0; x < end; x += kLanes) {
    const long at = y * level.pitch + x;
    prefetch_halves(level, level.zx, at + kAhead * level.pitch);
    prefetch_halves(level, level.zy, at + kAhead * level.pitch);
    prefetch_halves(level, level.g, at + kAhead * level.pitch);
    prefetch_halves(level, level.cf, at + kAhead * level.pitch);
    const Halves u = load_halves(level, level.u, at);
    const Halves down = load_halves(level, level.u, at + level.pitch);
    const Halves rx = load_halves(level, level.rx, at), ry = load_halves(level, level.ry, at);
    const Around even{at,        u.even,  shifted(u_left, u.odd),   u.odd,
                      down.even, rx.even, shifted(rx_left, rx.odd), ry.even};
    const Around odd{at + level.odd, u.odd,  u.even,  load(level.u + at + 1),
                     down.odd,       rx.odd, rx.even, ry.odd};
    const Reflected q_even = move_dual<kResumes>(level, even, factors);
    const Reflected q_odd = move_dual<kResumes>(level, odd, factors);
    const Halves above = load_halves(level, row, x);
    store_halves(level, row, x, {q_even.y, q_odd.y});
    const Halves cf = load_halves(level, level.cf, at);
    const Halves b{cf.even + (q_even.x - shifted(q_left, q_odd.x)) + (q_even.y - above.even),
                   cf.odd + (q_odd.x - q_even.x) + (q_odd.y - above.odd)};
    store_halves(level, level.b, at, b);
    kRelaxesEven ? relax(level, even, b.even) : relax(level, odd, b.odd);
    q_left = q_odd.x;
    u_left = u.odd;
    rx_left = rx.odd;
  }
}

void dual_row(const TvL2Level& level, int y, const TvL2Step& step) {
  if (y < 0 || y >= level.height) return;
  const Vec relaxation = splat(step.relaxation);
  const Relaxation factors{relaxation, relaxation, step.pauses ? splat(0) : relaxation};
  const auto run = (y & 1) == 0
                       ? (step.resumes ? dual_row_as<true, true> : dual_row_as<false, true>)
                       : (step.resumes ? dual_row_as<true, false> : dual_row_as<false, false>);
  run(level, y, factors, step.row);
}

void iterate(const TvL2Level& level, const TvL2Level& coarse, const TvL2Step& step) {
  clear_row(step.row, level.pitch);
  // Each stage follows the one before it at the least distance its stencil allows.
  for (int t = 0; t < level.height + 7; ++t) {
    if (!step.first) {
      correct_row(level, coarse, t);
      relax_row<true>(level, t - 1, 1);
      relax_row<true>(level, t - 2, 0);
    }
    dual_row(level, t - 3, step);
    relax_row<false>(level, t - 4, 1);
    if (((t - 6) & 1) == 0) restrict_row(level, coarse, (t - 6) >> 1);
  }
}

void descend(const TvL2Level& level, const TvL2Level& coarse) {
  for (int t = 0; t < level.height + 5; ++t) {
    relax_row_from_zero(level, t, 0);
    relax_row<true>(level, t - 1, 1);
    if (((t - 3) & 1) == 0) restrict_row(level, coarse, (t - 3) >> 1);
  }
}

void ascend(const TvL2Level& level, const TvL2Level& coarse) {
  for (int t = 0; t < level.height + 2; ++t) {
    correct_row(level, coarse, t);
    relax_row<true>(level, t - 1, 1);
    relax_row<true>(level, t - 2, 0);
  }
}

void solve(const TvL2Level& level) {
  constexpr int kSweeps = 8;
  for (int y = 0; y < level.height; ++y) relax_row_from_zero(level, y, 0);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (int y = 0; y < level.height; ++y) relax_row<false>(level, y, 1);
    for (int y = 0; y < level.height; ++y) relax_row<false>(level, y, 0);
  }
}

// Calls visit(offset, vector of u there, and to the right) for every vector of row y.
template <class Visit>
inline void for_each_vector(const TvL2Level& level, int y, const Visit& visit) {
  const int end = half_lanes(level);
  for (int x = 0; x < end; x += kLanes) {
    const long even = y * level.pitch + x;
    const Halves here = load_halves(level, level.u, even);
    visit(even, here.even, here.odd);
    visit(even + level.odd, here.odd, load(level.u + even + 1));
  }
}

// The gradient of u where there are edges, else 0.
struct Gradient {
  Vec x, y;
};

inline Gradient gradient_at(const TvL2Level& level, long i, Vec here, Vec right) {
  const Vec down = load(level.u + i + level.pitch);
  return {choose(load(level.rx + i) > 0.0F, right - here, splat(0)),
          choose(load(level.ry + i) > 0.0F, down - here, splat(0))};
}

inline Vec root_of_positive(Vec value) {
  return value * reciprocal_root(greatest(value, splat(1e-30F)));
}

inline void penalise_at(const TvL2Level& level, const TvL2Penalty& penalty, long i,
                        const Gradient& gradient) {
  const Vec rx = load(level.rx + i), ry = load(level.ry + i);
  const Vec ratio =
      penalty.knee * reciprocal_root(gradient.x * gradient.x + gradient.y * gradient.y + 1e-16F);
  const Vec g = load(level.g + i);
  const Vec bent =
      least(greatest(root_of_positive(ratio), splat(1 / penalty.spread)), splat(penalty.spread));
  const Vec next = penalty.scale * g * bent;
  const Vec zx = load(level.zx + i), zy = load(level.zy + i);
  if (penalty.first) {  // z holds p, d = ∇u
    store(level.zx + i, zx + next * gradient.x);
    store(level.zy + i, zy + next * gradient.y);
  } else {
    const Vec keep = shrinkage(zx, zy, g);
    const Vec any_edge = greatest(rx, ry);
    const Vec before = choose(any_edge > 0.0F, any_edge, splat(1));
    const Vec stretch = keep + (1.0F - keep) * next * reciprocal(before);
    store(level.zx + i, zx * stretch);
    store(level.zy + i, zy * stretch);
  }
  store(level.rx + i, choose(rx > 0.0F, next, splat(0)));
  store(level.ry + i, choose(ry > 0.0F, next, splat(0)));
}

void penalise(const TvL2Level& level, const TvL2Penalty& penalty) {
  for (int y = 0; y < level.height; ++y) {
    for_each_vector(level, y, [&](long i, Vec here, Vec right) {
      penalise_at(level, penalty, i, gradient_at(level, i, here, right));
    });
  }
}

// Cells of one coarse row, as they follow one another, to its halves.
inline void store_cells(const TvL2Level& coarse, float* plane, long at, Vec low, Vec high) {
  store(plane + at, shuffled(low, high, ramp(0, 2)));
  store(plane + at + coarse.odd, shuffled(low, high, ramp(1, 2)));
}

void coarsen_penalty(const TvL2Level& fine, const TvL2Level& coarse, float edge_factor) {
  const int end = half_pairs(fine);
  for (int y = 0; y < coarse.height; ++y) {
    // The padding right and below holds zeros.
    const float* const rx = fine.rx + 2L * y * fine.pitch + fine.odd;
    const float* const ry = fine.ry + (2L * y + 1) * fine.pitch;
    const auto across = [&](int x) {
      return edge_factor * (load(rx + x) + load(rx + fine.pitch + x));
    };
    const auto down = [&](int x) { return edge_factor * (load(ry + x) + load(ry + fine.odd + x)); };
    for (int x = 0; x < end; x += 2 * kLanes) {
      const long to = y * coarse.pitch + x / 2;
      store_cells(coarse, coarse.rx, to, across(x), across(x + kLanes));
      store_cells(coarse, coarse.ry, to, down(x), down(x + kLanes));
    }
  }
}

// 1/diagonal; 0 in the padding, whose diagonal need not be.
void invert_diagonal(const TvL2Level& level) {
  const int end = half_lanes(level);
  for (int y = 0; y < level.height; ++y) {
    for (int x = 0; x < end; x += kLanes) {
      const long at = y * level.pitch + x;
      const Halves left = load_left(level, level.rx, at);
      const auto invert = [&](long i, Vec beside) {
        const Vec c = load(level.c + i);
        const Vec diagonal = level.data_scale * c + load(level.rx + i) + beside +
                             load(level.ry + i) + load(level.ry + i - level.pitch);
        store(level.inverse + i,
              choose(c > 0.0F, reciprocal(choose(c > 0.0F, diagonal, splat(1))), splat(0)));
      };
      invert(at, left.even);
      invert(at + level.odd, left.odd);
    }
  }
}

void project(const TvL2Level& level) {
  for (int y = 0; y < level.height; ++y) {
    for_each_vector(level, y, [&](long i, Vec, Vec) {
      const Vec zx = load(level.zx + i), zy = load(level.zy + i);
      const Vec keep = shrinkage(zx, zy, load(level.g + i));
      store(level.zx + i, zx * keep);
      store(level.zy + i, zy * keep);
    });
  }
}

inline double total(Vec lanes) {
  double sum = 0;
  for (int i = 0; i < kLanes; ++i) sum += static_cast<double>(lanes[i]);
  return sum;
}

// What a pixel adds to P(u) and to −D(p), given the divergence there: with the observation f,
// g|∇u| + ½c(u − f)² and f·div p + ½(div p)²/c.
struct PixelSums {
  Vec energy, dual;
};

inline PixelSums sums_at(const TvL2Level& level, long i, Vec here, Vec right, Vec divergence) {
  const Gradient gradient = gradient_at(level, i, here, right);
  const Vec variation = root_of_positive(gradient.x * gradient.x + gradient.y * gradient.y);
  const Vec c = load(level.c + i), cf = load(level.cf + i);
  const Vec inverse = reciprocal(choose(c > 0.0F, c, splat(1)));
  const Vec off = here - cf * inverse;
  return {load(level.g + i) * variation + 0.5F * c * off * off,
          divergence * (cf + 0.5F * divergence) * inverse};
}

struct RowSums {
  Vec energy{}, dual{};
};

// `row` holds the vertical part of p in the row above, and then of this one.
RowSums measure_row(const TvL2Level& level, int y, float* row) {
  RowSums sums;
  const int end = half_lanes(level);
  Vec left = splat(0);  // horizontal part of the odd pixels before
  for (int x = 0; x < end; x += kLanes) {
    const long even = y * level.pitch + x, odd = even + level.odd;
    const Halves here = load_halves(level, level.u, even);
    Halves zx = load_halves(level, level.zx, even), zy = load_halves(level, level.zy, even);
    const Halves g = load_halves(level, level.g, even);
    const Halves keep = {shrinkage(zx.even, zy.even, g.even), shrinkage(zx.odd, zy.odd, g.odd)};
    const Halves px = {zx.even * keep.even, zx.odd * keep.odd};
    const Halves py = {zy.even * keep.even, zy.odd * keep.odd};
    const Halves above = load_halves(level, row, x);
    store_halves(level, row, x, py);
    const PixelSums of_even = sums_at(level, even, here.even, here.odd,
                                      px.even - shifted(left, px.odd) + py.even - above.even);
    const PixelSums of_odd = sums_at(level, odd, here.odd, load(level.u + even + 1),
                                     px.odd - px.even + py.odd - above.odd);
    sums.energy += of_even.energy + of_odd.energy;
    sums.dual -= of_even.dual + of_odd.dual;
    left = px.odd;
  }
  return sums;
}

TvL2Sums measure(const TvL2Level& level, float* row) {
  clear_row(row, level.pitch);
  TvL2Sums sums;
  for (int y = 0; y < level.height; ++y) {
    const RowSums of_row = measure_row(level, y, row);
    sums.energy += total(of_row.energy);
    sums.dual += total(of_row.dual);
  }
  return sums;
}

}  // namespace

const TvL2Kernel kTvL2Kernel = {iterate, descend, ascend, solve};

const TvL2PenaltyKernel kTvL2PenaltyKernel = {penalise, coarsen_penalty, invert_diagonal, project,
                                              measure};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
