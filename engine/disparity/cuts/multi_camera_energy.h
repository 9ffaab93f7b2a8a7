// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/cuts/interactions.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace episcope {

/// The smoothness term of [KZ02]: λ_pq min(|f_p − f_q|, T) between the four neighbours of a pixel,
/// in each view. λ_pq is three times λ where the intensities of the neighbours differ by less than
/// 8/255 in every channel [KMT14].
struct CameraSmoothness {
  std::int32_t weight = Interactions::kUnit / 5;  ///< λ ≥ 0 in units of Interactions.
  int truncation = 3;                             ///< T ≥ 1, in labels.
};

/// One label for every pixel of every view, `[view][y][x]`; larger = nearer.
using CameraLabels = std::vector<Image<std::int16_t>>;

/// The energy of [KZ02] of a labeling of several views at once:
///   E = Σ D(p, q) + Σ λ_pq min(|f_p − f_q|, T) + E_visibility.
/// The first sum runs over interacting pixels with the same label, the second over neighbours in
/// one view. The last is infinite if a pixel claims to look through a point that another view sees:
/// if p has label l, the pixel of the other view on which that point falls must have l or more.
class MultiCameraEnergy {
 public:
  MultiCameraEnergy(const Interactions& interactions, CameraSmoothness smoothness);

  [[nodiscard]] const Interactions& interactions() const { return interactions_; }
  [[nodiscard]] int views() const { return static_cast<int>(to_right_.size()); }
  [[nodiscard]] int truncation() const { return truncation_; }
  /// λ_pq of a pixel and its neighbour to the right, below. 0 at the border.
  [[nodiscard]] const std::int32_t* to_right(int view, int y) const {
    return to_right_[view].row(y);
  }
  [[nodiscard]] const std::int32_t* below(int view, int y) const { return below_[view].row(y); }

  /// All pixels at the farthest label, which sees through nothing.
  [[nodiscard]] CameraLabels farthest() const;
  /// E in units of Interactions; none if visibility is violated.
  [[nodiscard]] std::optional<std::int64_t> of(const CameraLabels& labels) const;

 private:
  [[nodiscard]] std::int64_t smoothness_of(const CameraLabels& labels) const;
  [[nodiscard]] bool is_visible(const CameraLabels& labels) const;

  const Interactions& interactions_;
  int truncation_;
  std::vector<Image<std::int32_t>> to_right_, below_;
};

}  // namespace episcope
