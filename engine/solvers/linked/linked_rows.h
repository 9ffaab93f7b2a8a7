// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/progress.h"
#include "engine/solvers/linked/link_sources.h"
#include "engine/solvers/linked/linked_unknowns.h"
#include "engine/solvers/simplex/pair_limits.h"
#include "engine/solvers/simplex/simplex_labeling_kernel.h"

#include <vector>

namespace episcope {

/// Weight of a link in [0, 1].
[[nodiscard]] inline float link_weight(const ImageLinks& links, int y, int x) {
  return links.weight.empty() ? 1.0F : static_cast<float>(links.weight.at(y, x)) / 255;
}

/// What does not change while a problem is solved; borrowed.
struct LinkedSetting {
  const LinkedProblem& problem;
  const LinkSources& sources;
  const std::vector<PairLimits>& limits;  ///< Of each image.
  Isa isa;
  const Progress& progress;
};

/// One thread's work on the rows of an image: unknowns are unpacked into its own memory, moved, and
/// packed again. All throw Cancelled.
class LinkedRows {
 public:
  LinkedRows(const LinkedSetting& setting, LinkedUnknowns& unknowns);

  /// Moves u and the duals of pairs of an image by one iteration.
  void sweep(int image);
  /// Moves the duals of the links that leave an image, after all images were swept.
  void move_links(int image);
  /// The part of the lower bound that belongs to an image.
  [[nodiscard]] double bound(int image);
  /// The largest u of each pixel; of equals the lowest label.
  void round(int image, ImageView<int> labels);

 private:
  [[nodiscard]] PairDuals pairs(int image, int y);
  [[nodiscard]] float* ahead(int y);
  void load_pairs(int image, int y);
  void fill_costs(int image, int y, bool is_limited);
  void find_leaving(const ImageLinks& links, int y, bool is_limited);
  void find_arriving(int image, int kind, int y, bool is_limited);
  void move_pairs(int image, int y, const float* ahead_below);

  LinkedSetting setting_;
  LinkedUnknowns& unknowns_;
  const LinkedKernel& kernel_;
  const SimplexKernel& simplex_;
  LayeredShape shape_;
  float link_step_ = 1;
  std::vector<float> pairs_[2], ahead_[2];  // of the last two rows
  std::vector<float> nothing_, u_, cost_, limit_;
  std::vector<long> places_;
};

}  // namespace episcope
