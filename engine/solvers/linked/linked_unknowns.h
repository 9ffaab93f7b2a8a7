// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/large_memory.h"
#include "engine/solvers/linked/linked_kernel.h"
#include "engine/solvers/linked/linked_labeling.h"
#include "engine/solvers/simplex/pair_duals.h"

#include <cstdint>
#include <vector>

namespace episcope {

/// u, 2u' − u, and the duals of pairs and links of all images, in 16 bits. Rows are `[label][x]`,
/// `pitch` apart; beyond the width everything stays 0.
class LinkedUnknowns {
 public:
  /// Everything 0. Units are those of the problem: u in ±4, duals up to twice their limits. Throws
  /// Cancelled.
  LinkedUnknowns(const LinkedProblem& problem, const Progress& progress);

  [[nodiscard]] const LinkedRow& row() const { return row_; }
  [[nodiscard]] long row_size() const { return row_.layers * row_.pitch; }
  [[nodiscard]] int height() const { return height_; }

  [[nodiscard]] std::int16_t* u(int image, int y) { return at(image, y); }
  [[nodiscard]] std::int16_t* ahead(int image, int y) { return at(image, y) + row_size(); }
  /// Duals of the pairs that begin in row y, `[pair][label][x]`.
  [[nodiscard]] std::int16_t* pairs(int image, int y) { return at(image, y) + 2 * row_size(); }
  /// Duals of the links of one kind that begin in row y.
  [[nodiscard]] std::int16_t* links(int image, int kind, int y) {
    return at(image, y) + (2 + kPairKinds + kind) * row_size();
  }
  /// From a row of one image to the same unknowns of the next row.
  [[nodiscard]] long stride() const { return (2 + kPairKinds + kLinkKinds) * row_size(); }

  static constexpr float kUnit = 1.0F / 8192;  ///< Of u and 2u' − u.
  [[nodiscard]] float pair_unit() const { return pair_unit_; }
  [[nodiscard]] float link_unit() const { return link_unit_; }

 private:
  [[nodiscard]] std::int16_t* at(int image, int y) {
    return memory_[static_cast<std::size_t>(image)].get() + y * stride();
  }

  LinkedRow row_;
  int height_ = 0;
  float pair_unit_ = 1, link_unit_ = 1;
  std::vector<LargeArray<std::int16_t>> memory_;
};

}  // namespace episcope
