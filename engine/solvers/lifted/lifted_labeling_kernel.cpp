// SPDX-License-Identifier: BSD-3-Clause
// Compiled once for each instruction set: see engine/core/parallel/isa.h for what may stand here.
#include "engine/solvers/lifted/lifted_labeling_kernel.h"

#include "engine/solvers/simplex/pair_duals_simd.h"

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

// Of a column of values v, where the projection to non-increasing sequences within [0, 1] is
// neither 1 nor 0: behind the summit of Σ (v − 1), up to that of Σ v. Both sums run in the order of
// the layers; the projection's values are slopes of the least concave majorant of Σ v.
struct Summits {
  float sum[kColumns], high[kColumns], excess[kColumns], high_excess[kColumns];
  float full[kColumns];   // the first so many layers are 1
  float empty[kColumns];  // all behind so many are 0

  void clear() {
    for (int i = 0; i < kColumns; i += kLanes) {
      float* const all[] = {sum, high, excess, high_excess, full, empty};
      for (float* const each : all) store(each + i, splat(0));
    }
  }
  void add(int i, Vec value, float layers) {
    const Vec s = load(sum + i) + value;
    const Vec e = load(excess + i) + (value - 1.0F);
    const IntVec rises = s > load(high + i);
    const IntVec rises_fast = e > load(high_excess + i);
    store(sum + i, s);
    store(excess + i, e);
    store(high + i, choose(rises, s, load(high + i)));
    store(high_excess + i, choose(rises_fast, e, load(high_excess + i)));
    store(empty + i, choose(rises, splat(layers), load(empty + i)));
    store(full + i, choose(rises_fast, splat(layers), load(full + i)));
  }
};

// Projects v[begin], …, v[end − 1], `stride` apart, to non-increasing sequences by pooling adjacent
// violators (Barlow et al. 1972).
void pool(float* v, long stride, int begin, int end) {
  float sums[kMaxLiftedLayers];
  int counts[kMaxLiftedLayers];
  int blocks = 0;
  for (int l = begin; l < end; ++l) {
    float sum = v[l * stride];
    int count = 1;
    while (blocks > 0 && sums[blocks - 1] * static_cast<float>(count) <=
                             sum * static_cast<float>(counts[blocks - 1])) {
      --blocks;
      sum += sums[blocks];
      count += counts[blocks];
    }
    sums[blocks] = sum;
    counts[blocks] = count;
    ++blocks;
  }
  int l = begin;
  for (int block = 0; block < blocks; ++block) {
    const float mean = sums[block] / static_cast<float>(counts[block]);
    for (int i = 0; i < counts[block]; ++i) v[l++ * stride] = mean;
  }
}

void pool_columns(const LayeredShape& shape, const Summits& summits, int begin, float* v) {
  const int end = shape.width < begin + kColumns ? shape.width : begin + kColumns;
  for (int x = begin; x < end; ++x) {
    const int first = static_cast<int>(summits.full[x - begin]);
    const int last = static_cast<int>(summits.empty[x - begin]);
    if (last - first > 1) pool(v + x, shape.pitch, first, last);
  }
}

void move_primal(const LayeredShape& shape, const float* cost, const PairDuals& here,
                 const PairDuals& above, float* phi, float* ahead) {
  Summits summits;
  const Vec step = splat(shape.primal_step), relaxation = splat(shape.relaxation);
  for (int begin = 0; begin < shape.width; begin += kColumns) {
    const int end = end_of(shape, begin);
    summits.clear();
    for (int l = 0; l < shape.steps; ++l) {
      const float* const lower = cost + static_cast<long>(l) * shape.width;
      const float* const upper = lower + shape.width;
      for (int x = begin; x < end; x += kLanes) {
        const long i = l * shape.pitch + x;
        const int left = shape.width - x;
        const Vec slope = load_first(lower + x, left) - load_first(upper + x, left);
        const Vec value = load(phi + i) + step * (divergence(here, above, i) + slope);
        store(ahead + i, value);
        summits.add(x - begin, value, static_cast<float>(l + 1));
      }
    }
    pool_columns(shape, summits, begin, ahead);
    for (int l = 0; l < shape.steps; ++l) {
      const Vec layer = splat(static_cast<float>(l));
      for (int x = begin; x < end; x += kLanes) {
        const long i = l * shape.pitch + x;
        const Vec within = greatest(least(load(ahead + i), splat(1)), splat(0));
        const Vec below = choose(layer < load(summits.empty + x - begin), within, splat(0));
        const Vec projected = choose(layer < load(summits.full + x - begin), splat(1), below);
        const Vec old = load(phi + i);
        store(ahead + i, 2.0F * projected - old);
        store(phi + i, old + relaxation * (projected - old));
      }
    }
  }
}

double bound(const LayeredShape& shape, const float* cost, const PairDuals& here,
             const PairDuals& above) {
  double total = 0;
  float least_cost[kColumns], gathered[kColumns];
  for (int begin = 0; begin < shape.width; begin += kColumns) {
    const int end = end_of(shape, begin);
    for (int x = begin; x < end; x += kLanes) {
      store(least_cost + x - begin, load_first(cost + x, shape.width - x));
      store(gathered + x - begin, splat(0));
    }
    for (int l = 0; l < shape.steps; ++l) {
      const float* const upper = cost + static_cast<long>(l + 1) * shape.width;
      for (int x = begin; x < end; x += kLanes) {
        const Vec sum =
            load(gathered + x - begin) + limited_divergence(here, above, l * shape.pitch + x, x);
        store(gathered + x - begin, sum);
        store(least_cost + x - begin,
              least(load(least_cost + x - begin), load_first(upper + x, shape.width - x) - sum));
      }
    }
    for (int x = begin; x < end && x < shape.width; ++x) {
      total += static_cast<double>(least_cost[x - begin]);
    }
  }
  return total;
}

void cut(const LayeredShape& shape, const float* phi, int* const labels[kLiftedCuts]) {
  float counts[kLiftedCuts][kColumns];
  for (int begin = 0; begin < shape.width; begin += kColumns) {
    const int end = end_of(shape, begin);
    for (auto& each : counts) {
      for (float& count : each) count = 0;
    }
    for (int l = 0; l < shape.steps; ++l) {
      for (int x = begin; x < end; x += kLanes) {
        const Vec value = load(phi + l * shape.pitch + x);
        for (int k = 0; k < kLiftedCuts; ++k) {
          float* const count = counts[k] + x - begin;
          store(count, load(count) + choose(value >= kLiftedThresholds[k], splat(1), splat(0)));
        }
      }
    }
    for (int k = 0; k < kLiftedCuts; ++k) {
      for (int x = begin; x < end && x < shape.width; ++x) {
        labels[k][x] = static_cast<int>(counts[k][x - begin]);
      }
    }
  }
}

}  // namespace

const LiftedKernel kLiftedKernel = {move_primal, move_dual, bound, cut};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
