// SPDX-License-Identifier: BSD-3-Clause
// Compiled once for each instruction set: see engine/core/parallel/isa.h for what may stand here.
#include "engine/solvers/tv_l2/tv_l2_lanes.h"

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

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

const TvL2PenaltyKernel kTvL2PenaltyKernel = {penalise, coarsen_penalty, invert_diagonal, project,
                                              measure};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
