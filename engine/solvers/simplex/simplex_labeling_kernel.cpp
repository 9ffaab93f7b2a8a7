// SPDX-License-Identifier: BSD-3-Clause
// Compiled once for each instruction set: see engine/core/parallel/isa.h for what may stand here.
#include "engine/solvers/simplex/simplex_labeling_kernel.h"

#include "engine/solvers/simplex/pair_duals_simd.h"

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

// θ such that Σ_l max(v_l − θ, 0) = 1, of the columns at `v`. Newton's method from below: the sum
// falls and is convex in θ, so every step stays below the solution and the last is exact (the steps
// of Michelot 1986). max v − 1 ≤ θ is the solution already where one label has it all. Layers that
// are not above θ in any column never will be: from the second pass on they are out of the race.
inline Vec threshold(const LayeredShape& shape, const LayerList& moving, const float* v, Vec top) {
  const float* racing[kMaxSimplexLayers];
  for (int k = 0; k < moving.count; ++k) racing[k] = v + moving.layers[k] * shape.pitch;
  Vec theta = top - 1.0F;
  int left = moving.count;
  for (int pass = 0; pass < moving.count; ++pass) {
    Vec sum = splat(-1), above = splat(0);
    int count = 0;
    for (int i = 0; i < left; ++i) {
      const Vec over = load(racing[i]) - theta;
      const IntVec is_above = over > 0.0F;
      sum += greatest(over, splat(0));
      above += choose(is_above, splat(1), splat(0));
      racing[count] = racing[i];
      count += any(is_above) ? 1 : 0;
    }
    left = count;
    // Rounding may leave nothing above θ where the largest is.
    const Vec step = sum / greatest(above, splat(1));
    theta += greatest(step, splat(0));
    if (!any(sum > 1e-6F)) break;
  }
  return theta;
}

void move_primal(const LayeredShape& shape, const float* cost, const PairDuals& here,
                 const PairDuals& above, float* u, float* ahead) {
  float largest[kColumns];
  const Vec step = splat(shape.primal_step), relaxation = splat(shape.relaxation);
  for (int begin = 0; begin < shape.width; begin += kColumns) {
    const int end = end_of(shape, begin);
    const LayerBlock block = block_of(shape, here, begin);
    const LayerList& moving = block.moving;
    for (int x = begin; x < end; x += kLanes) store(largest + x - begin, splat(-1e30F));
    for (int k = 0; k < moving.count; ++k) {
      const int l = moving.layers[k];
      const float* const costs = cost + static_cast<long>(l) * shape.width;
      for (int x = begin; x < end; x += kLanes) {
        const long i = l * shape.pitch + x;
        const Vec down = divergence(here, above, i) - load_first(costs + x, shape.width - x);
        const Vec value = load(u + i) + step * down;
        store(ahead + i, value);
        store(largest + x - begin, greatest(value, load(largest + x - begin)));
      }
    }
    for (int x = begin; x < end; x += kLanes) {
      const Vec theta = threshold(shape, moving, ahead + x, load(largest + x - begin));
      for (int k = 0; k < moving.count; ++k) {
        const long i = moving.layers[k] * shape.pitch + x;
        const Vec projected = greatest(load(ahead + i) - theta, splat(0));
        const Vec old = load(u + i);
        store(ahead + i, 2.0F * projected - old);
        store(u + i, old + relaxation * (projected - old));
      }
    }
    for (int k = 0; k < block.still.count; ++k) {
      float* const row = ahead + block.still.layers[k] * shape.pitch;
      for (int x = begin; x < end; x += kLanes) store(row + x, splat(0));
    }
  }
}

void project(const LayeredShape& shape, const float* from, float* to) {
  const int end = whole_registers(shape.width);
  const LayerList all = all_layers(shape);
  for (int x = 0; x < end; x += kLanes) {
    Vec top = load(from + x);
    for (int l = 1; l < shape.steps; ++l) top = greatest(top, load(from + l * shape.pitch + x));
    const Vec theta = threshold(shape, all, from + x, top);
    for (int l = 0; l < shape.steps; ++l) {
      const long i = l * shape.pitch + x;
      store(to + i, greatest(load(from + i) - theta, splat(0)));
    }
  }
}

double bound(const LayeredShape& shape, const float* cost, const PairDuals& here,
             const PairDuals& above) {
  double total = 0;
  float cheapest[kColumns];
  for (int begin = 0; begin < shape.width; begin += kColumns) {
    const int end = end_of(shape, begin);
    for (int l = 0; l < shape.steps; ++l) {
      const float* const costs = cost + static_cast<long>(l) * shape.width;
      for (int x = begin; x < end; x += kLanes) {
        const Vec value = load_first(costs + x, shape.width - x) -
                          limited_divergence(here, above, l * shape.pitch + x, x);
        float* const at = cheapest + x - begin;
        store(at, l == 0 ? value : least(load(at), value));
      }
    }
    for (int x = begin; x < end && x < shape.width; ++x) {
      total += static_cast<double>(cheapest[x - begin]);
    }
  }
  return total;
}

double energy(const LayeredShape& shape, const float* cost, const PairDuals& here, const float* u,
              const float* u_below) {
  double total = 0;
  const int end = whole_registers(shape.width);
  for (int l = 0; l < shape.steps; ++l) {
    Vec sum{};
    for (int x = 0; x < end; x += kLanes) {
      const long i = l * shape.pitch + x;
      const Vec at = load(u + i), right = load(u + i + 1);
      const Vec down = load(u_below + i), across = load(u_below + i + 1);
      sum += load_first(cost + static_cast<long>(l) * shape.width + x, shape.width - x) * at +
             load(here.limit[0] + x) * absolute(right - at) +
             load(here.limit[1] + x) * absolute(down - at) +
             load(here.limit[2] + x) * absolute(across - at) +
             load(here.limit[3] + x) * absolute(down - right);
    }
    for (int i = 0; i < kLanes; ++i) total += static_cast<double>(sum[i]);
  }
  return total;
}

void cut(const LayeredShape& shape, const float* u, int* labels) {
  float best[kColumns], layer[kColumns];
  for (int begin = 0; begin < shape.width; begin += kColumns) {
    const int end = end_of(shape, begin);
    for (int x = begin; x < end; x += kLanes) {
      store(best + x - begin, load(u + x));
      store(layer + x - begin, splat(0));
    }
    for (int l = 1; l < shape.steps; ++l) {
      for (int x = begin; x < end; x += kLanes) {
        float* const at = best + x - begin;
        const Vec value = load(u + l * shape.pitch + x);
        const IntVec more = value > load(at);
        store(at, choose(more, value, load(at)));
        store(layer + x - begin,
              choose(more, splat(static_cast<float>(l)), load(layer + x - begin)));
      }
    }
    for (int x = begin; x < end && x < shape.width; ++x) {
      labels[x] = static_cast<int>(layer[x - begin]);
    }
  }
}

}  // namespace

const SimplexKernel kSimplexKernel = {move_primal, move_dual, project, bound, energy, cut};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
