// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/linked_kernel.h"

#include "engine/core/simd.h"

// Compiled once for each instruction set: see engine/core/isa.h for what may stand here.

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

inline Vec limited(Vec value, Vec limit) {
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
      store(to + x, load(to + x) - limited(q.unit * load_packed(from + x), load(limit + x)));
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
        const Vec next = limited(old + step * difference, per_unit * load(options.limit + x));
        store_packed(q + i, old + relaxation * (next - old));
      }
    }
  }
}

}  // namespace

const LinkedKernel kLinkedKernel = {unpack, pack, look_up, leave, arrive, move};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
