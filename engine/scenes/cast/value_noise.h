// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// For kernel sources only: value noise on an integer lattice.

#include "engine/core/parallel/simd_pack.h"

namespace episcope::scenes::EPISCOPE_KERNEL_NAMESPACE {
namespace {

using namespace episcope::EPISCOPE_KERNEL_NAMESPACE;

constexpr unsigned kPrimeX = 0x9E3779B1U;
constexpr unsigned kPrimeY = 0x85EBCA77U;
constexpr unsigned kPrimeZ = 0xC2B2AE3DU;

/// A lattice value in [−1, 1) for each key.
inline Floats lattice_value(const Uints& key) {
  Uints h = (key ^ (key >> 15)) * 0x2C1B3C6DU;
  h = (h ^ (h >> 12)) * 0x297A2D39U;
  return convert<float>(convert<int>(h >> 8)) * 0x1p-23F - 1.0F;
}

/// The largest integers not above `a`, of magnitude below 2^31.
inline Ints floor_to_int(const Floats& a) {
  const Ints cut = convert<int>(a);
  return cut + (convert<float>(cut) > a);  // a comparison that holds is −1
}

/// Lattice cell of one coordinate: keys of its two ends and the C2 weight of the second.
struct Cell {
  Uints low;
  Uints high;
  Floats weight;
};

inline Cell cell_of(const Floats& x, unsigned prime) {
  const Ints whole = floor_to_int(x);
  const Floats t = x - convert<float>(whole);
  Cell cell;
  cell.low = convert<unsigned>(whole) * prime;
  cell.high = cell.low + prime;
  cell.weight = t * t * t * (t * (t * 6.0F - 15.0F) + 10.0F);
  return cell;
}

inline Floats blend(const Floats& a, const Floats& b, const Floats& weight) {
  return a + (b - a) * weight;
}

inline Floats noise(const Floats& x, const Floats& y, unsigned seed) {
  const Cell cx = cell_of(x, kPrimeX);
  const Cell cy = cell_of(y, kPrimeY);
  const Uints top = cy.low ^ seed;
  const Uints bottom = cy.high ^ seed;
  return blend(blend(lattice_value(cx.low ^ top), lattice_value(cx.high ^ top), cx.weight),
               blend(lattice_value(cx.low ^ bottom), lattice_value(cx.high ^ bottom), cx.weight),
               cy.weight);
}

inline Floats noise(const Floats& x, const Floats& y, const Floats& z, unsigned seed) {
  const Cell cx = cell_of(x, kPrimeX);
  const Cell cy = cell_of(y, kPrimeY);
  const Cell cz = cell_of(z, kPrimeZ);
  const auto slice = [&](const Uints& z_key) {
    const Uints top = cy.low ^ z_key;
    const Uints bottom = cy.high ^ z_key;
    return blend(blend(lattice_value(cx.low ^ top), lattice_value(cx.high ^ top), cx.weight),
                 blend(lattice_value(cx.low ^ bottom), lattice_value(cx.high ^ bottom), cx.weight),
                 cy.weight);
  };
  return blend(slice(cz.low ^ seed), slice(cz.high ^ seed), cz.weight);
}

}  // namespace
}  // namespace episcope::scenes::EPISCOPE_KERNEL_NAMESPACE
