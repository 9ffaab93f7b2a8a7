// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/disparity/estimator.h"
#include "engine/disparity/global_labeling.h"
#include "engine/disparity/multi_camera_energy.h"
#include "engine/solvers/minimal_cut.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace episcope {

/// Where an expansion can be worth its time. Where nothing nearby has changed since a label was
/// last expanded, expanding it again would change nothing either, or so little that it is left out.
/// Kept for tiles of pixels, the views on top of each other.
class RecentChanges {
 public:
  /// Nothing is expanded yet.
  RecentChanges(int height, int width, int labels);

  /// For every tile: whether it or one beside it has changed since `label` was last expanded.
  [[nodiscard]] Image<char> since(int label) const;
  [[nodiscard]] static int tile_of(int pixel) { return pixel / kTile; }

  /// `label` is being expanded; what other labels change from here on is new to it.
  void begin(int label) { expanded_[label] = ++time_; }
  void mark(int y, int x) { changed_.at(tile_of(y), tile_of(x)) = time_; }

 private:
  // Larger than parallax between two views usually is.
  static constexpr int kTile = 24;

  int time_ = 0;
  Image<int> changed_;
  std::vector<int> expanded_;
};

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

/// Parameters of KZ02.
struct Kz02Parameters {
  ProfileChoice profile = {};
  int labels = 64;
  int distance = 4;
  Matching matching = {};
  double smoothness = 0.02;  ///< λ, in K.
  int truncation = 3;
  int cycles = 4;
  Refinement refinement = Refinement::Parabola;
  IntervalOrAuto range;
  ViewOrAuto view;
};

/// KZ02: multi-camera scene reconstruction via graph cuts. Labels of one view and of up to four
/// side views, left, right, above and below it, are found together: pixels of two views that have
/// the label at which both see the same point gain by it the more they look alike, neighbors of a
/// view should have similar labels, and no pixel may look through what another view sees
/// (MultiCameraEnergy). The energy is lowered by α-expansions (LabelExpansion) from the farthest
/// label on until no label lowers it further, or for `cycles` rounds; the order of labels is coarse
/// to fine. Views interact with the estimated one, not among each other. Only the labels of the
/// estimated view are returned.
///
/// Confidence: which share of the greatest possible gain a pixel has; 0 where no side view sees it.
/// The notes hold K, the fall of the energy and whether it ended at a minimum.
///
/// The profile `paper` is the method as published, with K and λ = K/5 by the published heuristic.
/// The default departs from it: views are compared between pixels, because labels of a dense light
/// field are finer than pixels; λ is a fraction of that for the same reason, since a slope jumps by
/// many labels; and each pixel moves between labels by a parabola through the matching costs over
/// all views (st_av_l). From the second cycle on, both expand a label only near what has changed
/// since its last expansion (RecentChanges). Evidence: tests/accuracy/tuning.md.
///
/// Takes about 1.6 kB for each pixel of the view, most of it for the cut, and runs on one thread. A
/// cut of 768×768 px takes seconds; it polls the progress all the while. Ends at
/// `progress.finish_requested()` with the labels so far. Throws InvalidInput (no such view, a
/// single view), Cancelled. Reference: Kolmogorov and Zabih 2002 [KZ02]; heuristics of the authors'
/// program [KMT14].
[[nodiscard]] Estimate estimate_kz02(const LightField& light_field,
                                     const Kz02Parameters& parameters, const Progress& progress);

[[nodiscard]] Estimator kz02_estimator();

}  // namespace episcope
