// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/cuts/multi_camera_energy.h"
#include "engine/disparity/cuts/recent_changes.h"
#include "engine/solvers/max_flow/minimal_cut.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace episcope {

/// Lowers a MultiCameraEnergy by α-expansions: each move lets any set of pixels of all views take
/// the label α, and finds the best such set by one minimal cut [KZ02].
///
/// With x_p = 1 where pixel p takes α, every term is submodular: an interaction gains D ≤ 0 only if
/// both its pixels keep their common label or both take α; min(|·|, T) is a metric; and visibility
/// forbids one of the two mixed assignments of a pair.
class LabelExpansion {
 public:
  /// `start` must be of finite energy.
  LabelExpansion(const MultiCameraEnergy& energy, CameraLabels start);

  /// The best expansion of `alpha` where anything has changed since its last one (RecentChanges);
  /// the first is the best of all. Returns by how much the energy changed, ≤ 0; none, with the
  /// labels as before, if `progress.finish_requested()`. Throws Cancelled.
  [[nodiscard]] std::optional<std::int64_t> expand(int alpha, const Progress& progress);

  [[nodiscard]] const CameraLabels& labels() const { return labels_; }
  /// D of pixel (y, x) of the reference view and a side view if they interact, else 0.
  [[nodiscard]] std::int32_t gain(int side, int y, int x) const;

 private:
  // Nodes of the pixels that may move; the others have kFixed.
  static constexpr std::int32_t kFixed = -1;
  [[nodiscard]] int number_nodes(int alpha);
  [[nodiscard]] CutGraph build(int alpha, int nodes, const Progress& progress) const;
  void add_smoothness(int view, int y, int alpha, CutGraph& graph) const;
  void add_interactions(int side, int y, int alpha, CutGraph& graph) const;
  void add_visibility_of_side(int side, int y, int alpha, CutGraph& graph) const;
  void take(int alpha, const MinimalCut& cut);

  const MultiCameraEnergy& energy_;
  CameraLabels labels_;
  // D of every pixel of the reference view at its label, whether or not the other has it too.
  std::vector<Image<std::int32_t>> gains_;
  RecentChanges changes_;
  std::vector<Image<std::int32_t>> nodes_;
};

}  // namespace episcope
