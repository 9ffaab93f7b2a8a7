// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/order/motion_pictures.h"

#include <array>

namespace episcope::io {

/// Whether what moves between views moves along rows or along columns of the picture. Blocks are
/// matched one by one, so the evidence does not depend on where the plane of zero disparity lies.
class AxisEvidence {
 public:
  /// Adds a pair of views of equal size. The finest pictures are matched with shifts of up to 6 px,
  /// the next ones with up to 12 px.
  void add(const MotionPictures& one, const MotionPictures& other);

  /// Share of the difference of the views that goes when blocks are moved along x, or along y, at
  /// the scale where the two differ more clearly.
  [[nodiscard]] double gone_along_x() const;
  [[nodiscard]] double gone_along_y() const;
  /// Standard scores by which x explains the blocks better than y; negative for y.
  [[nodiscard]] double score() const;

  [[nodiscard]] bool is_x() const;
  [[nodiscard]] bool is_y() const;
  [[nodiscard]] bool has_pairs() const { return scales_[0].blocks + scales_[1].blocks > 0; }
  [[nodiscard]] bool is_decided() const { return is_x() || is_y(); }

  /// Sums over blocks, of the roots of mean squared differences.
  struct Sums {
    double blocks = 0;
    double unmoved = 0;
    double along_x = 0;
    double along_y = 0;
    double squares = 0;  ///< Of the differences of the last two.

    [[nodiscard]] double score() const;
  };

 private:
  [[nodiscard]] const Sums& clearest() const;

  std::array<Sums, 2> scales_;
};

}  // namespace episcope::io
