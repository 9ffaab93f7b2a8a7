// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/layered_kernel.h"

#include "engine/core/simd.h"

// Compiled once for each instruction set: see engine/core/isa.h for what may stand here. First what
// both kernels share, then problems with ordered layers (lifted), then those without (simplex).

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

typedef short LooseShorts
    __attribute__((vector_size(EPISCOPE_VECTOR_BYTES / 2), aligned(2), may_alias));

constexpr float kLargest = 32767;

inline Vec load_packed(const std::int16_t* from) {
  return __builtin_convertvector(*reinterpret_cast<const LooseShorts*>(from), Vec);
}

inline void store_packed(std::int16_t* to, Vec value) {
  const Vec size = least(absolute(value) + 0.5F, splat(kLargest));
  const IntVec rounded = convert<int>(choose(value < 0.0F, -size, size));
  *reinterpret_cast<LooseShorts*>(to) = __builtin_convertvector(rounded, LooseShorts);
}

inline Vec clamp(Vec value, Vec limit) {
  return greatest(least(value, limit), -limit);
}

void unpack(Packed from, long count, float* to) {
  for (long i = 0; i < count; i += kLanes) store(to + i, from.unit * load_packed(from.data + i));
}

void pack(const float* from, long count, float unit, std::int16_t* to) {
  const float per_unit = 1 / unit;
  for (long i = 0; i < count; i += kLanes) store_packed(to + i, per_unit * load(from + i));
}

void look_up(const std::uint8_t* codes, const float* table, long count, float* cost) {
  for (long i = 0; i < count; ++i) cost[i] = table[codes[i]];
}

void leave(const LinkedRow& row, Packed q, const float* limit, float* cost) {
  for (int l = 0; l < row.layers; ++l) {
    const std::int16_t* const from = q.data + l * row.pitch;
    float* const to = cost + static_cast<long>(l) * row.width;
    int x = 0;
    for (; x + kLanes <= row.width; x += kLanes) {
      store(to + x, load(to + x) - clamp(q.unit * load_packed(from + x), load(limit + x)));
    }
    for (; x < row.width; ++x) {
      const float value = q.unit * static_cast<float>(from[x]);
      to[x] -= value > limit[x] ? limit[x] : value < -limit[x] ? -limit[x] : value;
    }
  }
}

void arrive(const LinkedRow& row, Packed q, const long* from, const float* limit, float* cost) {
  for (int l = 0; l < row.layers; ++l) {
    const std::int16_t* const layer = q.data + l * row.pitch;
    float* const to = cost + static_cast<long>(l) * row.width;
    for (int x = 0; x < row.width; ++x) {
      const float value = q.unit * static_cast<float>(layer[from[x]]);
      to[x] += value > limit[x] ? limit[x] : value < -limit[x] ? -limit[x] : value;
    }
  }
}

void move(const LinkedRow& row, Packed here, Packed there, const long* to, const LinkStep& options,
          float q_unit, std::int16_t* q) {
  constexpr int kColumns = 64;
  float far[kColumns] = {};
  const Vec step = splat(options.step * here.unit / q_unit);
  const Vec relaxation = splat(options.relaxation), per_unit = splat(1 / q_unit);
  for (int l = 0; l < row.layers; ++l) {
    const std::int16_t* const layer = there.data + l * row.pitch;
    for (int begin = 0; begin < row.width; begin += kColumns) {
      const int end = begin + kColumns < row.width ? begin + kColumns : row.width;
      for (int x = begin; x < end; ++x) far[x - begin] = static_cast<float>(layer[to[x]]);
      for (int x = begin; x < end; x += kLanes) {
        const long i = l * row.pitch + x;
        const Vec difference = load(far + x - begin) - load_packed(here.data + i);
        const Vec old = load_packed(q + i);
        const Vec next = clamp(old + step * difference, per_unit * load(options.limit + x));
        store_packed(q + i, old + relaxation * (next - old));
      }
    }
  }
}

constexpr int kColumns = kLayerColumns;

struct AllLayers {
  static constexpr int kCount = 512;
  std::uint16_t layers[kCount] = {};
  constexpr AllLayers() {
    for (int l = 0; l < kCount; ++l) layers[l] = static_cast<std::uint16_t>(l);
  }
};
constexpr AllLayers kAllLayers;

inline LayerList all_layers(const LayeredShape& shape) {
  return {kAllLayers.layers, shape.steps};
}

inline LayerBlock block_of(const LayeredShape& shape, const PairDuals& row, int begin) {
  if (row.blocks != nullptr) return row.blocks[begin / kColumns];
  return {all_layers(shape), all_layers(shape), {}};
}

// The first `count` floats, then zeros.
inline Vec load_first(const float* from, int count) {
  if (count >= kLanes) return load(from);
  Vec value{};
  for (int i = 0; i < count; ++i) value[i] = from[i];
  return value;
}

inline int end_of(const LayeredShape& shape, int begin) {
  const int end = whole_registers(shape.width);
  return end < begin + kColumns ? end : begin + kColumns;
}

// What leaves a pixel through the pairs that begin at it, less what enters through those that end.
inline Vec divergence(const PairDuals& here, const PairDuals& above, long i) {
  return load(here.pair[0] + i) - load(here.pair[0] + i - 1) +     //
         (load(here.pair[1] + i) - load(above.pair[1] + i)) +      //
         (load(here.pair[2] + i) - load(above.pair[2] + i - 1)) +  //
         (load(here.pair[3] + i - 1) - load(above.pair[3] + i));
}

inline Vec limited(const PairDuals& row, int pair, long i, int x) {
  return clamp(load(row.pair[pair] + i), load(row.limit[pair] + x));
}

inline Vec limited_divergence(const PairDuals& here, const PairDuals& above, long i, int x) {
  return limited(here, 0, i, x) - limited(here, 0, i - 1, x - 1) +
         (limited(here, 1, i, x) - limited(above, 1, i, x)) +
         (limited(here, 2, i, x) - limited(above, 2, i - 1, x - 1)) +
         (limited(here, 3, i - 1, x - 1) - limited(above, 3, i, x));
}

void move_dual(const LayeredShape& shape, const float* ahead, const float* ahead_below,
               const PairDuals& here) {
  const Vec step = splat(shape.dual_step), relaxation = splat(shape.relaxation);
  const auto move = [&](int pair, long i, int x, Vec difference) {
    float* const at = here.pair[pair] + i;
    const Vec old = load(at);
    const Vec next = clamp(old + step * difference, load(here.limit[pair] + x));
    store(at, old + relaxation * (next - old));
  };
  for (int begin = 0; begin < shape.width; begin += kColumns) {
    const int end = end_of(shape, begin);
    const LayerList paired = block_of(shape, here, begin).paired;
    for (int k = 0; k < paired.count; ++k) {
      for (int x = begin; x < end; x += kLanes) {
        const long i = paired.layers[k] * shape.pitch + x;
        const Vec at = load(ahead + i), right = load(ahead + i + 1);
        const Vec down = load(ahead_below + i), across = load(ahead_below + i + 1);
        move(0, i, x, right - at);
        move(1, i, x, down - at);
        move(2, i, x, across - at);
        move(3, i, x, down - right);
      }
    }
  }
}

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

void move_primal_lifted(const LayeredShape& shape, const float* cost, const PairDuals& here,
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

double bound_lifted(const LayeredShape& shape, const float* cost, const PairDuals& here,
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

void cut_lifted(const LayeredShape& shape, const float* phi, int* const labels[kLiftedCuts]) {
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
          store(count, load(count) + choose(value >= kLiftedThresholds.at[k], splat(1), splat(0)));
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

void move_primal_simplex(const LayeredShape& shape, const float* cost, const PairDuals& here,
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

double bound_simplex(const LayeredShape& shape, const float* cost, const PairDuals& here,
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

void cut_simplex(const LayeredShape& shape, const float* u, int* labels) {
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

const LinkedKernel kLinkedKernel = {unpack, pack, look_up, leave, arrive, move};

const LiftedKernel kLiftedKernel = {move_primal_lifted, move_dual, bound_lifted, cut_lifted};

const SimplexKernel kSimplexKernel = {move_primal_simplex, move_dual, project,
                                      bound_simplex,       energy,    cut_simplex};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
